/* report.h - what a command says when it ends: messages, exit statuses, and whether the user asked to stop. */
#ifndef ISOROLL_REPORT_H
#define ISOROLL_REPORT_H

#include <stdbool.h>
#include <stdio.h>

#include "api/typed_impl.h"
#include "base/fold_impl.h"
#include "io/table_impl.h"
#include "orbit/orbit_impl.h"

enum exit_status {
    EXIT_DONE = 0,
    EXIT_SOME_FAILED = 1, /* some rows or cells failed; a bound of `check` is broken; interrupted */
    EXIT_USAGE = 2,
    EXIT_BAD_INPUT = 3,
    EXIT_NUMERICAL = 4,
    EXIT_FILE = 5,
};

/* Text for people is as wide as the terminal. A pipe or a file gets each line whole, so that `grep` finds what stands
 * in it, unless the environment's COLUMNS says how wide it should be. Returns ISO_ANY_WIDTH for such a stream. */
enum { USUAL_WIDTH = 80 };
int terminal_width(FILE *stream);

/* Prints "isoroll: MESSAGE" on stderr, in one line. */
void warn(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Prints each line of a text as warn does; NULL: there is none. */
void warn_lines(const char *text);

/* From now on warn only keeps its message; last_warning returns it ("": none). */
void warn_silently(void);
const char *last_warning(void);

/* Prints the context's message and returns the exit status that belongs to `status`. Says nothing after success,
 * after a stop on request, and when the reader of a pipe has gone. */
int finish(iso_context *ctx, iso_status status);

/* As finish(), after a failure with the scene: says where in its file the cause stands, unless an option put it
 * there. */
int finish_scene(iso_context *ctx, const char *file, const iso_scene *scene, iso_status status);

/* Puts the file's name before the context's message, unless it names a place, a file or an option already. Returns
 * `status`. */
iso_status name_the_file(iso_context *ctx, const char *file, iso_status status);

/* The worse of two exit statuses. */
int worse(int a, int b);

/* SIGINT, SIGTERM and SIGHUP take away the files that are being written, then end the program. */
void end_tidily(void);

/* From now on SIGINT, SIGTERM, SIGHUP, and SIGUSR1, which schedulers send before a time limit, only ask to stop. A
 * signal that comes two seconds later ends the program. */
void stop_gently(void);

/* True if the first signal that asked to stop was SIGTERM or SIGUSR1: a time limit, not the user. */
bool limit_is_near(void);

/* True once the user has asked to stop. */
bool interrupted(void);
bool not_interrupted(void *unused); /* a monitor of a context */

/* Long work begins: stop_gently, and the library asks interrupted(); a bar shows the progress. rows: where the work
 * writes rows, as for progress_begin_rows; NULL: nowhere yet. */
void begin_work(iso_context *ctx, const char *rows);

#endif

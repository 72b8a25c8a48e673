/* report.c - text for people, messages, exit statuses, and the signals that ask a command to stop (see report.h). */
#include "report.h"

#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "io/output_impl.h"
#include "io/text_impl.h"
#include "progress.h"

static volatile sig_atomic_t stop_asked, stop_signal;

static void end(int signal_number)
{
    iso_output_unlink_all();
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static void ask_to_stop(int signal_number)
{
    static volatile time_t first;
    if (!stop_asked) {
        first = time(NULL);
        stop_signal = signal_number;
    }
    stop_asked = 1;
    if (time(NULL) - first >= 2) end(signal_number); /* timeout(1) sends two signals at once */
}

/* A signal that nohup or a background start ignores stays ignored. */
static void at_signal(int signal_number, void (*handler)(int))
{
    const struct sigaction act = {.sa_handler = handler};
    struct sigaction old;
    if (sigaction(signal_number, NULL, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signal_number, &act, NULL);
}

void end_tidily(void)
{
    at_signal(SIGINT, end);
    at_signal(SIGTERM, end);
    at_signal(SIGHUP, end);
}

void stop_gently(void)
{
    at_signal(SIGINT, ask_to_stop);
    at_signal(SIGTERM, ask_to_stop);
    at_signal(SIGHUP, ask_to_stop);
    at_signal(SIGUSR1, ask_to_stop);
}

bool limit_is_near(void)
{
    return stop_signal == SIGTERM || stop_signal == SIGUSR1;
}

bool interrupted(void)
{
    return stop_asked != 0;
}

bool not_interrupted(void *unused)
{
    (void)unused;
    return !interrupted();
}

void begin_work(iso_context *ctx, const char *rows)
{
    stop_gently();
    progress_begin_rows(rows ? rows : "");
    iso_context_set_monitor(ctx, not_interrupted, NULL);
}

/* --- text ------------------------------------------------------------------------------------------------------- */

int terminal_width(FILE *stream)
{
    enum { LEAST_WIDTH = 40, MOST_WIDTH = 10000 };
    struct winsize size;
    const char *columns = getenv("COLUMNS");
    const bool is_terminal = isatty(fileno(stream));
    const long wanted = columns ? strtol(columns, NULL, 10) : 0;
    long width = is_terminal ? USUAL_WIDTH : ISO_ANY_WIDTH;
    if (is_terminal && ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        width = size.ws_col;
    else if (wanted > 0 && wanted <= MOST_WIDTH)
        width = wanted;
    return width == ISO_ANY_WIDTH || width >= LEAST_WIDTH ? (int)width : LEAST_WIDTH;
}

static bool silently;
static char kept[2048];

void warn_lines(const char *text)
{
    while (text && *text) {
        const size_t length = strcspn(text, "\n");
        warn("%.*s", (int)length, text);
        text += length + (text[length] == '\n');
    }
}

void warn_silently(void)
{
    silently = true;
}

const char *last_warning(void)
{
    return kept;
}

/* File names may hold control characters: they become question marks. */
void warn(const char *format, ...)
{
    char line[sizeof kept + 16];
    va_list args;
    va_start(args, format);
    vsnprintf(kept, sizeof kept, format, args);
    va_end(args);
    for (char *c = kept; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7f) *c = '?';
    if (silently) return;
    const int length = snprintf(line, sizeof line, "isoroll: %s", kept);
    progress_pause(); /* a message is folded on a terminal alone: elsewhere it is one line */
    iso_fold_line(stderr, line, (size_t)length, isatty(STDERR_FILENO) ? terminal_width(stderr) : ISO_ANY_WIDTH);
    progress_resume();
}

int worse(int a, int b)
{
    return a > b ? a : b;
}

int finish(iso_context *ctx, iso_status status)
{
    static const int exits[] = {
        [ISO_OK] = EXIT_DONE,
        [ISO_BAD_ARGUMENT] = EXIT_USAGE,
        [ISO_BAD_INPUT] = EXIT_BAD_INPUT,
        [ISO_NOT_MAPPED] = EXIT_BAD_INPUT,
        [ISO_NUMERICAL] = EXIT_NUMERICAL,
        [ISO_STOPPED] = EXIT_SOME_FAILED,
        [ISO_FILE_TROUBLE] = EXIT_FILE,
        [ISO_NO_MEMORY] = EXIT_NUMERICAL,
        [ISO_CLOSED_PIPE] = EXIT_FILE,
    };
    const bool silent = status == ISO_OK || status == ISO_STOPPED || status == ISO_CLOSED_PIPE;
    if (!silent) warn("%s", iso_context_message(ctx));
    return exits[status];
}

int finish_scene(iso_context *ctx, const char *file, const iso_scene *scene, iso_status status)
{
    return finish(ctx, iso_scene_blame(ctx, scene, iso_text_name(file), status));
}

iso_status name_the_file(iso_context *ctx, const char *file, iso_status status)
{
    const bool named = status == ISO_OK || status == ISO_BAD_ARGUMENT || status == ISO_FILE_TROUBLE ||
                       status == ISO_CLOSED_PIPE || iso_context_has_place(ctx);
    if (named) return status;
    return iso_context_fail(ctx, status, iso_context_about(ctx), "%s: %s", iso_text_name(file),
                            iso_context_message(ctx));
}

/* progress.h - a bar on stderr while a command works: how much is done, the time since the beginning, the time left;
 * "drawing" while gnuplot works.
 *
 *     progress_begin();
 *     status = long_work(ctx, ..., progress_sink, ...);      calls progress_show(part) now and then, or never
 *     progress_end();                                        before anything is printed on standard output
 *
 * The bar is drawn on a terminal only, and only after the first second. A thread of its own draws it: time runs on
 * while the work has nothing to tell. */
#ifndef ISOROLL_PROGRESS_H
#define ISOROLL_PROGRESS_H

/* The work begins. A second call changes nothing. */
void progress_begin(void);

/* The same for work that writes rows to `output` ("-": standard output): rows on a terminal are progress enough. */
void progress_begin_rows(const char *output);

/* Which part of the work is done, 0 to 1. The first call says where it began: what was done before takes no time. */
void progress_show(double part);

/* The same, for options of the library that take such a function. */
void progress_sink(void *unused, double part);

/* What is done from now on until progress_end, "drawing" or another word: the bar shows it, and a part only if it is
 * told. */
void progress_doing(const char *what);

/* The work has ended: takes the bar away. */
void progress_end(void);

/* Takes the bar away while a message is printed on stderr; it comes again. */
void progress_pause(void);
void progress_resume(void);

/* Seconds on the wall, from any beginning. */
double wall_seconds(void);

#endif

/* progress.h - a bar on stderr while a command works. */
#ifndef ISOROLL_PROGRESS_H
#define ISOROLL_PROGRESS_H

/* Shows which part of the work is done, 0 to 1. Draws only on a terminal, and only after the first second. */
void progress_show(double part);

/* The same, with words behind it. */
void progress_with(double part, const char *words);

/* The same, for options of the library that take such a function. */
void progress_told(double part, void *unused);

/* Takes the bar away. */
void progress_end(void);

/* Seconds on the wall, from any beginning. */
double wall_seconds(void);

#endif

/* progress.c - a bar on stderr while a command works (see progress.h). */
#include "progress.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

enum { WIDTH = 40, WORDS = 30 };

double wall_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool drawn;

void progress_with(double part, const char *words)
{
    static double start = -1, last;
    if (start < 0) start = wall_seconds();
    const double time = wall_seconds();
    if (time - start < 1 || time - last < 0.1 || !isatty(STDERR_FILENO)) return;
    last = time;
    const char *no_color = getenv("NO_COLOR"); /* counts only if it is not empty */
    const bool coloured = !no_color || !*no_color;
    fprintf(stderr, "\r%s", coloured ? "\033[36m" : "");
    for (int i = 0; i < WIDTH; i++) fputc(i < (int)(part * WIDTH) ? '#' : '.', stderr);
    fprintf(stderr, "%s %3.0f %% %-*.*s", coloured ? "\033[0m" : "", 100 * part, WORDS * (*words != '\0'), WORDS,
            words);
    fflush(stderr);
    drawn = true;
}

void progress_show(double part)
{
    progress_with(part, "");
}

void progress_told(double part, void *unused)
{
    (void)unused;
    progress_show(part);
}

void progress_end(void)
{
    if (drawn) fprintf(stderr, "\r%*s\r", WIDTH + 8 + WORDS, "");
    drawn = false;
}

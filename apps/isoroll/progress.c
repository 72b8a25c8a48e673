#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "command.h"

enum { WIDTH = 40 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool drawn;

/* Asked at every row: the clock is read only every so often. */
void progress_show(double part)
{
    static double start = -1, last;
    static unsigned calls;
    if (start < 0) start = now();
    if (calls++ % 64 != 0 || now() - start < 1 || now() - last < 0.1 || !isatty(STDERR_FILENO)) return;
    last = now();
    const char *colour = getenv("NO_COLOR") ? "" : "\033[36m", *plain = getenv("NO_COLOR") ? "" : "\033[0m";
    fprintf(stderr, "\r%s", colour);
    for (int i = 0; i < WIDTH; i++) fputc(i < (int)(part * WIDTH) ? '#' : '.', stderr);
    fprintf(stderr, "%s %3.0f %%", plain, 100 * part);
    fflush(stderr);
    drawn = true;
}

void progress_end(void)
{
    if (drawn) fprintf(stderr, "\r%*s\r", WIDTH + 8, "");
    drawn = false;
}

/* progress.c - a bar on stderr while a command works (see progress.h). */
#include "progress.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "report.h"

enum { WIDTH = 40, LINE = 80, WORDS = 32 /* the percentage, and the times */ };

/* All is changed under the lock. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t woken;
static struct {
    bool works, drawn;
    const char *what;   /* is done, if it is not the work itself; NULL: it is */
    double begun;       /* when                                            */
    double first, part; /* the first and the last part shown; NAN: none */
    pthread_t drawer;
} bar;

double wall_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* --- drawing ---------------------------------------------------------------------------------------------------- */

/* 0:05, 12:40, 3:00:00 */
static int print_time(char *to, size_t room, double seconds)
{
    const double all = floor(seconds), hours = floor(all / 3600), minutes = floor(all / 60) - 60 * hours;
    const int rest = (int)(all - 3600 * hours - 60 * minutes);
    if (hours < 1) return snprintf(to, room, "%.0f:%02d", minutes, rest);
    return snprintf(to, room, "%.0f:%02.0f:%02d", hours, minutes, rest);
}

static void draw(void)
{
    char words[LINE];
    const char *no_color = getenv("NO_COLOR"); /* counts only if it is not empty */
    const bool coloured = !no_color || !*no_color;
    const double part = isnan(bar.part) ? 0 : bar.part;
    const int room = terminal_width(stderr) - WORDS - 1, width = room < WIDTH ? room : WIDTH;
    /* the part that is done, the time since the beginning, and what is left if all goes on as fast */
    const double elapsed = wall_seconds() - bar.begun, done = bar.part - bar.first;
    int used = bar.what ? snprintf(words, LINE, "%s, ", bar.what) : 0;
    if (!bar.what || !isnan(bar.part)) used += snprintf(words + used, (size_t)(LINE - used), "%3.0f %% ", 100 * part);
    used += print_time(words + used, (size_t)(LINE - used), elapsed);
    if (!bar.what && done > 0) {
        used += snprintf(words + used, (size_t)(LINE - used), ", ");
        used += print_time(words + used, (size_t)(LINE - used), elapsed * (1 - bar.part) / done);
        snprintf(words + used, (size_t)(LINE - used), " left");
    }
    fprintf(stderr, "\r%s", coloured ? "\033[36m" : "");
    for (int i = 0; i < width; i++) fputc(i < (int)(part * width) ? '#' : '.', stderr);
    fprintf(stderr, "%s %-*s", coloured ? "\033[0m" : "", WORDS - 2, words);
    fflush(stderr);
    bar.drawn = true;
}

static void take_away(void)
{
    const int all = WIDTH + WORDS, width = terminal_width(stderr) - 1;
    if (bar.drawn) fprintf(stderr, "\r%*s\r", width < all ? width : all, "");
    bar.drawn = false;
}

/* Draws after the first second, then ten times a second, until the work ends. */
static void *draw_on(void *unused)
{
    (void)unused;
    pthread_mutex_lock(&lock);
    for (double next = bar.begun + 1; bar.works; next = wall_seconds() + 0.1) {
        const struct timespec until = {.tv_sec = (time_t)next, .tv_nsec = (long)(1e9 * (next - floor(next)))};
        while (bar.works && wall_seconds() < next) pthread_cond_timedwait(&woken, &lock, &until);
        if (bar.works) draw();
    }
    pthread_mutex_unlock(&lock);
    return NULL;
}

/* --- the work --------------------------------------------------------------------------------------------------- */

/* Signals are for the thread that works. */
static bool start_drawer(void)
{
    sigset_t all, before;
    pthread_condattr_t attributes;
    sigfillset(&all);
    if (pthread_condattr_init(&attributes) != 0) return false;
    bool started = pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC) == 0 &&
                   pthread_cond_init(&woken, &attributes) == 0 && pthread_sigmask(SIG_BLOCK, &all, &before) == 0;
    if (started) {
        started = pthread_create(&bar.drawer, NULL, draw_on, NULL) == 0;
        pthread_sigmask(SIG_SETMASK, &before, NULL);
    }
    pthread_condattr_destroy(&attributes);
    return started;
}

void progress_begin(void)
{
    if (!isatty(STDERR_FILENO)) return;
    pthread_mutex_lock(&lock);
    if (!bar.works) {
        bar.begun = wall_seconds();
        bar.first = bar.part = NAN;
        bar.what = NULL;
        bar.works = true;
        bar.works = start_drawer();
    }
    pthread_mutex_unlock(&lock);
}

void progress_begin_rows(const char *output)
{
    if (strcmp(output, "-") != 0 || !isatty(STDOUT_FILENO)) progress_begin();
}

void progress_show(double part)
{
    pthread_mutex_lock(&lock);
    if (isnan(bar.part)) bar.first = part;
    bar.part = part;
    pthread_mutex_unlock(&lock);
}

void progress_sink(void *unused, double part)
{
    (void)unused;
    progress_show(part);
}

void progress_doing(const char *what)
{
    progress_begin();
    pthread_mutex_lock(&lock);
    bar.what = what;
    bar.first = bar.part = NAN;
    pthread_mutex_unlock(&lock);
}

void progress_end(void)
{
    pthread_mutex_lock(&lock);
    const bool worked = bar.works;
    bar.works = false;
    take_away();
    if (worked) pthread_cond_signal(&woken);
    pthread_mutex_unlock(&lock);
    if (!worked) return;
    pthread_join(bar.drawer, NULL);
    pthread_cond_destroy(&woken);
}

void progress_pause(void)
{
    pthread_mutex_lock(&lock);
    take_away();
}

void progress_resume(void)
{
    pthread_mutex_unlock(&lock);
}

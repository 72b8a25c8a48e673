/* report.c - messages on stderr, exit statuses, and the signals that ask a command to stop (see report.h). */
#include "report.h"

#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "progress.h"

static volatile sig_atomic_t stop_asked;

static void ask_to_stop(int signal_number)
{
    static volatile time_t first;
    if (!stop_asked) first = time(NULL);
    stop_asked = 1;
    if (time(NULL) - first < 2) return; /* timeout(1) sends two signals at once */
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

void stop_gently(void)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    const struct sigaction ask = {.sa_handler = ask_to_stop};
    struct sigaction old;
    for (int i = 0; i < 3; i++) /* a signal that nohup or a background start ignores stays ignored */
        if (sigaction(signals[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signals[i], &ask, NULL);
}

bool interrupted(void)
{
    return stop_asked != 0;
}

/* File names may hold control characters: they become question marks. */
void complain(const char *format, ...)
{
    char text[2048];
    va_list args;
    progress_end();
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7f) *c = '?';
    fprintf(stderr, "isoroll: %s\n", text);
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
    if (!silent) complain("%s", iso_context_message(ctx));
    return exits[status];
}

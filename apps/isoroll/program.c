/* program.c - how a program of isoroll begins, runs a command, and ends (see command.h). */
#include "command.h"

#include <errno.h>
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_version.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#ifdef ISO_SUNDIALS
#include <sundials/sundials_version.h>
#endif
#include <unistd.h>
#include <yaml.h>

#include "json.h"

void program_version(void)
{
    int major, minor, patch;
    yaml_get_version(&major, &minor, &patch);
    printf("isoroll %s\n", iso_version());
#ifdef ISO_SUNDIALS
    char sundials[32] = "?";
    SUNDIALSGetVersion(sundials, sizeof sundials);
    printf("SUNDIALS %s\n", sundials);
#endif
    printf("GSL %s\nlibyaml %d.%d.%d\njansson %s\n", gsl_version, major, minor, patch, JANSSON_VERSION);
}

static int run_with(iso_context *ctx, void *options, const command *c, int argc, char **argv)
{
    if (!ctx || !options) return warn("out of memory"), EXIT_NUMERICAL;
    if (c->defaults) memcpy(options, c->defaults, c->size);
    if (c->study) c->study->begin(options);
    switch (options_read(c, argc, argv, options)) {
    case OPTIONS_WRONG: return EXIT_USAGE;
    case OPTIONS_HELP: help_command(c, stdout); return EXIT_DONE;
    case OPTIONS_DONE: break;
    }
    const void *argument = (const char *)options + c->file;
    if (!c->files && !file_fits(c, *(const char *const *)argument)) return EXIT_BAD_INPUT;
    if (!c->study) return c->run(ctx, options);
    const iso_status status = c->study->prepare ? c->study->prepare(ctx, options) : ISO_OK;
    const int result = status != ISO_OK ? finish(ctx, status)
                       : c->run         ? c->run(ctx, options)
                                        : shell_run(ctx, c->study, &c->parts, options, argument);
    if (c->study->end) c->study->end(options);
    return result;
}

int program_run(const command *c, int argc, char **argv)
{
    iso_context *ctx = iso_context_create();
    void *options = calloc(1, c->size);
    const int status = run_with(ctx, options, c, argc, argv);
    progress_end();
    free(options);
    iso_context_free(ctx);
    return status;
}

/* What was printed may still be lost: a full disk shows when the buffer is written. */
int program_flush(int status)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) return status;
    if (errno == 0) (void)!write(STDOUT_FILENO, "\n", 1); /* an earlier write failed: this one says why */
    if (errno != EPIPE && status != EXIT_FILE)
        warn("cannot write to standard output: %s", strerror(errno ? errno : EIO));
    return status == EXIT_DONE ? EXIT_FILE : status;
}

void program_begin(void)
{
    /* A file that we open must not get the number of a closed standard stream: messages would be written into it.
     * Writing to a closed stdout still fails, since /dev/null is opened for reading there. */
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) < 0) (void)!open("/dev/null", fd == 2 ? O_WRONLY : O_RDONLY);
    signal(SIGPIPE, SIG_IGN); /* a failed write says so: to a closed pipe, and to a file that would be too large */
    signal(SIGXFSZ, SIG_IGN);
    end_tidily();
    gsl_set_error_handler_off();
    json_begin();
}

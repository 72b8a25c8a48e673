/* isoroll - the rubber Chaplygin ball and its twin, the point on a sphere, at the command line. */
#include <errno.h>
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_version.h>
#include <signal.h>
#include <stdarg.h>
#include <string.h>
#include <sundials/sundials_version.h>
#include <time.h>
#include <unistd.h>
#include <yaml.h>

#include "command.h"
#include "json.h"

static const command *const commands[] = {&command_run,      &command_convert,     &command_compare,
                                          &command_cost,     &command_check,       &command_analogue,
                                          &command_frequencies, &command_explain, &command_list, &command_plot};
enum { COMMANDS = sizeof commands / sizeof *commands };

static volatile sig_atomic_t stop_asked;

static void ask_to_stop(int signal_number)
{
    static volatile time_t first;
    if (!stop_asked) first = time(NULL);
    stop_asked = 1;
    if (time(NULL) - first < 2) return; /* timeout(1) sends two at once */
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

void stop_gently(void)
{
    static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
    const struct sigaction ask = {.sa_handler = ask_to_stop};
    struct sigaction old;
    for (int i = 0; i < 3; i++) /* ignored: started in the background or by nohup, to stay so */
        if (sigaction(signals[i], NULL, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signals[i], &ask, NULL);
}

bool interrupted(void)
{
    return stop_asked != 0;
}

/* One line, whatever the file names in it are made of. */
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

static void print_help(FILE *to)
{
    fputs("isoroll simulates the rubber Chaplygin ball rolling on a sphere and its twin, a point on a sphere in a\n"
          "Neumann/Braden potential, and carries orbits from one to the other.\n\n"
          "usage: isoroll COMMAND [options] [SCENE or FILE]      - is standard input or output\n\n",
          to);
    for (int i = 0; i < COMMANDS; i++)
        fprintf(to, "  %-11s %-9s %s\n", commands[i]->name, commands[i]->argument, commands[i]->doc);
    fputs("\n  isoroll COMMAND --help     the options of a command\n"
          "  isoroll --version          of isoroll and its libraries\n\n"
          "exit status: 0 done; 1 some rows failed, or interrupted; 2 usage; 3 bad input; 4 numerical failure, or no "
          "memory;\n5 file trouble\n",
          to);
}

static void print_version(void)
{
    char sundials[32] = "?";
    int major, minor, patch;
    yaml_get_version(&major, &minor, &patch);
    SUNDIALSGetVersion(sundials, sizeof sundials);
    printf("isoroll %s\nSUNDIALS %s\nGSL %s\nlibyaml %d.%d.%d\njansson %s\n", ISO_VERSION, sundials, gsl_version,
           major, minor, patch, JANSSON_VERSION);
}

static const command *find_command(const char *name)
{
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(commands[i]->name, name) == 0) return commands[i];
    return NULL;
}

static int run_command(const command *c, int argc, char **argv)
{
    options o;
    iso_context *ctx = iso_context_create();
    if (!ctx) return complain("out of memory"), EXIT_NUMERICAL;
    int status = EXIT_USAGE;
    if (options_read(c, argc, argv, &o)) {
        if (o.help) options_help(c, stdout);
        status = o.help ? EXIT_DONE : c->run(ctx, &o);
    }
    progress_end();
    iso_context_free(ctx);
    return status;
}

/* What was printed may still fail to arrive: a full disk shows when the buffer is written. */
static int flush_output(int status)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) return status;
    if (errno == 0) (void)!write(STDOUT_FILENO, "\n", 1); /* an earlier write has failed: the next one says why */
    if (errno != EPIPE && status != EXIT_FILE)
        complain("cannot write to standard output: %s", strerror(errno ? errno : EIO));
    return status == EXIT_DONE ? EXIT_FILE : status;
}

/* A closed standard stream must not become the number of a file we write: writing to it would tear that file. What is
 * printed to a closed stdout still fails, since /dev/null is opened for reading there. */
static void fill_closed_streams(void)
{
    for (int fd = 0; fd <= 2; fd++)
        if (fcntl(fd, F_GETFD) < 0) (void)!open("/dev/null", fd == 2 ? O_WRONLY : O_RDONLY);
}

int main(int argc, char **argv)
{
    fill_closed_streams();
    signal(SIGPIPE, SIG_IGN); /* writing tells, here and of a file that would be too large */
    signal(SIGXFSZ, SIG_IGN);
    gsl_set_error_handler_off();
    json_begin();
    const char *name = argc > 1 ? argv[1] : "";
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0)
        return print_help(stdout), flush_output(EXIT_DONE);
    if (strcmp(name, "--version") == 0) return print_version(), flush_output(EXIT_DONE);
    const command *c = find_command(name);
    if (c) return flush_output(run_command(c, argc - 1, argv + 1));
    if (argc < 2)
        print_help(stderr);
    else
        complain("unknown command '%s'; 'isoroll --help' lists them", name);
    return EXIT_USAGE;
}

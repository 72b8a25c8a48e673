/* gnuplot.c - runs gnuplot. Its standard input is the script, its standard output the picture, its messages go to a
 * third file. All three are files, not pipes: nothing can block or raise SIGPIPE, and no script contains a file
 * name. */
#define _GNU_SOURCE /* memmem */
#include "plot/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/output_impl.h"
#include "progress.h"

#define INSTALL "install gnuplot (package gnuplot-nox)"

extern char **environ;

/* A format: the terminal that makes it, and how a complete file of it ends. A file without this ending shows that
 * gnuplot was stopped or had no room on the disk, also where its exit status is lost (in a program that ignores
 * SIGCHLD). */
typedef struct format {
    const char *extension, *terminal, *unit;
    double scale;         /* units of the file in a pixel of the page, on the screen          */
    double inch, px;      /* units of the file in an inch, and in a pixel as the user says it */
    double letter;        /* height of a letter "10" at fontscale 1, in units of the file     */
    double lines, points; /* linewidth and pointscale on the screen; 0: there is none             */
    const char *ending;
} format;

#define LOOK "enhanced rounded background 'white'"
static const format formats[] = {
    {".svg", "svg " LOOK " font 'DejaVu Sans,Helvetica,Arial,sans-serif,10'", "", 1, 96, 1, 10, 1, 0, "</svg>"},
    {".png", "pngcairo " LOOK " font 'DejaVu Sans,10'", "", 2, 300, 1, 40.0 / 3, 2, 2.1, "IEND\xAE\x42\x60\x82"},
    {".pdf", "pdfcairo " LOOK " font 'DejaVu Sans,10'", "in", 0.01, 1, 1.0 / 96, 5.0 / 27, 1.6, 1, "%%EOF"},
};
#define MM 25.4 /* an inch */

static const format *find_format(const char *path)
{
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        const size_t n = strlen(formats[i].extension);
        if (length > n && strcmp(path + length - n, formats[i].extension) == 0) return &formats[i];
    }
    return NULL;
}

/* A pipe would wait for its reader. */
static iso_status check_regular(iso_context *ctx, const char *path)
{
    struct stat old;
    if (stat(path, &old) != 0 || S_ISREG(old.st_mode)) return ISO_OK;
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot write '%s': it is not a regular file", path);
}

iso_status iso_gnuplot_check_files(iso_context *ctx, const iso_plot_page *page)
{
    if (!find_format(page->path))
        return ISO_FAIL_ARGUMENT(ctx, "", "'%s': the name of a picture must end in .svg, .png or .pdf", page->path);
    ISO_TRY(check_regular(ctx, page->path));
    return page->script ? check_regular(ctx, page->script) : ISO_OK;
}

void iso_gnuplot_write_page(FILE *to, const iso_plot_page *page)
{
    const format *f = find_format(page->path);
    double given[] = {page->size.width, page->size.height}; /* in units of the file */
    for (int i = 0; i < 2; i++) given[i] = page->size.mm ? given[i] / MM * f->inch : given[i] * f->px;
    fprintf(to,
            "terminal = \"%s\"; unit = '%s'; in_print = %d\n"
            "per_pixel = %.17g; per_inch = %.17g; per_letter = %.17g; lines = %.17g; points = %.17g\n"
            "given_width = %.17g; given_height = %.17g\n",
            f->terminal, f->unit, page->style == ISO_PLOT_IN_PRINT, f->scale, f->inch, f->letter, f->lines, f->points,
            given[0], given[1]);
}

/* ---- Drawing ---- */

/* gnuplot's messages in one line; of long ones the end. */
static void read_complaints(FILE *file, char text[], size_t size)
{
    fseek(file, 0, SEEK_END);
    const long length = ftell(file), most = (long)size - 1;
    fseek(file, length > most ? length - most : 0, SEEK_SET);
    const size_t got = fread(text, 1, size - 1, file);
    size_t kept = 0;
    for (size_t i = 0; i < got; i++) {
        const bool blank = (unsigned char)text[i] <= 0x20 || text[i] == 0x7F || text[i] == '^';
        if (!blank)
            text[kept++] = text[i];
        else if (kept > 0 && text[kept - 1] != ' ')
            text[kept++] = ' ';
    }
    while (kept > 0 && text[kept - 1] == ' ') kept--;
    text[kept] = '\0';
}

/* Starts a program that is searched for in PATH, its name and arguments with NULL behind them, with these standard
 * streams. Returns an errno, 0 if it runs. */
static int start_program(const char *const arguments[], const int streams[3], pid_t *child)
{
    int copies[3] = {-1, -1, -1}, error = 0; /* above 2: where they stand, dup2 cannot overwrite one with another */
    posix_spawn_file_actions_t actions;
    if ((error = posix_spawn_file_actions_init(&actions)) != 0) return error;
    for (int i = 0; i < 3 && error == 0; i++) {
        copies[i] = fcntl(streams[i], F_DUPFD_CLOEXEC, 3);
        error = copies[i] < 0 ? errno : posix_spawn_file_actions_adddup2(&actions, copies[i], i);
    }
    if (error == 0)
        error = posix_spawnp(child, arguments[0], &actions, NULL, (char *const *)(void *)arguments, environ);
    for (int i = 0; i < 3; i++)
        if (copies[i] >= 0) close(copies[i]);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

static bool is_whole(const format *f, int file)
{
    char end[32];
    const off_t length = lseek(file, 0, SEEK_END);
    const off_t from = length > (off_t)sizeof end ? length - (off_t)sizeof end : 0;
    const ssize_t got = pread(file, end, sizeof end, from);
    return got > 0 && memmem(end, (size_t)got, f->ending, strlen(f->ending));
}

/* Why nothing more can be written to the picture, as an errno; 0: something can. */
static int why_full(int file)
{
    static const char block[1 << 16];
    const off_t end = lseek(file, 0, SEEK_END);
    const ssize_t written = end < 0 ? 0 : pwrite(file, block, sizeof block, end);
    return written < 0 ? errno : written < (ssize_t)sizeof block ? ENOSPC : 0;
}

static iso_status draw(iso_context *ctx, const format *f, FILE *script, iso_output *output, FILE *complaints)
{
    const int file = fileno(iso_output_stream(output));
    char text[200];
    pid_t child, ended;
    int result = 0;
    fputs("\nunset multiplot\nunset output\n", script);
    if (fflush(script) != 0 || ferror(script) || fseek(script, 0, SEEK_SET) != 0)
        return iso_file_trouble(ctx, "write", "gnuplot's temporary script");
    /* -d: no start-up file of the user changes the picture. What it is given as "-" gnuplot reads by single bytes. */
    const int error = start_program((const char *[]){"gnuplot", "-d", "/dev/stdin", NULL},
                                    (int[]){fileno(script), file, fileno(complaints)}, &child);
    if (error != 0)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot run gnuplot: %s; " INSTALL, strerror(error));
    progress_doing("drawing");
    do ended = waitpid(child, &result, 0);
    while (ended < 0 && errno == EINTR);
    progress_end();
    if (ended == child && WIFSIGNALED(result) && WTERMSIG(result) == SIGINT)
        return iso_context_fail(ctx, ISO_STOPPED, "", "the picture was interrupted");
    if (ended == child && WIFSIGNALED(result))
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "",
                                "gnuplot was ended by signal %d; if it cannot run here, " INSTALL, WTERMSIG(result));
    if ((ended < 0 || (ended == child && WEXITSTATUS(result) == 0)) && is_whole(f, file)) return ISO_OK;
    errno = why_full(file);
    if (errno != 0) return iso_file_trouble(ctx, "write", iso_output_name(output));
    read_complaints(complaints, text, sizeof text);
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "gnuplot did not draw '%s' (exit status %d); it said: %s",
                            iso_output_name(output), ended == child ? WEXITSTATUS(result) : -1,
                            text[0] ? text : "nothing");
}

iso_status iso_gnuplot_run(iso_context *ctx, const iso_plot_page *page, FILE *script)
{
    iso_output *output, *copy;
    ISO_TRY(iso_output_open(ctx, page->path, &output));
    FILE *complaints = tmpfile();
    iso_status status = complaints ? draw(ctx, find_format(page->path), script, output, complaints)
                                   : iso_file_trouble(ctx, "open", "a temporary file");
    if (complaints) fclose(complaints);
    const iso_status closed = iso_output_close(ctx, output, status == ISO_OK);
    if (status == ISO_OK) status = closed;
    if (status != ISO_OK || !page->script) return status;
    ISO_TRY(iso_output_open(ctx, page->script, &copy));
    status = iso_output_copy(ctx, copy, script);
    const iso_status kept = iso_output_close(ctx, copy, status == ISO_OK);
    return status == ISO_OK ? kept : status;
}

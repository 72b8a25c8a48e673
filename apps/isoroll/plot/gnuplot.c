/* gnuplot.c - runs gnuplot. Its standard input is the script, its standard output the picture, its messages go to a
 * third file. All three are files, not pipes: nothing can block or raise SIGPIPE, and no script contains a file
 * name. */
#define _GNU_SOURCE /* memmem, mempcpy */
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
enum { NARROW_TITLE = 38 };

/* The picture that is drawn. */
static struct {
    iso_status status;
    const format *format;
    const char *script_name;
    FILE *script, *complaints; /* without a name */
    iso_output *output;        /* the picture    */
} g;

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
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                "'%s': the name of a picture must end in .svg, .png or .pdf", page->path);
    ISO_TRY(check_regular(ctx, page->path));
    return page->script ? check_regular(ctx, page->script) : ISO_OK;
}

/* ---- The page ---- */

/* Whether a picture of one panel is one column wide. */
static bool is_narrow(const iso_plot_page *page)
{
    return page->style == ISO_PLOT_IN_PRINT && page->size.width == 0;
}

/* A length that the user gives, in units of the file. */
static double given(const format *f, const iso_plot_page *page, double length)
{
    return page->size.mm ? length / MM * f->inch : length * f->px;
}

/* ---- Opening ---- */

static iso_status open_files(iso_context *ctx, const iso_plot_page *page)
{
    ISO_TRY(iso_gnuplot_check_files(ctx, page));
    ISO_TRY(iso_output_open(ctx, page->path, &g.output));
    g.script = tmpfile();
    g.complaints = tmpfile();
    return g.script && g.complaints ? ISO_OK : iso_file_trouble(ctx, "open", "a temporary file");
}

FILE *iso_gnuplot_begin(iso_context *ctx, const iso_plot_page *page)
{
    const format *f = g.format = find_format(page->path);
    g.output = NULL;
    g.script = g.complaints = NULL;
    g.script_name = page->script;
    g.status = open_files(ctx, page);
    if (!g.script) return stdin; /* takes nothing */
    fprintf(g.script, "# Made by isoroll, for gnuplot 5.4: gnuplot -d SCRIPT >PICTURE%s\n", f->extension);
    return g.script;
}

void iso_gnuplot_put_page(FILE *to, const iso_plot_page *page)
{
    const format *f = g.format;
    const bool sized = page->size.width > 0;
    if (!g.script) return;
    fprintf(to,
            "terminal = \"%s\"; unit = '%s'; in_print = %d\n"
            "per_pixel = %.17g; per_inch = %.17g; per_letter = %.17g; lines = %.17g; points = %.17g\n"
            "given_width = %.17g; given_height = %.17g\n",
            f->terminal, f->unit, page->style == ISO_PLOT_IN_PRINT, f->scale, f->inch, f->letter, f->lines, f->points,
            sized ? given(f, page, page->size.width) : 0, sized ? given(f, page, page->size.height) : 0);
}

/* ---- Texts ---- */

/* The length of the character that begins text, 0 if it is none that XML and pango take (controls, broken UTF-8). */
int iso_gnuplot_character(const char *from)
{
    const unsigned char *text = (const unsigned char *)from;
    static const unsigned smallest[] = {0, 0x20, 0xA0, 0x800, 0x10000};
    const int length = text[0] < 0x80 ? 1 : text[0] < 0xC0 ? 0 : text[0] < 0xE0 ? 2 : text[0] < 0xF0 ? 3 : 4;
    if (length == 0 || text[0] >= 0xF8 || text[0] == 0x7F) return 0;
    unsigned code = length == 1 ? text[0] : text[0] & (0x7Fu >> length);
    for (int i = 1; i < length; i++) {
        if ((text[i] & 0xC0) != 0x80) return 0;
        code = code << 6 | (text[i] & 0x3Fu);
    }
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    return code < smallest[length] || code > 0x10FFFF || surrogate || (code & 0xFFFE) == 0xFFFE ? 0 : length;
}

/* Characters that mean nothing to gnuplot in a text; quotes, backslashes, `commands` and @macros are not among
 * them. */
static bool is_plain(unsigned char c)
{
    return c >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           (c && strchr(" -._/,:", c));
}

/* Every other character is written in octal. (In single quotes gnuplot 5.4 fails on a text that begins with a quote.)
 * gnuplot reads a fourth digit as part of the number: before a digit the text is closed, and joined to the next by a
 * dot. */
const char *iso_gnuplot_quote(char quoted[static ISO_QUOTED_SIZE], const char *text, int longest)
{
    const unsigned char *c = (const unsigned char *)(text ? text : "");
    char *to = quoted;
    *to++ = '"';
    for (int i = 0; *c && i < longest; i++) {
        const int length = iso_gnuplot_character((const char *)c);
        if (length == 0)
            *to++ = *c < 0x20 ? ' ' : '.';
        else if (is_plain(*c))
            to = mempcpy(to, c, (size_t)length);
        else
            to += sprintf(to, c[1] >= '0' && c[1] <= '9' ? "\\%03o\".\"" : "\\%03o", *c);
        c += length > 0 ? length : 1;
    }
    strcpy(to, *c ? "…\"" : "\"");
    return quoted;
}

/* Where the first line of a title ends, which is too long for one: where there is a gap, else at the last blank that is
 * near enough, outside of parentheses if there is one. Without such a blank the line is longer. */
static size_t end_of_line(const char *text)
{
    size_t outside = 0, inside = 0;
    int open = 0;
    for (size_t i = 0; text[i] && i <= NARROW_TITLE; i++) {
        open += (text[i] == '(') - (text[i] == ')');
        if (text[i] != ' ' || i == 0) continue;
        if (text[i + 1] == ' ') return i;
        inside = i;
        if (open == 0) outside = i;
    }
    return outside ? outside : inside ? inside : strlen(text);
}

const char *iso_gnuplot_quote_title(char quoted[static ISO_QUOTED_SIZE], const iso_plot_page *page, const char *own,
                                    int longest)
{
    char line[ISO_QUOTED_SIZE], whole[200] = "";
    const char *text = iso_plot_titled(page, own);
    if (!is_narrow(page)) return iso_gnuplot_quote(quoted, text, longest);
    for (int i = 0, used = 0, length; text && *text && i < longest && used < (int)sizeof whole - 8; i++) {
        length = iso_gnuplot_character(text);
        used += snprintf(whole + used, sizeof whole - (size_t)used, "%.*s", length > 0 ? length : 1,
                         length > 0 ? text : " ");
        text += length > 0 ? length : 1;
    }
    text = whole;
    *quoted = '\0';
    for (; *quoted == '\0' || *text;) {
        const size_t used = strlen(quoted), length = strlen(text) > NARROW_TITLE ? end_of_line(text) : strlen(text);
        char part[200];
        snprintf(part, sizeof part, "%.*s", (int)length, text);
        snprintf(quoted + used, ISO_QUOTED_SIZE - used, "%s%s", used ? ".\"\\n\"." : "",
                 iso_gnuplot_quote(line, part, longest));
        for (text += length; *text == ' ';) text++;
    }
    return quoted;
}

/* ---- The script ---- */

/* Copies what has been written into the file that --script names. */
static iso_status keep_script(iso_context *ctx)
{
    iso_output *copy;
    if (!g.script_name) return ISO_OK;
    ISO_TRY(iso_output_open(ctx, g.script_name, &copy));
    const iso_status status = iso_output_copy(ctx, copy, g.script);
    const iso_status closed = iso_output_close(ctx, copy, status == ISO_OK);
    return status == ISO_OK ? closed : status;
}

/* ---- Drawing ---- */

/* gnuplot's messages in one line; of long ones the end. */
static void read_complaints(FILE *file, char words[], size_t size)
{
    fseek(file, 0, SEEK_END);
    const long length = ftell(file), tail = (long)size - 1;
    fseek(file, length > tail ? length - tail : 0, SEEK_SET);
    const size_t got = fread(words, 1, size - 1, file);
    size_t kept = 0;
    for (size_t i = 0; i < got; i++) {
        const bool blank = (unsigned char)words[i] <= 0x20 || words[i] == 0x7F || words[i] == '^';
        if (!blank)
            words[kept++] = words[i];
        else if (kept > 0 && words[kept - 1] != ' ')
            words[kept++] = ' ';
    }
    while (kept > 0 && words[kept - 1] == ' ') kept--;
    words[kept] = '\0';
}

int program_start(const char *const arguments[], const int streams[3], pid_t *child)
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

static bool is_whole(void)
{
    char tail[32];
    const off_t length = lseek(fileno(iso_output_stream(g.output)), 0, SEEK_END);
    const off_t from = length > (off_t)sizeof tail ? length - (off_t)sizeof tail : 0;
    const ssize_t got = pread(fileno(iso_output_stream(g.output)), tail, sizeof tail, from);
    return got > 0 && memmem(tail, (size_t)got, g.format->ending, strlen(g.format->ending));
}

/* Why nothing more can be written to the picture, as an errno; 0: something can. */
static int why_full(void)
{
    static const char block[1 << 16];
    const off_t end = lseek(fileno(iso_output_stream(g.output)), 0, SEEK_END);
    const ssize_t put = end < 0 ? 0 : pwrite(fileno(iso_output_stream(g.output)), block, sizeof block, end);
    return put < 0 ? errno : put < (ssize_t)sizeof block ? ENOSPC : 0;
}

static iso_status run(iso_context *ctx)
{
    char words[200];
    pid_t child, ended;
    int result = 0;
    fputs("\nunset multiplot\nunset output\n", g.script);
    if (fflush(g.script) != 0 || ferror(g.script) || fseek(g.script, 0, SEEK_SET) != 0)
        return iso_file_trouble(ctx, "write", "gnuplot's temporary script");
    /* -d: no start-up file of the user changes the picture. What it is given as "-" gnuplot reads by single bytes. */
    const int error =
        program_start((const char *[]){"gnuplot", "-d", "/dev/stdin", NULL},
                      (int[]){fileno(g.script), fileno(iso_output_stream(g.output)), fileno(g.complaints)}, &child);
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
    if (ended == child && WEXITSTATUS(result) == 0 && is_whole()) return ISO_OK;
    if (ended < 0 && is_whole()) return ISO_OK;
    errno = why_full();
    if (errno != 0) return iso_file_trouble(ctx, "write", iso_output_name(g.output));
    read_complaints(g.complaints, words, sizeof words);
    return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "gnuplot did not draw '%s' (exit status %d); it said: %s",
                            iso_output_name(g.output), ended == child ? WEXITSTATUS(result) : -1,
                            words[0] ? words : "nothing");
}

iso_status iso_gnuplot_close(iso_context *ctx, bool keep)
{
    const iso_status drawn = g.status == ISO_OK && keep ? run(ctx) : g.status;
    iso_status status = iso_output_close(ctx, g.output, keep && drawn == ISO_OK);
    if (drawn == ISO_OK && status == ISO_OK && keep) status = keep_script(ctx);
    if (g.script) fclose(g.script);
    if (g.complaints) fclose(g.complaints);
    return drawn != ISO_OK ? drawn : status;
}

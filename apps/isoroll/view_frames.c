/* view_frames.c - pictures of a page, drawn by a Chromium without a window (see view.h).
 *
 * Chromium opens the page with a fragment #frames=FIRST,COUNT,ALL. The page draws these pictures while it loads and
 * writes each into <pre id="frames"> as a line "frame NUMBER data:image/png;base64,...", which --dump-dom prints.
 * Texts of files come before it, and have no "<" there: they cannot forge a picture. One run draws BATCH pictures, so
 * memory stays small. No port is opened and nothing is loaded from a network.
 */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/output_impl.h"
#include "io/replacement_impl.h"
#include "plot/gnuplot.h"
#include "progress.h"
#include "view.h"

enum { BATCH = 20, MOST_FRAMES = 100000 };

/* --- Chromium --------------------------------------------------------------------------------------------------- */

/* Starts the first Chromium that is found. `out` becomes its standard output. Returns 0 or an errno. */
static int spawn(const char *address, int out, pid_t *child)
{
    static const char *const names[] = {"chromium", "chromium-browser", "google-chrome", "chrome"};
    const char *sandbox = geteuid() == 0 ? "--no-sandbox" : "--headless"; /* for root, Chromium has no sandbox */
    const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    int error = nothing < 0 ? errno : ENOENT;
    for (size_t i = 0; i < sizeof names / sizeof *names && nothing >= 0 && error == ENOENT; i++)
        error = program_start((const char *[]){names[i], "--headless", sandbox, "--disable-gpu",
                                               "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                                               "--host-resolver-rules=MAP * ~NOTFOUND", "--no-first-run",
                                               "--dump-dom", address, NULL},
                              (int[]){nothing, out, nothing}, child);
    if (nothing >= 0) close(nothing);
    return error;
}

static iso_status run_chromium(iso_context *ctx, const char *address, FILE *out)
{
    pid_t child;
    int result = 0;
    const int error = spawn(address, fileno(out), &child);
    if (error != 0)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "",
                                "--frames: cannot run Chromium: %s; install it (package chromium), or save pictures "
                                "in the page",
                                strerror(error));
    while (waitpid(child, &result, 0) < 0)
        if (errno != EINTR) break;
    rewind(out);
    return ISO_OK;
}

/* --- pictures --------------------------------------------------------------------------------------------------- */

static void put_base64(FILE *to, const char *text)
{
    static const char digits[] = VIEW_BASE64;
    unsigned bits = 0;
    int held = 0;
    for (const char *digit; *text && (digit = strchr(digits, *text)); text++) {
        bits = (bits << 6 | (unsigned)(digit - digits)) & 0xFFFFFF;
        held += 6;
        if (held < 8) continue;
        held -= 8;
        fputc((int)(bits >> held & 0xFF), to);
    }
}

static iso_status write_picture(iso_context *ctx, const char *folder, unsigned long number, const char *base64)
{
    char path[PATH_MAX];
    iso_output *out;
    snprintf(path, sizeof path, "%s/frame%04lu.png", folder, number + 1);
    ISO_TRY(iso_output_open(ctx, path, &out));
    put_base64(iso_output_stream(out), base64);
    return iso_output_close(ctx, out, true);
}

/* The picture in a line "frame NUMBER data:...", in base64; NULL: it is no such line. */
static const char *picture_in(const char *line, unsigned long number)
{
    char start[64];
    const int length = snprintf(start, sizeof start, "frame %lu data:image/png;base64,", number);
    return strncmp(line, start, (size_t)length) == 0 ? line + length : NULL;
}

/* Takes the frames from `first` on, at most `count`, out of what Chromium printed. */
static iso_status take_frames(iso_context *ctx, FILE *from, const char *folder, size_t first, size_t count,
                              size_t *taken)
{
    char *line = NULL;
    size_t room = 0;
    bool begun = false;
    iso_status status = ISO_OK;
    while (status == ISO_OK && *taken < count && getline(&line, &room, from) >= 0) {
        const char *base64 = begun ? picture_in(line, first + *taken) : NULL;
        begun = begun || strstr(line, "<pre id=\"frames\">");
        if (!base64) continue;
        status = write_picture(ctx, folder, first + *taken, base64);
        *taken += status == ISO_OK;
    }
    free(line);
    return status;
}

/* The number in frameNUMBER.png; 0: the name is another. */
static unsigned long number_of(const char *name)
{
    char *end;
    if (strncmp(name, "frame", 5) != 0 || name[5] < '0' || name[5] > '9') return 0;
    const unsigned long number = strtoul(name + 5, &end, 10);
    return strcmp(end, ".png") == 0 ? number : 0;
}

/* A page stands in the folder while Chromium reads it, locked by the program that wrote it. */
static bool is_page(const char *name)
{
    return strncmp(name, ".isoroll-", 9) == 0 && ends_with(name, ".html");
}

/* Removes the page of a program that was killed: it has no lock any more. */
static void remove_dead(DIR *folder, const char *name)
{
    const int fd = openat(dirfd(folder), name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return;
    if (flock(fd, LOCK_EX | LOCK_NB) == 0) unlinkat(dirfd(folder), name, 0);
    close(fd);
}

/* Older pictures beyond the last new one would become part of the film. */
static iso_status check_folder(iso_context *ctx, const char *folder, size_t all)
{
    iso_status status = ISO_OK;
    DIR *list = opendir(folder);
    if (!list) return iso_file_trouble(ctx, "open", folder);
    for (const struct dirent *one; status == ISO_OK && (one = readdir(list));) {
        if (is_page(one->d_name)) remove_dead(list, one->d_name);
        if (number_of(one->d_name) > all)
            status = iso_context_fail(ctx, ISO_FILE_TROUBLE, "",
                                      "--frames: '%s' has %s of an older film, and this one has %zu pictures: empty "
                                      "the folder, or name another",
                                      folder, one->d_name, all);
    }
    closedir(list);
    return status;
}

/* --- all of them ------------------------------------------------------------------------------------------------ */

/* The address of a file: characters that have a meaning in addresses are written in hexadecimal. */
static void address_of(const char *path, size_t first, size_t count, size_t all, char *to, size_t size)
{
    size_t used = (size_t)snprintf(to, size, "file://");
    for (const char *c = path; *c && used + 64 < size; c++) {
        const bool plain =
            strchr("/-._~", *c) || (*c >= '0' && *c <= '9') || (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z');
        used += (size_t)snprintf(to + used, size - used, plain ? "%c" : "%%%02X", (unsigned char)*c);
    }
    snprintf(to + used, size - used, "#frames=%zu,%zu,%zu", first, count, all);
}

/* Draws the pictures from `first` on. */
static iso_status draw_batch(iso_context *ctx, const char *folder, const char *address, size_t first, size_t count)
{
    size_t taken = 0;
    FILE *out = tmpfile();
    if (!out) return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot open a temporary file: %s", strerror(errno));
    iso_status status = run_chromium(ctx, address, out);
    if (status == ISO_OK) status = take_frames(ctx, out, folder, first, count, &taken);
    fclose(out);
    if (status != ISO_OK) return status;
    if (interrupted()) /* Ctrl-C ends Chromium too */
        return iso_context_fail(ctx, ISO_STOPPED, "", "%zu pictures were drawn", first + taken);
    if (taken < count)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "",
                                "--frames: Chromium drew only %zu of the frames %zu to %zu", taken, first + 1,
                                first + count);
    return ISO_OK;
}

static iso_status draw(iso_context *ctx, const view_frames *f, const char *page, size_t all)
{
    char address[3 * PATH_MAX + 128];
    iso_status status = ISO_OK;
    for (size_t first = 0; status == ISO_OK && first < all; first += BATCH) {
        const size_t count = all - first < BATCH ? all - first : BATCH;
        address_of(page, first, count, all, address, sizeof address);
        status = draw_batch(ctx, f->folder, address, first, count);
        progress_show((double)(first + count) / (double)all);
    }
    return status;
}

/* Writes and locks the page. In between, another program can take it for dead and remove it: then once more. */
static iso_status put_page(iso_context *ctx, const char *path, const view_page *page, int *lock)
{
    for (;;) {
        struct stat mine, named;
        ISO_TRY(view_write(ctx, path, page));
        *lock = open(path, O_RDWR | O_CLOEXEC);
        if (*lock < 0 && errno != ENOENT) return ISO_OK; /* it goes on without a lock */
        if (*lock < 0) continue;
        (void)!flock(*lock, LOCK_SH);
        if (fstat(*lock, &mine) == 0 && stat(path, &named) == 0 && mine.st_ino == named.st_ino) return ISO_OK;
        close(*lock);
    }
}

iso_status view_write_frames(iso_context *ctx, const view_frames *f, const view_page *page)
{
    char folder[PATH_MAX], path[PATH_MAX + 32];
    int lock;
    const double all = ceil(f->fps * f->seconds);
    if (all > MOST_FRAMES)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "--frames: fps times seconds is %g pictures, more than %d",
                                all, MOST_FRAMES);
    if (mkdir(f->folder, 0777) != 0 && errno != EEXIST) return iso_file_trouble(ctx, "make the folder", f->folder);
    if (!realpath(f->folder, folder)) return iso_file_trouble(ctx, "open", f->folder);
    ISO_TRY(check_folder(ctx, f->folder, (size_t)all));
    snprintf(path, sizeof path, "%s/.isoroll-%ld.html", folder, (long)getpid());
    iso_status status = put_page(ctx, path, page, &lock);
    if (status != ISO_OK) return status;
    status = draw(ctx, f, path, (size_t)all);
    unlink(path);
    close(lock);
    return status;
}

/* view_frames.c - pictures of a page, drawn by a Chromium without a window (see view.h).
 *
 * Chromium opens the page with a fragment #frames=FIRST,COUNT,ALL. The page draws these pictures while it loads and
 * writes each into its text as a line "frame NUMBER data:image/png;base64,...", which --dump-dom prints. One run draws
 * BATCH pictures, so memory stays small. No port is opened and nothing is loaded from a network.
 */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/output.h"
#include "progress.h"
#include "view.h"

enum { BATCH = 20, MOST_FRAMES = 100000 };

extern char **environ;

/* --- Chromium --------------------------------------------------------------------------------------------------- */

/* Starts the first Chromium that is found. `out` becomes its standard output. Returns 0 or an errno. */
static int spawn(const char *address, int out, pid_t *child)
{
    static const char *const names[] = {"chromium", "chromium-browser", "google-chrome", "chrome"};
    const char *sandbox = geteuid() == 0 ? "--no-sandbox" : "--headless"; /* for root, Chromium has no sandbox */
    const char *arguments[] = {NULL,
                               "--headless",
                               sandbox,
                               "--disable-gpu",
                               "--use-angle=swiftshader",
                               "--enable-unsafe-swiftshader",
                               "--host-resolver-rules=MAP * ~NOTFOUND",
                               "--no-first-run",
                               "--dump-dom",
                               address,
                               NULL};
    posix_spawn_file_actions_t actions;
    int error = posix_spawn_file_actions_init(&actions);
    if (error != 0) return error;
    posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    error = ENOENT;
    for (size_t i = 0; i < sizeof names / sizeof *names && error == ENOENT; i++) {
        arguments[0] = names[i];
        error = posix_spawnp(child, names[i], &actions, NULL, (char *const *)(void *)arguments, environ);
    }
    posix_spawn_file_actions_destroy(&actions);
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

static int value_of(char c)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c ? strchr(digit, c) : NULL;
    return at ? (int)(at - digit) : -1;
}

static void put_base64(FILE *to, const char *text)
{
    unsigned bits = 0;
    int held = 0;
    for (int v; (v = value_of(*text)) >= 0; text++) {
        bits = (bits << 6 | (unsigned)v) & 0xFFFFFF;
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
    const iso_status status = iso_output_open(ctx, path, &out);
    if (status != ISO_OK) return status;
    put_base64(iso_output_stream(out), base64);
    return iso_output_close(ctx, out, true);
}

/* Writes the frames that Chromium printed. */
static iso_status take_frames(iso_context *ctx, FILE *from, const char *folder, size_t *taken)
{
    static const char start[] = "frame ", kind[] = "data:image/png;base64,";
    char *line = NULL;
    size_t room = 0;
    iso_status status = ISO_OK;
    while (status == ISO_OK && getline(&line, &room, from) >= 0) {
        char *at = strstr(line, start), *end;
        if (!at || at[strlen(start)] < '0' || at[strlen(start)] > '9') continue;
        const unsigned long number = strtoul(at + strlen(start), &end, 10);
        if (strncmp(end, " ", 1) != 0 || strncmp(end + 1, kind, strlen(kind)) != 0) continue;
        status = write_picture(ctx, folder, number, end + 1 + strlen(kind));
        *taken += status == ISO_OK;
    }
    free(line);
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

static iso_status draw(iso_context *ctx, const view_frames *f, const char *page, size_t all)
{
    char address[3 * PATH_MAX + 128];
    iso_status status = ISO_OK;
    for (size_t first = 0; status == ISO_OK && first < all; first += BATCH) {
        const size_t count = all - first < BATCH ? all - first : BATCH;
        size_t taken = 0;
        FILE *out = tmpfile();
        if (!out)
            return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot open a temporary file: %s", strerror(errno));
        address_of(page, first, count, all, address, sizeof address);
        status = run_chromium(ctx, address, out);
        if (status == ISO_OK) status = take_frames(ctx, out, f->folder, &taken);
        fclose(out);
        if (status == ISO_OK && taken < count)
            status = iso_context_fail(ctx, ISO_FILE_TROUBLE, "",
                                      "--frames: Chromium drew only %zu of the frames %zu to %zu", taken, first + 1,
                                      first + count);
        if (status == ISO_OK && interrupted()) status = iso_context_fail(ctx, ISO_STOPPED, "", "stopped on request");
        progress_show((double)(first + count) / (double)all);
    }
    return status;
}

iso_status view_write_frames(iso_context *ctx, const view_frames *f, const view_page *page)
{
    char folder[PATH_MAX], path[PATH_MAX + 32];
    const double all = ceil(f->fps * f->seconds);
    if (all > MOST_FRAMES)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "--frames: fps times seconds is %g pictures, more than %d",
                                all, MOST_FRAMES);
    if (mkdir(f->folder, 0777) != 0 && errno != EEXIST)
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot make the folder '%s': %s", f->folder,
                                strerror(errno));
    if (!realpath(f->folder, folder))
        return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "cannot open '%s': %s", f->folder, strerror(errno));
    snprintf(path, sizeof path, "%s/.isoroll-%ld.html", folder, (long)getpid());
    iso_status status = view_write(ctx, path, page);
    if (status != ISO_OK) return status;
    status = draw(ctx, f, path, (size_t)all);
    unlink(path);
    return status;
}

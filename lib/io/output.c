/* output.c - writes text files: into a file that gets its name when it is complete. */
#include "io/output_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/replacement_impl.h"

struct iso_output {
    FILE *file;
    const char *name;            /* what messages call it                              */
    char *direct;                /* the name of a file that is written as it is, or    */
    iso_replacement replacement; /* the one that takes an older file's place           */
    int error;                   /* errno of the first failed write: a later one may say less         */
};

static iso_status no_memory(iso_context *ctx)
{
    return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write a file");
}

static void release(iso_output *out)
{
    free(out->direct);
    free(out);
}

/* ---- Opening ---- */

/* Not to be renamed over: what is no regular file, and other names of a stream that is already open. */
static bool is_direct(const char *path, const struct stat *old)
{
    static const char *const open_streams[] = {"/dev/std", "/dev/fd/", "/proc/"};
    for (size_t i = 0; i < sizeof open_streams / sizeof *open_streams; i++)
        if (strncmp(path, open_streams[i], strlen(open_streams[i])) == 0) return true;
    return old && !S_ISREG(old->st_mode);
}

static iso_status open_regular(iso_context *ctx, iso_output *out, const char *path)
{
    int fd;
    ISO_TRY(iso_replacement_open(ctx, path, false, &out->replacement, &fd));
    out->name = out->replacement.target;
    out->file = fdopen(fd, "w");
    if (out->file) return ISO_OK;
    const iso_status status = iso_file_trouble(ctx, "write", path);
    iso_replacement_close(ctx, &out->replacement, fd, false);
    close(fd);
    return status;
}

static iso_status open_direct(iso_context *ctx, iso_output *out, const char *path)
{
    out->name = out->direct = strdup(path);
    if (!out->name) return no_memory(ctx);
    const int fd = open(path, O_WRONLY | O_APPEND | O_CLOEXEC);
    if (fd >= 0 && (out->file = fdopen(fd, "a"))) return ISO_OK;
    const iso_status status = iso_file_trouble(ctx, "write", path);
    if (fd >= 0) close(fd);
    return status;
}

iso_status iso_output_open(iso_context *ctx, const char *path, iso_output **answer)
{
    struct stat old;
    iso_status status = ISO_OK;
    *answer = NULL;
    iso_output *out = calloc(1, sizeof *out);
    if (!out) return no_memory(ctx);
    const struct stat *known = stat(path, &old) == 0 ? &old : NULL;
    if (strcmp(path, "-") == 0)
        out->file = stdout, out->name = "<stdout>";
    else
        status = is_direct(path, known) ? open_direct(ctx, out, path) : open_regular(ctx, out, path);
    if (status != ISO_OK) release(out), out = NULL;
    *answer = out;
    return status;
}

/* ---- Writing ---- */

FILE *iso_output_stream(iso_output *out)
{
    return out->file;
}

iso_status iso_output_copy(iso_context *ctx, iso_output *out, FILE *from)
{
    char block[1 << 14];
    if (fflush(from) == EOF || fseek(from, 0, SEEK_SET) != 0)
        return iso_file_trouble(ctx, "write", "a temporary file");
    for (size_t length; (length = fread(block, 1, sizeof block, from)) > 0;)
        if (fwrite(block, 1, length, out->file) < length) break;
    return ferror(from) ? iso_file_trouble(ctx, "read", "a temporary file") : iso_output_check(ctx, out);
}

const char *iso_output_name(const iso_output *out)
{
    return out->name;
}

void iso_output_keep_others(iso_output *out)
{
    out->replacement.fresh = true;
}

iso_status iso_output_check(iso_context *ctx, iso_output *out)
{
    if (!ferror(out->file)) return ISO_OK;
    if (out->error == 0) out->error = errno;
    errno = out->error;
    return iso_file_trouble(ctx, "write", out->name);
}

/* ---- Closing ---- */

static iso_status flush(iso_context *ctx, iso_output *out)
{
    ISO_TRY(iso_output_check(ctx, out));
    return fflush(out->file) == 0 ? ISO_OK : iso_file_trouble(ctx, "write", out->name);
}

static iso_status close_regular(iso_context *ctx, iso_output *out, bool keep)
{
    const iso_status flushed = keep ? flush(ctx, out) : ISO_OK;
    const iso_status status =
        iso_replacement_close(ctx, &out->replacement, fileno(out->file), keep && flushed == ISO_OK);
    fclose(out->file); /* already on the disk, or not wanted */
    return flushed != ISO_OK ? flushed : status;
}

static iso_status close_direct(iso_context *ctx, iso_output *out)
{
    const iso_status status = flush(ctx, out);
    if (out->file == stdout || fclose(out->file) == 0 || status != ISO_OK) return status;
    return iso_file_trouble(ctx, "write", out->name);
}

iso_status iso_output_close(iso_context *ctx, iso_output *out, bool keep)
{
    if (!out) return ISO_OK;
    const iso_status status = out->replacement.temporary ? close_regular(ctx, out, keep) : close_direct(ctx, out);
    release(out);
    return status;
}

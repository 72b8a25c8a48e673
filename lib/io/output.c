/* output.c - writes text files. */
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
    char *direct;                /* the name of a file that is written as it is, or    */
    iso_replacement replacement; /* the one that takes an older file's place           */
    int error;                   /* errno of the first failed write: a later one may say less         */
};

/* ---- Opening ---- */

/* Not to be renamed over: what is no regular file, and other names of a stream that is already open. */
static bool is_direct(const char *path)
{
    struct stat old;
    if (stat(path, &old) == 0 && !S_ISREG(old.st_mode)) return true;
    char *end = iso_file_follow(path);
    const bool stream = end && iso_file_is_stream(end);
    free(end);
    return stream;
}

static iso_status open_file(iso_context *ctx, iso_output *out, const char *path, bool stays)
{
    int fd;
    if (!stays && is_direct(path)) {
        out->direct = strdup(path);
        fd = out->direct ? open(path, O_WRONLY | O_APPEND | O_CLOEXEC) : -1;
    } else {
        ISO_TRY(iso_replacement_open(ctx, path, stays, &out->replacement, &fd));
    }
    if (fd >= 0) out->file = fdopen(fd, out->direct ? "a" : "w");
    if (out->file) return ISO_OK;
    const iso_status status = iso_file_trouble(ctx, "write", path);
    if (out->replacement.target) iso_replacement_close(ctx, &out->replacement, fd, false);
    if (fd >= 0) close(fd);
    free(out->direct);
    return status;
}

static iso_status open_output(iso_context *ctx, const char *path, bool stays, iso_output **answer)
{
    iso_status status = ISO_OK;
    iso_output *out = calloc(1, sizeof *out);
    if (!out)
        status = iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory to write a file");
    else if (strcmp(path, "-") == 0)
        out->file = stdout;
    else
        status = open_file(ctx, out, path, stays);
    if (status != ISO_OK) free(out), out = NULL;
    *answer = out;
    return status;
}

iso_status iso_output_open(iso_context *ctx, const char *path, iso_output **out)
{
    return open_output(ctx, path, false, out);
}

iso_status iso_output_resume(iso_context *ctx, const char *path, iso_output **out)
{
    return open_output(ctx, path, true, out);
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
    const iso_replacement *r = &out->replacement;
    if (r->target) return r->stays ? r->temporary : r->target;
    return out->direct ? out->direct : "<stdout>";
}

void iso_output_keep_others(iso_output *out)
{
    out->replacement.fresh = true;
}

static iso_status trouble(iso_context *ctx, const iso_output *out)
{
    return iso_file_trouble(ctx, "write", iso_output_name(out));
}

iso_status iso_output_check(iso_context *ctx, iso_output *out)
{
    if (!ferror(out->file)) return ISO_OK;
    if (out->error == 0) out->error = errno;
    errno = out->error;
    return trouble(ctx, out);
}

iso_status iso_output_cut(iso_context *ctx, iso_output *out, size_t length)
{
    if (ftruncate(fileno(out->file), (off_t)length) == 0 && fseek(out->file, 0, SEEK_END) == 0) return ISO_OK;
    return trouble(ctx, out);
}

iso_status iso_output_close(iso_context *ctx, iso_output *out, bool keep)
{
    if (!out) return ISO_OK;
    const bool regular = out->replacement.target != NULL, wanted = keep || !regular;
    iso_status status = wanted ? iso_output_check(ctx, out) : ISO_OK;
    if (wanted && status == ISO_OK && fflush(out->file) != 0) status = trouble(ctx, out);
    if (regular) {
        const iso_status closed =
            iso_replacement_close(ctx, &out->replacement, fileno(out->file), keep && status == ISO_OK);
        if (status == ISO_OK) status = closed;
    }
    if (out->file != stdout && fclose(out->file) != 0 && !regular && status == ISO_OK) status = trouble(ctx, out);
    free(out->direct);
    free(out);
    return status;
}

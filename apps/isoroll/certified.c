/* certified.c - files of enclosures (certified.h). */
#include "certified.h"

#include "progress.h"

iso_status certified_line(void *data, const char *text)
{
    certified_file *f = data;
    if (!f->out) {
        stop_gently();
        progress_begin_rows(f->path);
        ISO_TRY(iso_output_open(f->ctx, f->path, &f->out));
    }
    fputs(text, iso_output_stream(f->out));
    return iso_output_check(f->ctx, f->out);
}

void certified_progress(void *data, double part)
{
    (void)data;
    progress_show(part);
}

int certified_close(const certified_file *f, iso_status status, bool keep)
{
    const int result = finish(f->ctx, status);
    const iso_status closed = iso_output_close(f->ctx, f->out, keep);
    return closed != ISO_OK && result == EXIT_DONE ? finish(f->ctx, closed) : result;
}

iso_status certified_refuse(iso_context *ctx, const certified_option list[], const char *why)
{
    for (int i = 0; list[i].name; i++)
        if (list[i].given) return ISO_FAIL_ARGUMENT(ctx, list[i].name, "--%s: %s", list[i].name, why);
    return ISO_OK;
}

/* stream.c - rows of a study that go to a file as soon as they are found (see stream.h). */
#include "stream.h"

#include "progress.h"

iso_status stream_header(void *data, int table, const iso_record *header)
{
    stream *s = data;
    if (table > 0) return ISO_OK;
    s->opened = true;
    stop_gently();
    progress_begin_rows(s->output);
    const iso_status status = iso_table_writer_open(s->ctx, s->output, s->kind, &s->writer);
    return status == ISO_OK ? iso_table_write_header(s->ctx, s->writer, header) : status;
}

iso_status stream_row(void *data, int table, const double row[], size_t count)
{
    const stream *s = data;
    (void)count;
    return table > 0 ? ISO_OK : iso_table_write_row(s->ctx, s->writer, row);
}

static void show_note(void *data, const char *text)
{
    if (!((const stream *)data)->quiet) complain("%s", text);
}

iso_sink stream_sink(stream *s)
{
    return (iso_sink){stream_header, stream_row, show_note, progress_told, s};
}

int stream_close(stream *s, iso_status status, bool keep)
{
    const int result = finish(s->ctx, status);
    if (!s->writer) return result;
    const iso_status closed = iso_table_writer_close(s->ctx, s->writer, keep);
    return closed != ISO_OK && result == EXIT_DONE ? finish(s->ctx, closed) : result;
}

/* stream.c - rows of a file, and rows that go to a file (see stream.h). */
#include "stream.h"

#include "progress.h"

iso_status stream_next(iso_context *ctx, void *reader, iso_source_row *row)
{
    const iso_status status = iso_table_next(ctx, reader, row->number, &row->more);
    const iso_table_place *at = iso_table_at(reader);
    row->line = at->line;
    row->orbits = at->orbits;
    row->orbit = at->orbit;
    row->begins_orbit = at->begins_orbit;
    row->passed = at->passed;
    row->ignored = at->ignored;
    return status;
}

iso_status stream_header(void *data, int table, const iso_record *header)
{
    stream *s = data;
    if (table > 0) return ISO_OK;
    s->opened = true;
    stop_gently();
    progress_begin_rows(s->output);
    ISO_TRY(iso_table_writer_open(s->ctx, s->output, s->kind, &s->writer));
    if (s->digits) iso_table_set_digits(s->writer, *s->digits);
    return iso_table_write_header(s->ctx, s->writer, header);
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

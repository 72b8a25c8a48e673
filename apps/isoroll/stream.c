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

static void begin(stream *s)
{
    s->opened = true;
    stop_gently();
    progress_begin_rows(s->output);
}

iso_status stream_header(void *data, int table, const iso_record *header)
{
    stream *s = data;
    if (table > 0) return ISO_OK;
    begin(s);
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

iso_status stream_line(void *data, const char *text)
{
    stream *s = data;
    if (!s->opened) {
        begin(s);
        ISO_TRY(iso_output_open(s->ctx, s->output, &s->out));
    }
    fputs(text, iso_output_stream(s->out));
    return iso_output_check(s->ctx, s->out);
}

static void show_note(void *data, const char *text)
{
    if (!((const stream *)data)->quiet) complain("%s", text);
}

iso_sink stream_sink(stream *s)
{
    return (iso_sink){stream_header, stream_row, show_note, progress_sink, s};
}

int stream_close(stream *s, iso_status status, bool keep)
{
    const int result = finish(s->ctx, status);
    if (!s->writer && !s->out) return result;
    const iso_status closed =
        s->writer ? iso_table_writer_close(s->ctx, s->writer, keep) : iso_output_close(s->ctx, s->out, keep);
    return closed != ISO_OK && result == EXIT_DONE ? finish(s->ctx, closed) : result;
}

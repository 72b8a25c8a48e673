/* stream.c - rows of a file, and rows that go to a file (see stream.h). */
#include "stream.h"

#include <string.h>

#include "base/number_impl.h"
#include "io/text_impl.h"
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
    if (!((const stream *)data)->quiet) warn("%s", text);
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

/* --- output times: numbers between blanks, commas, new lines and comments -------------------------------------- */

/* Where in a file, from 1, columns in characters. */
typedef struct place {
    int line, column;
} place;

enum { WORD = 512 }; /* as long as a number can be (iso_number_read) */

/* The next number of the file into word, with the place where it begins; its length, 0 at the end. Between them are
 * blanks, commas, new lines, and comments, which begin with #. */
static size_t next_word(FILE *file, char word[WORD], place *at)
{
    size_t length = 0;
    bool comment = false;
    for (int c; length < WORD - 1 && (c = getc(file)) != EOF;) {
        comment = c != '\n' && (comment || c == '#');
        if (c != '\0' && strchr(" \t,\r\n#", c)) {
            if (length > 0) {
                ungetc(c, file);
                break;
            }
        } else if (!comment) {
            word[length++] = (char)c;
            continue;
        }
        at->column = c == '\n' ? 1 : at->column + ((c & 0xC0) != 0x80);
        at->line += c == '\n';
    }
    word[length] = '\0';
    return length;
}

static iso_status read_words(iso_context *ctx, const char *name, FILE *file, iso_record *times)
{
    char word[WORD];
    place at = {1, 1};
    size_t length;
    double time;
    while ((length = next_word(file, word, &at)) > 0) {
        if (!iso_number_read(word, length, &time))
            return ISO_FAIL_INPUT(ctx, "", "%s:%d:%d: '%.40s' is not a time: expected a finite number", name, at.line,
                                  at.column, word);
        ISO_TRY(iso_record_add(ctx, times, 1, &time));
        at.column += (int)length;
    }
    if (ferror(file)) return iso_file_trouble(ctx, "read", name);
    if (iso_record_rows(times) > 0) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "", "%s:1:1: no times in this file: expected numbers", name);
}

iso_status times_read(iso_context *ctx, const char *path, iso_record **times)
{
    ISO_TRY(iso_record_create(ctx, 1, (const char *[]){"time"}, times));
    FILE *file = iso_text_open(ctx, path);
    if (!file) return ISO_FILE_TROUBLE;
    const iso_status status = read_words(ctx, iso_text_name(path), file, *times);
    iso_text_close(file);
    return status;
}

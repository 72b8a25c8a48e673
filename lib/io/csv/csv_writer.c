/* csv_writer.c - writes tables as text. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/number_impl.h"
#include "io/output_impl.h"
#include "io/table_impl.h"
#include "io/text_impl.h"

#define PATIENCE 0.1 /* seconds: rows that come slowly are not held back longer, so that a reader sees them */

typedef struct csv {
    iso_output *out;
    bool seen;    /* the file is a terminal: each row is shown at once     */
    char *text;   /* room for a row                                        */
    double shown; /* when all rows were last written, in seconds           */
    bool headed;  /* the file that is gone on with has its header          */
} csv;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The lines of a text are lines of #, each with the key. */
static void print_line(FILE *to, const char *key, const char *value)
{
    const bool plain = strcmp(key, ISO_TABLE_TEXT) == 0;
    if (!strchr(value, '\n')) fprintf(to, *value ? "# %s: %s\n" : "# %s:\n", key, value);
    for (const char *at = strchr(value, '\n') ? value : ""; *at;) {
        const size_t length = strcspn(at, "\r\n");
        fprintf(to, "# %s%s| %.*s\n", plain ? "" : key, plain ? "" : " ", (int)length, at);
        at += length;
        if (*at == '\r') at++;
        if (*at == '\n') at++;
    }
}

static iso_status csv_open(iso_context *ctx, iso_table_writer *w, const char *path)
{
    csv *c = w->data = calloc(1, sizeof *c);
    if (!c) return iso_text_no_memory(ctx, "write", path);
    const iso_status status =
        w->resumes ? iso_output_open_regular(ctx, path, true, &c->out) : iso_output_open(ctx, path, &c->out);
    if (status != ISO_OK) return free(c), status;
    w->name = iso_output_name(c->out);
    c->shown = now();
    c->seen = isatty(fileno(iso_output_stream(c->out))) == 1;
    return ISO_OK;
}

static iso_status csv_cut(iso_context *ctx, iso_table_writer *w, size_t length)
{
    csv *c = w->data;
    c->headed = length > 0;
    return iso_output_cut(ctx, c->out, length);
}

static iso_status csv_flush(iso_context *ctx, iso_table_writer *w)
{
    csv *c = w->data;
    fflush(iso_output_stream(c->out));
    return iso_output_check(ctx, c->out);
}

static iso_status csv_line(iso_context *ctx, iso_table_writer *w, const char *key, const char *value)
{
    csv *c = w->data;
    print_line(iso_output_stream(c->out), key, value);
    return iso_output_check(ctx, c->out);
}

static void print_header(FILE *to, const iso_table_writer *w, const iso_record *header)
{
    const char *key, *value;
    const size_t columns = iso_record_columns(header);
    fprintf(to, "# isoroll %s 1\n", w->kind);
    for (size_t i = 0; iso_record_line(header, i, &key, &value); i++) print_line(to, key, value);
    if (w->words) fputs("# " ISO_WORDS_KEY ":", to);
    for (size_t i = 0; w->words && i < columns; i++)
        if (iso_record_has_words(header, i)) fprintf(to, " %s", iso_record_name(header, i));
    if (w->words) putc('\n', to);
    for (size_t i = 0; i < columns; i++)
        fprintf(to, "%s%c", iso_record_name(header, i), i + 1 < columns ? ',' : '\n');
}

static iso_status csv_header(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    csv *c = w->data;
    if (!c->headed) print_header(iso_output_stream(c->out), w, header);
    c->text = malloc(iso_record_columns(header) * ISO_NUMBER_SIZE);
    return c->text ? iso_output_check(ctx, c->out) : iso_context_no_memory(ctx, "rows of '%s'", w->name);
}

/* In quotes where it would not read back without. */
static void print_word(FILE *to, const char *word, bool plain, bool alone)
{
    const bool quoted = strpbrk(word, plain ? ",\"\r\n" : ", \"\r\n") || *word == '#' || (alone && !*word);
    if (quoted) putc('"', to);
    for (; *word; word++) fprintf(to, quoted && *word == '"' ? "\"%c" : "%c", *word);
    if (quoted) putc('"', to);
}

/* Numbers are gathered in the text of the row, which goes ahead of a word. */
static iso_status csv_row(iso_context *ctx, iso_table_writer *w, const double row[])
{
    csv *c = w->data;
    FILE *const to = iso_output_stream(c->out);
    const iso_record *r = w->words ? w->words : w->header;
    const size_t columns = iso_record_columns(r);
    char *end = c->text;
    for (size_t i = 0; i < columns; i++) {
        const iso_column_format *format = iso_record_format(r, i);
        if (iso_record_has_words(r, i)) {
            fwrite(c->text, 1, (size_t)(end - c->text), to);
            end = c->text;
            print_word(to, iso_record_word(r, row[i]), format->plain, columns == 1);
        } else if (isnan(row[i]) && !format->empty) {
            memcpy(end, "nan", 3), end += 3;
        } else if (isfinite(row[i]) || !format->empty) {
            end += iso_number_print_as(end, row[i], format->digits ? format->digits : w->digits);
        }
        *end++ = i + 1 < columns ? ',' : '\n';
    }
    fwrite(c->text, 1, (size_t)(end - c->text), to);
    const double time = now();
    if (c->seen || time - c->shown > PATIENCE) fflush(to), c->shown = time;
    return iso_output_check(ctx, c->out);
}

static iso_status csv_close(iso_context *ctx, iso_table_writer *w, bool keep)
{
    csv *c = w->data;
    if (w->fresh) iso_output_keep_others(c->out);
    const iso_status status = iso_output_close(ctx, c->out, keep);
    free(c->text);
    free(c);
    return status;
}

const iso_table_writing iso_csv_writing = {csv_open, csv_header, csv_row, csv_line, csv_flush, csv_cut, csv_close};

/* csv_writer.c - writes tables as text: into a temporary file, which is renamed when it is complete.
 *
 * Rows are collected in blocks. A few threads print them, and the caller writes the text of one block after the
 * other. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/number_impl.h"
#include "io/output_impl.h"
#include "io/table_impl.h"
#include "io/tasks_impl.h"
#include "io/text_impl.h"

/* Rows of a block. A block holds LEAST rows at first, later a quarter of the rows before it, at most MOST. */
enum { BLOCKS = 8, LEAST = 32, MOST = 512 };

#define PATIENCE 0.1 /* seconds: rows that come slowly are not held back longer, so that a reader sees them */

typedef struct block {
    iso_task task;
    size_t columns, rows;
    int digits;
    double *row;
    char *text;
    size_t length;
} block;

typedef struct csv {
    iso_output *out;
    iso_tasks *tasks;
    bool seen;   /* the file is a terminal: each row is shown at once */
    bool styled; /* some column has words, or a format of its own */
    block block[BLOCKS];
    int first, count; /* blocks that are printed, or wait for it; the one behind them is being filled */
    size_t rows;      /* given to blocks so far */
    double shown;     /* when all rows were last written, in seconds */
} csv;

/* --- blocks ----------------------------------------------------------------------------------------------------- */

static void print_block(void *data)
{
    block *b = data;
    char *end = b->text;
    for (size_t i = 0; i < b->rows * b->columns; i++) {
        if (isnan(b->row[i]))
            memcpy(end, "nan", 3), end += 3;
        else
            end += iso_number_print_as(end, b->row[i], b->digits);
        *end++ = (i + 1) % b->columns > 0 ? ',' : '\n';
    }
    b->length = (size_t)(end - b->text);
}

/* Room for the rows of the block that is being filled. */
static bool has_room(block *b, size_t columns)
{
    if (b->row && b->text) return true;
    b->task = (iso_task){.work = print_block, .data = b};
    b->columns = columns;
    if (!b->row) b->row = malloc(MOST * columns * sizeof *b->row);
    if (!b->text) b->text = malloc(MOST * columns * ISO_NUMBER_SIZE);
    return b->row && b->text;
}

/* Writes the first block. */
static void write_block(csv *c)
{
    block *b = &c->block[c->first];
    iso_tasks_finish(c->tasks, &b->task);
    fwrite(b->text, 1, b->length, iso_output_stream(c->out));
    b->rows = 0;
    c->first = (c->first + 1) % BLOCKS;
    c->count--;
}

/* Writes what is printed; with `all`, all rows. */
static void write_blocks(csv *c, bool all)
{
    block *filled = &c->block[(c->first + c->count) % BLOCKS];
    const int most = all ? 0 : iso_tasks_size(c->tasks) > 0 ? 2 * iso_tasks_size(c->tasks) : 0;
    if (filled->rows > 0) iso_tasks_give(c->tasks, &filled->task), c->count++;
    while (c->count > most || (c->count > 0 && iso_tasks_is_done(c->tasks, &c->block[c->first].task))) write_block(c);
}

/* Whether the block is full. */
static bool is_full(const csv *c, const block *b)
{
    const size_t quarter = (c->rows - b->rows) / 4;
    return c->seen || b->rows >= (quarter < LEAST ? LEAST : quarter > MOST ? MOST : quarter);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Writes all rows, if the last time is long ago. */
static void show_soon(csv *c)
{
    const double time = now();
    if (time - c->shown < PATIENCE) return;
    write_blocks(c, true);
    fflush(iso_output_stream(c->out));
    c->shown = time;
}

/* Rows must stand before what is written next. */
static FILE *stream_behind_rows(csv *c)
{
    write_blocks(c, true);
    return iso_output_stream(c->out);
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* Each line of a text as a comment. */
static void write_text(FILE *to, const char *key, const char *text)
{
    const bool plain = strcmp(key, ISO_TABLE_TEXT) == 0;
    while (*text) {
        const size_t length = strcspn(text, "\r\n");
        fprintf(to, "# %s%s| %.*s\n", plain ? "" : key, plain ? "" : " ", (int)length, text);
        text += length;
        if (*text == '\r') text++;
        if (*text == '\n') text++;
    }
}

static void write_line(FILE *to, const char *key, const char *value)
{
    if (strchr(value, '\n'))
        write_text(to, key, value);
    else
        fprintf(to, *value ? "# %s: %s\n" : "# %s:\n", key, value);
}

/* --- the file --------------------------------------------------------------------------------------------------- */

static iso_status csv_open(iso_context *ctx, iso_table_writer *w, const char *path)
{
    csv *c = w->data = calloc(1, sizeof *c);
    if (c) c->tasks = iso_tasks_create();
    if (!c || !c->tasks) return free(c), iso_text_no_memory(ctx, "write", path);
    const iso_status status = iso_output_open(ctx, path, &c->out);
    if (status != ISO_OK) return iso_tasks_free(c->tasks), free(c), status;
    w->name = iso_output_name(c->out);
    c->shown = now();
    c->seen = isatty(fileno(iso_output_stream(c->out))) == 1;
    return ISO_OK;
}

static iso_status csv_line(iso_context *ctx, iso_table_writer *w, const char *key, const char *value)
{
    csv *c = w->data;
    FILE *to = stream_behind_rows(c);
    write_line(to, key, value);
    return iso_output_check(ctx, c->out);
}

static iso_status csv_header(iso_context *ctx, iso_table_writer *w, const iso_record *header)
{
    csv *c = w->data;
    FILE *const to = iso_output_stream(c->out);
    const char *key, *value;
    const size_t columns = iso_record_columns(header);
    fprintf(to, "# isoroll %s 1\n", w->kind);
    for (size_t i = 0; iso_record_line(header, i, &key, &value); i++) write_line(to, key, value);
    for (size_t i = 0; i < columns; i++) {
        const iso_column_format *format = iso_record_format(header, i);
        c->styled = c->styled || iso_record_has_words(header, i) || format->digits || format->empty;
        fprintf(to, "%s%c", iso_record_name(header, i), i + 1 < columns ? ',' : '\n');
    }
    return iso_output_check(ctx, c->out);
}

/* In quotes where it would not read back without. */
static void print_word(FILE *to, const char *word, bool plain, bool alone)
{
    const bool quoted = strpbrk(word, plain ? ",\"\r\n" : ", \"\r\n") || *word == '#' || (alone && !*word);
    if (quoted) putc('"', to);
    for (; *word; word++) fprintf(to, quoted && *word == '"' ? "\"%c" : "%c", *word);
    if (quoted) putc('"', to);
}

static void print_cell(FILE *to, const iso_record *r, size_t column, double value, int digits)
{
    char text[ISO_NUMBER_SIZE] = "nan";
    const iso_column_format *format = iso_record_format(r, column);
    if (iso_record_has_words(r, column)) {
        print_word(to, iso_record_word(r, value), format->plain, iso_record_columns(r) == 1);
        return;
    }
    if (!isfinite(value) && format->empty) return;
    if (!isnan(value)) iso_number_print_as(text, value, format->digits ? format->digits : digits);
    fputs(text, to);
}

/* Rows with words, or with formats, are written as they come. */
static void write_styled(const iso_table_writer *w, FILE *to, const double row[])
{
    const size_t columns = iso_record_columns(w->header);
    for (size_t i = 0; i < columns; i++) {
        print_cell(to, w->words ? w->words : w->header, i, row[i], w->digits);
        putc(i + 1 < columns ? ',' : '\n', to);
    }
}

static iso_status csv_row(iso_context *ctx, iso_table_writer *w, const double row[])
{
    csv *c = w->data;
    if (c->styled) {
        write_styled(w, iso_output_stream(c->out), row);
        return iso_output_check(ctx, c->out);
    }
    block *b = &c->block[(c->first + c->count) % BLOCKS];
    const size_t columns = iso_record_columns(w->header);
    if (!has_room(b, columns)) return iso_context_no_memory(ctx, "rows of '%s'", w->name);
    b->digits = w->digits;
    memcpy(b->row + b->rows++ * columns, row, columns * sizeof *row);
    c->rows++;
    if (is_full(c, b)) write_blocks(c, c->seen);
    show_soon(c);
    return iso_output_check(ctx, c->out);
}

static iso_status csv_close(iso_context *ctx, iso_table_writer *w, bool keep)
{
    csv *c = w->data;
    stream_behind_rows(c);
    if (w->fresh) iso_output_keep_others(c->out);
    const iso_status status = iso_output_close(ctx, c->out, keep);
    iso_tasks_free(c->tasks);
    for (int i = 0; i < BLOCKS; i++) free(c->block[i].row), free(c->block[i].text);
    free(c);
    return status;
}

const iso_table_writing iso_csv_writing = {csv_open, csv_header, csv_row, csv_line, csv_close};

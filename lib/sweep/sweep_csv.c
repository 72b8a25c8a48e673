/* sweep_csv.c - results of sweeps as CSV: lines "# key: value", one header line, one row for each point, "# sum:
 * SUM". */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/version.h"
#include "io/output.h"
#include "sweep/sweep_store_impl.h"

/* --- writing ---------------------------------------------------------------------------------------------------- */

/* Points that a part has are not one after the other. */
typedef struct csv_writer {
    iso_output *out;
} csv_writer;

/* A text, each line as a comment. */
static void write_text(FILE *to, const char *mark, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\r\n");
        fprintf(to, "# %s| %.*s\n", mark, (int)length, text);
        text += length;
        if (*text == '\r') text++;
        if (*text == '\n') text++;
    }
}

static iso_status write_head(iso_context *ctx, FILE *to, const iso_sweep_head *head, iso_sweep_shard share)
{
    char hash[ISO_HASH_SIZE], *columns = iso_sweep_columns_print(head);
    if (!columns) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    const bool all = iso_sweep_shard_is_all(share);
    iso_sweep_hash_print(hash, head->hash);
    fprintf(to, "# %s\n# isoroll: %s\n# hash: %s\n", all ? ISO_SWEEP_FORMAT : ISO_SWEEP_PART_FORMAT, ISO_VERSION,
            hash);
    fprintf(to, "# points: %zu\n# chunk: %zu\n# vectors: %s\n", head->count, head->chunk, head->vectors);
    if (!all) fprintf(to, "# part: %zu of %zu\n", share.index + 1, share.count);
    fprintf(to, "# columns: %s\n", columns);
    write_text(to, "", head->text);
    if (head->scene) write_text(to, "scene ", head->scene);
    fputs("point", to);
    for (int i = 0; i < head->columns; i++) {
        const iso_sweep_column *c = &head->column[i];
        const bool vary = strcmp(c->group, "vary") == 0;
        fprintf(to, ",%s%s%s", vary ? "" : c->group, vary ? "" : "_", c->name);
    }
    fputs(",status,reason\n", to);
    free(columns);
    return ISO_OK;
}

static iso_status csv_create(iso_context *ctx, const char *path, const iso_sweep_head *head, iso_sweep_shard share,
                             void **file)
{
    csv_writer *w = *file = calloc(1, sizeof *w);
    if (!w) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a sweep");
    iso_status status = iso_output_open(ctx, path, &w->out);
    if (status == ISO_OK) iso_output_keep_others(w->out);
    if (status == ISO_OK) status = write_head(ctx, iso_output_stream(w->out), head, share);
    if (status == ISO_OK) return ISO_OK;
    iso_output_close(ctx, w->out, false);
    free(w);
    return status;
}

static iso_status csv_rows(iso_context *ctx, void *file, const iso_sweep_rows *rows)
{
    csv_writer *w = file;
    FILE *to = iso_output_stream(w->out);
    for (size_t i = 0; i < rows->count; i++) {
        const double *row = rows->number + i * (size_t)rows->columns;
        fprintf(to, "%zu", rows->first + i);
        for (int c = 0; c < rows->columns; c++) {
            char text[ISO_NUMBER_SIZE];
            if (row[c] == row[c])
                iso_number_print(text, row[c]);
            else
                strcpy(text, "nan");
            fprintf(to, ",%s", text);
        }
        const bool failed = rows->status[i] != ISO_OK;
        fprintf(to, ",%d,%s%s%s\n", (int)rows->status[i], failed ? "\"" : "", failed ? rows->reason[i] : "",
                failed ? "\"" : "");
    }
    return iso_output_check(ctx, w->out);
}

static iso_status csv_close(iso_context *ctx, void *file, const uint64_t *sum)
{
    csv_writer *w = file;
    if (sum) fprintf(iso_output_stream(w->out), "# sum: %016" PRIx64 "\n", *sum);
    const iso_status status = iso_output_close(ctx, w->out, sum != NULL);
    free(w);
    return status;
}

const iso_sweep_writing iso_sweep_csv_writing = {csv_create, csv_rows, csv_close};

/* --- reading ---------------------------------------------------------------------------------------------------- */

typedef struct csv_reader {
    FILE *from;
    const iso_sweep_begin *begin;
    char *line, *path;
    size_t room, done; /* done: rows that were read */
} csv_reader;

/* The value of a line "# key: value"; NULL: it is another line. */
static const char *value_of(const char *line, const char *key)
{
    const size_t length = strlen(key);
    if (strncmp(line, "# ", 2) != 0 || strncmp(line + 2, key, length) != 0 || line[2 + length] != ':') return NULL;
    return line + length + 4;
}

/* The next line without its line end (LF or CR LF); false: there is none. */
static bool next_line(csv_reader *r)
{
    ssize_t length = getline(&r->line, &r->room, r->from);
    if (length <= 0) return false;
    if (r->line[length - 1] == '\n') length--;
    if (length > 0 && r->line[length - 1] == '\r') length--;
    r->line[length] = '\0';
    return true;
}

/* Adds a line to a text. */
static bool add_text(char **text, const char *line)
{
    const size_t before = *text ? strlen(*text) : 0;
    char *more = realloc(*text, before + strlen(line) + 2);
    if (!more) return false;
    *text = more;
    sprintf(more + before, "%s\n", line);
    return true;
}

/* One line of the head. False: a value makes no sense. */
static bool take_line(iso_sweep_begin *b, const char *line)
{
    const char *value;
    if (strncmp(line, "# | ", 4) == 0) return add_text(&b->text, line + 4);
    if (strncmp(line, "# scene | ", 10) == 0) return add_text(&b->scene, line + 10);
    if ((value = value_of(line, "hash"))) return iso_sweep_hash_scan(value, b->head.hash);
    if ((value = value_of(line, "points"))) return sscanf(value, "%zu", &b->head.count) == 1;
    if ((value = value_of(line, "chunk"))) return sscanf(value, "%zu", &b->head.chunk) == 1;
    if ((value = value_of(line, "vectors")))
        return snprintf(b->head.vectors, sizeof b->head.vectors, "%s", value) < ISO_NAME_SIZE;
    if ((value = value_of(line, "columns"))) {
        free(b->column);
        return (b->column = iso_sweep_columns_scan(value, &b->head.columns)) != NULL;
    }
    if (!(value = value_of(line, "part"))) return true;
    return sscanf(value, "%zu of %zu", &b->share.index, &b->share.count) == 2 && b->share.index-- > 0;
}

static bool read_head(csv_reader *r, iso_sweep_begin *b)
{
    b->share.count = 1;
    if (!next_line(r)) return false;
    const bool part = strcmp(r->line, "# " ISO_SWEEP_PART_FORMAT) == 0;
    if (!part && strcmp(r->line, "# " ISO_SWEEP_FORMAT) != 0) return false;
    while (next_line(r)) {
        if (r->line[0] != '#') return strncmp(r->line, "point,", 6) == 0 && part == (b->share.count > 1);
        if (!take_line(b, r->line)) return false;
    }
    return false;
}

static void csv_end(void *file)
{
    csv_reader *r = file;
    if (r->from) fclose(r->from);
    free(r->line);
    free(r->path);
    free(r);
}

static iso_status csv_open(iso_context *ctx, const char *path, iso_sweep_begin *begin, void **file)
{
    csv_reader *r = calloc(1, sizeof *r);
    if (!r || !(r->path = strdup(path))) {
        free(r);
        return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for '%s'", path);
    }
    r->from = fopen(path, "re");
    r->begin = begin;
    if (r->from && read_head(r, begin)) return *file = r, ISO_OK;
    csv_end(r);
    return iso_sweep_damaged(ctx, path, "it is no result of a sweep");
}

/* One cell; *at moves behind its comma. */
static bool read_cell(const char **at, double *x)
{
    const size_t length = strcspn(*at, ",");
    const char *cell = *at;
    if (cell[length] != ',') return false;
    *at += length + 1;
    if (length == 3 && memcmp(cell, "nan", 3) == 0) return *x = NAN, true;
    if (length == 3 && memcmp(cell, "inf", 3) == 0) return *x = INFINITY, true;
    if (length == 4 && memcmp(cell, "-inf", 4) == 0) return *x = -INFINITY, true;
    return iso_number_read(cell, length, x);
}

/* A row that says another number than that of its place has been moved. A row that was cut short has no status, or
 * its reason no end. */
static bool read_row(const csv_reader *r, iso_sweep_rows *rows, size_t i)
{
    double point, status;
    const char *at = r->line;
    if (!read_cell(&at, &point) || point != (double)iso_sweep_shard_point(&r->begin->head, r->begin->share, r->done))
        return false;
    for (int c = 0; c < rows->columns; c++)
        if (!read_cell(&at, &rows->number[i * (size_t)rows->columns + (size_t)c])) return false;
    if (!read_cell(&at, &status)) return false;
    rows->status[i] = (iso_status)status;
    rows->reason[i][0] = '\0';
    const size_t length = strlen(at);
    if (rows->status[i] == ISO_OK) return length == 0;
    if (length < 2 || length - 2 >= ISO_REASON_SIZE || at[0] != '"' || at[length - 1] != '"') return false;
    memcpy(rows->reason[i], at + 1, length - 2);
    rows->reason[i][length - 2] = '\0';
    return true;
}

static iso_status csv_next(iso_context *ctx, void *file, size_t count, iso_sweep_rows *rows)
{
    csv_reader *r = file;
    for (size_t i = 0; i < count; i++, r->done++)
        if (!next_line(r) || !read_row(r, rows, i))
            return iso_sweep_damaged(ctx, r->path, "a row is missing, moved or damaged");
    return ISO_OK;
}

static bool csv_sum(void *file, uint64_t *sum)
{
    csv_reader *r = file;
    const char *value = next_line(r) ? value_of(r->line, "sum") : NULL;
    return value && strlen(value) == 16 && sscanf(value, "%16" SCNx64, sum) == 1 && fgetc(r->from) == EOF;
}

const iso_sweep_reading iso_sweep_csv_reading = {csv_open, csv_next, csv_sum, csv_end};

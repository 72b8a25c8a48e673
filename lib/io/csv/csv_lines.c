/* csv_lines.c - the lines of a text file, read in blocks of whole lines.
 *
 * Each block is read by one call of read() and given to a few threads, which read the rows in it. The caller
 * takes the lines in their order. Lines that are not plain rows (#, empty, wrong) are left to the caller, which
 * alone writes messages. A block is read ahead only if read() would not wait, so a row from a slow pipe is passed
 * on at once. */
#define _GNU_SOURCE /* memrchr */
#include <errno.h>
#include <poll.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/context_impl.h"
#include "io/csv/csv_impl.h"
#include "io/replacement_impl.h"
#include "io/tasks_impl.h"
#include "io/text_impl.h"

enum { BLOCKS = 8, MOST_ROWS = 4096 }; /* MOST_ROWS: lines of a block that are read ahead */

typedef struct block {
    iso_task task;
    const iso_csv_format *format;
    char *text; /* room + 1 characters */
    size_t room;
    size_t length, at;  /* of whole lines; start of the first line that was not read ahead */
    bool too_long;      /* it is a part of one line                                          */
    size_t known, next; /* lines that were read ahead; the next of these to be taken        */
    uint32_t begin[MOST_ROWS], size[MOST_ROWS]; /* size: with '\r' */
    bool good[MOST_ROWS];
    double *row, *next_row; /* room for all numbers that a block can have; of the next good line */
} block;

struct iso_csv_lines {
    FILE *file;
    const char *name;
    bool ready, ended; /* ready: a regular file, which never lets one wait */
    int error;         /* errno of read(): told behind the lines before it */
    iso_tasks *tasks;
    const iso_csv_format *format; /* without columns: rows are not yet read ahead */
    block *ring[BLOCKS];
    int first, count; /* blocks that hold lines: count from first on */
    char *tail;       /* the beginning of the next block             */
    size_t tail_length, tail_room;
};

/* --- a block's rows, by a thread -------------------------------------------------------------------------------- */

static bool is_row(const block *b, char *line, size_t length, double row[])
{
    iso_csv_mistake unused;
    return length < ISO_LONGEST_LINE && *line != '#' &&
           iso_csv_read_row(b->format, line, row, &unused) == ISO_CSV_GOOD;
}

static void read_block(void *data)
{
    block *b = data;
    double *row = b->row;
    while (b->at < b->length && b->known < MOST_ROWS) {
        char *const line = b->text + b->at, *end = memchr(line, '\n', b->length - b->at);
        const size_t size = (size_t)((end ? end : b->text + b->length) - line);
        size_t length = size;
        b->at += length + (end != NULL);
        line[length] = '\0';
        while (length > 0 && line[length - 1] == '\r') line[--length] = '\0';
        b->begin[b->known] = (uint32_t)(line - b->text);
        b->size[b->known] = (uint32_t)size;
        b->good[b->known] = is_row(b, line, size, row);
        if (b->good[b->known++]) row += b->format->columns;
    }
}

/* --- blocks ----------------------------------------------------------------------------------------------------- */

static void free_block(block *b)
{
    if (!b) return;
    free(b->text);
    free(b->row);
    free(b);
}

/* A row has at least one digit and one separator or end for each number. */
static block *create_block(void)
{
    block *b = calloc(1, sizeof *b);
    if (!b) return NULL;
    b->task = (iso_task){.work = read_block, .data = b};
    b->room = 2 * ISO_LONGEST_LINE;
    b->text = malloc(b->room + 1);
    b->row = malloc((ISO_LONGEST_LINE + ISO_MOST_CSV_FIELDS) * sizeof *b->row);
    if (b->text && b->row) return b;
    free_block(b);
    return NULL;
}

/* Whether read() would give something at once. */
static bool is_ready(const iso_csv_lines *c)
{
    return c->ready || poll(&(struct pollfd){.fd = fileno(c->file), .events = POLLIN}, 1, 0) > 0;
}

/* Reads on, at most ISO_LONGEST_LINE characters. *got 0: the end, or an error, which is kept. */
static iso_status read_more(iso_context *ctx, iso_csv_lines *c, char *to, size_t *got)
{
    for (*got = 0;;) {
        const ssize_t n = read(fileno(c->file), to, ISO_LONGEST_LINE);
        if (n > 0) return *got = (size_t)n, ISO_OK;
        c->ended = n == 0 || errno != EINTR;
        if (n < 0 && c->ended) c->error = errno;
        if (c->ended) return ISO_OK;
        if (!iso_context_goes_on(ctx)) return iso_context_stopped(ctx);
    }
}

/* Room for one more reading behind `length` characters, and for all of them in the tail. */
static iso_status make_room(iso_context *ctx, iso_csv_lines *c, block *b, size_t length)
{
    const size_t room = 2 * (length + ISO_LONGEST_LINE);
    if (length + ISO_LONGEST_LINE <= b->room) return ISO_OK;
    char *tail = c->tail_room < room ? realloc(c->tail, room) : c->tail;
    if (tail) c->tail = tail, c->tail_room = room;
    char *text = tail ? realloc(b->text, room + 1) : NULL;
    if (!text) return iso_text_no_memory(ctx, "read", c->name);
    b->text = text;
    b->room = room;
    return ISO_OK;
}

/* Keeps what stands behind the whole lines for the next block. */
static void keep_tail(iso_csv_lines *c, const char *from, size_t length)
{
    memcpy(c->tail, from, length);
    c->tail_length = length;
}

/* The block holds the beginning of a line that is too long: passes over the rest of it. */
static iso_status skip_line(iso_context *ctx, iso_csv_lines *c, block *b)
{
    char *rest = b->text + ISO_LONGEST_LINE, *end = NULL;
    size_t got = 0;
    iso_status status = ISO_OK;
    b->too_long = true;
    b->length = 1;
    while (status == ISO_OK && !c->ended && !end) { /* it may never end */
        status = iso_context_goes_on(ctx) ? read_more(ctx, c, rest, &got) : iso_context_stopped(ctx);
        end = memchr(rest, '\n', got);
    }
    if (end) keep_tail(c, end + 1, got - (size_t)(end + 1 - rest));
    return status;
}

/* Fills a block with whole lines. b->length 0: there are none. */
static iso_status fill(iso_context *ctx, iso_csv_lines *c, block *b)
{
    size_t length = c->tail_length, got;
    ISO_TRY(make_room(ctx, c, b, length));
    memcpy(b->text, c->tail, length);
    c->tail_length = b->length = b->at = b->known = b->next = 0;
    b->next_row = b->row;
    b->too_long = false;
    const char *end = memrchr(b->text, '\n', length);
    while (!c->ended && (!end || (length < ISO_LONGEST_LINE / 2 && is_ready(c)))) {
        if (!end && length >= c->format->longest) return skip_line(ctx, c, b);
        got = 0;
        iso_status status = make_room(ctx, c, b, length);
        if (status == ISO_OK) status = read_more(ctx, c, b->text + length, &got);
        const char *later = memrchr(b->text + length, '\n', got);
        if (later) end = later;
        length += got;
        if (status != ISO_OK) return keep_tail(c, b->text, length), status;
    }
    b->length = c->ended && c->error == 0 ? length : end ? (size_t)(end + 1 - b->text) : 0;
    keep_tail(c, b->text + b->length, length - b->length);
    return ISO_OK;
}

/* Reads one more block, behind the others. The threads leave a block with '\0' in it to the caller. */
static iso_status add_block(iso_context *ctx, iso_csv_lines *c)
{
    block *b = c->ring[(c->first + c->count) % BLOCKS];
    const iso_status status = fill(ctx, c, b);
    if (status != ISO_OK || b->length == 0) return status;
    c->count++;
    b->format = c->format;
    if (c->format->columns > 0 && !b->too_long && !memchr(b->text, '\0', b->length))
        iso_tasks_give(c->tasks, &b->task);
    return ISO_OK;
}

/* How many blocks may be in work: some for each thread. */
static int depth(const iso_csv_lines *c)
{
    const int size = iso_tasks_size(c->tasks);
    return c->format->columns > 0 && size > 0 ? 2 * size + 2 : 1;
}

/* Whether there is room for one more block, in which to read ahead. */
static bool has_room(iso_csv_lines *c)
{
    if (c->count >= depth(c)) return false;
    block **at = &c->ring[(c->first + c->count) % BLOCKS];
    if (!*at) *at = create_block();
    return *at != NULL;
}

/* Goes to the next block. c->count 0: there is none. */
static iso_status next_block(iso_context *ctx, iso_csv_lines *c)
{
    iso_status status = ISO_OK;
    if (c->count > 0) c->first = (c->first + 1) % BLOCKS, c->count--;
    while (status == ISO_OK && !c->ended && has_room(c) && (c->count == 0 || is_ready(c))) status = add_block(ctx, c);
    if (status == ISO_OK && c->count == 0 && c->error != 0)
        errno = c->error, status = iso_file_trouble(ctx, "read", c->name);
    if (status == ISO_OK && c->count == 0 && !c->ended) /* not even one block could be made */
        status = iso_text_no_memory(ctx, "read", c->name);
    if (status == ISO_OK && c->count > 0) iso_tasks_finish(c->tasks, &c->ring[c->first]->task);
    return status;
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* A line that was read ahead. */
static void take_known(const iso_csv_lines *c, block *b, iso_csv_line *line)
{
    const size_t i = b->next++;
    *line = (iso_csv_line){.text = b->text + b->begin[i], .too_long = b->size[i] >= ISO_LONGEST_LINE};
    if (!b->good[i]) {
        line->length = strlen(line->text);
        return;
    }
    line->row = b->next_row;
    b->next_row += c->format->columns;
}

static void take_unknown(const iso_csv_lines *c, block *b, iso_csv_line *line)
{
    char *const text = b->text + b->at, *end = memchr(text, '\n', b->length - b->at);
    *line = (iso_csv_line){.text = text, .length = (size_t)((end ? end : b->text + b->length) - text)};
    line->too_long = b->too_long || line->length >= c->format->longest;
    b->at += line->length + (end != NULL);
    text[line->length] = '\0';
}

iso_status iso_csv_lines_next(iso_context *ctx, iso_csv_lines *c, iso_csv_line *line, bool *more)
{
    for (;;) {
        block *b = c->ring[c->first];
        *more = c->count > 0;
        if (*more && b->next < b->known) return take_known(c, b, line), ISO_OK;
        if (*more && b->at < b->length) return take_unknown(c, b, line), ISO_OK;
        if (!*more && c->ended && c->error == 0) return ISO_OK;
        ISO_TRY(next_block(ctx, c));
    }
}

/* --- opening and closing ---------------------------------------------------------------------------------------- */

void iso_csv_lines_close(iso_csv_lines *c)
{
    if (!c) return;
    for (int i = 0; i < c->count; i++) iso_tasks_finish(c->tasks, &c->ring[(c->first + i) % BLOCKS]->task);
    iso_tasks_free(c->tasks);
    for (int i = 0; i < BLOCKS; i++) free_block(c->ring[i]);
    if (c->file) iso_text_close(c->file);
    free(c->tail);
    free(c);
}

iso_status iso_csv_lines_open(iso_context *ctx, const char *path, const char *name, const iso_csv_format *format,
                              iso_csv_lines **lines)
{
    struct stat kind;
    iso_csv_lines *c = *lines = calloc(1, sizeof *c);
    if (!c) return iso_text_no_memory(ctx, "read", name);
    c->name = name;
    c->format = format;
    c->tasks = iso_tasks_create();
    c->tail_room = 2 * ISO_LONGEST_LINE;
    c->tail = malloc(c->tail_room);
    if (!c->tasks || !c->tail || !has_room(c)) return iso_text_no_memory(ctx, "read", name);
    c->file = iso_text_open(ctx, path);
    if (!c->file) return ISO_FILE_TROUBLE;
    c->ready = fstat(fileno(c->file), &kind) == 0 && S_ISREG(kind.st_mode);
    return ISO_OK;
}

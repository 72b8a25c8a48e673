/* csv_lines.c - the lines of a text file. read() fills a buffer, in which the next line is looked for: a line from a
 * slow pipe is passed on at once. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/context_impl.h"
#include "io/csv/csv_impl.h"
#include "io/output_impl.h"
#include "io/text_impl.h"

/* Reads on behind what is there. At the end, or with an error, which is kept, nothing is added. */
static iso_status read_more(iso_context *ctx, iso_csv_lines *c)
{
    memmove(c->text, c->text + c->begin, c->end - c->begin);
    c->searched -= c->begin, c->end -= c->begin, c->begin = 0;
    if (c->room - c->end < ISO_LONGEST_LINE) {
        char *text = realloc(c->text, 2 * c->room);
        if (!text) return iso_text_no_memory(ctx, "read", c->name);
        c->text = text, c->room *= 2;
    }
    for (;;) {
        const ssize_t n = read(fileno(c->file), c->text + c->end, c->room - c->end - 1); /* 1: for '\0' */
        if (n > 0) return c->end += (size_t)n, ISO_OK;
        c->ended = n == 0 || errno != EINTR;
        if (n < 0 && c->ended) c->error = errno;
        if (c->ended) return ISO_OK;
        if (!iso_context_goes_on(ctx)) return iso_context_stopped(ctx);
    }
}

/* The end of the line at c->begin; NULL: it is not there yet. */
static char *find_end(iso_csv_lines *c)
{
    char *end = memchr(c->text + c->searched, '\n', c->end - c->searched);
    c->searched = end ? (size_t)(end - c->text) : c->end;
    return end;
}

/* Passes over the rest of a line, which may never end. */
static iso_status skip_rest(iso_context *ctx, iso_csv_lines *c)
{
    char *end;
    while (!(end = find_end(c)) && !c->ended) {
        if (!iso_context_goes_on(ctx)) return iso_context_stopped(ctx);
        c->begin = c->end;
        ISO_TRY(read_more(ctx, c));
    }
    c->begin = c->searched = end ? (size_t)(end + 1 - c->text) : c->end;
    c->skips = false;
    return ISO_OK;
}

iso_status iso_csv_lines_next(iso_context *ctx, iso_csv_lines *c, size_t longest, char **text, size_t *length,
                              bool *more)
{
    char *end;
    if (c->skips) ISO_TRY(skip_rest(ctx, c));
    while (!(end = find_end(c)) && !c->ended && c->end - c->begin < longest) ISO_TRY(read_more(ctx, c));
    if (!end && c->error != 0) return errno = c->error, iso_file_trouble(ctx, "read", c->name);
    *more = c->begin < c->end;
    *text = c->text + c->begin;
    *length = (end ? (size_t)(end - c->text) : c->end) - c->begin;
    (*text)[*length] = '\0';
    c->skips = *length >= longest && !end;
    c->begin = c->searched = c->begin + *length + (end != NULL);
    return ISO_OK;
}

iso_status iso_csv_lines_open(iso_context *ctx, const char *path, const char *name, iso_csv_lines *c)
{
    *c = (iso_csv_lines){.name = name, .room = 2 * ISO_LONGEST_LINE, .text = malloc(2 * ISO_LONGEST_LINE)};
    if (!c->text) return iso_text_no_memory(ctx, "read", name);
    c->file = iso_text_open(ctx, path);
    return c->file ? ISO_OK : ISO_FILE_TROUBLE;
}

void iso_csv_lines_close(iso_csv_lines *c)
{
    if (c->file) iso_text_close(c->file);
    free(c->text);
}

/* fold.c - text for people, folded to the width of a page (see fold_impl.h). */
#define _GNU_SOURCE /* fopencookie */
#include "base/fold_impl.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

/* Columns of text in UTF-8: bytes that begin a character. */
static int columns_of(const char *text, size_t length)
{
    int columns = 0;
    for (size_t i = 0; i < length; i++) columns += (text[i] & 0xC0) != 0x80;
    return columns;
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* The words of text from column `column` on; further lines begin with `mark`, at column `indent`. */
static void fold_words(FILE *to, const char *text, size_t length, int column, int indent, const char *mark, int width)
{
    const char *end = text + length;
    bool first = true;
    while (text < end) {
        const size_t blanks = strspn(text, " ");
        text += blanks;
        if (text >= end) return;
        size_t word = strcspn(text, " \n");
        if (word > (size_t)(end - text)) word = (size_t)(end - text);
        const int columns = columns_of(text, word);
        if (!first && width != ISO_ANY_WIDTH && column + (int)blanks + columns > width)
            fprintf(to, "\n%-*s", indent, mark), column = indent;
        else
            fprintf(to, "%*s", (int)blanks, ""), column += (int)blanks;
        fwrite(text, 1, word, to);
        column += columns;
        text += word;
        first = false;
    }
}

/* Where further lines begin: below what follows the last two blanks, if there is room for words; else below the line
 * if it begins on the left, or a little to the right. */
static int indent_of(const char *text, size_t length, int width)
{
    enum { ROOM = 24, STEP = 2 };
    const size_t begin = strspn(text, " ");
    size_t at = begin > 0 ? begin + STEP : 0;
    for (size_t i = begin + 1; i + 2 < length && (int)i + ROOM < width; i++)
        if (text[i - 1] == ' ' && text[i] == ' ' && text[i + 1] != ' ') at = i + 1;
    return (int)at + ROOM / 2 < width ? (int)at : STEP;
}

void iso_fold_line(FILE *to, const char *text, size_t length, int width)
{
    const bool comment = *text == '#';
    fold_words(to, text, length, 0, comment ? 4 : indent_of(text, length, width), comment ? "#" : "", width);
    fputc('\n', to);
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

enum { MOST_CELLS = 24, GAP = 2, LEAST_WORDS = 24, MOST_WIDTH = 10000 };
enum { BEGIN = '\001', END = '\002' }; /* marks around a table */

typedef struct cell {
    const char *text;
    size_t length;
} cell;

typedef struct table {
    const char *text; /* all rows until END; the first is the header */
    int columns, keys;
    int width[MOST_CELLS];
    bool words[MOST_CELLS]; /* not all are numbers */
} table;

/* Cuts the row at *text into cells and steps behind it. Returns how many there are. */
static int read_row(const char **text, cell cells[MOST_CELLS])
{
    int count = 0;
    for (bool more = true; more && count < MOST_CELLS; *text += more) {
        const size_t length = strcspn(*text, "\t\n");
        cells[count++] = (cell){*text, length};
        *text += length;
        more = **text == '\t';
    }
    *text += strcspn(*text, "\n");
    *text += **text == '\n';
    return count;
}

static bool is_number(const cell *c)
{
    return c->length == 0 || strchr("0123456789+-~*.", c->text[0]) != NULL || strncmp(c->text, "nan", 3) == 0 ||
           strncmp(c->text, "inf", 3) == 0;
}

/* A last cell of words: of a row that is shorter than the header, or of a title. */
static bool is_free(const table *t, int count, int i)
{
    return i == count - 1 && count < t->columns;
}

static void measure(table *t)
{
    cell cells[MOST_CELLS];
    const char *at = t->text;
    t->columns = read_row(&at, cells);
    for (int row = 0, count = t->columns; count > 0; row++) {
        for (int i = 0; i < count && i < t->columns; i++) {
            if (is_free(t, count, i)) continue;
            const int columns = columns_of(cells[i].text, cells[i].length);
            if (columns > t->width[i]) t->width[i] = columns;
            if (row > 0 && !is_number(&cells[i])) t->words[i] = true;
        }
        count = *at && *at != END ? read_row(&at, cells) : 0;
    }
}

static void print_cell(FILE *to, const table *t, const cell *c, int i, bool last)
{
    const int blanks = t->width[i] - columns_of(c->text, c->length);
    fprintf(to, "%*s", GAP + (t->words[i] ? 0 : blanks), "");
    fwrite(c->text, 1, c->length, to);
    if (t->words[i] && !last) fprintf(to, "%*s", blanks, "");
}

/* One row: its keys, and the columns from `first` until `end`. What remains of the last one is folded. */
static void print_row(FILE *to, const table *t, const cell cells[], int count, int first, int end, int width)
{
    int column = 0, last = count < end ? count - 1 : end - 1;
    while (last > 0 && (cells[last].length == 0 || (last >= t->keys && last < first))) last--;
    for (int i = 0; i <= last; i++) {
        if (i >= t->keys && i < first) continue;
        const bool folded = is_free(t, count, i) || (t->words[i] && i == t->columns - 1);
        if (folded && is_free(t, count, i) && first > t->keys && count > 1) continue;
        if (folded) {
            const bool room = width == ISO_ANY_WIDTH || column + GAP + LEAST_WORDS <= width;
            const int indent = room ? column + GAP : 2 * GAP;
            fprintf(to, room ? "%*s" : "\n%*s", room ? GAP : indent, "");
            fold_words(to, cells[i].text, cells[i].length, indent, indent, "", width);
            continue;
        }
        print_cell(to, t, &cells[i], i, i == last);
        column += GAP + t->width[i];
    }
    fputc('\n', to);
}

/* The first column that has no room beside the keys and the columns from `first` on. At least one has. */
static int part_end(const table *t, int first, int width)
{
    int used = 0, end = first;
    for (int i = 0; i < t->keys; i++) used += GAP + t->width[i];
    for (; end < t->columns; end++) {
        const bool folds = t->words[end] && end == t->columns - 1;
        const int needs = GAP + (folds && t->width[end] > LEAST_WORDS ? LEAST_WORDS : t->width[end]);
        if (end > first && used + needs > width) break;
        used += needs;
    }
    return end;
}

static int count_parts(const table *t, int width)
{
    int parts = 0;
    for (int first = t->keys; first < t->columns; first = part_end(t, first, width)) parts++;
    return parts;
}

/* In as few parts as the width allows, which are about as wide as each other. */
static void print_table(FILE *to, const char *text, int keys, int width)
{
    cell cells[MOST_CELLS];
    table t = {.text = text, .keys = keys};
    measure(&t);
    int narrow = width == ISO_ANY_WIDTH ? MOST_WIDTH : width;
    const int parts = count_parts(&t, narrow);
    while (narrow > 1 && parts > 1 && count_parts(&t, narrow - 1) == parts) narrow--;
    for (int first = keys, end; first < t.columns; first = end) {
        end = part_end(&t, first, narrow);
        if (first > keys) fputc('\n', to);
        for (const char *at = text; *at && *at != END;) {
            const int count = read_row(&at, cells);
            print_row(to, &t, cells, count, first, end, width);
        }
    }
}

/* --- texts with tables ------------------------------------------------------------------------------------------ */

void iso_table_begin(FILE *to, int keys)
{
    fprintf(to, "%c%d\n", BEGIN, keys);
}

void iso_table_end(FILE *to)
{
    fprintf(to, "%c\n", END);
}

void iso_fold(FILE *to, const char *text, int width)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (*text == BEGIN) {
            print_table(to, text + length + 1, text[1] - '0', width);
            text += strcspn(text, (char[]){END, '\0'});
            text += strcspn(text, "\n");
        } else {
            iso_fold_line(to, text, length, width);
            text += length;
        }
        text += *text == '\n';
    }
}

/* --- a text that grows ------------------------------------------------------------------------------------------ */

static ssize_t keep(void *cookie, const char *text, size_t size)
{
    iso_memory *m = cookie;
    if (m->used + size + 1 > m->room) {
        const size_t room = 2 * m->room + size + 1;
        char *more = realloc(m->text, room);
        if (!more) return m->failed = true, 0;
        m->text = more;
        m->room = room;
    }
    memcpy(m->text + m->used, text, size);
    m->used += size;
    m->text[m->used] = '\0';
    return (ssize_t)size;
}

FILE *iso_memory_open(iso_memory *m)
{
    *m = (iso_memory){.used = 0};
    return fopencookie(m, "w", (cookie_io_functions_t){.write = keep});
}

char *iso_memory_close(FILE *to, iso_memory *m)
{
    const bool closed = to && fclose(to) == 0;
    if (closed && m->used == 0) keep(m, "", 0);
    if (closed && !m->failed) return m->text;
    free(m->text);
    return NULL;
}

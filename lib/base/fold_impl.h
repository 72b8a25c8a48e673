/* fold_impl.h - text for people, folded to the width of a page.
 *
 * A study prints lines, and tables whose cells have tabs between:
 *
 *     fprintf(to, "k = %s\n", ISO_SHORT(k));
 *     iso_table_begin(to, 1);                       a table, whose first column is repeated where it must be cut
 *     fprintf(to, "method\ttime\n");                its header
 *     fprintf(to, "%s\t%.1e\n", name, seconds);
 *     iso_table_end(to);
 *
 * iso_fold prints such a text. A line is folded between words. Further lines begin below what follows two blanks;
 * without two blanks, below the line's beginning. Columns of numbers stand to the right, others to the left. A column
 * that has no room goes on below, behind the first `keys` columns again; the last one is folded, if it has words. A row
 * with fewer cells than the header ends with words that may be long, and stands in the first part alone. One without a
 * tab is a title.
 */
#ifndef ISO_BASE_FOLD_IMPL_H
#define ISO_BASE_FOLD_IMPL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { ISO_ANY_WIDTH = 0 };

/* Marks around a table in a text. */
void iso_table_begin(FILE *to, int keys);
void iso_table_end(FILE *to);

/* Prints a text with tables. width: columns of the page; ISO_ANY_WIDTH: no line is folded. */
void iso_fold(FILE *to, const char *text, int width);

/* A text that is written into a stream. iso_memory_close returns it, for the caller to free; NULL: `to` is NULL, or
 * memory was short for a part of it, which a stream of open_memstream would not report. */
typedef struct iso_memory {
    char *text;
    size_t used, room;
    bool failed;
} iso_memory;
FILE *iso_memory_open(iso_memory *memory);
char *iso_memory_close(FILE *to, iso_memory *memory);

/* One line (the first `length` characters of text), folded; the end of the line is added. */
void iso_fold_line(FILE *to, const char *text, size_t length, int width);

#endif

/* csv_impl.h - what reading a table from text is made of.
 *
 *     csv_reader.c   lines of #, the names of the columns of trajectories
 *     csv_lines.c    the lines of the file
 *     csv_row.c      the fields of one line, its numbers; the cells of other tables: numbers, nan among them, words
 */
#ifndef ISO_IO_CSV_IMPL_H
#define ISO_IO_CSV_IMPL_H

#include <stdbool.h>
#include <stddef.h>

#include "base/record.h"

/* LONGEST_TEXT: a line of a table of isoroll, which may have the text of a sweep. */
enum { ISO_LONGEST_LINE = 1 << 16, ISO_LONGEST_TEXT = 1 << 25, ISO_MOST_CSV_FIELDS = 1024 };

/* --- csv_row.c -------------------------------------------------------------------------------------------------- */

/* A part of a line without the blanks around it, and the quotes. */
typedef struct iso_csv_field {
    char *text;
    size_t length;
} iso_csv_field;

/* Takes the blanks off. */
iso_csv_field iso_csv_trim(char *text, size_t length);

/* The next field of *rest, which then begins behind it (NULL after the last). */
iso_csv_field iso_csv_next_field(char separator, char **rest);

/* Whether a field is a number, perhaps a damaged one, or what somebody writes for one that is not finite. */
bool iso_csv_begins_as_number(iso_csv_field f);

/* How a row is read. */
typedef struct iso_csv_format {
    char separator; /* ',', ';', or ' ' for blanks                                       */
    size_t fields;
    short column[ISO_MOST_CSV_FIELDS]; /* of the row, for each field of the file; -1: passed over           */
} iso_csv_format;

/* What is wrong with a row. */
typedef enum iso_csv_wrong { ISO_CSV_GOOD, ISO_CSV_FEW, ISO_CSV_MANY, ISO_CSV_NO_NUMBER } iso_csv_wrong;

typedef struct iso_csv_mistake {
    char *at;     /* the character at which it is seen                   */
    size_t found; /* the number of the field, which is that of good ones */
} iso_csv_mistake;

/* Reads the numbers of a line, which ends with '\0'. */
iso_csv_wrong iso_csv_read_row(const iso_csv_format *format, char *line, size_t length, double row[],
                               iso_csv_mistake *mistake);

/* Reads a finite number at *at, before `end`, and moves *at behind it. An exponent may have the letter D. False: there
 * is none. */
bool iso_csv_read_number(char **at, const char *end, double *value);

static inline bool iso_is_blank(char x)
{
    return x == ' ' || x == '\t';
}

/* Takes the next cell of *rest, which then begins behind it (NULL after the last): without quotes, ended with '\0'.
 * NULL: it has no closing quote. */
char *iso_csv_next_cell(char **rest);

/* Reads a cell as a number: finite, nan, inf, or empty, which is nan. */
bool iso_csv_read_cell(char *cell, double *value);

enum { ISO_TEXT_KEY = 32 };
/* The text in "# KEY | TEXT", and its key; NULL: the line is another one. */
const char *iso_csv_text_line(const char *line, char key[ISO_TEXT_KEY]);

/* --- csv_lines.c ------------------------------------------------------------------------------------------------ */

typedef struct iso_csv_lines iso_csv_lines;

typedef struct iso_csv_line {
    char *text;    /* without its end                                                                      */
    size_t length; /* of the text, which may hold '\0' and has one behind it                               */
    bool too_long; /* the text is a part of a line that is longer than it may be                           */
} iso_csv_line;

/* name: what messages call the file; it must outlive the lines. Errors: ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_csv_lines_open(iso_context *ctx, const char *path, const char *name, iso_csv_lines **lines);
void iso_csv_lines_close(iso_csv_lines *lines);

/* The next line, which is shorter than `longest`; it is valid until the next call. *more false: there is none. Errors:
 * ISO_FILE_TROUBLE; ISO_NO_MEMORY; ISO_STOPPED, if a signal comes while a pipe is waited for and the monitor of ctx
 * says so. */
iso_status iso_csv_lines_next(iso_context *ctx, iso_csv_lines *lines, size_t longest, iso_csv_line *line, bool *more);

#endif

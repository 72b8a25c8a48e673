/* csv_impl.h - what reading a table from text is made of.
 *
 *     csv_reader.c   lines of #, the names of the columns
 *     csv_lines.c    the lines of the file
 *     csv_row.c      the fields of one line, its numbers; the cells of other tables: numbers, nan among them, words
 */
#ifndef ISO_IO_CSV_CSV_IMPL_H
#define ISO_IO_CSV_CSV_IMPL_H

#include "io/table_impl.h"

/* LONGEST_TEXT: a line of a table of isoroll, which may have the text of a sweep. */
enum { ISO_LONGEST_LINE = 1 << 16, ISO_LONGEST_TEXT = 1 << 25, ISO_MOST_CSV_FIELDS = 1024 };

/* --- csv_lines.c ------------------------------------------------------------------------------------------------ */

typedef struct iso_csv_lines {
    FILE *file;
    const char *name;
    bool ended, skips;                 /* skips: the rest of a line that is too long                   */
    int error;                         /* errno of read(): it is reported behind the lines before it   */
    char *text;                        /* `room` characters; [begin, end) are still to be taken        */
    size_t room, begin, end, searched; /* no line ends in [begin, searched)            */
} iso_csv_lines;

/* name: what messages call the file. Close them also after an error: ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_csv_lines_open(iso_context *ctx, const char *path, const char *name, iso_csv_lines *lines);
void iso_csv_lines_close(iso_csv_lines *lines);

/* The next line without its end; it may hold '\0' and has one behind it, and is valid until the next call. Of one
 * that is longer than `longest` it is a part that is at least as long. *more false: there is none. Errors:
 * ISO_FILE_TROUBLE; ISO_NO_MEMORY; ISO_STOPPED, if a signal comes while a pipe is waited for and the monitor of ctx
 * says so. */
iso_status iso_csv_lines_next(iso_context *ctx, iso_csv_lines *lines, size_t longest, char **text, size_t *length,
                              bool *more);

/* --- csv_reader.c ----------------------------------------------------------------------------------------------- */

typedef struct iso_csv {
    iso_context *ctx;
    iso_table_reader *r;
    iso_csv_lines lines;
    const char *separators;            /* ",", ";", or " \t" for blanks                                 */
    size_t fields;                     /* of a line, once the names of the columns are known            */
    short column[ISO_MOST_CSV_FIELDS]; /* of the row, for each field of the file; -1: passed over               */
    bool ours, again;                  /* a trajectory with our first line; the line is to be read once more */
    size_t orbit;                      /* the field of that name, from 1; 0: there is none              */
    bool callers;                      /* `line` is the caller's names of columns, no line of the file  */
    bool guesses;                      /* an older table: nothing says which columns have words         */
    bool typed[ISO_MOST_COLUMNS];      /* whether it is known that a column has words, or numbers       */
    char *line;                        /* without its end                                               */
    size_t length, number;             /* number: of the line, from 1                                   */
    size_t longest;                    /* a line is shorter than this                                   */
    char comment[ISO_LONGEST_LINE];    /* the last line of # that is no key: perhaps names              */
} iso_csv;

/* Records "name:line:column: ..." at a character of the line, NULL: its first, and returns ISO_BAD_INPUT. */
iso_status iso_csv_fail(const iso_csv *c, const char *at, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 3, 4)))
#endif
    ;

/* --- csv_row.c -------------------------------------------------------------------------------------------------- */

static inline bool iso_is_blank(char x)
{
    return x == ' ' || x == '\t';
}

/* A part of a line without the blanks around it, and the quotes. */
typedef struct iso_csv_field {
    char *text;
    size_t length;
} iso_csv_field;

/* Takes the blanks off. */
iso_csv_field iso_csv_trim(char *text, size_t length);

/* The next field of *rest, which then begins behind it (NULL after the last). */
iso_csv_field iso_csv_next_field(const char *separators, char **rest);

/* Whether a field is a number, perhaps a damaged one, or what somebody writes for one that is not finite. */
bool iso_csv_begins_as_number(iso_csv_field f);

/* Reads the numbers of the line, a row of a trajectory. */
iso_status iso_csv_read_numbers(const iso_csv *c, double row[]);

/* Takes the next cell of *rest, which then begins behind it (NULL after the last): without quotes, ended with '\0'.
 * NULL: it has no closing quote. */
char *iso_csv_next_cell(char **rest);

/* Reads the cells of the line, a row of another table. */
iso_status iso_csv_read_cells(iso_csv *c, double row[]);

/* At the end of an older table, columns of nothing but empty cells have words; without a row there are none. An empty
 * cell was nan as long as its column was not known to have words. */
void iso_csv_settle_words(const iso_csv *c);

#endif

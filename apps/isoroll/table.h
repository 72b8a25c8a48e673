/* table.h - the table of a command: a record, which is written to a file and drawn. */
#ifndef ISOROLL_TABLE_H
#define ISOROLL_TABLE_H

#include "io/table.h"
#include "isoroll.h"

/* A line "# key: value" of the command's own: `text`, or if that is NULL `number`. A NAN is left out. */
typedef struct table_line {
    const char *key; /* NULL ends a list */
    double number;
    const char *text;
} table_line;

/* Makes a table without rows, to be freed also after an error. It says of what it is: the scene's numbers
 * (description.h), the version of isoroll, the command line, from which it can be made again, and lines (NULL: none).
 * Its columns are those of the fields; iso_columns_append adds a row. */
iso_status table_create(iso_context *ctx, const char *kind, const iso_scene *scene, const table_line *lines,
                        const iso_field *fields, iso_record **table);

/* Copies fields, one of them with another name. */
void table_rename(const iso_field *fields, const char *old, const char *name, iso_field copy[ISO_MOST_FIELDS]);

/* Writes the table to the open file (NULL: there is none) and ends it. `status` says whether the table is whole;
 * otherwise no trace of the file is left. Gives the first failure. */
iso_status table_write(iso_context *ctx, iso_table_writer *to, iso_status status, const iso_record *table);

/* The same, then draws the table (plot NULL: not) and frees it. Gives the exit status. */
int table_finish(iso_context *ctx, iso_table_writer *to, const char *plot, iso_status status, iso_record *table);

#endif

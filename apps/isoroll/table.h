/* table.h - how the tables of commands begin: with the scene, the version, the command, and what it was told. */
#ifndef ISOROLL_TABLE_H
#define ISOROLL_TABLE_H

#include "io/output.h"
#include "isoroll.h"

/* A line "# key: value" of the command's own: `text`, or if that is NULL `number`. A NAN is left out. */
typedef struct table_line {
    const char *key; /* NULL ends a list */
    double number;
    const char *text;
} table_line;

/* Writes the beginning of a table: "# isoroll KIND 1"; the scene's numbers (description.h), the version of isoroll and
 * the command line, from which the table can be made again; lines (NULL: none); and the columns that the fields make.
 */
iso_status table_begin(iso_context *ctx, iso_output *to, const char *kind, const iso_scene *scene,
                       const table_line *lines, const iso_field *fields);

/* Copies fields, one of them with another name. */
void table_rename(const iso_field *fields, const char *old, const char *name, iso_field copy[ISO_MOST_FIELDS]);

/* Ends a table. `status` says whether its rows are all there; otherwise no trace of the file is left. Gives the first
 * failure. */
iso_status table_end(iso_context *ctx, iso_output *to, iso_status status);

#endif

/* table.h - how every table in text begins: "# isoroll KIND 1", the lines "# key: value", the names of the columns. */
#ifndef ISO_IO_TABLE_H
#define ISO_IO_TABLE_H

#include <stdio.h>

#include "../base/api.h"
#include "../base/record.h"

ISO_C_BEGIN

/* Writes one line. Errors: ISO_BAD_ARGUMENT: a key or value that does not read back as one line. */
ISO_API iso_status iso_table_line(iso_context *ctx, FILE *to, const char *key, const char *value);

/* Writes the beginning: the lines and the columns are those of `header`, whose rows are not looked at. Errors: those
 * of iso_table_line, before anything is written. Whether the text arrived, the stream tells. */
ISO_API iso_status iso_table_begin(iso_context *ctx, FILE *to, const char *kind, const iso_record *header);

ISO_C_END

#endif

/* record.h - a table in memory: named columns of doubles or words, and `key: value` lines that travel with them.
 *
 * A record is what a file of a table holds, no more: it knows nothing of balls. Column names and their units are
 * those of the files (lib/doc/formats.md); rows are stored one after another.
 */
#ifndef ISO_BASE_RECORD_H
#define ISO_BASE_RECORD_H

#include <stdbool.h>
#include <stddef.h>

#include "api.h"
#include "context.h"

ISO_C_BEGIN

typedef struct iso_record iso_record;

/* An empty record with the given column names (copied; up to 63 characters each, all different).
 * Errors: ISO_BAD_ARGUMENT, ISO_NO_MEMORY. */
ISO_API iso_status iso_record_create(iso_context *ctx, size_t columns, const char *const names[],
                                     iso_record **record);
ISO_API void iso_record_free(iso_record *record);

/* The same with the lines, the kind and the row tolerance of another record. names NULL: with its columns, too. */
ISO_API iso_status iso_record_create_like(iso_context *ctx, const iso_record *other, size_t columns,
                                          const char *const names[], iso_record **record);

/* What the table holds: "trajectory", "section", "chaos", ... (up to 31 characters); "" until it is set. */
ISO_API const char *iso_record_kind(const iso_record *record);
ISO_API void iso_record_set_kind(iso_record *record, const char *kind);

ISO_API size_t iso_record_columns(const iso_record *record);
ISO_API size_t iso_record_rows(const iso_record *record);
ISO_API const char *iso_record_name(const iso_record *record, size_t column);

/* The column called `name`, or -1. */
ISO_API int iso_record_find(const iso_record *record, const char *name);

/* Finds `count` columns at once; false, and the first missing name in *missing (may be NULL), if one is absent. */
ISO_API bool iso_record_find_all(const iso_record *record, size_t count, const char *const names[], int columns[],
                                 const char **missing);

/* Row `row`, iso_record_columns() doubles, to read or change; valid until the next append. */
ISO_API double *iso_record_row(iso_record *record, size_t row);
ISO_API const double *iso_record_const_row(const iso_record *record, size_t row);

/* Adds a row, *row, filled with zeros. Errors: ISO_NO_MEMORY. */
ISO_API iso_status iso_record_append(iso_context *ctx, iso_record *record, double **row);

/* Adds `count` rows, one after the other in rows[]. Errors: ISO_NO_MEMORY. */
ISO_API iso_status iso_record_add(iso_context *ctx, iso_record *record, size_t count, const double rows[]);

/* Columns of words, such as a verdict. A row holds a number for each word; 0 is the empty word. The record owns the
 * words: iso_record_intern returns the number of one (the same number for equal words) and iso_record_word the word of
 * a number ("" if there is none). Errors: ISO_NO_MEMORY. */
ISO_API void iso_record_set_words(iso_record *record, size_t column, bool words);
ISO_API bool iso_record_has_words(const iso_record *record, size_t column);
ISO_API iso_status iso_record_intern(iso_context *ctx, iso_record *record, const char *word, double *number);
ISO_API const char *iso_record_word(const iso_record *record, double number);

/* How far a row may be from a valid state: from a unit vector, and from a right angle. It follows from the digits
 * that the numbers were written with. It is no part of a file; a new record has ISO_ROW_TOLERANCE. The caller sets a
 * number > 0, at most 0.1. */
#define ISO_ROW_TOLERANCE 1e-5 /* five digits */
ISO_API void iso_record_set_row_tolerance(iso_record *record, double tolerance);
ISO_API double iso_record_row_tolerance(const iso_record *record);

/* The value of a `key: value` line, or NULL; setting an existing key replaces its value, NULL takes
 * the line away.
 * Numbers are stored as the shortest text that reads back, vectors with one blank between. */
ISO_API const char *iso_record_get(const iso_record *record, const char *key);
ISO_API iso_status iso_record_set(iso_context *ctx, iso_record *record, const char *key, const char *value);
ISO_API iso_status iso_record_set_numbers(iso_context *ctx, iso_record *record, const char *key, size_t count,
                                          const double values[]);

/* The i-th line, in the order they were first set; false past the last. */
ISO_API bool iso_record_line(const iso_record *record, size_t i, const char **key, const char **value);

/* Reads `count` finite numbers from the line `key`. Answers false when the line is absent; a line that is not
 * exactly `count` numbers is ISO_BAD_INPUT in *status. */
ISO_API bool iso_record_get_numbers(iso_context *ctx, const iso_record *record, const char *key, size_t count,
                                    double values[], iso_status *status);

ISO_C_END

#endif

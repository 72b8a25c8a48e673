/* record_impl.h - what only the library asks of a record. */
#ifndef ISO_BASE_RECORD_IMPL_H
#define ISO_BASE_RECORD_IMPL_H

#include "base/record.h"

/* How a column is written as text: with so many digits (0: the writer's), "" for what is not finite, words with
 * blanks without quotes. It is no part of a file. */
typedef struct iso_column_format {
    int digits;
    bool empty, plain;
} iso_column_format;
iso_column_format *iso_record_format(const iso_record *record, size_t column);

/* Adds a line, and an end to it, to the text that is the value of a key. */
iso_status iso_record_add_line(iso_context *ctx, iso_record *record, const char *key, const char *line);

/* Forgets all words: for rows that pass by. And all lines. */
void iso_record_forget_words(iso_record *record);
void iso_record_forget_lines(iso_record *record);

/* Keeps the text that a study prints beside its first table, and returns it; NULL: there is none. The record takes the
 * text, which is freed with it. */
void iso_record_keep_text(iso_record *record, char *text);
const char *iso_record_text(const iso_record *record);

#endif

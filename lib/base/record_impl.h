/* record_impl.h - what only the library asks of a record. */
#ifndef ISO_BASE_RECORD_IMPL_H
#define ISO_BASE_RECORD_IMPL_H

#include "base/record.h"

/* Forgets all words: for rows that pass by. */
void iso_record_forget_words(iso_record *record);

#endif

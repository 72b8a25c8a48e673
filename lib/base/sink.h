/* sink.h - who takes rows, remarks and progress while a study works. */
#ifndef ISO_BASE_SINK_H
#define ISO_BASE_SINK_H

#include "record.h"

ISO_C_BEGIN

/* A function that is NULL is not called. `header` and `row` return ISO_OK to go on; any other status ends the work,
 * which returns it. table: the number of the table that the header or the row belongs to, from 0. */
typedef struct iso_sink {
    iso_status (*header)(void *data, int table, const iso_record *header); /* columns and lines, once, before rows */
    iso_status (*row)(void *data, int table, const double row[], size_t count); /* in their order                  */
    void (*note)(void *data, const char *text);                                 /* one line, without a newline     */
    void (*progress)(void *data, double part); /* the part of the work that is done, in [0, 1], by any thread      */
    void *data;
} iso_sink;

ISO_C_END

#endif

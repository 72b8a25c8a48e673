/* stream.h - rows of a file for a study, and rows of a study that go to a file as soon as they are found. */
#ifndef ISOROLL_STREAM_H
#define ISOROLL_STREAM_H

#include "report.h"
#include "study/study.h"

typedef struct stream {
    iso_context *ctx;
    const char *output, *kind;
    bool quiet;        /* notes are not shown */
    const int *digits; /* of numbers (iso_table_set_digits); NULL: all */
    bool opened;       /* from here on, an error is no mistake in the scene */
    iso_table_writer *writer;
} stream;

/* The file is opened when the header is there; rows of other tables than the first are passed over. */
iso_sink stream_sink(stream *s);
iso_status stream_header(void *data, int table, const iso_record *header);
iso_status stream_row(void *data, int table, const double row[], size_t count);

/* Rows of a file as they are read: next of an iso_row_source. */
iso_status stream_next(iso_context *ctx, void *reader, iso_source_row *row);

/* Ends the file after a study with this status, with all its rows, or without a file. The exit status. */
int stream_close(stream *s, iso_status status, bool keep);

#endif

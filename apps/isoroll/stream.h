/* stream.h - rows of a file for a study, and what goes to a file as soon as it is found: rows of a study, or lines of
 * enclosures (`run --certify`), which are text. */
#ifndef ISOROLL_STREAM_H
#define ISOROLL_STREAM_H

#include "io/output_impl.h"
#include "report.h"
#include "study/study.h"

typedef struct stream {
    iso_context *ctx;
    const char *output, *kind;
    bool quiet;        /* notes are not shown */
    const int *digits; /* of numbers (iso_table_set_digits); NULL: all */
    bool opened;       /* from here on, an error is no mistake in the scene */
    iso_table_writer *writer;
    iso_output *out; /* of lines of text */
} stream;

/* The file is opened when the header is there; rows of other tables than the first are passed over. */
iso_sink stream_sink(stream *s);
iso_status stream_header(void *data, int table, const iso_record *header);
iso_status stream_row(void *data, int table, const double row[], size_t count);

/* A line of text; the first one opens the file. */
iso_status stream_line(void *data, const char *text);

/* Rows of a file as they are read: next of an iso_row_source. */
iso_status stream_next(iso_context *ctx, void *reader, iso_source_row *row);

/* The times that `run --times FILE` reads, in the order of the file, as rows of one column; "-" is standard input. The
 * caller frees the record, after an error, too. Errors: ISO_BAD_INPUT with the place, ISO_FILE_TROUBLE,
 * ISO_NO_MEMORY. */
iso_status times_read(iso_context *ctx, const char *path, iso_record **times);

/* Ends the file after a study with this status, with all its rows, or without a file. Returns the exit status. */
int stream_close(stream *s, iso_status status, bool keep);

#endif

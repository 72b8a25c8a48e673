/* table_impl.h - tables row by row, and what table.c and trajectory.c ask of a format of files, CSV or HDF5. */
#ifndef ISO_IO_TABLE_IMPL_H
#define ISO_IO_TABLE_IMPL_H

#include "base/record_impl.h"
#include "io/table.h"
#include "io/trajectory.h"

enum { ISO_MOST_COLUMNS = 5000 }; /* of a table; a sweep has 1000 or so */

#define ISO_TRAJECTORY_KIND "trajectory"
#define ISO_TRAJECTORY_MAGIC "# isoroll " ISO_TRAJECTORY_KIND " "
#define ISO_TRAJECTORY_VERSION "1"

typedef struct iso_table_reader iso_table_reader;
typedef struct iso_table_writer iso_table_writer;

/* As trajectories are read row by row (io/trajectory.h). The words of a row are those of the header. */
iso_status iso_table_reader_open(iso_context *ctx, const char *path, const char *kind, iso_table_reader **reader);
iso_record *iso_table_header(iso_table_reader *reader);
iso_status iso_table_next(iso_context *ctx, iso_table_reader *reader, double row[], bool *more);
void iso_table_reader_close(iso_table_reader *reader);

/* The kind is kept by address. A header with columns of words must live until the last row is written.
 * Errors: ISO_BAD_ARGUMENT: a key or value that is no single line, a column whose name is not known as one of words;
 * ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_table_writer_open(iso_context *ctx, const char *path, const char *kind, iso_table_writer **writer);
iso_status iso_table_write_header(iso_context *ctx, iso_table_writer *writer, const iso_record *header);
iso_status iso_table_write_row(iso_context *ctx, iso_table_writer *writer, const double row[]);
iso_status iso_table_write_line(iso_context *ctx, iso_table_writer *writer, const char *key, const char *value);
iso_status iso_table_writer_close(iso_context *ctx, iso_table_writer *writer, bool keep);

/* Of a new writer: how many rows come (HDF5 then takes no more room than these); a file that has the name when this one
 * ends is not replaced. */
void iso_table_writer_expect(iso_table_writer *writer, size_t rows);
void iso_table_writer_keep_others(iso_table_writer *writer);

/* Whether rows wait to be written, whose words are still needed. */
bool iso_table_writer_waits(const iso_table_writer *writer);

/* From now on the words of a row are forgotten with the next one. */
void iso_table_pass_words(iso_table_reader *reader);

/* --- formats ---------------------------------------------------------------------------------------------------- */

/* How a kind of file is read and written, in two halves; reader->data and writer->data are their own. */
typedef struct iso_table_reading {
    iso_status (*open)(iso_context *ctx, iso_table_reader *r, const char *columns); /* makes r->header */
    iso_status (*next)(iso_context *ctx, iso_table_reader *r, double row[], bool *more);
    void (*close)(iso_table_reader *r); /* also after a failing open */
} iso_table_reading;

typedef struct iso_table_writing {
    iso_status (*open)(iso_context *ctx, iso_table_writer *w, const char *path);
    iso_status (*header)(iso_context *ctx, iso_table_writer *w, const iso_record *header);
    iso_status (*row)(iso_context *ctx, iso_table_writer *w, const double row[]);
    iso_status (*line)(iso_context *ctx, iso_table_writer *w, const char *key, const char *value);
    iso_status (*close)(iso_context *ctx, iso_table_writer *w, bool keep); /* also after a failing open */
} iso_table_writing;

extern const iso_table_reading iso_csv_reading, iso_hdf5_reading;
extern const iso_table_writing iso_csv_writing, iso_hdf5_writing; /* of HDF5: where the build has it */

struct iso_table_reader {
    const iso_table_reading *format;
    const char *path, *name; /* name: what messages call it */
    const char *kind;        /* of a file of isoroll; NULL: any */
    bool trajectory;         /* it is read as a trajectory, isoroll's or another program's: its known columns */
    iso_record *header;
    size_t line;       /* of the row read last */
    size_t rows;       /* of an HDF5 file; 0: not known */
    bool forgets;      /* words of rows that were read before */
    char ignored[512]; /* "": nothing */
    bool passes;       /* over rows of nan, which are counted */
    size_t passed;
    double orbit;     /* the format sets it with each row: the number of its orbit */
    bool any, begins; /* a row was read; the last one is of another orbit than the one before */
    void *data;
};

/* The column of a file of several orbits that tells them apart. It is no column of a trajectory. */
#define ISO_ORBIT_COLUMN "orbit"

/* The reader's header gets columns, and keeps its lines. */
iso_status iso_table_name_columns(iso_context *ctx, iso_table_reader *r, size_t count, const char *const names[]);

/* All rows and the header, which the reader then no longer has. */
iso_status iso_table_read_all(iso_context *ctx, iso_table_reader *r, iso_record **record);

/* Opens a file as `how` says; *reader is NULL after an error. columns: see iso_trajectory_reader_open. */
iso_status iso_table_reader_make(iso_context *ctx, const char *path, const char *columns, const iso_table_reader *how,
                                 iso_table_reader **reader);

struct iso_table_writer {
    const iso_table_writing *format;
    const char *name;        /* what messages call it */
    const char *kind;        /* of the file */
    iso_record *header;      /* names of the columns, no rows; NULL before it is written */
    const iso_record *words; /* the caller's header, if it has columns of words; else NULL */
    size_t rows, expected;   /* written so far; all of them, SIZE_MAX: not known */
    int digits;
    bool waits; /* rows are held back in memory */
    bool fresh; /* a file that has the name when this one ends is not replaced */
    void *data;
};

/* Writes one line. A value of whole lines, each with its end, is written as a text: "# KEY | LINE" for each, without KEY if it is
 * "sweep". Errors: ISO_BAD_ARGUMENT: a key or value that does not read back. */
iso_status iso_table_line(iso_context *ctx, FILE *to, const char *key, const char *value);

/* Whether a name is that of a column of words. */
bool iso_table_has_words(const char *name);

/* Whether a file that is to be written is HDF5. */
bool iso_table_is_hdf5(const char *path);

#define ISO_TABLE_TEXT "sweep" /* in CSV the text with this key has lines "# | ..." */

/* Whether the build can read and write the file: ISO_BAD_ARGUMENT if not. */
iso_status iso_table_check_format(iso_context *ctx, const char *path);

#endif

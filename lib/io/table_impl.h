/* table_impl.h - what table.c and trajectory.c ask of a format of files, CSV or HDF5. */
#ifndef ISO_IO_TABLE_IMPL_H
#define ISO_IO_TABLE_IMPL_H

#include "io/trajectory.h"

enum { ISO_MOST_COLUMNS = 5000 }; /* of a table; a sweep has 1000 or so */

#define ISO_TRAJECTORY_KIND "trajectory"
#define ISO_TRAJECTORY_MAGIC "# isoroll " ISO_TRAJECTORY_KIND " "
#define ISO_TRAJECTORY_VERSION "1"

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
    bool fresh; /* a file that has the name when this one ends is not replaced */
    void *data;
};

/* Whether a name is that of a column of words. */
bool iso_table_has_words(const char *name);

/* Whether the build can read and write the file: ISO_BAD_ARGUMENT if not. */
iso_status iso_table_check_format(iso_context *ctx, const char *path);

#endif

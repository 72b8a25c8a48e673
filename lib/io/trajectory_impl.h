/* trajectory_impl.h - what trajectory.c asks of a format of trajectory files. */
#ifndef ISO_IO_TRAJECTORY_IMPL_H
#define ISO_IO_TRAJECTORY_IMPL_H

#include "io/trajectory.h"

#define ISO_TRAJECTORY_KIND    "trajectory"
#define ISO_TRAJECTORY_MAGIC   "# isoroll " ISO_TRAJECTORY_KIND " "
#define ISO_TRAJECTORY_VERSION "1"

/* How a kind of file is read and written, in two halves; reader->data and writer->data are their own. */
typedef struct iso_trajectory_reading {
    iso_status (*open)(iso_context *ctx, iso_trajectory_reader *r, const char *columns); /* makes r->header */
    iso_status (*next)(iso_context *ctx, iso_trajectory_reader *r, double row[], bool *more);
    void (*close)(iso_trajectory_reader *r); /* also after a failing open */
} iso_trajectory_reading;

typedef struct iso_trajectory_writing {
    iso_status (*open)(iso_context *ctx, iso_trajectory_writer *w, const char *path);
    iso_status (*header)(iso_context *ctx, iso_trajectory_writer *w, const iso_record *header);
    iso_status (*row)(iso_context *ctx, iso_trajectory_writer *w, const double row[]); /* NaNs: a mark */
    iso_status (*line)(iso_context *ctx, iso_trajectory_writer *w, const char *key, const char *value);
    iso_status (*close)(iso_context *ctx, iso_trajectory_writer *w, bool keep); /* also after a failing open */
} iso_trajectory_writing;

extern const iso_trajectory_reading iso_csv_reading, iso_hdf5_reading;
extern const iso_trajectory_writing iso_csv_writing, iso_hdf5_writing; /* of HDF5: where the build has it */

struct iso_trajectory_reader {
    const iso_trajectory_reading *format;
    const char *path, *name; /* name: what messages call it */
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
iso_status iso_trajectory_name_columns(iso_context *ctx, iso_trajectory_reader *r, size_t count,
                                       const char *const names[]);

struct iso_trajectory_writer {
    const iso_trajectory_writing *format;
    const char *name;   /* what messages call it */
    const char *kind;   /* of the file: ISO_TRAJECTORY_KIND, or another kind, such as "section" */
    iso_record *header; /* names of the columns, no rows; NULL before it is written */
    size_t rows;
    int digits;
    void *data;
};

#endif

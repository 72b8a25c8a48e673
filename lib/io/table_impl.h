/* table_impl.h - tables row by row, and what table.c asks of a format of files, CSV or HDF5. */
#ifndef ISO_IO_TABLE_IMPL_H
#define ISO_IO_TABLE_IMPL_H

#include "base/record_impl.h"
#include "io/table.h"
#include "orbit/description.h"

enum { ISO_MOST_COLUMNS = 5000 }; /* of a table; a sweep has 1000 or so */

#define ISO_TRAJECTORY_KIND "trajectory"
#define ISO_ORBITS_KIND "periodic" /* its rows are states, as those of a section */
#define ISO_TRAJECTORY_MAGIC "# isoroll " ISO_TRAJECTORY_KIND " "

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
    iso_status (*flush)(iso_context *ctx, iso_table_writer *w);              /* NULL: there is nothing to do */
    iso_status (*cut)(iso_context *ctx, iso_table_writer *w, size_t length); /* of a file that is resumed */
    iso_status (*close)(iso_context *ctx, iso_table_writer *w, bool keep);   /* not after a failing open */
} iso_table_writing;

extern const iso_table_reading iso_csv_reading, iso_hdf5_reading;
extern const iso_table_writing iso_csv_writing, iso_hdf5_writing; /* of HDF5: where the build has it */

struct iso_table_reader {
    const iso_table_reading *format;
    const char *path, *name; /* name: what messages call it */
    const char *kind;        /* of a file of isoroll; NULL: any */
    bool trajectory;         /* it is read as a trajectory, isoroll's or another program's: its known columns */
    iso_record *header;
    iso_table_place at;
    size_t rows;       /* of an HDF5 file; 0: not known */
    double stored;     /* bytes of an HDF5 file */
    bool forgets;      /* true: words of earlier rows are dropped */
    char ignored[512]; /* "": nothing */
    bool passes;       /* over rows of nan, which are counted */
    bool any;          /* a row was read */
    void *data;
};

/* The reader's header gets columns, and keeps its lines. */
iso_status iso_table_name_columns(iso_context *ctx, iso_table_reader *r, size_t count, const char *const names[]);

/* All rows and the header, which the reader then no longer has. */
iso_status iso_table_read_all(iso_context *ctx, iso_table_reader *r, iso_record **record);

/* Writes a whole record as a table of this kind with so many digits. */
iso_status iso_table_write_as(iso_context *ctx, const char *path, const char *kind, int digits,
                              const iso_record *record);

struct iso_table_writer {
    const iso_table_writing *format;
    const char *name;        /* what messages call it */
    const char *kind;        /* of the file */
    bool finite;             /* its numbers must be: a trajectory or a section */
    bool resumes;            /* see iso_table_writer_open_as */
    iso_record *header;      /* names of the columns, no rows; NULL before it is written */
    const iso_record *words; /* the caller's header, if it has columns of words; else NULL */
    size_t rows, expected;   /* written so far; set it to all that come: HDF5 takes no more room */
    int digits;
    bool waits; /* rows are held back in memory, whose words are still needed */
    bool fresh; /* set it, and a file that has the name when this one ends is not replaced */
    void *data;
};

/* As iso_table_writer_open. resumes: a table as CSV in a regular file, whose FILE.part is locked, and as it was. When
 * this ends without keeping it, it stays. iso_table_go_on goes on behind its first `length` bytes, whose header is this
 * one; 0: begins with the header. Errors: those of iso_table_writer_open and iso_table_write_header. */
iso_status iso_table_writer_open_as(iso_context *ctx, const char *path, const char *kind, bool resumes,
                                    iso_table_writer **writer);
iso_status iso_table_go_on(iso_context *ctx, iso_table_writer *w, const iso_record *header, size_t length);

/* Brings the rows of CSV so far into the file. Errors: ISO_FILE_TROUBLE, ISO_CLOSED_PIPE. */
iso_status iso_table_flush(iso_context *ctx, iso_table_writer *w);

/* Whether a file that is to be written is HDF5. */
bool iso_table_is_hdf5(const char *path);

/* Whether tables of this kind have finite numbers only, in which nan marks a whole row. */
bool iso_table_is_finite(const char *kind);

#define ISO_WORDS_KEY "words" /* In CSV the line "# words: NAME NAME" names the columns of words. */

#define ISO_TABLE_TEXT "sweep" /* In CSV a value of whole lines is lines "# KEY | ...", with this key "# | ...". */

/* Whether the build can read and write the file: ISO_BAD_ARGUMENT if not. */
iso_status iso_table_check_format(iso_context *ctx, const char *path);

/* What kind of table of isoroll a file is, also one that will be refused; "": none. "-" is never looked at. */
enum { ISO_KIND_SIZE = 32 };
void iso_table_kind(const char *path, char kind[ISO_KIND_SIZE]);

/* From now on rows of a trajectory that are nan in every column, as `convert` writes them for rows that cannot be
 * converted, are passed over; otherwise they are ISO_BAD_INPUT, as are rows that are nan in some columns. */
void iso_table_pass_nan(iso_table_reader *reader);

/* Writes a whole record to a new writer, and ends it. */
iso_status iso_table_write_all(iso_context *ctx, iso_table_writer *writer, const iso_record *record);

#endif

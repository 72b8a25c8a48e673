/* hdf5_impl.h - tables as HDF5: the layout of a file, and what its reader and its writer share. All three are
 * compiled where the build has HDF5 (ISO_HDF5).
 *
 *     /             attributes: "format" = "isoroll KIND 1", and one for each line "# key: value" of the
 *                   record: an array of numbers if the value is numbers, else text; "columns": the names of all
 *                   columns, with commas between (not of trajectories)
 *     /clock        t, tau, s                 rows
 *     /ball         omega, n, e, q, ...       rows x 3 (q: 4); if a column is missing, omega1 ... for each one there
 *     /point        M, gamma                  rows x 3
 *     /KIND         all other columns, such as /section/orbit: doubles, or texts of variable length
 *
 * Numbers are doubles. If the number of rows is known before them, a dataset has just their room; else it has chunks
 * of ISO_HDF5_BLOCK rows. Trajectories and sections of version 0.1 have no "columns"; their datasets may stand at the
 * root.
 *
 * Results of older sweeps have a layout of their own, which is only read. Their line "columns" names datasets:
 *
 *     /GROUP/NAME   doubles, as "columns" says: GROUP/NAME ...
 *     /status       integers
 *     /point        integers; in a part only: else the rows are points 0, 1, ...
 *     /failed       reason: of the rows whose status is not 0
 */
#ifndef ISO_IO_HDF5_HDF5_IMPL_H
#define ISO_IO_HDF5_HDF5_IMPL_H

#include <hdf5.h>

#include "io/output_impl.h"
#include "io/table_impl.h"

/* Without messages of HDF5. */
#define ISO_HDF5_QUIETLY(...)                                                                                        \
    H5E_BEGIN_TRY                                                                                                    \
    {                                                                                                                \
        __VA_ARGS__;                                                                                                 \
    }                                                                                                                \
    H5E_END_TRY

#undef H5CHECK /* HDF5 ends the program if it finds another release than that of its headers; its soname suffices */
#define H5CHECK

enum {
    ISO_HDF5_BLOCK = 4096,
    ISO_HDF5_NUMBERS = 16, /* of an attribute */
    ISO_HDF5_TEXT = 200,
    ISO_HDF5_MOST_CHUNKS = 1 << 28, /* bytes of one chunk of each dataset, which HDF5 keeps in memory */
    ISO_HDF5_WORDS = 1 << 26,       /* bytes of the words of a column in a block                      */
    ISO_HDF5_EXPANSION = 1024       /* times the size of its file the numbers may take: deflate gets no further */
};
#define ISO_HDF5_COLUMNS "columns"

/* One dataset and the columns of the record it holds. */
typedef struct iso_hdf5_set {
    hid_t id;
    int first, count; /* adjacent columns of the record */
    bool words;
    int failed;   /* of reasons of an older sweep: only rows whose number in this column is not 0 have one; else 0 */
    hsize_t done; /* ... which were read so far */
} iso_hdf5_set;

/* A file, and a block of its rows. */
typedef struct iso_hdf5_store {
    hid_t file;
    hid_t access;   /* how datasets are opened: one chunk is kept; no link to another file is followed */
    hid_t transfer; /* how rows are moved: words take no more than word_room bytes of memory           */
    hid_t text;     /* the type of texts of any length                                                 */
    int sets;
    iso_hdf5_set *set;
    double *block; /* rows: those of each dataset stand together           */
    size_t filled; /* rows in the block                                    */
    hsize_t rows;  /* in the file: to be read, or written so far           */
    /* of a writer */
    bool grows;              /* datasets get room as rows come */
    const iso_record *words; /* whose words the rows have      */
    iso_output *out;
    /* of a reader */
    iso_context *ctx;
    iso_record *header; /* gets the words                                          */
    char *names;        /* those of the columns, which the header has copied        */
    bool counts;        /* column 0 is the number of the row, without a dataset    */
    bool elsewhere;     /* a link leads to another file                            */
    size_t word_room;   /* 0: the words of a block are too long                    */
    double chunks;      /* bytes of one chunk of each dataset                      */
    size_t next;        /* row of the block                                        */
    hsize_t begun;      /* rows of the file up to the end of the block             */
} iso_hdf5_store;

/* NULL: no memory. */
iso_hdf5_store *iso_hdf5_store_create(void);

/* Adds a dataset, which is closed if that fails: an invalid one, or no memory. */
bool iso_hdf5_store_add(iso_hdf5_store *s, iso_hdf5_set set);

/* Closes what is open; false if that fails. */
bool iso_hdf5_store_free(iso_hdf5_store *s);

/* A dataset's part of a row of the block. */
double *iso_hdf5_cells(const iso_hdf5_store *s, const iso_hdf5_set *d, size_t row);

/* The block's rows from row `first` of the file on, between the block and every dataset. */
bool iso_hdf5_transfer(iso_hdf5_store *s, hsize_t first, bool write);

/* How many of these columns, from the first on, stand in one dataset: those of a whole part of a trajectory, such as
 * /ball/omega, or one. *group and *name are set to those of the dataset if it is of a trajectory. */
int iso_hdf5_part(const char *const names[], size_t count, const char **group, const char **name);

/* Records that the HDF5 library failed, which does not say why. Returns ISO_FILE_TROUBLE. */
iso_status iso_hdf5_trouble(iso_context *ctx, const char *what, const char *name);

/* --- files of strangers (hdf5_refuse.c) --- */

/* Makes access and transfer of a new store. */
void iso_hdf5_guard(iso_hdf5_store *s);

/* Why a dataset of this type and size is not read, a text that its name follows; NULL: it may be. size: 0 if its rank
 * is not 1 or 2. Adds to s->chunks. */
const char *iso_hdf5_trouble_of_set(iso_hdf5_store *s, hid_t id, hid_t type, const hsize_t size[2]);

#endif

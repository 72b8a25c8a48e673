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
#ifndef ISO_IO_HDF5_IMPL_H
#define ISO_IO_HDF5_IMPL_H

#include <hdf5.h>

#include "io/replacement_impl.h"
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
#if !H5_VERSION_GE(1, 12, 0) /* what H5Oget_info2 fills has this name since */
#define H5O_info1_t H5O_info_t
#endif

/* --- files ------------------------------------------------------------------------------------------------------ */

enum {
    ISO_HDF5_BLOCK = 4096,
    ISO_HDF5_NUMBERS = 16 /* of an attribute */,
    ISO_HDF5_TEXT = 200,
    ISO_HDF5_MOST_CHUNKS = 1 << 28, /* bytes of one chunk of each dataset, which HDF5 keeps in memory */
    ISO_HDF5_WORDS = 1 << 26,       /* bytes of the words of a column in a block                      */
    ISO_HDF5_EXPANSION = 1024       /* times the size of its file the numbers may take: deflate gets no further */
};
#define ISO_HDF5_COLUMNS "columns"

/* How many of these columns, from the first on, stand in one dataset: those of a whole part of a trajectory, such as
 * /ball/omega, or one. *group and *name are set to those of the dataset if it is of a trajectory. */
int iso_hdf5_part(const char *const names[], size_t count, const char **group, const char **name);

/* One dataset and the columns of the record it holds. */
typedef struct iso_hdf5_set {
    hid_t id;
    int first, count; /* count adjacent columns of the record */
    bool words, grows;
} iso_hdf5_set;

/* The reasons of the failed points of an older sweep. */
typedef struct iso_hdf5_failures {
    hid_t reason; /* < 0: there are none */
    hsize_t done; /* read so far         */
    int status_column, reason_column;
} iso_hdf5_failures;

/* A file, and a block of its rows. */
typedef struct iso_hdf5_store {
    hid_t file;
    int sets;
    iso_hdf5_set *set;
    iso_hdf5_failures failed;
    bool counts;                  /* column 0 is the number of the row, without a dataset       */
    size_t columns, filled, next; /* rows in the block; the one read next                       */
    hsize_t rows;                 /* in the file: to be read, or written so far                 */
    hsize_t begun;                /* of the block that is being read                            */
    double chunks;                /* of a reader: bytes of one chunk of each dataset            */
    bool elsewhere, wordy;        /* a link leads to another file; the words of a block are too long */
    double *block, *packed;       /* rows; a dataset's part of them                             */
    const iso_record *words;      /* of a writer: whose words the rows have                     */
    iso_record *interned;         /* of a reader: the record that gets the words                */
    iso_context *ctx;             /* of the reader                                              */
    iso_replacement replacement;  /* of a writer                                                */
    int descriptor;
} iso_hdf5_store;

/* NULL: no memory. */
iso_hdf5_store *iso_hdf5_store_create(void);

/* Adds a dataset, which is closed if that fails: an invalid one, or no memory. */
bool iso_hdf5_store_add(iso_hdf5_store *s, iso_hdf5_set set);

/* For so many columns; false: no memory. */
bool iso_hdf5_store_room(iso_hdf5_store *s, size_t columns);

/* Closes what is open; false if that fails. */
bool iso_hdf5_store_free(iso_hdf5_store *s);

/* The block's rows from row `first` of the file on, between the block and every dataset. */
bool iso_hdf5_transfer(iso_hdf5_store *s, hsize_t first, bool write);

/* How datasets are accessed: chunk by chunk, of which one is kept. The caller closes it. */
hid_t iso_hdf5_access(void);

/* --- files of strangers (hdf5_refuse.c) --- */

/* The same, and for links to datasets: none to another file is followed, but *elsewhere set. */
hid_t iso_hdf5_access_of_strangers(bool *elsewhere);

/* Why a dataset is not read, in words before its name; NULL: it may be. Adds to s->chunks. */
const char *iso_hdf5_trouble_of_set(iso_hdf5_store *s, hid_t id);

/* How words of any length are read: into memory from malloc, ISO_HDF5_WORDS bytes of it. *left is 0 if that is too
 * little. The caller closes it. */
hid_t iso_hdf5_words(size_t *left);

/* Records that the HDF5 library failed, which does not say why. Returns ISO_FILE_TROUBLE. */
iso_status iso_hdf5_trouble(iso_context *ctx, const char *what, const char *name);

#endif

/* hdf5_impl.h - trajectories as HDF5: the layout of a file, and what its reader and its writer share. All three are
 * compiled where the build has HDF5 (ISO_HDF5).
 *
 *     /             attributes: "format" = "isoroll trajectory 1", and one for each line "# key: value" of the
 *                   record:
 *                   an array of numbers if the value is numbers, else text
 *     /clock        t, tau, s                 rows
 *     /ball         omega, n, e, q, ...       rows x 3 (q: 4); if a column is missing, omega1 ... for each one there
 *     /point        M, gamma                  rows x 3
 *     /section      orbit, crossing, l, x     rows; in files of sections, whose "format" is "isoroll section 1"
 *
 * All numbers are doubles, in chunks of ISO_HDF5_BLOCK rows. Datasets of these names at the root are read as well.
 */
#ifndef ISO_IO_HDF5_IMPL_H
#define ISO_IO_HDF5_IMPL_H

#include "io/hdf5/hdf5_library_impl.h"
#include "io/replacement_impl.h"
#include "io/table_impl.h"
#include "orbit/scene.h"

enum { ISO_HDF5_BLOCK = 4096, ISO_HDF5_NUMBERS = 16 /* of an attribute */ };
#define ISO_HDF5_FORMAT "isoroll " ISO_TRAJECTORY_KIND " " ISO_TRAJECTORY_VERSION

/* A dataset of the layout: it holds columns first ... first + count - 1 of a trajectory (iso_column_name). */
typedef struct iso_hdf5_part {
    const char *group, *name;
    int first, count;
} iso_hdf5_part;
enum { ISO_HDF5_PARTS = ISO_TRAJECTORY_COLUMNS }; /* room for them */

/* Lists them, those of the effects last; gives how many there are. */
int iso_hdf5_parts(iso_hdf5_part parts[ISO_HDF5_PARTS]);

/* One dataset and the columns of the record it holds. */
typedef struct iso_hdf5_set {
    hid_t id;
    int first, count; /* count adjacent columns of the record */
} iso_hdf5_set;

/* A file, and a block of its rows. */
typedef struct iso_hdf5_store {
    hid_t file;
    int sets;
    iso_hdf5_set set[ISO_TRAJECTORY_COLUMNS + 1]; /* the last: the orbits of a section */
    size_t columns, filled, next;                 /* rows in the block; the one read next       */
    hsize_t rows;                                 /* in the file: to be read, or written so far */
    hsize_t begun;                                /* of the block that is being read            */
    double *block, *packed;                       /* rows; a dataset's part of them             */
    iso_replacement replacement;                  /* of a writer                                */
    int descriptor;
} iso_hdf5_store;

/* NULL: no memory. */
iso_hdf5_store *iso_hdf5_store_create(void);

/* For so many columns; false: no memory. */
bool iso_hdf5_store_room(iso_hdf5_store *s, size_t columns);

/* Closes what is open; false if that fails. */
bool iso_hdf5_store_free(iso_hdf5_store *s);

/* The block's rows from row `first` of the file on, between the block and every dataset. */
bool iso_hdf5_transfer(iso_hdf5_store *s, hsize_t first, bool write);

/* A file that is to be written, under the name that a replacement has; negative: it fails. */
hid_t iso_hdf5_create(const char *path);

/* How datasets are accessed: chunk by chunk, of which none need be kept. */
hid_t iso_hdf5_access(void);

/* Attributes: text, and numbers. False: it fails. */
bool iso_hdf5_write_text(hid_t at, const char *key, const char *value);
bool iso_hdf5_write_numbers(hid_t at, const char *key, int count, const double numbers[]);

/* Records that the HDF5 library failed, which does not say why. Returns ISO_FILE_TROUBLE. */
iso_status iso_hdf5_trouble(iso_context *ctx, const char *what, const char *name);

#endif

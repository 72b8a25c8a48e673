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
 * The result of a sweep has the line "columns" of its own, which names datasets:
 *
 *     /GROUP/NAME   doubles, as "columns" says: GROUP/NAME ...
 *     /status       integers
 *     /point        integers; in a part only: else the rows are points 0, 1, ...
 *     /failed       point, reason: of the rows whose status is not 0
 */
#ifndef ISO_IO_HDF5_IMPL_H
#define ISO_IO_HDF5_IMPL_H

#include <hdf5.h>

#include "io/replacement_impl.h"
#include "io/table_impl.h"

/* --- the HDF5 library, which is loaded when the first .h5 file is opened -------------------------------------------
 *
 * Linked in the ordinary way it costs each start of the command three milliseconds: it brings 30 other libraries,
 * for network access among them. So what we call of it is a table of pointers: H5Fopen is h5.Fopen. Macros of HDF5
 * name things without the table; for them stand the macros at the end.
 *
 * ISOROLL_HDF5 in the environment is the path of the library; without it, it is the one that CMake found, by its name.
 * It may be another release than that of the headers: since 1.10.7 HDF5 has all these names with the same types.
 *
 * Every function that opens a .h5 file begins with
 *
 *     iso_status status = iso_hdf5_load(ctx);
 */

/* clang-format off */
#ifdef H5_NO_DEPRECATED_SYMBOLS
#define ISO_HDF5_OLD(X)
#else
#define ISO_HDF5_OLD(X) X(Eauto_is_v2) X(Eget_auto1) X(Eset_auto1) /* H5E_BEGIN_TRY calls them */
#endif

/* Functions, and numbers that H5open() sets. */
#define ISO_HDF5_NAMES(X)                                                                                            \
    ISO_HDF5_OLD(X) X(Aclose) X(Acreate2) X(Aget_name_by_idx) X(Aget_space) X(Aget_type) X(Aopen) X(Aread) X(Awrite) \
    X(Dclose) X(Dcreate2) X(Dget_space) X(Dget_type) X(Dopen2) X(Dread) X(Dset_extent) X(Dwrite) X(Eget_auto2)       \
    X(Eset_auto2) X(Fclose) X(Fcreate) X(Fopen) X(Lexists) X(Oget_info2) X(Pclose) X(Pcreate) X(Pset_alloc_time)     \
    X(Pset_chunk) X(Pset_chunk_cache) X(Pset_create_intermediate_group) X(Pset_file_locking) X(Pset_fill_time)       \
    X(Pset_obj_track_times) X(Sclose) X(Screate) X(Screate_simple) X(Sget_simple_extent_dims)                        \
    X(Sget_simple_extent_ndims) X(Sget_simple_extent_npoints) X(Sselect_hyperslab) X(Tclose) X(Tcopy) X(Tget_class)  \
    X(Tget_cset) X(Tget_size) X(Tis_variable_str) X(Tset_cset) X(Tset_size) X(dont_atexit) X(free_memory) X(open)    \
    X(T_NATIVE_DOUBLE_g) X(T_NATIVE_INT_g) X(T_NATIVE_INT64_g) X(T_C_S1_g) X(P_CLS_DATASET_ACCESS_ID_g)              \
    X(P_CLS_DATASET_CREATE_ID_g) X(P_CLS_FILE_ACCESS_ID_g) X(P_CLS_LINK_CREATE_ID_g)

typedef struct iso_hdf5_library {
#define ISO_HDF5_POINTER(name) __typeof__(H5##name) *name;
    ISO_HDF5_NAMES(ISO_HDF5_POINTER)
#undef ISO_HDF5_POINTER
} iso_hdf5_library;
/* clang-format on */

#define h5 iso_hdf5
extern iso_hdf5_library h5; /* set once, by iso_hdf5_load */

/* Loads the library, if it is not yet there. Errors: ISO_FILE_TROUBLE: it is not installed, or lacks a name. */
iso_status iso_hdf5_load(iso_context *ctx);

/* Without messages of HDF5. */
#define ISO_HDF5_QUIETLY(...)                                                                                        \
    H5E_BEGIN_TRY                                                                                                    \
    {                                                                                                                \
        __VA_ARGS__;                                                                                                 \
    }                                                                                                                \
    H5E_END_TRY

#undef H5OPEN /* it is open, */
#define H5OPEN
#undef H5CHECK /* and HDF5 ends the program if it finds another release of this library; its soname suffices */
#define H5CHECK
#if !H5_VERSION_GE(1, 12, 0) /* what H5Oget_info2 fills has this name since */
#define H5O_info1_t H5O_info_t
#endif
#define H5Eauto_is_v2 h5.Eauto_is_v2
#define H5Eget_auto1 h5.Eget_auto1
#define H5Eset_auto1 h5.Eset_auto1
#define H5Eget_auto2 h5.Eget_auto2
#define H5Eset_auto2 h5.Eset_auto2
#define H5T_NATIVE_DOUBLE_g (*h5.T_NATIVE_DOUBLE_g)
#define H5T_NATIVE_INT_g (*h5.T_NATIVE_INT_g)
#define H5T_NATIVE_INT64_g (*h5.T_NATIVE_INT64_g)
#define H5T_C_S1_g (*h5.T_C_S1_g)
#define H5P_CLS_DATASET_ACCESS_ID_g (*h5.P_CLS_DATASET_ACCESS_ID_g)
#define H5P_CLS_DATASET_CREATE_ID_g (*h5.P_CLS_DATASET_CREATE_ID_g)
#define H5P_CLS_FILE_ACCESS_ID_g (*h5.P_CLS_FILE_ACCESS_ID_g)
#define H5P_CLS_LINK_CREATE_ID_g (*h5.P_CLS_LINK_CREATE_ID_g)

/* --- files ------------------------------------------------------------------------------------------------------ */

enum { ISO_HDF5_BLOCK = 4096, ISO_HDF5_NUMBERS = 16 /* of an attribute */, ISO_HDF5_TEXT = 200 };
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

/* The failed points of a sweep: two datasets, and the columns of the record. */
typedef struct iso_hdf5_failures {
    hid_t point, reason; /* < 0: there are none */
    hsize_t done;        /* read or written so far */
    int point_column, status_column, reason_column;
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
    double *block, *packed;       /* rows; a dataset's part of them                             */
    const iso_record *words;      /* of a writer: whose words the rows have                     */
    iso_record *interned;         /* of a reader: the record that gets the words                */
    iso_context *ctx;             /* of the reader                                              */
    iso_replacement replacement;  /* of a writer                                                */
    int descriptor;
} iso_hdf5_store;

/* Whether a kind has the layout of sweeps. */
bool iso_hdf5_is_sweep(const char *kind);

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

/* How datasets are accessed: chunk by chunk, of which none need be kept. */
hid_t iso_hdf5_access(void);

/* Records that the HDF5 library failed, which does not say why. Returns ISO_FILE_TROUBLE. */
iso_status iso_hdf5_trouble(iso_context *ctx, const char *what, const char *name);

#endif

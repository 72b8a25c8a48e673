/* hdf5_library_impl.h - the HDF5 library, which is loaded when the first .h5 file is opened.
 *
 * Linked in the ordinary way it costs each start of the command three milliseconds: it brings 30 other libraries,
 * for network access among them. So what we call of it is a table of pointers, and macros put the table before the
 * names: H5Fopen(...) is iso_hdf5.H5Fopen(...).
 *
 * Every function that opens a .h5 file begins with
 *
 *     iso_status status = iso_hdf5_load(ctx);
 */
#ifndef ISO_IO_HDF5_LIBRARY_IMPL_H
#define ISO_IO_HDF5_LIBRARY_IMPL_H

#include <hdf5.h>
#include <stdbool.h>

#include "base/context.h"

#ifdef H5_NO_DEPRECATED_SYMBOLS
#define ISO_HDF5_OLD(X)
#else
#define ISO_HDF5_OLD(X) X(H5Eauto_is_v2) X(H5Eget_auto1) X(H5Eset_auto1) /* H5E_BEGIN_TRY calls them */
#endif

/* Functions, and numbers that H5open() sets. */
#define ISO_HDF5_NAMES(X)                                                                                            \
    ISO_HDF5_OLD(X)                                                                                                  \
    X(H5Aclose)                                                                                                      \
    X(H5Acreate2)                                                                                                    \
    X(H5Aget_name_by_idx)                                                                                            \
    X(H5Aget_space) X(H5Aget_type) X(H5Aopen) X(H5Aread) X(H5Awrite) X(H5Dclose) X(H5Dcreate2) X(H5Dget_space)       \
        X(H5Dget_type) X(H5Dopen2) X(H5Dread) X(H5Dset_extent) X(H5Dwrite) X(H5Eget_auto2) X(H5Eset_auto2)           \
            X(H5Fclose) X(H5Fcreate) X(H5Fopen) X(H5Lexists) X(H5Oget_info2) X(H5Pclose) X(H5Pcreate)                \
                X(H5Pset_alloc_time) X(H5Pset_chunk) X(H5Pset_chunk_cache) X(H5Pset_create_intermediate_group)       \
                    X(H5Pset_file_locking) X(H5Pset_fill_time) X(H5Pset_obj_track_times) X(H5Sclose) X(H5Screate)    \
                        X(H5Screate_simple) X(H5Sget_simple_extent_dims) X(H5Sget_simple_extent_ndims)               \
                            X(H5Sget_simple_extent_npoints) X(H5Sselect_hyperslab) X(H5Tclose) X(H5Tcopy)            \
                                X(H5Tget_class) X(H5Tget_cset) X(H5Tget_size) X(H5Tis_variable_str) X(H5Tset_cset)   \
                                    X(H5Tset_size) X(H5check_version) X(H5dont_atexit) X(H5free_memory) X(H5open)    \
                                        X(H5T_NATIVE_DOUBLE_g) X(H5T_NATIVE_INT_g) X(H5T_NATIVE_INT64_g)             \
                                            X(H5T_C_S1_g) X(H5P_CLS_DATASET_ACCESS_ID_g)                             \
                                                X(H5P_CLS_DATASET_CREATE_ID_g) X(H5P_CLS_FILE_ACCESS_ID_g)           \
                                                    X(H5P_CLS_LINK_CREATE_ID_g)

typedef struct iso_hdf5_library {
#define ISO_HDF5_POINTER(name) __typeof__(name) *name;
    ISO_HDF5_NAMES(ISO_HDF5_POINTER)
#undef ISO_HDF5_POINTER
} iso_hdf5_library;

extern iso_hdf5_library iso_hdf5; /* set once, by iso_hdf5_load */

/* Loads the library, if it is not yet there. Errors: ISO_FILE_TROUBLE: it is not installed, or lacks a name. */
iso_status iso_hdf5_load(iso_context *ctx);

/* The same, without words. */
bool iso_hdf5_is_there(void);

#ifndef ISO_HDF5_TABLE /* of the file that fills the table */
#define H5Eauto_is_v2 iso_hdf5.H5Eauto_is_v2
#define H5Eget_auto1 iso_hdf5.H5Eget_auto1
#define H5Eset_auto1 iso_hdf5.H5Eset_auto1
#define H5Aclose iso_hdf5.H5Aclose
#define H5Acreate2 iso_hdf5.H5Acreate2
#define H5Aget_name_by_idx iso_hdf5.H5Aget_name_by_idx
#define H5Aget_space iso_hdf5.H5Aget_space
#define H5Aget_type iso_hdf5.H5Aget_type
#define H5Aopen iso_hdf5.H5Aopen
#define H5Aread iso_hdf5.H5Aread
#define H5Awrite iso_hdf5.H5Awrite
#define H5Dclose iso_hdf5.H5Dclose
#define H5Dcreate2 iso_hdf5.H5Dcreate2
#define H5Dget_space iso_hdf5.H5Dget_space
#define H5Dget_type iso_hdf5.H5Dget_type
#define H5Dopen2 iso_hdf5.H5Dopen2
#define H5Dread iso_hdf5.H5Dread
#define H5Dset_extent iso_hdf5.H5Dset_extent
#define H5Dwrite iso_hdf5.H5Dwrite
#define H5Eget_auto2 iso_hdf5.H5Eget_auto2
#define H5Eset_auto2 iso_hdf5.H5Eset_auto2
#define H5Fclose iso_hdf5.H5Fclose
#define H5Fcreate iso_hdf5.H5Fcreate
#define H5Fopen iso_hdf5.H5Fopen
#define H5Lexists iso_hdf5.H5Lexists
#define H5Oget_info2 iso_hdf5.H5Oget_info2
#if !H5_VERSION_GE(1, 12, 0) /* what H5Oget_info2 fills has this name since */
#define H5O_info1_t H5O_info_t
#endif
#define H5Pclose iso_hdf5.H5Pclose
#define H5Pcreate iso_hdf5.H5Pcreate
#define H5Pset_alloc_time iso_hdf5.H5Pset_alloc_time
#define H5Pset_chunk iso_hdf5.H5Pset_chunk
#define H5Pset_chunk_cache iso_hdf5.H5Pset_chunk_cache
#define H5Pset_create_intermediate_group iso_hdf5.H5Pset_create_intermediate_group
#define H5Pset_file_locking iso_hdf5.H5Pset_file_locking
#define H5Pset_fill_time iso_hdf5.H5Pset_fill_time
#define H5Pset_obj_track_times iso_hdf5.H5Pset_obj_track_times
#define H5Sclose iso_hdf5.H5Sclose
#define H5Screate iso_hdf5.H5Screate
#define H5Screate_simple iso_hdf5.H5Screate_simple
#define H5Sget_simple_extent_dims iso_hdf5.H5Sget_simple_extent_dims
#define H5Sget_simple_extent_ndims iso_hdf5.H5Sget_simple_extent_ndims
#define H5Sget_simple_extent_npoints iso_hdf5.H5Sget_simple_extent_npoints
#define H5Sselect_hyperslab iso_hdf5.H5Sselect_hyperslab
#define H5Tclose iso_hdf5.H5Tclose
#define H5Tcopy iso_hdf5.H5Tcopy
#define H5Tget_class iso_hdf5.H5Tget_class
#define H5Tget_cset iso_hdf5.H5Tget_cset
#define H5Tget_size iso_hdf5.H5Tget_size
#define H5Tis_variable_str iso_hdf5.H5Tis_variable_str
#define H5Tset_cset iso_hdf5.H5Tset_cset
#define H5Tset_size iso_hdf5.H5Tset_size
#define H5check_version iso_hdf5.H5check_version
#define H5dont_atexit iso_hdf5.H5dont_atexit
#define H5free_memory iso_hdf5.H5free_memory
#define H5open iso_hdf5.H5open
#define H5T_NATIVE_DOUBLE_g (*iso_hdf5.H5T_NATIVE_DOUBLE_g)
#define H5T_NATIVE_INT_g (*iso_hdf5.H5T_NATIVE_INT_g)
#define H5T_NATIVE_INT64_g (*iso_hdf5.H5T_NATIVE_INT64_g)
#define H5T_C_S1_g (*iso_hdf5.H5T_C_S1_g)
#define H5P_CLS_DATASET_ACCESS_ID_g (*iso_hdf5.H5P_CLS_DATASET_ACCESS_ID_g)
#define H5P_CLS_DATASET_CREATE_ID_g (*iso_hdf5.H5P_CLS_DATASET_CREATE_ID_g)
#define H5P_CLS_FILE_ACCESS_ID_g (*iso_hdf5.H5P_CLS_FILE_ACCESS_ID_g)
#define H5P_CLS_LINK_CREATE_ID_g (*iso_hdf5.H5P_CLS_LINK_CREATE_ID_g)
#endif

#endif

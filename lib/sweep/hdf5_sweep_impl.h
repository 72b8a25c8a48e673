/* hdf5_sweep_impl.h - a result of a sweep as HDF5, as its writer (hdf5_sweep.c) and its reader (hdf5_sweep_reader.c)
 * see it. */
#ifndef ISO_IO_HDF5_SWEEP_IMPL_H
#define ISO_IO_HDF5_SWEEP_IMPL_H

#include "io/hdf5/hdf5_impl.h"
#include "sweep/sweep_store_impl.h"

enum { ISO_SWEEP_BLOCK = ISO_HDF5_BLOCK, ISO_SWEEP_FAILURES = 1024 };

typedef struct iso_sweep_hdf5 {
    hid_t file, *set, status, point, failed_point, failed_reason;
    int columns;
    hsize_t done, points; /* rows in the file so far; all */
    size_t filled;        /* rows of the block */
    double *block;        /* column after column: ISO_SWEEP_BLOCK numbers each */
    int *block_status;
    int64_t *block_point;
    hsize_t failures; /* in the file so far, or all of a file that is read */
    size_t noted;     /* failures that wait, or the one that is read next  */
    int64_t *failure;
    char (*reason)[ISO_REASON_SIZE];
    bool part;
    iso_replacement replacement;
    int descriptor;
    char *name;
} iso_sweep_hdf5;

/* NULL: no memory for it; it may still lack room for its block. */
iso_sweep_hdf5 *iso_sweep_hdf5_create(int columns);
bool iso_sweep_hdf5_has_room(const iso_sweep_hdf5 *f);

/* Closes what is open. False: it fails. */
bool iso_sweep_hdf5_free(iso_sweep_hdf5 *f);

/* Moves `count` elements from `first` on, between a dataset and memory. */
bool iso_sweep_hdf5_move(hid_t set, hid_t type, hsize_t first, hsize_t count, void *data, bool write);

/* The type of a reason: the caller closes it. */
hid_t iso_sweep_hdf5_reason(void);

#endif

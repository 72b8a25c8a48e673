/* sweep_record_impl.h - the rows of a chunk as bytes: numbers, statuses, and of each point that has failed the length of
 * its reason and the reason. Numbers stand as they are in memory. */
#ifndef ISO_IO_SWEEP_RECORD_IMPL_H
#define ISO_IO_SWEEP_RECORD_IMPL_H

#include "orbit/family.h"

/* The most bytes that `count` points can need. */
size_t iso_sweep_record_most(const iso_sweep_rows *rows, size_t count);

/* Gives the number of bytes. */
size_t iso_sweep_record_pack(const iso_sweep_rows *rows, unsigned char bytes[]);

/* Back: rows->first and rows->count are set before. False: the bytes are not those of so many rows. */
bool iso_sweep_record_unpack(const unsigned char bytes[], size_t length, iso_sweep_rows *rows);

/* Of bytes; another salt gives another number. */
uint64_t iso_sweep_checksum(const void *bytes, size_t length, uint64_t salt);

#endif

/* section_file.h - files of sections that are HDF5 (lib/doc/formats.md): all their columns and lines, as a record.
 * Those that are text are read like other tables of text. */
#ifndef ISO_IO_SECTION_FILE_H
#define ISO_IO_SECTION_FILE_H

#include <stdbool.h>

#include "../base/api.h"
#include "../base/record.h"

ISO_C_BEGIN

/* Whether a file is HDF5 and holds a section. */
ISO_API bool iso_section_file_is_hdf5(const char *path);

/* Reads all columns and lines of a section file that is HDF5. Errors: ISO_BAD_INPUT, ISO_FILE_TROUBLE, ISO_NO_MEMORY,
 * without the name of the file; ISO_BAD_ARGUMENT: this build has no HDF5. */
ISO_API iso_status iso_section_file_read_hdf5(iso_context *ctx, const char *path, iso_record **record);

ISO_C_END

#endif

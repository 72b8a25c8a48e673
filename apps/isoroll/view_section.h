/* view_section.h - reads section files for `isoroll view`. */
#ifndef ISOROLL_VIEW_SECTION_H
#define ISOROLL_VIEW_SECTION_H

#include "view.h"

/* Reads a section file, HDF5 or text, "-" being standard input: all columns and lines. Errors: ISO_BAD_INPUT, of text
 * with line and column, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status view_section_read(iso_context *ctx, const char *path, iso_record **record);

/* Whether a file is HDF5 and holds a section. */
bool view_section_is_hdf5(const char *path);

/* The same of a file that is HDF5, where the build has it; else ISO_BAD_ARGUMENT. */
iso_status view_section_read_hdf5(iso_context *ctx, const char *path, iso_record **record);

#endif

/* view_section.h - reads section files for `isoroll view`. */
#ifndef ISOROLL_VIEW_SECTION_H
#define ISOROLL_VIEW_SECTION_H

#include "view.h"

/* Reads all columns and lines of a section file, HDF5 or CSV; "-" is standard input. Errors: ISO_BAD_INPUT (in CSV
 * with line and column), ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status view_section_read(iso_context *ctx, const char *path, iso_record **record);

#endif

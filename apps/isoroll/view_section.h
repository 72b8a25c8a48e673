/* view_section.h - reads section files for `isoroll view`. */
#ifndef ISOROLL_VIEW_SECTION_H
#define ISOROLL_VIEW_SECTION_H

#include "view.h"

/* Reads a section file as text, "-" being standard input: all columns and lines. Errors: ISO_BAD_INPUT with line and
 * column, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status view_section_read(iso_context *ctx, const char *path, iso_record **record);

#endif

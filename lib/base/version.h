/* version.h - the version of isoroll. It stands here alone: CMake reads it from this file.
 *
 * The macros are those of the headers that a program was compiled with. iso_version() answers for the library that
 * the program runs with.
 */
#ifndef ISO_BASE_VERSION_H
#define ISO_BASE_VERSION_H

#include "api.h"

#define ISO_VERSION_MAJOR 0
#define ISO_VERSION_MINOR 3
#define ISO_VERSION_PATCH 0

/* "MAJOR.MINOR.PATCH" */
#define ISO_VERSION ISO_VERSION_JOIN(ISO_VERSION_MAJOR, ISO_VERSION_MINOR, ISO_VERSION_PATCH)
#define ISO_VERSION_JOIN(major, minor, patch) ISO_VERSION_WORDS(major, minor, patch)
#define ISO_VERSION_WORDS(major, minor, patch) #major "." #minor "." #patch

ISO_C_BEGIN

/* The version of the library that runs, such as "0.3.0". */
ISO_API const char *iso_version(void);

ISO_C_END

#endif

/* version.c - returns the version of the library. */
#include "base/version.h"

const char *iso_version(void)
{
    return ISO_VERSION;
}

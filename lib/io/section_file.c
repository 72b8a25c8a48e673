/* section_file.c - the calls of section_file.h in a build without HDF5. Otherwise they are in hdf5_section.c. */
#include "io/section_file.h"

#ifndef ISO_HDF5
bool iso_section_file_is_hdf5(const char *path)
{
    (void)path;
    return false;
}

iso_status iso_section_file_read_hdf5(iso_context *ctx, const char *path, iso_record **record)
{
    *record = NULL;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "'%s': this build has no HDF5 (.h5), use CSV", path);
}
#endif

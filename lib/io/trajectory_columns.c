/* trajectory_columns.c - what the readers of all formats share: the columns of a file's header.
 *
 * It stands below the readers (csv_reader.c, hdf5_reader.c), and these stand below trajectory.c, which chooses one.
 */
#include "io/trajectory_impl.h"

iso_status iso_trajectory_name_columns(iso_context *ctx, iso_trajectory_reader *r, size_t count,
                                       const char *const names[])
{
    const char *key, *value;
    iso_record *named;
    iso_status status = iso_record_create(ctx, count, names, &named);
    for (size_t i = 0; status == ISO_OK && iso_record_line(r->header, i, &key, &value); i++)
        status = iso_record_set(ctx, named, key, value);
    iso_record_free(status == ISO_OK ? r->header : named);
    if (status == ISO_OK) r->header = named;
    return status;
}

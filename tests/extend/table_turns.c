/* table_turns.c - a table of a new kind: three rows, written as CSV and as HDF5. */
#include <isoroll/isoroll.h>

int main(int count, char **paths)
{
    static const char *const names[] = {"number", "angle"}; /* of the turn, from 1; by which it goes on, rad */
    iso_context *ctx = iso_context_create();
    iso_record *r = NULL;
    iso_status status = iso_record_create(ctx, 2, names, &r);
    if (status == ISO_OK) iso_record_set_kind(r, "turns");
    for (int i = 1; i <= 3 && status == ISO_OK; i++) status = iso_record_add(ctx, r, 1, (double[]){i, 0.5 / i});
    for (int i = 1; i < count && status == ISO_OK; i++) status = iso_table_write(ctx, paths[i], r);
    iso_record_free(r);
    iso_context_free(ctx);
    return status != ISO_OK;
}

/* table_turns.c - a table of a new kind: three rows, written as CSV and as HDF5. */
#include "base/field.h"
#include "io/table.h"

typedef struct turn {
    double number, angle;
} turn;

static const iso_field turn_fields[] = {ISO_MEMBER(turn, "number", number, "", "of the turn, from 1"),
                                        ISO_MEMBER(turn, "angle", angle, "rad", "by which it goes on"),
                                        ISO_FIELD_END};

int main(int count, char **paths)
{
    iso_context *ctx = iso_context_create();
    iso_record *r = NULL;
    iso_status status = iso_columns_create(ctx, turn_fields, &r);
    if (status == ISO_OK) iso_record_set_kind(r, "turns");
    for (int i = 1; i <= 3 && status == ISO_OK; i++)
        status = iso_columns_append(ctx, turn_fields, &(turn){i, 0.5 / i}, r);
    for (int i = 1; i < count && status == ISO_OK; i++) status = iso_table_write(ctx, paths[i], r);
    iso_record_free(r);
    iso_context_free(ctx);
    return status != ISO_OK;
}

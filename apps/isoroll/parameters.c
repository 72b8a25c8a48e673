#include "parameters.h"

#include <math.h>
#include <string.h>

iso_status parameters_of_file(iso_context *ctx, const options *o, iso_record *record, iso_params *params)
{
    iso_status status = ISO_OK;
    if (!isnan(o->k)) status = iso_record_set_numbers(ctx, record, "k", 1, &o->k);
    if (status == ISO_OK && !isnan(o->J[0])) status = iso_record_set_numbers(ctx, record, "J", 3, o->J);
    if (status == ISO_OK && !isnan(o->h)) status = iso_record_set_numbers(ctx, record, "h", 1, &o->h);
    if (status == ISO_OK && !isnan(o->eps)) status = iso_record_set_numbers(ctx, record, "eps", 1, &o->eps);
    if (status == ISO_OK) status = iso_record_params(ctx, record, params);
    return status;
}

iso_status name_the_file(iso_context *ctx, const options *o, iso_status status)
{
    const char *name = strcmp(o->file, "-") == 0 ? "<stdin>" : o->file;
    const char *message = iso_context_message(ctx);
    if (strncmp(message, name, strlen(name)) == 0) return status;
    return iso_context_fail(ctx, status, iso_context_field(ctx), "%s: %s", name, message);
}

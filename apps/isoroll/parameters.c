/* parameters.c - k, J and eps of a trajectory file: from its own lines, or from the options (see parameters.h). */
#include "parameters.h"

const char *file_option_given(const file_options *o)
{
    const iso_file_parameters *a = &o->added;
    if (!isnan(a->k)) return "k";
    if (!isnan(a->J[0])) return "J";
    if (!isnan(a->eps)) return "eps";
    if (!isnan(a->h)) return "h";
    if (a->row_tolerance != ISO_ROW_TOLERANCE) return "row-tolerance";
    if (o->scene) return "scene";
    return o->columns ? "columns" : NULL;
}

iso_status parameters_of_file(iso_context *ctx, const file_options *o, iso_record *record, iso_params *params)
{
    iso_scene scene;
    const iso_status status = o->scene ? iso_scene_load(ctx, o->scene, &scene) : ISO_OK;
    return status == ISO_OK ? iso_file_parameters_apply(ctx, &o->added, o->scene ? &scene : NULL, record, params)
                            : status;
}

iso_status name_the_file(iso_context *ctx, const char *file, iso_status status)
{
    const bool named = status == ISO_OK || status == ISO_BAD_ARGUMENT || status == ISO_FILE_TROUBLE ||
                       status == ISO_CLOSED_PIPE || iso_context_has_place(ctx);
    if (named) return status;
    return iso_context_fail(ctx, status, iso_context_about(ctx), "%s: %s", iso_text_name(file),
                            iso_context_message(ctx));
}

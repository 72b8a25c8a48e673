/* parameters.c - k, J and eps of a trajectory file: from its own lines, or from the options (see parameters.h). */
#include "parameters.h"

#include <math.h>
#include <string.h>

/* Makes what an option says a line of the record. If the file has that line already, it must say the same. */
static iso_status set_line(iso_context *ctx, iso_record *record, const char *key, size_t count, const double values[])
{
    double said[3];
    iso_status status;
    if (isnan(values[0])) return ISO_OK;
    const bool there = iso_record_get_numbers(ctx, record, key, count, said, &status);
    if (status != ISO_OK) return status;
    for (size_t i = 0; there && i < count; i++)
        if (said[i] != values[i])
            return iso_context_fail(ctx, ISO_BAD_INPUT, key, "--%s contradicts the file, which says '# %s: %s'", key,
                                    key, iso_record_get(record, key));
    return iso_record_set_numbers(ctx, record, key, count, values);
}

/* Takes from a scene what the file does not say: k, J and D, the effects that act, a point's eps. */
static iso_status set_scene(iso_context *ctx, const char *path, iso_record *record)
{
    iso_scene scene;
    iso_status status = iso_scene_read(ctx, path, &scene);
    if (status != ISO_OK) return status;
    const iso_effects effects = iso_scene_acting(&scene);
    const double eps = scene.start.model == ISO_POINT ? scene.start.eps : NAN;
    if (!iso_record_get(record, "k")) status = iso_record_set_numbers(ctx, record, "k", 1, &scene.params.k);
    if (status == ISO_OK && !iso_record_get(record, "J"))
        status = iso_record_set_numbers(ctx, record, "J", 3, scene.params.J);
    if (status == ISO_OK && scene.params.D > 0 && !iso_record_get(record, "D"))
        status = iso_record_set_numbers(ctx, record, "D", 1, &scene.params.D);
    if (status == ISO_OK && !isnan(eps) && !iso_record_get(record, "eps") && !iso_record_get(record, "h"))
        status = iso_record_set_numbers(ctx, record, "eps", 1, &eps);
    if (status == ISO_OK && !iso_record_get(record, "effects"))
        status = iso_record_describe_effects(ctx, record, &effects);
    return status;
}

iso_status parameters_of_file(iso_context *ctx, const file_options *o, iso_record *record, iso_params *params)
{
    if (!isnan(o->h) && !isnan(o->eps))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "eps",
                                "--h and --eps say the same thing: leave one of them out");
    iso_record_set_row_tolerance(record, o->row_tolerance);
    iso_status status = set_line(ctx, record, "k", 1, &o->k);
    if (status == ISO_OK) status = set_line(ctx, record, "J", 3, o->J);
    if (status == ISO_OK && o->scene) status = set_scene(ctx, o->scene, record);
    if (status == ISO_OK) status = set_line(ctx, record, "h", 1, &o->h);
    if (status == ISO_OK) status = set_line(ctx, record, "eps", 1, &o->eps);
    return status == ISO_OK ? iso_record_params(ctx, record, params) : status;
}

iso_status name_the_file(iso_context *ctx, const char *file, iso_status status)
{
    const bool named = status == ISO_OK || status == ISO_BAD_ARGUMENT || status == ISO_FILE_TROUBLE ||
                       status == ISO_CLOSED_PIPE || iso_context_has_place(ctx);
    if (named) return status;
    return iso_context_fail(ctx, status, iso_context_about(ctx), "%s: %s", iso_text_name(file),
                            iso_context_message(ctx));
}

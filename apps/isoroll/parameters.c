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

/* Makes numbers (NAN: none) a line, if the record has none of that key. */
static iso_status add_line(iso_context *ctx, iso_record *record, const char *key, size_t count, const double values[])
{
    if (isnan(values[0]) || iso_record_get(record, key)) return ISO_OK;
    return iso_record_set_numbers(ctx, record, key, count, values);
}

/* Takes from a scene what the file does not say: k, J and D, the effects that act, a point's eps. */
static iso_status set_scene(iso_context *ctx, const char *path, iso_record *record)
{
    iso_scene scene;
    ISO_TRY(iso_scene_read(ctx, path, &scene));
    const iso_effects effects = iso_scene_acting(&scene);
    const bool coupled = scene.start.model == ISO_POINT && !iso_record_get(record, "h");
    const double D = scene.params.D > 0 ? scene.params.D : (double)NAN, eps = coupled ? scene.start.eps : (double)NAN;
    ISO_TRY(add_line(ctx, record, "k", 1, &scene.params.k));
    ISO_TRY(add_line(ctx, record, "J", 3, scene.params.J));
    ISO_TRY(add_line(ctx, record, "D", 1, &D));
    ISO_TRY(add_line(ctx, record, "eps", 1, &eps));
    return iso_record_get(record, "effects") ? ISO_OK : iso_record_describe_effects(ctx, record, &effects);
}

iso_status parameters_of_file(iso_context *ctx, const file_options *o, iso_record *record, iso_params *params)
{
    if (!isnan(o->h) && !isnan(o->eps))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "eps",
                                "--h and --eps say the same thing: leave one of them out");
    iso_record_set_row_tolerance(record, o->row_tolerance);
    ISO_TRY(set_line(ctx, record, "k", 1, &o->k));
    ISO_TRY(set_line(ctx, record, "J", 3, o->J));
    if (o->scene) ISO_TRY(set_scene(ctx, o->scene, record));
    ISO_TRY(set_line(ctx, record, "h", 1, &o->h));
    ISO_TRY(set_line(ctx, record, "eps", 1, &o->eps));
    return iso_record_params(ctx, record, params);
}

iso_status name_the_file(iso_context *ctx, const char *file, iso_status status)
{
    const bool named = status == ISO_OK || status == ISO_BAD_ARGUMENT || status == ISO_FILE_TROUBLE ||
                       status == ISO_CLOSED_PIPE || iso_context_has_place(ctx);
    if (named) return status;
    return iso_context_fail(ctx, status, iso_context_about(ctx), "%s: %s", iso_text_name(file),
                            iso_context_message(ctx));
}

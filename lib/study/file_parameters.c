/* file_parameters.c - k, J and eps of a trajectory: from its own lines, from options, from a scene (see
 * file_parameters_impl.h). */
#include "study/file_parameters_impl.h"

#include <string.h>

#include "orbit/description.h"
#include "orbit/orbit_impl.h"

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

/* Where the record has the line, it must say what the scene has, to the digits of its rows. */
static iso_status check_scene(iso_context *ctx, const iso_record *record, const char *key, size_t count,
                              const double values[], const char *who, bool *there)
{
    double said[3];
    iso_status status;
    *there = iso_record_get_numbers(ctx, record, key, count, said, &status);
    for (size_t i = 0; *there && i < count; i++)
        if (!(fabs(said[i] - values[i]) <= iso_record_row_tolerance(record) * fabs(values[i])))
            return ISO_FAIL_INPUT(ctx, "scene", "--scene has %s = %.10g, and %s says '# %s: %s'", key, values[i], who,
                                  key, iso_record_get(record, key));
    return status;
}

static iso_status set_from_scene(iso_context *ctx, iso_record *record, const char *key, size_t count,
                                 const double values[])
{
    bool there;
    ISO_TRY(check_scene(ctx, record, key, count, values, "the file or an option", &there));
    return there ? ISO_OK : iso_record_set_numbers(ctx, record, key, count, values);
}

/* Numbers of effects that both the record and the scene say, such as level.c. An effect that one of them lacks may
 * only observe. */
static iso_status compare_effects(iso_context *ctx, const iso_record *record, const iso_effects *effects)
{
    const char *key, *value;
    iso_record *scene;
    iso_status status = iso_record_create(ctx, 0, NULL, &scene);
    if (status == ISO_OK) status = iso_record_describe_effects(ctx, scene, effects);
    for (size_t i = 0; status == ISO_OK && iso_record_line(scene, i, &key, &value); i++) {
        double number;
        iso_status unused;
        bool there;
        if (!strchr(value, ' ') && iso_record_get_numbers(ctx, scene, key, 1, &number, &unused))
            status = check_scene(ctx, record, key, 1, &number, "the file", &there);
    }
    iso_record_free(scene);
    return status;
}

/* Takes from a scene what the record does not say. */
static iso_status set_scene(iso_context *ctx, const iso_scene *scene, iso_record *record)
{
    const iso_effects effects = iso_scene_acting(scene);
    const bool point = scene->start.model == ISO_POINT && !isnan(scene->start.eps);
    ISO_TRY(set_from_scene(ctx, record, "k", 1, &scene->params.k));
    ISO_TRY(set_from_scene(ctx, record, "J", 3, scene->params.J));
    if (scene->params.D > 0) ISO_TRY(set_from_scene(ctx, record, "D", 1, &scene->params.D));
    if (point && (iso_record_get(record, "eps") || !iso_record_get(record, "h")))
        ISO_TRY(set_from_scene(ctx, record, "eps", 1, &scene->start.eps));
    if (!iso_record_get(record, "effects")) return iso_record_describe_effects(ctx, record, &effects);
    return compare_effects(ctx, record, &effects);
}

iso_status iso_file_parameters_apply(iso_context *ctx, const iso_file_parameters *o, const iso_scene *scene,
                                     iso_record *record, iso_params *params)
{
    if (!isnan(o->h) && !isnan(o->eps))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "eps",
                                "--h and --eps say the same thing: leave one of them out");
    iso_record_set_row_tolerance(record, o->row_tolerance);
    iso_status status = set_line(ctx, record, "k", 1, &o->k);
    if (status == ISO_OK) status = set_line(ctx, record, "J", 3, o->J);
    if (status == ISO_OK && scene) status = set_scene(ctx, scene, record);
    if (status == ISO_OK) status = set_line(ctx, record, "h", 1, &o->h);
    if (status == ISO_OK) status = set_line(ctx, record, "eps", 1, &o->eps);
    return status == ISO_OK ? iso_record_params(ctx, record, params) : status;
}

double iso_stated_energy(iso_context *ctx, const iso_record *record, const iso_units *units, const char *key,
                         iso_status *status)
{
    double x;
    const bool eps = strcmp(key, "eps") == 0;
    if (!iso_record_get_numbers(ctx, record, key, 1, &x, status)) return NAN;
    x /= iso_unit(units, eps ? iso_dimension_eps : iso_dimension_h);
    return eps ? iso_energy(&units->own, x) : x;
}

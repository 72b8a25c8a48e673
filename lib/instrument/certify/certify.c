/* certify.c - what a scene must be to be enclosed, and its times (certify_impl.h). */
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "instrument/certify/certify_impl.h"
#include "orbit/orbit_impl.h"

#define WHAT "--certify encloses the free ball, with a rotor or on a level"

/* A time as it is written; its double holds up to 15 digits. */
static iso_status read_time(iso_context *ctx, const char *key, double x, iso_rational *r)
{
    *r = (iso_rational){0, 1};
    if (x == 0 || iso_rational_of(x, r)) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, key, "--certify takes times exactly: write '%s' with at most 15 digits", key);
}

static iso_status read_times(iso_context *ctx, iso_certify_problem *p)
{
    const iso_scene *scene = p->scene;
    ISO_TRY(iso_scene_check_times(ctx, scene));
    const iso_literal *end = iso_literal_find(p->literals, "end");
    double x;
    if (end && iso_number_read(end->text[0], strlen(end->text[0]), &x) && x == scene->end)
        p->end_text = end->text[0]; /* else an option has changed it */
    p->end = (iso_rational){0, 1};
    if (!p->end_text || scene->step == 0) ISO_TRY(read_time(ctx, "end", scene->end, &p->end));
    if (scene->step > 0) return read_time(ctx, "step", scene->step, &p->step);
    p->step = (iso_rational){llabs(p->end.top), 100 * p->end.below}; /* as iso_scene_time */
    return ISO_OK;
}

static iso_status check_scene(iso_context *ctx, const iso_scene *scene)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        if (scene->effects.on[e] && e != ISO_ROTOR && e != ISO_LEVEL && e != ISO_CLOCK)
            return ISO_FAIL_INPUT(ctx, iso_effect_list[e]->name, WHAT ": remove '%s'", iso_effect_list[e]->name);
    if (scene->columns > 0)
        return ISO_FAIL_INPUT(ctx, "columns",
                              "--certify writes all clocks and whole states: remove 'columns' (or use --as)");
    if (scene->backend == ISO_BACKEND_EXACT)
        return ISO_FAIL_ARGUMENT(ctx, "backend",
                                 "--certify: the closed solution is not enclosed: use backend ball, point or auto");
    return ISO_OK;
}

iso_status iso_certify(iso_context *ctx, const iso_scene *scene, const iso_literals *literals,
                       const iso_certify_options *options, const iso_certify_sink *sink, iso_certify_result *result)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_certify_problem p = {.scene = scene, .literals = literals, .options = *options};
    *result = (iso_certify_result){.asked = 0};
    ISO_TRY(iso_certify_is_possible(ctx));
    if (options->digits < 1 || options->digits > ISO_MOST_CERTIFIED_DIGITS)
        return ISO_FAIL_ARGUMENT(ctx, "", "--digits %d: expected a whole number from 1 to %d", options->digits,
                                 ISO_MOST_CERTIFIED_DIGITS);
    if (options->work_digits &&
        (options->work_digits < options->digits || options->work_digits > ISO_MOST_WORK_DIGITS))
        return ISO_FAIL_ARGUMENT(ctx, "", "--work-digits %d: expected a whole number from %d (--digits) to %d",
                                 options->work_digits, options->digits, ISO_MOST_WORK_DIGITS);
    ISO_TRY(check_scene(ctx, scene));
    ISO_TRY(read_times(ctx, &p));
    p.backend = scene->backend == ISO_BACKEND_AUTO ? scene->start.model : (iso_model_kind)scene->backend;
    result->asked = iso_scene_rows(scene);
    result->backend = (iso_backend)p.backend;
    return iso_certify_orbit(ctx, &p, sink, result);
}

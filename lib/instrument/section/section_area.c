/* section_area.c - whether the return map keeps the area dL dl: det D of each orbit, by the deviations that crossings
 * carry (orbit/crossings.h).
 *
 * D is the derivative of the map from the start to a return, so det D of n returns is a product of n determinants. An
 * error d of a deviation, relative to its length, makes an error d exp(growth of d1 + growth of d2) of det D: where
 * two deviations have grown far along one direction, their area is a difference of large numbers. So only the
 * first returns of a chaotic orbit are used.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "instrument/section/section_impl.h"
#include "model/model_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"

/* An error of a deviation after n turns, in units of n and of the tolerance; det D is computed while its bound is below
 * LARGEST; beyond so many bounds it is not kept. */
static const double ERRORS = 300, LARGEST = 1e-3, BEYOND = 10;

/* Effects that have states of their own move in more than the four dimensions of (omega, n). Where the energy is
 * neither constant nor lost, D compares areas on levels of different energies, and says nothing of the measure (10),
 * which has four dimensions. */
static iso_status check_effects(const iso_section_walk *w)
{
    const iso_model *m = iso_orbit_model(w->orbit);
    const iso_effects effects = iso_orbit_effects(w->orbit);
    if (iso_effects_twist(&effects))
        return ISO_FAIL_INPUT(w->ctx, "twist", "with a twist the ball's motion has no section of two dimensions");
    const iso_effect *changing = iso_effects_changing_energy(&m->problem);
    if (changing)
        return ISO_FAIL_INPUT(w->ctx, changing->name,
                              "'%s' may change the energy: then a section has three dimensions, and no area",
                              changing->name);
    if (m->moving == ISO_STATE) {
        iso_sample start;
        ISO_TRY(iso_orbit_at(w->orbit, 0, &start));
        if (largest(w->model[0] == ISO_POINT ? start.point : start.ball) > 0) return ISO_OK;
        return iso_refuse_start_at_rest(w->ctx, &w->scene->start, "deviations have no size");
    }
    const iso_effect *effect = iso_effects_breaking(&effects);
    return ISO_FAIL_INPUT(w->ctx, effect ? effect->name : "effects",
                          "'%s' moves more than omega and n: a section has more than two dimensions, and no area",
                          effect ? effect->name : "an effect");
}

/* The walk by one model. */
typedef struct area_walk {
    iso_section_walk w;
    int model;
    void (*progress)(void *data, double part);
    void *data;
    iso_section_area *orbit; /* of this model */
} area_walk;

static iso_status visit(void *user, size_t i, const iso_walk_stop *stop)
{
    const area_walk *walk = user;
    const iso_crossing *c = stop->crossing[0];
    iso_section_area *a = &walk->orbit[i];
    const double grown = exp(fmax(0, c->growth[0]) + fmax(0, c->growth[1]));
    const double bound = ERRORS * fmax(walk->w.options.tolerance, 1e-15) * (double)(a->turns + 1) * grown;
    const double off = fabs(c->determinant - 1);
    if (!(bound < LARGEST) || isnan(off)) return ISO_OK;
    a->turns++;
    if (a->turns > 1 && off * a->bound <= a->worst * bound) return ISO_OK; /* another return says more */
    a->worst = off;
    a->bound = bound;
    return ISO_OK;
}

static void note_failure(void *user, size_t i, int model, iso_status status, const char *why)
{
    const area_walk *a = user;
    (void)model, (void)status, (void)why;
    a->orbit[i].why = "it did not get to the end";
}

static void show_progress(void *user, double part)
{
    const area_walk *a = user;
    if (a->progress) a->progress(a->data, (a->model + part) / a->w.models);
}

iso_status iso_section_areas_find(iso_context *ctx, const iso_scene *scene, const iso_section_options *options,
                                  void (*progress)(void *data, double part), void *data, iso_section_areas *areas)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_section_result result;
    area_walk a = {.w = {.result = &result, .areas = true}, .progress = progress, .data = data};
    *areas = (iso_section_areas){.count = 0};
    iso_status status = iso_section_begin(&a.w, ctx, scene, options);
    if (status == ISO_OK) status = check_effects(&a.w);
    if (status == ISO_OK && !(areas->orbit = calloc(result.orbits * (size_t)a.w.models, sizeof *areas->orbit)))
        status = iso_context_no_memory(ctx, "areas");
    areas->returns = status == ISO_OK && iso_section_has_returns(&a.w);
    for (; a.model < a.w.models && status == ISO_OK; a.model++) {
        iso_walk walk = iso_section_plan(&a.w, a.model);
        a.orbit = areas->orbit + areas->count;
        for (size_t i = 0; i < result.orbits; i++)
            a.orbit[i] = (iso_section_area){.orbit = i, .model = a.w.model[a.model]};
        walk.user = &a, walk.visit = visit, walk.failed_by = note_failure, walk.progress = show_progress;
        status = iso_walk_go(&walk);
        areas->count += walk.begun;
        if (!*areas->words) memcpy(areas->words, walk.text, sizeof areas->words);
    }
    /* where an effect takes energy the area is lost as well, though perhaps by less than can be seen */
    const bool lost = areas->count > 0 && iso_effects_taking_energy(&iso_orbit_model(a.w.orbit)->problem);
    for (iso_section_area *o = areas->orbit; o < areas->orbit + areas->count; o++)
        o->kept = o->turns > 0 && o->worst > BEYOND * o->bound    ? "not kept"
                  : o->turns > 0 && o->worst <= o->bound && !lost ? "kept"
                                                                  : "undecided";
    iso_orbit_free(a.w.orbit);
    return status;
}

void iso_section_areas_free(iso_section_areas *areas)
{
    free(areas->orbit);
    *areas = (iso_section_areas){.count = 0};
}

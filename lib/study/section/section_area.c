/* section_area.c - whether the return map keeps the area dL dl: det D of each orbit, by the deviations that crossings
 * carry (orbit/crossings.h).
 *
 * D is the derivative of the map from the start to a return, so det D of n returns is a product of n determinants. An
 * error d of a deviation, relative to its length, makes an error d exp(growth of d1 + growth of d2) of det D: where
 * two deviations have grown far along one direction, their area is a difference of large numbers. So only the
 * first returns of a chaotic orbit are used.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/orbit_impl.h"
#include "study/section/section_impl.h"
#include "study/study_impl.h"

/* An error of a deviation after n turns, in units of n and of the tolerance; det D is computed while its bound is below
 * LARGEST; beyond so many bounds it is not kept. */
static const double ERRORS = 300, LARGEST = 1e-3, BEYOND = 10;

static void add_return(iso_section_area *a, const iso_crossing *c, double tolerance)
{
    const double grown = exp(fmax(0, c->growth[0]) + fmax(0, c->growth[1]));
    const double bound = ERRORS * fmax(tolerance, 1e-15) * (double)(a->turns + 1) * grown;
    const double off = fabs(c->determinant - 1);
    if (!(bound < LARGEST) || isnan(off)) return;
    a->turns++;
    /* the return that says most */
    if (a->turns > 1 && off * a->bound <= a->worst * bound) return;
    a->worst = off;
    a->bound = bound;
}

/* lost: an effect takes energy. Then the area is lost as well, though perhaps by less than can be seen. */
static const char *verdict_of(const iso_section_area *a, bool lost)
{
    if (a->turns == 0) return "undecided";
    return a->worst > BEYOND * a->bound ? "not kept" : a->worst <= a->bound && !lost ? "kept" : "undecided";
}

/* Effects that have states of their own move in more than the four dimensions of (omega, n). Where the energy is neither
 * constant nor lost, D compares areas on levels of different energies, and says nothing of the measure (10), which has
 * four dimensions. */
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

/* All returns of one group by one model. */
static iso_status follow(iso_section_walk *w, int m, void (*progress)(void *data, double part), void *data,
                         iso_section_areas *areas)
{
    iso_section_area *a = &areas->orbit[areas->count];
    const size_t most = w->options.crossings;
    iso_status status = ISO_OK;
    for (size_t i = 0; i < w->members; i++) a[i] = (iso_section_area){.orbit = w->first + i, .model = w->model[m]};
    for (size_t found = 0, each; found < most && status == ISO_OK; found += each) {
        each = most - found < w->slice ? most - found : w->slice;
        status = iso_crossings_go(w->crossings[m], NULL, each, w->crossing[m], NULL, w->done[m], w->status[m]);
        for (size_t i = 0; i < w->members && status != ISO_NO_MEMORY; i++)
            for (size_t j = 0; j < w->done[m][i]; j++)
                add_return(&a[i], &w->crossing[m][each * i + j], w->options.tolerance);
        const double part = ((double)m + (double)(found + each) / (double)most) / w->models;
        if (progress) progress(data, ((double)w->first + part * (double)w->members) / (double)w->result->orbits);
        if (status == ISO_STOPPED || status == ISO_NO_MEMORY) break;
        status = ISO_OK; /* an orbit that ends has its words; the others go on */
    }
    const bool lost = iso_effects_taking_energy(&iso_orbit_model(w->orbit)->problem) != NULL;
    for (size_t i = 0; i < w->members; i++) {
        a[i].kept = verdict_of(&a[i], lost);
        if (w->status[m][i] == ISO_OK || w->status[m][i] == ISO_STOPPED) continue;
        a[i].why = "it did not get to the end";
        if (!*areas->words)
            snprintf(areas->words, sizeof areas->words, "orbit %zu: %s", a[i].orbit,
                     iso_crossings_why(w->crossings[m], i));
    }
    areas->count += w->members;
    return status;
}

iso_status iso_section_areas_find(iso_context *ctx, const iso_scene *scene, const iso_section_options *options,
                                  void (*progress)(void *data, double part), void *data, iso_section_areas *areas)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_section_result result;
    iso_section_walk w = {.result = &result, .areas = true};
    *areas = (iso_section_areas){.count = 0};
    iso_status status = iso_section_begin(&w, ctx, scene, options);
    if (status == ISO_OK) status = check_effects(&w);
    if (status == ISO_OK && !(areas->orbit = calloc(result.orbits * (size_t)w.models, sizeof *areas->orbit)))
        status = iso_context_no_memory(ctx, "areas");
    areas->returns = status == ISO_OK && iso_section_has_returns(&w);
    while (status == ISO_OK) {
        for (int m = 0; m < w.models && status == ISO_OK; m++) status = follow(&w, m, progress, data, areas);
        iso_section_close_group(&w);
        w.first += w.members;
        if (status != ISO_OK || w.first >= result.orbits) break;
        status = iso_section_open_group(&w);
    }
    iso_section_end(&w);
    return status;
}

void iso_section_areas_free(iso_section_areas *areas)
{
    free(areas->orbit);
    *areas = (iso_section_areas){.count = 0};
}

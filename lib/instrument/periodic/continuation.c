/* continuation.c - follows symmetric periodic orbits along k or a moment, see continuation.h: the call, the two
 * directions of a branch, and the branches that are switched to. */
#define _GNU_SOURCE /* functions of _Float128 */
#include "instrument/periodic/continuation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/context_impl.h"
#include "base/math_impl.h"
#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/pool_impl.h"
#include "instrument/periodic/continuation_impl.h"
#include "study/study_impl.h"

enum { MOST_STEPS = 2000 /* of a branch in each direction */ };
#define NEAR_END 4e-3 /* of the line, in u: here a collision is foretold */

ISO_NAMES(iso_branch_kind_name, int, "fold", "period doubling", "symmetry breaking", "collision", "torus", "end",
          "failure", "touch", "undecided")

/* --- one direction ---------------------------------------------------------------------------------------------- */

static iso_status add_point(const iso_continuation *f, iso_branch *b, const iso_continuation_point *at, double arc)
{
    const iso_branch_point point = iso_continuation_read(at, arc);
    return iso_periodic_append(f->ctx, &b->point, &b->points, &point, sizeof point);
}

static iso_status fail_at(const iso_continuation *f, iso_branch *b, const iso_continuation_point *at, double arc,
                          const char *why)
{
    iso_branch_event e = {.kind = ISO_BRANCH_FAILURE, .at = iso_continuation_read(at, arc), .axis = -1};
    snprintf(e.text, sizeof e.text, "%s at %s = %.12g, l = %.9g, x = %.9g", why, iso_vary_name((int)f->options.vary),
             at->value, e.at.l, e.at.x);
    return iso_continuation_add_event(f, b, &e);
}

/* At the end of the range: the orbit at exactly this value. */
static iso_status end_at(const iso_continuation *f, iso_branch *b, const iso_continuation_point *last, double value,
                         double arc)
{
    iso_continuation_point at = *last;
    double u = last->u + (value / f->width - last->v) * last->tangent[0] / last->tangent[1];
    bool there = false;
    for (int i = 0; i < 8 && !there; i++) {
        if (!iso_continuation_evaluate(f, u, value / f->width, false, &at)) break;
        u -= at.off / at.D[1][0];
        there = fabs(at.off / at.D[1][0]) < 1e-11;
    }
    if (!there) return fail_at(f, b, last, arc, "the last step to the end of the range failed");
    at.value = value;
    iso_branch_event e = {.kind = ISO_BRANCH_END, .at = iso_continuation_read(&at, arc), .axis = -1};
    snprintf(e.text, sizeof e.text, "the end of the range");
    ISO_TRY(add_point(f, b, &at, arc));
    return iso_continuation_add_event(f, b, &e);
}

/* What is done with the point `next`, ds behind `at`. *over: the branch ends there. */
static iso_status accept(const iso_continuation *f, iso_branch *b, const iso_continuation_point *at,
                         const iso_continuation_point *next, double ds, double arc, bool *over)
{
    iso_branch_event e;
    *over = true;
    if (next->value < f->options.from) return end_at(f, b, at, f->options.from, arc + ds);
    if (next->value > f->options.to) return end_at(f, b, at, f->options.to, arc + ds);
    const bool near = fmin(at->u, next->u) < NEAR_END || fmax(at->u, next->u) > ISO_PI / 2 - NEAR_END;
    if (near && iso_continuation_collision(f, at, next, &e)) {
        e.at.arc = arc + ds;
        return iso_continuation_add_event(f, b, &e);
    }
    if (next->u < 0 || next->u > ISO_PI / 2) return fail_at(f, b, at, arc, "too near a rotation to go on");
    *over = false;
    ISO_TRY(iso_continuation_events(f, b, at, next, ds, arc));
    return add_point(f, b, next, arc + ds);
}

static iso_status stop_at(const iso_continuation *f, iso_branch *b, const iso_continuation_point *at, double arc)
{
    ISO_TRY(fail_at(f, b, at, arc, "stopped on request"));
    return iso_context_stopped(f->ctx);
}

/* Why no step can be taken from `at`. */
static const char *why_stuck(const iso_continuation *f, const iso_continuation_point *at)
{
    iso_params p;
    double energy, u[2];
    iso_periodic_map map;
    if (!iso_continuation_params(f, (at->v + 1e-3 * at->tangent[1]) * f->width, &p, &energy))
        return "another axis gets the largest (k > 0) or least (k < 0) moment, or a moment becomes 0,";
    iso_periodic_map_prepare(f->ctx, &p, energy, 1, &map);
    const bool open = iso_symmetry_line_range(&map, f->line, u);
    if (!open || at->u < u[0] + NEAR_END || at->u > u[1] - NEAR_END)
        return "too near an oscillation in a principal plane, where the point rests, to go on";
    return "steps became too small";
}

/* From `at` along its tangent. */
static iso_status go(const iso_continuation *f, iso_branch *b, iso_continuation_point at)
{
    double ds = f->options.longest / 4, arc = 0;
    for (int step = 0; step < MOST_STEPS; step++) {
        iso_continuation_point next;
        int steps;
        bool over;
        /* slowly towards the ends, which are singular */
        const double room = fmin(at.u, ISO_PI / 2 - at.u);
        double taken = fmin(ds, fmax(room / 2, NEAR_END / 4) / (fabs(at.tangent[0]) + 1e-9));
        while (!iso_continuation_step(f, &at, taken, &next, &steps)) {
            if (!iso_context_goes_on(f->ctx)) return stop_at(f, b, &at, arc);
            taken /= 2;
            if (taken < 1e-7) return fail_at(f, b, &at, arc, why_stuck(f, &at));
        }
        const iso_status status = accept(f, b, &at, &next, taken, arc, &over);
        if (status != ISO_OK || over) return status;
        at = next;
        arc += taken;
        ds = steps <= 5 ? fmin(1.4 * taken, f->options.longest) : taken;
    }
    return fail_at(f, b, &at, arc, "the limit of steps was reached");
}

/* --- a branch --------------------------------------------------------------------------------------------------- */

/* What was found backwards comes first, in the opposite order, with negative arcs. */
static iso_status join(const iso_continuation *f, iso_branch *back, const iso_branch *forth, iso_branch *b)
{
    for (size_t i = back->points; i-- > 0;) {
        back->point[i].arc = -back->point[i].arc;
        ISO_TRY(iso_periodic_append(f->ctx, &b->point, &b->points, &back->point[i], sizeof *b->point));
    }
    for (size_t i = 0; i < forth->points; i++)
        ISO_TRY(iso_periodic_append(f->ctx, &b->point, &b->points, &forth->point[i], sizeof *b->point));
    for (size_t i = back->events; i-- > 0;) {
        back->event[i].at.arc = -back->event[i].at.arc;
        ISO_TRY(iso_continuation_add_event(f, b, &back->event[i]));
    }
    for (size_t i = 0; i < forth->events; i++) ISO_TRY(iso_continuation_add_event(f, b, &forth->event[i]));
    return ISO_OK;
}

static void free_branch(iso_branch *b)
{
    free(b->point);
    free(b->event);
}

static iso_status follow_both_ways(const iso_continuation *f, double u, double value, iso_branch *b)
{
    iso_branch side[2] = {{0}, {0}};
    iso_continuation_point at = {.tangent = {0, 1}};
    iso_status status = ISO_OK;
    if (!iso_continuation_evaluate(f, u, value / f->width, true, &at)) {
        at.u = u, at.value = value;
        return iso_context_goes_on(f->ctx) ? fail_at(f, b, &at, 0, "the orbit could not be computed")
                                           : stop_at(f, b, &at, 0);
    }
    iso_continuation_turn(&at, NULL);
    for (int i = 0; i < 2 && (status == ISO_OK || status == ISO_STOPPED); i++) {
        if (i == 1) status = add_point(f, &side[1], &at, 0);
        const double sign = i == 0 ? -1 : 1;
        iso_continuation_point start = at;
        for (int d = 0; d < 2; d++) start.tangent[d] *= sign;
        const iso_status gone = go(f, &side[i], start);
        if (gone != ISO_OK) status = gone;
    }
    const iso_status joined = join(f, &side[0], &side[1], b);
    free_branch(&side[0]);
    free_branch(&side[1]);
    return joined == ISO_OK ? status : joined;
}

/* The branch through (u, value), which becomes the last of the list. */
static iso_status follow_branch(const iso_continuation *f, double u, double value, int parent, iso_continuations *out)
{
    iso_branch b = {.line = f->line, .period = f->period, .parent = parent};
    const iso_status status = follow_both_ways(f, u, value, &b),
                     kept = iso_periodic_append(f->ctx, &out->branch, &out->count, &b, sizeof b);
    if (kept != ISO_OK) free_branch(&b);
    return kept == ISO_OK ? status : kept;
}

/* An orbit of the list, and what branches off from it. */
static iso_status follow_orbit(iso_continuation *f, const iso_periodic_orbit *o, double own, iso_continuations *out)
{
    const size_t i = out->count;
    f->line = o->line;
    f->period = o->period;
    ISO_TRY(follow_branch(f, o->u, own, -1, out));
    for (size_t j = 0; f->options.branches && j < out->branch[i].events; j++) {
        iso_branch_event *e = &out->branch[i].event[j];
        iso_continuation beside;
        double at[2];
        bool found;
        if (e->joins || !(e->kind == ISO_BRANCH_BREAKING || iso_continuation_doubles(e->kind))) continue;
        ISO_TRY(iso_continuation_switch(f, e, &beside, at, &found));
        const size_t used = strlen(e->text);
        if (!found) snprintf(e->text + used, sizeof e->text - used, "; the branch was not found");
        if (found) ISO_TRY(follow_branch(&beside, at[0], at[1], (int)i, out));
    }
    return ISO_OK;
}

/* --- all orbits ------------------------------------------------------------------------------------------------- */

typedef struct crowd {
    const iso_continuation *family;
    const iso_periodic_orbit *orbit;
    double own;
    iso_continuations *of; /* of each orbit */
} crowd;

static bool follow_some(iso_pool_worker *w, void *data, size_t first, size_t count)
{
    const crowd *c = data;
    for (size_t i = first; i < first + count; i++) {
        const iso_continuation_options *o = &c->family->options;
        if (w->asks && o->progress) o->progress(o->data, (double)i / (double)w->all->count);
        iso_continuation f = *c->family;
        f.ctx = w->ctx;
        const iso_status status = follow_orbit(&f, &c->orbit[i], c->own, &c->of[i]);
        if (status == ISO_NO_MEMORY) return false;
        if (status != ISO_OK) break; /* stopped */
    }
    return true;
}

/* What is followed; *own: the scene's value. */
static iso_status prepare(iso_context *ctx, const iso_scene *scene, const iso_continuation_options *options,
                          iso_continuation *f, double *own)
{
    const iso_continuation_options *o = &f->options;
    const double *J = scene->params.J;
    iso_params p;
    double energy;
    *f = (iso_continuation){.ctx = ctx, .options = options ? *options : iso_continuation_defaults()};
    f->base = scene->params;
    f->axis = iso_section_axis(iso_free_point(&scene->params, 1));
    f->width = o->to - o->from;
    ISO_TRY(iso_level_of_scene(ctx, scene, "periodic orbits are followed", &f->level));
    *own = o->vary == ISO_VARY_K       ? scene->params.k
           : o->vary == ISO_VARY_LEVEL ? f->level
           : o->vary == ISO_VARY_RATIO ? (J[1] - J[0]) / (J[2] - J[0])
                                       : J[o->vary - ISO_VARY_J1];
    const char *name = iso_vary_name((int)o->vary);
    if (!(o->from < o->to) || !isfinite(o->to - o->from))
        return ISO_FAIL_ARGUMENT(ctx, "range", "%s from %s to %s: give A:B with A < B", name, ISO_SHORT(o->from),
                                 ISO_SHORT(o->to));
    if (o->vary == ISO_VARY_K && o->from <= 0 && o->to >= 0)
        return ISO_FAIL_ARGUMENT(ctx, "range", "the range %s to %s contains k = 0, where there is no ball",
                                 ISO_SHORT(o->from), ISO_SHORT(o->to));
    if (!(*own >= o->from && *own <= o->to))
        return ISO_FAIL_ARGUMENT(ctx, "range", "the scene has %s = %.12g: the range %s to %s must contain it", name,
                                 *own, ISO_SHORT(o->from), ISO_SHORT(o->to));
    if (o->vary == ISO_VARY_K ||
        (iso_continuation_params(f, o->from, &p, &energy) && iso_continuation_params(f, o->to, &p, &energy)))
        return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "range", "%s from %s to %s leaves the range in which J%d is the %s moment", name,
                             ISO_SHORT(o->from), ISO_SHORT(o->to), f->axis + 1,
                             scene->params.k > 0 ? "largest" : "smallest");
}

iso_status iso_continuation_check(iso_context *ctx, const iso_scene *scene, const iso_continuation_options *options)
{
    iso_continuation f;
    double own;
    return prepare(ctx, scene, options, &f, &own);
}

iso_status iso_continuation_run(iso_context *ctx, const iso_scene *scene, const iso_periodic_orbit orbits[],
                                size_t count, const iso_continuation_options *options, iso_continuations **follow)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_continuation f;
    crowd c = {.family = &f, .orbit = orbits};
    *follow = NULL;
    ISO_TRY(prepare(ctx, scene, options, &f, &c.own));
    for (size_t i = 0; i < count; i++)
        if (orbits[i].line < 0) return ISO_FAIL_INPUT(ctx, "orbit", "an orbit without a symmetry cannot be followed");
    if (count == 0) return ISO_FAIL_INPUT(ctx, "orbit", "no symmetric orbit to follow: the list is empty");
    iso_continuations *out = calloc(1, sizeof *out);
    c.of = calloc(count, sizeof *c.of);
    if (!out || !c.of) return free(out), free(c.of), iso_context_no_memory(ctx, "branches");
    out->vary = f.options.vary;
    iso_pool pool = {.what = "orbit", .count = count, .chunk = 1, .solve = follow_some, .data = &c};
    iso_status status = iso_pool_run(ctx, &pool, iso_pool_threads(f.options.threads, count - 1, 1), NULL);
    for (size_t i = 0; i < count; i++) { /* all branches in one list */
        const int before = (int)out->count;
        for (iso_branch *b = c.of[i].branch; b < c.of[i].branch + c.of[i].count; b++) {
            if (b->parent >= 0) b->parent += before;
            const iso_status kept = iso_periodic_append(ctx, &out->branch, &out->count, b, sizeof *b);
            if (kept != ISO_OK) free_branch(b), status = kept;
        }
        free(c.of[i].branch);
    }
    free(c.of);
    if (status != ISO_OK && status != ISO_STOPPED) iso_continuation_free(out), out = NULL;
    *follow = out;
    return status;
}

void iso_continuation_free(void *follow)
{
    iso_continuations *f = follow;
    if (!f) return;
    for (size_t i = 0; i < f->count; i++) free_branch(&f->branch[i]);
    free(f->branch);
    free(follow);
}

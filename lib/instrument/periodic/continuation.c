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

#define NEAR_END 4e-3 /* of the line, in u: here a collision is foretold */

ISO_NAMES(iso_branch_kind_name, iso_branch_kind, "fold", "period doubling", "symmetry breaking", "collision", "torus",
          "end", "failure", "touch", "undecided")

static double value_of(const iso_params *p, double level, iso_vary vary)
{
    if (vary == ISO_VARY_K) return p->k;
    if (vary == ISO_VARY_LEVEL) return level;
    if (vary == ISO_VARY_RATIO) return (p->J[1] - p->J[0]) / (p->J[2] - p->J[0]);
    return p->J[vary - ISO_VARY_J1];
}

/* --- one direction ---------------------------------------------------------------------------------------------- */

static iso_status add_point(const iso_continuation *f, iso_branch *b, const iso_continuation_point *at, double arc)
{
    if ((b->points & (b->points - 1)) == 0) { /* room for a power of two */
        iso_branch_point *larger = realloc(b->point, 2 * (b->points + 1) * sizeof *larger);
        if (!larger) return iso_context_no_memory(f->ctx, "a branch");
        b->point = larger;
    }
    b->point[b->points++] = iso_continuation_read(at, arc);
    return ISO_OK;
}

static iso_status fail_at(const iso_continuation *f, iso_branch *b, const iso_continuation_point *at, double arc,
                          const char *why)
{
    iso_branch_event e = {.kind = ISO_BRANCH_FAILURE, .at = iso_continuation_read(at, arc), .axis = -1};
    snprintf(e.words, sizeof e.words, "%s at %s = %.12g, l = %.9g, x = %.9g", why,
             iso_vary_name((int)f->options.vary), at->value, e.at.l, e.at.x);
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
        u -= at.off / at.by_u;
        there = fabs(at.off / at.by_u) < 1e-11;
    }
    if (!there) return fail_at(f, b, last, arc, "the last step to the end of the range failed");
    at.value = value;
    iso_branch_event e = {.kind = ISO_BRANCH_END, .at = iso_continuation_read(&at, arc), .axis = -1};
    snprintf(e.words, sizeof e.words, "the end of the range");
    ISO_TRY(add_point(f, b, &at, arc));
    return iso_continuation_add_event(f, b, &e);
}

static bool ends_in_collision(const iso_continuation_point *at, const iso_continuation_point *next)
{
    const double low = fmin(at->u, next->u), high = fmax(at->u, next->u);
    return low < NEAR_END || high > ISO_PI / 2 - NEAR_END;
}

/* What is done with the point `next`, ds behind `at`. *over: the branch ends there. */
static iso_status accept(const iso_continuation *f, iso_branch *b, const iso_continuation_point *at,
                         const iso_continuation_point *next, double ds, double arc, bool *over)
{
    iso_branch_event e;
    *over = true;
    if (next->value < f->options.from) return end_at(f, b, at, f->options.from, arc + ds);
    if (next->value > f->options.to) return end_at(f, b, at, f->options.to, arc + ds);
    if (ends_in_collision(at, next) && iso_continuation_collision(f, at, next, &e)) {
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
    for (long step = 0; step < f->options.most; step++) {
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
    const size_t points = back->points + forth->points, events = back->events + forth->events;
    b->point = malloc((points + 1) * sizeof *b->point);
    b->event = malloc((events + 1) * sizeof *b->event);
    if (!b->point || !b->event) return iso_context_no_memory(f->ctx, "a branch");
    for (size_t i = back->points; i-- > 0;) {
        back->point[i].arc = -back->point[i].arc;
        b->point[b->points++] = back->point[i];
    }
    for (size_t i = 0; i < forth->points; i++) b->point[b->points++] = forth->point[i];
    for (size_t i = back->events; i-- > 0;) {
        back->event[i].at.arc = -back->event[i].at.arc;
        b->event[b->events++] = back->event[i];
    }
    for (size_t i = 0; i < forth->events; i++) b->event[b->events++] = forth->event[i];
    return ISO_OK;
}

static void free_branch(iso_branch *b)
{
    free(b->point);
    free(b->event);
}

static iso_status follow_branch(const iso_continuation *f, double u, double value, iso_branch *b)
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

/* --- the whole -------------------------------------------------------------------------------------------------- */

static iso_status check(const iso_continuation *f, double own)
{
    const iso_continuation_options *o = &f->options;
    const char *name = iso_vary_name((int)o->vary);
    iso_params p;
    double energy;
    if (!name || !(o->from < o->to) || !isfinite(o->to - o->from))
        return ISO_FAIL_ARGUMENT(f->ctx, "range", "%s from %s to %s: give A:B with A < B", name ? name : "?",
                                 ISO_SHORT(o->from), ISO_SHORT(o->to));
    if (o->vary == ISO_VARY_K && o->from <= 0 && o->to >= 0)
        return ISO_FAIL_ARGUMENT(f->ctx, "range", "the range %s to %s contains k = 0, where there is no ball",
                                 ISO_SHORT(o->from), ISO_SHORT(o->to));
    if (!(own >= o->from && own <= o->to))
        return ISO_FAIL_ARGUMENT(f->ctx, "range", "the scene has %s = %.12g: the range %s to %s must contain it",
                                 name, own, ISO_SHORT(o->from), ISO_SHORT(o->to));
    if (o->vary != ISO_VARY_K &&
        (!iso_continuation_params(f, o->from, &p, &energy) || !iso_continuation_params(f, o->to, &p, &energy)))
        return ISO_FAIL_ARGUMENT(f->ctx, "range", "%s from %s to %s leaves the range in which J%d is the %s moment",
                                 name, ISO_SHORT(o->from), ISO_SHORT(o->to), f->axis + 1,
                                 f->base.k > 0 ? "largest" : "smallest");
    return ISO_OK;
}

static iso_branch *new_branch(const iso_continuation *f, iso_continuations *out, int parent)
{
    iso_branch *larger = realloc(out->branch, (out->count + 1) * sizeof *larger);
    if (!larger) return NULL;
    out->branch = larger;
    iso_branch *b = &out->branch[out->count++];
    *b = (iso_branch){.line = f->line, .period = f->period, .parent = parent};
    return b;
}

/* --- branches that are switched to ------------------------------------------------------------------------------ */

typedef struct switcher {
    iso_continuations *out;
    int parent;
} switcher;

static iso_status follow_found(void *data, const iso_continuation *f, double u, double value)
{
    const switcher *s = data;
    iso_branch *b = new_branch(f, s->out, s->parent);
    if (!b) return iso_context_no_memory(f->ctx, "a branch");
    return follow_branch(f, u, value, b);
}

/* What branches off from branch i. */
static iso_status switch_branches(const iso_continuation *f, iso_continuations *out, size_t i)
{
    switcher s = {out, (int)i};
    iso_status status = ISO_OK;
    for (size_t j = 0; j < out->branch[i].events && status == ISO_OK; j++) {
        const iso_branch b = out->branch[i]; /* the list may move */
        const iso_branch_event e = b.event[j];
        const bool off = !e.joins && (e.kind == ISO_BRANCH_BREAKING || iso_continuation_doubles(e.kind));
        const size_t before = out->count;
        if (!off) continue;
        status = iso_continuation_switch(f, &b, &e, follow_found, &s);
        char *words = out->branch[i].event[j].words;
        const size_t used = strlen(words);
        if (out->count == before && status == ISO_OK)
            snprintf(words + used, sizeof e.words - used, "; the branch was not found");
    }
    return status;
}

static iso_status follow_orbit(iso_continuation *f, const iso_periodic_orbit *o, double own, iso_continuations *out)
{
    f->line = o->line;
    f->period = o->period;
    iso_branch *b = new_branch(f, out, -1);
    if (!b) return iso_context_no_memory(f->ctx, "a branch");
    const size_t at = out->count - 1;
    const iso_status status = follow_branch(f, o->u, own, b);
    return status == ISO_OK && f->options.branches ? switch_branches(f, out, at) : status;
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

/* Moves all branches to one list. */
static iso_status gather(iso_context *ctx, iso_continuations of[], size_t count, iso_continuations *out)
{
    size_t branches = 0;
    for (size_t i = 0; i < count; i++) branches += of[i].count;
    out->branch = malloc((branches + 1) * sizeof *out->branch);
    if (!out->branch) return iso_context_no_memory(ctx, "branches");
    for (size_t i = 0; i < count; i++) {
        const int before = (int)out->count;
        for (size_t j = 0; j < of[i].count; j++) {
            iso_branch *b = &out->branch[out->count++];
            *b = of[i].branch[j];
            if (b->parent >= 0) b->parent += before;
        }
        of[i].count = 0;
    }
    return ISO_OK;
}

static void free_branches(iso_continuations *follow)
{
    for (size_t i = 0; i < follow->count; i++) free_branch(&follow->branch[i]);
    free(follow->branch);
}

static iso_status follow_all(crowd *c, size_t count, iso_continuations *out)
{
    iso_context *ctx = c->family->ctx;
    c->of = calloc(count + 1, sizeof *c->of);
    if (!c->of) return iso_context_no_memory(ctx, "branches");
    iso_pool pool = {.what = "orbit", .count = count, .chunk = 1, .solve = follow_some, .data = c};
    const size_t threads = iso_pool_threads(c->family->options.threads, count > 0 ? count - 1 : 0, 1);
    const iso_status status = iso_pool_run(ctx, &pool, threads, NULL);
    const iso_status gathered = gather(ctx, c->of, count, out);
    for (size_t i = 0; i < count; i++) free_branches(&c->of[i]);
    free(c->of);
    return gathered == ISO_OK ? status : gathered;
}

static iso_status check_lines(iso_context *ctx, const iso_periodic_orbit orbits[], size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!iso_symmetry_line_name(orbits[i].line))
            return ISO_FAIL_INPUT(ctx, "orbit", "an orbit without a symmetry cannot be followed");
    return ISO_OK;
}

/* What is followed; *own: the scene's value. */
static iso_status prepare(iso_context *ctx, const iso_scene *scene, const iso_continuation_options *options,
                          iso_continuation *f, double *own)
{
    *f = (iso_continuation){.ctx = ctx, .options = iso_continuation_defaults(), .base = scene->params};
    if (options) f->options = *options;
    iso_status status = iso_level_of_scene(ctx, scene, "periodic orbits are followed", &f->level);
    f->axis = iso_section_axis(iso_free_point(&scene->params, 1));
    f->width = f->options.to - f->options.from;
    *own = value_of(&scene->params, f->level, f->options.vary);
    return status == ISO_OK ? check(f, *own) : status;
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
    double own;
    *follow = NULL;
    ISO_TRY(prepare(ctx, scene, options, &f, &own));
    ISO_TRY(check_lines(ctx, orbits, count));
    if (count == 0) return ISO_FAIL_INPUT(ctx, "orbit", "no symmetric orbit to follow: the list is empty");
    iso_continuations *out = calloc(1, sizeof *out);
    if (!out) return iso_context_no_memory(ctx, "branches");
    out->vary = f.options.vary;
    const iso_status status = follow_all(&(crowd){.family = &f, .orbit = orbits, .own = own}, count, out);
    if (status != ISO_OK && status != ISO_STOPPED) iso_continuation_free(out), out = NULL;
    *follow = out;
    return status;
}

void iso_continuation_free(iso_continuations *follow)
{
    if (!follow) return;
    free_branches(follow);
    free(follow);
}

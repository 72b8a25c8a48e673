/* chaos.c - which orbits of a scene are chaotic, see chaos.h: what is refused, what a turn is, and the shares. The
 * orbits are followed by chaos_walk.c. */
#include "instrument/chaos/chaos.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "instrument/chaos/chaos_impl.h"
#include "map/section_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"

/* --- what is refused -------------------------------------------------------------------------------------------- */

static const char what[] = "is neither chaotic nor regular";

static iso_status check_motion(const iso_chaos_walk *w, const iso_sample *start)
{
    const iso_status status = iso_refuse_unbound(w->ctx, w->orbit, what);
    if (status != ISO_OK || largest(w->out->with[ISO_BALL] ? start->ball : start->point) > 0) return status;
    return iso_refuse_start_at_rest(w->ctx, &w->scene->start, "deviations have no size");
}

static iso_status check_options(const iso_chaos_walk *w)
{
    const iso_chaos_options *o = &w->options;
    if (o->turns < 1) return ISO_FAIL_ARGUMENT(w->ctx, "turns", "%ld turns: give 1 or more", o->turns);
    if (o->exponent_turns < 0)
        return ISO_FAIL_ARGUMENT(w->ctx, "exponent_turns", "%ld turns: give 0 or more", o->exponent_turns);
    return iso_crossings_check_axis(w->ctx, o->axis);
}

/* Errors: ISO_BAD_INPUT about "axis". */
static iso_status check_section(const iso_chaos_walk *w)
{
    const iso_point_motion m = iso_orbit_motion(w->orbit);
    const int axis = w->out->axis;
    if (axis < 0 || iso_section_is_global(m, axis)) return ISO_OK;
    return ISO_FAIL_INPUT(w->ctx, "axis",
                          "orbits can stay away from the section n_%d = 0 for ever: take n_%d = 0, which is global",
                          axis + 1, iso_section_axis(m) + 1);
}

/* --- what a turn is --------------------------------------------------------------------------------------------- */

/* A turn: a return to the section; under an effect beyond the level, the time in which n turns once at the rate
 * |k omega|. */
static void choose_turn(iso_chaos_walk *w, const iso_effect *effect)
{
    iso_chaos *c = w->out;
    const int asked = w->options.axis;
    c->chart = asked == ISO_AXIS_AUTO ? iso_section_axis(iso_orbit_motion(w->orbit)) : asked;
    c->axis = effect ? -1 : c->chart;
    c->turn = effect ? iso_walk_turn(w->orbit, ISO_CLOCK_T) : (double)NAN;
    if (!effect) c->integral = iso_orbit_additional_integral(w->orbit);
}

/* The axis about which a free orbit rotates in the plane n_axis = 0; -1: it does not. */
static int find_plane(const double y[ISO_STATE])
{
    for (int a = 0; a < 3; a++)
        if (iso_section_is_rotation(y, a)) return a;
    return -1;
}

static void choose_models(iso_chaos_walk *w)
{
    const iso_effects *e = &w->effects;
    const bool alone = iso_effects_breaking(e) || iso_effects_ball_only(e);
    const iso_models models = w->options.models != ISO_SHOW_START ? w->options.models
                              : alone                             ? ISO_SHOW_BALL
                                                                  : ISO_SHOW_BOTH;
    w->out->with[ISO_BALL] = models != ISO_SHOW_POINT;
    w->out->with[ISO_POINT] = models != ISO_SHOW_BALL;
    w->sampled = w->options.models == ISO_SHOW_START && models == ISO_SHOW_BOTH;
}

static iso_status open_orbit(iso_chaos_walk *w, iso_sample *start)
{
    const bool *with = w->out->with;
    iso_orbit_options o = iso_orbit_defaults(&w->scene->start);
    o.effects = &w->effects;
    o.backend = with[ISO_BALL] ? ISO_BACKEND_BALL : ISO_BACKEND_POINT;
    o.clock = with[ISO_BALL] ? ISO_CLOCK_T : ISO_CLOCK_S;
    o.shown = with[ISO_BALL] && with[ISO_POINT] ? ISO_SHOW_BOTH : with[ISO_BALL] ? ISO_SHOW_BALL : ISO_SHOW_POINT;
    o.tolerance = w->options.tolerance;
    ISO_TRY(iso_orbit_create(w->ctx, &w->scene->params, &w->scene->start, &o, &w->orbit));
    return iso_orbit_at(w->orbit, 0, start);
}

/* --- the result ------------------------------------------------------------------------------------------------- */

static bool could_not_be_followed(const iso_chaos_orbit *o)
{
    return o->verdict == ISO_UNDECIDED && (o->status[ISO_BALL] != ISO_OK || o->status[ISO_POINT] != ISO_OK);
}

bool iso_chaos_followed(const iso_chaos_orbit *o)
{
    return !could_not_be_followed(o) && o->result[ISO_BALL].turns + o->result[ISO_POINT].turns > 0;
}

static void count_shares(const iso_chaos_walk *w)
{
    iso_chaos *c = w->out;
    iso_chaos_fraction *s = &c->share;
    size_t count[ISO_SHIFTS] = {0}, chaotic[ISO_SHIFTS] = {0}, possible[ISO_SHIFTS] = {0};
    double unused;
    s->asked = w->options.starts;
    s->tolerance = w->spread_tolerance;
    for (size_t i = 0; i < s->asked && i < c->starts; i++) {
        const iso_chaos_orbit *o = &c->start[i];
        const size_t copy = i % ISO_SHIFTS;
        s->failed += could_not_be_followed(o);
        if (!iso_chaos_followed(o)) continue;
        count[copy]++;
        chaotic[copy] += o->verdict == ISO_CHAOTIC;
        possible[copy] += o->verdict == ISO_CHAOTIC || (o->verdict == ISO_UNDECIDED && !c->integral);
        s->count++;
        s->chaotic += o->verdict == ISO_CHAOTIC;
        s->regular += o->verdict == ISO_REGULAR;
        s->disagree += o->disagree;
        s->checked += o->result[ISO_BALL].verdict != ISO_UNDECIDED && o->result[ISO_POINT].verdict != ISO_UNDECIDED;
    }
    s->undecided = s->count - s->chaotic - s->regular;
    s->share = s->count > 0 ? (double)s->chaotic / (double)s->count : NAN;
    iso_share_interval(count, chaotic, &s->low, &unused);
    iso_share_interval(count, possible, &unused, &s->high);
}

/* All that comes before the first turn. */
static iso_status prepare(iso_chaos_walk *w)
{
    const iso_chaos_options *o = &w->options;
    const size_t starts = o->starts + o->at_count;
    iso_sample start;
    ISO_TRY(check_options(w));
    w->effects = iso_scene_acting(w->scene);
    choose_models(w);
    ISO_TRY(iso_refuse_rest(w->ctx, &w->scene->start, &w->effects, what));
    ISO_TRY(open_orbit(w, &start));
    const iso_effects effects = iso_orbit_effects(w->orbit);
    const iso_effect *effect = iso_effects_beyond_level(&effects);
    ISO_TRY(check_motion(w, &start));
    choose_turn(w, effect);
    ISO_TRY(check_section(w));
    if (starts > 0)
        ISO_TRY(iso_refuse_starts(w->ctx, w->orbit, &w->effects, w->out->chart, o->at, o->at_count, o->starts > 0));
    w->starts = (iso_starts){.scene = w->scene,
                             .orbit = w->orbit,
                             .effects = &w->effects,
                             .axis = w->out->chart,
                             .spread = o->starts,
                             .seed = o->seed,
                             .copies = ISO_SHIFTS,
                             .at = o->at};
    iso_starts_prepare(&w->starts);
    w->out->plane = effect ? -1 : find_plane(w->out->with[ISO_BALL] ? start.ball : start.point);
    w->out->start = calloc(starts + 1, sizeof *w->out->start);
    if (!w->out->start) return iso_context_no_memory(w->ctx, "the starts");
    for (size_t i = 0; i < starts; i++) w->out->start[i].number = i + 1;
    return ISO_OK;
}

static iso_status begin(iso_context *ctx, const iso_scene *scene, const iso_chaos_options *options, iso_chaos_walk *w)
{
    *w = (iso_chaos_walk){.ctx = ctx, .scene = scene, .options = iso_chaos_defaults()};
    if (options) w->options = *options;
    const double asked = w->options.tolerance;
    w->options.tolerance = isnan(asked) ? scene->tolerance : asked;
    w->spread_tolerance = isnan(asked) ? fmax(scene->tolerance, ISO_SPREAD_TOLERANCE) : asked;
    w->out = calloc(1, sizeof *w->out);
    if (!w->out) return iso_context_no_memory(ctx, "the indicators");
    w->out->own.verdict = ISO_UNDECIDED;
    return ISO_OK;
}

iso_status iso_chaos_run(iso_context *ctx, const iso_scene *scene, const iso_chaos_options *options,
                         iso_chaos **chaos)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_chaos_walk w;
    *chaos = NULL;
    ISO_TRY(begin(ctx, scene, options, &w));
    iso_status status = prepare(&w);
    if (status == ISO_OK) {
        status = iso_chaos_follow(&w);
        count_shares(&w);
    }
    iso_orbit_free(w.orbit);
    if (status != ISO_OK && status != ISO_STOPPED) iso_chaos_free(w.out), w.out = NULL;
    *chaos = w.out;
    return status;
}

/* --- many scenes ------------------------------------------------------------------------------------------------ */

static bool alike(const iso_chaos_walk *a, const iso_chaos_walk *b)
{
    return a->options.tolerance == b->options.tolerance && a->out->with[0] == b->out->with[0] &&
           a->out->with[1] == b->out->with[1];
}

/* Orbits that turn from section to section can share lanes; the others are followed alone. */
static iso_status follow_single(iso_chaos_walk *w, iso_status *status)
{
    *status = iso_chaos_follow(w);
    for (int m = 0; m < 2; m++) {
        iso_record_free(w->out->trace[m]);
        w->out->trace[m] = NULL;
    }
    return *status == ISO_STOPPED || *status == ISO_NO_MEMORY ? *status : ISO_OK;
}

/* Follows walk[0] and all that are like it. The others move to the front; *count is their number. */
static iso_status follow_alike(iso_chaos_walk *walk[], iso_chaos_walk *together[], size_t *count)
{
    size_t others = 0, like = 0;
    for (size_t i = 0; i < *count; i++)
        if (like == 0 || alike(together[0], walk[i]))
            together[like++] = walk[i];
        else
            walk[others++] = walk[i];
    *count = others;
    return iso_chaos_follow_each(like, together);
}

static iso_status follow_many(size_t count, iso_chaos_walk walk[], iso_chaos_walk *left[], iso_status status[])
{
    iso_status answer = ISO_OK;
    size_t free = 0;
    for (size_t i = 0; i < count && answer == ISO_OK; i++) {
        if (status[i] != ISO_OK) continue;
        if (walk[i].out->axis < 0 || walk[i].out->plane >= 0)
            answer = follow_single(&walk[i], &status[i]);
        else
            left[free++] = &walk[i];
    }
    while (free > 0 && answer == ISO_OK) answer = follow_alike(left, left + count, &free);
    return answer;
}

/* The orbit of a walk is only needed before the first turn. */
static iso_status prepare_many(iso_context *ctx, size_t count, const iso_scene *const scene[],
                               const iso_chaos_options *options, iso_chaos_walk walk[], iso_status status[])
{
    for (size_t i = 0; i < count; i++) {
        if (!scene[i]) continue;
        status[i] = begin(ctx, scene[i], options, &walk[i]);
        if (status[i] == ISO_OK) status[i] = prepare(&walk[i]);
        iso_orbit_free(walk[i].orbit);
        walk[i].orbit = NULL;
        if (status[i] == ISO_NO_MEMORY || status[i] == ISO_STOPPED) return status[i];
        if (status[i] == ISO_OK || !walk[i].out) continue;
        snprintf(walk[i].out->words, sizeof walk[i].out->words, "%s", iso_context_message(ctx));
    }
    return ISO_OK;
}

iso_status iso_chaos_run_many(iso_context *ctx, size_t count, const iso_scene *const scene[],
                              const iso_chaos_options *options, iso_chaos *chaos[], iso_status status[])
{
    ISO_DEFAULT_ARITHMETIC;
    iso_chaos_walk *walk = calloc(count + 1, sizeof *walk), **left = calloc(2 * count + 1, sizeof *left);
    iso_status answer = ISO_NO_MEMORY;
    for (size_t i = 0; i < count; i++) status[i] = ISO_BAD_ARGUMENT;
    if (walk && left) {
        answer = prepare_many(ctx, count, scene, options, walk, status);
        if (answer == ISO_OK) answer = follow_many(count, walk, left, status);
    } else {
        iso_context_no_memory(ctx, "%zu orbits", count);
    }
    for (size_t i = 0; i < count; i++) {
        chaos[i] = walk ? walk[i].out : NULL;
        if (answer == ISO_OK && status[i] == ISO_OK && walk[i].out->plane < 0)
            status[i] = iso_chaos_check_own(&walk[i]);
        if (answer == ISO_OK) continue;
        iso_chaos_free(chaos[i]);
        chaos[i] = NULL;
    }
    free(walk);
    free(left);
    return answer;
}

void iso_chaos_free(iso_chaos *chaos)
{
    if (!chaos) return;
    for (int m = 0; m < 2; m++) iso_record_free(chaos->trace[m]);
    free(chaos->start);
    free(chaos);
}

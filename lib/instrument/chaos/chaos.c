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

/* --- before the first turn -------------------------------------------------------------------------------------- */

static const char what[] = "is neither chaotic nor regular";

/* Checks the options, and opens the scene's orbit of the models that are integrated. */
static iso_status open_orbit(iso_chaos_walk *w, iso_sample *start)
{
    const iso_chaos_options *asked = &w->options;
    const iso_effects *e = &w->effects;
    bool *with = w->out->with;
    if (asked->turns < 1) return ISO_FAIL_ARGUMENT(w->ctx, "turns", "%ld turns: give 1 or more", asked->turns);
    if (asked->exponent_turns < 0)
        return ISO_FAIL_ARGUMENT(w->ctx, "exponent_turns", "%ld turns: give 0 or more", asked->exponent_turns);
    ISO_TRY(iso_crossings_check_axis(w->ctx, asked->axis));
    w->effects = iso_scene_acting(w->scene);
    const bool alone = iso_effects_breaking(e) || iso_effects_ball_only(e);
    const iso_models models = asked->models != ISO_SHOW_START ? asked->models : alone ? ISO_SHOW_BALL : ISO_SHOW_BOTH;
    with[ISO_BALL] = models != ISO_SHOW_POINT;
    with[ISO_POINT] = models != ISO_SHOW_BALL;
    w->sampled = asked->models == ISO_SHOW_START && models == ISO_SHOW_BOTH;
    ISO_TRY(iso_refuse_rest(w->ctx, &w->scene->start, e, what));
    iso_orbit_options o = iso_orbit_defaults(&w->scene->start);
    o.effects = e;
    o.backend = with[ISO_BALL] ? ISO_BACKEND_BALL : ISO_BACKEND_POINT;
    o.clock = with[ISO_BALL] ? ISO_CLOCK_T : ISO_CLOCK_S;
    o.shown = with[ISO_BALL] && with[ISO_POINT] ? ISO_SHOW_BOTH : with[ISO_BALL] ? ISO_SHOW_BALL : ISO_SHOW_POINT;
    o.tolerance = asked->tolerance;
    ISO_TRY(iso_orbit_create(w->ctx, &w->scene->params, &w->scene->start, &o, &w->orbit));
    ISO_TRY(iso_orbit_at(w->orbit, 0, start));
    ISO_TRY(iso_refuse_unbound(w->ctx, w->orbit, what));
    if (largest(with[ISO_BALL] ? start->ball : start->point) > 0) return ISO_OK;
    return iso_refuse_start_at_rest(w->ctx, &w->scene->start, "deviations have no size");
}

/* A turn: a return to the section; under an effect beyond the level, the time in which n turns once at the rate
 * |k omega|. Errors: ISO_BAD_INPUT about "axis". */
static iso_status choose_turn(iso_chaos_walk *w, const iso_effect *effect)
{
    iso_chaos *c = w->out;
    const iso_point_motion m = iso_orbit_motion(w->orbit);
    const int global = iso_section_axis(m);
    c->chart = w->options.axis == ISO_AXIS_AUTO ? global : w->options.axis;
    c->axis = effect ? -1 : c->chart;
    c->turn = effect ? iso_walk_turn(w->orbit, ISO_CLOCK_T) : (double)NAN;
    if (!effect) c->integral = iso_orbit_additional_integral(w->orbit);
    if (effect || iso_section_is_global(m, c->axis)) return ISO_OK;
    return ISO_FAIL_INPUT(w->ctx, "axis",
                          "orbits can stay away from the section n_%d = 0 for ever: take n_%d = 0, which is global",
                          c->axis + 1, global + 1);
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
    s->half_interval = (s->high - s->low) / 2;
    s->regular_share = (double)s->regular / (double)s->count;
    s->undecided_share = (double)s->undecided / (double)s->count;
}

/* All that comes before the first turn. *w is set in each case; w->out is NULL if there is no memory. */
static iso_status prepare(iso_context *ctx, const iso_scene *scene, const iso_chaos_options *options,
                          iso_chaos_walk *w)
{
    iso_chaos_options *o = &w->options;
    iso_sample start;
    *w = (iso_chaos_walk){.ctx = ctx, .scene = scene, .options = options ? *options : iso_chaos_defaults()};
    w->spread_tolerance = isnan(o->tolerance) ? fmax(scene->tolerance, ISO_SPREAD_TOLERANCE) : o->tolerance;
    if (isnan(o->tolerance)) o->tolerance = scene->tolerance;
    iso_chaos *c = w->out = calloc(1, sizeof *c);
    if (!c) return iso_context_no_memory(ctx, "the indicators");
    c->own.verdict = ISO_UNDECIDED;
    ISO_TRY(open_orbit(w, &start));
    const iso_effects effects = iso_orbit_effects(w->orbit);
    const iso_effect *effect = iso_effects_beyond_level(&effects);
    const size_t starts = o->starts + o->at_count;
    ISO_TRY(choose_turn(w, effect));
    if (starts > 0)
        ISO_TRY(iso_refuse_starts(ctx, w->orbit, &w->effects, c->chart, o->at, o->at_count, o->starts > 0));
    w->starts = (iso_starts){.scene = scene,
                             .orbit = w->orbit,
                             .effects = &w->effects,
                             .axis = c->chart,
                             .spread = o->starts,
                             .seed = o->seed,
                             .copies = ISO_SHIFTS,
                             .at = o->at};
    iso_starts_prepare(&w->starts);
    c->plane = -1;
    for (int a = 2; a >= 0 && !effect; a--)
        if (iso_section_is_rotation(c->with[ISO_BALL] ? start.ball : start.point, a)) c->plane = a;
    c->start = calloc(starts + 1, sizeof *c->start);
    if (!c->start) return iso_context_no_memory(ctx, "the starts");
    for (size_t i = 0; i < starts; i++) c->start[i].number = i + 1;
    return ISO_OK;
}

iso_status iso_chaos_run(iso_context *ctx, const iso_scene *scene, const iso_chaos_options *options,
                         iso_chaos **chaos)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_chaos_walk w;
    *chaos = NULL;
    iso_status status = prepare(ctx, scene, options, &w);
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

/* Follows walk[0] and all that have the same models and tolerance. The others move to the front; *count is their
 * number. */
static iso_status follow_alike(iso_chaos_walk *walk[], iso_chaos_walk *together[], size_t *count)
{
    const iso_chaos_walk *first = walk[0];
    const bool *with = first->out->with;
    size_t others = 0, like = 0;
    for (size_t i = 0; i < *count; i++)
        if (walk[i]->options.tolerance == first->options.tolerance && walk[i]->out->with[0] == with[0] &&
            walk[i]->out->with[1] == with[1])
            together[like++] = walk[i];
        else
            walk[others++] = walk[i];
    *count = others;
    return iso_chaos_follow_each(like, together);
}

/* Orbits that turn from section to section can share lanes; the others are followed alone. */
static iso_status follow_many(size_t count, iso_chaos_walk walk[], iso_chaos_walk *left[], iso_status status[])
{
    iso_status answer = ISO_OK;
    size_t free = 0;
    for (size_t i = 0; i < count && answer == ISO_OK; i++) {
        iso_chaos *c = walk[i].out;
        if (status[i] != ISO_OK) continue;
        if (c->axis >= 0 && c->plane < 0) {
            left[free++] = &walk[i];
            continue;
        }
        status[i] = iso_chaos_follow(&walk[i]);
        for (int m = 0; m < 2; m++) iso_record_free(c->trace[m]), c->trace[m] = NULL;
        if (status[i] == ISO_STOPPED || status[i] == ISO_NO_MEMORY) answer = status[i];
    }
    while (free > 0 && answer == ISO_OK) answer = follow_alike(left, left + count, &free);
    return answer;
}

iso_status iso_chaos_run_many(iso_context *ctx, size_t count, const iso_scene *const scene[],
                              const iso_chaos_options *options, iso_chaos *chaos[], iso_status status[])
{
    ISO_DEFAULT_ARITHMETIC;
    iso_chaos_walk *walk = calloc(count + 1, sizeof *walk), **left = calloc(2 * count + 1, sizeof *left);
    iso_status answer = walk && left ? ISO_OK : iso_context_no_memory(ctx, "%zu orbits", count);
    for (size_t i = 0; i < count; i++) {
        status[i] = ISO_BAD_ARGUMENT;
        if (answer != ISO_OK || !scene[i]) continue;
        status[i] = prepare(ctx, scene[i], options, &walk[i]);
        iso_orbit_free(walk[i].orbit); /* only needed before the first turn */
        walk[i].orbit = NULL;
        if (status[i] == ISO_NO_MEMORY || status[i] == ISO_STOPPED)
            answer = status[i];
        else if (status[i] != ISO_OK)
            snprintf(walk[i].out->words, sizeof walk[i].out->words, "%s", iso_context_message(ctx));
    }
    if (answer == ISO_OK) answer = follow_many(count, walk, left, status);
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

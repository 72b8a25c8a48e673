/* walk.c - many orbits to their next stops, see walk_impl.h: groups, rounds, failures, progress; and the orbits of a
 * scene. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/walk_impl.h"

/* ROOM: crossings in memory, about 50 MB for each model, and as much for samples. A round in order is computed in
 * SLICES parts: between them progress is shown. */
enum { ROOM = 1 << 19, ROOM_WITH_SAMPLES = 1 << 17, IN_ORDER = 4096, SLICES = 32, GROUP = 1024, ROUND = 240 };

typedef struct member {
    iso_start start;
    bool wanted, failed, ended[2]; /* in this round; by one model at least; by this model */
    size_t visited, done[2];       /* stops; those of this round, by each model */
} member;

typedef struct iso_walk_group {
    iso_walk *w;
    size_t most, round, slice;  /* orbits; stops of a round; stops computed at a time */
    size_t first, count, asked; /* of this group: orbits; stops asked for in earlier rounds */
    member *member;
    iso_batch_orbit *orbit;
    iso_crossings *crossings[2];
    iso_crossing *crossing[2]; /* [orbit][stop of the round] */
    iso_sample *sample;        /* likewise; NULL: not asked for */
    /* of one call of iso_crossings_go_apart */
    bool *going;
    size_t *found;
    iso_status *status;
} group;

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static iso_status make_room(group *g)
{
    const size_t n = g->most, cells = n * g->round;
    bool room = true;
    g->member = calloc(n, sizeof *g->member);
    g->orbit = calloc(n, sizeof *g->orbit);
    g->going = calloc(n, sizeof *g->going);
    g->found = calloc(n, sizeof *g->found);
    g->status = calloc(n, sizeof *g->status);
    g->sample = g->w->samples ? malloc(cells * sizeof *g->sample) : NULL;
    for (int m = 0; m < g->w->models; m++) room = (g->crossing[m] = malloc(cells * sizeof **g->crossing)) && room;
    if (room && g->member && g->orbit && g->going && g->found && g->status && (g->sample || !g->w->samples))
        return ISO_OK;
    return iso_context_no_memory(g->w->ctx, "the crossings of %zu orbits", n);
}

void iso_walk_keep(iso_status *failure, char text[512], size_t i, iso_status status, const char *why)
{
    if (*failure != ISO_OK) return;
    *failure = status;
    snprintf(text, 512, "orbit %zu: %s", i, why);
}

void iso_walk_fail(iso_walk *w, size_t i, iso_status status, const char *why)
{
    bool *failed = &w->group->member[i - w->group->first].failed;
    w->failed += !*failed;
    *failed = true;
    iso_walk_keep(&w->failure, w->text, i, status, why);
}

static void show_progress(const group *g, size_t stops)
{
    const iso_walk *w = g->w;
    const double part = (double)(g->first - w->first) + (double)g->count * (double)stops / (double)w->most;
    if (w->progress) w->progress(w->user, part / (double)w->count);
}

/* The stops of the next round; 0: no orbit goes on. */
static size_t next_round(group *g)
{
    const iso_walk *w = g->w;
    size_t each = 0;
    for (size_t i = 0; i < g->count; i++) {
        member *one = &g->member[i];
        const bool over = g->asked > 0 && one->done[0] == 0 && one->done[1] == 0; /* it ended, or finds no more */
        const size_t left = over ? 0 : w->wanted ? w->wanted(w->user, g->first + i) : w->most - g->asked;
        one->wanted = left > 0;
        if (left > 0 && (each == 0 || left < each)) each = left;
    }
    return least(each, g->round);
}

/* Goes on to the next `each` stops. Errors: ISO_STOPPED, ISO_NO_MEMORY. */
static iso_status go_on(group *g, size_t each)
{
    iso_walk *w = g->w;
    for (size_t i = 0; i < g->count; i++) g->member[i].done[0] = g->member[i].done[1] = 0;
    for (size_t at = 0, part; at < each; at += part) {
        part = least(each - at, g->slice);
        for (size_t i = 0; i < g->count; i++) g->going[i] = g->member[i].wanted;
        for (int m = 0; m < w->models; m++) {
            const iso_crossings_task task = {
                g->going, part,     g->round, g->crossing[m] + at, m == 0 && g->sample ? g->sample + at : NULL,
                g->found, g->status};
            const iso_status status = iso_crossings_go_apart(g->crossings[m], &task);
            const bool ended = status == ISO_STOPPED || status == ISO_NO_MEMORY;
            for (size_t i = 0; i < g->count; i++) {
                member *one = &g->member[i];
                one->done[m] += g->found[i];
                if (g->status[i] == ISO_BAD_INPUT && g->found[i] == 0) g->going[i] = false; /* it stays away */
                if (ended || g->status[i] == ISO_OK || one->ended[m]) continue;
                const char *why = iso_crossings_why(g->crossings[m], i);
                one->ended[m] = true;
                iso_walk_fail(w, g->first + i, g->status[i], why);
                if (w->failed_by) w->failed_by(w->user, g->first + i, m, g->status[i], why);
            }
            if (ended) return status;
        }
        show_progress(g, g->asked + at + part);
    }
    return ISO_OK;
}

static iso_status visit(group *g)
{
    const iso_walk *w = g->w;
    for (size_t i = 0; i < g->count; i++) {
        member *one = &g->member[i];
        for (size_t j = 0; j < one->done[0] || j < one->done[1]; j++) {
            const size_t at = g->round * i + j;
            iso_walk_stop stop = {.number = ++one->visited};
            for (int m = 0; m < 2; m++) stop.crossing[m] = j < one->done[m] ? &g->crossing[m][at] : NULL;
            stop.sample = g->sample && j < one->done[0] ? &g->sample[at] : NULL;
            ISO_TRY(w->visit(w->user, g->first + i, &stop));
        }
    }
    return ISO_OK;
}

static iso_status walk_group(group *g)
{
    iso_walk *w = g->w;
    iso_status status = ISO_OK;
    g->asked = 0;
    for (size_t i = 0; i < g->count; i++) {
        member *one = &g->member[i];
        double l, x;
        *one = (member){.visited = 0};
        if (w->begin)
            w->begin(w->user, g->first + i, &one->start, &g->orbit[i]);
        else
            iso_starts_orbit(w->starts, g->first + i, &l, &x, &one->start, &g->orbit[i]);
    }
    for (int m = 0; m < w->models && status == ISO_OK; m++)
        status = iso_crossings_create(w->ctx, g->orbit, g->count, &w->options[m], &g->crossings[m]);
    for (size_t each; status == ISO_OK && (each = next_round(g)) > 0; g->asked += each) {
        status = go_on(g, each);
        w->stopped = status == ISO_STOPPED;
        if (status != ISO_OK && !w->stopped) break;
        const iso_status visited = visit(g);
        if (visited != ISO_OK) status = visited;
        show_progress(g, g->asked + each);
    }
    for (int m = 0; m < w->models; m++) {
        iso_crossings_free(g->crossings[m]);
        g->crossings[m] = NULL;
    }
    return status;
}

iso_status iso_walk_go(iso_walk *w)
{
    group g = {.w = w, .first = w->first};
    if (w->count == 0 || w->most == 0) return ISO_OK;
    const size_t room = w->samples ? ROOM_WITH_SAMPLES : ROOM, fit = room / w->most;
    g.most = least(!w->in_order ? GROUP : fit < 1 ? 1 : least(fit, IN_ORDER), w->count);
    g.slice = w->in_order ? least((w->most + SLICES - 1) / SLICES, room / SLICES) : least(w->most, ROUND);
    g.round = w->in_order && g.most > 1 ? w->most : g.slice; /* the rounds of a single orbit are in order */
    w->group = &g;
    iso_status status = make_room(&g);
    for (; status == ISO_OK && g.first < w->first + w->count; g.first += g.count) {
        g.count = least(g.most, w->first + w->count - g.first);
        w->begun += g.count;
        status = walk_group(&g);
    }
    free(g.member);
    free(g.orbit);
    free(g.going);
    free(g.found);
    free(g.status);
    free(g.sample);
    for (int m = 0; m < 2; m++) free(g.crossing[m]);
    w->group = NULL;
    return status;
}

double iso_walk_turn(iso_orbit *orbit, iso_clock clock)
{
    iso_sample start;
    const bool point = clock == ISO_CLOCK_S, pulled = iso_effects_pull(&orbit->effects);
    const double unit = point ? orbit->unit_M : orbit->units.w;
    if (iso_orbit_at(orbit, 0, &start) != ISO_OK) return NAN;
    const double speed = norm(point ? start.point : start.ball);
    return 2 * ISO_PI /
           ((isnan(speed) ? unit : fmax(speed, pulled ? unit : 0)) * (point ? 1 : fabs(orbit->units.own.k)));
}

/* --- the orbits of a scene -------------------------------------------------------------------------------------- */

void iso_starts_prepare(iso_starts *s)
{
    const iso_effects found = iso_orbit_effects(s->orbit);
    const double c = iso_effects_level(&found);
    if (iso_effects_have_level(&found) && isnormal(c)) iso_effects_set_level(s->effects, true, c);
    if (s->spread > 0) iso_section_spread_prepare(&s->even, iso_orbit_motion(s->orbit), s->axis, s->seed);
    s->even.copies = s->copies;
}

void iso_starts_orbit(const iso_starts *s, size_t i, double *l, double *x, iso_start *start, iso_batch_orbit *orbit)
{
    *start = s->scene->start;
    *orbit = (iso_batch_orbit){&s->scene->params, start, s->effects};
    *l = *x = NAN;
    if (i == 0) return;
    if (i <= s->spread)
        iso_section_spread_point(&s->even, i - 1, l, x);
    else
        *l = s->at[i - 1 - s->spread][0], *x = s->at[i - 1 - s->spread][1];
    *start = iso_section_start(s->orbit, s->scene->start.model, s->axis, *l, *x);
}

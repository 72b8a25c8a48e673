/* cost_reference.c - what errors are measured against, and how far that can be trusted. */
#include <math.h>
#include <stdio.h>

#include "study/cost_impl.h"

/* Where the orbit may come from. */
typedef struct source {
    iso_picture backend;
    const iso_method *method;
    double tolerance;
} source;

static void describe(const source *s, char what[120])
{
    if (s->backend == ISO_EXACT)
        snprintf(what, 120, "the closed solution");
    else
        snprintf(what, 120, "%s at %g, backend %s", s->method->name, s->tolerance, iso_picture_name((int)s->backend));
}

static iso_status follow(cost_problem *p, const source *s, double seconds, cost_track *track)
{
    const iso_status status = iso_cost_walk(p, s->backend, s->method, s->tolerance, true, seconds, track);
    if (status == ISO_OK || status == ISO_STOPPED || track->reached > 0) return status;
    return iso_cost_walk(p, s->backend, s->method, s->tolerance, false, seconds,
                         track); /* perhaps for want of a clock */
}

/* The first of the sources that gets to the end, else the one that gets farthest; -1: none gets anywhere. */
static int best_source(cost_problem *p, const source list[], int count, double seconds, cost_track *track)
{
    int best = -1, farthest = 0, used = -1;
    for (int i = 0; i < count && !iso_cost_is_stopped(p); i++) {
        if (list[i].backend != ISO_EXACT && !list[i].method) continue;
        used = i;
        if (follow(p, &list[i], seconds, track) == ISO_OK) return i;
        if (track->reached > farthest) farthest = track->reached, best = i;
    }
    if (best >= 0 && best != used) follow(p, &list[best], seconds, track); /* once more, it was written over */
    return best;
}

static iso_status find_first(cost_problem *p, double seconds, bool may_fall_short, cost_reference *r, source *from)
{
    const iso_picture own = p->scene->start.model;
    const source list[] = {{ISO_EXACT, NULL, 0},
                           {own, iso_method_find("taylor_quad"), 1e-15},
                           {own, iso_method_find("taylor_extended"), 1e-15},
                           {ISO_BALL, iso_method_find("taylor_extended"), 1e-15},
                           {ISO_BALL, iso_method_find("bsimp"), 1e-14},
                           {ISO_BALL, iso_method_find("bdf"), 1e-14},
                           {ISO_BALL, iso_method_find("bdf"), 1e-12}};
    const int i = best_source(p, list, (int)(sizeof list / sizeof *list), seconds, &r->first);
    if (iso_cost_is_stopped(p)) return iso_context_fail(p->user, ISO_STOPPED, "", "stopped on request");
    if (i < 0 || (r->first.reached < r->first.times && !may_fall_short))
        return iso_context_fail(p->user, ISO_NUMERICAL, "", "no reference gets to %s = %g in %.2g s: %s",
                                iso_clock_name(p->clock), p->end, seconds, iso_context_message(p->ctx));
    *from = list[i];
    r->exact = from->backend == ISO_EXACT;
    describe(from, r->what);
    return ISO_OK;
}

/* Series in the formulation that the first was not found in; of the closed solution, in any. */
static bool find_by_series(cost_problem *p, const source *first, double seconds, cost_reference *r)
{
    const iso_picture own = p->scene->start.model, other = own == ISO_BALL ? ISO_POINT : ISO_BALL;
    const iso_picture backend = first->backend == ISO_EXACT ? own : first->backend == own ? other : own;
    const source list[] = {{backend, iso_method_find("taylor_quad"), 1e-15},
                           {backend, iso_method_find("taylor_extended"), 1e-15}};
    const int i = best_source(p, list, 2, seconds, &r->second);
    if (i < 0 || r->second.reached < r->first.reached) return false;
    describe(&list[i], r->second_what);
    return true;
}

/* Other codes in the same formulation: that which agrees best bears the first out. */
static bool find_by_others(cost_problem *p, const source *first, double seconds, cost_reference *r)
{
    static const char *const names[] = {"rk8pd", "fehlberg_13_7_8", "bsimp", "bdf"};
    static const double tolerances[] = {1e-13, 1e-14, 1e-15};
    source best = {ISO_BALL, NULL, 0}, now = best;
    double least = INFINITY;
    for (int i = 0; i < 12 && !iso_cost_is_stopped(p); i++) {
        now.method = iso_method_find(names[i / 3]);
        now.tolerance = tolerances[i % 3];
        if (now.method == first->method && now.tolerance == first->tolerance) continue;
        follow(p, &now, seconds, &r->second);
        const double off = iso_cost_distance(&r->first, &r->second);
        if (r->second.reached >= r->first.reached && off < least)
            best = now, least = off;
        else if (r->second.reached < r->first.reached)
            i += 2 - i % 3; /* the tighter ones do not get there either */
    }
    if (!best.method || follow(p, &best, 2 * seconds, &r->second) != ISO_OK) return false; /* others are there now */
    describe(&best, r->second_what);
    return true;
}

iso_status iso_cost_reference_find(cost_problem *p, int times, const double time[], double seconds,
                                   bool may_fall_short, cost_reference *r)
{
    source from;
    *r = (cost_reference){.uncertainty = INFINITY};
    iso_status status = iso_cost_track_make(p, times, time, &r->first);
    if (status == ISO_OK) status = iso_cost_track_make(p, times, time, &r->second);
    if (status == ISO_OK) status = find_first(p, seconds / 3, may_fall_short, r, &from);
    if (status != ISO_OK) return status;
    snprintf(r->second_what, sizeof r->second_what, "none");
    r->doubted = find_by_series(p, &from, seconds / 3, r);
    if (!r->doubted) r->doubted = find_by_others(p, &from, seconds / 24, r);
    if (r->doubted) r->uncertainty = iso_cost_distance(&r->first, &r->second);
    if (iso_cost_is_stopped(p)) return iso_context_fail(p->user, ISO_STOPPED, "", "stopped on request");
    return ISO_OK;
}

void iso_cost_reference_free(cost_reference *r)
{
    iso_cost_track_free(&r->first);
    iso_cost_track_free(&r->second);
}

/* cost_reference.c - the reference for errors, and its uncertainty: the distance from a second, independent
 * reference. */
#include <math.h>
#include <stdio.h>

#include "base/number_impl.h"
#include "method/methods_impl.h"
#include "task/cost/cost_impl.h"

/* A run from which the reference may come. */
typedef struct source {
    iso_backend backend;
    const iso_method *method;
    double tolerance;
} source;

static void describe(const source *s, char what[120])
{
    if (s->backend == ISO_BACKEND_EXACT)
        snprintf(what, 120, "the closed solution");
    else
        snprintf(what, 120, "%s at %s, backend %s", s->method->name, ISO_SHORT(s->tolerance),
                 iso_backend_name((int)s->backend));
}

static iso_status follow(cost_problem *p, const source *s, double seconds, cost_track *track)
{
    const iso_status status = iso_cost_walk(p, s->backend, s->method, s->tolerance, true, seconds, track);
    if (status == ISO_OK || status == ISO_STOPPED || track->reached > 0) return status;
    return iso_cost_walk(p, s->backend, s->method, s->tolerance, false, seconds,
                         track); /* without the other clock, which may be what failed */
}

/* The first of the sources that gets to the end, else the one that gets farthest; -1: none gets to any time. */
static int best_source(cost_problem *p, const source list[], int count, double seconds, cost_track *track)
{
    int best = -1, farthest = 0, used = -1;
    for (int i = 0; i < count && !iso_cost_is_stopped(p); i++) {
        if (list[i].backend != ISO_BACKEND_EXACT && !list[i].method) continue;
        used = i;
        if (follow(p, &list[i], seconds, track) == ISO_OK) return i;
        if (track->reached > farthest) farthest = track->reached, best = i;
    }
    if (best >= 0 && best != used) follow(p, &list[best], seconds, track); /* again: the track holds another run */
    return best;
}

/* --- where to look ---------------------------------------------------------------------------------------------- */

enum { MOST_SOURCES = 16 };

typedef struct sources {
    int count;
    source list[MOST_SOURCES];
} sources;

static void add(sources *s, iso_backend backend, const iso_method *method, double tolerance)
{
    if (s->count < MOST_SOURCES) s->list[s->count++] = (source){backend, method, tolerance};
}

/* Methods with more digits than a double has, the most first. */
static void add_fine(sources *s, iso_backend backend)
{
    const iso_method *fine[MOST_SOURCES];
    int count = 0, digits = ISO_DOUBLE_DIGITS;
    for (const iso_method *m; count < MOST_SOURCES && (m = iso_method_with_more_digits(digits)); digits = m->digits)
        fine[count++] = m;
    while (count > 0) add(s, backend, fine[--count], 1e-15);
}

/* --- the reference, and what bears it out ----------------------------------------------------------------------- */

static iso_status find_first(cost_problem *p, double seconds, cost_reference *r, source *from)
{
    sources s = {0};
    add(&s, ISO_BACKEND_EXACT, NULL, 0);
    add_fine(&s, (iso_backend)p->scene->start.model);
    add(&s, ISO_BACKEND_BALL, iso_method_with_more_digits(ISO_DOUBLE_DIGITS), 1e-15);
    /* what stiff models need: the implicit witnesses, and the last of them, which goes farthest, at a looser tolerance */
    const iso_method *last = NULL, *m;
    for (int place = 1; (m = iso_method_witness(place)); place++)
        if (m->implicit) add(&s, ISO_BACKEND_BALL, last = m, 1e-14);
    if (last) add(&s, ISO_BACKEND_BALL, last, 1e-12);
    const int i = best_source(p, s.list, s.count, seconds, &r->first);
    if (iso_cost_is_stopped(p)) return iso_context_stopped(p->user);
    if (i < 0 || r->first.reached < r->first.times)
        return ISO_FAIL_NUMERICAL(p->user, "no reference gets to %s = %s in %.2g s: %s", iso_clock_name(p->clock),
                                  ISO_SHORT(p->end), seconds, iso_context_message(p->ctx));
    *from = s.list[i];
    r->exact = from->backend == ISO_BACKEND_EXACT;
    describe(from, r->what);
    return ISO_OK;
}

/* A second reference by extended precision, in the formulation (ball or point) that the first does not use; if the
 * first is the closed solution, in that of the start. */
static bool find_by_series(cost_problem *p, const source *first, double seconds, cost_reference *r)
{
    const iso_backend own = (iso_backend)p->scene->start.model,
                      other = own == ISO_BACKEND_BALL ? ISO_BACKEND_POINT : ISO_BACKEND_BALL;
    const iso_backend backend = first->backend == ISO_BACKEND_EXACT ? own : first->backend == own ? other : own;
    sources s = {0};
    add_fine(&s, backend);
    const int i = best_source(p, s.list, s.count, seconds, &r->second);
    if (i < 0 || r->second.reached < r->first.reached) return false;
    describe(&s.list[i], r->second_what);
    return true;
}

/* Another method (iso_method.witness) for the same equations, the ball's: of all runs that come as far as the first,
 * the one that is nearest to it. */
static bool find_by_others(cost_problem *p, const source *first, double seconds, cost_reference *r)
{
    static const double tolerances[] = {1e-13, 1e-14, 1e-15};
    source best = {ISO_BACKEND_BALL, NULL, 0}, now = best;
    double least = INFINITY;
    for (int place = 1; (now.method = iso_method_witness(place)); place++)
        for (int i = 0; i < 3 && !iso_cost_is_stopped(p); i++) {
            now.tolerance = tolerances[i];
            if (now.method == first->method && now.tolerance == first->tolerance) continue;
            follow(p, &now, seconds, &r->second);
            if (r->second.reached < r->first.reached) break; /* tighter tolerances do not get there either */
            const double off = iso_cost_distance(&r->first, &r->second);
            if (off < least) best = now, least = off;
        }
    if (!best.method || follow(p, &best, 2 * seconds, &r->second) != ISO_OK)
        return false; /* r->second held the last run */
    describe(&best, r->second_what);
    return true;
}

iso_status iso_cost_reference_find(cost_problem *p, int times, const double time[], double seconds, cost_reference *r)
{
    source from;
    *r = (cost_reference){.uncertainty = INFINITY};
    ISO_TRY(iso_cost_track_make(p, times, time, &r->first));
    ISO_TRY(iso_cost_track_make(p, times, time, &r->second));
    ISO_TRY(find_first(p, seconds / 3, r, &from));
    snprintf(r->second_what, sizeof r->second_what, "none");
    r->doubted = find_by_series(p, &from, seconds / 3, r);
    if (!r->doubted) r->doubted = find_by_others(p, &from, seconds / 24, r);
    if (r->doubted) r->uncertainty = iso_cost_distance(&r->first, &r->second);
    if (iso_cost_is_stopped(p)) return iso_context_stopped(p->user);
    return ISO_OK;
}

void iso_cost_reference_free(cost_reference *r)
{
    iso_cost_track_free(&r->first);
    iso_cost_track_free(&r->second);
}

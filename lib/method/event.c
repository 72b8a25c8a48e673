/* event.c - zeros of a function of the state, the same for every method.
 *
 * Each step is looked at in four parts. Where g changes its sign over a part the zero is bracketed, and Brent's
 * method finds it, reaching every trial time by a leap from the step's left end. Where g has the same sign at both
 * ends of a part but comes towards zero at one end and leaves it at the other, there may be two zeros: the minimum
 * of |g| between them is sought first, and splits the part in two.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_roots.h>
#include <math.h>

#include "base/vec3_impl.h"
#include "method/integrator_impl.h"

enum { PARTS = 4, MAX_ITERATIONS = 200 };

typedef struct search {
    iso_integrator *it;
    const iso_event *event;
    double sign;       /* what g is multiplied with, to seek a minimum of a positive function */
    iso_status status; /* of the leaps                                                        */
} search;

/* One place of the current step: dt from its left end. */
typedef struct place {
    double dt, g;
} place;

static double g_at(double dt, void *data)
{
    search *s = data;
    double y[ISO_MAX_STATE];
    if (s->status == ISO_OK) s->status = iso_leap(s->it, dt, y);
    return s->status == ISO_OK ? s->sign * s->event->g(&s->it->model, y, s->event->data) : 0;
}

/* dg/dt by a difference over a millionth of the step. */
static double slope(search *s, double dt)
{
    const double d = s->it->h * 1e-6;
    return (g_at(dt + d, s) - g_at(dt - d, s)) / (2 * d);
}

static double find_zero(search *s, double a, double b)
{
    gsl_function f = {g_at, s};
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    if (!solver || gsl_root_fsolver_set(solver, &f, fmin(a, b), fmax(a, b)) != GSL_SUCCESS) {
        s->status = iso_context_fail(s->it->ctx, ISO_NO_MEMORY, "", "no memory to find an event");
        gsl_root_fsolver_free(solver);
        return a;
    }
    double root = a;
    for (int i = 0; i < MAX_ITERATIONS && s->status == ISO_OK; i++) {
        if (gsl_root_fsolver_iterate(solver) != GSL_SUCCESS) break;
        root = gsl_root_fsolver_root(solver);
        const double low = gsl_root_fsolver_x_lower(solver), high = gsl_root_fsolver_x_upper(solver);
        if (high - low <= 2e-16 * fmax(fabs(root), fabs(s->it->left.head))) break;
    }
    gsl_root_fsolver_free(solver);
    return root;
}

/* A place between a and b where s->sign * g is not positive, if there is one; g(a), g(b) have the sign s->sign. */
static bool find_dip(search *s, double a, double b, place *dip)
{
    bool found = false;
    double x = a + (b - a) / 2;
    gsl_function f = {g_at, s};
    const double low = fmin(a, b), high = fmax(a, b), g_low = g_at(low, s), g_high = g_at(high, s);
    /* GSL's search wants a place below both ends: on the way down from the lower one there is one */
    for (int i = 0; i < 40 && !(g_at(x, s) < fmin(g_low, g_high)); i++) x = g_low < g_high ? (low + x) / 2 : (x + high) / 2;
    const double g_x = g_at(x, s);
    if (!(g_x < fmin(g_low, g_high)) || s->status != ISO_OK) return false;
    *dip = (place){x, g_x};
    if (g_x <= 0) return true;
    gsl_min_fminimizer *m = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    if (m && gsl_min_fminimizer_set_with_values(m, &f, x, g_x, low, g_low, high, g_high) == GSL_SUCCESS)
        for (int i = 0; i < MAX_ITERATIONS && !found && s->status == ISO_OK; i++) {
            if (gsl_min_fminimizer_iterate(m) != GSL_SUCCESS) break;
            *dip = (place){gsl_min_fminimizer_x_minimum(m), gsl_min_fminimizer_f_minimum(m)};
            found = dip->g <= 0;
            if (gsl_min_fminimizer_x_upper(m) - gsl_min_fminimizer_x_lower(m) <= 1e-9 * (high - low)) break;
        }
    gsl_min_fminimizer_free(m);
    return found;
}

/* Whether a change from g_a to g_b, a before b on the way, is an event of the wanted direction in growing time. */
static bool counts(const search *s, double g_a, double g_b)
{
    if (g_a == 0 || (g_a > 0) == (g_b > 0)) return false;
    const int upwards = ((g_b > g_a) ? 1 : -1) * s->it->direction;
    return s->event->direction == 0 || s->event->direction == upwards;
}

/* The first event in (a, b], which lies in one part. */
static bool search_part(search *s, place a, place b, double *dt)
{
    if (counts(s, a.g, b.g)) {
        *dt = b.g == 0 ? b.dt : find_zero(s, a.dt, b.dt);
        return s->status == ISO_OK;
    }
    if (a.g == 0 || b.g == 0 || (a.g > 0) != (b.g > 0)) return false;
    const double sign = a.g > 0 ? 1 : -1, away = sign * s->it->direction; /* sign of slopes that leave zero */
    if (!(away * slope(s, a.dt) < 0 && away * slope(s, b.dt) > 0)) return false;
    place dip;
    s->sign = sign;
    const bool crosses = find_dip(s, a.dt, b.dt, &dip);
    s->sign = 1;
    dip.g *= sign;
    if (!crosses) return false;
    const bool first = counts(s, a.g, -sign);
    if (!first && !counts(s, -sign, b.g)) return false;
    if (dip.g == 0) return false; /* touches only */
    *dt = first ? find_zero(s, a.dt, dip.dt) : find_zero(s, dip.dt, b.dt);
    return s->status == ISO_OK;
}

/* The first event between dt = from and dt = to within the current step. */
static bool search_step(search *s, double from, double to, double *dt)
{
    place a = {from, g_at(from, s)};
    for (int i = 1; i <= PARTS && s->status == ISO_OK; i++) {
        const double end = i == PARTS ? to : from + (to - from) * i / PARTS;
        const place b = {end, g_at(end, s)};
        if (search_part(s, a, b, dt)) return true;
        a = b;
    }
    return false;
}

iso_status iso_integrator_event(iso_integrator *it, const iso_event *event, double from, double to, bool *found,
                                double *t, double y[])
{
    const int direction = to > 0 ? 1 : -1;
    *found = false;
    if (!isfinite(from) || !isfinite(to) || direction * from < 0 || direction * (to - from) < 0)
        return iso_context_fail(it->ctx, ISO_BAD_ARGUMENT, "", "events are sought away from 0: %g to %g is not", from, to);
    search s = {.it = it, .event = event, .sign = 1, .status = iso_integrator_reach(it, direction, from)};
    double begin = s.status == ISO_OK ? iso_integrator_since(it, from) + 1e-9 * it->h : 0, dt;
    while (s.status == ISO_OK) {
        const double rest = iso_integrator_since(it, to);
        const bool last = direction * (rest - it->h) <= 0;
        const double end = last ? rest : it->h;
        if (direction * (end - begin) > 0 && search_step(&s, begin, end, &dt)) {
            *found = true;
            *t = it->left.head + (it->left.tail + dt);
            return iso_leap(it, dt, y);
        }
        if (last || s.status != ISO_OK) break;
        s.status = iso_integrator_advance(it);
        begin = 0;
    }
    return s.status;
}

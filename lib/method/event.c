/* event.c - zeros of a function of the state, the same for every method.
 *
 * Each step is divided into parts over which the state changes by about a quarter of its size.
 * - Where g changes its sign over a part, the zero is bracketed, and Brent's method finds it. It reaches every trial
 *   time from the left end of the step.
 * - Where g has the same sign at both ends of a part, but goes towards zero at one end and away from it at the other,
 *   there may be two zeros. The extremum of g between them, a zero of its slope, is found first, and divides the
 *   part.
 * - At the end of a step the method's own state and that of dense output differ by the error of the step. A zero
 *   that falls into this gap is found once, and at the end of the step.
 */
#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "method/integrator_impl.h"

enum { PARTS_PER_CHANGE = 4, MOST_PARTS = 64, MAX_ITERATIONS = 200 };

typedef struct search {
    iso_integrator *it;
    const iso_event *event;
    double nearby;     /* a time in which the state hardly changes */
    iso_status status; /* of dense output                          */
} search;

/* One place of the current step: dt from its left end, g and its slope in growing time. */
typedef struct place {
    double dt, g, slope;
} place;

static double g_of(search *s, const double y[])
{
    const double g = s->event->g(&s->it->model, y, s->event->data);
    if (!isfinite(g) && s->status == ISO_OK)
        s->status = ISO_FAIL_NUMERICAL(s->it->ctx, "the event function is not finite");
    return s->status == ISO_OK ? g : 0;
}

/* g after the state y has moved with its velocity f for a time */
static double g_moved(search *s, const double y[], const double f[], double time)
{
    double moved[ISO_MAX_STATE];
    for (int i = 0; i < s->it->model.dim; i++) moved[i] = y[i] + time * f[i];
    return g_of(s, moved);
}

/* g and its slope at dt. Where g is exactly 0, its value a moment later is taken, so that every zero lies inside one
 * part: on the orbit, as a g that only touches 0 there passes it on the tangent; behind the step's end on the
 * tangent. */
static place look(search *s, double dt)
{
    iso_integrator *it = s->it;
    place p = {.dt = dt};
    double y[ISO_MAX_STATE], f[ISO_MAX_STATE];
    if (s->status == ISO_OK) s->status = iso_integrator_within(it, dt, y);
    if (s->status == ISO_OK && !iso_integrator_rhs(it, y, f))
        s->status = iso_integrator_stopped(it, "the equations of motion are not finite");
    if (s->status != ISO_OK) return p;
    const double before = g_moved(s, y, f, -s->nearby), after = g_moved(s, y, f, s->nearby);
    p.g = g_of(s, y);
    p.slope = after - before;
    if (p.g != 0) return p;
    const double later = dt + it->direction * s->nearby;
    if (fabs(later) > fabs(it->h)) {
        p.g = it->direction > 0 ? after : before;
    } else {
        if (s->status == ISO_OK) s->status = iso_integrator_within(it, later, y);
        p.g = s->status == ISO_OK ? g_of(s, y) : 0;
    }
    return p;
}

static double g_at(double dt, void *data)
{
    return look(data, dt).g;
}

static double slope_at(double dt, void *data)
{
    return look(data, dt).slope;
}

/* The zero between a and b of a function whose signs differ there. */
static double find_zero(search *s, double (*function)(double dt, void *data), double a, double b)
{
    gsl_function f = {function, s};
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
        if (high - low <= DBL_EPSILON * fmax(fabs(root), fabs(s->it->left.head))) break;
    }
    gsl_root_fsolver_free(solver);
    return root;
}

/* Whether g changes its sign from a to b, a before b on the way, in the wanted direction of growing time. */
static bool counts(const search *s, place a, place b)
{
    const int upwards = (b.g > a.g ? 1 : -1) * s->it->direction;
    return (a.g > 0) != (b.g > 0) && (s->event->direction == 0 || s->event->direction == upwards);
}

/* The first event in (a, b], which lies in one part. */
static bool search_part(search *s, place a, place b, double *dt)
{
    if (a.g == 0 || b.g == 0) return false; /* g is 0 there and just beyond: it passes nothing */
    place end = b;
    if ((a.g > 0) == (b.g > 0)) {
        const double away = (a.g > 0 ? 1 : -1) * s->it->direction; /* sign of slopes that leave zero */
        if (!(away * a.slope < 0 && away * b.slope > 0)) return false;
        end = look(s, find_zero(s, slope_at, a.dt, b.dt));
        if (end.g == 0 || !counts(s, a, end)) a = end, end = b;
    }
    if (a.g == 0 || !counts(s, a, end)) return false;
    *dt = find_zero(s, g_at, a.dt, end.dt);
    return s->status == ISO_OK;
}

/* The first event between dt = from and dt = to within the current step. */
static bool search_step(search *s, double from, double to, double *dt)
{
    iso_integrator *it = s->it;
    const double changes = PARTS_PER_CHANGE * fabs(it->h) * iso_integrator_rate(it, it->at_left);
    const double part = it->h / ceil(fmax(1, fmin(changes, MOST_PARTS)));
    s->nearby = 1e-6 * fabs(part);
    place a = look(s, from);
    while (s->status == ISO_OK && a.dt != to) {
        const double end = fabs(to - a.dt) < 1.5 * fabs(part) ? to : a.dt + part;
        const place b = look(s, end);
        if (s->status == ISO_OK && search_part(s, a, b, dt)) return true;
        a = b;
    }
    return false;
}

iso_status iso_integrator_event(iso_integrator *it, const iso_event *event, double from, double to, bool *found,
                                double *t, double y[])
{
    ISO_DEFAULT_ARITHMETIC;
    const int direction = to > 0 ? 1 : -1;
    *found = false;
    if (!isfinite(from) || !isfinite(to) || direction * from < 0 || direction * (to - from) < 0)
        return ISO_FAIL_ARGUMENT(it->ctx, "", "events are sought away from 0: %s to %s is not", ISO_SHORT(from),
                                 ISO_SHORT(to));
    search s = {.it = it, .event = event, .status = iso_integrator_reach(it, direction, from)};
    for (double dt; s.status == ISO_OK; s.status = iso_integrator_advance(it)) {
        const double skip = direction * fmax(1e-9 * fabs(it->h), 4 * DBL_EPSILON * fabs(from)); /* a zero at `from` */
        const double rest = iso_integrator_since(it, to), begin = iso_integrator_since(it, from) + skip;
        const bool last = direction * (rest - it->h) <= 0;
        const double a = direction * begin > 0 ? begin : 0, b = last ? rest : it->h;
        if (direction * (b - a) > 0 && search_step(&s, a, b, &dt)) {
            *found = true;
            *t = it->left.head + (it->left.tail + dt);
            return iso_integrator_within(it, dt, y);
        }
        if (last || s.status != ISO_OK) break;
    }
    return s.status;
}

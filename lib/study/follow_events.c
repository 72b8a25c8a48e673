/* follow_events.c - what happens to a followed orbit between two points of its curve, and exactly where. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/pi_impl.h"
#include "study/follow_impl.h"

iso_status iso_follow_add_event(const iso_follow_family *f, iso_branch *b, const iso_branch_event *e)
{
    iso_branch_event *larger = realloc(b->event, (b->events + 1) * sizeof *larger);
    if (!larger) return iso_context_fail(f->ctx, ISO_NO_MEMORY, "", "no memory for a branch");
    b->event = larger;
    b->event[b->events++] = *e;
    return ISO_OK;
}

/* The tests: each changes its sign where its event is. */
enum { TEST_FOLD, TEST_BREAKING, TEST_DIAGONAL, TEST_OTHER_DIAGONAL, TESTS };

static double test_of(const iso_follow_point *p, int test)
{
    return test == TEST_FOLD ? p->by_u : test == TEST_BREAKING ? p->across : p->diagonal[test - TEST_DIAGONAL];
}

/* Where the test is 0 on the curve, by halving and secants of the step from a. *part: of ds. */
static bool locate(const iso_follow_family *f, const iso_follow_point *a, const iso_follow_point *b, int test,
                   double ds, iso_follow_point *at, double *part)
{
    double low = 0, high = ds, at_low = test_of(a, test), at_high = test_of(b, test);
    for (int i = 0; i < 40 && fabs(high - low) > 1e-11; i++) {
        double next = i % 3 == 2 ? (low + high) / 2 : low + (high - low) * at_low / (at_low - at_high);
        const double room = 0.02 * (high - low); /* a secant that hugs an end leaves the other where it is */
        next = fmin(fmax(next, fmin(low + room, high - room)), fmax(low + room, high - room));
        int steps;
        if (!iso_follow_step(f, a, next, at, &steps)) return false;
        const double value = test_of(at, test);
        if ((value < 0) == (at_low < 0))
            low = next, at_low = value;
        else
            high = next, at_high = value;
    }
    *part = (low + high) / 2;
    int steps;
    return iso_follow_step(f, a, *part, at, &steps);
}

static void name(const iso_follow_family *f, const iso_follow_point *at, int test, iso_branch_event *e)
{
    iso_params p;
    const bool torus = iso_follow_params(f, at->value, &p) && fabs(fabs(p.k) - 1) < 1e-7;
    const char *vary = iso_vary_name((int)f->options.vary);
    e->kind = test == TEST_FOLD       ? ISO_BRANCH_FOLD
              : test == TEST_BREAKING ? ISO_BRANCH_BREAKING
                                      : ISO_BRANCH_DOUBLING;
    if (torus && test == TEST_BREAKING) e->kind = ISO_BRANCH_TORUS;
    static const char *const what[] = {
        "two orbits meet and vanish", "orbits of period %d branch off", "orbits with less symmetry branch off", "",
        "the orbit lies on a resonant torus"};
    if (e->kind == ISO_BRANCH_DOUBLING)
        snprintf(e->words, sizeof e->words, "orbits of period %d branch off at %s = %.12g", 2 * f->period, vary,
                 at->value);
    else
        snprintf(e->words, sizeof e->words, "%s at %s = %.12g", what[e->kind], vary, at->value);
}

iso_status iso_follow_events(const iso_follow_family *f, iso_branch *b, const iso_follow_point *a,
                             const iso_follow_point *to, double ds, double arc)
{
    iso_status status = ISO_OK;
    for (int test = 0; test < TESTS && status == ISO_OK; test++) {
        iso_branch_event e = {.axis = -1};
        iso_follow_point at;
        double part;
        if (test_of(a, test) * test_of(to, test) >= 0) continue;
        if (!locate(f, a, to, test, ds, &at, &part)) continue;
        name(f, &at, test, &e);
        e.at = iso_follow_tell(f, &at, arc + part);
        status = iso_follow_add_event(f, b, &e);
    }
    return status;
}

/* --- collisions ------------------------------------------------------------------------------------------------- */

/* The rotation at an end of the line. */
static int axis_at(const iso_follow_family *f, bool end)
{
    const int b = (f->axis + 1) % 3, c = (f->axis + 2) % 3;
    if (f->line == LINE_X) return end ? b : c;
    return end ? f->axis : f->line == LINE_0 ? c : b;
}

/* How many half-periods p half-turns of the rotation's neighbours make: p theta/pi, trace 2 cos theta. NaN: unstable. */
static double phase(const iso_follow_family *f, int axis, double value)
{
    iso_params p;
    if (!iso_follow_params(f, value, &p)) return NAN;
    const double trace = iso_hill_trace(p.k, p.J, axis, NULL);
    return fabs(trace) <= 2 ? f->period * acos(trace / 2) / ISO_PI : NAN;
}

bool iso_follow_collision(const iso_follow_family *f, const iso_follow_point *a, const iso_follow_point *b,
                          iso_branch_event *e)
{
    const bool end = b->u > ISO_PI / 4;
    const double near_a = end ? ISO_PI / 2 - a->u : a->u, near_b = end ? ISO_PI / 2 - b->u : b->u;
    const int axis = axis_at(f, end);
    /* value ~ value* + c u^2 */
    const double guess = b->value - (a->value - b->value) * near_b * near_b / (near_a * near_a - near_b * near_b);
    double x0 = guess, x1 = guess + 1e-6 * f->width;
    double p0 = phase(f, axis, x0);
    const double whole = round(p0);
    bool exact = isfinite(p0);
    for (int i = 0; i < 30 && exact && fabs(x1 - x0) > 1e-14 * f->width; i++) {
        const double p1 = phase(f, axis, x1), next = x1 - (p1 - whole) * (x1 - x0) / (p1 - p0);
        exact = isfinite(next) && fabs(next - guess) < 0.02 * f->width;
        x0 = x1, p0 = p1, x1 = next;
    }
    *e = (iso_branch_event){.kind = ISO_BRANCH_COLLISION, .axis = axis};
    iso_follow_point at = *b;
    at.value = exact ? x0 : guess;
    at.u = end ? ISO_PI / 2 : 0;
    e->at = iso_follow_tell(f, &at, 0);
    snprintf(e->words, sizeof e->words, "it shrinks onto the rotation about axis %d at %s = %.12g%s", axis + 1,
             iso_vary_name((int)f->options.vary), at.value, exact ? "" : " or so");
    return true;
}

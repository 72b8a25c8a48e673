/* continuation_curve.c - the curve F(u, value) = 0 of a symmetric periodic orbit: evaluation, corrector, one step; what
 * happens to the orbit between two points of the curve, and exactly where; and the orbits that branch off there. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdio.h>

#include "base/math_impl.h"
#include "base/names_impl.h"
#include "instrument/periodic/continuation_impl.h"
#include "map/section_impl.h"
#include "model/model_impl.h"

ISO_NAMES(iso_vary_name, int, "k", "J1", "J2", "J3", "ratio", "level")

bool iso_continuation_params(const iso_continuation *f, double value, iso_params *p, double *energy)
{
    double J[3] = {f->base.J[0], f->base.J[1], f->base.J[2]}, k = f->base.k, level = f->level;
    iso_params own;
    iso_units units;
    switch (f->options.vary) {
    case ISO_VARY_K: k = value; break;
    case ISO_VARY_J1: J[0] = value; break;
    case ISO_VARY_J2: J[1] = value; break;
    case ISO_VARY_J3: J[2] = value; break;
    case ISO_VARY_RATIO: J[1] = J[0] + value * (J[2] - J[0]); break;
    case ISO_VARY_LEVEL: level = value; break;
    }
    if (iso_params_reduced(f->ctx, k, J, &own) != ISO_OK) return false;
    iso_units_choose(&own, 1, &units);
    *p = units.own;
    *energy = iso_level_energy(p, level);
    return iso_section_axis(iso_free_point(p, 1)) == f->axis;
}

/* Half the orbit, from (u, v) to the line again. */
static bool shoot(const iso_continuation *f, double u, double v, iso_periodic_shot *shot)
{
    iso_params p;
    double energy;
    iso_periodic_map map;
    if (!iso_continuation_params(f, v * f->width, &p, &energy)) return false;
    iso_periodic_map_prepare(f->ctx, &p, energy, 1, &map);
    return iso_periodic_shoot(&map, &iso_return_extended, f->line, u, f->period, shot);
}

/* The slope by v, by differences: its error is of the order of h^2. */
static bool find_by_v(const iso_continuation *f, iso_continuation_point *at)
{
    const double h = 2e-5;
    iso_periodic_shot low, high;
    if (!shoot(f, at->u, at->v - h, &low) || !shoot(f, at->u, at->v + h, &high)) return false;
    at->by_v = ((double)high.off - (double)low.off) / (2 * h);
    return true;
}

bool iso_continuation_evaluate(const iso_continuation *f, double u, double v, bool slopes, iso_continuation_point *at)
{
    iso_periodic_shot shot;
    if (!shoot(f, u, v, &shot)) return false;
    at->u = u, at->v = v, at->value = v * f->width;
    for (int i = 0; i < 2; i++) at->z[i] = (double)shot.z[i];
    at->off = (double)shot.off;
    for (int i = 0; i < 4; i++) at->D[i / 2][i % 2] = (double)shot.D[i / 2][i % 2];
    at->trace = (double)shot.trace;
    return !slopes || find_by_v(f, at);
}

void iso_continuation_turn(iso_continuation_point *at, const double like[2])
{
    const double length = hypot(at->D[1][0], at->by_v);
    at->tangent[0] = -at->by_v / length;
    at->tangent[1] = at->D[1][0] / length;
    const double along = like ? at->tangent[0] * like[0] + at->tangent[1] * like[1] : at->tangent[1];
    if (along < 0) at->tangent[0] = -at->tangent[0], at->tangent[1] = -at->tangent[1];
}

/* Newton's method across the tangent of `a`; by_v is kept from the predicted point, and found again at the end. */
bool iso_continuation_step(const iso_continuation *f, const iso_continuation_point *a, double ds,
                           iso_continuation_point *to, int *steps)
{
    enum { MOST = 8 };
    const double *t = a->tangent;
    double u = a->u + ds * t[0], v = a->v + ds * t[1];
    bool there = false;
    for (*steps = 0; *steps < MOST && !there; ++*steps) {
        if (!iso_continuation_evaluate(f, u, v, *steps == 0, to)) return false;
        const double det = to->D[1][0] * t[1] - to->by_v * t[0];
        const double du = -to->off * t[1] / det, dv = to->off * t[0] / det, length = hypot(du, dv);
        if (!(length < 2 * fabs(ds) + 1e-9)) return false;
        there = length < 1e-12;
        u += du, v += dv;
    }
    if (!there || !find_by_v(f, to)) return false;
    iso_continuation_turn(to, t);
    return to->tangent[0] * t[0] + to->tangent[1] * t[1] > 0.9;
}

iso_branch_point iso_continuation_read(const iso_continuation_point *at, double arc)
{
    return (iso_branch_point){at->value, at->u, at->z[0], at->z[1], at->trace, arc};
}

/* --- events ----------------------------------------------------------------------------------------------------- */

#define SAME_PLACE 1e-8 /* along the curve: zeros that are closer are one ... */
#define TOO_CLOSE 1e-5  /* ... and those that are not as far apart may be one or two */

/* The tests: each changes its sign where its event is. The first four are numbers of D. */
enum { TEST_FOLD, TEST_BREAKING, TEST_DIAGONAL, TEST_OTHER_DIAGONAL, TEST_TURN, TESTS };

static double test_of(const iso_continuation_point *p, int test)
{
    const double of[TESTS] = {p->D[1][0], p->D[0][1], p->D[0][0], p->D[1][1], p->tangent[1]};
    return of[test];
}

/* The point at arc `next`, between low (at `from`) and high (at `to`): from the nearer one, then from the other. */
static bool between(const iso_continuation *f, const iso_continuation_point *low, const iso_continuation_point *high,
                    double from, double to, double next, iso_continuation_point *at)
{
    int steps;
    const bool first = next - from < to - next;
    if (iso_continuation_step(f, first ? low : high, first ? next - from : next - to, at, &steps)) return true;
    return iso_continuation_step(f, first ? high : low, first ? next - to : next - from, at, &steps);
}

/* Where the test is 0 on the curve, by halving and secants. *part: of ds. Where another branch of the same line
 * crosses, Newton's method fails next to the crossing: there the last two points are joined by a straight line. */
static void locate(const iso_continuation *f, const iso_continuation_point *a, const iso_continuation_point *b,
                   int test, double ds, iso_continuation_point *at, double *part)
{
    iso_continuation_point low = *a, high = *b;
    double from = 0, to = ds;
    for (int i = 0; i < 40 && to - from > 1e-12; i++) {
        const double F[2] = {test_of(&low, test), test_of(&high, test)}, room = 0.02 * (to - from);
        const double secant = from + (to - from) * F[0] / (F[0] - F[1]);
        double next = i % 3 == 2 ? (from + to) / 2 : fmin(fmax(secant, from + room), to - room);
        if (!between(f, &low, &high, from, to, next, at) &&
            !between(f, &low, &high, from, to, next = from + 0.3 * (to - from), at) &&
            !between(f, &low, &high, from, to, next = from + 0.7 * (to - from), at))
            break;
        if ((test_of(at, test) < 0) == (F[0] < 0))
            from = next, low = *at;
        else
            to = next, high = *at;
    }
    const double F[2] = {test_of(&low, test), test_of(&high, test)}, share = F[0] / (F[0] - F[1]);
    *at = low;
    at->u += share * (high.u - low.u);
    at->v += share * (high.v - low.v);
    at->value += share * (high.value - low.value);
    at->trace += share * (high.trace - low.trace);
    for (int i = 0; i < 2; i++) at->D[i][i] += share * (high.D[i][i] - low.D[i][i]);
    *part = from + share * (to - from);
}

/* Two moments that are equal at a value very near: it is set in *value, and their names. */
static bool are_equal(const iso_continuation *f, double *value, char names[2])
{
    const iso_vary vary = f->options.vary;
    const double *J = f->base.J;
    if (vary == ISO_VARY_K || vary == ISO_VARY_LEVEL) return false;
    for (int i = 0; i < 3; i++) {
        const int moved = vary == ISO_VARY_RATIO ? 1 : (int)vary - (int)ISO_VARY_J1;
        const double at = vary == ISO_VARY_RATIO ? (i == 2 ? 1 : 0) : J[i];
        if (i == moved || fabs(*value - at) > 1e-4 * fmax(fabs(at), f->width)) continue;
        *value = at;
        names[0] = (char)('1' + (i < moved ? i : moved));
        names[1] = (char)('1' + (i < moved ? moved : i));
        return true;
    }
    return false;
}

/* trace + 2 = 4 D_00 D_11/det D changes its sign where one of D_00 and D_11 is 0. Where both are, as they are where
 * half of an orbit with two symmetries has the trace 0, it only touches 0. How far from each other they are 0, along
 * the curve, the slope between both points says. */
static iso_branch_kind doubles(const iso_continuation_point *a, const iso_continuation_point *to, int test, double ds,
                               const iso_continuation_point *at)
{
    const int other = test == TEST_DIAGONAL ? TEST_OTHER_DIAGONAL : TEST_DIAGONAL;
    const double slope = (test_of(to, other) - test_of(a, other)) / ds, apart = fabs(test_of(at, other) / slope);
    const bool passes = (a->trace + 2) * (to->trace + 2) < 0;
    if (!(apart < TOO_CLOSE)) return ISO_BRANCH_DOUBLING;
    return apart < SAME_PLACE && !passes ? ISO_BRANCH_TOUCH : ISO_BRANCH_UNDECIDED;
}

/* Whether F of half the period is 0 as well. */
static bool has_half_period(const iso_continuation *f, const iso_continuation_point *at)
{
    iso_continuation half = *f;
    iso_continuation_point there;
    half.period = f->period / 2;
    return f->period % 2 == 0 && iso_continuation_evaluate(&half, at->u, at->v, false, &there) &&
           fabs(there.off) < 1e-4;
}

/* What happens at a zero of a test, and at which value of the parameter.
 *
 * Where the curve turns without a fold it meets another one: there this orbit branches off from one of half the period
 * or of more symmetry. At a touch the derivative of the return map is -1: half of the orbit,
 * up to its symmetry, has the multipliers i and -i, and orbits of four such halves may branch off. */
static void classify(const iso_continuation *f, const iso_continuation_point *a, const iso_continuation_point *to,
                     int test, double ds, iso_continuation_point *at, iso_branch_event *e)
{
    iso_params p;
    double energy;
    char J[2], *text = e->text;
    const size_t size = sizeof e->text;
    const char *vary = iso_vary_name((int)f->options.vary);
    const bool equal = are_equal(f, &at->value, J), turns = test == TEST_FOLD && a->tangent[1] * to->tangent[1] < 0;
    if (test == TEST_TURN) {
        const bool doubled = has_half_period(f, at);
        e->joins = true;
        e->kind = doubled ? ISO_BRANCH_DOUBLING : ISO_BRANCH_BREAKING;
        snprintf(text, size, "it branches off there from an orbit of %s at %s = %.12g",
                 doubled ? "half its period" : "more symmetry", vary, at->value);
    } else if (equal) {
        e->kind = ISO_BRANCH_TORUS;
        snprintf(text, size, "J%c = J%c: orbits fill tori, and this one is of no special kind", J[0], J[1]);
    } else if (test > TEST_BREAKING) {
        e->kind = doubles(a, to, test, ds, at);
        if (e->kind == ISO_BRANCH_DOUBLING)
            snprintf(text, size, "orbits of period %d branch off at %s = %.12g", 2 * f->period, vary, at->value);
        else
            snprintf(text, size, "%s at %s = %.12g; orbits of period %d may branch off",
                     e->kind == ISO_BRANCH_TOUCH ? "the trace touches -2 and does not pass it"
                                                 : "the trace touches -2, or passes it twice: undecided",
                     vary, at->value, 2 * f->period);
    } else {
        const bool torus = iso_continuation_params(f, at->value, &p, &energy) && fabs(fabs(p.k) - 1) < 1e-7;
        e->kind = turns ? ISO_BRANCH_FOLD : torus ? ISO_BRANCH_TORUS : ISO_BRANCH_BREAKING;
        snprintf(text, size, "%s at %s = %.12g",
                 turns   ? "two orbits meet and vanish"
                 : torus ? "the orbit lies on a resonant torus"
                         : "orbits with less symmetry branch off",
                 vary, at->value);
    }
}

iso_status iso_continuation_events(const iso_continuation *f, iso_branch *b, const iso_continuation_point *a,
                                   const iso_continuation_point *to, double ds, double arc)
{
    for (int test = 0; test < TESTS; test++) {
        iso_branch_event e = {.axis = -1};
        iso_continuation_point at;
        double part;
        bool known = false; /* of an orbit with two symmetries two tests have their zeros together */
        if (test_of(a, test) * test_of(to, test) >= 0) continue;
        if (test == TEST_TURN && a->D[1][0] * to->D[1][0] < 0) continue; /* a fold */
        locate(f, a, to, test, ds, &at, &part);
        /* half way the coordinates of what stays on the line can themselves turn over: the trace shows it */
        const double trace = test > TEST_BREAKING ? -2 : 2;
        if (iso_symmetry_line_is_half_way(f->line) && test != TEST_TURN && !(fabs(at.trace - trace) < 0.01)) continue;
        classify(f, a, to, test, ds, &at, &e);
        e.at = iso_continuation_read(&at, arc + part);
        for (const iso_branch_event *o = b->event; o < b->event + b->events; o++)
            known = known ||
                    (o->kind == e.kind && fabs(o->at.arc - e.at.arc) < (e.kind == ISO_BRANCH_TORUS ? 1e-3 : 1e-7));
        if (!known) ISO_TRY(iso_continuation_add_event(f, b, &e));
    }
    return ISO_OK;
}

/* --- collisions ------------------------------------------------------------------------------------------------- */

static double mismatch(const iso_continuation *f, int axis, double value, double target)
{
    iso_params p;
    double energy;
    return iso_continuation_params(f, value, &p, &energy) ? iso_hill_trace(p.k, p.J, energy, axis, NULL) - target
                                                          : NAN;
}

/* The trace of the rotation at a collision, 2 cos theta, nearest to what it is. Neighbours of a fixed point turn p
 * times by theta, whole half-turns in all. Those of the section's own axis cross the section every half-turn of
 * theirs: p of these are m half-turns of the rotation, p pi = m theta. */
static double target_of(const iso_continuation *f, int axis, double trace)
{
    const int p = f->period;
    double best = INFINITY;
    for (int m = 0; m <= (axis == f->axis ? 8 * p : p); m++) {
        const double target = 2 * cos(axis == f->axis ? p * ISO_PI / (m + 1) : m * ISO_PI / p);
        if (fabs(target - trace) < fabs(best - trace)) best = target;
    }
    return best;
}

bool iso_continuation_collision(const iso_continuation *f, const iso_continuation_point *a,
                                const iso_continuation_point *b, iso_branch_event *e)
{
    const bool end = b->u > ISO_PI / 4;
    const double near_a = end ? ISO_PI / 2 - a->u : a->u, near_b = end ? ISO_PI / 2 - b->u : b->u;
    const int axis = iso_symmetry_line_axis_at(f->axis, f->line, end);
    /* value ~ value* + c u^2, trace ~ 2 + d u^2 */
    const double part = near_b * near_b / (near_a * near_a - near_b * near_b);
    const double guess = b->value - (a->value - b->value) * part, trace = b->trace - (a->trace - b->trace) * part;
    const double doubt = 0.3 * fabs(guess - b->value) + 1e-6 * f->width;
    const double target = target_of(f, axis, mismatch(f, axis, guess, 0));
    double x0 = guess, x1 = guess + 1e-6 * f->width, F0 = mismatch(f, axis, x0, target);
    bool exact = isfinite(F0);
    for (int i = 0; i < 30 && exact && fabs(x1 - x0) > 1e-14 * f->width; i++) {
        const double F1 = mismatch(f, axis, x1, target), next = F1 == 0 ? x1 : x1 - F1 * (x1 - x0) / (F1 - F0);
        exact = isfinite(next) && fabs(next - guess) < doubt;
        x0 = x1, F0 = F1, x1 = next;
    }
    if (!exact || fabs(trace - 2) > 0.05) return false;
    *e = (iso_branch_event){.kind = ISO_BRANCH_COLLISION, .axis = axis};
    iso_continuation_point at = *b;
    at.value = x1;
    at.u = end ? ISO_PI / 2 : 0;
    at.z[0] = axis == (f->axis + 1) % 3 ? ISO_PI / 2 : 0; /* the fixed point of the rotation */
    at.z[1] = axis == f->axis ? 1 : 0;
    e->at = iso_continuation_read(&at, 0);
    snprintf(e->text, sizeof e->text, "it shrinks onto the rotation about axis %d at %s = %.12g", axis + 1,
             iso_vary_name((int)f->options.vary), at.value);
    return true;
}

/* --- what branches off ------------------------------------------------------------------------------------------ */

/* They begin next to the orbit. So beside each of its points on a symmetry line, F of the new period is sampled at a
 * value of the parameter a little to each side. There it has three zeros where branches are: the orbit itself, in the
 * middle, and two of the new orbit. The first one is taken. Orbits without a symmetry are not found. */

enum { SAMPLES = 40 };
#define ASIDE 0.004 /* of the range */
#define WINDOW 0.12 /* of the line, to each side */

/* The first of three zeros of F or more around `middle`, by halving; NaN: there are less, or it is a jump. */
static double first_of_three(const iso_continuation *f, double v, double middle)
{
    iso_continuation_point at;
    double before = NAN, u = NAN, off = NAN, h = 2 * WINDOW / SAMPLES;
    int zeros = 0;
    for (int i = 0; i <= SAMPLES; i++) {
        const double next = middle + WINDOW * (2.0 * i / SAMPLES - 1);
        if (!(next > 0 && next < ISO_PI / 2) || !iso_continuation_evaluate(f, next, v, false, &at)) continue;
        if (at.off * before < 0 && fabs(at.off - before) < 1 && zeros++ == 0) u = next - h, off = before;
        before = at.off;
    }
    if (zeros < 3) return NAN;
    for (int i = 0; i < 40 && fabs(h) > 1e-12; i++) {
        h /= 2;
        if (!iso_continuation_evaluate(f, u + h, v, false, &at)) return NAN;
        if ((at.off < 0) == (off < 0)) u += h;
    }
    return fabs(at.off) < 1e-3 * (1 + fabs(at.D[1][0])) ? u : NAN;
}

/* Where the orbit passes a line between its crossings `before` and z, or at z; NaN: nowhere. Half way u is as near as
 * samples allow. */
static double parameter_on(const iso_periodic_map *map, int line, const double before[2], const double z[2])
{
    enum { PLACES = 400 };
    const double near = 1e-4, l = fabs(remainder(z[0], ISO_PI)), x = fabs(z[1]);
    double image[2], u[PLACES], place[PLACES][2], by_u[PLACES][2], best = NAN, least = 0.02;
    if (line == LINE_X) return x < near ? l : NAN;
    if (!iso_symmetry_line_is_half_way(line))
        return fabs(l - (line == LINE_0 ? 0 : ISO_PI / 2)) < near ? asin(fmin(x, 1)) : NAN;
    iso_periodic_reverse(iso_symmetry_line_reversor(line), before, image);
    if (fabs(remainder(z[0] - image[0], 2 * ISO_PI)) > near || fabs(z[1] - image[1]) > near) return NAN;
    for (int i = 0; i < PLACES; i++) u[i] = ISO_PI / 2 * (i + 0.5) / PLACES;
    if (iso_periodic_place(map, line, PLACES, u, place, by_u) != ISO_OK) return NAN;
    for (int i = 0; i < PLACES; i++)
        if (iso_periodic_apart(place[i], z) < least) best = u[i], least = iso_periodic_apart(place[i], z);
    return best;
}

iso_status iso_continuation_switch(const iso_continuation *f, const iso_branch_event *e, iso_continuation *beside,
                                   double at[2], bool *found)
{
    iso_params p;
    double energy;
    iso_periodic_map map;
    const double from[1][2] = {{e->at.l, e->at.x}};
    iso_periodic_point point[2 * ISO_PERIODIC_MOST];
    const int halves = 2 * f->period;
    *found = false;
    *beside = *f;
    if (iso_continuation_doubles(e->kind)) beside->period *= 2;
    if (beside->period > ISO_PERIODIC_MOST || !iso_continuation_params(f, e->at.value, &p, &energy)) return ISO_OK;
    iso_periodic_map_prepare(f->ctx, &p, energy, 1, &map);
    ISO_TRY(iso_periodic_walk(&map, 1, from, halves, false, 1e-13, point));
    for (int i = 0; i < halves * LINES; i++) { /* beside each point of the orbit, on any line */
        const iso_periodic_point *z = &point[i / LINES], *last = &point[(i / LINES + halves - 1) % halves];
        beside->line = i % LINES;
        const double u =
            parameter_on(&map, beside->line, (const double[2]){last->l, last->x}, (const double[2]){z->l, z->x});
        for (int side = -1; side <= 1 && !isnan(u); side += 2) {
            at[1] = e->at.value + side * ASIDE * f->width;
            at[0] = first_of_three(beside, at[1] / f->width, u);
            *found = !isnan(at[0]);
            if (*found) return ISO_OK;
        }
    }
    return ISO_OK;
}

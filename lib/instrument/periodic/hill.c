/* hill.c - the rotations about the principal axes: Hill's equation over half a turn, in 64 and in 113 bits,
 * and the section's tangent map. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <complex.h>
#include <math.h>
#include <stdbool.h>

#include "base/context_impl.h"
#include "base/math_impl.h"
#include "instrument/periodic/periodic_impl.h"

/* --- the length of a step --------------------------------------------------------------------------------------- */

#define PART 0.3
enum { MOST_POINTS = 256 };

/* Singular points phi = at +- i height, and how fast y changes at most. */
typedef struct hill_pace {
    int points;
    double at[MOST_POINTS], height[MOST_POINTS], pace;
} hill_pace;

static void add_point(hill_pace *s, double at, double height)
{
    if (s->points < MOST_POINTS) s->at[s->points] = at, s->height[s->points++] = height;
}

static double level_at(double k, double energy, double q)
{
    return 1 + energy * pow(q, 1 / k);
}

/* q = m + d cos 2 phi. ratio: m/|d|; swing: J_i/(k min q). 1 + E q^(1/k) = 0 where ln q = -k ln |E| + i k pi n, n odd
 * for E > 0 and even for E < 0; where q goes round its zero farther than arg = 3 pi/2 no disc of convergence comes. */
static hill_pace pace_of(double k, double m, double d, double energy, double ratio, double swing)
{
    hill_pace s = {.points = 0};
    add_point(&s, d > 0 ? ISO_PI / 2 : 0, d == 0 ? 1e3 : acosh(ratio) / 2);
    for (int n = energy > 0 ? 1 : 0; fabs(k) * n <= 1.5 && energy != 0 && d != 0; n += 2) {
        const double complex q = cexp(-k * log(fabs(energy)) + I * k * ISO_PI * n), phi = cacos((q - m) / d) / 2;
        add_point(&s, creal(phi), fabs(cimag(phi)));
        if (n > 0 || fabs(creal(phi)) > 0) add_point(&s, ISO_PI - creal(phi), fabs(cimag(phi)));
    }
    const double least = fmin(level_at(k, energy, m + d), level_at(k, energy, m - d));
    s.pace = sqrt(fabs(swing) / fmin(least, 1) + 1);
    return s;
}

static double step_from(const hill_pace *s, double phi)
{
    double h = 1 / (1 + s->pace);
    for (int i = 0; i < s->points; i++) {
        const double apart = fmin(fabs(phi - s->at[i]), fabs(phi - ISO_PI - s->at[i]));
        h = fmin(h, PART * hypot(apart, s->height[i]));
    }
    return h;
}

/* --- the matrix ------------------------------------------------------------------------------------------------- */

#define HILL(name) hill_##name
#define NUMBER long double
#define COS cosl
#define SIN sinl
#define POW powl
#define PI ISO_PI_LONG
#define TERMS 40 /* 0.3^40 = 1e-21 */
#include "instrument/periodic/hill_impl.h"
#undef HILL
#undef NUMBER
#undef COS
#undef SIN
#undef POW
#undef PI
#undef TERMS

#define HILL(name) hill_wide_##name
#define NUMBER iso_wide
#define COS WIDE_COS
#define SIN WIDE_SIN
#define POW WIDE_POW
#define PI WIDE_PI
#define TERMS 70 /* 0.3^70 = 3e-37 */
#include "instrument/periodic/hill_impl.h"

bool iso_hill_has_rotation(double k, const double J[3], double energy, int axis)
{
    return level_at(k, energy, J[(axis + 1) % 3]) > 0 && level_at(k, energy, J[(axis + 2) % 3]) > 0;
}

/* The determinant, which is 1, shows how many digits are lost. */
double iso_hill_trace(double k, const double J[3], double energy, int axis, double *error)
{
    long double y[2][2];
    if (error) *error = NAN;
    if (!(fabs(k) >= 1e-4) || !(fmin(fmin(J[0], J[1]), J[2]) > 0) || !isfinite(k * J[0] * J[1] * J[2])) return NAN;
    if (!isfinite(energy) || !iso_hill_has_rotation(k, J, energy, axis)) return NAN;
    hill_turn(k, J[axis], J[(axis + 1) % 3], J[(axis + 2) % 3], energy, y);
    const long double size = fabsl(y[0][0] * y[1][1]) + fabsl(y[0][1] * y[1][0]);
    const long double trace = y[0][0] + y[1][1];
    const double off = (double)fabsl(y[0][0] * y[1][1] - y[0][1] * y[1][0] - 1);
    if (error)
        *error = 1e-16 * fabs((double)trace) + 1e-17 * sqrt((double)size) + 4 * off * (1 + fabs((double)trace));
    return (double)trace;
}

/* --- the rotations ---------------------------------------------------------------------------------------------- */

/* By the derivative of g. g turns the deviation over: its trace has the other sign. The rotation about the section's
 * own axis never crosses it: the section of the next axis serves. */
static bool ask_section(iso_periodic_work *w, iso_rotation *r, iso_wide *trace)
{
    iso_periodic_map map = w->map;
    iso_periodic_fine found;
    const bool own = r->axis == map.axis;
    if (own) iso_periodic_map_turn((map.axis + 1) % 3, &map);
    const iso_wide z[2] = {r->axis == (map.axis + 1) % 3 ? WIDE_PI / 2 : 0, 0};
    if (!iso_periodic_far(&map, iso_return_build_of(w->options.polish), z, 1, NULL, &found)) return false;
    *trace = -(found.slope[0][0] + found.slope[1][1]);
    for (int c = 0; c < ISO_CLOCKS; c++) r->clock[c] = 2 * (double)found.clock[c] * w->unit_clock[c];
    return true;
}

/* Its error is how far apart three results are: Hill's equation in numbers of 113 bits, the section's derivative, and
 * Hill's equation in numbers of 64 bits. Polished, the first two have as many digits. */
static bool find_rotation(iso_periodic_work *w, int axis)
{
    iso_rotation *r = &w->out->rotation[axis];
    const iso_params *p = &w->map.p;
    iso_wide Y[2][2], section;
    *r = (iso_rotation){.axis = axis}; /* the section's own axis has the boundary */
    r->l = axis == (w->map.axis + 1) % 3 ? ISO_PI / 2 : 0;
    r->x = axis == w->map.axis;
    if (!iso_hill_has_rotation(p->k, p->J, w->map.energy, axis)) {
        r->oscillates = true;
        r->half_turn_trace = r->error = r->tail = r->by_section = r->turn_trace = NAN;
        r->half = (iso_multipliers){.stability = ISO_STABILITY_UNDECIDED, .value = {{NAN, NAN}, {NAN, NAN}}};
        for (int c = 0; c < ISO_CLOCKS; c++) r->clock[c] = NAN;
        return true;
    }
    hill_wide_turn(p->k, p->J[axis], p->J[(axis + 1) % 3], p->J[(axis + 2) % 3], w->map.energy, Y);
    const iso_wide wide = Y[0][0] + Y[1][1];
    const iso_fine trace = iso_fine_of(wide);
    r->half_turn_trace = trace.head;
    r->tail = trace.tail;
    if (!ask_section(w, r, &section)) return false;
    const double rough = fabs(iso_hill_trace(p->k, p->J, w->map.energy, axis, NULL) - (double)wide),
                 size = fabs((double)wide), apart = fabs((double)(section - wide));
    r->by_section = (double)section;
    r->error = w->options.polish ? fmax(apart, 1e-31 * size) : fmax(apart, fmax(rough, 0x1p-53 * size));
    r->turn_trace = trace.head * trace.head - 2;
    r->half = iso_multipliers_of(trace.head, fmax(4 * r->error, 1e-15), (double)Y[1][0]);
    return true;
}

iso_status iso_periodic_rotations(iso_periodic_work *w)
{
    for (int axis = 0; axis < 3; axis++)
        if (!find_rotation(w, axis))
            return iso_context_goes_on(w->ctx)
                       ? ISO_FAIL_NUMERICAL(w->ctx, "the rotation about axis %d was not followed", axis + 1)
                       : iso_context_stopped(w->ctx);
    return ISO_OK;
}

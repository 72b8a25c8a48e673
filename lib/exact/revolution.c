/* revolution.c - the form of one angle: two equal moments of inertia, and motion in a principal plane, for every k.
 *
 * The component x of gamma along the axis swings as latitude_impl.h says, as an elliptic function of an angle xi; the
 * rest is a quadrature, as d phi/ds = M_x/(1 - x^2), also with a rotor whose K is along the axis. What lies across the
 * axis is an elementary factor, which turns past the pole as fast as need be, times a smooth one:
 *
 *     gamma_1 + i gamma_2 = (sqrt(1 - a) cn + i sqrt(1 - b') sn) exp(i psi),    b' = max(b, 0)
 *
 * A principal plane is the same with M_x = 0: J_a and J_e are the moments of the two axes in it. A rotor at right
 * angles to it has no field in it.
 */
#include <math.h>
#include <stdlib.h>

#include "exact/form_impl.h"
#include "exact/latitude_impl.h"
#include "exact/series_impl.h"
#include "model/model_impl.h"

/* Where the rates of a clock differ by more than exp(MOST_SHARP), its series has no digits
 * left where they are small. */
static const real MOST_SHARP = 23;

enum { LEAST_SAMPLES = 32, MOST_SAMPLES = 1 << 15, PSI = ISO_CLOCKS, SERIES };

/* A function of xi: mean (xi - start) + sum_n b_n sin n xi - zero, 0 at the start. */
typedef struct growing {
    real mean;
    double zero, range, *b;
    int modes;
} growing;

typedef struct revolution {
    int axis[3]; /* the caller's axes, right-handed; the first is x's                     */
    bool plane;  /* a principal plane ...                                                 */
    int across;  /* ... and the axis that stands on it                                    */
    bool even;   /* a plane on H = 0: omega is a constant ...                             */
    double spin; /* ... and this is sqrt(J) omega = M/NN across the plane                 */
    iso_params params;
    latitude x;
    real det, force; /* det J/k^2; mean of (M^2 + M_x M_x[y,1]) ds/dxi                        */
    elliptic f;
    real start; /* xi at time 0, plus half a period of sn where half is -1               */
    int half;
    double turned[2], sense; /* exp(i longitude) of the smooth factor at time 0; of growing longitude */
    growing of[SERIES];      /* the clocks, and psi (in the sense of growing longitude)               */
} revolution;

/* --- the series ------------------------------------------------------------------------------------------------- */

/* y = x^2 from the elliptic functions */
static real square_at(const revolution *r, real cn, real dn)
{
    return r->x.a * (r->x.side ? dn * dn : cn * cn);
}

/* The series of f from samples of f' in `a`. False: too few samples, or no memory. */
static bool integrate(growing *f, double a[], int N, double work[])
{
    cosine_series(a, N, 1, work);
    const double most = largest_of(a, 0, N);
    if (!isfinite(most) || !(largest_of(a, N - N / 16, N) <= 1e-15 * most)) return false;
    f->modes = 0;
    for (int n = 1; n <= N; n++)
        if (fabs(a[n]) > 2e-17 * most) f->modes = n;
    f->b = malloc(((size_t)f->modes + 1) * sizeof *f->b);
    for (int n = 1; f->b && n <= f->modes; n++) {
        f->b[n] = a[n] / n;
        f->range += fabs(f->b[n]);
    }
    return f->b != NULL;
}

static void forget(revolution *r)
{
    for (int i = 0; i < SERIES; i++) {
        free(r->of[i].b);
        r->of[i] = (growing){0};
    }
}

/* All series from N + 1 samples of d/dxi of the clocks and of psi, which are even about xi = 0 and pi. False: too few
 * samples, or no memory. */
static bool make_series(revolution *r, int N, double *samples, double work[])
{
    const real stretch = r->f.K / ISO_PI_LONG;
    forget(r);
    r->force = 0;
    for (int j = 0; j <= N; j++) {
        real sn, cn, dn, rate[SERIES];
        iso_elliptic_at(&r->f, ISO_PI_LONG * j / N, &sn, &cn, &dn);
        const real weight = (j % N == 0 ? 0.5L : 1) / N, y = square_at(r, cn, dn), q = iso_latitude_q(&r->x, y);
        const real ds = stretch / iso_latitude_rate(&r->x, y, dn, &rate[PSI]);
        rate[PSI] *= stretch;
        rate[ISO_CLOCK_S] = ds;
        rate[ISO_CLOCK_TAU] = r->det * powl(q, r->x.power) * ds;
        rate[ISO_CLOCK_T] = r->det * powl(q, r->x.power / 2 - 1) * ds;
        const real more = iso_latitude_Mx(&r->x, y) * iso_latitude_Mx_slope(&r->x, y, 1);
        r->force += weight * ds * (iso_latitude_m(&r->x, y) + more);
        for (int i = 0; i < SERIES; i++) {
            samples[i * (N + 1) + j] = (double)rate[i];
            r->of[i].mean += weight * rate[i];
        }
    }
    bool enough = true;
    for (int i = 0; i < SERIES && enough; i++) enough = integrate(&r->of[i], samples + i * (N + 1), N, work);
    return enough;
}

/* A power q^p has the width 1/sqrt(p) between its values on the axis and across it. */
static iso_status find_series(revolution *r)
{
    const real p = r->x.power, sharp = fmaxl(fabsl(p), fabsl(p / 2 - 1)) * fabsl(logl(r->x.Ja / r->x.Je));
    int least = LEAST_SAMPLES;
    while (least < 32 * sqrtl(1 + sharp) && least < MOST_SAMPLES) least *= 2;
    if (sharp > MOST_SHARP) return ISO_NUMERICAL;
    for (int N = least; N <= MOST_SAMPLES; N *= 2) {
        double *samples = malloc(SERIES * ((size_t)N + 1) * sizeof *samples),
               *work = malloc(2 * (size_t)N * sizeof *work);
        const bool room = samples && work, done = room && make_series(r, N, samples, work);
        free(samples);
        free(work);
        if (!room) return ISO_NO_MEMORY;
        if (done) return ISO_OK;
    }
    return ISO_NUMERICAL;
}

/* r->of[i] and its slope. */
static real growing_at(const revolution *r, int i, real along, real *slope)
{
    const growing *f = &r->of[i];
    double part;
    const double series = sine_series(f->b, f->modes, (double)remainderl(r->start + along, 2 * ISO_PI_LONG), &part);
    *slope = f->mean + part;
    return f->mean * along + (series - f->zero);
}

/* --- the state -------------------------------------------------------------------------------------------------- */

/* x, the elementary factor h of gamma_1 + i gamma_2, their rates in s, and M_x */
typedef struct swinging {
    double x, dx, h[2], dh[2], Mx;
} swinging;

/* At xi, or (half = -1) half a period of sn later. The rates only if they are asked for. They come from dx/ds itself
 * and not from the series of s: where a rate is small beside its largest value the series has lost its digits. */
static swinging swing_at(const revolution *r, double xi, int half, bool rates)
{
    real sn_l, cn_l, dn_l;
    iso_elliptic_at(&r->f, xi, &sn_l, &cn_l, &dn_l);
    const double sn = half * (double)sn_l, cn = half * (double)cn_l, dn = (double)dn_l;
    const real y = square_at(r, cn_l, dn_l);
    const double W = rates ? (double)iso_latitude_rate(&r->x, y, dn_l, NULL) : 0;
    const double root_a = sqrt((double)r->x.a), up = r->x.x0 < 0 ? -1 : 1, wide = sqrt((double)r->x.rest_b);
    return (swinging){
        .x = r->x.side ? up * root_a * dn : root_a * cn,
        .dx = r->x.side ? -up * (double)r->x.a_b / root_a * sn * cn * W : -root_a * sn * dn * W,
        .h = {sqrt((double)r->x.rest_a) * cn, r->sense * wide * sn},
        .dh = {0, r->sense * wide * cn * dn * W}, /* at the pole, the only place that asks: there sn = 0 */
        .Mx = (double)iso_latitude_Mx(&r->x, y),
    };
}

static void turn(const double by[2], double h[2])
{
    const double x = h[0] * by[0] - h[1] * by[1];
    h[1] = h[0] * by[1] + h[1] * by[0];
    h[0] = x;
}

/* From x, h = gamma_1 + i gamma_2 and their rates: gamma' = gamma x M and (M,gamma) = 0 give M = gamma' x gamma, and
 * with M_x the component across obeys h' = (-x x' - i M_x)/conj(h). In a plane on H = 0 the ball turns evenly, and
 * M = NN sqrt(J) omega takes no rates. */
static void state_at(const revolution *r, real along, double point[ISO_STATE])
{
    real unused;
    int turns;
    const double psi = r->sense * (double)remainderl(growing_at(r, PSI, along, &unused), 2 * ISO_PI_LONG);
    const double xi = (double)remquol(r->start + along, 2 * ISO_PI_LONG, &turns), by[2] = {cos(psi), sin(psi)};
    swinging at = swing_at(r, xi, turns % 2 == 0 ? r->half : -r->half, !r->even);
    turn(by, at.h), turn(r->turned, at.h);
    turn(by, at.dh), turn(r->turned, at.dh);
    const double rest = at.h[0] * at.h[0] + at.h[1] * at.h[1], u = -at.x * at.dx, w = -at.Mx;
    if (rest > 0) {
        at.dh[0] = (u * at.h[0] - w * at.h[1]) / rest;
        at.dh[1] = (w * at.h[0] + u * at.h[1]) / rest;
    }
    const double g[3] = {at.x, at.h[0], at.h[1]}, d[3] = {at.dx, at.dh[0], at.dh[1]};
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        const bool out = r->plane && r->axis[i] == r->across, in = r->plane && !out;
        point[r->axis[i]] = i == 0 ? at.Mx : in ? 0 : d[j] * g[l] - d[l] * g[j];
        point[3 + r->axis[i]] = out ? 0 : g[i];
    }
    if (!r->even) return;
    point[r->across] = r->spin;
    iso_point_in_t_to_point(&r->params, point, point);
}

/* --- from a state ----------------------------------------------------------------------------------------------- */

/* Whether v is along the axis. */
static bool is_along(const double v[3], int axis)
{
    return v[(axis + 1) % 3] == 0 && v[(axis + 2) % 3] == 0;
}

/* The axis across a principal plane in which the point is and stays; -1: none. */
static int across_plane(const iso_problem *f, const double point[ISO_STATE])
{
    const double *K = iso_effects_rotor(&f->effects);
    for (int i = 0; i < 3; i++)
        if (point[3 + i] == 0 && is_along(point, i) && is_along(K, i)) return i;
    return -1;
}

/* The axis of revolution; -1: none. */
static int symmetry_axis(const iso_problem *f)
{
    const double *K = iso_effects_rotor(&f->effects);
    for (int i = 0; i < 3; i++)
        if (iso_params_symmetric(&f->p, i) && is_along(K, i)) return i;
    return -1;
}

static bool serves(const iso_problem *f, const double point[ISO_STATE])
{
    return across_plane(f, point) >= 0 || symmetry_axis(f) >= 0;
}

/* gamma, gamma' = gamma x M on |gamma| = 1, (M,gamma) = 0 and the level H = 0. */
static void read_state(revolution *r, const double point[ISO_STATE], real g[3], real d[3])
{
    real M[3], length = 0, along = 0, M2 = 0;
    for (int i = 0; i < 3; i++) g[i] = point[3 + r->axis[i]], M[i] = point[r->axis[i]], length += g[i] * g[i];
    for (int i = 0; i < 3; i++) g[i] /= sqrtl(length), along += M[i] * g[i];
    for (int i = 0; i < 3; i++) M[i] -= along * g[i], M2 += M[i] * M[i];
    r->x.y0 = g[0] * g[0];
    if (r->x.H == 0) { /* the level is restored; another is what M says */
        const real scale = sqrtl(iso_latitude_m(&r->x, r->x.y0) / M2);
        for (int i = 0; i < 3; i++) M[i] *= scale;
    }
    r->x.M2 = M2;
    for (int i = 0; i < 3; i++) d[i] = g[(i + 1) % 3] * M[(i + 2) % 3] - g[(i + 2) % 3] * M[(i + 1) % 3];
    r->x.x0 = g[0], r->x.dx0 = d[0], r->x.Mx = r->plane ? 0 : M[0];
}

static void read_body(revolution *r, const iso_problem *f, const double point[ISO_STATE])
{
    const int plane = across_plane(f, point), next = (plane + 1) % 3, last = (plane + 2) % 3;
    const int nearer =
        fabs(point[3 + next]) < fabs(point[3 + last]) ? next : last; /* to the equator: y has digits there */
    const int first = plane >= 0 ? nearer : symmetry_axis(f);
    r->plane = plane >= 0;
    r->across = plane;
    for (int i = 0; i < 3; i++) r->axis[i] = (first + i) % 3;
    const real *const J = (const real[]){f->p.J[0], f->p.J[1], f->p.J[2]};
    r->x.Ja = J[first]; /* of moments that differ by rounding the mean: what they differ by averages out in a turn */
    r->x.Je = plane < 0 ? (J[(first + 1) % 3] + J[(first + 2) % 3]) / 2 : J[first == next ? last : next];
    r->x.eps = f->eps, r->x.H = f->energy, r->x.power = -1 / (real)f->p.k;
    r->det = J[0] * J[1] * J[2] / ((real)f->p.k * f->p.k);
    /* In a plane on H = 0 the moving ball's energy J omega^2/2 = h is all of it: omega is a constant, and M goes like
     * NN ~ q^(-1/(2k)). Computed from there the state's omega is that constant again to rounding, for every k; from
     * gamma' it has the rounding errors of a power, 1/(2k) times as many. */
    r->params = f->p;
    r->even = r->plane && f->energy == 0;
    if (r->even) r->spin = copysign(sqrt(2 * iso_energy(&f->p, f->eps)), point[r->across] * f->p.k);
    if (!r->plane)
        r->x.field = r->det / sqrtl(J[0] * J[1] * J[2]) * sqrtl(r->x.Ja) * iso_effects_rotor(&f->effects)[first] / 2;
}

/* xi at the start: P = (a - y)(y - b) Q gives what sn^2 takes of y0 */
static void find_start(revolution *r)
{
    const int up = r->x.x0 < 0 ? -1 : 1, rising = r->x.dx0 < 0 ? -1 : 1;
    const real from_a = sqrtl(iso_latitude_distance(&r->x, r->x.a));
    const real sn = r->x.side ? from_a : -rising * from_a;
    const real cn = r->x.side ? -up * rising * sqrtl(iso_latitude_distance(&r->x, r->x.b)) : r->x.x0;
    r->half = cn < 0 ? -1 : 1; /* so that a small sn keeps its digits */
    r->start = sn == 0 ? 0 : iso_elliptic_inverse(&r->f, r->half * sn, r->half * cn);
}

/* exp(i longitude) of the smooth factor: what gamma across the axis (at the pole, its rate) is beside the other. */
static void find_longitude(revolution *r, const real g[3], const real d[3])
{
    for (int i = 0; i < SERIES; i++) {
        real unused;
        r->of[i].zero = (double)growing_at(r, i, 0, &unused);
    }
    const bool pole = g[1] == 0 && g[2] == 0;
    const swinging at = swing_at(r, (double)r->start, r->half, pole);
    const double *elementary = pole ? at.dh : at.h;
    const double y[2] = {(double)(pole ? d[1] : g[1]), (double)(pole ? d[2] : g[2])};
    r->turned[0] = elementary[0] * y[0] + elementary[1] * y[1];
    r->turned[1] = elementary[0] * y[1] - elementary[1] * y[0];
    const double length = hypot(r->turned[0], r->turned[1]);
    r->turned[0] = length > 0 ? r->turned[0] / length : 1;
    r->turned[1] = length > 0 ? r->turned[1] / length : 0;
}

static iso_status make(const iso_problem *f, const double point[ISO_STATE], const bool clocks[ISO_CLOCKS],
                       form_motion *m)
{
    (void)clocks; /* all of them cost little */
    real g[3], d[3];
    revolution *r = m->data = calloc(1, sizeof *r);
    if (!r) return ISO_NO_MEMORY;
    read_body(r, f, point);
    read_state(r, point, g, d);
    iso_latitude_range(&r->x);
    r->sense = -(double)r->x.sense;
    const latitude *x = &r->x;
    iso_elliptic_set(&r->f, !x->has_b ? 1 : x->side ? x->b / x->a : x->b / (x->b - x->a));
    find_start(r);
    const iso_status status = find_series(r);
    if (status == ISO_OK) find_longitude(r, g, d);
    for (int c = 0; c < ISO_CLOCKS; c++) m->rate[c] = r->of[c].mean;
    m->unstable = x->homoclinic ? r->axis[0] : -1;
    return status;
}

/* --- the form --------------------------------------------------------------------------------------------------- */

static void find(const void *data, iso_clock clock, real time, form_place *p)
{
    const revolution *r = data;
    const growing *f = &r->of[clock];
    const real about = (time + f->zero) / f->mean, around = f->range / f->mean;
    real low = about - around, high = about + around, slope;
    if (isnan(p->along)) p->along = about;
    for (int i = 0; i < 100; i++) {
        const real miss = growing_at(r, (int)clock, p->along, &slope) - time;
        *(miss > 0 ? &high : &low) = p->along;
        const real next = p->along - miss / slope;
        if (fabsl(next - p->along) <= 1e-9L) {
            p->along = next;
            break;
        }
        p->along = next > low && next < high && i % 8 != 7 ? next : (low + high) / 2;
    }
    for (iso_clock k = 0; k < ISO_CLOCKS; k++)
        p->clock[k] = k == clock ? time : growing_at(r, (int)k, p->along, &slope);
    state_at(r, p->along, p->point);
}

static void describe(const void *data, const bool clocks[ISO_CLOCKS], iso_exact_torus *to)
{
    const revolution *r = data;
    const real swing = r->x.side && !r->plane ? 1 : 0.5L,
               turning = 0.5L + r->of[PSI].mean; /* of both angles, by xi */
    to->kind = r->plane ? ISO_EXACT_PLANE : ISO_EXACT_SYMMETRIC;
    to->angles = r->plane ? 1 : 2;
    to->action[0] = (double)((r->force - r->x.sense * iso_latitude_Mx(&r->x, 1) * turning) / swing);
    if (!r->plane) to->action[1] = (double)iso_latitude_Mx(&r->x, 0), to->distance = (double)r->x.distance;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        if (!clocks[c]) continue;
        to->frequency[c][0] = (double)(swing / r->of[c].mean);
        if (!r->plane) to->frequency[c][1] = (double)(turning / r->of[c].mean);
    }
}

static void release(void *data)
{
    if (data) forget(data);
    free(data);
}

const iso_form iso_form_revolution = {
    .serves = serves, .make = make, .free = release, .find = find, .describe = describe};

/* torus.c - the separated form: the two oscillations of u and v side by side, and the clocks t, tau, s.
 *
 *  (1) The angles grow evenly: theta_u = start_u + omega_u sigma, theta_v = start_v + omega_v sigma. The state is a
 *      function of the two angles.
 *  (2) The rate d clock/dsigma is a function of u and v (rate_of), so it is even in each angle:
 *          d clock/dsigma = sum_mn d_mn cos m theta_u cos n theta_v.
 *      Its coefficients d_mn come from samples on a grid of both angles (two cosine transforms). They fall like a
 *      geometric series, because the rate is a smooth periodic function.
 *  (3) cos m theta_u cos n theta_v = (cos(m theta_u + n theta_v) + cos(m theta_u - n theta_v))/2. Integrated in sigma
 *      each cosine becomes a sine, divided by m omega_u + n omega_v or m omega_u - n omega_v. Put back as products:
 *          clock = d_00 sigma + sum_mn [ (P + Q) sin m theta_u cos n theta_v + (P - Q) cos m theta_u sin n theta_v ],
 *          P = d_mn/(2 (m omega_u + n omega_v)),    Q = d_mn/(2 (m omega_u - n omega_v)),
 *      less the value of the sum at sigma = 0.
 *  (4) The place at which a clock shows a given time is found by Newton's method. Clocks only go forwards, so there
 *      is one such place, and it lies within (range of the sum)/d_00 of time/d_00.
 */
#include <math.h>
#include <stdlib.h>

#include "base/vec3_impl.h"
#include "exact/form_impl.h"
#include "exact/separation_impl.h"
#include "exact/series_impl.h"
#include "model/model_impl.h"

/* A clock (3): mean = d_00, at_sine[m][n] = P + Q, at_cosine[m][n] = P - Q. The tables have a row for each m. ABREAST
 * rows make a block; the rows of a block have the same length. */
typedef struct torus_clock {
    real mean;
    int blocks, columns, *length; /* length[block]; `columns` is the largest of them                */
    int few;                      /* terms with m, n < few give the clock to LITTLE of its range    */
    double *at_sine, *at_cosine;
    double zero;  /* the sum at sigma = 0, less what the clock shows there          */
    double range; /* the sum of the sizes of all terms                              */
} torus_clock;

typedef struct torus {
    separation s;
    int rows, columns; /* how many multiples of theta_u and of theta_v are needed at most */
    torus_clock clock[ISO_CLOCKS];
} torus;

/* d clock/dsigma, u and v counted from b2: ds = (v - u) dsigma. */
static real rate_of(const separation *s, iso_clock clock, real u, real v)
{
    const real *b = s->b, far = s->off[0] + s->off[2] - u - v;
    const real q = s->k == -1 ? b[1] + far : (b[1] + u) * (b[1] + v) / (b[0] * b[1] * b[2]);
    return (v - u) * iso_separation_clock_rate(s, clock, q);
}

/* --- set-up ----------------------------------------------------------------------------------------------------- */

/* Coefficients below LEAST d_00 are rounding errors of the transform. Differences |m omega_u - n omega_v| below
 * RESONANT times the sum of both are zero. The first terms, for a first guess, are good to LITTLE. */
static const double LEAST = 4e-17, RESONANT = 1e-15, LITTLE = 1e-6;

enum { MOST_TERMS = 1 << 23 };

/* (3): the term d_mn of the rate, into the two tables. Where m omega_u = n omega_v, the angle m theta_u - n theta_v
 * is a constant: its cosine belongs to the mean rate. */
static void integrate_term(const separation *s, torus_clock *c, int m, int n, double d, size_t to)
{
    const oscillation *u = &s->coordinate[0], *v = &s->coordinate[1];
    const double sum = (double)(m * u->omega + n * v->omega), gap = (double)(m * u->omega - n * v->omega);
    const bool apart = fabs(gap) > RESONANT * sum;
    const double of_sum = d / 2 / sum, of_gap = apart ? d / 2 / gap : 0;
    if (!apart) c->mean += d / 2 * cosl(m * u->start - n * v->start);
    c->at_sine[to] = of_sum + of_gap;
    c->at_cosine[to] = of_sum - of_gap;
    c->range += fabs(of_sum) + fabs(of_gap);
}

/* The least multiple of ABREAST beyond which all terms are small. */
static void find_few(torus_clock *c)
{
    size_t at = 0;
    c->few = ABREAST;
    for (int m = 0; m < c->blocks * ABREAST; m++)
        for (int n = 0; n < c->length[m / ABREAST]; n++, at++)
            while (fabs(c->at_sine[at]) + fabs(c->at_cosine[at]) > LITTLE * c->range && (m >= c->few || n >= c->few))
                c->few += ABREAST;
}

/* (3) for all d[m][n], m <= M, n <= N. False: no memory. */
static bool integrate(const separation *s, torus_clock *c, const double d[], int M, int N)
{
    const double least = LEAST * (double)c->mean;
    size_t terms = 0, to = 0;
    c->length = calloc((size_t)(unsigned)M / ABREAST + 1, sizeof *c->length);
    if (!c->length) return false;
    for (int m = 0; m <= M; m++) {
        int *const length = &c->length[m / ABREAST];
        for (int n = *length; n <= N; n++)
            if (m + n > 0 && fabs(d[(size_t)m * (size_t)(N + 1) + (size_t)n]) >= least) *length = n + 1;
        if (*length > 0) c->blocks = m / ABREAST + 1;
        if (*length > c->columns) c->columns = *length;
    }
    for (int i = 0; i < c->blocks; i++) terms += ABREAST * (size_t)c->length[i];
    c->at_sine = calloc(terms + 1, sizeof *c->at_sine);
    c->at_cosine = calloc(terms + 1, sizeof *c->at_cosine);
    if (!c->at_sine || !c->at_cosine) return false;
    for (int m = 0; m < c->blocks * ABREAST; m++)
        for (int n = 0; n < c->length[m / ABREAST]; n++, to++) {
            const double term = m + n > 0 && m <= M ? d[(size_t)m * (size_t)(N + 1) + (size_t)n] : 0;
            if (fabs(term) >= least) integrate_term(s, c, m, n, term, to);
        }
    find_few(c);
    return true;
}

/* enough[0]: whether the last eighth of the terms in m is as small as the rounding errors of a rate of size `most`;
 * enough[1]: the same in n. If not, the grid of (2) is too coarse. */
static void check_resolution(const double d[], int M, int N, double most, bool enough[2])
{
    enough[0] = enough[1] = true;
    for (int m = 0; m <= M; m++)
        for (int n = 0; n <= N; n++) {
            if (fabs(d[m * (N + 1) + n]) <= 1e-15 * most) continue;
            if (m > M - M / 8) enough[0] = false;
            if (n > N - N / 8) enough[1] = false;
        }
}

/* (2) and (3) from the samples that u and v have; enough: whether these are enough, of u and of v. */
static iso_status make_clock(const separation *s, iso_clock clock, torus_clock *c, bool enough[2])
{
    const oscillation *u = &s->coordinate[0], *v = &s->coordinate[1];
    const int M = u->samples, N = v->samples, columns = N + 1;
    const size_t size = (size_t)(M + 1) * (size_t)columns;
    if (size > MOST_TERMS) return ISO_NUMERICAL;
    double *d = malloc(size * sizeof *d), *work = malloc(2 * (size_t)(M > N ? M : N) * sizeof *work);
    bool room = d && work;
    real mean = 0, most = 0;
    for (int j = 0; room && j <= M; j++)
        for (int l = 0; l <= N; l++) {
            const real r = rate_of(s, clock, u->at[j], v->at[l]);
            mean += r * (j % M == 0 ? 0.5L : 1) * (l % N == 0 ? 0.5L : 1);
            most = fmaxl(most, r);
            d[j * columns + l] = (double)r;
        }
    c->mean = mean / M / N;
    for (int j = 0; room && j <= M; j++) cosine_series(d + j * columns, N, 1, work);
    for (int l = 0; room && l <= N; l++) cosine_series(d + l, M, columns, work);
    if (room) check_resolution(d, M, N, (double)most, enough);
    if (room && enough[0] && enough[1]) room = integrate(s, c, d, M, N);
    free(d);
    free(work);
    return room ? ISO_OK : ISO_NO_MEMORY;
}

static iso_status why_not(const separation *s)
{
    return s->coordinate[0].no_memory || s->coordinate[1].no_memory ? ISO_NO_MEMORY : ISO_NUMERICAL;
}

/* Makes a clock. The samples that resolve u and v may be too few for its rate: then they are doubled. */
static iso_status resolve_clock(separation *s, iso_clock clock, torus_clock *c)
{
    for (;;) {
        bool enough[2];
        const iso_status status = make_clock(s, clock, c, enough);
        if (status != ISO_OK || (enough[0] && enough[1])) return status;
        for (int i = 0; i < 2; i++)
            if (!enough[i] && !iso_oscillation_refine(&s->coordinate[i])) return why_not(s);
    }
}

/* --- angles and clocks at sigma --------------------------------------------------------------------------------- */

enum { SMALL = 2048 };

typedef struct angles {
    real sigma, theta[2];        /* theta_u, theta_v, in [-2 pi, 2 pi]      */
    double *sine[2], *cosine[2]; /* of m theta_u, of n theta_v              */
    double *of_sine, *of_cosine; /* for each n: the sums of (3) over m      */
    double *heap, small[SMALL];
} angles;

/* Room for all multiples and sums; seldom more than `small`, then from the heap. False: no memory. */
static bool open_angles(const torus *x, angles *a)
{
    const size_t rows = (size_t)x->rows + 2 * ABREAST, columns = (size_t)x->columns + 2 * ABREAST;
    const size_t size = 2 * rows + 4 * columns;
    a->heap = size > SMALL ? malloc(size * sizeof *a->heap) : NULL;
    double *const at = size > SMALL ? a->heap : a->small;
    if (!at) return false;
    a->sine[0] = at;
    a->cosine[0] = at + rows;
    a->sine[1] = at + 2 * rows;
    a->cosine[1] = a->sine[1] + columns;
    a->of_sine = a->cosine[1] + columns;
    a->of_cosine = a->of_sine + columns;
    return true;
}

/* The angles at sigma, (1), and the sines and cosines of their multiples below `most`. */
static void set_angles(const torus *x, real sigma, int most, angles *a)
{
    a->sigma = sigma;
    for (int i = 0; i < 2; i++) {
        const oscillation *o = &x->s.coordinate[i];
        const int last = i == 0 ? x->rows : x->columns;
        a->theta[i] = less_turns(o->start + o->omega * sigma, 4 * ISO_PI_LONG);
        set_multiples(0, (double)a->theta[i], last < most ? last : most, a->cosine[i], a->sine[i]);
    }
}

/* The clock by the first `blocks` blocks of rows and n < most. The sums over m come first: there the terms for
 * different n do not wait for each other. */
static real clock_at(const torus_clock *c, int blocks, int most, const angles *a)
{
    double *const of_sine = a->of_sine, *const of_cosine = a->of_cosine, sum = 0;
    const double *p = c->at_sine, *q = c->at_cosine;
    const int columns = c->columns < most ? c->columns : most;
    for (int n = 0; n < columns; n++) of_sine[n] = of_cosine[n] = 0;
    for (int block = 0; block < c->blocks && block < blocks; block++) {
        const double *const s = a->sine[0] + block * ABREAST, *const t = a->cosine[0] + block * ABREAST;
        const int row = c->length[block], length = row < most ? row : most;
        for (int n = 0; n < length; n++) {
            of_sine[n] += (p[n] * s[0] + p[n + row] * s[1]) + (p[n + 2 * row] * s[2] + p[n + 3 * row] * s[3]);
            of_cosine[n] += (q[n] * t[0] + q[n + row] * t[1]) + (q[n + 2 * row] * t[2] + q[n + 3 * row] * t[3]);
        }
        p += ABREAST * row, q += ABREAST * row;
    }
    for (int n = 0; n < columns; n++) sum += of_sine[n] * a->cosine[1][n] + of_cosine[n] * a->sine[1][n];
    return c->mean * a->sigma + (sum - c->zero);
}

enum { ALL = MOST_MODES + 1 };

/* u and v at a place, and their first and second derivative in sigma. */
typedef struct local {
    real z[2], rate[2], bend[2];
} local;

static void look_around(const torus *x, int most, const angles *a, local *l)
{
    for (int i = 0; i < 2; i++) {
        const oscillation *o = &x->s.coordinate[i];
        double z = o->z[0], rate = 0, bend = 0;
        for (int n = 1; n <= o->terms && n < most; n++) {
            const double term = o->z[n] * a->cosine[i][n];
            z += term;
            rate -= n * o->z[n] * a->sine[i][n];
            bend -= (double)n * n * term;
        }
        l->z[i] = z, l->rate[i] = rate * o->omega, l->bend[i] = bend * o->omega * o->omega;
    }
}

/* d clock/dsigma a short step further on, u and v by their Taylor polynomials */
static real rate_at(const torus *x, iso_clock clock, const local *l, real step)
{
    real z[2];
    for (int i = 0; i < 2; i++) z[i] = l->z[i] + step * (l->rate[i] + step / 2 * l->bend[i]);
    return rate_of(&x->s, clock, z[0], z[1]);
}

/* The mean rate of a clock over a short step, by Simpson's rule; *error: how wrong it may be, relatively. The rule is
 * exact for polynomials of degree 3, so for a smooth rate that changes by a part e its error is about e^4. */
static real simpson(const torus *x, iso_clock clock, const local *l, real step, real *error)
{
    const real first = rate_at(x, clock, l, 0), middle = rate_at(x, clock, l, step / 2),
               last = rate_at(x, clock, l, step);
    const real slope = (last - first) / middle, curve = (first - 2 * middle + last) / middle;
    *error = slope * slope * slope * slope + curve * curve;
    return (first + 4 * middle + last) / 6;
}

/* A first guess for (4): a few steps of Newton's method with the first terms only. */
static real near(const torus *x, iso_clock clock, real time, angles *a)
{
    const torus_clock *c = &x->clock[clock];
    const real about = (time + c->zero) / c->mean, around = c->range / c->mean;
    real sigma = about;
    local l;
    for (int i = 0; i < 8; i++) {
        set_angles(x, sigma, c->few, a);
        look_around(x, c->few, a, &l);
        const real step = (time - clock_at(c, c->few / ABREAST, c->few, a)) / rate_at(x, clock, &l, 0);
        if (!(fabsl(sigma + step - about) <= around)) break;
        sigma += step;
        if (fabsl(step) <= 1e-4L * around) break;
    }
    return sigma;
}

/* (4) from a->sigma on. The place sought lies between `low` and `high`, which come closer; a step that leaves them,
 * and each eighth step, is replaced by the middle. The last step is not taken, that is the sum (3) is not evaluated
 * again: it is (time missing)/(mean rate over the step), the mean rate by Simpson's rule. Returns that step. */
static real approach(const torus *x, iso_clock clock, real time, angles *a)
{
    const torus_clock *c = &x->clock[clock];
    const real about = (time + c->zero) / c->mean, around = c->range / c->mean;
    real low = about - around, high = about + around, error;
    local l;
    for (int i = 0;; i++) {
        set_angles(x, a->sigma, ALL, a);
        look_around(x, ALL, a, &l);
        const real miss = clock_at(c, ALL, ALL, a) - time;
        const real step = -miss / rate_at(x, clock, &l, 0);
        *(miss > 0 ? &high : &low) = a->sigma;
        const bool inside = a->sigma + step > low && a->sigma + step < high;
        if (i < 100 && (!inside || i % 8 == 7)) {
            a->sigma = (low + high) / 2;
            continue;
        }
        if (fabsl(step) <= 1e-5L * around || i == 100) {
            const real better = -miss / simpson(x, clock, &l, step, &error);
            const real best = -miss / simpson(x, clock, &l, better, &error);
            if (error * fabsl(best) <= 1e-17L * around) return best;
            if (i == 100) return step;
        }
        a->sigma += step;
    }
}

static void find(const void *data, iso_clock clock, real time, form_place *p)
{
    const torus *x = data;
    bool others = false;
    real theta[2];
    angles a;
    if (!open_angles(x, &a)) {
        p->point[0] = NAN;
        return;
    }
    a.sigma = isnan(p->along) ? near(x, clock, time, &a) : p->along;
    const real step = approach(x, clock, time, &a);
    for (int i = 0; i < 2; i++) theta[i] = less_turns(a.theta[i] + x->s.coordinate[i].omega * step, 4 * ISO_PI_LONG);
    p->along = a.sigma + step;
    for (int k = 0; k < ISO_CLOCKS; k++) others = others || (k != (int)clock && x->clock[k].mean > 0);
    if (others) set_angles(x, p->along, ALL, &a);
    for (int k = 0; k < ISO_CLOCKS; k++)
        p->clock[k] = k == (int)clock ? time : x->clock[k].mean > 0 ? clock_at(&x->clock[k], ALL, ALL, &a) : NAN;
    iso_separation_state(&x->s, theta, p->point);
    free(a.heap);
}

/* --- the form --------------------------------------------------------------------------------------------------- */

static bool serves(const iso_problem *f, const double point[ISO_STATE])
{
    (void)point;
    return norm(iso_effects_rotor(&f->effects)) == 0 && (f->p.k == -1 || (f->p.k == 1 && f->energy == 0));
}

static void release(void *data)
{
    torus *x = data;
    if (!x) return;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        free(x->clock[c].length);
        free(x->clock[c].at_sine);
        free(x->clock[c].at_cosine);
    }
    for (int i = 0; i < 2; i++) iso_oscillation_release(&x->s.coordinate[i]);
    free(x);
}

static iso_status make(const iso_problem *problem, const double point[ISO_STATE], const bool clocks[ISO_CLOCKS],
                       form_motion *m)
{
    torus *x = m->data = calloc(1, sizeof *x);
    iso_status status = ISO_OK;
    angles a;
    if (!x) return ISO_NO_MEMORY;
    if (!iso_separation_make(&x->s, problem, point)) return why_not(&x->s);
    for (iso_clock c = 0; c < ISO_CLOCKS && status == ISO_OK; c++) {
        torus_clock *const clock = &x->clock[c];
        if (!clocks[c]) continue;
        status = resolve_clock(&x->s, c, clock);
        if (clock->blocks * ABREAST > x->rows) x->rows = clock->blocks * ABREAST;
        if (clock->columns > x->columns) x->columns = clock->columns;
    }
    if (x->s.coordinate[0].terms >= x->rows) x->rows = x->s.coordinate[0].terms + 1;
    if (x->s.coordinate[1].terms >= x->columns) x->columns = x->s.coordinate[1].terms + 1;
    if (status != ISO_OK || !open_angles(x, &a)) return status != ISO_OK ? status : ISO_NO_MEMORY;
    set_angles(x, 0, ALL, &a);
    for (int c = 0; c < ISO_CLOCKS; c++) {
        if (clocks[c]) x->clock[c].zero = (double)(clock_at(&x->clock[c], ALL, ALL, &a) - x->s.before[c]);
        m->rate[c] = x->clock[c].mean;
    }
    m->unstable = x->s.unstable;
    free(a.heap);
    return status;
}

/* (1/2 pi) times the integral of |p_z dz| over one swing. p_z = (dz/dsigma)/(4 A), so
 * p_z dz = (dz/dsigma)^2/(4 A) dsigma = 2 (R + c) dsigma = 2 (R + c) dtheta/omega: the mean of 2 (R + c) over even
 * samples of theta, over omega. */
static real action(const separation *s, const oscillation *o)
{
    real mean = 0;
    for (int j = 0; j <= o->samples; j++) {
        const real z = o->at[j], from_al = z + s->to_al[1];
        const real excess = s->k == -1 ? s->eps * from_al * (s->to_be[1] - z) : s->c * from_al / (s->b[1] + z);
        mean += 2 * fabsl(excess) * (j % o->samples == 0 ? 0.5L : 1) / o->samples;
    }
    return mean / o->omega;
}

static void describe(const void *data, const bool clocks[ISO_CLOCKS], iso_exact_torus *to)
{
    const torus *x = data;
    const separation *s = &x->s;
    to->kind = ISO_EXACT_SEPARATED;
    to->angles = 2;
    to->c = (double)s->c;
    to->distance = (double)s->distance;
    for (int i = 0; i < 2; i++) {
        /* The state returns after two swings of a coordinate, because gamma goes like sn and cn, which change sign
         * after one. It returns after one of v where neither gamma3 (be < b3) nor gamma2 (v librates) goes like sn_v
         * or cn_v. */
        const int swings = i == 1 && s->below_b3 && !s->librates_low ? 1 : 2;
        to->action[i] = (double)(action(s, &s->coordinate[i]) * swings);
        for (int c = 0; c < ISO_CLOCKS; c++)
            to->frequency[c][i] = clocks[c] ? (double)(s->coordinate[i].omega / x->clock[c].mean / swings) : NAN;
    }
}

const iso_form iso_form_separated = {
    .serves = serves, .make = make, .free = release, .find = find, .describe = describe};

#include "exact/exact.h"

#include <float.h>
#include <gsl/gsl_fft_real.h>
#include <math.h>
#include <stdlib.h>

#include "exact/separation_impl.h"
#include "model/effect.h"

/* A clock on the torus: d clock/d sigma = mean + sum_mn d_mn cos m theta_u cos n theta_v, integrated term by term:
 *     clock = mean sigma + sum_mn [ at_sine[m][n] sin m theta_u cos n theta_v
 *                                   + at_cosine[m][n] cos m theta_u sin n theta_v ]
 * less its value at sigma = 0. */
typedef struct torus_clock {
    real mean;
    int rows, columns;          /* m < rows, n < columns ... */
    int length[MOST_MODES + 1]; /* ... and n < length[m]: beyond it there is nothing */
    double *at_sine, *at_cosine, zero, range;
} torus_clock;

struct iso_exact {
    separation s;
    bool has[ISO_CLOCKS];
    torus_clock clock[ISO_CLOCKS];
};

/* --- the clocks on the torus ------------------------------------------------------------------------------------ */

/* From f(pi j/N) to the a_n of f(x) = sum_n a_n cos n x, j, n = 0 ... N, for each of `lines` lines: halves of even
 * functions. */
static void transform_lines(double x[], int lines, int line, int N, int stride)
{
    double even[2 * MOST_MODES];
    for (int l = 0; l < lines; l++) {
        double *f = x + l * line;
        for (int j = 0; j <= N; j++) even[j] = even[(2 * N - j) % (2 * N)] = f[j * stride];
        gsl_fft_real_radix2_transform(even, 1, 2 * (size_t)N);
        for (int n = 0; n <= N; n++) f[n * stride] = even[n] / (n % N == 0 ? 2 * N : N);
    }
}

/* What of a coefficient is above the rounding of its transform, and a difference of frequencies above theirs. */
static const double LEAST = 4e-17, RESONANT = 1e-15;

/* d_mn into the two tables of the integral: sin(m theta_u +- n theta_v)/(m omega_u +- n omega_v), each with d_mn/2.
 * Where the frequencies are in the ratio n : m, m theta_u - n theta_v stays what it is. */
static void integrate(const separation *s, torus_clock *c, const double d[])
{
    const double least = LEAST * (double)c->mean;
    for (int m = 0; m < c->rows; m++)
        for (int n = 0; n < c->columns; n++) {
            const int i = m * c->columns + n;
            c->at_sine[i] = c->at_cosine[i] = 0;
            if (i == 0 || fabs(d[i]) < least) continue;
            const double sum = (double)(m * s->u.omega + n * s->v.omega);
            const double gap = (double)(m * s->u.omega - n * s->v.omega);
            const bool apart = fabs(gap) > RESONANT * sum;
            const double of_sum = d[i] / 2 / sum, of_gap = apart ? d[i] / 2 / gap : 0;
            if (!apart) c->mean += d[i] / 2 * cosl(m * s->u.start - n * s->v.start);
            c->at_sine[i] = of_sum + of_gap;
            c->at_cosine[i] = of_sum - of_gap;
            c->range += fabs(of_sum) + fabs(of_gap);
            c->length[m] = n + 1;
        }
}

static bool make_clock(const separation *s, iso_clock clock, torus_clock *c)
{
    const int M = s->u.samples, N = s->v.samples;
    real mean = 0;
    c->rows = M + 1;
    c->columns = N + 1;
    const size_t size = (size_t)c->rows * (size_t)c->columns;
    double *d = malloc(size * sizeof *d);
    c->at_sine = malloc(size * sizeof *c->at_sine);
    c->at_cosine = malloc(size * sizeof *c->at_cosine);
    if (!d || !c->at_sine || !c->at_cosine) return free(d), false;
    for (int j = 0; j <= M; j++)
        for (int l = 0; l <= N; l++) {
            const real r = iso_separation_rate(s, clock, s->u.at[j], s->v.at[l]);
            mean += r * (j % M == 0 ? 0.5L : 1) * (l % N == 0 ? 0.5L : 1);
            d[j * c->columns + l] = (double)r;
        }
    c->mean = mean / M / N;
    transform_lines(d, c->rows, c->columns, N, 1);
    transform_lines(d, c->columns, 1, M, c->columns);
    integrate(s, c, d);
    free(d);
    return true;
}

/* --- angles and clocks at sigma --------------------------------------------------------------------------------- */

typedef struct place {
    real sigma;
    double theta[2]; /* of u and v, within two turns */
    double sine[2][MOST_MODES + 1], cosine[2][MOST_MODES + 1];
} place;

static void set_place(const iso_exact *x, real sigma, place *p)
{
    const oscillation *const o[2] = {&x->s.u, &x->s.v};
    p->sigma = sigma;
    for (int i = 0; i < 2; i++) {
        p->theta[i] = (double)fmodl(o[i]->start + o[i]->omega * sigma, 4 * ISO_PI);
        const double s = sin(p->theta[i]), c = cos(p->theta[i]);
        double *sine = p->sine[i], *cosine = p->cosine[i];
        sine[0] = 0, cosine[0] = 1;
        for (int n = 1; n <= o[i]->samples; n++) {
            cosine[n] = cosine[n - 1] * c - sine[n - 1] * s;
            sine[n] = sine[n - 1] * c + cosine[n - 1] * s;
        }
    }
}

static real clock_at(const torus_clock *c, const place *p)
{
    double sum = 0;
    for (int m = 0; m < c->rows; m++) {
        const double *a = c->at_sine + m * c->columns, *b = c->at_cosine + m * c->columns;
        double sine = 0, cosine = 0;
        for (int n = 0; n < c->length[m]; n++) {
            sine += a[n] * p->cosine[1][n];
            cosine += b[n] * p->sine[1][n];
        }
        sum += p->sine[0][m] * sine + p->cosine[0][m] * cosine;
    }
    return c->mean * p->sigma + (sum - c->zero);
}

static double coordinate_at(const oscillation *o, const double cosine[])
{
    double sum = 0;
    for (int n = 0; n <= o->samples; n++) sum += o->z[n] * cosine[n];
    return sum;
}

/* Where a clock shows `time`: Newton's method between bounds, as clocks only go forwards. */
static void find_place(const iso_exact *x, iso_clock clock, real time, place *p)
{
    const torus_clock *c = &x->clock[clock];
    const real about = (time + c->zero) / c->mean, around = c->range / c->mean;
    real low = about - around, high = about + around;
    set_place(x, about, p);
    for (int i = 0; i < 100; i++) {
        const real miss = clock_at(c, p) - time;
        if (miss > 0)
            high = p->sigma;
        else
            low = p->sigma;
        const double u = coordinate_at(&x->s.u, p->cosine[0]), v = coordinate_at(&x->s.v, p->cosine[1]);
        real next = p->sigma - miss / iso_separation_rate(&x->s, clock, u, v);
        if (!(next >= low && next <= high)) next = (low + high) / 2;
        const real moved = fabsl(next - p->sigma);
        set_place(x, next, p);
        if (moved <= DBL_EPSILON * around + 4 * LDBL_EPSILON * fabsl(next)) break;
    }
}

/* --- the front -------------------------------------------------------------------------------------------------- */

static iso_status check(iso_context *ctx, const iso_field *f)
{
    if (f->p.k != 1 && f->p.k != -1)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "k",
                                "the closed solution is for k = 1 and k = -1, not for k = %.17g", f->p.k);
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (f->effects.on[e] && e != ISO_CLOCK)
            return iso_context_fail(ctx, ISO_BAD_ARGUMENT, iso_effect_list[e]->name,
                                    "the closed solution is for a free motion, not one with '%s'",
                                    iso_effect_list[e]->name);
    if (!(f->eps > 0 && isfinite(f->eps)))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "eps", "the closed solution needs eps > 0, not %g", f->eps);
    return ISO_OK;
}

iso_status iso_exact_create(iso_context *ctx, const iso_field *field, const double point[ISO_STATE],
                            const bool clocks[ISO_CLOCKS], iso_exact **exact)
{
    *exact = NULL;
    iso_status status = check(ctx, field);
    if (status != ISO_OK) return status;
    iso_exact *x = calloc(1, sizeof *x);
    if (!x) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a closed solution");
    if (!iso_separation_make(&x->s, field, point)) {
        iso_exact_free(x);
        return iso_context_fail(
            ctx, ISO_NUMERICAL, "",
            "the orbit lies on the separatrix, or so close to it that its angles are not resolved");
    }
    place p;
    set_place(x, 0, &p);
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) {
        x->has[c] = clocks[c];
        if (!clocks[c]) continue;
        if (!make_clock(&x->s, c, &x->clock[c])) {
            iso_exact_free(x);
            return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for a closed solution");
        }
        x->clock[c].zero = (double)clock_at(&x->clock[c], &p);
    }
    *exact = x;
    return ISO_OK;
}

void iso_exact_free(iso_exact *x)
{
    if (!x) return;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        free(x->clock[c].at_sine);
        free(x->clock[c].at_cosine);
    }
    free(x);
}

iso_status iso_exact_at(iso_context *ctx, const iso_exact *x, iso_clock clock, double time, double point[ISO_STATE],
                        double clocks[ISO_CLOCKS])
{
    if (!isfinite(time)) return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a time is not finite");
    if (!x->has[clock])
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "this closed solution was made without the clock %s",
                                iso_clock_name(clock));
    place p;
    find_place(x, clock, time, &p);
    for (int c = 0; c < ISO_CLOCKS; c++)
        clocks[c] = c == (int)clock ? time : x->has[c] ? (double)clock_at(&x->clock[c], &p) : NAN;
    iso_separation_state(&x->s, p.theta, point);
    return ISO_OK;
}

iso_status iso_exact_grid(iso_context *ctx, const iso_exact *x, iso_clock clock, double start, double step,
                          size_t count, double points[], double clocks[])
{
    double unused[ISO_CLOCKS];
    iso_status status = ISO_OK;
    for (size_t i = 0; status == ISO_OK && i < count; i++)
        status = iso_exact_at(ctx, x, clock, start + (double)i * step, points + ISO_STATE * i,
                              clocks ? clocks + ISO_CLOCKS * i : unused);
    return status;
}

iso_exact_torus iso_exact_describe(const iso_exact *x)
{
    iso_exact_torus torus = {.angles = 2, .c = (double)x->s.c, .distance = (double)x->s.distance};
    const oscillation *const o[2] = {&x->s.u, &x->s.v};
    for (int i = 0; i < 2; i++) {
        const bool once = i == 1 && x->s.below_b3; /* one swing of the coordinate is the loop, else two */
        torus.action[i] = (double)(iso_separation_action(&x->s, o[i]) * (once ? 1 : 2));
        for (int c = 0; c < ISO_CLOCKS; c++)
            torus.frequency[c][i] = x->has[c] ? (double)(o[i]->omega / x->clock[c].mean / (once ? 1 : 2)) : NAN;
    }
    return torus;
}

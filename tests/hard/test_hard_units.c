/* Units of mass, length and time from 1e-40 to 1e40: the same numbers, scaled; to the bit, as the units are powers
 * of two. */
#include "hard.h"
#include "numbers.h"

static iso_context *ctx;
enum { K = 5, SCALES = 6 };
static const double ks[K] = {1, -1, 0.5, 0.75, -0.4};

/* Powers of two of mass, length and 1/time: 2^132 = 5e39 */
static const int scales[SCALES][3] = {{132, 0, 0},  {-132, 0, 0}, {0, 132, 0},
                                      {0, -132, 0}, {0, 0, 132},  {0, 0, -132}};

typedef struct scene {
    iso_params p;
    iso_start start;
    iso_effects effects;
    double J, w; /* what J and rates are multiplied by */
} scene;

enum { FREE, FIELD, LEVEL, GRAVITY, TWIST, FORCES };

static scene make(double k, int force, const int scale[3])
{
    scene s = {.J = ldexp(1, scale[0] + 2 * scale[1]), .w = ldexp(1, scale[2])};
    const double J[3] = {1.4 * s.J, 2.1 * s.J, 3.0 * s.J}, omega[3] = {0.9 * s.w, -0.3 * s.w, -0.225 * s.w};
    const double energy = s.J * s.w * s.w, normal[3] = {0.36, 0.48, 0.8};
    iso_effects *e = &s.effects;
    gsl_test(iso_params_reduced(ctx, k, J, &s.p) || iso_params_set_D(ctx, 0.5 * s.J, &s.p) ||
                 iso_start_ball(ctx, omega, normal, ISO_SPIN_REMOVE, &s.start),
             "a ball: %s", iso_context_message(ctx));
    e->on[ISO_FIELD] = force == FIELD;
    e->on[ISO_LEVEL] = force == LEVEL;
    e->on[ISO_GRAVITY] = force == GRAVITY;
    e->on[ISO_TWIST] = force == TWIST;
    e->on[ISO_REACTIONS] = force >= GRAVITY;
    FIELD_QUADRATIC(e)[0] = 0.3 * energy, FIELD_LINEAR(e)[2] = 0.1 * energy;
    LEVEL_C(e) = 0.3 * energy * exp2(-log2(s.J) / k); /* c of U = -c (n,J^-1 n)^(-1/k) */
    GRAVITY_MGB(e) = (k > 1 || k < 0 ? -0.7 : 0.7) * energy;
    GRAVITY_UP(e)[1] = 0.6, GRAVITY_UP(e)[2] = 0.8;
    TWIST_RESISTANCE(e) = s.J * s.w;
    return s;
}

/* omega, n and lambda after 3 turns in t; with the point's, M, gamma and the clock s too. */
typedef struct answer {
    iso_status status;
    iso_sample at;
} answer;

static answer solve(const hard_road *way, const scene *s, bool both)
{
    answer a = {0};
    a.status = hard_solve(ctx, way, &s->p, &s->start, &s->effects, both, ISO_CLOCK_T, 20 / s->w, &a.at);
    return a;
}

/* What M, and s, are multiplied by: J^(J + J_2k/(2k)) w^w */
static double factor(const scene *s, iso_dimension d)
{
    return exp2(log2(s->J) * (d.J + d.J_2k / (2 * s->p.k)) + log2(s->w) * d.w);
}

/* 0: the same bits. M and s have a unit that is no power of two where 1/k is no whole number: 1e-13, for exponents of
 * up to 1000. */
static double difference(const answer *a, const answer *b, const scene *s, bool both)
{
    double worst = 0;
    for (int i = 0; i < 6; i++) worst = fmax(worst, fabs(a->at.ball[i] * (i < 3 ? s->w : 1) - b->at.ball[i]));
    if (!isnan(iso_sample_get(&a->at, "lambda")))
        worst = fmax(worst,
                     fabs(iso_sample_get(&a->at, "lambda") * s->J * s->w * s->w - iso_sample_get(&b->at, "lambda")));
    if (!both) return worst;
    const double M = factor(s, iso_system_point.fast_dimension), clock = factor(s, iso_clock_dimension(ISO_CLOCK_S));
    for (int i = 0; i < 3; i++) {
        const double off = fabs(b->at.point[i] / (a->at.point[i] * M) - 1);
        worst = fmax(worst, fmax(off > 1e-12 ? off : 0, fabs(a->at.point[3 + i] - b->at.point[3 + i])));
    }
    const double off = fabs(b->at.clock[ISO_CLOCK_S] / (a->at.clock[ISO_CLOCK_S] * clock) - 1);
    return fmax(worst, off > 1e-12 ? off : 0);
}

/* Refused in one of the units only is a failure. */
static void hold_scaled(int force, bool both)
{
    static const int plain[3] = {0, 0, 0};
    for (int i = 0; i < hard_ways; i++) {
        double worst = 0;
        int answered = 0;
        const int most = force == LEVEL ? 3 : K; /* where 1/k is whole, the unit of c is a power of two */
        for (int k = 0; k < most; k++) {
            const scene one = make(ks[k], force, plain);
            const answer expected = solve(&hard_way[i], &one, both);
            const int c = force == FREE ? SCALES : 2;
            for (int j = 0; j < c; j++) {
                const scene s = make(ks[k], force, scales[(j * 3 + k) % SCALES]);
                const answer a = solve(&hard_way[i], &s, both);
                if (a.status != expected.status) worst = INFINITY;
                if (a.status != ISO_OK || expected.status != ISO_OK) continue;
                worst = fmax(worst, difference(&expected, &a, &s, both));
                answered++;
            }
        }
        if (answered > 0 || worst > 0)
            hard_hold(&hard_way[i], worst, 0);
        else
            hard_refused(&hard_way[i], true, iso_context_message(ctx));
    }
}

/* eps = h det J/k^2 in the caller's units */
static void check_naive(void)
{
    const scene s = make(-1, FREE, scales[2]);
    hard_naive("h det J/k^2 in these units", isfinite(dot_diag(s.start.y, s.p.J, s.start.y) * s.p.det_J) ? 0 : NAN,
               0);
}

int main(void)
{
    static const char why[] = "det J, eps = h det J/k^2 and q^(1/k) leave the range of doubles";
    ctx = iso_context_create();
    hard_topic("2. Units");
    hard_case("free, units 1e-40 to 1e40", "omega, n, M, gamma, s at t = 20: to the bit the same numbers scaled",
              why);
    hold_scaled(FREE, true);
    check_naive();
    hard_case("field", "the same", why);
    hold_scaled(FIELD, true);
    hard_case("level", "omega, n: the same", why);
    hold_scaled(LEVEL, false);
    hard_case("gravity, reactions", "omega, n, lambda: the same", why);
    hold_scaled(GRAVITY, false);
    hard_case("twist, reactions", "omega, n, lambda: the same", why);
    hold_scaled(TWIST, false);
    iso_context_free(ctx);
    return hard_summary();
}

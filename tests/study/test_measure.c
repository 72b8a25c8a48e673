/* The invariant measure (10): a cloud of states keeps it under the flow in t and in s. Another exponent is not kept,
 * and a ball that loses energy does not keep it.
 *
 * States on one level of the energy are drawn evenly in n and in the direction theta of v = J^(1/2) omega across
 * J^(-1/2) n. There the measure is g^(a/(2k) - 1/2) dn dtheta in t and g^(-3/2) in s, with a = 1. So each state has
 * this weight, and the mean of weight (f(later) - f(start)) is 0 for every function f of the state. It is compared
 * with its standard error. */
#include "laws.h"
#include "orbit/batch.h"

enum { FUNCTIONS = 4, MOST = 40000 };

static iso_context *ctx;
static iso_start start[MOST];
static iso_batch_orbit orbit[MOST];
static iso_sample later[MOST];

static double g_of(const iso_params *p, const double n[3])
{
    return dot_diag(n, p->inv_J, n);
}

static void functions(const iso_params *p, const double ball[ISO_STATE], double f[FUNCTIONS])
{
    const double *w = ball, *n = ball + 3;
    f[0] = log(g_of(p, n));
    f[1] = n[0] * n[0];
    f[2] = n[1] * n[1];
    f[3] = w[0] * w[1] / dot(w, w);
}

static void draw(const iso_params *p, const iso_effects *effects, int count)
{
    iso_random *r = iso_random_create(7);
    for (int i = 0; i < count; i++) {
        double n[3], gamma[3], v[3], w[3];
        iso_random_direction(r, n);
        for (int j = 0; j < 3; j++) gamma[j] = n[j] / p->root_J[j];
        make_unit(gamma);
        iso_random_direction(r, v);
        remove_along(v, gamma);
        make_unit(v);
        for (int j = 0; j < 3; j++) w[j] = v[j] / p->root_J[j];
        if (iso_start_ball(ctx, w, n, ISO_SPIN_REMOVE, &start[i]) != ISO_OK) exit(1);
        orbit[i] = (iso_batch_orbit){p, &start[i], effects};
    }
    iso_random_free(r);
}

/* The largest deviation of a mean, in standard errors, with this exponent of g. */
static double deviation(const iso_params *p, double exponent, int count)
{
    double largest_one = 0;
    for (int f = 0; f < FUNCTIONS; f++) {
        double sum = 0, square = 0;
        for (int i = 0; i < count; i++) {
            double before[FUNCTIONS], after[FUNCTIONS];
            functions(p, start[i].y, before);
            functions(p, later[i].ball, after);
            const double x = pow(g_of(p, start[i].y + 3), exponent) * (after[f] - before[f]);
            sum += x;
            square += x * x;
        }
        largest_one = fmax(largest_one, fabs(sum) / sqrt(square - sum * sum / count));
    }
    return largest_one;
}

static void carry(iso_clock clock, double end, int count)
{
    iso_batch_options o = iso_batch_defaults();
    o.clock = clock;
    o.backend = ISO_BACKEND_BALL;
    if (iso_batch_run(ctx, orbit, (size_t)count, &o, &end, 1, later, NULL) != ISO_OK) {
        gsl_test(1, "a cloud: %s", iso_context_message(ctx));
        exit(1);
    }
}

/* A deviation of 4.5 comes by chance once in 10^5. */
static void check(double k)
{
    const int count = tests_length(8000, MOST / 2);
    const iso_params p = laws_params(k, (const double[]){1, 2, 5});
    draw(&p, NULL, count);
    for (iso_clock clock = ISO_CLOCK_T; clock <= ISO_CLOCK_S; clock += ISO_CLOCK_S - ISO_CLOCK_T) {
        const double mean_rate = iso_clock_rate(&p, clock, 2, NULL);
        carry(clock, 3 * mean_rate / fabs(k), count);
        const double right = clock == ISO_CLOCK_T ? 1 / (2 * k) - 0.5 : -1.5;
        const double kept = deviation(&p, right, count), other = deviation(&p, right + 0.5, count);
        gsl_test(!(kept < 4.5), "k = %g, in %s: the measure is kept, to %.2g standard errors", k,
                 iso_clock_name(clock), kept);
        gsl_test(!(other > 6), "k = %g, in %s: another exponent is not, by %.2g", k, iso_clock_name(clock), other);
    }
}

/* Resistance makes the ball turn less. Its energy tells at once; here its directions do. */
static void losses(void)
{
    const int count = tests_length(8000, MOST / 2);
    const iso_params p = laws_params(0.5, (const double[]){1, 2, 5});
    iso_effects effects = iso_effects_default();
    if (iso_effects_set(ctx, &effects, "torque", NULL, 0, NULL) != ISO_OK ||
        iso_effects_write(ctx, &effects, "torque", "M1", "-0.2*omega1") != ISO_OK ||
        iso_effects_write(ctx, &effects, "torque", "M2", "0") != ISO_OK ||
        iso_effects_write(ctx, &effects, "torque", "M3", "0") != ISO_OK)
        exit(1);
    draw(&p, &effects, count);
    carry(ISO_CLOCK_T, 20, count);
    const double found = deviation(&p, 0.5, count);
    gsl_test(!(found > 6), "a torque that takes energy about axis 1: off by %.2g standard errors", found);
}

int main(void)
{
    ctx = iso_context_create();
    const double k[] = {0.5, -0.4, 4};
    for (size_t i = 0; i < sizeof k / sizeof *k; i++) check(k[i]);
    losses();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

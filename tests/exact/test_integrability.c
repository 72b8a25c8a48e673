/* Which case a problem is (exact/integrability_impl.h): what is known, what the theorem says, what it does not say. */
#include "exact/integrability_impl.h"
#include "laws.h"
#include "model/effects/effect.h"

static iso_context *ctx;
static const double ours[3] = {1.4, 2.1, 3}, pair[3] = {2, 2, 3}, all[3] = {2, 2, 2};

static iso_integrability_kind with(double k, const double J[3], const char *effect, const char *number, int count,
                                   const double value[])
{
    const iso_params p = laws_params(k, J);
    iso_effects effects = iso_effects_default();
    if (effect && iso_effects_set(ctx, &effects, effect, number, count, value) != ISO_OK)
        gsl_test(1, "%s", iso_context_message(ctx));
    return iso_integrability_of(&p, &effects, false).kind;
}

static iso_integrability_kind of(double k, const double J[3])
{
    return with(k, J, NULL, NULL, 0, NULL);
}

static void expect(iso_integrability_kind got, iso_integrability_kind wanted, const char *what)
{
    gsl_test(got != wanted, "%s: %s", what, iso_integrability_name(got));
}

/* 1/k an odd integer, as near as doubles come to it, in both ways in which k is found. */
static void check_odd(void)
{
    for (int n = 1; n <= 41; n += 2)
        for (int sign = -1; sign <= 1; sign += 2) {
            const iso_integrability_kind wanted = n == 1    ? ISO_SECOND_INTEGRAL
                                                  : n <= 21 ? ISO_NO_INTEGRAL
                                                            : ISO_INTEGRABILITY_OPEN;
            const double k = sign / (double)n;
            gsl_test(of(k, ours) != wanted, "1/k = %d", sign * n);
            if (n == 1) continue;
            gsl_test(of(nextafter(k, 0), ours) != wanted, "1/k = %d, the double before", sign * n);
            gsl_test(of(1 / (1 + (sign * n - 1.)), ours) != wanted, "1/k = 1 + b/a = %d", sign * n);
            gsl_test(of(k * (1 + 1e-14), ours) != ISO_NO_INTEGRAL, "1/k next to %d, but not it", sign * n);
        }
    expect(of(1 + DBL_EPSILON, ours), ISO_INTEGRABILITY_OPEN, "k = 1 up to rounding");
    expect(of(-1 - DBL_EPSILON, ours), ISO_INTEGRABILITY_OPEN, "k = -1 up to rounding");
    expect(of(1 + 1e-14, ours), ISO_NO_INTEGRAL, "k = 1 + 1e-14");
}

/* Any other k, and even 1/k. */
static void check_others(void)
{
    iso_random *random = iso_random_create(5);
    int wrong = 0;
    for (int i = 0; i < tests_length(1000, 10000); i++) {
        const double k = iso_random_uniform(random, -6, 6);
        wrong += of(k, ours) != ISO_NO_INTEGRAL;
        wrong += of(k, pair) != ISO_SECOND_INTEGRAL || of(k, all) != ISO_SECOND_INTEGRAL;
    }
    gsl_test(wrong, "random k: not so for %d", wrong);
    for (int n = 2; n < 60; n += 2)
        wrong += of(1. / n, ours) != ISO_NO_INTEGRAL || of(-1. / n, ours) != ISO_NO_INTEGRAL;
    gsl_test(wrong, "1/k even: not so for %d", wrong);
    expect(of(1000, ours), ISO_NO_INTEGRAL, "k = 1000");
    expect(of(1e-3, ours), ISO_NO_INTEGRAL, "1/k = 1000");
    expect(of(0.5, (const double[3]){2, 2 * (1 + DBL_EPSILON), 3}), ISO_SECOND_INTEGRAL, "moments equal to rounding");
    expect(of(0.5, (const double[3]){2, 2 * (1 + 1e-14), 3}), ISO_NO_INTEGRAL, "moments 1e-14 apart");
    iso_random_free(random);
}

static void check_effects(void)
{
    static const double K[3] = {0.3, 0.4, 0.5}, axis[3] = {0, 0, 1}, c = 0.1, up[3] = {0, 0.6, 0.8};
    expect(with(0.5, ours, "level", "c", 1, &c), ISO_INTEGRABILITY_OPEN, "a level");
    expect(with(1, ours, "level", "c", 1, &c), ISO_SECOND_INTEGRAL, "k = 1 on a level");
    expect(with(0.5, pair, "level", "c", 1, &c), ISO_SECOND_INTEGRAL, "two equal moments on a level");
    expect(with(0.5, ours, "rotor", "momentum", 3, K), ISO_INTEGRABILITY_OPEN, "a rotor");
    expect(with(-1, ours, "rotor", "momentum", 3, K), ISO_INTEGRABILITY_OPEN, "a rotor at k = -1");
    expect(with(1, ours, "rotor", "momentum", 3, K), ISO_SECOND_INTEGRAL, "a rotor at k = 1");
    expect(with(0.5, pair, "rotor", "momentum", 3, axis), ISO_SECOND_INTEGRAL, "a rotor along the body's axis");
    expect(with(0.5, pair, "rotor", "momentum", 3, K), ISO_INTEGRABILITY_OPEN,
           "a rotor askew in a body with an axis");
    expect(with(0.5, ours, "attitude", NULL, 0, NULL), ISO_NO_INTEGRAL, "an effect that only observes");
    expect(with(-1, ours, "gravity", "up", 3, up), ISO_INTEGRABILITY_OPEN, "gravity");
    const iso_params p = laws_params(0.5, ours), shell = laws_params(-1, ours);
    const iso_effects none = iso_effects_default();
    expect(iso_integrability_of(&p, &none, true).kind, ISO_INTEGRABILITY_OPEN, "a point off H = 0");
    expect(iso_integrability_of(&shell, &none, true).kind, ISO_SECOND_INTEGRAL, "Neumann's problem off H = 0");
}

int main(void)
{
    ctx = iso_context_create();
    check_odd();
    check_others();
    check_effects();
    iso_context_free(ctx);
    return gsl_test_summary();
}

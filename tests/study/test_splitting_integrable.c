/* The splitting (lib/instrument/separatrix/separatrix.h) where the problem is integrable, k = 1 and k = -1: m is 0 there for all J
 * and on all levels, so it is below its error, with 64 bits and with 128. */
#include "instrument/separatrix/separatrix.h"
#include "studies.h"

enum { MOST = 20 };

typedef struct worst {
    double of_error, size; /* |m| by its error; the error */
} worst;

/* part: of the way from level 0 down to that on which the rotation ends; above 0 the level itself. */
static void look(double k, const double J[3], double part, iso_separatrix_digits digits, worst *w)
{
    iso_separatrix_splitting s;
    const double least = fmin(J[0], fmin(J[1], J[2])), most = fmax(J[0], fmax(J[1], J[2])),
                 middle = J[0] + J[1] + J[2] - least - most;
    const double level = part > 0 ? part : part * pow(middle / (k > 0 ? most : least), 1 / k);
    if (iso_separatrix_at(ctx, k, J, level, digits, &s) != ISO_OK)
        gsl_test(1, "k = %g, J = %.15g %.15g %.15g, level %.15g: %s", k, J[0], J[1], J[2], level,
                 iso_context_message(ctx));
    w->of_error = fmax(w->of_error, isnan(s.error) ? INFINITY : fabs(s.m) / s.error);
    w->size = fmax(w->size, s.error);
}

/* The first `count` of these J; both signs of k, or the sign that its place in the row gives. */
static void check(iso_separatrix_digits digits, int count, bool both, double bound, const char *name)
{
    iso_random *random = iso_random_create(17);
    worst w = {0, 0};
    for (int i = 0; i < count; i++) {
        double J[3];
        draw_moments(random, 1.2, 0.05, J);
        const bool off = i % 2 == (digits == ISO_SEPARATRIX_QUAD ? 0 : 1); /* every other one on another level */
        const double part = off ? iso_random_uniform(random, -0.9, 1) : 0;
        for (int k = -1; k <= 1; k += 2)
            if (both || k == (i % 2 ? 1 : -1)) look(k, J, part, digits, &w);
    }
    gsl_test(!(w.of_error < 1), "%s, %d J: |m| is at most %.2g of its error", name, count, w.of_error);
    gsl_test(!(w.size < bound), "%s, %d J: the largest error is %.1e", name, count, w.size);
    iso_random_free(random);
}

int main(void)
{
    const bool full = tests_length(0, 1);
    iso_separatrix_splitting s;
    ctx = iso_context_create();
    check(ISO_SEPARATRIX_DOUBLE, tests_length(10, MOST), full, 1e-14, "64 bits");
    if (iso_separatrix_at(ctx, NAN, (double[3]){1, 2, 3}, 0, ISO_SEPARATRIX_QUAD, &s) != ISO_BAD_ARGUMENT)
        check(ISO_SEPARATRIX_QUAD, tests_length(1, MOST / 4), false, 1e-26, "128 bits");
    iso_context_free(ctx);
    return gsl_test_summary();
}

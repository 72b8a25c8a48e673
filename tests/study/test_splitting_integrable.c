/* The splitting (lib/instrument/separatrix/separatrix.h) where the problem is integrable, k = 1 and k = -1: m is 0
 * there for all J and on all levels, so it is below its error, with 64 bits and with 128. */
#include "instrument/separatrix/separatrix.h"
#include "studies.h"

enum { MOST = 20 };

/* The first `count` of these J; both signs of k, or the sign that its place in the row gives. */
static void check(iso_separatrix_digits digits, int count, bool both, double bound, const char *name)
{
    iso_random *random = iso_random_create(17);
    double of_error = 0, size = 0; /* |m| by its error; the error */
    for (int i = 0; i < count; i++) {
        double J[3];
        draw_moments(random, 1.2, 0.05, J);
        const bool off = i % 2 == (digits == ISO_SEPARATRIX_QUAD ? 0 : 1); /* every other one on another level */
        /* of the way from level 0 down to that on which the rotation ends; above 0 the level itself */
        const double part = off ? iso_random_uniform(random, -0.9, 1) : 0;
        for (int k = -1; k <= 1; k += 2) {
            if (!both && k != (i % 2 ? 1 : -1)) continue;
            iso_separatrix_splitting s;
            const double least = min3(J), most = max3(J), middle = J[0] + J[1] + J[2] - least - most;
            const double level = part > 0 ? part : part * pow(middle / (k > 0 ? most : least), 1. / k);
            if (iso_separatrix_at(ctx, k, J, level, digits, &s) != ISO_OK)
                gsl_test(1, "k = %d, J = %.15g %.15g %.15g, level %.15g: %s", k, J[0], J[1], J[2], level,
                         iso_context_message(ctx));
            of_error = fmax(of_error, isnan(s.error) ? INFINITY : fabs(s.m) / s.error);
            size = fmax(size, s.error);
        }
    }
    gsl_test(!(of_error < 1), "%s, %d J: |m| is at most %.2g of its error", name, count, of_error);
    gsl_test(!(size < bound), "%s, %d J: the largest error is %.1e", name, count, size);
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

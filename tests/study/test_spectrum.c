/* Lines of made signals, lib/instrument/frequencies/spectrum.c. */
#include "instrument/frequencies/frequencies_impl.h"
#include "studies.h"

/* It asks before each line that it looks for, and before each that it refines, and once it is told no asks no more.
 */
static void check_stop(const double x[], size_t count, double step)
{
    iso_spectral_line found[ISO_MAX_LINES];
    int lines, asked = 1000;
    iso_context_set_monitor(ctx, some_times, &asked);
    must(iso_spectrum_find(ctx, x, count, step, ISO_MAX_LINES, found, &lines), "a spectrum that may be stopped");
    asked = 1000 - asked;
    gsl_test(asked < 2 * lines, "asked %d times whether to go on, for %d lines", asked, lines);
    for (int calls = 0; calls < asked; calls++) {
        int left = calls;
        iso_context_set_monitor(ctx, some_times, &left);
        const iso_status status = iso_spectrum_find(ctx, x, count, step, ISO_MAX_LINES, found, &lines);
        gsl_test(status != ISO_STOPPED || lines != 0 || left != -1, "stopped when asked %d times", calls + 1);
    }
    iso_context_set_monitor(ctx, NULL, NULL);
}

/* Six lines of amplitudes 1 to 1e-5, two of them five resolutions apart, at frequencies that are no bins. */
static void check_lines(void)
{
    enum { COUNT = 4096, MADE = 6 };
    static const iso_spectral_line made[MADE] = {{1.0123, 1, 0.3},    {-1.0123, 0.5, 1}, {1.0923, 0.1, -2},
                                                 {-2.2345, 1e-2, -1}, {0, 1e-3, 0.2},    {3.0456, 1e-5, 2}};
    static double x[2 * COUNT];
    const double step = 0.5;
    iso_spectral_line found[ISO_MAX_LINES];
    double worst = 0, worst_part = 0;
    int count;
    for (int j = 0; j < COUNT; j++)
        for (int l = 0; l < MADE; l++) {
            x[2 * j] += made[l].amplitude * cos(made[l].frequency * step * j + made[l].phase);
            x[2 * j + 1] += made[l].amplitude * sin(made[l].frequency * step * j + made[l].phase);
        }
    must(iso_spectrum_find(ctx, x, COUNT, step, ISO_MAX_LINES, found, &count), "a spectrum");
    gsl_test_int(count, MADE, "lines of a made signal");
    for (int l = 0; l < MADE && l < count; l++) {
        const double phase = remainder(found[l].phase - made[l].phase, 2 * M_PI);
        worst = fmax(worst, fabs(found[l].frequency - made[l].frequency) * made[l].amplitude);
        worst_part =
            fmax(worst_part, fmax(fabs(found[l].amplitude / made[l].amplitude - 1), fabs(phase)) * made[l].amplitude);
    }
    gsl_test(!(worst < 1e-15), "frequencies, times amplitude: %.1e", worst);
    gsl_test(!(worst_part < 1e-12), "amplitudes and phases: %.1e", worst_part);
    gsl_test(iso_spectrum_find(ctx, x, 1000, step, 5, found, &count) != ISO_BAD_ARGUMENT, "1000 samples: %s",
             iso_context_message(ctx));
    check_stop(x, COUNT, step);
    x[17] = NAN;
    gsl_test(iso_spectrum_find(ctx, x, COUNT, step, 5, found, &count) != ISO_NUMERICAL || count != 0, "NaN: %s",
             iso_context_message(ctx));
}

int main(void)
{
    ctx = iso_context_create();
    check_lines();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

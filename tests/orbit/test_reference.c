/* Every row of reference/free_ball.csv, quadruple-precision states of the free ball, by both backends.
 *
 * rk8pd at 1e-13 must reach what the project promises: (w, n) to 1e-10 by the ball and 1e-9 by the point for
 * t <= 100, to 1e-8 at t = 1000; s, promised to 1e-9 of itself, comes out much better. The other methods are asked
 * for about ten times the error that was measured.
 */
#include "reference.h"

static iso_context *ctx;

typedef struct trial {
    const char *method;
    double tolerance;
    double bound[2];  /* of (w, n) by the backends ball and point, t <= 100          */
    double bound_s;   /* of s, relative                                              */
    double long_time; /* bound of (w, n) for t > 100; 0: such rows are not run       */
} trial;

static void note_row(const trial *run, const reference *r, iso_backend backend, laws_worst *state, laws_worst *clock)
{
    iso_orbit_options o = iso_orbit_defaults(&r->start);
    iso_orbit *orbit = NULL;
    iso_sample s;
    char where[48];
    o.backend = backend;
    o.method = iso_method_find(run->method);
    o.tolerance = run->tolerance;
    o.with_clock[ISO_CLOCK_S] = true;
    snprintf(where, sizeof where, "%s t=%g", iso_backend_name((int)backend), r->t);
    if (iso_orbit_create(ctx, &r->p, &r->start, &o, &orbit) != ISO_OK || iso_orbit_at(orbit, r->t, &s) != ISO_OK) {
        gsl_test(1, "%s, backend %s: %s", run->method, where, iso_context_message(ctx));
    } else {
        const double bound = r->t > 100 ? run->long_time : run->bound[backend];
        double error[ISO_STATE];
        for (int i = 0; i < ISO_STATE; i++) error[i] = s.ball[i] - r->ball[i];
        laws_note(state, laws_max(ISO_STATE, error), bound, &r->p, where);
        laws_note(clock, fabs(s.clock[ISO_CLOCK_S] / r->s - 1), run->bound_s, &r->p, where);
    }
    iso_orbit_free(orbit);
}

static void check(const trial *run, const reference rows[], int count)
{
    for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
        laws_worst state = {0}, clock = {0};
        char title[96];
        for (int i = 0; i < count; i++)
            if (rows[i].t <= 100 || run->long_time > 0) note_row(run, &rows[i], backend, &state, &clock);
        snprintf(title, sizeof title, "%s at %g, backend %s: (w, n)", run->method, run->tolerance,
                 iso_backend_name((int)backend));
        laws_report(&state, title);
        snprintf(title, sizeof title, "%s at %g, backend %s: s", run->method, run->tolerance,
                 iso_backend_name((int)backend));
        laws_report(&clock, title);
    }
}

int main(void)
{
    static const trial runs[] = {
        {"rk8pd", 1e-13, {1e-10, 1e-9}, 1e-12, 1e-8},
        {"fehlberg_13_7_8", 1e-13, {3e-10, 3e-10}, 1e-12, 1e-8},
        {"adams", 1e-11, {3e-7, 2e-5}, 1e-7, 0},
        {"bdf", 1e-8, {5e-3, 2e-3}, 2e-5, 0},
        {"rkf45", 1e-11, {3e-7, 3e-8}, 3e-9, 0},
        {"msadams", 1e-11, {2e-6, 1e-4}, 2e-6, 0},
        {"bsimp", 1e-11, {3e-7, 1e-7}, 1e-9, 0},
        {"dormand_prince_7_4_5", 1e-13, {1e-9, 1e-9}, 1e-9, 0},
        {"verner_8_5_6", 1e-13, {1e-9, 1e-9}, 1e-9, 0},
        /* at their finest; auto takes Taylor series */
        {"auto", 1e-15, {1e-12, 1e-12}, 1e-12, 1e-8},
        {"taylor", 1e-15, {1e-12, 1e-12}, 1e-12, 2e-12},
        {"taylor_extended", 1e-15, {2e-13, 2e-13}, 1e-12, 1e-8},
    };
    reference rows[REFERENCE_ROWS];
    ctx = iso_context_create();
    const int count = reference_read(ctx, rows);
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) check(&runs[i], rows, count);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

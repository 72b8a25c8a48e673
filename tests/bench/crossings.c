/* bench_crossings - how many crossings of the section a second can be computed, alone and with deviations.
 *
 *     bench_crossings [K]            speed, J = (1, 2, 5)
 *     bench_crossings count N        N million crossings of random and of nearly flat orbits: none may be missed
 *
 * The orbits start evenly spread over the section. All runs have tolerance 1e-12 and one thread; seconds are
 * processor time. `ratio` is to the first line of its block.
 *
 * - crossings: a loop over iso_orbit_event with the method rk8pd, then iso_crossings with each kind of vectors.
 * - with two deviations, as for the verdict of `isoroll chaos`: GSL's rk8pd on (9) and its variational equations,
 *   written by hand, 18 numbers, 100 turns; then iso_crossings with deviations.
 * - count: the library checks each return against Sturm's bounds. Here the times s of both models are compared as
 *   well: for k = 1 and -1 those of all crossings, for other k those of the first 6, before chaotic orbits part. If
 *   one model misses a crossing, their times differ by a turn.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "bench.h"
#include "map/section_impl.h"
#include "map/state.h"
#include "orbit/crossings.h"

enum { ORBITS = 256, TURNS = 200, SLOW_ORBITS = 8 };

static iso_context *ctx;
static iso_params params;
static iso_start starts[ORBITS];
static iso_batch_orbit orbits[ORBITS];

static void stop(void)
{
    fprintf(stderr, "bench_crossings: %s\n", iso_context_message(ctx));
    exit(1);
}

/* With `flat`, every other start is next to the boundary: 1 - |x| = 1e-12 ... 1e-3. */
static void make_starts(double k, bool flat)
{
    static const double J[3] = {1, 2, 5};
    if (iso_params_reduced(ctx, k, J, &params) != ISO_OK) stop();
    const int axis = iso_section_axis(iso_free_point(&params, 1));
    iso_section_spread spread;
    iso_section_spread_prepare(&spread, iso_free_point(&params, 1), axis, 1);
    for (uint64_t i = 0; i < ORBITS; i++) {
        double l, x, point[ISO_STATE];
        iso_section_spread_point(&spread, i, &l, &x);
        if (flat && i % 2 == 0) x = copysign(1 - pow(10, -3 - (double)(i % 10)), x);
        iso_section_point(iso_free_point(&params, 1), axis, l, x, point);
        starts[i] = (iso_start){.model = ISO_POINT, .eps = 1};
        memcpy(starts[i].y, point, sizeof point);
        orbits[i] = (iso_batch_orbit){&params, &starts[i], NULL};
    }
}

static double print(const char *name, double count, double milliseconds, double first)
{
    const double rate = 1e3 * count / milliseconds;
    printf("  %-28s %12.0f  %8.1f\n", name, rate, first > 0 ? rate / first : 1);
    return rate;
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

static double height(const iso_sample *sample, const void *axis)
{
    return sample->ball[3 + *(const int *)axis];
}

static double by_events(void)
{
    const int axis = iso_section_axis(iso_free_point(&params, 1));
    const double begin = bench_milliseconds();
    for (int i = 0; i < SLOW_ORBITS; i++) {
        iso_orbit *orbit;
        iso_orbit_options o = iso_orbit_defaults(&starts[i]);
        o.method = iso_method_find("rk8pd"), o.backend = ISO_BACKEND_BALL;
        o.clock = ISO_CLOCK_T, o.shown = ISO_SHOW_BALL, o.with_clock[ISO_CLOCK_S] = true;
        if (iso_orbit_create(ctx, &params, &starts[i], &o, &orbit) != ISO_OK) stop();
        double from = 0;
        for (int turn = 0; turn < TURNS; turn++) {
            iso_sample sample;
            bool found;
            if (iso_orbit_event(orbit, height, &axis, 1, from, from + 1000, &found, &sample) != ISO_OK) stop();
            from = sample.clock[ISO_CLOCK_T];
        }
        iso_orbit_free(orbit);
    }
    return bench_milliseconds() - begin;
}

static double by_lanes(const char *vectors, iso_backend backend, bool deviations)
{
    static iso_crossing crossing[ORBITS * TURNS];
    static size_t done[ORBITS];
    static iso_status status[ORBITS];
    iso_crossings *c;
    iso_crossings_options o = iso_crossings_defaults();
    o.threads = 1, o.vectors = vectors, o.deviations = deviations, o.backend = backend;
    const double begin = bench_milliseconds();
    if (iso_crossings_create(ctx, orbits, ORBITS, &o, &c) != ISO_OK) stop();
    if (iso_crossings_go(c, NULL, TURNS, crossing, NULL, done, status) != ISO_OK) stop();
    iso_crossings_free(c);
    return bench_milliseconds() - begin;
}

static void print_lanes(bool deviations, double first)
{
    const char *vectors;
    for (int i = 0; (vectors = iso_batch_vectors(i, NULL)); i++)
        for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
            char name[64];
            double best = INFINITY;
            for (int pass = 0; pass < 3; pass++) best = fmin(best, by_lanes(vectors, backend, deviations));
            snprintf(name, sizeof name, "%s, by the %s", vectors, backend == ISO_BACKEND_BALL ? "ball" : "point");
            print(name, (double)ORBITS * TURNS, best, first);
        }
}

/* --- deviations: (9) and its first variation -------------------------------------------------------------------- */

/* J w' = J w x w + lambda n, n' = k n x w; and the same to first order in (dw, dn). */
static void vary(const double y[ISO_STATE], const double f[ISO_STATE], double lambda, const double d[ISO_STATE],
                 double out[ISO_STATE])
{
    const double *w = y, *n = y + 3, *dw = d, *dn = d + 3, *J = params.J, *inv = params.inv_J;
    double Jw[3], Jdw[3], a[3], b[3], c[3], over = 0, top = 0;
    (void)f;
    for (int i = 0; i < 3; i++) Jw[i] = J[i] * w[i], Jdw[i] = J[i] * dw[i];
    cross(Jdw, w, a);
    cross(Jw, dw, b);
    cross(Jw, w, c);
    for (int i = 0; i < 3; i++) {
        a[i] += b[i];
        over += n[i] * inv[i] * n[i];
        top -= a[i] * inv[i] * n[i] + c[i] * inv[i] * dn[i] + 2 * lambda * n[i] * inv[i] * dn[i];
    }
    const double dlambda = top / over;
    for (int i = 0; i < 3; i++) out[i] = inv[i] * (a[i] + dlambda * n[i] + lambda * dn[i]);
    cross(dn, w, a);
    cross(n, dw, b);
    for (int i = 0; i < 3; i++) out[3 + i] = params.k * (a[i] + b[i]);
}

static int variational(double t, const double y[], double dy[], void *data)
{
    const double *w = y, *n = y + 3;
    double Jw[3], turn[3], over = 0, top = 0;
    (void)t, (void)data;
    for (int i = 0; i < 3; i++) Jw[i] = params.J[i] * w[i];
    cross(Jw, w, turn);
    for (int i = 0; i < 3; i++) {
        over += n[i] * params.inv_J[i] * n[i];
        top -= turn[i] * params.inv_J[i] * n[i];
    }
    const double lambda = top / over;
    for (int i = 0; i < 3; i++) dy[i] = params.inv_J[i] * (turn[i] + lambda * n[i]);
    cross(n, w, turn);
    for (int i = 0; i < 3; i++) dy[3 + i] = params.k * turn[i];
    vary(y, dy, lambda, y + 6, dy + 6);
    vary(y, dy, lambda, y + 12, dy + 12);
    return GSL_SUCCESS;
}

/* Milliseconds for a hundred turns, sampled twenty times a turn. */
static double by_hand(double *turns)
{
    enum { SIZE = 18, SAMPLES = 2000 };
    gsl_odeiv2_system system = {variational, NULL, SIZE, NULL};
    const int axis = iso_section_axis(iso_free_point(&params, 1));
    const double begin = bench_milliseconds();
    *turns = 0;
    for (int i = 0; i < SLOW_ORBITS; i++) {
        double y[SIZE] = {0}, t = 0, last = 0;
        iso_point_to_ball(&params, starts[i].y, y);
        const double step = 0.05 * 6.28 / (fabs(params.k) * norm(y));
        for (int j = 0; j < 3; j++) y[6 + j] = y[15 + j] = 0.5 + 0.1 * j;
        gsl_odeiv2_driver *d =
            gsl_odeiv2_driver_alloc_standard_new(&system, gsl_odeiv2_step_rk8pd, step, 1e-12, 1e-12, 1, 0);
        for (int j = 0; j < SAMPLES; j++) {
            if (gsl_odeiv2_driver_apply(d, &t, t + step, y) != GSL_SUCCESS) exit(1);
            *turns += last < 0 && y[3 + axis] >= 0;
            last = y[3 + axis];
            for (int m = 0; m < 2; m++) { /* as long as 1 */
                const double length = hypot(norm(y + 6 + 6 * m), norm(y + 9 + 6 * m));
                for (int v = 0; v < 6; v++) y[6 + 6 * m + v] /= length;
            }
        }
        gsl_odeiv2_driver_free(d);
    }
    return bench_milliseconds() - begin;
}

/* --- none may be missed ----------------------------------------------------------------------------------------- */

static void count_crossings(double millions)
{
    static const double ks[] = {-2, -1, -0.5, 0.3, 0.5, 1, 3};
    enum { EACH = 2000 };
    static iso_crossing crossing[2][ORBITS * EACH];
    static size_t done[ORBITS];
    static iso_status status[ORBITS];
    double count = 0, failed = 0, apart = 0;
    for (int n = 0; count < 1e6 * millions; n++) {
        make_starts(ks[n % 7], true);
        for (int b = 0; b < 2; b++) {
            iso_crossings *c;
            iso_crossings_options o = iso_crossings_defaults();
            o.backend = b == 0 ? ISO_BACKEND_BALL : ISO_BACKEND_POINT;
            if (iso_crossings_create(ctx, orbits, ORBITS, &o, &c) != ISO_OK) stop();
            if (iso_crossings_go(c, NULL, EACH, crossing[b], NULL, done, status) != ISO_OK)
                printf("%s\n", iso_context_message(ctx)), failed++;
            for (int i = 0; i < ORBITS; i++) count += (double)done[i];
            iso_crossings_free(c);
        }
        for (int i = 0; i < ORBITS; i++)
            for (int j = 0; j < (fabs(params.k) == 1 ? EACH : 6); j++) {
                const double s[2] = {crossing[0][EACH * i + j].clock[2], crossing[1][EACH * i + j].clock[2]};
                apart = fmax(apart, fabs(s[1] / s[0] - 1));
            }
    }
    printf("%.0f crossings, %g runs that failed; the models' times differ by at most %.1e of them\n", count, failed,
           apart);
}

int main(int argc, char *argv[])
{
    ctx = iso_context_create();
    if (argc > 2 && strcmp(argv[1], "count") == 0) {
        count_crossings(atof(argv[2]));
        return 0;
    }
    make_starts(argc > 1 ? atof(argv[1]) : -1, false);
    double turns, first;
    printf("k = %g\ncrossings a second %30s\n", params.k, "ratio");
    first = print("iso_orbit_event, rk8pd", SLOW_ORBITS * TURNS, by_events(), 0);
    print_lanes(false, first);
    printf("turns a second with two deviations %14s\n", "ratio");
    const double time = by_hand(&turns);
    first = print("rk8pd by hand", turns, time, 0);
    print_lanes(true, first);
    iso_context_free(ctx);
    return 0;
}

/* The return map of free orbits in lanes, lib/orbit/crossings.h: its derivative, its fixed points, its integrals, and
 * that the numbers of an orbit do not depend on other orbits. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "laws.h"
#include "length.h"
#include "map/section_impl.h"
#include "map/state.h"
#include "orbit/crossings.h"

enum { MOST_ORBITS = 1000, MOST_EACH = 1000 };

static iso_context *ctx;
static iso_params params;
static iso_start starts[MOST_ORBITS];
static iso_batch_orbit orbits[MOST_ORBITS];
static iso_status status[MOST_ORBITS];
static size_t done[MOST_ORBITS];

static void start_at(int i, double l, double x)
{
    starts[i] = (iso_start){.model = ISO_POINT, .eps = 1};
    iso_section_point(iso_free_point(&params, 1), iso_section_axis(iso_free_point(&params, 1)), l, x, starts[i].y);
    orbits[i] = (iso_batch_orbit){&params, &starts[i], NULL};
}

static void start_spread(double k, const double J[3], int count)
{
    iso_section_spread spread;
    params = laws_params(k, J);
    iso_section_spread_prepare(&spread, iso_free_point(&params, 1), iso_section_axis(iso_free_point(&params, 1)), 5);
    for (int i = 0; i < count; i++) {
        double l, x;
        iso_section_spread_point(&spread, (uint64_t)i, &l, &x);
        start_at(i, l, x);
    }
}

static void go(const iso_crossings_options *o, const iso_batch_orbit from[], int count, size_t each,
               iso_crossing crossing[])
{
    iso_crossings *c;
    if (iso_crossings_create(ctx, from, (size_t)count, o, &c) != ISO_OK ||
        iso_crossings_go(c, NULL, each, crossing, NULL, done, status) != ISO_OK)
        gsl_test(1, "crossings: %s", iso_context_message(ctx));
    iso_crossings_free(c);
}

static iso_crossings_options options_of(iso_backend backend, const char *vectors, bool deviations)
{
    iso_crossings_options o = iso_crossings_defaults();
    o.backend = backend, o.vectors = vectors, o.deviations = deviations;
    return o;
}

/* --- its derivative --------------------------------------------------------------------------------------------- */

static const double ks[] = {-2, -1, -0.8, -0.4, 0.3, 0.5, 0.75, 1, 2};
static const double Js[][3] = {{1.4, 2.1, 3}, {2, 5, 1}, {5, 1, 2}};
enum { KS = sizeof ks / sizeof *ks };

/* The image of (l, x) under the return map, by differences of which its derivative is measured. */
static void image(const void *options, const double from[], double to[])
{
    iso_crossing crossing;
    start_at(0, from[0], from[1]);
    go(options, orbits, 1, 1, &crossing);
    to[0] = cos(crossing.l), to[1] = sin(crossing.l), to[2] = crossing.x;
}

static void check_slope(const iso_crossings_options *o, double l, double x, laws_worst *slopes, laws_worst *areas)
{
    const int axis = iso_section_axis(iso_free_point(&params, 1));
    iso_crossing c;
    start_at(0, l, x);
    go(o, orbits, 1, 1, &c);
    for (int j = 0; j < 2; j++) {
        double found[3];
        const double direction[2] = {j == 0, j == 1};
        laws_slope(image, o, 3, 2, (const double[]){l, x}, direction, 2e-3 * (1 - fabs(x)), found);
        const double dl = cos(c.l) * found[1] - sin(c.l) * found[0], size = fabs(dl) + fabs(found[2]);
        laws_note(slopes, fabs(c.slope[0][j] - dl) / size, 1e-8, &params, "by l");
        laws_note(slopes, fabs(c.slope[1][j] - found[2]) / size, 1e-8, &params, "by x");
    }
    const double det = c.slope[0][0] * c.slope[1][1] - c.slope[0][1] * c.slope[1][0];
    const double size = fabs(c.slope[0][0] * c.slope[1][1]) + fabs(c.slope[0][1] * c.slope[1][0]);
    const double expected = iso_section_momentum(iso_free_point(&params, 1), axis, l) /
                            iso_section_momentum(iso_free_point(&params, 1), axis, c.l);
    laws_note(areas, fabs(det - expected) / size, 1e-11, &params, "area");
}

static void check_slopes(void)
{
    static const char *const vectors[] = {"plain", "avx2", "avx512", "extended", "quad"};
    laws_worst slopes = {0}, areas = {0};
    for (int n = 0; n < tests_length(KS, 3 * KS); n++) {
        iso_section_spread spread;
        double l, x;
        params = laws_params(ks[n % KS], Js[n % 3]);
        iso_section_spread_prepare(&spread, iso_free_point(&params, 1), iso_section_axis(iso_free_point(&params, 1)),
                                   7);
        iso_section_spread_point(&spread, (uint64_t)n, &l, &x);
        for (int v = 0; v < 5; v++)
            for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
                const iso_crossings_options o = options_of(backend, vectors[v], true);
                iso_crossings *c;
                if (iso_crossings_create(ctx, orbits, 0, &o, &c) != ISO_OK) continue; /* no such vectors here */
                iso_crossings_free(c);
                if (v == 4 && n >= 1) continue; /* slow */
                check_slope(&o, l, x, &slopes, &areas);
            }
    }
    laws_report(&slopes, "the derivative of the return map, by differences");
    laws_report(&areas, "it keeps dL dl");
}

/* --- fixed points ----------------------------------------------------------------------------------------------- */

/* Half-turn traces T of rotations about the axes b and c, beside the section's own axis; Hill's equation by another
 * code. A turn has the trace T^2 - 2. */
static void check_fixed_points(void)
{
    static const struct {
        double k, J[3], T[2];
    } rows[] = {{-2, {1.4, 2.1, 3}, {-2.08844277, -1.64204496}},  {-1, {1.4, 2.1, 3}, {-2.35263343, -0.29106773}},
                {-0.5, {1.4, 2.1, 3}, {-3.42625824, 7.66156228}}, {0.5, {1.4, 2.1, 3}, {0.73482572, -3.56858865}},
                {1, {1.4, 2.1, 3}, {-1.45392350, -2.36990950}},   {2, {1.4, 2.1, 3}, {-1.87809342, -2.09058642}},
                {-1, {1, 2, 5}, {-3.08144739, 42.73314819}},      {0.5, {1, 2, 5}, {6.27038962, -11.14417488}}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        for (int i = 0; i < 4; i++) {
            iso_crossing c;
            const iso_crossings_options o = options_of(i % 2 == 0 ? ISO_BACKEND_BALL : ISO_BACKEND_POINT, NULL, true);
            params = laws_params(rows[r].k, rows[r].J);
            start_at(0, i < 2 ? ISO_PI / 2 : 0, 0); /* axis b, axis c */
            go(&o, orbits, 1, 1, &c);
            const double T = rows[r].T[i / 2], trace = c.slope[0][0] + c.slope[1][1];
            gsl_test_abs(trace, T * T - 2, 1e-7 * (T * T + 1), "k = %g, J3 = %g: trace of axis %d", rows[r].k,
                         rows[r].J[2], (iso_section_axis(iso_free_point(&params, 1)) + 1 + i / 2) % 3 + 1);
        }
}

/* --- integrals -------------------------------------------------------------------------------------------------- */

/* The second integral of the point with eps = 1, in units of the largest of its terms. */
static double second_integral(const double point[ISO_STATE])
{
    const double *J = params.J, *inv = params.inv_J, *M = point, *gamma = point + 3;
    double velocity[3], a = 0, b = 0;
    cross(gamma, M, velocity);
    for (int i = 0; i < 3; i++) {
        a += params.k == -1 ? M[i] * J[i] * M[i] / params.det_J : velocity[i] * inv[i] * velocity[i];
        b += params.k == -1 ? 2 * gamma[i] * inv[i] * gamma[i] : 0;
    }
    return a + b;
}

static void check_integrals(void)
{
    const int count = tests_length(100, MOST_ORBITS), each = tests_length(100, MOST_EACH);
    iso_crossing *crossing = malloc((size_t)count * (size_t)each * sizeof *crossing);
    laws_worst worst = {0};
    for (int n = 0; crossing && n < 4; n++) {
        start_spread(n % 2 == 0 ? -1 : 1, Js[0], count);
        const int axis = iso_section_axis(iso_free_point(&params, 1));
        const iso_crossings_options o = options_of(n / 2 == 0 ? ISO_BACKEND_BALL : ISO_BACKEND_POINT, NULL, false);
        go(&o, orbits, count, (size_t)each, crossing);
        for (int i = 0; i < count; i++) {
            const double F = second_integral(starts[i].y);
            for (int j = 0; j < each; j++) {
                double point[ISO_STATE];
                const iso_crossing *c = &crossing[i * each + j];
                iso_section_point(iso_free_point(&params, 1), axis, c->l, c->x, point);
                laws_note(&worst, fabs(second_integral(point) - F) / fabs(F), 1e-12, &params, "F");
            }
        }
    }
    gsl_test(!crossing, "memory");
    laws_report(&worst, "k = 1, -1: all crossings on their level of F");
    free(crossing);
}

/* --- no orbit feels another ------------------------------------------------------------------------------------- */

static bool same(const iso_crossing *a, const iso_crossing *b)
{
    const double *x = (const double *)a, *y = (const double *)b;
    bool equal = true;
    for (size_t i = 0; i < sizeof *a / sizeof *x; i++)
        equal = equal && (x[i] == y[i] || (isnan(x[i]) && isnan(y[i])));
    return equal;
}

typedef struct stopper {
    int left;
} stopper;

static bool goes_on(void *data)
{
    stopper *s = data;
    return s->left-- > 0;
}

/* In parts of 7, each stopped after some steps and gone on with. */
static int go_with_stops(const iso_crossings_options *o, int count, int each, iso_crossing crossing[])
{
    static size_t got[MOST_ORBITS];
    enum { PART = 7 };
    iso_crossing part[PART];
    int stops = 0;
    for (int i = 0; i < count; i++) {
        iso_crossings *c;
        got[0] = 0;
        if (iso_crossings_create(ctx, &orbits[i], 1, o, &c) != ISO_OK) return -1;
        for (int turn = 0; got[0] < (size_t)each && turn < 1000; turn++) {
            stopper s = {3 + turn % 5};
            const size_t left = (size_t)each - got[0], wanted = left < PART ? left : PART;
            size_t now;
            iso_context_set_monitor(ctx, goes_on, &s);
            const iso_status done_with = iso_crossings_go(c, NULL, wanted, part, NULL, &now, status);
            stops += done_with == ISO_STOPPED && status[0] == ISO_STOPPED;
            iso_context_set_monitor(ctx, NULL, NULL);
            memcpy(&crossing[i * each + (int)got[0]], part, now * sizeof *part);
            got[0] += now;
        }
        iso_crossings_free(c);
    }
    return stops;
}

static void check_bits(const char *vectors, iso_backend backend, bool deviations)
{
    enum { COUNT = 41, EACH = 30 };
    static iso_crossing first[COUNT * EACH], other[COUNT * EACH], stopped[COUNT * EACH];
    static iso_batch_orbit turned[COUNT];
    iso_crossings_options o = options_of(backend, vectors, deviations);
    start_spread(0.5, (const double[]){1, 2, 5}, COUNT);
    start_at(0, 0.3, 1 - 1e-12); /* next to the boundary */
    for (int i = 0; i < COUNT; i++) turned[i] = orbits[COUNT - 1 - i];
    o.threads = 1;
    go(&o, orbits, COUNT, EACH, first);
    o.threads = 3;
    go(&o, turned, COUNT, EACH, other);
    int wrong = 0;
    for (int i = 0; i < COUNT; i++)
        for (int j = 0; j < EACH; j++) wrong += !same(&first[i * EACH + j], &other[(COUNT - 1 - i) * EACH + j]);
    gsl_test_int(wrong, 0, "%s, backend %d: order and threads change nothing", vectors, backend);
    const int stops = go_with_stops(&o, COUNT, EACH, stopped);
    wrong = 0;
    for (int i = 0; i < COUNT * EACH; i++) wrong += !same(&first[i], &stopped[i]);
    gsl_test(wrong != 0 || stops < COUNT, "%s, backend %d: %d of %d change in parts, with %d stops", vectors, backend,
             wrong, COUNT * EACH, stops);
}

int main(void)
{
    gsl_test_verbose(1);
    ctx = iso_context_create();
    check_slopes();
    check_fixed_points();
    check_integrals();
    const char *vectors;
    for (int v = 0; (vectors = iso_batch_vectors(v, NULL)); v++)
        for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++)
            for (int deviations = 0; deviations < 2; deviations++) check_bits(vectors, backend, deviations == 1);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

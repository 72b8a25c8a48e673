/* The return map of free orbits in lanes, lib/orbit/crossings.h: its derivative, and that
 * the numbers of an orbit do not depend on other orbits. */
#include "base/math_impl.h"
#include "base/random_impl.h"
#include "crossed.h"
#include "map/section_impl.h"
#include "map/state.h"

enum { MOST_ORBITS = 64 };

static iso_context *ctx;
static iso_params params;
static iso_start starts[MOST_ORBITS];
static iso_batch_orbit orbits[MOST_ORBITS];
static iso_status status[MOST_ORBITS];

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
    crossed_all(ctx, from, (size_t)count, o, each, crossing, NULL);
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

static void check_slope(const iso_crossings_options *o, double l, double x, laws_worst *slopes)
{
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
}

static void check_slopes(void)
{
    static const char *const vectors[] = {"plain", "avx2", "avx512", "extended", "quad"};
    laws_worst slopes = {0};
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
                check_slope(&o, l, x, &slopes);
            }
    }
    laws_report(&slopes, "the derivative of the return map, by differences");
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
            int asks = 3 + turn % 5;
            const size_t left = (size_t)each - got[0], wanted = left < PART ? left : PART;
            size_t now;
            iso_context_set_monitor(ctx, some_times, &asks);
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
    ctx = iso_context_create();
    check_slopes();
    const char *vectors;
    for (int v = 0; (vectors = iso_batch_vectors(v, NULL)); v++)
        for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++)
            for (int deviations = 0; deviations < 2; deviations++) check_bits(vectors, backend, deviations == 1);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

/* bench_crossings - how many crossings of the section a second can be computed, alone and with deviations.
 *
 *     bench_crossings [K [T]]        speed, J = (1, 2, 5); T: tolerance of ours, default 1e-12
 *
 * The orbits start evenly spread over the section. All runs have tolerance 1e-12, and ours T; one thread; seconds are
 * processor time. `ratio` is to the fastest rival; of the rivals to the first.
 *
 * - crossings: the rivals are plain loops over the steps of GSL's rk8pd (rivals/gsl.c), and of Boost.odeint's
 *   fehlberg78 and bulirsch_stoer_dense_out where it is found (rivals/odeint.cpp), by the ball and by the point.
 *   Then iso_crossings with each kind of vectors.
 * - with two deviations, as for the verdict of `isoroll chaos`: the same loops with the variational equations, 18
 *   numbers. Then iso_crossings with deviations.
 * - `off`: the largest relative error of the times of the first 5 crossings, against ours at 1e-15 by the same model.
 *   The law: a rival's `off` is below 1e-9, and its variations there are ours up to 1e-6.
 */
#include "orbit/crossings.h"
#include "bench.h"
#include "map/section_impl.h"
#include "map/state.h"
#include "rivals/rivals.h"

enum { ORBITS = 256, TURNS = 200, SLOW_ORBITS = 8, CHECKED = 5 };
static const double tolerance = 1e-12; /* of the rivals */
static double our_tolerance = 1e-12;

static iso_context *ctx;
static iso_params params;
static iso_start starts[ORBITS];
static iso_batch_orbit orbits[ORBITS];
static double start_at[ORBITS][2];                  /* l, x */
static iso_crossing crossing[ORBITS * TURNS];       /* of the last run of ours */
static iso_crossing right[2][SLOW_ORBITS][CHECKED]; /* by each model at 1e-15 */

static void make_starts(double k)
{
    params = bench_params(ctx, k, (double[]){1, 2, 5});
    const int axis = iso_section_axis(iso_free_point(&params, 1));
    iso_section_spread spread;
    iso_section_spread_prepare(&spread, iso_free_point(&params, 1), axis, 1);
    for (uint64_t i = 0; i < ORBITS; i++) {
        double l, x;
        iso_section_spread_point(&spread, i, &l, &x);
        start_at[i][0] = l, start_at[i][1] = x;
        starts[i] = bench_section_start(&params, l, x);
        orbits[i] = (iso_batch_orbit){&params, &starts[i], NULL};
    }
}

static double print(const char *name, double count, double milliseconds, double first, double off)
{
    const double rate = 1e3 * count / milliseconds;
    printf("  %-32s %8.0f  %8.1f  %8.1e\n", name, rate, first > 0 ? rate / first : 1, off);
    return rate;
}

/* NaN counts as the largest. */
static double larger(double worst, double off)
{
    return off <= worst ? worst : off;
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

static double by_lanes(const char *vectors, iso_backend backend, bool deviations, double accuracy)
{
    static size_t done[ORBITS];
    static iso_status status[ORBITS];
    iso_crossings *c;
    iso_crossings_options o = iso_crossings_defaults();
    o.threads = 1, o.vectors = vectors, o.deviations = deviations, o.backend = backend;
    o.tolerance = accuracy;
    const double begin = bench_milliseconds();
    bench_must(ctx, iso_crossings_create(ctx, orbits, ORBITS, &o, &c));
    bench_must(ctx, iso_crossings_go(c, NULL, TURNS, crossing, NULL, done, status));
    iso_crossings_free(c);
    return bench_milliseconds() - begin;
}

static const iso_clock clock_of[] = {ISO_CLOCK_T, ISO_CLOCK_S}; /* of the ball, of the point */

static void find_right(iso_backend backend, bool deviations)
{
    by_lanes(NULL, backend, deviations, 1e-15);
    for (size_t i = 0; i < SLOW_ORBITS; i++)
        memcpy(right[backend][i], crossing + i * TURNS, sizeof right[backend][i]);
}

static double lanes_off(iso_backend backend)
{
    double off = 0;
    for (size_t i = 0; i < SLOW_ORBITS; i++)
        for (size_t turn = 0; turn < CHECKED; turn++)
            off = larger(off, fabs(crossing[i * TURNS + turn].clock[clock_of[backend]] /
                                       right[backend][i][turn].clock[clock_of[backend]] -
                                   1));
    return off;
}

static void print_lanes(bool deviations, double first)
{
    const char *vectors;
    for (int i = 0; (vectors = iso_batch_vectors(i, NULL)); i++)
        for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
            char name[64];
            double best = INFINITY;
            for (int pass = 0; pass < 3; pass++)
                best = fmin(best, by_lanes(vectors, backend, deviations, our_tolerance));
            snprintf(name, sizeof name, "%s, by the %s", vectors, backend == ISO_BACKEND_BALL ? "ball" : "point");
            print(name, (double)ORBITS * TURNS, best, first, lanes_off(backend));
        }
}

/* --- rivals ----------------------------------------------------------------------------------------------------- */

/* The law for a rival: its crossings are ours. Chaotic orbits part, so only the first ones are compared. */
typedef struct check {
    const iso_crossing *ours;
    bool point, deviations;
    int crossings, variations; /* that were compared */
    double worst, worst_variation;
} check;

static rival_problem problem_of(bool point, bool deviations)
{
    const double *J = params.J;
    return (rival_problem){
        .point = point, .k = params.k, .J = {J[0], J[1], J[2]}, .eps = 1, .variations = deviations ? 2 : 0};
}

/* The state of the ball or of the point at (l, x) of the section. */
static void state_at(bool point, double l, double x, double y[ISO_STATE])
{
    const iso_start at = bench_section_start(&params, l, x);
    if (point)
        memcpy(y, at.y, sizeof at.y);
    else
        iso_point_to_ball(&params, at.y, y);
}

/* Its derivatives by l and x. */
static void tangents(bool point, double l, double x, double by[2][ISO_STATE])
{
    const double step = 1e-5;
    for (int v = 0; v < 2; v++) {
        double before[ISO_STATE], after[ISO_STATE];
        state_at(point, l - (v == 0 ? step : 0), x - (v == 1 ? step : 0), before);
        state_at(point, l + (v == 0 ? step : 0), x + (v == 1 ? step : 0), after);
        for (int i = 0; i < ISO_STATE; i++) by[v][i] = (after[i] - before[i]) / (2 * step);
    }
}

/* How far the rival's variation v, moved along the flow onto the section, is from what our slopes say. */
static double variation_error(const iso_crossing *c, bool point, int v, const double y[])
{
    const int height = 3 + iso_section_axis(iso_free_point(&params, 1));
    const rival_problem p = problem_of(point, false);
    const double *d = y + 6 + 6 * v;
    double by[2][ISO_STATE], flow[ISO_STATE], off = 0, size = 0;
    tangents(point, c->l, c->x, by);
    rival_rhs(&p, y, flow);
    for (int i = 0; i < ISO_STATE; i++) {
        const double ours = c->slope[0][v] * by[0][i] + c->slope[1][v] * by[1][i];
        off = fmax(off, fabs(d[i] - flow[i] * d[height] / flow[height] - ours));
        size = fmax(size, fabs(ours));
    }
    return off / size;
}

static void see(void *data, int turn, double time, const double y[], const double growth[2])
{
    check *c = data;
    if (turn >= CHECKED) return;
    c->worst = larger(c->worst, fabs(time / c->ours[turn].clock[clock_of[c->point]] - 1));
    c->crossings++;
    for (int v = 0; v < 2 && c->deviations && growth[v] == 0; v++) {
        c->worst_variation = larger(c->worst_variation, variation_error(&c->ours[turn], c->point, v, y));
        c->variations++;
    }
}

static double by_rival(const rival_walker *walker, bool point, bool deviations, double *off)
{
    const rival_problem p = problem_of(point, deviations);
    const int axis = iso_section_axis(iso_free_point(&params, 1));
    check c = {.point = point, .deviations = deviations};
    bool followed = true;
    const double begin = bench_milliseconds();
    for (int i = 0; i < SLOW_ORBITS; i++) {
        double y[RIVAL_MOST] = {0};
        const double l = start_at[i][0], x = start_at[i][1];
        state_at(point, l, x, y);
        if (deviations) tangents(point, l, x, (double(*)[ISO_STATE])(y + ISO_STATE));
        c.ours = right[point][i];
        followed = walker->follow(&p, axis, tolerance, TURNS, y, see, &c) && followed;
    }
    const double milliseconds = bench_milliseconds() - begin;
    const bool enough =
        followed && c.crossings == SLOW_ORBITS * CHECKED && (!deviations || c.variations >= 2 * SLOW_ORBITS);
    bench_check_rival(walker->name, enough ? c.worst : NAN, 1e-9);
    bench_check_rival(walker->name, c.worst_variation, 1e-6);
    *off = c.worst;
    return milliseconds;
}

/* Gives the rate of the fastest. */
static double print_rivals(bool deviations)
{
    double first = 0, fastest = 0;
    for (const rival_walker *walker = rival_walkers; walker->name; walker++)
        for (int point = 0; point <= 1; point++) {
            char name[64];
            double best = INFINITY, off = NAN;
            for (int pass = 0; pass < 3; pass++) best = fmin(best, by_rival(walker, point, deviations, &off));
            snprintf(name, sizeof name, "%s, by the %s", walker->name, point ? "point" : "ball");
            const double rate = print(name, SLOW_ORBITS * TURNS, best, first, off);
            if (first == 0) first = rate;
            fastest = fmax(fastest, rate);
        }
    return fastest;
}

int main(int argc, char *argv[])
{
    ctx = iso_context_create();
    if (argc > 2) our_tolerance = atof(argv[2]);
    make_starts(argc > 1 ? atof(argv[1]) : -1);
    printf("k = %g\n", params.k);
    for (int deviations = 0; deviations <= 1; deviations++) {
        printf("%-34s %8s  %8s  %8s\n", deviations ? "turns with two deviations" : "crossings", "a second", "ratio",
               "off");
        for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++) find_right(b, deviations);
        print_lanes(deviations, print_rivals(deviations));
    }
    iso_context_free(ctx);
    return 0;
}

/* bench_exact - what the closed solution costs: set-up, one time, grids; and what methods with steps cost instead.
 *
 *     bench_exact [race|--long]
 *
 * How to read the first table. It shows microseconds of processor time for ORBITS random orbits (J between 1 and 4)
 * of each kind. The columns are: set-up with the clock t alone, set-up with all three clocks, one state at random
 * times t up to a bound, one point of a grid whose step is given in turns. Each kind has three rows:
 * - half: half of the orbits take at most so long (of each orbit the least of several rounds counts);
 * - 95 %: so do 95 % of the orbits;
 * - rounds: the median of all rounds of all orbits. If it is far above `half`, other work disturbed the machine.
 * inf: the orbit was refused.
 *
 * How to read the second table. It goes to t = 1e2, 1e3, ... on problem A of bench_methods, and shows milliseconds
 * and errors of the closed solution (set-up included), of `taylor` on the point, and of the rival, each at the
 * tolerance where it is most exact. An error is relative to the length of the vector, against Taylor series in long
 * double, as far as these go. A time in brackets is the last run's, scaled with t. race: this table alone.
 * --long: ten times as far.
 * The rival is a loop over the steps of GSL's rk8pd on the ball (rivals/gsl.c). The law: its error at t = 1000 is
 * below 1e-9. Else the program fails.
 */
#include <string.h>

#include "base/random_impl.h"
#include "bench.h"
#include "exact/exact_impl.h"
#include "laws.h"
#include "map/state.h"
#include "method/integrator_impl.h"
#include "model/model_impl.h"
#include "rivals/rivals.h"

enum { ORBITS = 30, ROUNDS = 5, TIMES = 50, POINTS = 300 };

static iso_context *ctx;

static void must(iso_status status)
{
    bench_must(ctx, status);
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

typedef struct orbit {
    iso_problem problem;
    double point[ISO_STATE];
} orbit;

static orbit sample(double k, const double J[3], iso_random *random)
{
    orbit o = {.problem.p = bench_params(ctx, k, J)};
    laws_sample(&iso_system_point, &o.problem, random, o.point);
    return o;
}

/* To this gamma in the plane gamma2 = 0, with M along that plane and across it in a ratio. */
static void put(orbit *o, double gamma1, double gamma3, double along, double across)
{
    const double to[ISO_STATE] = {-along * gamma3, across, along * gamma1, gamma1, 0, gamma3};
    memcpy(o->point, to, sizeof to);
    iso_system_point.project(&o->problem, o->point);
}

typedef struct kind {
    const char *name;
    double k, distance;
    enum { ANY, REVOLUTION, PLANE, NEAR } where;
} kind;

static orbit make_orbit(const kind *row, iso_random *random)
{
    double J[3];
    for (int i = 0; i < 3; i++) J[i] = iso_random_uniform(random, 1, 4);
    if (row->where == REVOLUTION) J[1] = J[0];
    if (row->where == NEAR) bench_sort(J, 3);
    if (row->where == PLANE) J[1] += 3; /* a stable rotation */
    orbit o = sample(row->k, J, random);
    const double *b = row->k == 1 ? o.problem.p.inv_J : J, angle = iso_random_uniform(random, 0.3, 1.3);
    if (row->where == PLANE) put(&o, cos(angle), sin(angle), 0, 1);
    if (row->where == NEAR) /* where gamma2 = 0 the distance is one of gamma alone */
        put(&o, sqrt((1 - row->distance) * fabs(b[1] - b[0])), sqrt((1 + row->distance) * fabs(b[2] - b[1])),
            cos(angle), sin(angle));
    return o;
}

/* --- set-up, one time, grids ------------------------------------------------------------------------------------ */

static const bool clock_t_alone[ISO_CLOCKS] = {true, false, false}, all_clocks[ISO_CLOCKS] = {true, true, true};
static const double until[] = {1e2, 1e6, 1e12}, step[] = {0.01, 0.1, 1, 10};
enum { UNTIL = 3, STEPS = 4, ONE = 2, GRIDS = ONE + UNTIL, COLUMNS = GRIDS + STEPS };

static double set_up(const orbit *o, const bool clocks[ISO_CLOCKS])
{
    iso_exact *exact;
    const double begin = bench_milliseconds();
    must(iso_exact_create(ctx, &o->problem, o->point, clocks, &exact));
    const double took = bench_milliseconds() - begin;
    iso_exact_free(exact);
    return 1e3 * took;
}

static double one(const iso_exact *exact, const double time[TIMES])
{
    double y[ISO_STATE], clocks[ISO_CLOCKS];
    const double begin = bench_milliseconds();
    for (int i = 0; i < TIMES; i++) must(iso_exact_at(ctx, exact, ISO_CLOCK_T, time[i], y, clocks));
    return 1e3 * (bench_milliseconds() - begin) / TIMES;
}

static double grid(const iso_exact *exact, double every)
{
    iso_exact_walk walk = {0};
    double y[ISO_STATE], clocks[ISO_CLOCKS];
    const double begin = bench_milliseconds();
    for (int i = 0; i < POINTS; i++)
        must(iso_exact_walk_to(ctx, exact, &walk, ISO_CLOCK_T, 1 + i * every, y, clocks));
    return 1e3 * (bench_milliseconds() - begin) / POINTS;
}

static void measure(const orbit *o, iso_random *random, double took[COLUMNS])
{
    iso_exact *exact;
    double time[TIMES];
    for (int c = 0; c < COLUMNS; c++) took[c] = INFINITY;
    if (iso_exact_create(ctx, &o->problem, o->point, clock_t_alone, &exact) != ISO_OK) return;
    took[0] = set_up(o, clock_t_alone);
    took[1] = set_up(o, all_clocks);
    const double turn = 2 * M_PI / fabs(iso_exact_describe(exact).frequency[ISO_CLOCK_T][0]);
    for (int i = 0; i < UNTIL; i++) {
        for (int j = 0; j < TIMES; j++) time[j] = iso_random_uniform(random, -until[i], until[i]);
        took[ONE + i] = one(exact, time);
    }
    for (int i = 0; i < STEPS; i++) took[GRIDS + i] = grid(exact, step[i] * turn);
    iso_exact_free(exact);
}

static void print_row(const kind *row, const char *what, double took[COLUMNS][ORBITS * ROUNDS], int count,
                      double share)
{
    printf("%-24s %-6s", row->name, what);
    for (int c = 0; c < COLUMNS; c++) {
        bench_sort(took[c], (size_t)count);
        printf(c < ONE ? "%8.0f" : "%8.2f", took[c][(int)(share * (count - 1))]);
    }
    putchar('\n');
}

static void bench(const kind *row)
{
    static double least[COLUMNS][ORBITS * ROUNDS], all[COLUMNS][ORBITS * ROUNDS];
    static orbit orbits[ORBITS];
    iso_random *random = iso_random_create(1);
    for (int i = 0; i < ORBITS; i++) orbits[i] = make_orbit(row, random);
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < ORBITS; i++) {
            double took[COLUMNS];
            measure(&orbits[i], random, took);
            for (int c = 0; c < COLUMNS; c++) {
                all[c][round * ORBITS + i] = took[c];
                least[c][i] = round == 0 ? took[c] : fmin(least[c][i], took[c]);
            }
        }
    print_row(row, "half", least, ORBITS, 0.5);
    print_row(row, "95 %", least, ORBITS, 0.95);
    print_row(row, "rounds", all, ORBITS * ROUNDS, 0.5);
    fflush(stdout);
    iso_random_free(random);
}

static void bench_kinds(void)
{
    static const kind kinds[] = {
        {"k = -1", -1, 0, ANY},
        {"k = 1", 1, 0, ANY},
        {"revolution, k = -1", -1, 0, REVOLUTION},
        {"revolution, k = 1/2", 0.5, 0, REVOLUTION},
        {"plane, k = 1", 1, 0, PLANE},
        {"plane, k = 1/2", 0.5, 0, PLANE},
    };
    printf("%-31s%16s%24s%32s\n%-31s", "microseconds", "set-up", "one time, up to", "grid, steps in turns", "");
    printf("%8s%8s", "t", "t,tau,s");
    for (int i = 0; i < UNTIL; i++) printf("%8.0e", until[i]);
    for (int i = 0; i < STEPS; i++) printf("%8g", step[i]);
    putchar('\n');
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) bench(&kinds[i]);
    for (int digits = 3; digits <= 12; digits += 3)
        for (int k = -1; k <= 1; k += 2) {
            char name[32];
            snprintf(name, sizeof name, "separatrix 1e-%d, k = %d", digits, k);
            bench(&(kind){name, k, pow(10, -digits), NEAR});
        }
}

/* --- against stepping ------------------------------------------------------------------------------------------- */

enum { FIRST = 2, LAST = 9, DECADES = LAST - FIRST + 1 };

/* How a row of times was found: the ball at the ends 10^2, 10^3 ..., milliseconds, and how far it went. */
typedef struct way {
    double ball[DECADES][ISO_STATE], milliseconds[DECADES], last;
} way;

/* From 0 to each end up to `last`, each on its own, or (together) the later ones onwards. */
static void run(const char *method, double tolerance, const iso_system *system, const iso_problem *problem,
                const double y0[], double last, bool together, way *w)
{
    const iso_model model = iso_model_assemble(system, problem, ISO_CLOCK_T, (const bool[ISO_CLOCKS]){false});
    const iso_method_options options = {.tolerance = tolerance};
    iso_integrator *it = NULL;
    w->last = last;
    for (int i = 0; i < DECADES && pow(10, FIRST + i) <= 1.01 * last; i++) {
        double y[ISO_MAX_STATE];
        const double begin = bench_milliseconds();
        if (!it) {
            must(iso_integrator_create(ctx, iso_method_find(method), &model, &options, &it));
            must(iso_integrator_start(it, y0));
        }
        must(iso_integrator_at(it, pow(10, FIRST + i), y));
        w->milliseconds[i] = bench_milliseconds() - begin;
        memcpy(w->ball[i], y, sizeof w->ball[i]);
        if (system == &iso_system_point) iso_point_to_ball(&problem->p, y, w->ball[i]);
        if (together) continue;
        iso_integrator_free(it);
        it = NULL;
    }
    iso_integrator_free(it);
}

/* From 0 to each end up to `last`, each on its own. */
static void run_rival(double k, double last, const way *reference, way *w)
{
    const rival_problem ball = {.k = k, .J = {bench_J[0], bench_J[1], bench_J[2]}};
    w->last = last;
    for (int i = 0; i < DECADES && pow(10, FIRST + i) <= 1.01 * last; i++) {
        memcpy(w->ball[i], bench_state, sizeof bench_state);
        const double begin = bench_milliseconds();
        if (!rival_gsl_rk8pd(&ball, 1e-14, pow(10, FIRST + i), w->ball[i])) w->ball[i][0] = NAN;
        w->milliseconds[i] = bench_milliseconds() - begin;
    }
    bench_check_rival("GSL", bench_error(w->ball[3 - FIRST], reference->ball[3 - FIRST]), 1e-9);
}

static double closed(const iso_problem *problem, const double point[], double end, int times, double ball[])
{
    double least = INFINITY, y[ISO_STATE];
    for (int round = 0; round < ROUNDS; round++) {
        iso_exact *exact;
        const double begin = bench_milliseconds();
        must(iso_exact_create(ctx, problem, point, clock_t_alone, &exact));
        for (int i = 1; i <= times; i++) must(iso_exact_at(ctx, exact, ISO_CLOCK_T, end * i / times, y, NULL));
        least = fmin(least, bench_milliseconds() - begin);
        iso_exact_free(exact);
    }
    iso_point_to_ball(&problem->p, y, ball);
    return least;
}

static void print_way(const way *w, const way *reference, int i)
{
    const double t = pow(10, FIRST + i);
    char took[32] = "", error[32] = "-";
    if (t <= 1.01 * w->last)
        snprintf(took, sizeof took, "%.4g", w->milliseconds[i]);
    else
        snprintf(took, sizeof took, "(%.2g)", w->milliseconds[(int)(log10(w->last) + 0.5) - FIRST] * t / w->last);
    if (t <= 1.01 * fmin(w->last, reference->last))
        snprintf(error, sizeof error, "%.1e", bench_error(w->ball[i], reference->ball[i]));
    printf("%12s%9s", took, error);
}

static void bench_long(double k, double longer)
{
    static way reference, taylor, rk8pd, exact;
    iso_problem ball = {.p = bench_params(ctx, k, bench_J)}, point = ball;
    double at[ISO_STATE], unused[ISO_STATE];
    ball.energy = iso_ball_energy(&ball.p, bench_state);
    point.eps = iso_coupling(&ball.p, ball.energy);
    iso_ball_to_point(&ball.p, bench_state, at);
    run("taylor_extended", 1e-15, &iso_system_ball, &ball, bench_state, 1e5 * longer, true, &reference);
    run("taylor", 1e-15, &iso_system_point, &point, at, 1e6 * longer, false, &taylor);
    run_rival(k, 1e5 * longer, &reference, &rk8pd);
    exact.last = pow(10, LAST);
    printf("\nk = %-6g%33s%21s%21s\n%-10s%12s%9s%12s%12s%9s%12s%9s\n", k, "closed solution", "taylor, point",
           "GSL rk8pd, ball", "t", "ms, 1 time", "error", "1000 times", "ms", "error", "ms", "error");
    for (int i = 0; i < DECADES; i++) {
        const double end = pow(10, FIRST + i);
        exact.milliseconds[i] = closed(&point, at, end, 1, exact.ball[i]);
        printf("%-10.0e", end);
        print_way(&exact, &reference, i);
        printf("%12.4g", closed(&point, at, end, 1000, unused));
        print_way(&taylor, &reference, i);
        print_way(&rk8pd, &reference, i);
        putchar('\n');
    }
}

int main(int argc, char **argv)
{
    ctx = iso_context_create();
    if (argc < 2 || strcmp(argv[1], "race") != 0) bench_kinds();
    for (int k = -1; k <= 1; k += 2) bench_long(k, argc > 1 && strcmp(argv[1], "--long") == 0 ? 10 : 1);
    iso_context_free(ctx);
    return 0;
}

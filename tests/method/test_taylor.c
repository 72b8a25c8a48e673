/* The Taylor series of lib/method/taylor/: recurrences, orders, processors, integrals of long runs. */
#include "method/taylor/code_impl.h"
#include "orbits.h"

static iso_context *ctx;
static const iso_method *taylor, *extended;
static const iso_method_options finest = {.tolerance = 1e-15};

/* --- every recurrence ------------------------------------------------------------------------------------------- */

/* What acts on neither the motion nor a state of it doubles the cases for nothing. */
static bool idle(const effects_case *c)
{
    return c->subset & (1 << ISO_REACTIONS | 1 << ISO_CLOCK);
}

typedef struct course {
    iso_integrator *it;
    bool failed;
} course;

static void state_at(const void *data, const double t[], double y[])
{
    course *const way = *(course *const *)data;
    if (iso_integrator_at(way->it, *t, y) != ISO_OK) way->failed = true;
}

/* y' = f(y) of the model, of which the method knows nothing: differences within the steps, both ways. A stiff contact
 * is followed while it relaxes, forwards only, and its torque c (w,n) has the rounding of w times c. */
static void differences(const effects_case *c, const iso_method *m, laws_worst *worst)
{
    if (idle(c)) return;
    static int variant;
    const orbit o = orbit_of(ctx, c, variant++);
    const bool stiff = effects_lambda(c) > 0;
    const double rate = iso_effects_stiffness(&c->model.problem);
    const double unit = orbit_stretch(c, &o) / (stiff ? rate : 1), bound = 1e-12 * (stiff ? rate : 1), forward = 1;
    course way = {orbit_start(&o, m, &finest), false}, *const data = &way;
    for (int i = stiff ? 1 : -2; i <= 3; i += 4) {
        const double t = 0.3 * i * unit;
        double y[ISO_MAX_STATE], f[ISO_MAX_STATE], slope[ISO_MAX_STATE], size[ISO_MAX_STATE];
        state_at(&data, &t, y);
        o.model.rhs(&o.model, y, f);
        iso_model_size(&o.model, y, size);
        if (stiff) size[effects_lambda(c)] += TWIST_RESISTANCE(&c->model.problem.effects) * norm(y) / rate;
        laws_slope(state_at, &data, o.model.dim, 1, &t, &forward, unit / 64, slope);
        for (int j = 0; j < o.model.dim; j++) {
            char name[64];
            snprintf(name, sizeof name, "y[%d]' in %s%s", j, iso_clock_name(o.model.clock), i < 0 ? ", back" : "");
            effects_note(c, worst, way.failed ? NAN : fabs(slope[j] - f[j]) * unit, bound * size[j], name);
        }
    }
    iso_integrator_free(way.it);
}

static void differences_double(const effects_case *c, laws_worst *worst)
{
    differences(c, taylor, worst);
}

static void differences_extended(const effects_case *c, laws_worst *worst)
{
    differences(c, extended, worst);
}

/* The same states as by rk8pd from the model's equations, and by long double. */
static void states(const effects_case *c, laws_worst *worst)
{
    if (idle(c) || effects_lambda(c) > 0) return;
    static int variant;
    const orbit o = orbit_of(ctx, c, variant++);
    const double t = 4 * orbit_stretch(c, &o) * (variant % 5 < 3 ? 1 : -1);
    double y[ISO_MAX_STATE], long_y[ISO_MAX_STATE], expected[ISO_MAX_STATE];
    orbit_solve(&o, taylor, &finest, t, y);
    orbit_solve(&o, extended, &finest, t, long_y);
    orbit_reference(&o, t, expected);
    effects_note(c, worst, orbit_error(&o, y, long_y), 1e-13, "long double");
    effects_note(c, worst, orbit_error(&o, y, expected), 1e-13, "rk8pd");
}

/* The order that the tolerance chooses: by how much the error falls when fixed steps are halved. */
static void check_order(const iso_method *m, const iso_system *system, iso_clock clock, double k, int order)
{
    enum { ORBITS = 64 };
    const bool neumann = k == -1 && clock == ISO_CLOCK_S;
    const int lowest = neumann ? 8 : 4; /* of tolerance 1: see order_for in form_impl.h */
    const int steps = order == 6 ? 96 : order == 10 ? (k == -1 ? 22 : 36) : 30; /* errors above rounding */
    const double finer = m == extended ? 1e4 : 1, length = 6;
    double logarithm[2] = {0, 0};
    for (int i = 0; i < ORBITS; i++) {
        orbit o = orbit_sample(ctx, system, k, orbit_J, 50 + (unsigned long)i);
        orbit_clocks(&o, clock, false, false, false);
        double y[ISO_MAX_STATE], expected[ISO_MAX_STATE];
        orbit_solve(&o, extended, &finest, length * o.unit, expected);
        for (int j = 0; j < 2; j++) {
            const double h = length * o.unit / (steps << j);
            const iso_method_options options = {.tolerance = finer * pow(10, (lowest - order) / 1.6),
                                                .fixed_step = h};
            orbit_solve(&o, m, &options, length * o.unit, y);
            logarithm[j] += log2(orbit_error(&o, y, expected)) / ORBITS;
        }
    }
    const double slope = logarithm[0] - logarithm[1];
    gsl_test(!(fabs(slope - order) < (order > 10 ? 1 : 0.4)),
             "%s, %s in %s, k = %g: order %d, measured %.2f from errors %.1e", m->name, system->name,
             iso_clock_name(clock), k, order, slope, exp2(logarithm[0]));
}

/* --- processors ------------------------------------------------------------------------------------------------- */

static void check_processors(void)
{
#if defined(__x86_64__) /* elsewhere the library has no code for AVX2 */
    const bool both = iso_taylor_has_avx2();
    const iso_method *avx2 = both ? &iso_taylor_avx2 : &iso_taylor_plain;
#else
    const bool both = false;
    const iso_method *avx2 = &iso_taylor_plain;
#endif
    if (!both) printf("no AVX2 here: only the plain code is tested\n");
    for (int i = 0; i < 2 * ORBIT_K; i++) {
        const orbit o = orbit_sample(ctx, iso_systems[i % 2], orbit_k[i / 2], orbit_J, 5 + (unsigned long)i);
        const double t = 10 * 2 * M_PI * o.unit;
        double y[3][ISO_MAX_STATE], expected[ISO_MAX_STATE];
        orbit_solve(&o, &iso_taylor_plain, &finest, t, y[0]);
        orbit_solve(&o, avx2, &finest, t, y[1]);
        orbit_solve(&o, taylor, &finest, t, y[2]);
        orbit_solve(&o, extended, &finest, t, expected);
        const double apart = orbit_error(&o, y[0], y[1]), wrong = orbit_error(&o, y[0], expected);
        gsl_test(!(apart < 3e-12 && wrong < 2e-12), "%s, k = %g: plain and avx2 apart by %.1e, wrong by %.1e",
                 o.model.system->name, orbit_k[i / 2], apart, wrong);
        gsl_test(memcmp(y[both], y[2], sizeof(double) * ISO_STATE) != 0, "the best code for the processor is taken");
    }
}

/* Long double against numbers of 128 bits, which round 2000 times less: what they differ by is the former's error. */
static void check_quad(void)
{
    const iso_method *quad = iso_method_find("taylor_quad");
    if (!quad) printf("no taylor_quad here: long double is tested against doubles alone\n");
    for (int i = 0; quad && i < 2 * ORBIT_K; i++) {
        const orbit o = orbit_sample(ctx, iso_systems[i % 2], orbit_k[i / 2], orbit_J, 70 + (unsigned long)i);
        double y[2][ISO_MAX_STATE];
        orbit_solve(&o, extended, &finest, 20 * o.unit, y[0]);
        orbit_solve(&o, quad, &(iso_method_options){.tolerance = i < ORBIT_K ? 1e-15 : 1e-6}, 20 * o.unit, y[1]);
        const double apart = orbit_error(&o, y[0], y[1]);
        gsl_test(!(apart < 5e-16), "%s, k = %g: 64 and 113 bits apart by %.1e", o.model.system->name, orbit_k[i / 2],
                 apart);
    }
}

/* --- long runs: states at t = 1000 are in orbit/reference, phases in hard_long --------------------------------------- */

/* The integral of that name, each radian of 10^4: how far it goes from its start, and the root mean square of that in
 * the last tenth beside the first. Of a ball: in t. A point: in either clock, and off the level H = 0 in s. */
static void check_second(const iso_system *system, double k, iso_clock clock, double stretch, const char *name,
                         unsigned long seed)
{
    enum { RADIANS = 10000, TENTH = RADIANS / 10 };
    const iso_integral *F = laws_integral(system, name);
    orbit o = orbit_sample(ctx, system, k, orbit_J, seed);
    double square[2] = {0, 0}, worst = 0, size;
    scale(o.y0, stretch);
    if (stretch != 1) o.model.problem.energy = system->energy(&o.model.problem, o.y0, &size);
    orbit_clocks(&o, clock, false, false, false);
    iso_integrator *it = orbit_start(&o, taylor, &finest);
    const double start = F->value(&o.model.problem, o.y0, &size);
    for (int i = 1; i <= RADIANS; i++) {
        double y[ISO_MAX_STATE] = {NAN};
        iso_integrator_at(it, i * o.unit, y);
        const double off = fabs(F->value(&o.model.problem, y, &size) - start) / size;
        worst = off <= worst ? worst : off;
        if (i <= TENTH) square[0] += off * off / TENTH;
        if (i > RADIANS - TENTH) square[1] += off * off / TENTH;
    }
    const double first = sqrt(square[0]), last = sqrt(square[1]);
    gsl_test(!(worst < 1e-14 && last < 1.5 * first + 1e-16),
             "%s, k = %g, %s, H = %.2g: %s keeps to %.1e, rms %.1e at first, %.1e at last", system->name, k,
             iso_clock_name(clock), o.model.problem.energy, name, worst, first, last);
    iso_integrator_free(it);
}

int main(void)
{
    ctx = iso_context_create();
    taylor = iso_method_find("taylor");
    extended = iso_method_find("taylor_extended");
    effects_hold("y' = f(y) by differences within the steps", NULL, 6, differences_double);
    effects_hold("the same in long double", NULL, 11, differences_extended);
    effects_hold("states as by rk8pd and by long double", NULL, 6, states);
    for (int order = 6; order <= 10; order += 4) {
        for (int i = 0; i < ORBIT_K; i++) {
            check_order(taylor, &iso_system_ball, ISO_CLOCK_T, orbit_k[i], order);
            /* for k > 0 the singularities of q near by hide the others; Neumann's problem has no order below 10 */
            if (order == 6 ? orbit_k[i] != -1 : orbit_k[i] < 0)
                check_order(taylor, &iso_system_point, ISO_CLOCK_S, orbit_k[i], order);
            if (orbit_k[i] != -1) check_order(taylor, &iso_system_point, ISO_CLOCK_T, orbit_k[i], order);
        }
    }
    check_order(extended, &iso_system_ball, ISO_CLOCK_T, 0.5, 12);
    check_processors();
    check_quad();
    for (int k = -1; k <= 1; k += 2) {
        const char *name = k == -1 ? "F_shell" : "F_plane";
        check_second(&iso_system_ball, k, ISO_CLOCK_T, 1, name, 3);
        check_second(&iso_system_point, k, ISO_CLOCK_T, 1, name, 3);
        check_second(&iso_system_point, k, ISO_CLOCK_S, 1, name, 3);
        check_second(&iso_system_point, k, ISO_CLOCK_S, 1.1, name, 3);
    }
    for (unsigned long seed = 7; seed <= 8; seed++) /* near a principal axis, where w hardly changes F */
        check_second(&iso_system_ball, -1, ISO_CLOCK_T, 1, "F_shell", seed);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

/* Events: known times, directions, none missed, none invented, for every
 * method. */
#include "orbits.h"

static iso_context *ctx;

/* --- event functions -------------------------------------------------------------------------------------------- */

/* factor * (y[component] - level)^power */
typedef struct level {
    int component, power;
    double level, factor;
} level;

static double g_level(const iso_model *m, const double y[], const void *data)
{
    const level *l = data;
    (void)m;
    return l->factor * pow(y[l->component] - l->level, l->power);
}

static const level n1 = {.component = 3, .power = 1, .factor = 1};

/* Low orders get a tolerance that they reach in 10^4 steps. */
static double tolerance_for(const iso_method *m)
{
    return m->order == 2 ? 1e-7 : m->order == 3 ? 1e-9 : 1e-10;
}

/* The error such orbits may have, see tests/method/test_order.c. */
static double allowed(const iso_method *m)
{
    return (m->order ? 300 : 1e4) * tolerance_for(m);
}

static iso_integrator *start(const orbit *o, const iso_method *m)
{
    return orbit_start(o, m, &(iso_method_options){.tolerance = tolerance_for(m)});
}

/* Finds one; the status is checked. */
static bool find(iso_integrator *it, const level *l, int direction, double from, double to, double *t, double y[])
{
    bool found = false;
    const iso_event event = {.g = g_level, .data = l, .direction = direction};
    const iso_status status = iso_integrator_event(it, &event, from, to, &found, t, y);
    gsl_test(status != ISO_OK, "search from %g to %g: %s", from, to, iso_context_message(ctx));
    return found;
}

/* --- the rotation, whose events are known: n1 = cos t ----------------------------------------------------------- */

/* Collects the events of the rotation up to `to` and compares them with first,
 * first + step, ... */
static void check_times(const char *what, const iso_method *m, const level *l, int direction, double to, double first,
                        double step)
{
    const orbit o = orbit_rotation(ctx, 1, 1);
    iso_integrator *it = start(&o, m);
    double from = 0, t, y[ISO_MAX_STATE], error = 0, residual = 0;
    int count = 0;
    while (count < 100 && find(it, l, direction, from, to, &t, y)) {
        error = fmax(error, fabs(t - (first + step * count++)));
        residual = fmax(residual, fabs(g_level(&o.model, y, l) / l->factor));
        from = t;
    }
    const int expected = (int)floor((to - first) / step) + 1;
    gsl_test(count != expected, "%s: %s: %d events, %d expected", m->name, what, count, expected);
    gsl_test(!(error <= allowed(m)), "%s: %s: times wrong by %.2g", m->name, what, error);
    gsl_test(!(residual <= 4e-15), "%s: %s: zero to %.2g", m->name, what, residual);
    iso_integrator_free(it);
}

static void check_rotation(const iso_method *m)
{
    const level tiny = {.component = 3, .power = 1, .factor = 1e-200},
                huge = {.component = 3, .power = 1, .factor = -1e200};
    const double pi = M_PI;
    check_times("upwards", m, &n1, 1, 20, 1.5 * pi, 2 * pi);
    check_times("downwards", m, &n1, -1, 20, 0.5 * pi, 2 * pi);
    check_times("both ways", m, &n1, 0, 20, 0.5 * pi, pi);
    check_times("upwards in growing time, seen backwards", m, &n1, 1, -20, -0.5 * pi, -2 * pi);
    check_times("downwards in growing time, seen backwards", m, &n1, -1, -20, -1.5 * pi, -2 * pi);
    check_times("backwards, both ways", m, &n1, 0, -20, -0.5 * pi, -pi);
    check_times("a tiny function", m, &tiny, 0, 20, 0.5 * pi, pi);
    check_times("a huge negative function", m, &huge, 1, 20, 0.5 * pi, 2 * pi);
}

/* Pairs of zeros 2 acos(c) apart about every maximum of n1 = cos t, the last
 * ones within 1/700 of a turn; and the levels that are not reached. */
static void check_tangents(const iso_method *m)
{
    const orbit o = orbit_rotation(ctx, 1, 1);
    const int deepest = m->projects ? 12 : 6;
    iso_integrator *it = start(&o, m);
    for (int digits = 1; digits <= deepest; digits++) {
        const double c = 1 - pow(10, -digits), apart = acos(c),
                     accuracy = allowed(m) + (m->projects ? 1e-16 : 1e-7) / sin(apart);
        level l = {.component = 3, .power = 1, .factor = 1, .level = c};
        double up = NAN, down = NAN, y[ISO_MAX_STATE];
        const bool one = find(it, &l, 0, 1, 10, &up, y), two = find(it, &l, 0, up + apart, 10, &down, y);
        gsl_test(!(one && fabs(up - 2 * M_PI + apart) < accuracy), "%s: up through 1 - 1e-%d at %.15g", m->name,
                 digits, up);
        gsl_test(!(two && fabs(down - 2 * M_PI - apart) < accuracy), "%s: and down at %.15g", m->name, down);
        gsl_test(!find(it, &l, -1, 1, 10, &down, y) || !(down > up), "%s: down only, not up", m->name);
        l.level = 1 + pow(10, -digits);
        gsl_test(find(it, &l, 0, 0, 10, &up, y), "%s: 1 + 1e-%d is not reached", m->name, digits);
        l.level = -l.level;
        gsl_test(find(it, &l, 0, 0, 10, &up, y), "%s: -1 - 1e-%d is not reached", m->name, digits);
    }
    iso_integrator_free(it);
}

/* Squares touch zero from one side, cubes pass it; n3 is 0 all the time. */
static void check_touching(const iso_method *m)
{
    const level above = {.component = 3, .power = 2, .factor = 1}, below = {.component = 3, .power = 2, .factor = -1},
                aside = {.component = 3, .power = 2, .factor = 1, .level = 0.3},
                always = {.component = 5, .power = 1, .factor = 1};
    const level cube = {.component = 3, .power = 3, .factor = 1};
    const orbit o = orbit_rotation(ctx, 1, 1);
    iso_integrator *it = start(&o, m);
    double t, y[ISO_MAX_STATE];
    gsl_test(find(it, &above, 0, 0, 20, &t, y), "%s: touching from above is no event", m->name);
    gsl_test(find(it, &below, 0, 0, -20, &t, y), "%s: touching from below is no event", m->name);
    gsl_test(find(it, &aside, 0, 0, 20, &t, y), "%s: touching 0.3 is no event", m->name);
    gsl_test(find(it, &always, 0, 0, 20, &t, y), "%s: being zero is no event", m->name);
    gsl_test(!(find(it, &cube, 0, 0, 20, &t, y) && fabs(t - M_PI / 2) < allowed(m)), "%s: passing without slope is",
             m->name);
    iso_integrator_free(it);
}

/* n2 = -sin t is 0 at the start; and events at the ends of the range. */
static void check_ends(const iso_method *m)
{
    const level n2 = {.component = 4, .power = 1, .factor = 1};
    const orbit o = orbit_rotation(ctx, 1, 1);
    iso_integrator *it = start(&o, m);
    double t = 0, t_to, y[ISO_MAX_STATE];
    gsl_test(!(find(it, &n2, 0, 0, 10, &t, y) && fabs(t - M_PI) < allowed(m)), "%s: a zero at the start is not found",
             m->name);
    gsl_test(!(find(it, &n2, 0, 0, -10, &t, y) && fabs(t + M_PI) < allowed(m)), "%s: nor backwards", m->name);
    find(it, &n2, 0, 0, 10, &t, y);
    gsl_test(!(find(it, &n2, 0, 0, t * (1 + 2e-15), &t_to, y) && fabs(t_to - t) <= 2e-15 * t),
             "%s: an event at the end of the range is", m->name);
    gsl_test(find(it, &n2, 0, 0, t * (1 - 1e-12), &t_to, y), "%s: and not one behind it", m->name);
    gsl_test(find(it, &n2, 0, t, t + 1, &t_to, y), "%s: nor again from there", m->name);
    gsl_test(find(it, &n2, 0, t, t, &t_to, y), "%s: an empty range holds none", m->name);
    iso_integrator_free(it);
}

/* A step that ends at a zero of g to the last bit, on the way down and on the
 * way up. */
static void check_exact_zero(const iso_method *m)
{
    static const double ends[] = {0.75, 5};
    const orbit o = orbit_rotation(ctx, 1, 1);
    iso_integrator *it = orbit_start(&o, m, &(iso_method_options){.fixed_step = 1.0 / 64});
    for (int i = 0; i < 2; i++) {
        level l = {.component = 3, .power = 1, .factor = 1};
        double t = NAN, y[ISO_MAX_STATE];
        gsl_test(iso_integrator_at(it, ends[i], y) != ISO_OK, "%s: reaches %g", m->name, ends[i]);
        l.level = y[3];
        gsl_test(!(find(it, &l, i == 0 ? -1 : 1, ends[i] - 0.4, ends[i] + 0.4, &t, y) && fabs(t - ends[i]) < 1e-6),
                 "%s: a zero at the end of a step", m->name);
        gsl_test(find(it, &l, 0, ends[i], ends[i] + 0.4, &t, y), "%s: and only once", m->name);
    }
    iso_integrator_free(it);
}

/* --- generic orbits --------------------------------------------------------------------------------------------- */

enum { MOST = 64, SAMPLES = 1000 };
#define WAY 20 /* units */

typedef struct crossing {
    double t;
    int direction;
} crossing;

/* Sign changes of l between samples of the orbit: every one that is longer than
 * a sample, and about where. */
static int dense_crossings(const orbit *o, const level *l, int sense, crossing list[MOST])
{
    iso_integrator *it = orbit_start(o, iso_method_find("rk8pd"), &(iso_method_options){.tolerance = 1e-13});
    double last = g_level(&o->model, o->y0, l);
    int count = 0;
    for (int i = 1; i <= SAMPLES && count < MOST; i++) {
        double y[ISO_MAX_STATE];
        iso_integrator_at(it, sense * WAY * o->unit * i / SAMPLES, y);
        const double g = g_level(&o->model, y, l);
        if ((g > 0) != (last > 0))
            list[count++] = (crossing){sense * WAY * o->unit * (i - 0.5) / SAMPLES, (g > 0 ? 1 : -1) * sense};
        last = g;
    }
    iso_integrator_free(it);
    return count;
}

static void check_orbit(const orbit *o, const iso_method *m, const level *l, int sense, int direction)
{
    crossing expected[MOST];
    int count = dense_crossings(o, l, sense, expected), wanted = 0, found = 0;
    iso_integrator *it = start(o, m);
    double t = 0, y[ISO_MAX_STATE], residual = 0, apart = 0;
    for (int i = 0; i < count; i++)
        if (direction == 0 || expected[i].direction == direction) expected[wanted++] = expected[i];
    while (found < MOST && find(it, l, direction, t, sense * WAY * o->unit, &t, y)) {
        residual = fmax(residual, fabs(g_level(&o->model, y, l)) / (1 + laws_norm(y)));
        if (found < wanted) apart = fmax(apart, fabs(t - expected[found].t) / o->unit);
        if (found % 2) iso_integrator_at(it, t + sense * o->unit / 3, y); /* changes nothing */
        found++;
    }
    gsl_test(found != wanted, "%s %s k=%g: %d events of %d", m->name, o->model.system->name, o->model.problem.p.k,
             found, wanted);
    gsl_test(!(apart < 0.51 * WAY / SAMPLES + 1e-4), "%s: where they are expected, within %.2g", m->name, apart);
    gsl_test(!(residual < 1e-14), "%s: zero to %.2g", m->name, residual);
    iso_integrator_free(it);
}

static void check_orbits(const iso_method *m)
{
    static const level levels[] = {{5, 1, 0, 1}, {3, 1, 0.4, -1e-200}, {0, 1, 0.1, 1}};
    for (int s = 0; iso_systems[s]; s++)
        for (int k = 0; k < ORBIT_K; k++) {
            if (!orbit_served(m, iso_systems[s])) continue;
            const orbit o = orbit_sample(ctx, iso_systems[s], orbit_k[k], orbit_J, 17 + (unsigned long)k);
            const int direction = (k + s) % 3 - 1;
            check_orbit(&o, m, &levels[k % 3], 1, direction);
            check_orbit(&o, m, &levels[(k + s) % 3], -1, direction);
        }
}

/* Every method finds the same times, at its tolerance. */
static void check_agreement(void)
{
    const orbit o = orbit_sample(ctx, &iso_system_ball, 1, orbit_J, 3);
    const level l = {.component = 5, .power = 1, .factor = 1};
    double reference[5], y[ISO_MAX_STATE], from = 0;
    iso_integrator *it = orbit_start(&o, iso_method_find("rk8pd"), &(iso_method_options){.tolerance = 1e-14});
    for (int i = 0; i < 5; from = reference[i++]) find(it, &l, 1, from, 1000, &reference[i], y);
    iso_integrator_free(it);
    for (int i = 0; iso_methods[i]; i++) {
        const iso_method *m = iso_methods[i];
        if (!orbit_served(m, o.model.system)) continue;
        double t = 0, worst = 0;
        it = start(&o, m);
        for (int e = 0; e < 5; e++) {
            find(it, &l, 1, t, 1000, &t, y);
            worst = fmax(worst, fabs(t - reference[e]));
        }
        gsl_test(!(worst < allowed(m)), "%s: five times to %.2g", m->name, worst);
        iso_integrator_free(it);
    }
}

/* --- refusals --------------------------------------------------------------------------------------------------- */

static double g_nan(const iso_model *m, const double y[], const void *data)
{
    (void)m, (void)data;
    return y[3] > 0.5 ? 1 : NAN;
}

static void check_refusals(void)
{
    static const double ranges[][2] = {{-1, 1},  {1, -1},  {2, 1},        {-2, -1},
                                       {NAN, 1}, {0, NAN}, {0, INFINITY}, {-INFINITY, 0}};
    const orbit o = orbit_rotation(ctx, 1, 1);
    iso_integrator *it = orbit_start(&o, iso_method_find("rk8pd"), &(iso_method_options){.tolerance = 1e-10});
    const iso_event event = {.g = g_level, .data = &n1}, bad = {.g = g_nan};
    double t = 7, y[ISO_MAX_STATE] = {7};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        bool found = true;
        const iso_status status = iso_integrator_event(it, &event, ranges[i][0], ranges[i][1], &found, &t, y);
        gsl_test(status != ISO_BAD_ARGUMENT || found || t != 7 || y[0] != 7, "range %g to %g refused: %s",
                 ranges[i][0], ranges[i][1], iso_context_message(ctx));
    }
    bool found = true;
    const iso_status status = iso_integrator_event(it, &bad, 0, 10, &found, &t, y);
    gsl_test(status != ISO_NUMERICAL || found, "a function that is not finite: %s", iso_context_message(ctx));
    gsl_test(!find(it, &n1, 0, 0, 10, &t, y), "and the integrator still works");
    iso_integrator_free(it);
}

int main(void)
{
    ctx = iso_context_create();
    for (int i = 0; iso_methods[i]; i++) {
        check_orbits(iso_methods[i]);
        if (!orbit_served(iso_methods[i], &iso_system_ball)) continue; /* the others know ball's orbits exactly */
        check_rotation(iso_methods[i]);
        check_tangents(iso_methods[i]);
        check_touching(iso_methods[i]);
        check_ends(iso_methods[i]);
        if (iso_methods[i]->fixed) check_exact_zero(iso_methods[i]);
    }
    check_agreement();
    check_refusals();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

/* What methods refuse: orbits that end, options that make no sense, names that
 * fit none or several. */
#include <sys/stat.h>
#include <unistd.h>

#include "method/methods_impl.h"
#include "orbits.h"

static iso_context *ctx;

/* --- a wall: beyond y[3] = n1 = WALL the equations of motion have no value -------------------------------------- */

#define WALL 0.2

static double beyond; /* NAN or INFINITY */

static void walled_rhs(const iso_model *m, const double y[], double dy[])
{
    m->system->rhs(&m->problem, y, dy);
    if (!(y[3] >= WALL)) dy[1] = beyond;
}

static double g_never(const iso_model *m, const double y[], const void *data)
{
    (void)m, (void)y, (void)data;
    return 1;
}

/* Both ways in time the orbit meets the wall after 1.37 radians. */
static orbit walled_orbit(const iso_system *system)
{
    orbit o = orbit_rotation(ctx, 1, 1);
    if (system == &iso_system_point) {
        const double eps = 1, q = orbit_J[0];
        o.model.system = system;
        o.model.problem.eps = eps;
        o.model.problem.energy = 0;
        o.y0[2] = sqrt(2 * eps / q);
        orbit_clocks(&o, ISO_CLOCK_S, false, false, false);
    }
    o.model.rhs = walled_rhs;
    return o;
}

static bool same(const double a[], const double b[])
{
    for (int i = 0; i < ISO_STATE; i++)
        if (a[i] != b[i]) return false;
    return true;
}

/* The time that a message of `m` tells as the last good one; NaN when it does
 * not read like one. */
static double told_time(const iso_method *m)
{
    const char *const message = iso_context_message(ctx), *const last = strstr(message, "last good ");
    if (strncmp(message, m->name, strlen(m->name)) != 0 || !last || !strchr(last, '=')) return NAN;
    return strtod(strchr(last, '=') + 1, NULL);
}

static void check_wall(const iso_system *system, const iso_method *m, int direction, double step)
{
    const orbit o = walled_orbit(system);
    const iso_method_options options = {.tolerance = 1e-7, .fixed_step = step * o.unit};
    const double behind = direction * 3 * o.unit, before = direction * o.unit / 2;
    iso_integrator *it = orbit_start(&o, m, &options);
    double y[ISO_MAX_STATE] = {7}, last[ISO_MAX_STATE], again[ISO_MAX_STATE], t, t_again;
    const iso_status status = iso_integrator_at(it, behind, y);
    gsl_test(status != ISO_NUMERICAL || y[0] != 7, "%s, %s: stops at the wall: %s", m->name, system->name,
             iso_context_message(ctx));
    iso_integrator_last(it, &t, last);
    gsl_test(!(fabs(told_time(m) - t) <= 1e-15 * fabs(t)), "%s: the message names it and the last good time",
             m->name);
    gsl_test(!(direction * t > 0), "%s: some way was made, to %g", m->name, t);
    gsl_test(!(last[3] > WALL - 0.02 && last[3] < 0.7), "%s: the last good state is at the wall, %g", m->name,
             last[3]);
    gsl_test(!isfinite(laws_max(ISO_STATE, last)), "%s: and finite", m->name);
    gsl_test(iso_integrator_at(it, behind, y) != ISO_NUMERICAL, "%s: asked again, stops again", m->name);
    iso_integrator_last(it, &t_again, again);
    gsl_test(!(t_again == t && same(last, again)), "%s: at the same place", m->name);
    gsl_test(iso_integrator_at(it, before, y) != ISO_OK, "%s: what lies before the wall can still be asked", m->name);
    orbit_solve(&o, m, &options, before, again);
    gsl_test(!same(y, again), "%s: and is the same", m->name);
    iso_integrator_free(it);
}

/* Methods with equations of their own do not meet walls that stand in the model's. */
static bool meets_walls(const iso_method *m)
{
    return !m->own_equations;
}

static void check_walls(void)
{
    for (int i = 0; iso_methods[i]; i++)
        for (int s = 0; iso_systems[s] && meets_walls(iso_methods[i]); s++)
            for (int direction = -1; direction <= 1; direction += 2) {
                beyond = direction > 0 ? NAN : INFINITY;
                check_wall(iso_systems[s], iso_methods[i], direction, 0);
                if (iso_methods[i]->fixed) check_wall(iso_systems[s], iso_methods[i], direction, 0.01);
            }
}

static void check_events_at_walls(void)
{
    const orbit o = walled_orbit(&iso_system_ball);
    const iso_event event = {.g = g_never};
    for (int i = 0; iso_methods[i]; i++) {
        if (!meets_walls(iso_methods[i])) continue;
        bool found = true;
        double t = 7, y[ISO_MAX_STATE] = {7};
        iso_integrator *it = orbit_start(&o, iso_methods[i], &(iso_method_options){.tolerance = 1e-7});
        const iso_status status = iso_integrator_event(it, &event, 0, 3, &found, &t, y);
        gsl_test(status != ISO_NUMERICAL || found || t != 7 || y[0] != 7, "%s: no event behind the wall",
                 iso_methods[i]->name);
        iso_integrator_free(it);
    }
}

/* --- equations that break off: no value anywhere after so many calls -------------------------------------------- */

static int calls_left;

static void mortal_rhs(const iso_model *m, const double y[], double dy[])
{
    m->system->rhs(&m->problem, y, dy);
    if (calls_left-- <= 0) dy[0] = beyond;
}

static orbit mortal_orbit(void)
{
    orbit o = orbit_rotation(ctx, 1, 1);
    o.model.rhs = mortal_rhs;
    calls_left = 1000;
    beyond = NAN;
    return o;
}

static void check_breaking_off(const iso_method *m)
{
    const orbit o = mortal_orbit();
    iso_integrator *it = orbit_start(&o, m, &(iso_method_options){.tolerance = 1e-7});
    double y[ISO_MAX_STATE], t;
    gsl_test(iso_integrator_at(it, 1000, y) != ISO_NUMERICAL, "%s", iso_context_message(ctx));
    iso_integrator_last(it, &t, y);
    gsl_test(!(t > 0 && fabs(norm(y + 3) - 1) < 1e-4), "%s: the last state is good", m->name);
    iso_integrator_free(it);
}

static void check_max_steps(const iso_method *m)
{
    enum { MOST = 7 };
    const orbit o = m->system ? orbit_sample(ctx, m->system, 1, orbit_J, 3) : orbit_rotation(ctx, 1, 1);
    iso_integrator *it = orbit_start(&o, m, &(iso_method_options){.tolerance = 1e-9, .max_steps = MOST});
    double y[ISO_MAX_STATE], last[ISO_MAX_STATE], t;
    const iso_status status = iso_integrator_at(it, 1000, y);
    iso_integrator_last(it, &t, last);
    gsl_test(status != ISO_NUMERICAL, "%s: %s", m->name, iso_context_message(ctx));
    gsl_test(iso_integrator_statistics(it).steps != MOST, "%s: takes all the steps it may", m->name);
    gsl_test(iso_integrator_at(it, t * 0.999, y) != ISO_OK, "%s: the way made can be asked", m->name);
    gsl_test(!(t > 0 && fabs(norm(last + 3) - 1) < 1e-6), "%s: the last state is good", m->name);
    iso_integrator_free(it);
}

/* --- options and times ------------------------------------------------------------------------------------------ */

static void refused(const char *what, const iso_method *m, const iso_method_options *options)
{
    const orbit o = orbit_rotation(ctx, 1, 1);
    iso_integrator *it = (iso_integrator *)&beyond; /* must become NULL */
    const iso_status status = iso_integrator_create(ctx, m, &o.model, options, &it);
    gsl_test(status != ISO_BAD_ARGUMENT || it, "%s is refused: %s", what, iso_context_message(ctx));
}

/* References: methods with more digits than a double, one after the other, and witnesses by their places. */
static void check_references(void)
{
    int digits = ISO_DOUBLE_DIGITS, finer = 0, witnesses = 0;
    for (const iso_method *m; (m = iso_method_with_more_digits(digits)); digits = m->digits, finer++)
        gsl_test(!(m->digits > digits), "%s has %d digits", m->name, m->digits);
    for (int i = 0; iso_methods[i]; i++) {
        finer -= iso_methods[i]->digits > ISO_DOUBLE_DIGITS;
        witnesses += iso_methods[i]->witness > 0;
    }
    gsl_test(finer != 0, "each method of more digits is met once: %d too many", finer);
    for (int place = 1; place <= witnesses; place++)
        gsl_test(!iso_method_witness(place), "witness %d of %d", place, witnesses);
    gsl_test(iso_method_witness(witnesses + 1) || iso_method_witness(0), "and no other");
}

static void check_options(void)
{
    const iso_method *const adams = iso_method_find("adams"), *const rk4 = iso_method_find("rk4");
    refused("tolerance 0", adams, &(iso_method_options){.tolerance = 0});
    refused("tolerance NaN", rk4, &(iso_method_options){.tolerance = NAN});
    refused("tolerance 1", adams, &(iso_method_options){.tolerance = 1});
    refused("tolerance -1e-9", adams, &(iso_method_options){.tolerance = -1e-9});
    refused("tolerance 1e-16", rk4, &(iso_method_options){.tolerance = 1e-16});
    refused("tolerance 1 with fixed steps", rk4, &(iso_method_options){.tolerance = 1, .fixed_step = 0.1});
    refused("a negative step", rk4, &(iso_method_options){.tolerance = 1e-9, .fixed_step = -0.1});
    refused("a step NaN", rk4, &(iso_method_options){.tolerance = 1e-9, .fixed_step = NAN});
    refused("an infinite step", rk4, &(iso_method_options){.tolerance = 1e-9, .fixed_step = INFINITY});
    refused("no method", NULL, &(iso_method_options){.tolerance = 1e-9});
    for (int i = 0; iso_methods[i]; i++)
        if (!iso_methods[i]->fixed)
            refused(iso_methods[i]->name, iso_methods[i],
                    &(iso_method_options){.tolerance = 1e-9, .fixed_step = 0.1});
}

static void check_times(void)
{
    static const double times[] = {NAN, INFINITY, -INFINITY};
    const orbit o = orbit_rotation(ctx, 1, 1);
    iso_integrator *it = orbit_start(&o, iso_method_find("rk8pd"), &(iso_method_options){.tolerance = 1e-9});
    double y[ISO_MAX_STATE], bad[ISO_MAX_STATE] = {0};
    for (int i = 0; i < 3; i++)
        gsl_test(iso_integrator_at(it, times[i], y) != ISO_BAD_ARGUMENT, "time %g is refused", times[i]);
    gsl_test(iso_integrator_start(it, bad) != ISO_BAD_ARGUMENT, "n = 0 is no state to start from");
    copy(o.y0, bad, ISO_STATE);
    bad[4] = NAN;
    gsl_test(iso_integrator_start(it, bad) != ISO_BAD_ARGUMENT, "nor one with NaN: %s", iso_context_message(ctx));
    gsl_test(iso_integrator_start(it, o.y0) != ISO_OK || iso_integrator_at(it, 1, y) != ISO_OK,
             "a good one after it is");
    iso_integrator_free(it);
    iso_integrator_free(NULL);
}

/* --- silence ---------------------------------------------------------------------------------------------------- */

/* Everything that fails, without a word of our own. */
static void fail_quietly(void)
{
    const orbit o = walled_orbit(&iso_system_ball), good = orbit_rotation(ctx, 1, 1);
    double y[ISO_MAX_STATE];
    for (int i = 0; iso_methods[i]; i++) {
        if (!meets_walls(iso_methods[i])) continue;
        const orbit mortal = mortal_orbit();
        orbit_solve(&mortal, iso_methods[i], &(iso_method_options){.tolerance = 1e-7}, 1000, y);
        for (int kind = 0; kind < 4; kind++) {
            const bool low = iso_methods[i]->order && iso_methods[i]->order < 5; /* not for 10^7 steps */
            const iso_method_options options = {.tolerance = kind == 1 && !low ? 1e-15 : 1e-6,
                                                .max_steps = kind == 2 ? 3 : 0};
            iso_integrator *it;
            if (iso_integrator_create(ctx, iso_methods[i], kind == 2 ? &good.model : &o.model, &options, &it) !=
                ISO_OK)
                continue;
            beyond = kind == 3 ? INFINITY : NAN;
            if (iso_integrator_start(it, o.y0) == ISO_OK) iso_integrator_at(it, kind == 3 ? -3 : 3, y);
            iso_integrator_free(it);
        }
    }
}

static void check_silence(void)
{
    fflush(NULL);
    FILE *const caught = tmpfile();
    const int out = dup(STDOUT_FILENO), err = dup(STDERR_FILENO);
    if (!caught || out < 0 || err < 0) {
        gsl_test(1, "no temporary file");
        return;
    }
    dup2(fileno(caught), STDOUT_FILENO);
    dup2(fileno(caught), STDERR_FILENO);
    fail_quietly();
    fflush(NULL);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    close(out);
    close(err);
    struct stat s = {0};
    const int unknown = fstat(fileno(caught), &s);
    fclose(caught);
    gsl_test(unknown || s.st_size != 0, "failures print nothing: %ld characters", (long)s.st_size);
}

/* --- names ------------------------------------------------------------------------------------------------------ */

static void check_names(void)
{
    static const char *const names[][2] = {/* NULL: none, or more than one */
                                           {"rk8pd", "rk8pd"},
                                           {"RK8PD", "rk8pd"},
                                           {"gsl-rk8pd", "rk8pd"},
                                           {"GSL_Rk8pd", "rk8pd"},
                                           {"cvode_adams", "adams"},
                                           {"CVODE-ADAMS", "adams"},
                                           {"Adams", "adams"},
                                           {"ada", "adams"},
                                           {"bdf", "bdf"},
                                           {"rk4", "rk4"},
                                           {"rk8", "rk8pd"},
                                           {"dormand-prince", "dormand_prince_7_4_5"},
                                           {"verner", "verner_8_5_6"},
                                           {"gsl-msa", "msadams"},
                                           {"arkode-verner-8-5-6", "verner_8_5_6"},
                                           {"msb", "msbdf"},
                                           {"fehlberg_1", "fehlberg_13_7_8"},
                                           {"", NULL},
                                           {"rk", NULL},
                                           {"fehlberg", NULL},
                                           {"ark548l2sa", NULL},
                                           {"gsl-", NULL},
                                           {"gsl_adams", NULL},
                                           {"arkode-rk4", NULL},
                                           {"rk8pdx", NULL},
                                           {"x", NULL},
                                           {"-", NULL},
                                           {"_", NULL},
                                           {" rk4", NULL},
                                           {"gsl", NULL},
                                           {"gsl-gsl-rk4", NULL},
                                           {"m", NULL}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const iso_method *m = iso_method_find(names[i][0]);
        gsl_test(!(names[i][1] ? m && strcmp(m->name, names[i][1]) == 0 : !m), "'%s' is %s, expected %s", names[i][0],
                 m ? m->name : "nothing", names[i][1] ? names[i][1] : "nothing");
    }
    for (int i = 0; iso_methods[i]; i++) {
        const iso_method *m = iso_methods[i];
        gsl_test(!(m->name && m->name[0] && m->family && m->family[0] && m->doc && m->doc[0]),
                 "row %d says what it is", i);
        gsl_test(!(m->create && m->start && m->step && m->free), "%s is complete", m->name);
        gsl_test(iso_method_find(m->name) != m, "%s is found by its name", m->name);
        for (int j = 0; j < i; j++) gsl_test(strcmp(m->name, iso_methods[j]->name) == 0, "%s: one row", m->name);
    }
}

/* What "auto" is for a system at this k, with this resistance to twisting (0: none). */
static void check_auto(const iso_system *system, double k, double resistance, const char *wanted)
{
    iso_problem f = {.p = laws_params(k, orbit_J),
                     .effects = {.on[ISO_TWIST] = resistance > 0, .number[ISO_TWIST] = {resistance}}};
    f.p.D = 0.5;
    const iso_model m = iso_model_assemble(system, &f, system->clock, (const bool[ISO_CLOCKS]){false});
    gsl_test_str(iso_method_auto(&m)->name, wanted, "auto: %s, k = %g, c = %g", system->name, k, resistance);
}

/* Where the series would overflow, and where the model is stiff, it is another method. */
static void check_choices(void)
{
    for (int i = 0; i < ORBIT_K; i++) {
        check_auto(&iso_system_ball, orbit_k[i], 0, "taylor");
        check_auto(&iso_system_point, orbit_k[i], 0, "taylor");
    }
    check_auto(&iso_system_ball, 0.03, 0, "taylor");
    check_auto(&iso_system_point, 0.04, 0, "taylor"); /* (3/1.4)^(1/k) = 1.9e8 ... */
    check_auto(&iso_system_point, 0.03, 0, "rk8pd");  /* ... and 1.1e11         */
    check_auto(&iso_system_point, -0.03, 0, "rk8pd");
    check_auto(&iso_system_ball, 1e7, 0, "taylor");
    check_auto(&iso_system_point, -1e7, 0, "taylor");
    check_auto(&iso_system_ball, -1, 10, "taylor");
    check_auto(&iso_system_ball, -1, 1e2, "bsimp");
    check_auto(&iso_system_ball, -1, 1e4, "bdf");
}

int main(void)
{
    ctx = iso_context_create();
    check_walls();
    check_events_at_walls();
    for (int i = 0; iso_methods[i]; i++) {
        if (meets_walls(iso_methods[i])) check_breaking_off(iso_methods[i]);
        check_max_steps(iso_methods[i]);
    }
    check_references();
    check_options();
    check_times();
    check_silence();
    check_names();
    check_choices();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

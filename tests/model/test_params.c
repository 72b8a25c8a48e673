/* Parameters: what is accepted and what it gives, what is refused and about which quantity, the ball's own units. */
#include "laws.h"

static iso_context *ctx;

static const iso_body solid = {1.5, 0.25, {0.02, 0.03, 0.04}, ISO_PLANE, 0};

static iso_body on(iso_surface surface, double A, double B)
{
    iso_body b = solid;
    b.surface = surface, b.surface_radius = A, b.radius = B;
    return b;
}

/* Theory, section 1. */
static void surfaces_give_k(void)
{
    static const struct {
        iso_surface surface;
        double A, B, k;
    } row[] = {{ISO_PLANE, 0, 0.25, 1},
               {ISO_PLANE, NAN, 3, 1},
               {ISO_OUTSIDE, 2, 2, 0.5},
               {ISO_OUTSIDE, 3, 1, 0.75},
               {ISO_OUTSIDE, 1, 19, 0.05},
               {ISO_INSIDE, 3, 1, 1.5},
               {ISO_INSIDE, 4, 3, 4},
               {ISO_INSIDE, 50, 49, 50},
               {ISO_SHELL, 1, 2, -1},
               {ISO_SHELL, 2, 7, -0.4},
               {ISO_SHELL, 2, 3, -2},
               {ISO_SHELL, 1, 21, -0.05},
               {ISO_OUTSIDE, 1e-3, 1, 1 / 1001.0},
               {ISO_INSIDE, 1, DBL_EPSILON, 1 + DBL_EPSILON}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        iso_params p;
        const iso_body b = on(row[i].surface, row[i].A, row[i].B);
        const iso_status status = iso_params_physical(ctx, &b, &p);
        gsl_test(status != ISO_OK, "%s A=%g B=%g accepted", iso_surface_name((int)row[i].surface), row[i].A,
                 row[i].B);
        gsl_test_rel(p.k, row[i].k, 2 * DBL_EPSILON, "k of %s A=%g B=%g", iso_surface_name((int)row[i].surface),
                     row[i].A, row[i].B);
        for (int j = 0; j < 3; j++)
            gsl_test_rel(p.J[j], b.inertia[j] + b.mass * b.radius * b.radius, 2 * DBL_EPSILON, "J = I + m B^2");
        gsl_test(p.body.surface != row[i].surface || p.body.mass != b.mass, "the body is kept");
    }
}

static void derived_numbers(const iso_params *p)
{
    for (int j = 0; j < 3; j++) {
        gsl_test_rel(p->inv_J[j] * p->J[j], 1, DBL_EPSILON, "1/J%d", j + 1);
        gsl_test_rel(p->root_J[j] * p->root_J[j], p->J[j], 2 * DBL_EPSILON, "sqrt J%d", j + 1);
    }
    gsl_test_rel(p->det_J, p->J[0] * p->J[1] * p->J[2], 2 * DBL_EPSILON, "det J");
}

static void reduced(void)
{
    /* no solid body's, and not sorted */
    const iso_params p = laws_params(-0.4, (const double[3]){50, 1, 2});
    gsl_test(p.k != -0.4 || p.J[0] != 50 || p.J[1] != 1 || p.J[2] != 2, "reduced numbers are kept as they are");
    gsl_test(p.body.surface != ISO_REDUCED, "reduced has no body");
    derived_numbers(&p);
    iso_params flat, q;
    iso_body b = solid;
    memcpy(b.inertia, (double[3]){0.1, 0.2, 0.30000000000000004}, sizeof b.inertia);
    gsl_test(iso_params_physical(ctx, &b, &flat) != ISO_OK, "a flat body, I3 = I1 + I2 to rounding, is accepted");
    derived_numbers(&flat);
    b.inertia[2] = 0.3 * (1 + 1e-13);
    gsl_test(iso_params_physical(ctx, &b, &q) == ISO_OK, "more than rounding above I1 + I2 is not");
}

static void refuse(iso_status status, const char *field, const char *what)
{
    gsl_test(status != ISO_BAD_INPUT || strcmp(iso_context_about(ctx), field) != 0, "%s: refused about '%s' (%s)",
             what, field, status == ISO_OK ? "accepted" : iso_context_about(ctx));
    gsl_test(strlen(iso_context_message(ctx)) < 20 || strchr(iso_context_message(ctx), '\n'), "%s: says why", what);
}

static void reduced_refusals(void)
{
    static const double bad[] = {0, -0.0, NAN, INFINITY, -INFINITY, DBL_TRUE_MIN, DBL_MIN / 2};
    const double J[3] = {1, 2, 3};
    iso_params p;
    char what[64];
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        snprintf(what, sizeof what, "k = %g", bad[i]);
        refuse(iso_params_reduced(ctx, bad[i], J, &p), "k", what);
        for (int j = 0; j < 3; j++) {
            double worse[3] = {1, 2, 3};
            worse[j] = bad[i];
            snprintf(what, sizeof what, "J%d = %g", j + 1, bad[i]);
            refuse(iso_params_reduced(ctx, 1, worse, &p), "J", what);
            worse[j] = -1;
            refuse(iso_params_reduced(ctx, 1, worse, &p), "J", "J = -1");
        }
    }
}

static void physical_refusals(void)
{
    static const double bad[] = {0, -1, NAN, INFINITY, -INFINITY, DBL_TRUE_MIN};
    char what[64];
    iso_params p;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        iso_body mass = solid, radius = solid, surface = on(ISO_OUTSIDE, bad[i], 1);
        mass.mass = radius.radius = bad[i];
        snprintf(what, sizeof what, "%g", bad[i]);
        refuse(iso_params_physical(ctx, &mass, &p), "mass", what);
        refuse(iso_params_physical(ctx, &radius, &p), "radius", what);
        for (surface.surface = ISO_OUTSIDE; surface.surface <= ISO_SHELL; surface.surface++)
            refuse(iso_params_physical(ctx, &surface, &p), "surface_radius", what);
        for (int j = 0; j < 3; j++) {
            iso_body inertia = solid;
            inertia.inertia[j] = bad[i];
            refuse(iso_params_physical(ctx, &inertia, &p), "inertia", what);
        }
    }
}

static void impossible_bodies(void)
{
    iso_params p;
    for (int j = 0; j < 3; j++) {
        iso_body b = solid;
        b.inertia[j] = 0.1;
        refuse(iso_params_physical(ctx, &b, &p), "inertia", "triangle inequality");
    }
    const iso_body fits[] = {on(ISO_INSIDE, 1, 1), on(ISO_SHELL, 1, 1), on(ISO_INSIDE, 1, 2), on(ISO_SHELL, 2, 1)};
    for (size_t i = 0; i < sizeof fits / sizeof *fits; i++)
        refuse(iso_params_physical(ctx, &fits[i], &p), "surface_radius", "ball and surface do not fit");
    iso_body b = on(ISO_OUTSIDE, 1e-200, 1e200);
    b.mass = 1e-300;
    refuse(iso_params_physical(ctx, &b, &p), "surface_radius", "k underflows");
    b = on(ISO_PLANE, 0, 1e200);
    refuse(iso_params_physical(ctx, &b, &p), "mass", "m B^2 overflows");
}

static bool power_of_two(double x)
{
    int exponent;
    return x > 0 && isfinite(x) && frexp(x, &exponent) == 0.5;
}

static void note_unit(const iso_units *u, iso_dimension d, laws_worst *worst, const char *name)
{
    const double J = log2(u->J), w = log2(u->w), J_2k = d.J_2k / (2 * u->own.k);
    const double expected = (d.J + J_2k) * J + d.w * w, unit = iso_unit(u, d);
    const double terms = fabs(d.J * J) + fabs(J_2k * J) + fabs(d.w * w);
    if (expected > 1024.5) laws_note(worst, isinf(unit) ? 0 : 1, 0.5, &u->own, name);
    if (fabs(expected) > 1021) return; /* at the ends of the range, or past them */
    laws_note(worst, fabs(log2(unit) - expected), 4 * DBL_EPSILON * (1 + terms), &u->own, name);
}

static void note_choice(const iso_params *p, double speed, laws_worst *choice, laws_worst *units)
{
    iso_units u;
    iso_units_choose(p, speed, &u);
    laws_note(choice, power_of_two(u.J) && power_of_two(u.w) ? 0 : 1, 0.5, p, "powers of two");
    for (int j = 0; j < 3; j++) laws_note(choice, fabs(u.own.J[j] * u.J / p->J[j] - 1), DBL_TRUE_MIN, p, "J back");
    const double mean = cbrt(u.own.J[0]) * cbrt(u.own.J[1]) * cbrt(u.own.J[2]);
    laws_note(choice, fabs(log2(mean)), 0.5 + 1e-12, p, "J of order one");
    laws_note(choice, fabs(u.own.det_J / (u.own.J[0] * u.own.J[1] * u.own.J[2]) - 1), DBL_EPSILON, p, "det J");
    laws_note(choice, u.own.k == p->k ? 0 : 1, 0.5, p, "k");
    if (speed > 0) laws_note(choice, speed / u.w >= 1 && speed / u.w < 2 ? 0 : 1, 0.5, p, "speed of order one");
    note_unit(&u, iso_dimension_h, units, "h");
    note_unit(&u, iso_dimension_eps, units, "eps");
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) note_unit(&u, iso_clock_dimension(c), units, iso_clock_name(c));
    for (int s = 0; iso_systems[s]; s++) {
        note_unit(&u, iso_systems[s]->fast_dimension, units, iso_systems[s]->state[0]);
        for (const iso_integral *i = iso_systems[s]->integrals; i->name; i++)
            note_unit(&u, i->dimension, units, i->name);
    }
}

static void own_units(void)
{
    laws_worst choice = {0}, units = {0};
    for (int i = 0; i < LAWS_K; i++)
        for (int j = 0; j < LAWS_J; j++)
            for (int size = -30; size <= 30; size += 5)
                for (int speed = -150; speed <= 150; speed += 25) {
                    double J[3];
                    for (int l = 0; l < 3; l++) J[l] = laws_J[j][l] * pow(10, size);
                    const iso_params p = laws_params(laws_k[i], J);
                    note_choice(&p, pow(10, speed), &choice, &units);
                    if (speed == 0) note_choice(&p, 0, &choice, &units);
                }
    laws_report(&choice, "own units are powers of two that make J and speed of order one");
    laws_report(&units, "iso_unit against the power it stands for");
}

/* Every quantity scales as its dimension says: the same orbit in units of 2^9 and 2^-7. */
static void scaled(const laws_case *c, laws_case *big, iso_units *u)
{
    double J[3];
    *big = *c;
    for (int i = 0; i < 3; i++) J[i] = ldexp(c->problem.p.J[i], 9);
    big->problem.p = laws_params(c->problem.p.k, J);
    u->own = c->problem.p, u->J = ldexp(1, 9), u->w = ldexp(1, -7);
    scale(big->y, iso_unit(u, c->system->fast_dimension));
    big->problem.eps *= iso_unit(u, iso_dimension_eps);
    big->problem.energy *= iso_unit(u, c->system->integrals[0].dimension);
}

static void dimensions(const laws_case *c, laws_worst *worst)
{
    laws_case big;
    iso_units u;
    double f[ISO_STATE], big_f[ISO_STATE];
    const iso_params *p = &c->problem.p;
    scaled(c, &big, &u);
    for (const iso_integral *i = c->system->integrals; i->name; i++) {
        if (i->holds && !i->holds(&c->problem))
            continue; /* F_plane's and F_shell's dimensions are those at their k */
        double size, big_size;
        const double value = i->value(&c->problem, c->y, &size), unit = iso_unit(&u, i->dimension);
        const double big_value = i->value(&big.problem, big.y, &big_size);
        laws_note(worst, fabs(big_value / unit - value), 4 * laws_rounding(p) * size, p, i->name);
        laws_note(worst, fabs(big_size / unit - size), 4 * laws_rounding(p) * size, p, i->name);
    }
    c->system->rhs(&c->problem, c->y, f);
    c->system->rhs(&big.problem, big.y, big_f);
    const double fast = iso_unit(&u, c->system->fast_dimension);
    const double clock = iso_unit(&u, iso_clock_dimension(c->system->clock));
    for (int i = 0; i < ISO_STATE; i++)
        laws_note(worst, fabs(big_f[i] * clock / (i < 3 ? fast : 1) - f[i]), 8 * laws_rounding(p) * laws_max(6, f), p,
                  c->system->state[i]);
    for (iso_clock i = 0; i < ISO_CLOCKS; i++) {
        const double rate = iso_clock_rate(p, i, c->system->q(p, c->y, NULL), NULL);
        const double big_rate = iso_clock_rate(&big.problem.p, i, big.system->q(&big.problem.p, big.y, NULL), NULL);
        const double unit = iso_unit(&u, iso_clock_dimension(i)) / iso_unit(&u, iso_clock_dimension(ISO_CLOCK_T));
        laws_note(worst, fabs(big_rate / unit / rate - 1), 8 * laws_rounding(p), p, iso_clock_name(i));
    }
}

int main(void)
{
    ctx = iso_context_create();
    surfaces_give_k();
    reduced();
    reduced_refusals();
    physical_refusals();
    impossible_bodies();
    own_units();
    laws_hold("dimensions of integrals, equations and clocks", NULL, dimensions);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

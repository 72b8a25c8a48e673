/* Effects that a scene writes against the same effects compiled: field and level as a potential; gravity, rolling
 * resistance and rotor as a torque. By every method that takes them, on both models, in reduced and in physical units.
 * Steps are fixed and long, and no energy is restored. So methods of low order have large errors, and both ways of
 * writing an effect must have the same ones: then their orders are the same too. */
#include "laws.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "numbers.h"
#include "orbit/crossings.h"
#include "orbit/orbit_impl.h"

static iso_context *ctx;

typedef struct pair {
    const char *name;
    iso_params p;
    iso_start start;
    iso_effects compiled, written;
    double time;
} pair;

static void write(iso_effects *e, const char *effect, const char *name, const char *text)
{
    laws_stop_if(ctx, iso_effects_write(ctx, e, effect, name, text) != ISO_OK, text);
}

static void set(iso_effects *e, const char *effect, const char *name, int count, const double x[])
{
    laws_stop_if(ctx, iso_effects_set(ctx, e, effect, name, count, x) != ISO_OK, name);
}

static void write_torque(iso_effects *e, const char *M1, const char *M2, const char *M3)
{
    write(e, "torque", "M1", M1);
    write(e, "torque", "M2", M2);
    write(e, "torque", "M3", M3);
}

/* A reduced ball, or one in g, mm and s: its numbers are far from one. */
static pair ball(const char *name, bool physical, double k)
{
    pair c = {.name = name, .compiled = iso_effects_default(), .written = iso_effects_default(), .time = 5};
    double omega[3] = {0.9, -0.3, -0.225};
    const double n[3] = {0.36, 0.48, 0.8}, J[3] = {1.4, 2.1, 3};
    const iso_body body = {.mass = 6800,
                           .radius = 109.2,
                           .inertia = {2.7e7, 2.74e7, 2.83e7},
                           .surface = ISO_SHELL,
                           .surface_radius = 54.6};
    if (physical) {
        laws_stop_if(ctx, iso_params_physical(ctx, &body, &c.p) != ISO_OK, "a body");
        scale(omega, 7), c.time /= 7;
    } else {
        laws_stop_if(ctx, iso_params_reduced(ctx, k, J, &c.p) != ISO_OK, "a ball");
    }
    laws_stop_if(ctx, iso_start_ball(ctx, omega, n, ISO_SPIN_REMOVE, &c.start) != ISO_OK, "a start");
    return c;
}

/* The energy of the start's order, in the units of the ball. */
static double energy_of(const pair *c)
{
    return dot_diag(c->start.y, c->p.J, c->start.y) / 2;
}

static pair field(bool physical, double k)
{
    pair c = ball("field", physical, k);
    const double h = energy_of(&c), C[9] = {0.3 * h, 0.1 * h, 0, 0.1 * h, -0.2 * h, 0.05 * h, 0, 0.05 * h, 0.1 * h};
    const double l[3] = {0.1 * h, -0.2 * h, 0.3 * h};
    set(&c.compiled, "field", "quadratic", 9, C);
    set(&c.compiled, "field", "linear", 3, l);
    set(&c.written, "potential", "h", 1, &h);
    write(&c.written, "potential", "U",
          "h*(0.15*n1^2 - n2*n2/10 + 0.1*n1*n2 + (n2 + n3)*n3/20 + (n1 - 2*n2 + 3*n3)/10)");
    return c;
}

static pair level(bool physical, double k)
{
    pair c = ball("level", physical, k);
    const double g = dot_diag(c.start.y + 3, c.p.inv_J, c.start.y + 3),
                 size = 0.2 * energy_of(&c) * pow(g, 1 / c.p.k);
    set(&c.compiled, "level", "c", 1, &size);
    set(&c.written, "potential", "c", 1, &size);
    write(&c.written, "potential", "U", "-c*(n1^2/J1 + n2^2/J2 + n3^2/J3)^(-1/k)");
    return c;
}

static pair weight(bool physical, double k)
{
    pair c = ball("gravity", physical, k);
    const double mgb = 0.3 * energy_of(&c), none = 0, up[3] = {0, 0.6, 0.8};
    set(&c.compiled, "gravity", "mgb", 1, &mgb);
    set(&c.compiled, "gravity", "up", 3, up);
    set(&c.written, "gravity", "mgb", 1, &none);
    set(&c.written, "gravity", "up", 3, up);
    set(&c.written, "torque", "m", 1, &mgb);
    write_torque(&c.written, "m*(e2*n3 - e3*n2)", "m*(e3*n1 - e1*n3)", "m*(e1*n2 - e2*n1)");
    return c;
}

static pair friction(bool physical, double k)
{
    pair c = ball("rolling_resistance", physical, k);
    const double r = 0.1 * energy_of(&c) / norm(c.start.y);
    set(&c.compiled, "rolling_resistance", "coefficient", 1, &r);
    set(&c.written, "torque", "r", 1, &r);
    write_torque(&c.written, "-r*omega1", "-r*omega2", "-r*omega3");
    return c;
}

static pair rotor(bool physical, double k)
{
    pair c = ball("rotor", physical, k);
    const double L = energy_of(&c) / norm(c.start.y), K[3] = {0.3 * L, 0.4 * L, 0.5 * L};
    set(&c.compiled, "rotor", "momentum", 3, K);
    set(&c.written, "torque", "L", 1, &L);
    write_torque(&c.written, "L*(0.4*omega3 - omega2/2)", "L*(omega1/2 - 0.3*omega3)", "L*(0.3*omega2 - 0.4*omega1)");
    return c;
}

/* The state after 5 own units of time, by 250 fixed steps where the method takes them; false: it does not take the
 * model.
 */
static bool state_of(const pair *c, const iso_effects *effects, iso_backend backend, const iso_method *method,
                     double y[])
{
    iso_orbit_options o = iso_orbit_defaults(&c->start);
    iso_orbit *orbit;
    iso_integrator *it;
    iso_sample begin;
    o.backend = backend;
    o.effects = effects;
    if (backend == ISO_BACKEND_POINT) o.clock = ISO_CLOCK_S, o.shown = ISO_SHOW_BOTH;
    laws_stop_if(ctx, iso_orbit_create(ctx, &c->p, &c->start, &o, &orbit) != ISO_OK, c->name);
    laws_stop_if(ctx, iso_orbit_at(orbit, 0, &begin) != ISO_OK, c->name);
    const iso_model *m = iso_orbit_model(orbit);
    const iso_method_options options = {
        .tolerance = 1e-13, .fixed_step = method->fixed ? 0.02 : 0, .no_projection = true};
    bool found = iso_integrator_create(ctx, method, m, &options, &it) == ISO_OK;
    if (found) {
        iso_orbit_state_of(orbit, m->system, &begin, y);
        found = iso_integrator_start(it, y) == ISO_OK && iso_integrator_at(it, 5, y) == ISO_OK;
        iso_integrator_free(it);
    }
    iso_orbit_free(orbit);
    return found;
}

/* The same fixed steps give the same to rounding; what chooses its steps by its errors, to its tolerance. */
static void by_all_methods(const pair *c, iso_backend backend)
{
    int taken = 0;
    for (int i = 0; iso_methods[i]; i++) {
        const iso_method *m = iso_methods[i];
        const double bound = m->implicit ? 1e-8 : m->fixed ? 1e-13 : 1e-11;
        double a[ISO_MAX_STATE], b[ISO_MAX_STATE], off = 0;
        const bool first = state_of(c, &c->compiled, backend, m, a), second = state_of(c, &c->written, backend, m, b);
        for (int j = 0; first && second && j < ISO_STATE; j++)
            off = fmax(off, fabs(a[j] - b[j]) / norm(a + j / 3 * 3));
        taken += first;
        gsl_test(first != second, "%s by %s, %s: one of both is refused: %s", c->name, iso_backend_name((int)backend),
                 m->name, iso_context_message(ctx));
        gsl_test(!(off <= bound), "%s by %s, %s: apart by %.2g", c->name, iso_backend_name((int)backend), m->name,
                 off);
    }
    gsl_test(taken < 20, "%s by %s: %d methods take it", c->name, iso_backend_name((int)backend), taken);
}

/* How far the state at t = 10 is from omega, n and e in x. */
static double off_reference(const pair *c, const char *method, const double x[9])
{
    iso_orbit_options o = iso_orbit_defaults(&c->start);
    iso_orbit *orbit;
    iso_sample s;
    double off = 0;
    o.method = iso_method_find(method);
    o.tolerance = 1e-14;
    o.effects = &c->written;
    laws_stop_if(ctx, iso_orbit_create(ctx, &c->p, &c->start, &o, &orbit) != ISO_OK, c->name);
    laws_stop_if(ctx, iso_orbit_at(orbit, 10, &s) != ISO_OK, c->name);
    for (int j = 0; j < ISO_STATE; j++) off = fmax(off, fabs(s.ball[j] - x[j]));
    for (int j = 0; j < 3; j++) off = fmax(off, fabs(sample_of(&s, "e")[j] - x[ISO_STATE + j]));
    iso_orbit_free(orbit);
    return off;
}

/* The states of written.csv, by three methods. */
static void references(void)
{
    static const struct {
        const char *name, *M[3];
    } torques[] = {
        {"friction", {"-c*n3^2*omega1", "-c*n3^2*omega2", "-c*n3^2*omega3"}},
        {"space", {"0.2*e1", "0.2*e2", "0.2*e3"}},
        {"both", {"e1/5 - c*n3^2*omega1", "e2/5 - c*n3^2*omega2 + sin(n1)/4", "e3/5 - c*n3^2*omega3"}},
    };
    static const char *const methods[] = {"taylor", "taylor_quad", "rk8pd"};
    FILE *file = fopen(ISO_TEST_DATA "/written.csv", "r");
    char line[512], name[16];
    double k, x[9];
    int rows = 0;
    while (file && fgets(line, sizeof line, file)) {
        if (sscanf(line, "%15[a-z],%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", name, &k, x, x + 1, x + 2, x + 3, x + 4,
                   x + 5, x + 6, x + 7, x + 8) < 11)
            continue;
        int which = 0;
        while (strcmp(torques[which].name, name) != 0) which++;
        pair c = ball(name, false, k);
        const double friction = 0.3, none = 0, up[3] = {0, 0.6, 0.8};
        set(&c.written, "gravity", "mgb", 1, &none);
        set(&c.written, "gravity", "up", 3, up);
        set(&c.written, "torque", "c", 1, &friction);
        write_torque(&c.written, torques[which].M[0], torques[which].M[1], torques[which].M[2]);
        rows++;
        for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
            const double off = off_reference(&c, methods[i], x);
            gsl_test(!(off <= 1e-12), "%s, k = %g, by %s: off by %.2g", name, k, methods[i], off);
        }
    }
    gsl_test_int(rows, 6, "rows of written.csv");
    if (file) fclose(file);
}

int main(void)
{
    ctx = iso_context_create();
    references();
    for (int physical = 0; physical < 2; physical++) {
        pair (*const pairs[])(bool, double) = {field, level, weight, friction, rotor};
        for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
            if (tests_length(1, 0) && (i + (size_t)physical) % 2) continue; /* each in units of one kind */
            const pair c = pairs[i](physical, 0.6);
            by_all_methods(&c, ISO_BACKEND_BALL);
            if (i == 0) by_all_methods(&c, ISO_BACKEND_POINT);
        }
    }
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

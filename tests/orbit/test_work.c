/* The work of torques that a scene writes: what the form of the power shows, and what a scene claims. The laws:
 *
 * - A torque with a patch, where it does what it does nowhere else, moves the ball rightly or is refused: whatever is
 *   claimed of its work. Patches lie on the orbit, and are too small, in n and omega, for samples.
 * - A false claim is never an answer: the orbit ends where the claim fails, by every method, alone and in lanes.
 * - A true claim is not refused, and what it gives is the same motion as without it.
 */
#include "laws.h"
#include "method/integrator_impl.h"
#include "method/methods_impl.h"
#include "model/expression/written_impl.h"
#include "orbit/batch.h"
#include "orbit/orbit_impl.h"

enum { TEXT = ISO_EXPRESSION_SIZE, NOT_SAID = -1 };

static iso_context *ctx;
static iso_params params;
static iso_start start;

static iso_effects torque_of(const char *const M[3], int said)
{
    static const char *const names[] = {"M1", "M2", "M3"};
    iso_effects e = iso_effects_default();
    const double work = said;
    for (int i = 0; i < 3; i++)
        laws_stop_if(ctx, iso_effects_write(ctx, &e, "torque", names[i], M[i]) != ISO_OK, "a torque");
    laws_stop_if(ctx, said != NOT_SAID && iso_effects_set(ctx, &e, "torque", "work", 1, &work) != ISO_OK, "work");
    return e;
}

static void forms(void)
{
    static const struct {
        const char *M[3];
        iso_work rigid, twisting;
    } cases[] = {
        {{"omega3*n2", "0", "-omega1*n2"}, ISO_WORK_NONE, ISO_WORK_NONE},
        {{"n1*exp(n2)", "n2*exp(n2)", "n3*exp(n2)"}, ISO_WORK_NONE, ISO_WORK_UNKNOWN},
        {{"0.1*omega2", "-omega1/10", "0"}, ISO_WORK_UNKNOWN, ISO_WORK_UNKNOWN}, /* 0.1 is not a tenth */
        {{"0.1*omega2", "-0.1*omega1", "0"}, ISO_WORK_NONE, ISO_WORK_NONE},
        {{"omega2*(1 + n1)", "-omega1 - n1*omega1", "0"}, ISO_WORK_NONE, ISO_WORK_NONE},
        {{"omega2/(1.2 - n1)", "-omega1/(1.2 - n1)", "0"}, ISO_WORK_NONE, ISO_WORK_NONE},
        /* the sum of the numbers is 0 in doubles alone */
        {{"1e16*omega1 + omega1 - 1e16*omega1 - 1e-3*omega1", "0", "0"}, ISO_WORK_UNKNOWN, ISO_WORK_UNKNOWN},
        {{"omega2*9007199254740992 + omega2", "-9007199254740992*omega1", "0"}, ISO_WORK_UNKNOWN, ISO_WORK_UNKNOWN},
        {{"a*omega2", "b*omega1", "0"}, ISO_WORK_NONE, ISO_WORK_NONE}, /* a = -b */
        {{"a*omega1", "-b*omega2*J1", "a^3*omega3"}, ISO_WORK_LOST, ISO_WORK_LOST},
        {{"-a*omega1", "0", "0"}, ISO_WORK_UNKNOWN, ISO_WORK_UNKNOWN},
        {{"-omega1", "-omega2", "-omega3"}, ISO_WORK_LOST, ISO_WORK_LOST},
        {{"omega1", "omega2", "omega3"}, ISO_WORK_UNKNOWN, ISO_WORK_UNKNOWN},
        {{"-omega1*n1^2", "-omega2*exp(n1)", "-omega3^3*sqrt(n1 + 2)"}, ISO_WORK_LOST, ISO_WORK_LOST},
        {{"-omega1*n1^3", "0", "0"}, ISO_WORK_UNKNOWN, ISO_WORK_UNKNOWN},
        {{"-omega1^2", "0", "0"}, ISO_WORK_UNKNOWN, ISO_WORK_UNKNOWN},
        {{"-omega1*(n1 - 1)*(n1 - 1)", "0", "0"}, ISO_WORK_LOST, ISO_WORK_LOST},
        {{"-omega1*(n1^101)^2", "0", "0"}, ISO_WORK_LOST, ISO_WORK_LOST},
        {{"-omega1*n1^101", "0", "0"}, ISO_WORK_UNKNOWN, ISO_WORK_UNKNOWN},
        {{"-omega1*sqrt(n3 - 2)", "0", "0"}, ISO_WORK_LOST, ISO_WORK_LOST}, /* nowhere defined */
        {{"n1 - omega1", "n2 - omega2", "n3 - omega3"}, ISO_WORK_LOST, ISO_WORK_UNKNOWN},
        {{"-omega2 - 3*exp(-2000*n1^2)*omega1", "omega1", "0"}, ISO_WORK_LOST, ISO_WORK_LOST},
        {{"sin(n1)^2*omega2 + cos(n1)^2*omega2", "-omega1", "0"}, ISO_WORK_UNKNOWN, ISO_WORK_UNKNOWN},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int twisting = 0; twisting < 2; twisting++) {
            iso_effects e = torque_of(cases[i].M, NOT_SAID);
            const iso_work expected = twisting ? cases[i].twisting : cases[i].rigid;
            const double c = 0.1, minus = -0.25, other = 0.25;
            laws_stop_if(ctx, iso_effects_set(ctx, &e, "torque", "a", 1, &minus) != ISO_OK, "a");
            laws_stop_if(ctx, iso_effects_set(ctx, &e, "torque", "b", 1, &other) != ISO_OK, "b");
            if (twisting)
                laws_stop_if(ctx, iso_effects_set(ctx, &e, "twist", "resistance", 1, &c) != ISO_OK, "twist");
            iso_problem f = {.p = params, .effects = e};
            gsl_test(iso_written_work(&f) != expected, "form %zu, twisting %d: %s, %s, %s is %d, not %d", i, twisting,
                     cases[i].M[0], cases[i].M[1], cases[i].M[2], (int)iso_written_work(&f), (int)expected);
        }
}

/* --- orbits ------------------------------------------------------------------------------------------------------ */

static iso_status follow(const iso_effects *e, const char *method, double time, double y[ISO_STATE])
{
    iso_orbit_options o = iso_orbit_defaults(&start);
    iso_orbit *orbit;
    iso_sample s;
    o.method = iso_method_find(method);
    o.effects = e;
    iso_status status = iso_orbit_create(ctx, &params, &start, &o, &orbit);
    if (status == ISO_OK) status = iso_orbit_at(orbit, time, &s);
    if (status == ISO_OK) copy(s.ball, y, ISO_STATE);
    iso_orbit_free(orbit);
    return status;
}

/* The same by equal steps of rk8pd, which keep no energy and ask nobody about it. Steps are a tenth of the time in
 * which the ball crosses a patch, so their error is below 1e-8. */
static void follow_single(const iso_effects *e, double time, double step, double y[ISO_STATE])
{
    const iso_method_options options = {.tolerance = 1e-13, .fixed_step = step, .no_projection = true};
    iso_orbit_options o = iso_orbit_defaults(&start);
    iso_orbit *orbit;
    iso_integrator *it;
    iso_sample s;
    o.effects = e;
    laws_stop_if(ctx, iso_orbit_create(ctx, &params, &start, &o, &orbit) != ISO_OK, "the reference");
    laws_stop_if(ctx, iso_orbit_at(orbit, 0, &s) != ISO_OK, "its start");
    const iso_model *m = iso_orbit_model(orbit);
    iso_orbit_state_of(orbit, m->system, &s, y);
    const double unit = iso_orbit_units(orbit)->w;
    laws_stop_if(ctx, iso_integrator_create(ctx, iso_method_find("rk8pd"), m, &options, &it) != ISO_OK, "rk8pd");
    laws_stop_if(ctx, iso_integrator_start(it, y) != ISO_OK || iso_integrator_at(it, time * unit, y) != ISO_OK,
                 "its end");
    for (int i = 0; i < 3; i++) y[i] *= unit;
    iso_integrator_free(it);
    iso_orbit_free(orbit);
}

static double apart(const double a[ISO_STATE], const double b[ISO_STATE])
{
    double most = 0;
    for (int i = 0; i < ISO_STATE; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* M = B x omega, and in the patch `much` times the torque of `kind`: resistance, a push, or another torque B' x
 * omega. */
typedef struct patched {
    char M[3][TEXT], smooth[3][TEXT];
    int kind;
    double sharp;
} patched;

enum { RESISTS, PUSHES, TURNS, KINDS };

static patched random_torque(iso_random *r)
{
    patched t = {.kind = (int)iso_random_uniform(r, 0, KINDS), .sharp = pow(10, iso_random_uniform(r, 1.5, 2.3))};
    const double many = iso_random_uniform(r, 1, 4), much = iso_random_uniform(r, 0.5, 3);
    const double size = iso_random_uniform(r, 0.1, 1);
    double place[ISO_STATE], B[3], C[3], step = 0.01;
    char patch[TEXT];
    iso_random_direction(r, B);
    iso_random_direction(r, C);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        snprintf(t.smooth[i], TEXT, "(%.3f)*omega%d - (%.3f)*omega%d", size * B[j], l + 1, size * B[l], j + 1);
    }
    const char *const smooth[3] = {t.smooth[0], t.smooth[1], t.smooth[2]};
    const iso_effects e = torque_of(smooth, NOT_SAID);
    follow_single(&e, many, step, place);
    int at = snprintf(patch, TEXT, "%.3f*exp(-%.0f*(", much, t.sharp);
    for (int i = 0; i < ISO_STATE; i++)
        at += snprintf(patch + at, TEXT - (size_t)at, "%s(%s%d - (%.3f))^2", i > 0 ? "+" : "", i < 3 ? "omega" : "n",
                       i % 3 + 1, place[i]);
    snprintf(patch + at, TEXT - (size_t)at, "))");
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        if (t.kind == TURNS)
            snprintf(t.M[i], TEXT, "%.80s + %.200s*((%.3f)*omega%d - (%.3f)*omega%d)", t.smooth[i], patch, C[j],
                     l + 1, C[l], j + 1);
        else
            snprintf(t.M[i], TEXT, "%.80s %c %.200s*omega%d", t.smooth[i], t.kind == PUSHES ? '+' : '-', patch,
                     i + 1);
    }
    return t;
}

static void patches(void)
{
    enum { CLAIMS = 4 };
    static const int claims[CLAIMS] = {NOT_SAID, ISO_WORK_UNKNOWN, ISO_WORK_NONE, ISO_WORK_LOST};
    static const char *const methods[] = {"taylor", "rk8pd", "taylor_extended"};
    iso_random *r = iso_random_create(45);
    const int count = tests_length(12, 300);
    int refused = 0, early = 0;
    double worst = 0;
    for (int i = 0; i < count; i++) {
        const patched t = random_torque(r);
        const char *const M[3] = {t.M[0], t.M[1], t.M[2]};
        const iso_effects any = torque_of(M, ISO_WORK_UNKNOWN);
        double y[ISO_STATE], reference[ISO_STATE];
        follow_single(&any, 6, 0.1 / sqrt(t.sharp), reference);
        for (int j = 0; j < CLAIMS; j++) {
            const iso_effects e = torque_of(M, claims[j]);
            const char *method = methods[(i + j) % 3];
            const iso_status status = follow(&e, method, 6, y);
            const char *words = iso_context_message(ctx);
            const double off = status == ISO_OK ? apart(y, reference) : 0;
            const bool says = (status == ISO_BAD_INPUT && strstr(words, "'work' is")) ||
                              (status == ISO_NUMERICAL && strstr(words, "the scene says 'work: ") &&
                               strstr(words, "; there 'torque' ") && strstr(words, "and n = ("));
            refused += says, early += status == ISO_BAD_INPUT;
            worst = fmax(worst, off);
            if (claims[j] == ISO_WORK_UNKNOWN || claims[j] == NOT_SAID || t.kind == TURNS ||
                (t.kind == RESISTS && claims[j] == ISO_WORK_LOST)) /* true */
                gsl_test(status != ISO_OK || off > 1e-7, "patch %d, kind %d, said %d, %s: off by %.2g, %s", i, t.kind,
                         claims[j], method, off, status == ISO_OK ? "" : words);
            else
                gsl_test(!says, "patch %d, kind %d, falsely said %d, %s: status %d, off by %.2g, %s", i, t.kind,
                         claims[j], method, (int)status, off, status == ISO_OK ? "" : words);
        }
    }
    printf("%d torques with a patch: %d false claims refused, %d of them by samples; else off by at most %.2g\n",
           count, refused, early, worst);
    iso_random_free(r);
}

/* Claims that are true, but that no form shows, and the same torque in a form that does. */
static void true_claims(void)
{
    static const struct {
        const char *hidden[3], *plain[3];
        int said;
    } cases[] = {
        {{"omega2*(sin(n1)^2 + cos(n1)^2)", "-omega1", "0"}, {"omega2", "-omega1", "0"}, ISO_WORK_NONE},
        {{"omega2*(n1^2 + n2^2 + n3^2)", "-omega1", "0"}, {"omega2", "-omega1", "0"}, ISO_WORK_NONE},
        {{"-omega1*(1.5 - n2)", "-omega2*(1.5 - n2)", "-omega3*(1.5 - n2)"},
         {"-omega1*exp(log(1.5 - n2))", "-omega2*exp(log(1.5 - n2))", "-omega3*exp(log(1.5 - n2))"},
         ISO_WORK_LOST},
    };
    static const char *const methods[] = {"taylor", "taylor_extended", "rk8pd", "bsimp", "adams", "bdf"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t j = 0; j < sizeof methods / sizeof *methods; j++) {
            double a[ISO_STATE], b[ISO_STATE];
            const iso_effects hidden = torque_of(cases[i].hidden, cases[i].said);
            const iso_effects plain = torque_of(cases[i].plain, NOT_SAID);
            if (!iso_method_find(methods[j])) continue;
            const bool good =
                follow(&hidden, methods[j], 20, a) == ISO_OK && follow(&plain, methods[j], 20, b) == ISO_OK;
            gsl_test(!good, "true claim %zu by %s: %s", i, methods[j], iso_context_message(ctx));
            gsl_test(good && apart(a, b) > (j < 3 ? 1e-10 : 1e-7), "true claim %zu by %s: apart by %.2g", i,
                     methods[j], apart(a, b));
        }
}

/* A false claim ends at the same place by every method, and in lanes: beside orbits that go on. */
static void by_every_way(void)
{
    enum { MANY = 5, ROWS = 3 };
    static const char *const M[3] = {
        "-omega2 - 3*exp(-2000*((n1 - 0.105)^2 + (n2 - 0.892)^2 + (n3 + 0.439)^2))*omega1",
        "omega1 - 3*exp(-2000*((n1 - 0.105)^2 + (n2 - 0.892)^2 + (n3 + 0.439)^2))*omega2",
        "-3*exp(-2000*((n1 - 0.105)^2 + (n2 - 0.892)^2 + (n3 + 0.439)^2))*omega3"};
    const iso_effects none = torque_of(M, ISO_WORK_NONE), lost = torque_of(M, ISO_WORK_LOST);
    const double times[ROWS] = {1, 2, 12};
    double y[ISO_STATE];
    int methods = 0;
    for (int i = 0; iso_methods[i]; i++) {
        iso_status status = follow(&lost, iso_methods[i]->name, 0.1, y);
        if (status != ISO_OK || iso_methods[i]->order == 1 || iso_methods[i]->order == 2) continue;
        status = follow(&none, iso_methods[i]->name, 12, y);
        const char *words = iso_context_message(ctx);
        const bool said = strstr(words, "; there 'torque' takes energy") || strstr(words, ISO_MOVED_TOO_FAR);
        gsl_test(status != ISO_NUMERICAL || !said, "%s: %s", iso_methods[i]->name,
                 status == ISO_OK ? "no end" : words);
        methods++;
    }
    gsl_test(methods < 10, "%d methods", methods);
    iso_batch_orbit orbits[MANY];
    iso_sample samples[MANY * ROWS];
    iso_status status[MANY];
    for (int i = 0; i < MANY; i++) orbits[i] = (iso_batch_orbit){&params, &start, i % 2 ? &none : &lost};
    iso_batch_run(ctx, orbits, MANY, NULL, times, ROWS, samples, status);
    gsl_test(!strstr(iso_context_message(ctx), "'torque' does work, but the scene says 'work: none'"), "lanes: %s",
             iso_context_message(ctx));
    for (int i = 0; i < MANY; i++) {
        const double *last = samples[i * ROWS + 2].ball, *before = samples[i * ROWS + 1].ball;
        gsl_test(status[i] != (i % 2 ? ISO_NUMERICAL : ISO_OK) || isnan(last[0]) != (i % 2 == 1) || isnan(before[0]),
                 "orbit %d of a batch: status %d", i, (int)status[i]);
    }
}

int main(void)
{
    const double omega[3] = {0.9, -0.3, -0.225}, n[3] = {0.36, 0.48, 0.8}, J[3] = {1.4, 2.1, 3};
    ctx = iso_context_create();
    laws_stop_if(ctx, iso_params_reduced(ctx, 0.5, J, &params) != ISO_OK, "a ball");
    laws_stop_if(ctx, iso_start_ball(ctx, omega, n, ISO_SPIN_REMOVE, &start) != ISO_OK, "a start");
    forms();
    true_claims();
    by_every_way();
    patches();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

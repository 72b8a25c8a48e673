/* bench_effects - what each effect costs: states, one right-hand side, a whole orbit; as ratios to the free ball's.
 *
 *     cmake -S . -B .build/release && cmake --build .build/release -j 2 && .build/release/tests/bench_effects
 *
 * The ball is the shell k = -1, J = (1.4, 2.1, 3.0), D = 0.5. Its orbit runs to t = 100 with method auto at tolerance
 * 1e-12.
 *
 * How to read the output. Each row is one effect: the number of states, the time of one right-hand side, its ratio to
 * the free ball's, the time of the whole orbit, and its ratio. Compare the ratios: times depend on the machine. Each
 * time is the least of several rounds, and each round goes over all effects, so that ratios hold on a noisy machine.
 */
#include "api/typed_impl.h"
#include "bench.h"
#include "orbit/orbit_impl.h"

enum { CALLS = 20000, ROUNDS = 15, MOST = 24 };

typedef struct run {
    const char *name;
    iso_effects effects;
    iso_backend backend;
    int states;
    double rhs, orbit; /* least milliseconds so far */
} run;

/* The field, or the level, as a scene writes it. */
static void write_potential(iso_effects *e, bool level)
{
    iso_written *text = &e->written[iso_effect_list[ISO_POTENTIAL]->written];
    strcpy(text->parameter[0], "c");
    e->number[ISO_POTENTIAL][0] = 0.1;
    strcpy(text->expression[0], level
                                    ? "-c*(n1^2/J1 + n2^2/J2 + n3^2/J3)^(-1/k)"
                                    : "0.15*n1^2 - c*n2^2 + n3^2/20 + c*n1*n2 + 0.05*n2*n3 + c*n1 - 0.2*n2 + 0.3*n3");
}

static iso_effects all_numbers(void)
{
    static const double number[ISO_EFFECTS][ISO_EFFECT_NUMBERS] = {
        [ISO_GRAVITY] = {0.7, 0, 0.6, 0.8},
        [ISO_FIELD] = {0.3, 0.1, 0, 0.1, -0.2, 0.05, 0, 0.05, 0.1, 0.1, -0.2, 0.3},
        [ISO_LEVEL] = {0.1},
        [ISO_TWIST] = {10},
        [ISO_ROLLING_RESISTANCE] = {0.01},
        [ISO_ROTOR] = {0.3, 0.4, 0.5},
        [ISO_ATTITUDE] = {1, 0, 0, 0},
        [ISO_REACTIONS] = {true},
    };
    iso_effects e = iso_effects_default();
    iso_written *torque = &e.written[iso_effect_list[ISO_TORQUE]->written];
    for (int id = 0; id < ISO_EFFECTS; id++)
        if (number[id][0] != 0) memcpy(e.number[id], number[id], sizeof number[id]);
    write_potential(&e, false);
    for (int i = 0; i < 3; i++) snprintf(torque->expression[i], ISO_EXPRESSION_SIZE, "-0.01*omega%d", i + 1);
    strcpy(e.written[iso_effect_list[ISO_INTEGRALS]->written].expression[0], "n1^2 + n2^2 + n3^2");
    return e;
}

static void time_rhs(const iso_orbit *orbit, run *r)
{
    const iso_model *m = iso_orbit_model(orbit);
    double y[ISO_MAX_STATE], dy[ISO_MAX_STATE];
    iso_model_begin(m, bench_state, y);
    const double begin = bench_milliseconds();
    for (int i = 0; i < CALLS; i++) {
        m->rhs(m, y, dy);
        y[0] += 1e-18 * dy[0]; /* each call waits for the one before */
    }
    r->rhs = fmin(r->rhs, (bench_milliseconds() - begin) / CALLS);
    r->states = m->dim;
}

static void measure(iso_context *ctx, const iso_params *p, run *r)
{
    const iso_start start = bench_start(ctx);
    iso_orbit *orbit;
    iso_sample sample;
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &r->effects;
    o.backend = r->backend;
    o.with_clock[ISO_CLOCK_TAU] = o.with_clock[ISO_CLOCK_S] = r->effects.on[ISO_CLOCK];
    bench_must(ctx, iso_orbit_create(ctx, p, &start, &o, &orbit));
    time_rhs(orbit, r);
    const double begin = bench_milliseconds();
    bench_must(ctx, iso_orbit_at(orbit, 100, &sample));
    r->orbit = fmin(r->orbit, bench_milliseconds() - begin);
    iso_orbit_free(orbit);
}

enum { NOTHING = -1 };

static run run_with(const char *name, iso_backend backend, int effect)
{
    run r = {name, all_numbers(), backend, 0, INFINITY, INFINITY};
    if (effect != NOTHING) r.effects.on[effect] = true;
    return r;
}

static int list_runs(run runs[])
{
    int count = 0;
    runs[count++] = run_with("free ball", ISO_BACKEND_BALL, NOTHING);
    for (int e = 0; e < ISO_EFFECTS; e++) runs[count++] = run_with(iso_effect_list[e]->name, ISO_BACKEND_BALL, e);
    for (int stiff = 0; stiff < 2; stiff++) { /* the contact's torque is a state */
        runs[count] = run_with(stiff ? "twist, c = 1e8" : "twist, c = 1e2", ISO_BACKEND_BALL, ISO_TWIST);
        runs[count++].effects.number[ISO_TWIST][0] = stiff ? 1e8 : 1e2;
    }
    runs[count] = run_with("all together", ISO_BACKEND_BALL, NOTHING);
    for (int e = 0; e < ISO_EFFECTS; e++) runs[count].effects.on[e] = true;
    count++;
    runs[count++] = run_with("free point", ISO_BACKEND_POINT, NOTHING);
    runs[count++] = run_with("point in a field", ISO_BACKEND_POINT, ISO_FIELD);
    runs[count++] = run_with("point in it, written", ISO_BACKEND_POINT, ISO_POTENTIAL);
    runs[count] = run_with("level, written", ISO_BACKEND_BALL, ISO_POTENTIAL);
    write_potential(&runs[count++].effects, true);
    runs[count++] = run_with("point with a rotor", ISO_BACKEND_POINT, ISO_ROTOR);
    return count;
}

int main(void)
{
    iso_context *ctx = iso_context_create();
    iso_params p = bench_params(ctx, -1, bench_J);
    run runs[MOST];
    const int count = list_runs(runs);
    bench_must(ctx, iso_params_set_D(ctx, 0.5, &p));
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < count; i++) measure(ctx, &p, &runs[i]);
    printf("%-20s %6s %20s %20s\n", "", "states", "right-hand side", "orbit to t = 100");
    for (int i = 0; i < count; i++)
        printf("%-20s %6d %10.0f ns %6.2f %10.2f ms %6.2f\n", runs[i].name, runs[i].states, 1e6 * runs[i].rhs,
               runs[i].rhs / runs[0].rhs, runs[i].orbit, runs[i].orbit / runs[0].orbit);
    iso_context_free(ctx);
    return 0;
}

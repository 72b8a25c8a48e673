/* First-order variations, lib/method/taylor/deviations_impl.h: of every model and effect against differences of
 * neighbouring orbits in numbers of 128 bits, by each code. */
#include "method/taylor/lanes_impl.h"
#include "orbits.h"

static const iso_lane_options finest = {.tolerance = 1e-15};
static const char *const codes[] = {"plain", "avx2", "avx512", "extended", "quad"};
enum { CODES = sizeof codes / sizeof *codes };

static iso_context *ctx;
static int each; /* of so many cases one is tested: all take an hour */

/* --- one orbit to one time -------------------------------------------------------------------------------------- */

typedef struct flow {
    const orbit *o;
    double time;
    const iso_lane_build *code;
    iso_lane_event event;
    double first[ISO_LANE_DEVIATIONS][ISO_MAX_STATE];
    bool arrived;
} flow;

static void go(flow *f, const double y[])
{
    iso_lane_job job = {.model = &f->o->model, .rows = 1, .time = &f->time, .unit = 1, .event = &f->event};
    iso_lane_job *const only = &job;
    copy(y, job.start, f->o->model.dim);
    f->arrived = f->code->solve(&only, 1, &finest) && job.done == 1;
    memcpy(f->first, job.first, sizeof f->first);
}

/* The state at the flow's time, from y. */
static void state_after(const void *data, const double y[], double value[])
{
    flow own = *(const flow *)data;
    go(&own, y);
    for (int i = 0; i < own.o->model.moving; i++) value[i] = own.arrived ? own.event.y[i] : NAN;
}

/* --- against neighbours ----------------------------------------------------------------------------------------- */

/* The states that have equations of motion of their own, which no integral of another is. */
static bool compared(const orbit *o, int i)
{
    if (i < ISO_STATE) return true;
    const iso_formula *F = &o->model.problem.motion;
    for (int s = 0; s < F->states; s++)
        if (F->state[s].kind != ISO_STATE_DERIVED && i >= F->state[s].at &&
            i < F->state[s].at + (F->state[s].is_vector ? 3 : 1))
            return true;
    return false;
}

/* The error of a deviation, without its part along the flow, relative to its length and that of the state. */
static double error_of(const orbit *o, const double y[], const double d[], const double neighbour[])
{
    double f[ISO_MAX_STATE], size[ISO_MAX_STATE], along = 0, square = 0, worst = 0, length = 0;
    o->model.rhs(&o->model, y, f);
    iso_model_size(&o->model, y, size);
    for (int i = 0; i < ISO_STATE; i++) {
        along += (d[i] - neighbour[i]) * f[i] / (size[i] * size[i]);
        square += f[i] * f[i] / (size[i] * size[i]);
        length = fmax(length, fabs(neighbour[i] / size[i]));
    }
    for (int i = 0; i < o->model.moving; i++)
        if (compared(o, i)) worst = fmax(worst, fabs((d[i] - neighbour[i] - along / square * f[i]) / size[i]));
    return worst / length;
}

static void check_neighbours(const effects_case *c, laws_worst *worst)
{
    static int variant, number;
    if (c->subset & 1 << ISO_CLOCK || iso_effects_stiffness(&c->model.problem) > ISO_STIFF) return;
    if (c->system == &iso_system_point &&
        c->subset & ~(1 << ISO_FIELD | 1 << ISO_LEVEL | 1 << ISO_ROTOR | 1 << ISO_POTENTIAL))
        return;
    if (pow(laws_spread(&c->model.problem.p), 1 / fabs(c->model.problem.p.k)) > 1e4 || number++ % each != 0) return;
    const orbit o = orbit_of(ctx, c, variant++);
    flow f = {.o = &o, .time = 0.7 * orbit_stretch(c, &o), .code = iso_lane_build_find("quad", true)};
    go(&f, o.y0);
    const double step = 2e-4; /* with a strong rotor 1e-3 is too large for the differences */
    double neighbour[ISO_LANE_DEVIATIONS][ISO_MAX_STATE];
    for (int d = 0; d < ISO_LANE_DEVIATIONS; d++)
        laws_slope(state_after, &f, o.model.moving, o.model.moving, o.y0, f.first[d], step, neighbour[d]);
    for (int code = 0; code < CODES; code++) {
        flow own = f;
        own.code = iso_lane_build_find(codes[code], true);
        if (!own.code) continue;
        go(&own, o.y0);
        for (int d = 0; d < ISO_LANE_DEVIATIONS; d++) {
            double found[ISO_MAX_STATE];
            for (int i = 0; i < o.model.moving; i++) found[i] = exp(own.event.scale[d]) * own.event.deviation[d][i];
            const double error = own.arrived ? error_of(&o, own.event.y, found, neighbour[d]) : NAN;
            effects_note(c, worst, error, 1e-9 * laws_spread(&c->model.problem.p), codes[code]);
        }
    }
}

int main(void)
{
    if (!iso_lane_build_find("quad", true)) {
        printf("SKIP deviations against neighbours: this compiler has no numbers of 128 bits\n");
        return 0;
    }
    ctx = iso_context_create();
    each = tests_length(499, 1009);
    effects_hold("deviations are those of neighbours", &iso_system_ball, tests_length(0, 2), check_neighbours);
    each = tests_length(11, 23);
    effects_hold("deviations are those of neighbours", &iso_system_point, tests_length(0, 2), check_neighbours);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

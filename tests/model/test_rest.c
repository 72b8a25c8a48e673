/* The end of a motion (model/rest.c): rest, endless speeding up backwards in time, a constraint that is lost. */
#include "orbits.h"

enum { RESIST = 1, TWIST = 2, STIFF = 4, FIELD = 8, GRAVITY = 16, KINDS = 32 };

static iso_context *ctx;

/* A ball under the effects of `kind`, with all clocks but its own carried. */
static iso_model make_model(const orbit *o, int kind)
{
    iso_problem f = o->model.problem;
    f.p.D = 0.5;
    f.effects.on[ISO_ROLLING_RESISTANCE] = kind & RESIST, ROLLING_COEFFICIENT(&f.effects) = 0.2;
    f.effects.on[ISO_TWIST] = kind & (TWIST | STIFF), TWIST_RESISTANCE(&f.effects) = kind & STIFF   ? 1e5
                                                                                     : kind & TWIST ? 0.3
                                                                                                    : 0;
    f.effects.on[ISO_FIELD] = kind & FIELD, FIELD_LINEAR(&f.effects)[1] = 0.4;
    f.effects.on[ISO_GRAVITY] = kind & GRAVITY, GRAVITY_MGB(&f.effects) = 0.3, GRAVITY_UP(&f.effects)[2] = 1;
    return iso_model_assemble(o->model.system, &f, o->model.clock, (const bool[ISO_CLOCKS]){true, true, true});
}

/* The state of the orbit's start, as slow as `speed`. */
static void make_state(const orbit *o, const iso_model *m, double speed, double y[])
{
    double six[ISO_STATE];
    copy(o->y0, six, ISO_STATE);
    scale(six, speed / norm(six));
    iso_model_begin(m, six, y);
}

/* At rest the way of a time a + b is that of a and then of b; omega is 0, and the equations hold all the way. */
static void check_way(const iso_model *m, const double start[])
{
    const double a = 1.5, b = 1e6;
    double once[ISO_MAX_STATE], twice[ISO_MAX_STATE], f[ISO_MAX_STATE];
    copy(start, once, m->dim);
    copy(start, twice, m->dim);
    iso_model_rest(m, a + b, once);
    iso_model_rest(m, a, twice);
    iso_model_rest(m, b, twice);
    m->rhs(m, once, f);
    for (int i = 0; i < m->dim; i++) {
        const double moved = i < m->moving ? 0 : f[i] * (a + b);
        gsl_test(!(fabs(once[i] - twice[i]) <= 4 * DBL_EPSILON * fabs(once[i])), "state %d: %g, %g", i, once[i],
                 twice[i]);
        gsl_test(!(fabs(once[i] - start[i] - moved) <= 4 * DBL_EPSILON * fabs(moved) + ISO_REST),
                 "state %d: %g after %g", i, once[i], start[i]);
    }
    gsl_test(!(largest(once) == 0 && m->clocks > 0 && f[m->moving] > 0), "only clocks go on");
    gsl_test(!iso_model_at_rest(m, once), "what rests, rests");
}

static void check_rest(const orbit *o, int kind)
{
    const iso_model m = make_model(o, kind);
    double y[ISO_MAX_STATE];
    const bool ends = (kind & (RESIST | TWIST | STIFF)) && !(kind & (FIELD | GRAVITY));
    make_state(o, &m, 0.1 * ISO_REST, y);
    gsl_test(iso_model_at_rest(&m, y) != ends, "effects %d: at rest %d", kind, ends);
    if (ends) check_way(&m, y);
    make_state(o, &m, 10 * ISO_REST, y);
    gsl_test(iso_model_at_rest(&m, y), "effects %d: it still moves", kind);
}

static void check_speeding(const orbit *o, int kind)
{
    const iso_model m = make_model(o, kind);
    double y0[ISO_MAX_STATE], y[ISO_MAX_STATE];
    const bool resisted = kind & (RESIST | TWIST | STIFF);
    make_state(o, &m, 1, y0);
    make_state(o, &m, 9e3, y);
    gsl_test(iso_model_speeds_up(&m, -1, y0, y) != NULL, "effects %d: 9000 times as fast", kind);
    make_state(o, &m, 1.1e4, y);
    gsl_test((iso_model_speeds_up(&m, -1, y0, y) != NULL) != resisted, "effects %d: 11000 times as fast", kind);
}

/* The constraint is there unless the ball twists freely; of a stiff contact it is that of lambda. */
static void check_lost(const orbit *o, int kind)
{
    const iso_model m = make_model(o, kind);
    const bool resisted = kind & (RESIST | TWIST | STIFF), kept = !(kind & TWIST) || (kind & STIFF);
    for (double speed = 1e-200; speed < 1e10; speed *= 1e50) {
        double y[ISO_MAX_STATE];
        make_state(o, &m, speed, y);
        const double unit = m.system->speed(&m.problem, y); /* also what potentials can make of it */
        gsl_test(iso_model_lost(&m, y, 1e-9) != NULL, "effects %d: nothing is lost", kind);
        add_scaled(y, 0.5e-3 * unit, y + 3);
        gsl_test(iso_model_lost(&m, y, 1e-9) != NULL, "effects %d: half a thousandth is not enough", kind);
        add_scaled(y, 1.5e-3 * unit, y + 3);
        gsl_test((iso_model_lost(&m, y, 1e-9) != NULL) != (resisted && kept), "effects %d: two thousandths are",
                 kind);
        gsl_test(iso_model_lost(&m, y, 1e-6) != NULL, "effects %d: but not at a loose tolerance", kind);
        if (m.problem.at[ISO_TWIST] == 0) continue;
        y[m.problem.at[ISO_TWIST]] = -TWIST_RESISTANCE(&m.problem.effects) * dot(y, y + 3);
        gsl_test(iso_model_lost(&m, y, 1e-9) != NULL, "effects %d: a stiff contact turns with its torque", kind);
    }
}

int main(void)
{
    ctx = iso_context_create();
    for (int k = 0; k < ORBIT_K; k++)
        for (int kind = 0; kind < KINDS; kind++) {
            const orbit o = orbit_sample(ctx, &iso_system_ball, orbit_k[k], orbit_J, 7 + (unsigned long)kind);
            check_rest(&o, kind);
            check_speeding(&o, kind);
            check_lost(&o, kind);
        }
    const orbit point = orbit_sample(ctx, &iso_system_point, 1, orbit_J, 3);
    double still[ISO_MAX_STATE] = {0};
    gsl_test(iso_model_at_rest(&point.model, still) || iso_model_lost(&point.model, still, 1e-9) ||
                 iso_model_speeds_up(&point.model, -1, still, point.y0),
             "a point has no resistance");
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

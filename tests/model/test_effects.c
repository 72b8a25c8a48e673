/* The effects as the table has them: states, Jacobians, torques and their potentials, integrals, what is refused. */
#include "effects.h"

/* --- states ---------------------------------------------------------------------------------------------------- */

static void note_state(const effects_case *c, const iso_model *m, int at, const char *name, laws_worst *worst)
{
    const char *reason;
    const bool same = at < m->dim && strcmp(iso_model_state_name(m, at, &reason), name) == 0;
    effects_note(c, worst, same && (at < ISO_STATE) == (reason[0] == '\0') ? 0 : 1, 0.5, name);
}

/* What a subset of the effects must have: 6, the vertical, a stiff contact's torque, the quaternion,
 * on a plane the way, and clocks if asked. */
static void states(const effects_case *c, laws_worst *worst)
{
    static const char *const added[] = {"e1", "e2", "e3", "q0", "q1", "q2", "q3", "x1", "x2", "x3"};
    const iso_problem *f = &c->model.problem;
    const bool ball = c->system == &iso_system_ball;
    const bool gravity = ball && effects_on(c, ISO_GRAVITY), attitude = ball && effects_on(c, ISO_ATTITUDE);
    const bool stiff = ball && c->subset & EFFECTS_STIFF;
    for (int asked = 0; asked < 1 << ISO_CLOCKS; asked++) {
        const bool with_clock[ISO_CLOCKS] = {asked & 1, asked & 2, asked & 4};
        const iso_model m = iso_model_assemble(c->system, f, ISO_CLOCK_TAU, with_clock);
        int dim = 0;
        while (dim < ISO_STATE) note_state(c, &m, dim, c->system->state[dim], worst), dim++;
        effects_note(c, worst, abs(m.problem.at[ISO_GRAVITY] - (gravity ? dim : 0)), 0.5, "place of e");
        for (int i = 0; i < 3 && gravity; i++) note_state(c, &m, dim++, added[i], worst);
        effects_note(c, worst, abs(m.problem.at[ISO_TWIST] - (stiff ? dim : 0)), 0.5, "place of lambda");
        if (stiff) note_state(c, &m, dim++, "lambda", worst);
        effects_note(c, worst, abs(m.problem.at[ISO_ATTITUDE] - (attitude ? dim : 0)), 0.5, "place of Q");
        for (int i = 3; i < (f->p.k == 1 ? 10 : 7) && attitude; i++) note_state(c, &m, dim++, added[i], worst);
        effects_note(c, worst, abs(m.moving - dim), 0.5, "moving");
        if (with_clock[ISO_CLOCK_T]) note_state(c, &m, dim++, "t", worst);
        if (with_clock[ISO_CLOCK_S]) note_state(c, &m, dim++, "s", worst);
        effects_note(c, worst, abs(m.dim - dim), 0.5, "dim");
        for (int e = 0; e < ISO_EFFECTS; e++)
            if (e != ISO_GRAVITY && e != ISO_ATTITUDE && e != ISO_TWIST)
                effects_note(c, worst, m.problem.at[e], 0.5, "no states");
    }
}

static bool has_image(const iso_effects *e)
{
    return e->on[ISO_FIELD] || e->on[ISO_ROTOR] || e->on[ISO_POTENTIAL];
}

/* What is added up at each call: the ball's torques, none from a contact that twists freely; the point's field. */
static void forces(const effects_case *c, laws_worst *worst)
{
    const iso_problem *f = &c->model.problem;
    const iso_effects *e = &f->effects;
    const int torques = e->on[ISO_GRAVITY] + e->on[ISO_FIELD] + e->on[ISO_LEVEL] +
                        (e->on[ISO_TWIST] && TWIST_RESISTANCE(e) > 0) + e->on[ISO_ROLLING_RESISTANCE] +
                        e->on[ISO_ROTOR] + e->on[ISO_POTENTIAL] + 3 * e->on[ISO_TORQUE];
    int written = 0;
    for (int i = 0; i < f->motion.lines; i++) written += f->motion.line[i].operation == ISO_R_TORQUE;
    if (c->system == &iso_system_ball)
        effects_note(c, worst, abs(written - torques), 0.5, "torques");
    else
        effects_note(c, worst, abs((f->energy_formula.lines > 0) - has_image(e)), 0.5, "image");
}

/* The start: the six numbers, `up`, `quaternion`, the rest 0; sizes: 1, and of the way 1 more than it is long. */
static void beginnings(const effects_case *c, laws_worst *worst)
{
    const iso_effects *e = &c->model.problem.effects;
    const int up = c->model.problem.at[ISO_GRAVITY], Q = c->model.problem.at[ISO_ATTITUDE],
              lambda = effects_lambda(c);
    double y[ISO_MAX_STATE], size[ISO_MAX_STATE];
    for (int i = 0; i < ISO_MAX_STATE; i++) y[i] = NAN;
    iso_model_begin(&c->model, c->y, y);
    iso_model_size(&c->model, c->y, size);
    effects_note(c, worst, memcmp(y, c->y, ISO_STATE * sizeof *y), 0.5, "six");
    for (int i = ISO_STATE; i < c->model.dim; i++) {
        if (i == lambda) continue;
        const bool vertical = up > 0 && i < up + 3, turned = !vertical && i < Q + 4;
        const double expected = vertical ? GRAVITY_UP(e)[i - up] : turned ? QUATERNION(e)[i - Q] : 0;
        const double length = vertical || turned ? 1 : 1 + norm(c->y + Q + 4);
        effects_note(c, worst, fabs(y[i] - expected), DBL_MIN, "begin");
        effects_note(c, worst, fabs(size[i] / length - 1), 2 * DBL_EPSILON, "size");
    }
    if (lambda == 0) return;
    const double torque = -TWIST_RESISTANCE(e) * dot(c->y, c->y + 3);
    effects_note(c, worst, fabs(y[lambda] - torque), 4 * DBL_EPSILON * TWIST_RESISTANCE(e) * norm(c->y), "lambda");
    const double resists = e->on[ISO_ROLLING_RESISTANCE] ? ROLLING_COEFFICIENT(e) * largest(c->y) : 0;
    const double motion = 2 * iso_ball_energy(&c->model.problem.p, c->y) + resists;
    effects_note(c, worst, fabs(size[lambda] - fabs(torque) - motion),
                 8 * DBL_EPSILON * (size[lambda] + TWIST_RESISTANCE(e) * norm(c->y)), "size of lambda");
}

/* What nothing acts on is integrated with the system's own functions, bit for bit. */
static void plain(const effects_case *c, laws_worst *worst)
{
    static const bool none[ISO_CLOCKS] = {false};
    const iso_effects *e = &c->model.problem.effects;
    const bool ball = c->system == &iso_system_ball;
    const bool acted_on = !iso_effects_are_free(e) || e->on[ISO_LEVEL];
    if (ball ? acted_on : has_image(e)) return;
    const iso_problem bare = {.p = c->model.problem.p, .eps = c->model.problem.eps};
    const iso_model simplest = iso_model_assemble(c->system, &bare, c->system->clock, none);
    double own[ISO_STATE], dy[ISO_MAX_STATE];
    c->system->rhs(&bare, c->y, own);
    c->model.rhs(&c->model, c->y, dy);
    effects_note(c, worst, memcmp(own, dy, sizeof own), 0.5, "rhs");
    if (ball && e->on[ISO_ATTITUDE]) return;
    const bool same =
        c->model.rhs == simplest.rhs && c->model.own_rhs == simplest.rhs && c->model.jacobian == simplest.jacobian;
    effects_note(c, worst, same && c->model.dim == ISO_STATE ? 0 : 1, 0.5, "functions");
}

/* --- Jacobians ------------------------------------------------------------------------------------------------- */

static void check_jacobian(const effects_case *c, const iso_model *m, laws_worst *worst)
{
    enum { DIM = ISO_MAX_STATE };
    const iso_params *p = &m->problem.p;
    const double q = c->system->q(p, c->y, NULL);
    const double rate = iso_clock_rate(p, m->clock, q, NULL) / iso_clock_rate(p, c->system->clock, q, NULL);
    double y[DIM] = {0}, f[DIM], jac[DIM * DIM], column[DIM], size[DIM];
    copy(c->y, y, c->model.dim);
    for (int i = 0; i < DIM * DIM; i++) jac[i] = NAN;
    m->rhs(m, y, f);
    m->jacobian(m, y, jac);
    effects_sizes(c, size);
    for (int i = 0; i < m->dim; i++) size[i] = i < m->moving ? size[i] / rate : f[i];
    for (int j = 0; j < m->dim; j++) {
        const double h = effects_step_of(c, j);
        double direction[DIM] = {0};
        direction[j] = 1;
        laws_slope(effects_rhs, m, m->dim, m->dim, y, direction, h, column);
        for (int i = 0; i < m->dim; i++)
            effects_note(c, worst, fabs(jac[m->dim * i + j] - column[i]), 2 * laws_rounding(p) * size[i] / h,
                         j < 3           ? "d/dfast"
                         : j < ISO_STATE ? "d/dunit"
                                         : "d/dadded");
    }
}

/* The right-hand side stands twice: in ball.c, point.c and contact.c, and in the recurrences of the series
 * (series/recurrences_impl.h). Both give the same values, up to the rounding of their terms. */
static void statements_agree(const effects_case *c, laws_worst *worst)
{
    double dy[ISO_MAX_STATE], other[ISO_MAX_STATE], size[ISO_MAX_STATE];
    c->model.rhs(&c->model, c->y, dy);
    iso_model_rhs_of_recurrences(&c->model, c->y, other);
    effects_sizes(c, size);
    for (int i = 0; i < c->model.moving; i++)
        effects_note(c, worst, fabs(dy[i] - other[i]), 4 * laws_rounding(&c->model.problem.p) * size[i], "value");
}

static void jacobian_own_clock(const effects_case *c, laws_worst *worst)
{
    check_jacobian(c, &c->model, worst);
}

static void jacobian_clocks(const effects_case *c, laws_worst *worst)
{
    for (iso_clock clock = 0; clock < ISO_CLOCKS; clock++)
        for (int asked = 0; asked < 1 << ISO_CLOCKS; asked++) {
            const bool with_clock[ISO_CLOCKS] = {asked & 1, asked & 2, asked & 4};
            const iso_model m = iso_model_assemble(c->system, &c->model.problem, clock, with_clock);
            if (!(asked & 1 << clock)) check_jacobian(c, &m, worst);
        }
}

/* In another clock and with carried clocks the equations are the own ones times the rate of (16), (24). */
static void rhs_clocks(const effects_case *c, laws_worst *worst)
{
    const iso_params *p = &c->model.problem.p;
    const double q = c->system->q(p, c->y, NULL);
    double own[ISO_MAX_STATE], dy[ISO_MAX_STATE], y[ISO_MAX_STATE] = {0};
    copy(c->y, y, c->model.dim);
    c->model.rhs(&c->model, y, own);
    for (iso_clock clock = 0; clock < ISO_CLOCKS; clock++) {
        const iso_model m = iso_model_assemble(c->system, &c->model.problem, clock, (const bool[]){true, true, true});
        const double rate = iso_clock_rate(p, clock, q, NULL),
                     own_rate = iso_clock_rate(p, c->system->clock, q, NULL);
        m.rhs(&m, y, dy);
        for (int i = 0; i < m.moving; i++)
            effects_note(c, worst, fabs(dy[i] - own[i] * own_rate / rate), 8 * DBL_EPSILON * fabs(dy[i]), "state");
        for (int i = 0; i < m.clocks; i++)
            effects_note(c, worst, fabs(dy[m.moving + i] * rate / iso_clock_rate(p, m.clock_of[i], q, NULL) - 1),
                         8 * DBL_EPSILON, "clock");
    }
}

/* --- torques --------------------------------------------------------------------------------------------------- */

typedef struct potential_of {
    const effects_case *c;
    const iso_effect *effect;
    iso_problem alone;
} potential_of;

static void potential(const void *data, const double y[], double U[])
{
    const potential_of *of = data;
    U[0] = iso_effects_potential(&of->alone, y);
}

/* T of U: a turn of the ball about e_i, and all that it moves with it, costs -T_i. */
static void torque_of_potential(const potential_of *of, double h, double T[3])
{
    const iso_model *m = &of->c->model;
    for (int i = 0; i < 3; i++) {
        double y[ISO_MAX_STATE], turn[ISO_MAX_STATE];
        copy(of->c->y, y, m->dim);
        for (int j = 0; j < 3; j++) y[j] = i == j;
        m->rhs(m, y, turn);
        for (int j = 0; j < 3; j++) turn[j] = 0;
        laws_slope(potential, of, 1, m->dim, y, turn, h, &T[i]);
        T[i] = -T[i];
    }
}

/* k n x dU/dn of what depends on n alone */
static void torque_of_gradient(const potential_of *of, double h, double T[3])
{
    double dU[3];
    for (int i = 0; i < 3; i++) {
        double direction[ISO_MAX_STATE] = {0};
        direction[3 + i] = 1;
        laws_slope(potential, of, 1, of->c->model.dim, of->c->y, direction, h, &dU[i]);
    }
    cross(of->c->y + 3, dU, T);
    scale(T, of->c->model.problem.p.k);
}

static void torques_from_potentials(const effects_case *c, laws_worst *worst)
{
    const iso_params *p = &c->model.problem.p;
    const double h = laws_reach(p) / (128 * fmax(1, fabs(p->k)));
    for (int e = 0; e < ISO_EFFECTS; e++) {
        if (!effects_on(c, e) || !iso_effect_list[e]->potential) continue;
        const potential_of of = {c, iso_effect_list[e], effects_alone(c, (iso_effect_id)e)};
        if (e == ISO_GRAVITY && p->k == 1 && !effects_on(c, ISO_ATTITUDE)) continue; /* nobody knows the height */
        const double allowed = 2 * laws_rounding(p) * effects_energy_size(c) / h;
        double T[3], expected[3], dy[ISO_MAX_STATE];
        iso_effects_torque(&of.alone, c->y, T, dy);
        torque_of_potential(&of, h, expected);
        effects_note(c, worst, laws_distance(T, expected), allowed, of.effect->name);
        if (e == ISO_GRAVITY) continue;
        torque_of_gradient(&of, h, expected);
        effects_note(c, worst, laws_distance(T, expected), allowed * fmax(1, fabs(p->k)), "k n x dU/dn");
    }
}

/* The potentials and torques themselves, as section 7 of the theory has them. */
static void written_out(const effects_case *c, laws_worst *worst)
{
    const iso_problem *f = &c->model.problem;
    const iso_effects *e = &f->effects;
    const double *w = c->y, *n = c->y + 3, *up = c->y + f->at[ISO_GRAVITY], g = dot_diag(n, f->p.inv_J, n);
    double sum[3] = {0, 0, 0}, T[3] = {0, 0, 0}, C_n[3], e_n[3], K_w[3], own[3], U = 0;
    for (int i = 0; i < 3; i++) C_n[i] = dot(FIELD_QUADRATIC(e) + 3 * i, n);
    if (e->on[ISO_FIELD]) U += dot(n, C_n) / 2 + dot(FIELD_LINEAR(e), n);
    if (e->on[ISO_LEVEL]) U -= LEVEL_C(e) * pow(g, -1 / f->p.k);
    if (e->on[ISO_GRAVITY] && f->p.k != 1) U += GRAVITY_MGB(e) / (1 - f->p.k) * dot(n, up);
    cross(up, n, e_n);
    if (e->on[ISO_GRAVITY]) add_scaled(T, GRAVITY_MGB(e), e_n);
    if (e->on[ISO_TWIST]) add_scaled(T, -TWIST_RESISTANCE(e) * dot(w, n), n);
    if (e->on[ISO_ROLLING_RESISTANCE]) add_scaled(T, -ROLLING_COEFFICIENT(e), w);
    cross(ROTOR_MOMENTUM(e), w, K_w);
    if (e->on[ISO_ROTOR]) add_scaled(T, 1, K_w);
    if (e->on[ISO_POTENTIAL]) U += effects_potential_of(e, &f->p, n);
    effects_torque_of(e, w, n, up, own);
    if (e->on[ISO_TORQUE]) add_scaled(T, 1, own);
    for (iso_effect_id i = 0; i < ISO_EFFECTS; i++) {
        if (!e->on[i] || i == ISO_FIELD || i == ISO_LEVEL || i == ISO_POTENTIAL) continue;
        const iso_problem alone = effects_alone(c, i);
        double dy[ISO_MAX_STATE];
        iso_effects_torque(&alone, c->y, own, dy);
        add_scaled(sum, 1, own);
    }
    effects_note(c, worst, laws_distance(T, sum),
                 8 * DBL_EPSILON * (effects_torque_size(c) + TWIST_RESISTANCE(e) * norm(w)), "torque");
    if (f->p.k == 1 && e->on[ISO_GRAVITY]) return;
    effects_note(c, worst, fabs(U - iso_effects_potential(f, c->y)), laws_rounding(&f->p) * effects_energy_size(c),
                 "U");
}

/* --- what is refused ------------------------------------------------------------------------------------------- */

static iso_context *ctx;

/* Every subset with its random numbers is fine, and left as it is to rounding. */
static void accepted(const effects_case *c, laws_worst *worst)
{
    iso_effects e = c->model.problem.effects;
    const iso_status status = iso_effects_check(ctx, &c->model.problem.p, c->y, &e);
    effects_note(c, worst, status != ISO_OK, 0.5, "refused");
    for (iso_effect_id i = 0; i < ISO_EFFECTS; i++)
        for (const iso_effect_number *n = iso_effect_list[i]->numbers; n && n->name; n++)
            for (int j = 0; !n->hidden && n->kind != ISO_NUMBER_WORD && j < n->count; j++) {
                const double *old = iso_effect_values(&c->model.problem.effects, i, n);
                const double *new = iso_effect_values(&e, i, n);
                effects_note(c, worst, fabs(new[j] - old[j]), 4 * DBL_EPSILON * fabs(old[j]), n->name);
            }
}

/* The isomorphism is lost with gravity, twist, rolling resistance and a written torque, and with nothing else. */
static void breaking(const effects_case *c, laws_worst *worst)
{
    const iso_effects *e = &c->model.problem.effects;
    const char *expected = e->on[ISO_GRAVITY]              ? "gravity"
                           : e->on[ISO_TWIST]              ? "twist"
                           : e->on[ISO_ROLLING_RESISTANCE] ? "rolling_resistance"
                           : e->on[ISO_TORQUE]             ? "torque"
                                                           : "";
    const iso_effect *first = iso_effects_breaking(e);
    effects_note(c, worst, strcmp(first ? first->name : "", expected), 0.5, "breaking");
}

int main(void)
{
    ctx = iso_context_create();
    effects_hold("states of every subset", NULL, 1, states);
    effects_hold("forces of every subset", NULL, 1, forces);
    effects_hold("starts and sizes of the states", NULL, 1, beginnings);
    effects_hold("what nothing acts on is free, bit for bit", NULL, 1, plain);
    effects_hold("rhs against the recurrences", NULL, 1, statements_agree);
    effects_hold("Jacobian against differences", NULL, 1, jacobian_own_clock);
    effects_hold("Jacobian in every clock, with carried clocks", NULL, tests_length(0, 4), jacobian_clocks);
    effects_hold("right-hand side in every clock", NULL, 1, rhs_clocks);
    effects_hold("torques from potentials", &iso_system_ball, 1, torques_from_potentials);
    effects_hold("torques and potentials written out", &iso_system_ball, 1, written_out);
    effects_hold("every subset is accepted", &iso_system_ball, 1, accepted);
    effects_hold("what breaks the isomorphism", &iso_system_ball, 1, breaking);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

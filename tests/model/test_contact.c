/* The contact that cannot twist, the one that can, and between them; D; what a projection restores. */
#include <float.h>
#include <string.h>

#include "base/random_impl.h"
#include "effects.h"
#include "model/effects/contact_impl.h"
#include "model/model_impl.h"
#include "orbits.h"

/* --- rigid ----------------------------------------------------------------------------------------------------- */

/* Without torques it is the free ball (9), Jacobian and all: also where the contact takes up an effect of nothing. */
static void rigid_is_free(const effects_case *c, laws_worst *worst)
{
    if (c->subset != 0) return;
    const iso_problem *f = &c->model.problem;
    const double none[3] = {0, 0, 0}, bound = 4 * DBL_EPSILON;
    double own[ISO_STATE], dy[ISO_STATE], slope[ISO_STATE * ISO_STATE], jac[ISO_STATE * ISO_STATE] = {0};
    iso_problem nothing = *f;
    double size[ISO_MAX_STATE];
    effects_sizes(c, size);
    iso_system_ball.rhs(f, c->y, own);
    nothing.effects.on[ISO_FIELD] = true;
    memset(nothing.effects.number[ISO_FIELD], 0, sizeof nothing.effects.number[ISO_FIELD]);
    const iso_model m = iso_model_assemble(&iso_system_ball, &nothing, ISO_CLOCK_T, (const bool[ISO_CLOCKS]){false});
    iso_model_slopes(&c->model, c->y, slope);
    iso_contact_rigid(f, c->y, none, dy);
    iso_model_slopes(&m, c->y, jac);
    for (int i = 0; i < ISO_STATE; i++) {
        effects_note(c, worst, fabs(own[i] - dy[i]), bound * size[i], "rhs");
        for (int j = 0; j < ISO_STATE; j++)
            effects_note(c, worst, fabs(slope[ISO_STATE * i + j] - jac[ISO_STATE * i + j]),
                         bound * size[i] / (j < 3 ? norm(c->y) : 1 / sqrt(laws_spread(&f->p))), "slope");
    }
}

static void torque_on(const effects_case *c, double T[3])
{
    for (int i = 0; i < 3; i++) T[i] = c->kinetic * iso_random_normal(c->random);
}

/* J w' = J w x w + T + lambda n with the lambda that keeps (w,n) = 0 */
static void rigid_equation(const effects_case *c, laws_worst *worst)
{
    const iso_problem *f = &c->model.problem;
    double y[ISO_STATE], T[3], dy[ISO_STATE], Jw[3], rest[3], along[3];
    torque_on(c, T);
    copy(c->y, y, ISO_STATE);
    for (int pass = 0; pass < 2; pass++) remove_along(y, y + 3); /* where the ball is free to twist */
    iso_contact_rigid(f, y, T, dy);
    diag(f->p.J, y, Jw);
    cross(y, Jw, rest);
    for (int i = 0; i < 3; i++) rest[i] += f->p.J[i] * dy[i] - T[i];
    cross(rest, y + 3, along);
    const double w = norm(y), forces = max3(f->p.J) * w * w + norm(T), spread = laws_spread(&f->p);
    effects_note(c, worst, norm(along), 8 * DBL_EPSILON * spread * forces, "along n");
    effects_note(c, worst, fabs(dot(dy, y + 3)), 8 * DBL_EPSILON * forces / min3(f->p.J), "(w',n)");
}

/* --- twisting -------------------------------------------------------------------------------------------------- */

static void momentum(const void *params, const double y[], double K[])
{
    const iso_params *p = params;
    diag(p->J, y, K);
    add_scaled(K, -p->D * dot(y, y + 3), y + 3);
}

/* K' = K x w + T by differences of K along the flow, for any spin */
static void twisting_equation(const effects_case *c, laws_worst *worst)
{
    const iso_params *p = &c->model.problem.p;
    double T[3], y[ISO_STATE], dy[ISO_STATE], K[3], K_dot[3], expected[3];
    copy(c->y, y, ISO_STATE);
    add_scaled(y, iso_random_normal(c->random), y + 3);
    torque_on(c, T);
    iso_contact_twisting(&c->model.problem, y, T, dy);
    momentum(p, y, K);
    cross(K, y, expected);
    add_scaled(expected, 1, T);
    const double way = norm(dy) / norm(y) + norm(dy + 3), h = 1 / (128 * way);
    laws_slope(momentum, p, 3, ISO_STATE, y, dy, h, K_dot);
    const double w = norm(y), forces = max3(p->J) * w * w + norm(T), twisting = 1 / (1 - p->D / min3(p->J));
    effects_note(c, worst, laws_distance(K_dot, expected),
                 4 * DBL_EPSILON * (max3(p->J) * w / h + laws_spread(p) * twisting * forces), "K'");
    cross(y + 3, y, K);
    scale(K, p->k);
    effects_note(c, worst, laws_distance(K, dy + 3), 4 * DBL_EPSILON * norm(K), "n'");
}

/* The same ball with a contact of resistance c, turning by the spin that the rigid contact's lambda asks of it. */
static double distance_to_rigid(const effects_case *c, double resistance)
{
    iso_problem f = c->model.problem;
    double y[ISO_MAX_STATE], rigid[ISO_MAX_STATE], twisting[ISO_MAX_STATE], T[3];
    iso_effects_torque(&c->model.problem, c->y, T, y);
    const double lambda = iso_contact_lambda(&c->model.problem, c->y, T);
    f.effects.on[ISO_TWIST] = true;
    TWIST_RESISTANCE(&f.effects) = resistance;
    const iso_model m = iso_model_assemble(&iso_system_ball, &f, ISO_CLOCK_T, (const bool[]){false, false, false});
    copy(c->y, y, ISO_STATE);
    add_scaled(y, -lambda / resistance, y + 3);
    iso_model_begin(&m, y, y);
    if (c->model.problem.at[ISO_ATTITUDE] > 0 && m.problem.p.k == 1) /* the same way, which moves nothing */
        copy(c->y + c->model.problem.at[ISO_ATTITUDE] + 4, y + m.problem.at[ISO_ATTITUDE] + 4, 3);
    c->model.rhs(&c->model, c->y, rigid);
    m.rhs(&m, y, twisting);
    return laws_distance(rigid, twisting);
}

/* c -> infinity: w' tends to that of the rubber ball like 1/c, whatever else acts. */
static void twisting_to_rigid(const effects_case *c, laws_worst *worst)
{
    if (effects_on(c, ISO_TWIST) || laws_spread(&c->model.problem.p) > 3) return;
    const double unit = 1e4 * c->kinetic / norm(c->y);
    double size[ISO_MAX_STATE];
    effects_sizes(c, size);
    const double forces = size[0] / (1 - c->model.problem.p.D / min3(c->model.problem.p.J));
    const double far = distance_to_rigid(c, unit), near = distance_to_rigid(c, 100 * unit);
    const double strong = effects_torque_size(c) / c->kinetic + fabs(c->model.problem.p.k) + 1;
    effects_note(c, worst, far, 1e-3 * forces * strong, "c = 1e4");
    effects_note(c, worst, near, 0.015 * far + 4e6 * DBL_EPSILON * forces, "c = 1e6");
}

/* The rates at which the contact takes spin out, and rolling resistance motion about the axis of the least moment. */
static void stiffness(const effects_case *c, laws_worst *worst)
{
    const iso_problem *f = &c->model.problem;
    const double J = min3(f->p.J), free = 1 - f->p.D / J;
    const double spin =
        effects_on(c, ISO_TWIST) ? TWIST_RESISTANCE(&f->effects) / (J * free) / fmax(1, fabs(f->p.k)) : 0;
    const double most = fmax(spin, effects_on(c, ISO_ROLLING_RESISTANCE) ? ROLLING_COEFFICIENT(&f->effects) / J : 0);
    effects_note(c, worst, fabs(iso_effects_stiffness(f) - most), 8 * DBL_EPSILON / free * most, "stiffness");
}

/* --- D --------------------------------------------------------------------------------------------------------- */

static void bounds_of_D(void)
{
    iso_context *ctx = iso_context_create();
    for (int j = 0; j < LAWS_J; j++) {
        iso_params p = laws_params(-1, laws_J[j]);
        const double least = min3(p.J);
        const double bad[] = {0, -least / 2, NAN, INFINITY, -INFINITY, least, 2 * least, DBL_MIN / 2};
        const double good[] = {least / 2, nextafter(least, 0), DBL_MIN, 1e-9 * least};
        gsl_test(p.D != 0, "a reduced ball has no D");
        for (int i = 0; i < 4; i++)
            gsl_test(iso_params_set_D(ctx, good[i], &p) != ISO_OK || p.D != good[i], "D = %g is accepted", good[i]);
        const iso_params before = p;
        for (int i = 0; i < 8; i++)
            gsl_test(iso_params_set_D(ctx, bad[i], &p) != ISO_BAD_INPUT || strcmp(iso_context_about(ctx), "D") != 0 ||
                         memcmp(&p, &before, sizeof p) != 0,
                     "D = %g is refused, and nothing changed", bad[i]);
    }
    const iso_body body = {1.5, 0.25, {0.02, 0.03, 0.04}, ISO_SHELL, 0.1};
    iso_params p;
    gsl_test(iso_params_physical(ctx, &body, &p) != ISO_OK, "a solid body");
    gsl_test_rel(p.D, 1.5 * 0.25 * 0.25, 2 * DBL_EPSILON, "its D = m b^2");
    iso_context_free(ctx);
}

/* --- projection ------------------------------------------------------------------------------------------------ */

/* A unit vector that was pushed off its length and direction: the direction stays where it was pushed. */
static void note_unit(const effects_case *c, int count, const double pushed[], const double y[], const char *what,
                      laws_worst *worst)
{
    double square = 0, length = 0, turned = 0;
    for (int i = 0; i < count; i++) square += y[i] * y[i], length += pushed[i] * pushed[i];
    for (int i = 0; i < count; i++) turned = fmax(turned, fabs(y[i] - pushed[i] / sqrt(length)));
    effects_note(c, worst, fabs(sqrt(square) - 1), 4 * DBL_EPSILON, what);
    effects_note(c, worst, turned, 4 * DBL_EPSILON, what);
}

/* w after the projection: without spin, by an impulse of the contact, where there is no twist; of the right energy
 * where that is kept and the ball moves enough; else, and in direction always, as it was. */
static void note_omega(const effects_case *c, const iso_model *m, const double pushed[], const double y[],
                       laws_worst *worst)
{
    const iso_problem *f = &m->problem;
    const double eps = laws_rounding(&f->p), spin = dot(pushed, y + 3), size = effects_energy_size(c);
    const bool twisting = effects_on(c, ISO_TWIST);
    double expected[3], u[3], across[3], unused;
    copy(pushed, expected, 3);
    diag(f->p.inv_J, y + 3, u);
    if (!twisting) add_scaled(expected, -spin / dot(y + 3, u), u);
    if (effects_lambda(c) > 0)
        add_scaled(expected, -spin - y[effects_lambda(c)] / TWIST_RESISTANCE(&f->effects), y + 3);
    cross(expected, y, across);
    effects_note(c, worst, norm(across), 16 * DBL_EPSILON * norm(y) * norm(y), "direction of w");
    if (!twisting) effects_note(c, worst, fabs(dot(y, y + 3)), 4 * DBL_EPSILON * norm(y), "(w,n)");
    const double U = iso_effects_potential(f, y), h = iso_system_ball.energy(f, y, &unused);
    const double falling = fmax(fabs(U), iso_effects_strength(f, y));
    const bool keeps = iso_effects_keep_energy(f), fast = h - U > 0.2 * falling, still = h - U < 0.05 * falling;
    if (keeps && fast && f->energy > U) effects_note(c, worst, fabs(h - f->energy), 4 * eps * size, "energy");
    if (!keeps || still) effects_note(c, worst, laws_distance(expected, y), 4 * DBL_EPSILON * norm(y), "w kept");
}

static void project_pushed(const effects_case *c, double push, bool slow, laws_worst *worst)
{
    iso_model m = iso_model_assemble(c->system, &c->model.problem, ISO_CLOCK_T, (const bool[]){true, true, true});
    const int up = m.problem.at[ISO_GRAVITY], Q = m.problem.at[ISO_ATTITUDE], lambda = m.problem.at[ISO_TWIST];
    double y[ISO_MAX_STATE], pushed[ISO_MAX_STATE], again[ISO_MAX_STATE], unused;
    copy(c->y, y, m.moving);
    if (slow) scale(y, 0.01);
    if (slow && lambda > 0) y[lambda] *= 0.01;
    m.problem.energy = iso_system_ball.energy(&m.problem, y, &unused);
    for (int i = m.moving; i < m.dim; i++) y[i] = iso_random_normal(c->random);
    const double w = norm(y);
    for (int i = 0; i < m.moving; i++)
        if (!(Q > 0 && i >= Q + 4) && i != lambda) y[i] += push * iso_random_normal(c->random) * (i < 3 ? w : 1);
    copy(y, pushed, m.dim);
    const double correction = iso_model_project(&m, y);
    note_unit(c, 3, pushed + 3, y + 3, "n", worst);
    if (up > 0) note_unit(c, 3, pushed + up, y + up, "e", worst);
    if (Q > 0) note_unit(c, 4, pushed + Q, y + Q, "Q", worst);
    if (lambda > 0) effects_note(c, worst, fabs(y[lambda] - pushed[lambda]), DBL_MIN, "lambda");
    for (int i = Q > 0 ? Q + 4 : m.moving; i < m.dim; i++)
        effects_note(c, worst, fabs(y[i] - pushed[i]), DBL_MIN, "way and clocks");
    note_omega(c, &m, pushed, y, worst);
    copy(y, again, m.dim);
    iso_model_project(&m, again);
    for (int i = 0; i < m.dim; i++) {
        const double size = i < 3 ? w * effects_energy_size(c) / (slow ? 1e-4 * c->kinetic : c->kinetic) : 1;
        effects_note(c, worst, fabs(again[i] - y[i]), 8 * laws_rounding(&m.problem.p) * size, "again");
    }
    effects_note(c, worst, correction > 0 ? 0 : 1, 0.5, "correction noticed");
}

static void projection(const effects_case *c, laws_worst *worst)
{
    for (double push = 1e-6; push > 1e-11; push /= 100) {
        project_pushed(c, push, false, worst);
        project_pushed(c, push, true, worst);
    }
}

/* Each vector's length alone is off by `push`: so large is the correction. */
static void correction(const effects_case *c, laws_worst *worst)
{
    const double push = 1e-7;
    const int at[] = {3, c->model.problem.at[ISO_GRAVITY], c->model.problem.at[ISO_ATTITUDE]};
    for (int i = 0; i < 3; i++) {
        double y[ISO_MAX_STATE];
        if (at[i] == 0) continue;
        copy(c->y, y, c->model.dim);
        for (int j = 0; j < (i == 2 ? 4 : 3); j++) y[at[i] + j] *= 1 + push;
        const double noticed = iso_model_project(&c->model, y);
        const double others = 16 * laws_rounding(&c->model.problem.p) * effects_energy_size(c) / c->kinetic;
        if (effects_lambda(c) == 0) effects_note(c, worst, fabs(noticed - push), 2 * push * push + others, "length");
    }
}

int main(void)
{
    gsl_test_verbose(1);
    effects_hold("rigid contact without torques is free", &iso_system_ball, 1, rigid_is_free);
    effects_hold("rigid contact: J w' = J w x w + T + lambda n", &iso_system_ball, 1, rigid_equation);
    effects_hold("twisting contact: K' = K x w + T", &iso_system_ball, 1, twisting_equation);
    effects_hold("twisting contact tends to the rigid one", &iso_system_ball, 1, twisting_to_rigid);
    effects_hold("stiffness", &iso_system_ball, 1, stiffness);
    bounds_of_D();
    effects_hold("projection restores, and touches nothing else", &iso_system_ball, 1, projection);
    effects_hold("projection reports its correction", &iso_system_ball, 1, correction);
    exit(gsl_test_summary());
}

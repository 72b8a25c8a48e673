/* effects.h - the cases of the laws of effects: every subset of the effects, with random numbers, on random states.
 *
 * The numbers are of the size that matters: torques and potentials are about as large as the kinetic energy. Bounds
 * are rounding errors relative to the terms that the equations are made of, effects_sizes().
 */
#ifndef ISO_TESTS_EFFECTS_H
#define ISO_TESTS_EFFECTS_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "laws.h"
#include "length.h"
#include "map/state.h"
#include "model/model_impl.h"
#include "numbers.h"
#include "poisson.h"

enum {
    EFFECTS_CLASSICAL =
        1 << ISO_EFFECTS,             /* beside the bits 1 << e of the effects: the resistance of `twist` is 0 ... */
    EFFECTS_STIFF = 2 << ISO_EFFECTS, /* ... or so large that its torque lambda is a state */
    EFFECTS_SUBSETS = 3 << ISO_EFFECTS,
    EFFECTS_WRITTEN = 1 << ISO_POTENTIAL | 1 << ISO_TORQUE
};

typedef struct effects_case {
    const iso_system *system;
    int subset;
    iso_model model;         /* in the system's own clock, no clocks carried            */
    double y[ISO_MAX_STATE]; /* model.problem.energy is its energy                        */
    double kinetic;          /* energy of the ball's motion, without potentials         */
    iso_random *random;
} effects_case;

typedef void effects_law(const effects_case *c, laws_worst *worst);

static inline bool effects_on(const effects_case *c, int e)
{
    return c->model.problem.effects.on[e];
}

/* The place of the torque of a stiff contact in the state; 0: the torque is not a state. */
static inline int effects_lambda(const effects_case *c)
{
    return c->model.problem.at[ISO_TWIST];
}

/* Writes "a+b" for a subset. */
static inline void effects_name(int subset, char *name, size_t size)
{
    int used = 0;
    name[0] = '\0';
    for (int e = 0; e < ISO_EFFECTS && used < (int)size; e++)
        if (subset & 1 << e)
            used += snprintf(name + used, size - (size_t)used, "%s%s", used > 0 ? "+" : "", iso_effect_list[e]->name);
    const char *contact = subset & EFFECTS_STIFF ? "(stiff)" : subset & EFFECTS_CLASSICAL ? "(0)" : "";
    if (used < (int)size) snprintf(name + used, size - (size_t)used, "%s", contact);
}

static inline void effects_note(const effects_case *c, laws_worst *worst, double error, double allowed,
                                const char *what)
{
    char text[112], name[80];
    const bool news = !(error <= worst->ratio * allowed); /* making the name takes longer than the law */
    if (news) effects_name(c->subset, name, sizeof name);
    if (news) snprintf(text, sizeof text, "%s [%s]", what, name);
    laws_note(worst, error, allowed, &c->model.problem.p, news ? text : what);
}

static inline double effects_random_sign(iso_random *r, double low, double high)
{
    const double size = iso_random_uniform(r, low, high);
    return iso_random_uniform(r, -1, 1) < 0 ? -size : size;
}

/* Texts that use all that expressions have, e with gravity alone. Those of a scene are effects_potential_of and
 * effects_torque_of below. */
static inline iso_effects effects_text(bool gravity)
{
    iso_effects e = iso_effects_default();
    iso_written *potential = &e.written[iso_effect_list[ISO_POTENTIAL]->written];
    iso_written *torque = &e.written[iso_effect_list[ISO_TORQUE]->written];
    strcpy(potential->parameter[0], "a"), strcpy(potential->parameter[1], "b");
    strcpy(torque->parameter[0], "a"), strcpy(torque->parameter[1], "c");
    strcpy(potential->expression[0],
           "a*(n1*n2 - n3/2 + J1/J3) + b*(sin(n3)*exp(0.3*n1)/(2.5 - n2) + sqrt(2 + n1)*log(3 + n3^3) - "
           "cos(k/(1 + k^2) + n1)*(1.5 + n2*n3)^1.2/2)");
    strcpy(e.written[iso_effect_list[ISO_INTEGRALS]->written].expression[0], "n1^2 + n2^2 + n3^2"); /* always kept */
    strcpy(torque->expression[0], "-c*omega1 + a*n2^2");
    strcpy(torque->expression[1], gravity ? "a*e2*sin(n1)/3" : "a*sin(n1)/3");
    strcpy(torque->expression[2], "-c*n3*omega3*omega2/sqrt(omega1^2 + omega2^2 + omega3^2)");
    return e;
}

static inline double effects_potential_of(const iso_effects *e, const iso_params *p, const double n[3])
{
    const double a = e->number[ISO_POTENTIAL][0], b = e->number[ISO_POTENTIAL][1], k = p->k;
    return a * (n[0] * n[1] - n[2] / 2 + p->J[0] / p->J[2]) +
           b * (sin(n[2]) * exp(0.3 * n[0]) / (2.5 - n[1]) + sqrt(2 + n[0]) * log(3 + n[2] * n[2] * n[2]) -
                cos(k / (1 + k * k) + n[0]) * pow(1.5 + n[1] * n[2], 1.2) / 2);
}

static inline void effects_torque_of(const iso_effects *e, const double w[3], const double n[3], const double up[3],
                                     double T[3])
{
    const double a = e->number[ISO_TORQUE][0], c = e->number[ISO_TORQUE][1];
    T[0] = -c * w[0] + a * n[1] * n[1];
    T[1] = a * (e->on[ISO_GRAVITY] ? up[1] : 1) * sin(n[0]) / 3;
    T[2] = -c * n[2] * w[2] * w[1] / norm(w);
}

/* Valid numbers for all effects, `energy` and 1/`speed` being the units of energy and time. */
static inline iso_effects effects_random(iso_random *r, const iso_params *p, int subset, double energy, double speed,
                                         double q)
{
    iso_effects e = effects_text(subset & 1 << ISO_GRAVITY);
    double square = 0;
    *e.number[ISO_REACTIONS] = iso_random_uniform(r, -1, 1) < 0;
    for (int i = 0; i < 2; i++) {
        e.number[ISO_POTENTIAL][i] = effects_random_sign(r, 0.3, 1) * energy;
        e.number[ISO_TORQUE][i] = effects_random_sign(r, 0.3, 1) * energy / (i == 0 ? 1 : speed);
    }
    for (int i = 0; i < ISO_EFFECTS; i++) e.on[i] = subset & 1 << i;
    GRAVITY_MGB(&e) = effects_random_sign(r, 0.3, 1) * energy;
    iso_random_direction(r, GRAVITY_UP(&e));
    for (int i = 0; i < 3; i++) {
        FIELD_LINEAR(&e)[i] = iso_random_normal(r) * energy;
        for (int j = 0; j <= i; j++)
            FIELD_QUADRATIC(&e)[3 * i + j] = FIELD_QUADRATIC(&e)[3 * j + i] = iso_random_normal(r) * energy;
    }
    LEVEL_C(&e) = effects_random_sign(r, 0.3, 1) * energy * pow(q, -1 / p->k);
    const double stiff = 50 * fmax(1, fabs(p->k)) * (min3(p->J) - p->D); /* from there on lambda is a state */
    TWIST_RESISTANCE(&e) =
        subset & EFFECTS_CLASSICAL ? 0 : fmin(0.9 * stiff, iso_random_uniform(r, 0.3, 1) * energy / speed);
    if (subset & EFFECTS_STIFF) TWIST_RESISTANCE(&e) = iso_random_uniform(r, 1.1, 1000) * stiff;
    ROLLING_COEFFICIENT(&e) = iso_random_uniform(r, 0.3, 1) * energy / speed;
    for (int i = 0; i < 4; i++)
        QUATERNION(&e)[i] = iso_random_normal(r), square += QUATERNION(&e)[i] * QUATERNION(&e)[i];
    for (int i = 0; i < 4; i++) QUATERNION(&e)[i] /= sqrt(square);
    const bool along = iso_random_uniform(r, -1, 1) < 0; /* an axis of symmetry, where there is one */
    for (int i = 0; i < 3; i++)
        ROTOR_MOMENTUM(&e)[i] = iso_random_normal(r) * (along && !iso_params_symmetric(p, i) ? 0 : energy / speed);
    return e;
}

static inline void effects_set_energy(effects_case *c)
{
    double unused;
    c->model.problem.energy = c->system->energy(&c->model.problem, c->y, &unused);
}

static inline effects_case effects_sample(const iso_system *system, const iso_params *p, int subset, iso_random *r)
{
    static const bool none[ISO_CLOCKS] = {false};
    effects_case c = {.system = system, .subset = subset, .random = r};
    iso_problem f = {.p = *p};
    double start[ISO_STATE];
    laws_sample(system, &f, r, start);
    const bool ball = system == &iso_system_ball;
    if (ball && subset & 1 << ISO_TWIST && !(subset & EFFECTS_STIFF))
        add_scaled(start, effects_random_sign(r, 0.2, 1) * norm(start), start + 3);
    c.kinetic = ball ? iso_ball_energy(p, start) : poisson_hamiltonian(p, start, NULL);
    const double speed = ball ? norm(start) : sqrt(2 * c.kinetic / max3(p->J));
    f.effects = effects_random(r, p, subset, c.kinetic, speed, system->q(p, start, NULL));
    if (ball && subset & EFFECTS_STIFF) { /* hardly any spin is left */
        add_scaled(start, effects_random_sign(r, 0.2, 1) * c.kinetic / TWIST_RESISTANCE(&f.effects), start + 3);
        c.kinetic = iso_ball_energy(p, start); /* about an axis of a large moment the rest can be much */
    }
    c.model = iso_model_assemble(system, &f, system->clock, none);
    iso_model_begin(&c.model, start, c.y);
    for (int i = 0; ball && p->k == 1 && effects_on(&c, ISO_ATTITUDE) && i < 3; i++)
        c.y[c.model.problem.at[ISO_ATTITUDE] + 4 + i] = iso_random_normal(r); /* the ball has come some way */
    effects_set_energy(&c);
    return c;
}

/* Parameters with a mass, that is with some D. */
static inline iso_params effects_params(double k, const double J[3], iso_random *r)
{
    iso_params p = laws_params(k, J);
    iso_context *ctx = iso_context_create();
    const iso_status status = iso_params_set_D(ctx, iso_random_uniform(r, 0.1, 0.9) * min3(J), &p);
    iso_context_free(ctx);
    if (status == ISO_OK) return p;
    gsl_test(1, "D refused");
    exit(gsl_test_summary());
}

/* Of the subsets with effects that a scene writes these: small ones, and one in 24 of the others. None with integrals:
 * they have no equations and no states, and would only double the number of cases. */
static inline bool effects_taken(int subset)
{
    const int others = subset & ~EFFECTS_WRITTEN, below = subset & ((1 << ISO_INTEGRALS) - 1);
    const unsigned number = (unsigned)(subset >> (ISO_INTEGRALS + 1) << ISO_INTEGRALS | below);
    if (subset & 1 << ISO_INTEGRALS) return false;
    return others == subset || (others & (others - 1)) == 0 || (number * 2654435761u >> 16) % 24 == 0;
}

/* One case for every k, J and subset. J_step > 1: not every J; 0: of the J one in turn for each k and subset, and every
 * J where there are no effects. */
static inline void effects_each(const iso_system *system, int J_step, effects_law *law, laws_worst *worst)
{
    iso_random *r = iso_random_create(2007);
    for (int i = 0; i < LAWS_K; i++)
        for (int j = 0; j<LAWS_J; j += J_step> 0 ? J_step : 1)
            for (int subset = 0, turn = i; subset < EFFECTS_SUBSETS; subset++) {
                if (subset >= EFFECTS_CLASSICAL && !(subset & 1 << ISO_TWIST)) continue;
                if (!effects_taken(subset)) continue;
                if (J_step == 0 && subset > 0 && turn++ % LAWS_J != j) continue;
                const iso_params p = effects_params(laws_k[i], laws_J[j], r);
                const effects_case c = effects_sample(system, &p, subset, r);
                law(&c, worst);
            }
    iso_random_free(r);
}

/* Reports one line for each system (NULL: both). J_step 1: every J at full length, at short length one in turn. */
static inline void effects_hold(const char *name, const iso_system *system, int J_step, effects_law *law)
{
    for (int i = 0; iso_systems[i]; i++) {
        if (system && system != iso_systems[i]) continue;
        char title[128];
        laws_worst worst = {0};
        effects_each(iso_systems[i], J_step == 1 ? tests_length(0, 1) : J_step, law, &worst);
        snprintf(title, sizeof title, "%s: %s", iso_systems[i]->name, name);
        laws_report(&worst, title);
    }
}

/* --- how large the terms are ----------------------------------------------------------------------------------- */

/* of the field's U */
static inline double effects_field_size(const iso_effects *e)
{
    double square = dot(FIELD_LINEAR(e), FIELD_LINEAR(e));
    for (int i = 0; i < 9; i++) square += FIELD_QUADRATIC(e)[i] * FIELD_QUADRATIC(e)[i];
    return e->on[ISO_FIELD] ? sqrt(square) : 0;
}

/* of the written U and of its slopes: J1/J3, and the terms of b */
static inline double effects_written_size(const iso_effects *e, const iso_params *p)
{
    const double a = fabs(e->number[ISO_POTENTIAL][0]), b = fabs(e->number[ISO_POTENTIAL][1]);
    return e->on[ISO_POTENTIAL] ? a * (2 + p->J[0] / p->J[2]) + 12 * b : 0;
}

/* The field with one of its effects alone, whose states stay where they are: its own torque and potential. */
static inline iso_problem effects_alone(const effects_case *c, iso_effect_id id)
{
    iso_problem f = c->model.problem;
    for (int e = 0; e < ISO_EFFECTS; e++) f.effects.on[e] = e == (int)id && f.effects.on[e];
    iso_effects_record_motion(&f, false, &f.motion);
    iso_effects_record_energy(&f, &f.energy_formula);
    return f;
}

/* U of one effect */
static inline double effects_potential(const effects_case *c, iso_effect_id id)
{
    const iso_problem f = effects_alone(c, id);
    return effects_on(c, (int)id) ? iso_effects_potential(&f, c->y) : 0;
}

/* of the energy */
static inline double effects_energy_size(const effects_case *c)
{
    const iso_problem *f = &c->model.problem;
    double size = c->kinetic + effects_field_size(&f->effects);
    if (effects_on(c, ISO_LEVEL)) size += fabs(effects_potential(c, ISO_LEVEL));
    size += effects_written_size(&f->effects, &f->p);
    if (effects_on(c, ISO_GRAVITY) && f->p.k != 1) size += fabs(GRAVITY_MGB(&f->effects) / (1 - f->p.k));
    if (effects_on(c, ISO_GRAVITY) && f->p.k == 1 && effects_on(c, ISO_ATTITUDE))
        size += fabs(GRAVITY_MGB(&f->effects)) * norm(c->y + f->at[ISO_ATTITUDE] + 4);
    return size;
}

/* of the torques on the ball */
static inline double effects_torque_size(const effects_case *c)
{
    const iso_effects *e = &c->model.problem.effects;
    const iso_params *p = &c->model.problem.p;
    double size = fabs(p->k) * (effects_field_size(e) + effects_written_size(e, p)), u[3];
    diag(p->inv_J, c->y + 3, u);
    if (e->on[ISO_GRAVITY]) size += fabs(GRAVITY_MGB(e));
    if (e->on[ISO_LEVEL]) size += 2 * fabs(LEVEL_C(e)) * pow(dot(c->y + 3, u), -1 / p->k - 1) * norm(u);
    if (e->on[ISO_TWIST])
        size += effects_lambda(c) > 0 ? fabs(c->y[effects_lambda(c)]) : TWIST_RESISTANCE(e) * norm(c->y);
    if (e->on[ISO_ROLLING_RESISTANCE]) size += ROLLING_COEFFICIENT(e) * norm(c->y);
    if (e->on[ISO_ROTOR]) size += norm(ROTOR_MOMENTUM(e)) * norm(c->y);
    if (e->on[ISO_TORQUE])
        size += 2 * fabs(e->number[ISO_TORQUE][0]) + 2 * fabs(e->number[ISO_TORQUE][1]) * norm(c->y);
    return size;
}

/* of gamma x dV/dgamma: |dq|/q <= 2 sqrt(max J/q) and |B gamma| <= |C| sqrt(max J q); of the rotor's B gamma' */
static inline double effects_image_size(const effects_case *c)
{
    const iso_params *p = &c->model.problem.p;
    const double q = c->system->q(p, c->y, NULL), k = fabs(p->k);
    const double free = 2 * fabs(c->model.problem.eps) / k;
    const iso_effects *e = &c->model.problem.effects;
    const double field = iso_coupling(p, effects_field_size(e) + effects_written_size(e, p)) * (2 + 2 / k);
    const double rotor = e->on[ISO_ROTOR] ? sqrt(p->det_J * max3(p->J)) / (k * k) * norm(ROTOR_MOMENTUM(e)) : 0;
    return (free + field) * pow(q, -1 / p->k) * sqrt(max3(p->J) / q) +
           rotor * pow(q, -1 - 1 / (2 * p->k)) * norm(c->y);
}

/* of each component of y' in the system's own clock */
static inline void effects_sizes(const effects_case *c, double size[ISO_MAX_STATE])
{
    const iso_params *p = &c->model.problem.p;
    const double w = norm(c->y), twisting = effects_on(c, ISO_TWIST) ? 1 / (1 - p->D / min3(p->J)) : 1;
    const bool ball = c->system == &iso_system_ball;
    const double normal_turns = effects_on(c, ISO_TWIST) ? p->D * fabs(p->k) * w * w : 0; /* D s n' of contact.c */
    const double turning = 2 * twisting * (max3(p->J) * w * w + normal_turns + effects_torque_size(c)) / min3(p->J);
    for (int i = 0; i < ISO_MAX_STATE; i++)
        size[i] = i >= ISO_STATE ? w : i >= 3 ? (ball ? fabs(p->k) * w : w) : ball ? turning : effects_image_size(c);
    if (effects_lambda(c) > 0) size[effects_lambda(c)] = TWIST_RESISTANCE(&c->model.problem.effects) * turning;
}

/* A step along the flow of 1/128 of the way on which the equations change much; see laws_step(). */
static inline double effects_step(const effects_case *c)
{
    double size[ISO_MAX_STATE];
    effects_sizes(c, size);
    const double way = fmax(size[0] / norm(c->y), fmax(size[3], norm(c->y)));
    return laws_reach(&c->model.problem.p) / (128 * way);
}

/* The same along one component alone. A twisting contact divides by 1 - D (n,J^-1 n), which has a zero near |n| =
 * 1. */
static inline double effects_step_of(const effects_case *c, int i)
{
    const iso_params *p = &c->model.problem.p;
    const double near = i >= 3 && effects_on(c, ISO_TWIST) ? (1 - p->D / min3(p->J)) / 2 : 1;
    const double reach = laws_reach(p) * near / 128;
    if (i == effects_lambda(c) && i > 0) return c->kinetic / 128;
    return i < 3 ? reach * norm(c->y) : i < ISO_STATE ? reach : 1.0 / 128;
}

static inline void effects_rhs(const void *model, const double y[], double dy[])
{
    const iso_model *m = model;
    m->rhs(m, y, dy);
}

#endif

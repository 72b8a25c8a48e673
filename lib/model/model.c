#include "model/model.h"

#include <math.h>

#include "base/vec3_impl.h"
#include "model/contact_impl.h"
#include "model/effects_impl.h"

/* --- in the system's own clock ------------------------------------------------------------------------------------- */

static void free_rhs(const iso_model *m, const double y[], double dy[])
{
    m->system->rhs(&m->field, y, dy);
}

static void free_jacobian(const iso_model *m, const double y[], double jac[])
{
    m->system->jacobian(&m->field, y, jac);
}

static void follow(const iso_model *m, const double y[], double dy[])
{
    for (int i = 0; i < m->followers; i++) m->follower[i]->rates(&m->field, y, dy);
}

static void free_rhs_followed(const iso_model *m, const double y[], double dy[])
{
    m->system->rhs(&m->field, y, dy);
    follow(m, y, dy);
}

static void ball_rhs(const iso_model *m, const double y[], double dy[])
{
    double T[3] = {0, 0, 0};
    for (int i = 0; i < m->forces; i++) m->force[i]->torque(&m->field, y, T);
    m->contact->solve(&m->field, y, T, dy);
    follow(m, y, dy);
}

static void point_rhs(const iso_model *m, const double y[], double dy[])
{
    m->system->rhs(&m->field, y, dy);
    for (int i = 0; i < m->forces; i++) m->force[i]->image(&m->field, y, dy);
}

static void set_zero(const iso_model *m, double jac[])
{
    for (int i = 0; i < m->moving * m->moving; i++) jac[i] = 0;
}

static void ball_jacobian(const iso_model *m, const double y[], double jac[])
{
    double T[3] = {0, 0, 0}, dy[ISO_MAX_STATE];
    set_zero(m, jac);
    for (int i = 0; i < m->forces; i++) {
        m->force[i]->torque(&m->field, y, T);
        m->force[i]->torque_slope(&m->field, y, m->moving, jac);
    }
    m->contact->solve(&m->field, y, T, dy);
    m->contact->slope(&m->field, y, T, m->moving, jac);
    for (int i = 0; i < m->followers; i++) m->follower[i]->rates_slope(&m->field, y, dy, m->moving, jac);
}

static void free_jacobian_followed(const iso_model *m, const double y[], double jac[])
{
    double six[ISO_STATE * ISO_STATE], dy[ISO_MAX_STATE];
    set_zero(m, jac);
    m->system->rhs(&m->field, y, dy);
    m->system->jacobian(&m->field, y, six);
    for (int i = 0; i < ISO_STATE; i++) copy(six + ISO_STATE * i, jac + m->moving * i, ISO_STATE);
    for (int i = 0; i < m->followers; i++) m->follower[i]->rates_slope(&m->field, y, dy, m->moving, jac);
}

static void point_jacobian(const iso_model *m, const double y[], double jac[])
{
    m->system->jacobian(&m->field, y, jac);
    for (int i = 0; i < m->forces; i++) m->force[i]->image_slope(&m->field, y, m->moving, jac);
}

/* --- in another clock, with clocks carried ------------------------------------------------------------------------- */

/* d(clock)/d(independent variable) at q, and the exponent of q in it */
static double rate(const iso_model *m, iso_clock clock, double q, double *exponent)
{
    double e, e_independent;
    const double numerator = iso_clock_rate(&m->field.p, clock, q, &e);
    const double denominator = iso_clock_rate(&m->field.p, m->clock, q, &e_independent);
    *exponent = e - e_independent;
    return numerator / denominator;
}

static void rhs_clocks(const iso_model *m, const double y[], double dy[])
{
    double exponent;
    const double q = m->system->q(&m->field.p, y, NULL);
    m->own_rhs(m, y, dy);
    if (m->clock != m->system->clock) {
        const double r = rate(m, m->system->clock, q, &exponent);
        for (int i = 0; i < m->moving; i++) dy[i] *= r;
    }
    for (int c = 0; c < m->carried; c++) dy[m->moving + c] = rate(m, m->carry[c], q, &exponent);
}

/* With r = r(q) ~ q^e:  d(r f_i)/dy_j = r df_i/dy_j + f_i (e r/q) dq/dy_j, and the last term alone for a clock. */
static void jacobian_clocks(const iso_model *m, const double y[], double jac[])
{
    double f[ISO_MAX_STATE], own[ISO_MAX_STATE * ISO_MAX_STATE], dq[ISO_MAX_STATE] = {0}, exponent;
    const double q = m->system->q(&m->field.p, y, dq);
    m->own_rhs(m, y, f);
    m->own_jacobian(m, y, own);
    for (int i = 0; i < m->dim * m->dim; i++) jac[i] = 0;
    const double r = rate(m, m->system->clock, q, &exponent);
    for (int i = 0; i < m->moving; i++)
        for (int j = 0; j < m->moving; j++)
            jac[m->dim * i + j] = r * (own[m->moving * i + j] + f[i] * exponent / q * dq[j]);
    for (int c = 0; c < m->carried; c++) {
        const double r_c = rate(m, m->carry[c], q, &exponent);
        for (int j = 0; j < m->moving; j++) jac[m->dim * (m->moving + c) + j] = r_c * exponent / q * dq[j];
    }
}

/* --- assembling ----------------------------------------------------------------------------------------------------- */

/* The effects that act, and those that have states. */
static void add_effects(iso_model *m)
{
    const bool ball = m->system == &iso_system_ball;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_row(&m->field, e);
        m->field.at[e] = 0;
        if (!m->field.effects.on[e]) continue;
        if (ball ? effect->torque != NULL : effect->image != NULL) m->force[m->forces++] = effect;
        if (!ball || !effect->states) continue;
        m->field.at[e] = m->moving;
        m->moving += effect->states(&m->field);
        m->follower[m->followers++] = effect;
    }
}

/* The plainest functions that do it. */
static void choose_equations(iso_model *m)
{
    const bool ball = m->system == &iso_system_ball;
    m->own_rhs = free_rhs;
    m->own_jacobian = free_jacobian;
    if (ball && m->followers > 0) m->own_rhs = free_rhs_followed, m->own_jacobian = free_jacobian_followed;
    if (ball && (m->forces > 0 || m->contact == &iso_contact_loose))
        m->own_rhs = ball_rhs, m->own_jacobian = ball_jacobian;
    if (!ball && m->forces > 0) m->own_rhs = point_rhs, m->own_jacobian = point_jacobian;
}

iso_model iso_model_assemble(const iso_system *system, const iso_field *field, iso_clock clock,
                             const bool carry[ISO_CLOCKS])
{
    iso_model m = {.system = system, .field = *field, .clock = clock, .moving = ISO_STATE};
    add_effects(&m);
    m.contact = iso_contact_of(&m.field);
    choose_equations(&m);
    for (iso_clock c = 0; c < ISO_CLOCKS; c++)
        if (carry[c] && c != clock) m.carry[m.carried++] = c;
    m.dim = m.moving + m.carried;
    const bool plain = clock == system->clock && m.carried == 0;
    m.rhs = plain ? m.own_rhs : rhs_clocks;
    m.jacobian = plain ? m.own_jacobian : jacobian_clocks;
    return m;
}

void iso_model_begin(const iso_model *m, const double start[ISO_STATE], double y[])
{
    copy(start, y, ISO_STATE);
    for (int i = 0; i < m->followers; i++) m->follower[i]->begin(&m->field, y);
    for (int i = m->moving; i < m->dim; i++) y[i] = 0;
}

const char *iso_model_state_name(const iso_model *m, int i, const char **reason)
{
    *reason = "";
    if (i < ISO_STATE) return m->system->state[i];
    *reason = "clock: a column, or the effect clock, asks for it";
    if (i >= m->moving) return iso_clock_name(m->carry[i - m->moving]);
    iso_effect_id last = ISO_GRAVITY;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        if (m->field.at[e] > 0 && m->field.at[e] <= i) last = e;
    const iso_effect *effect = iso_effect_row(&m->field, last);
    *reason = effect->states_doc;
    return effect->state[i - m->field.at[last]];
}

/* --- sizes ---------------------------------------------------------------------------------------------------------- */

double iso_model_project(const iso_model *m, double y[])
{
    double correction = 0;
    if (m->followers == 0) return m->system->project(&m->field, y);
    for (int i = 0; i < m->followers; i++) /* first: the energy of the ball may ask for the vertical */
        correction = fmax(correction, m->follower[i]->restore(&m->field, y));
    return fmax(correction, m->system->project(&m->field, y));
}

void iso_model_size(const iso_model *m, const double y[], double size[])
{
    /* a state at rest has no size: any positive number does, since nothing moves */
    const double speed = fmax(m->system->speed(&m->field, y), ISO_REST);
    const double length = norm(y + 3);
    for (int i = 0; i < 3; i++) {
        size[i] = speed;
        size[3 + i] = length;
    }
    for (int i = 0; i < m->followers; i++) m->follower[i]->size(&m->field, y, size);
    if (m->carried == 0) return;
    const double q = m->system->q(&m->field.p, y, NULL);
    for (int c = 0; c < m->carried; c++) {
        double exponent;
        size[m->moving + c] = fabs(y[m->moving + c]) + rate(m, m->carry[c], q, &exponent);
    }
}

/* model.c - puts the equations of one orbit together: the system, its effects, the clock it runs in, other clocks.
 * The model calls the plainest functions that do it: a free ball in its own time costs no look at effects or clocks.
 */
#include "model/model_impl.h"

#include <math.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "model/effects/contact_impl.h"
#include "model/formula/formula_lines_impl.h"

_Static_assert(ISO_MAX_STATE <= 256, "a formula holds places in y in uint8_t");

/* --- in the system's own clock ---------------------------------------------------------------------------------- */

static void free_rhs(const iso_model *m, const double y[], double dy[])
{
    m->system->rhs(&m->problem, y, dy);
}

/* Effects with states, and without a torque. */
static void free_rhs_followed(const iso_model *m, const double y[], double dy[])
{
    double T[3];
    m->system->rhs(&m->problem, y, dy);
    iso_effects_torque(&m->problem, y, T, dy);
}

static void ball_rhs(const iso_model *m, const double y[], double dy[])
{
    double T[3];
    iso_effects_torque(&m->problem, y, T, dy);
    m->contact(&m->problem, y, T, dy);
    if (m->problem.motion.late) iso_formula_late_rates(&m->problem.motion, &m->problem.p, y, dy);
}

static void point_rhs(const iso_model *m, const double y[], double dy[])
{
    double gamma_dV[3];
    m->system->rhs(&m->problem, y, dy);
    const iso_image image = iso_formula_image(&m->problem.energy_formula, &m->problem.p, y);
    cross(y + 3, image.gradient, gamma_dV);
    add_scaled(dy, 1, gamma_dV);
    add_scaled(dy, image.magnetic, dy + 3);
}

/* --- in another clock, with other clocks as states -------------------------------------------------------------- */

/* d(clock)/d(independent variable) at q, and the exponent of q in this rate */
static double rate(const iso_model *m, iso_clock clock, double q, double *exponent)
{
    double e, e_independent;
    const double numerator = iso_clock_rate(&m->problem.p, clock, q, &e);
    const double denominator = iso_clock_rate(&m->problem.p, m->clock, q, &e_independent);
    *exponent = e - e_independent;
    return numerator / denominator;
}

static void rhs_clocks(const iso_model *m, const double y[], double dy[])
{
    double exponent;
    const double q = m->system->q(&m->problem.p, y, NULL);
    m->own_rhs(m, y, dy);
    if (m->clock != m->system->clock) {
        const double r = rate(m, m->system->clock, q, &exponent);
        for (int i = 0; i < m->moving; i++) dy[i] *= r;
    }
    for (int c = 0; c < m->clocks; c++) dy[m->moving + c] = rate(m, m->clock_of[c], q, &exponent);
}

/* With r = r(q) ~ q^e:  d(r f_i)/dy_j = r df_i/dy_j + f_i (e r/q) dq/dy_j, and the last term alone for a clock. */
static void jacobian_clocks(const iso_model *m, const double y[], double jac[])
{
    double f[ISO_MAX_STATE], own[ISO_MAX_STATE * ISO_MAX_STATE], dq[ISO_MAX_STATE] = {0}, exponent;
    const double q = m->system->q(&m->problem.p, y, dq);
    m->own_rhs(m, y, f);
    iso_model_slopes(m, y, own);
    for (int i = 0; i < m->dim * m->dim; i++) jac[i] = 0;
    const double r = rate(m, m->system->clock, q, &exponent);
    for (int i = 0; i < m->moving; i++)
        for (int j = 0; j < m->moving; j++)
            jac[m->dim * i + j] = r * (own[m->moving * i + j] + f[i] * exponent / q * dq[j]);
    for (int c = 0; c < m->clocks; c++) {
        const double r_c = rate(m, m->clock_of[c], q, &exponent);
        for (int j = 0; j < m->moving; j++) jac[m->dim * (m->moving + c) + j] = r_c * exponent / q * dq[j];
    }
}

/* --- assembling ------------------------------------------------------------------------------------------------- */

/* Series have formulas in the place of derived states. These may be longer than what other methods compute. */
static bool series_overrun(const iso_model *m)
{
    iso_formula series = {.overrun = false};
    for (int i = 0; i < m->with_states_count; i++)
        if (m->with_states[i]->states->kind == ISO_STATE_DERIVED) {
            iso_effects_record_motion(&m->problem, true, &series);
            break;
        }
    return series.overrun || series.wrong;
}

/* Writes down the equations of the effects that act, or have states. */
static void record(iso_model *m)
{
    iso_problem *f = &m->problem;
    iso_formula_begin(&f->motion, ISO_FORMULA_NONE, false);
    iso_formula_begin(&f->energy_formula, ISO_FORMULA_NONE, false);
    if (iso_effects_none(&f->effects) || m->moving > ISO_STATE + ISO_MOST_EFFECT_STATES) return;
    if (m->system == &iso_system_ball) {
        iso_effects_record_motion(f, false, &f->motion);
        f->motion.overrun = f->motion.overrun || series_overrun(m);
        iso_effects_record_energy(f, &f->energy_formula);
    } else {
        iso_effects_record_image(f, &f->energy_formula);
    }
}

/* The plainest function that does it. A late rate needs omega', which only ball_rhs has. */
static void choose_equations(iso_model *m)
{
    const iso_formula *motion = &m->problem.motion;
    if (m->system != &iso_system_ball)
        m->own_rhs = m->problem.energy_formula.lines > 0 ? point_rhs : free_rhs;
    else if (motion->torques || m->without_formula || motion->late || m->contact == iso_contact_twisting)
        m->own_rhs = ball_rhs;
    else
        m->own_rhs = m->with_states_count > 0 ? free_rhs_followed : free_rhs;
}

const char *iso_model_too_large(const iso_model *m)
{
    const iso_problem *f = &m->problem;
    if (m->moving > ISO_STATE + ISO_MOST_EFFECT_STATES) return "the effects have more states than there is room for";
    if (m->system == &iso_system_point && f->energy_formula.overrun)
        return "the images of the effects on the point have more lines than there is room for (formula.h): take the "
               "backend ball";
    if (f->motion.overrun || f->energy_formula.overrun)
        return "the equations of the effects have more lines than there is room for (formula.h)";
    return f->motion.wrong ? f->motion.wrong : f->energy_formula.wrong;
}

void iso_model_complete(iso_model *m, const iso_system *system, iso_clock clock, const bool with_clock[ISO_CLOCKS])
{
    m->system = system;
    m->clock = clock;
    m->moving = ISO_STATE;
    m->with_states_count = m->clocks = 0;
    memset(m->problem.at, 0, sizeof m->problem.at);
    if (system == &iso_system_ball) m->moving = iso_effects_place_states(&m->problem);
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        if (m->problem.at[e] > 0) m->with_states[m->with_states_count++] = iso_effect_list[e];
    record(m);
    m->without_formula = system == &iso_system_ball ? iso_effects_without_formula(&m->problem.effects) : NULL;
    m->contact = iso_effects_twist(&m->problem.effects) ? iso_contact_twisting : iso_contact_rigid;
    choose_equations(m);
    for (iso_clock c = 0; c < ISO_CLOCKS; c++)
        if (with_clock[c] && c != clock) m->clock_of[m->clocks++] = c;
    m->dim = m->moving + m->clocks;
    const bool plain = clock == system->clock && m->clocks == 0;
    m->rhs = plain ? m->own_rhs : rhs_clocks;
    m->jacobian = plain ? iso_model_slopes : jacobian_clocks;
}

iso_model iso_model_assemble(const iso_system *system, const iso_problem *problem, iso_clock clock,
                             const bool with_clock[ISO_CLOCKS])
{
    iso_model m = {.problem = *problem};
    iso_model_complete(&m, system, clock, with_clock);
    return m;
}

void iso_model_begin(const iso_model *m, const double start[ISO_STATE], double y[])
{
    copy(start, y, ISO_STATE);
    for (int i = 0; i < m->with_states_count; i++)
        if (m->with_states[i]->begin) m->with_states[i]->begin(&m->problem, y);
    for (int i = m->moving; i < m->dim; i++) y[i] = 0;
}

const char *iso_model_state_name(const iso_model *m, int i, const char **reason)
{
    *reason = "";
    if (i < ISO_STATE) return m->system->state[i];
    *reason = "clock: a column, or the effect clock, asks for it";
    if (i >= m->moving) return iso_clock_name(m->clock_of[i - m->moving]);
    iso_effect_id effect;
    int in_group;
    const iso_effect_state *s = iso_effects_state_at(&m->problem, i, &effect, &in_group);
    *reason = iso_effect_list[effect]->states_doc;
    return s->name[in_group];
}

/* --- sizes ------------------------------------------------------------------------------------------------------ */

/* Makes unit vectors of the states that are, and restores the effect's other constraints; the largest correction. */
static double restore_states(const iso_problem *f, iso_effect_id id, double y[])
{
    const iso_effect *effect = iso_effect_list[id];
    double correction = 0, *x = y + f->at[id];
    for (const iso_effect_state *s = effect->states; s->name; s++) {
        if (s->there && !s->there(f)) continue;
        double square = 0;
        for (int i = 0; i < s->count; i++) square += x[i] * x[i];
        const double length = sqrt(square);
        for (int i = 0; s->kind == ISO_STATE_UNIT && i < s->count; i++) x[i] /= length;
        if (s->kind == ISO_STATE_UNIT) correction = fmax(correction, fabs(length - 1));
        x += s->count;
    }
    return effect->restore ? fmax(correction, effect->restore(f, y)) : correction;
}

double iso_model_project(const iso_model *m, double y[])
{
    double correction = 0;
    if (m->with_states_count == 0) return m->system->project(&m->problem, y);
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) /* first: the energy of the ball may ask for the vertical */
        if (m->problem.at[e] > 0) correction = fmax(correction, restore_states(&m->problem, e, y));
    return fmax(correction, m->system->project(&m->problem, y));
}

void iso_model_size(const iso_model *m, const double y[], double size[])
{
    /* a state at rest has no size: any positive number does, since nothing moves */
    const double speed = fmax(m->system->speed(&m->problem, y), ISO_REST);
    const double length = norm(y + 3);
    for (int i = 0; i < 3; i++) {
        size[i] = speed;
        size[3 + i] = length;
    }
    for (int i = ISO_STATE; i < m->moving; i++) size[i] = 1 + fabs(y[i]);
    for (int i = 0; i < m->with_states_count; i++)
        if (m->with_states[i]->size) m->with_states[i]->size(&m->problem, y, size);
    if (m->clocks == 0) return;
    const double q = m->system->q(&m->problem.p, y, NULL);
    for (int c = 0; c < m->clocks; c++) {
        double exponent;
        size[m->moving + c] = fabs(y[m->moving + c]) + rate(m, m->clock_of[c], q, &exponent);
    }
}

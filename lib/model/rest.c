/* rest.c - where a motion ends: the ball at rest, the ball that resistance drives backwards in time, or a torque
 * forwards, and the constraint that is lost while the motion dies away. See model_impl.h.
 *
 * Resistance takes motion out at the rate iso_effects_stiffness() > 0. Only the ball has resistance: it breaks the
 * isomorphism, so that no point has any.
 */
#include "model/model_impl.h"

#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"

static bool is_resisted(const iso_model *m)
{
    return m->system == &iso_system_ball && iso_effects_stiffness(&m->problem) > 0;
}

bool iso_model_at_rest(const iso_model *m, const double y[])
{
    return m->system == &iso_system_ball && iso_effects_at_rest(&m->problem, y);
}

/* The derivatives of a state at rest are constant, so y + dt f(y) is exact. omega, which is below the bound of
 * rest, becomes 0, and with it the states that follow from it. */
void iso_model_rest(const iso_model *m, double dt, double y[])
{
    double f[ISO_MAX_STATE];
    for (int i = 0; i < 3; i++) y[i] = 0;
    for (int i = 0; i < m->with_states_count; i++)
        if (iso_effect_is_derived(m->with_states[i])) m->with_states[i]->begin(&m->problem, y);
    m->rhs(m, y, f);
    for (int i = 0; i < m->dim; i++) y[i] += dt * f[i];
}

/* A ball that turns this many times as fast as at the start soon needs more steps than can ever be taken. */
enum { MOST_GROWTH = 10000 };

/* The first effect that may give the ball energy without end; NULL: none. */
static const iso_effect *driving(const iso_model *m, int direction)
{
    const iso_problem *f = &m->problem;
    for (iso_effect_id e = 0; e < ISO_EFFECTS && m->system == &iso_system_ball; e++) {
        const iso_effect *effect = iso_effect_list[e];
        if (!iso_effect_acts(&f->effects, e) || !effect->drives) continue;
        const iso_work work = effect->work(f);
        if (work == ISO_WORK_UNKNOWN || (work == ISO_WORK_LOST && direction < 0)) return effect;
    }
    return NULL;
}

/* Whether the torques drive the ball in y, and would do so if it turned faster: nothing is in sight that ends it. */
static bool is_driven(const iso_model *m, int direction, const double y[])
{
    double faster[ISO_MAX_STATE], T[3], dy[ISO_MAX_STATE];
    copy(y, faster, m->dim);
    for (int i = 0; i <= 6; i++) {
        iso_effects_torque(&m->problem, faster, T, dy);
        if (direction * dot(T, faster) <= 0) return false;
        scale(faster, 10);
    }
    return true;
}

double iso_model_fast(const iso_model *m, int direction, const double y0[])
{
    const bool resisted = direction < 0 && is_resisted(m);
    if (iso_effects_none(&m->problem.effects) || (!resisted && !driving(m, direction))) return INFINITY;
    return MOST_GROWTH * m->system->speed(&m->problem, y0);
}

const char *iso_model_speeds_up(const iso_model *m, int direction, const double y0[], const double y[])
{
    if (!(m->system->speed(&m->problem, y) > iso_model_fast(m, direction, y0))) return NULL;
    if (direction < 0 && is_resisted(m))
        return "backwards in time resistance drives the ball, without end: it turns more than 10000 times as fast as "
               "at the start";
    return is_driven(m, direction, y) ? driving(m, direction)->drives : NULL;
}

/* By how much the constraint of the contact is broken, in units of omega:
 *
 *     it cannot twist            (omega, n) = 0
 *     it twists, and is stiff    that of its state, which the effect restores
 *     it twists, not stiff       none: (omega, n) is free
 *
 * An error of this constraint is motion that resistance does not take out. */
static double broken(const iso_model *m, const double y[])
{
    const double speed = m->system->speed(&m->problem, y);
    double restored[ISO_MAX_STATE];
    if (!iso_effects_twist(&m->problem.effects)) return fabs(dot(y, y + 3)) / speed;
    copy(y, restored, m->dim);
    for (int i = 0; i < m->with_states_count; i++)
        if (m->with_states[i]->restore) m->with_states[i]->restore(&m->problem, restored);
    return fabs(dot(restored, y + 3) - dot(y, y + 3)) / speed;
}

const char *iso_model_lost(const iso_model *m, const double y[], double tolerance)
{
    if (!is_resisted(m) || !(broken(m, y) > fmax(1e-3, 1e4 * tolerance))) return NULL;
    return "it does not keep (omega,n) = 0, and little else is left of omega: take a method with projection";
}

/* rest.c - where a motion ends: the ball at rest, the ball that resistance drives backwards in time, and the
 * constraint that is lost while the motion dies away. See model_impl.h.
 *
 * Resistance takes motion out at the rate iso_effects_stiffness() > 0. Only the ball has resistance: it breaks the
 * isomorphism, so that no point has any.
 */
#include "model/model_impl.h"

#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects_impl.h"

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
    for (int i = 0; i < m->followers; i++)
        if (iso_effect_is_derived(m->follower[i])) m->follower[i]->begin(&m->problem, y);
    m->rhs(m, y, f);
    for (int i = 0; i < m->dim; i++) y[i] += dt * f[i];
}

/* A ball that turns this many times as fast as at the start soon needs more steps than can ever be taken. */
enum { MOST_GROWTH = 10000 };

const char *iso_model_speeds_up(const iso_model *m, const double y0[], const double y[])
{
    if (!is_resisted(m)) return NULL;
    const double before = m->system->speed(&m->problem, y0), now = m->system->speed(&m->problem, y);
    if (now <= MOST_GROWTH * before) return NULL;
    return "backwards in time resistance drives the ball, without end: it turns more than 10000 times as fast as at "
           "the start";
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
    for (int i = 0; i < m->followers; i++)
        if (m->follower[i]->restore) m->follower[i]->restore(&m->problem, restored);
    return fabs(dot(restored, y + 3) - dot(y, y + 3)) / speed;
}

const char *iso_model_lost(const iso_model *m, const double y[], double tolerance)
{
    if (!is_resisted(m) || !(broken(m, y) > fmax(1e-3, 1e4 * tolerance))) return NULL;
    return "it does not keep (omega,n) = 0, and little else is left of omega: take a method with projection";
}

/* rest.c - where a motion ends: the ball at rest, the ball that resistance drives backwards in time, and the
 * constraint that is lost while the motion dies away. See rest_impl.h.
 *
 * Resistance takes motion out at the rate iso_effects_stiffness() > 0. Only the ball has resistance: it breaks the
 * isomorphism, so that no point has any.
 */
#include "model/rest_impl.h"

#include <math.h>

#include "base/vec3_impl.h"

static bool is_resisted(const iso_model *m)
{
    return m->system == &iso_system_ball && iso_effects_stiffness(&m->field) > 0;
}

bool iso_model_at_rest(const iso_model *m, const double y[])
{
    return m->system == &iso_system_ball && iso_effects_at_rest(&m->field, y);
}

/* The derivatives of a state at rest are constant, so y + dt f(y) is exact. omega and the torque lambda of a stiff
 * contact, both below the bound of rest, become 0. */
void iso_model_rest(const iso_model *m, double dt, double y[])
{
    double f[ISO_MAX_STATE];
    const int lambda = m->field.at[ISO_TWIST];
    for (int i = 0; i < 3; i++) y[i] = 0;
    if (lambda > 0) y[lambda] = 0;
    m->rhs(m, y, f);
    for (int i = 0; i < m->dim; i++) y[i] += dt * f[i];
}

/* A ball that turns this many times as fast as at the start soon needs more steps than can ever be taken. */
enum { MOST_GROWTH = 10000 };

const char *iso_model_speeds_up(const iso_model *m, const double y0[], const double y[])
{
    if (!is_resisted(m)) return NULL;
    const double before = m->system->speed(&m->field, y0), now = m->system->speed(&m->field, y);
    if (now <= MOST_GROWTH * before) return NULL;
    return "backwards in time resistance drives the ball, without end: "
           "it turns more than 10000 times as fast as at the start";
}

/* Constraint of the contact:
 *
 *     it cannot twist            (omega, n) = 0
 *     it resists, and is stiff   (omega, n) = -lambda/c
 *     it resists, not stiff      none: (omega, n) is free
 *
 * An error of this constraint is motion that resistance does not take out. */
const char *iso_model_lost(const iso_model *m, const double y[], double tolerance)
{
    const iso_field *f = &m->field;
    const bool twists = f->effects.on[ISO_TWIST], stiff = f->at[ISO_TWIST] > 0;
    if (!is_resisted(m) || (twists && !stiff)) return NULL;
    const double lost = dot(y, y + 3) + (stiff ? y[f->at[ISO_TWIST]] / f->effects.twist : 0);
    const double may = fmax(1e-3, 1e4 * tolerance) * m->system->speed(f, y);
    if (!(fabs(lost) > may)) return NULL;
    return "it does not keep (omega,n) = 0, and little else is left of omega: take a method with projection";
}

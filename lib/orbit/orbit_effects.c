/* orbit_effects.c - what effects add to the samples of an orbit: own units to the caller's, and back. */
#include <float.h>
#include <math.h>

#include "base/vec3_impl.h"
#include "model/attitude_impl.h"
#include "model/reactions.h"
#include "orbit/orbit_impl.h"

/* The radius of the fixed sphere in units of |b|, never negative. */
static double radius_a(const iso_params *p)
{
    return iso_params_sign_of_radius(p) * p->k / (1 - p->k);
}

/* The contact goes round the fixed sphere at a R n; on a plane it goes with the centre, b x. */
static void sample_attitude(const iso_orbit *o, const double y[], iso_sample *s)
{
    const iso_field *f = &o->model.field;
    const double *n = y + 3, *Q = y + f->at[ISO_ATTITUDE], b = iso_params_sign_of_radius(&f->p);
    double space_n[3];
    copy(Q, s->quaternion, 4);
    iso_turn_to_space(Q, n, space_n);
    for (int i = 0; i < 3; i++) {
        s->contact[i] = o->length * (f->p.k == 1 ? iso_way(f, y)[i] : radius_a(&f->p) * space_n[i]);
        s->trace[i] = -o->length * b * n[i];
        s->centre[i] = s->contact[i] + o->length * b * space_n[i];
    }
}

static void sample_reactions(const iso_orbit *o, const double y[], iso_sample *s)
{
    const iso_reactions r = iso_reactions_at(&o->model.field, y);
    const double torque = iso_unit(&o->units, iso_dimension_h), force = torque / o->length;
    for (int i = 0; i < 3; i++) s->force[i] = r.force[i] * force;
    s->pressure = r.pressure * force;
    s->friction = r.friction * force;
    s->mu = fmin(r.needed, DBL_MAX); /* where contact is lost the pressure may be 0 */
    s->lambda = r.twist * torque;
}

iso_status iso_orbit_sample_effects(const iso_orbit *o, const double y[], iso_sample *s)
{
    const iso_field *f = &o->model.field;
    if (f->effects.on[ISO_GRAVITY]) copy(y + f->at[ISO_GRAVITY], s->vertical, 3);
    if (f->effects.on[ISO_ATTITUDE]) sample_attitude(o, y, s);
    if (f->effects.on[ISO_REACTIONS]) sample_reactions(o, y, s);
    for (int c = ISO_COLUMN_EFFECTS; c < ISO_TRAJECTORY_COLUMNS; c++)
        if (f->effects.on[iso_column_effect(c)] && !isfinite(iso_sample_column(s, c)))
            return iso_context_fail(
                o->ctx, ISO_NUMERICAL, "",
                "%s is out of the range of doubles in these units: use other units of mass, length or time",
                iso_trajectory_columns[c]);
    return ISO_OK;
}

void iso_orbit_state_of(const iso_orbit *o, const iso_system *system, const iso_sample *s, double y[])
{
    const iso_field *f = &o->model.field;
    const bool ball = system == &iso_system_ball;
    copy(ball ? s->ball : s->point, y, ISO_STATE);
    for (int i = 0; i < 3; i++) y[i] /= ball ? o->units.w : o->unit_M;
    if (f->at[ISO_GRAVITY] > 0) copy(s->vertical, y + f->at[ISO_GRAVITY], 3);
    if (f->at[ISO_TWIST] > 0) y[f->at[ISO_TWIST]] = -f->effects.twist * dot(y, y + 3);
    if (f->at[ISO_ATTITUDE] == 0) return;
    copy(s->quaternion, y + f->at[ISO_ATTITUDE], 4);
    for (int i = 0; f->p.k == 1 && i < 3; i++) y[f->at[ISO_ATTITUDE] + 4 + i] = s->contact[i] / o->length;
}

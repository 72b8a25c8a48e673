/* effect_reactions.c - the forces of the contact: asked for, they act on nothing that is not simulated anyway. */
#include <float.h>

#include "base/vec3_impl.h"
#include "model/contact_impl.h"
#include "model/effects_impl.h"
#include "model/reactions.h"

/* All torques but the reaction's own. */
static void torques(const iso_field *f, const double y[], double T[3])
{
    for (int i = 0; i < 3; i++) T[i] = 0;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_row(f, e);
        if (f->effects.on[e] && effect->torque) effect->torque(f, y, T);
    }
}

/* Of the pressure, relative to its terms: what is less is none. Else a ball that grazes weightlessness, or rolls down a
 * wall, would leave its support where rounding says so. */
#define ROUNDING (8 * DBL_EPSILON)

/* w x n' + w x (w x n) = (1-k) w x (w x n) = (1-k) [ (w,n) w - w^2 n ]. The parts along n and across are found one by one:
 * on a plane without weight the first is exactly 0. */
iso_reactions iso_reactions_at(const iso_field *f, const double y[])
{
    const double *w = y, *n = y + 3, D = f->p.D, k = f->p.k, spin = dot(w, n);
    const double side = k > 1 ? -1 : 1; /* inside a sphere the support is on the other side of the centre */
    const double b = iso_params_sign_of_radius(&f->p);
    const iso_contact *contact = iso_contact_of(f);
    double T[3], dy[ISO_STATE], across[3];
    torques(f, y, T);
    contact->solve(f, y, T, dy);
    cross(dy, n, across);
    add_scaled(across, (1 - k) * spin, w);
    scale(across, D);
    double normal = -D * (1 - k) * dot(w, w), size = fabs(normal);
    if (f->effects.on[ISO_GRAVITY]) {
        const double *e = y + f->at[ISO_GRAVITY];
        add_scaled(across, f->effects.mgb, e);
        normal += f->effects.mgb * dot(e, n);
        size += fabs(f->effects.mgb);
    }
    normal += D * (1 - k) * spin * spin;
    if (fabs(normal) <= ROUNDING * size) normal = 0;
    remove_along(across, n);
    iso_reactions r = {.pressure = side * b * normal, .friction = norm(across), .twist = contact->twist(f, y, T)};
    r.needed = r.friction / fabs(r.pressure);
    for (int i = 0; i < 3; i++) r.force[i] = b * (across[i] + normal * n[i]);
    return r;
}

const iso_effect iso_effect_reactions = {
    .name = "reactions",
    .doc = "contact force, twist torque, friction coefficient needed; a run ends where contact is lost",
};

const iso_effect iso_effect_clock = {
    .name = "clock",
    .doc = "the other clocks as states and columns; a column asks for one of them",
};

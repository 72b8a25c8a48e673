/* integrals_impl.h - conditions under which first integrals hold, shared by both systems' tables. */
#ifndef ISO_MODEL_INTEGRALS_IMPL_H
#define ISO_MODEL_INTEGRALS_IMPL_H

#include "model/effect.h"

/* No force but that of a level, which on the point is none; on a plane also the torque of a contact that twists, along n. */
static inline bool holds_plane(const iso_field *f)
{
    iso_effects others = f->effects;
    if (!others.on[ISO_LEVEL]) others.on[ISO_TWIST] = false;
    return f->p.k == 1 && iso_effects_free(&others);
}

static inline bool holds_shell(const iso_field *f)
{
    return f->p.k == -1 && iso_effects_free(&f->effects);
}

/* The body is symmetric about an axis, and a field, if there is one, as well. */
static inline bool holds_axis(const iso_field *f, int axis)
{
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    const double *C = f->effects.quadratic, *l = f->effects.linear;
    iso_effects others = f->effects;
    others.on[ISO_FIELD] = false;
    if (!iso_params_symmetric(&f->p, axis) || !iso_effects_free(&others)) return false;
    return !f->effects.on[ISO_FIELD] || (C[4 * j] == C[4 * k] && C[3 * j + k] == 0 && C[3 * axis + j] == 0 &&
                                         C[3 * axis + k] == 0 && l[j] == 0 && l[k] == 0);
}

static inline bool holds_axis1(const iso_field *f)
{
    return holds_axis(f, 0);
}

static inline bool holds_axis2(const iso_field *f)
{
    return holds_axis(f, 1);
}

static inline bool holds_axis3(const iso_field *f)
{
    return holds_axis(f, 2);
}

#endif

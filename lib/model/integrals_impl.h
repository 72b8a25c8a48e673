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

static inline bool holds_axis1(const iso_field *f)
{
    return iso_params_symmetric(&f->p, 0) && iso_effects_free(&f->effects);
}

static inline bool holds_axis2(const iso_field *f)
{
    return iso_params_symmetric(&f->p, 1) && iso_effects_free(&f->effects);
}

static inline bool holds_axis3(const iso_field *f)
{
    return iso_params_symmetric(&f->p, 2) && iso_effects_free(&f->effects);
}

#endif

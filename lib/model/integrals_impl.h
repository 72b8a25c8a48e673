/* integrals_impl.h - conditions under which first integrals hold, shared by both systems' tables. */
#ifndef ISO_MODEL_INTEGRALS_IMPL_H
#define ISO_MODEL_INTEGRALS_IMPL_H

#include "model/effects_impl.h"

static inline bool holds_plane(const iso_problem *f)
{
    return f->p.k == 1 && iso_effects_keep(f, ISO_F_PLANE);
}

static inline bool holds_shell(const iso_problem *f)
{
    return f->p.k == -1 && iso_effects_keep(f, ISO_F_SHELL);
}

/* The body is symmetric about an axis, and the effects as well. */
static inline bool holds_axis(const iso_problem *f, int axis)
{
    return iso_params_symmetric(&f->p, axis) && iso_effects_keep(f, (iso_additional)(ISO_F_AXIS1 + axis));
}

static inline bool holds_axis1(const iso_problem *f)
{
    return holds_axis(f, 0);
}

static inline bool holds_axis2(const iso_problem *f)
{
    return holds_axis(f, 1);
}

static inline bool holds_axis3(const iso_problem *f)
{
    return holds_axis(f, 2);
}

#endif

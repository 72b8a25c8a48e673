/* integrals_impl.h - conditions under which first integrals hold, shared by both systems' tables. */
#ifndef ISO_MODEL_INTEGRALS_IMPL_H
#define ISO_MODEL_INTEGRALS_IMPL_H

#include "model/system.h"

static inline bool holds_plane(const iso_params *p)
{
    return p->k == 1;
}

static inline bool holds_shell(const iso_params *p)
{
    return p->k == -1;
}

static inline bool holds_axis1(const iso_params *p)
{
    return iso_params_symmetric(p, 0);
}

static inline bool holds_axis2(const iso_params *p)
{
    return iso_params_symmetric(p, 1);
}

static inline bool holds_axis3(const iso_params *p)
{
    return iso_params_symmetric(p, 2);
}

#endif

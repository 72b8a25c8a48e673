/* lanes.c - the list of compilations for batches and tails: which of them this processor can run, and which models can
 * stand side by side in the lanes of one vector. */
#include "method/taylor/lanes_impl.h"

#include <string.h>

#include "method/methods_impl.h"
#include "method/taylor/code_impl.h"
#include "method/taylor/tail_impl.h"
#include "model/formula/formula_lines_impl.h"
#include "model/model_impl.h"

const iso_lane_build *const iso_lane_builds[] = {
#ifdef ISO_TAYLOR_X86
    &iso_lanes_avx512, &iso_lanes_avx2,
#endif
    &iso_lanes_plain, NULL};

static const iso_lane_build *const tangent_codes[] = {
#ifdef ISO_TAYLOR_X86
    &iso_tangent_avx512,
    &iso_tangent_avx2,
#endif
    &iso_tangent_plain,
    &iso_tangent_extended,
#ifdef ISO_TAYLOR_HAS_QUAD
    &iso_tangent_quad,
#endif
    NULL};

const iso_lane_build *iso_lane_build_find(const char *name, bool deviations)
{
    for (const iso_lane_build *const *code = deviations ? tangent_codes : iso_lane_builds; *code; code++)
        if ((!name || strcmp(name, (*code)->name) == 0) && (*code)->runs_here()) return *code;
    return NULL;
}

const iso_tail_build *iso_tail_build_find(void)
{
#ifdef ISO_TAYLOR_X86
    if (iso_taylor_has_avx2()) return &iso_tail_avx2;
#endif
    return &iso_tail_plain;
}

iso_clock iso_lane_clock(const iso_model *m)
{
    const bool in_field = m->problem.energy_formula.lines > 0;
    const bool in_t = !in_field && m->problem.energy == 0 && m->clock == ISO_CLOCK_T && m->problem.p.k != -1;
    return m->system == &iso_system_point && !in_t ? ISO_CLOCK_S : ISO_CLOCK_T;
}

bool iso_lanes_alike(const iso_model *a, const iso_model *b)
{
    const iso_problem *f = &a->problem, *g = &b->problem;
    bool alike = a->system == b->system && a->clock == b->clock && a->dim == b->dim && a->clocks == b->clocks &&
                 (f->p.k == -1) == (g->p.k == -1) && (f->p.k == 1) == (g->p.k == 1) &&
                 (f->energy == 0) == (g->energy == 0);
    for (int i = 0; i < a->clocks && alike; i++) alike = a->clock_of[i] == b->clock_of[i];
    for (int e = 0; e < ISO_EFFECTS && alike; e++)
        alike = f->effects.on[e] == g->effects.on[e] && f->at[e] == g->at[e];
    return alike && iso_formula_alike(&f->motion, &g->motion) &&
           iso_formula_alike(&f->energy_formula, &g->energy_formula);
}

#include "method/lanes_impl.h"

const iso_lane_code *const iso_lane_codes[] = {&iso_lanes_avx512, &iso_lanes_avx2, &iso_lanes_plain, NULL};

const iso_lane_code *iso_lane_code_here(void)
{
    int i = 0;
    while (!iso_lane_codes[i]->runs_here()) i++;
    return iso_lane_codes[i];
}

bool iso_lanes_alike(const iso_model *a, const iso_model *b)
{
    const iso_field *f = &a->field, *g = &b->field;
    bool alike = a->system == b->system && a->clock == b->clock && a->dim == b->dim && a->carried == b->carried &&
                 (f->p.k == -1) == (g->p.k == -1) && (f->p.k == 1) == (g->p.k == 1) &&
                 (f->energy == 0) == (g->energy == 0);
    for (int i = 0; i < a->carried && alike; i++) alike = a->carry[i] == b->carry[i];
    for (int e = 0; e < ISO_EFFECTS && alike; e++)
        alike = f->effects.on[e] == g->effects.on[e] && f->at[e] == g->at[e];
    return alike;
}

bool iso_lanes_solve(iso_lane_job *const jobs[], size_t count, const iso_lane_options *options)
{
    return count == 0 || iso_lane_code_here()->solve(jobs, count, options);
}

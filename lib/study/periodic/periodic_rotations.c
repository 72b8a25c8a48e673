/* periodic_rotations.c - the rotations about the principal axes: Hill's equation in 64 and 113 bits, and the
 * section's tangent map. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>

#include "base/monitor_impl.h"
#include "base/pi_impl.h"
#include "study/periodic/hill_trace_impl.h"
#include "study/periodic/periodic_impl.h"

/* The fixed point of the rotation about `axis`; the section's own axis has the boundary. */
static void place(const iso_periodic_map *map, iso_rotation *r)
{
    const int b = (map->axis + 1) % 3;
    r->l = r->axis == b ? ISO_PI / 2 : 0;
    r->x = r->axis == map->axis ? 1 : 0;
}

/* By the derivative of g. g turns the deviation over: its trace has the other sign. The rotation about the section's
 * own axis never crosses it: the section of the next axis serves. */
static bool ask_section(iso_periodic_work *w, iso_rotation *r, iso_wide *trace)
{
    iso_periodic_map map = w->map;
    iso_periodic_fine found;
    const bool own = r->axis == map.axis;
    if (own) iso_periodic_map_turn((map.axis + 1) % 3, &map);
    const iso_wide z[2] = {r->axis == (map.axis + 1) % 3 ? WIDE_PI / 2 : 0, 0};
    if (!iso_periodic_far(&map, iso_return_code_of(w->options.polish), z, 1, NULL, &found)) return false;
    *trace = -(found.slope[0][0] + found.slope[1][1]);
    for (int c = 0; c < ISO_CLOCKS; c++) r->clock[c] = 2 * (double)found.clock[c] * w->unit_clock[c];
    return true;
}

/* How far apart the two ways are that give the trace: Hill's equation in numbers of 113 bits, and the section's
 * derivative; and Hill's equation in numbers of 64 bits. Polished, both ways have as many digits. */
static double error_of(const iso_periodic_work *w, iso_wide trace, double rough, iso_wide section)
{
    const double size = fabs((double)trace), apart = fabs((double)(section - trace));
    if (w->options.polish) return fmax(apart, 1e-31 * size);
    return fmax(apart, fmax(fabs(rough - (double)trace), 0x1p-53 * size));
}

/* No number: the plane holds an oscillation. */
static void none(iso_rotation *r)
{
    r->oscillates = true;
    r->half_turn_trace = r->error = r->tail = r->by_section = r->turn_trace = NAN;
    r->half = (iso_multipliers){.stability = ISO_STABILITY_UNDECIDED, .value = {{NAN, NAN}, {NAN, NAN}}};
    for (int c = 0; c < ISO_CLOCKS; c++) r->clock[c] = NAN;
}

static bool find_rotation(iso_periodic_work *w, int axis)
{
    iso_rotation *r = &w->out->rotation[axis];
    const iso_params *p = &w->map.p;
    iso_wide Y[2][2], section;
    *r = (iso_rotation){.axis = axis};
    place(&w->map, r);
    if (!iso_hill_has_rotation(p->k, p->J, w->energy, axis)) return none(r), true;
    const double rough = iso_hill_trace(p->k, p->J, w->energy, axis, NULL);
    iso_hill_matrix_wide(p->k, p->J, w->energy, axis, Y);
    const iso_fine trace = iso_fine_of(Y[0][0] + Y[1][1]);
    r->half_turn_trace = trace.head;
    r->tail = trace.tail;
    if (!ask_section(w, r, &section)) return false;
    r->by_section = (double)section;
    r->error = error_of(w, Y[0][0] + Y[1][1], rough, section);
    r->turn_trace = trace.head * trace.head - 2;
    r->half = iso_multipliers_of(trace.head, fmax(4 * r->error, 1e-15), (double)Y[1][0]);
    return true;
}

iso_status iso_periodic_rotations(iso_periodic_work *w)
{
    for (int axis = 0; axis < 3; axis++)
        if (!find_rotation(w, axis))
            return iso_context_goes_on(w->ctx)
                       ? iso_context_fail(w->ctx, ISO_NUMERICAL, "", "the rotation about axis %d was not followed",
                                          axis + 1)
                       : iso_context_stopped(w->ctx);
    return ISO_OK;
}

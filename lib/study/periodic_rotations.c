/* periodic_rotations.c - the rotations about the principal axes: Hill's equation in 64 and 113 bits, and the section's
 * tangent map. */
#include <math.h>

#include "base/pi_impl.h"
#include "base/vec3_impl.h"
#include "study/hill_wide_impl.h"
#include "study/periodic_impl.h"

/* The fixed point of the rotation about `axis`; the section's own axis has the boundary. */
static void place(const iso_periodic_map *map, iso_rotation *r)
{
    const int b = (map->axis + 1) % 3;
    r->l = r->axis == b ? ISO_PI / 2 : 0;
    r->x = r->axis == map->axis ? 1 : 0;
}

/* By the derivative of g. g turns the deviation over: its trace has the other sign. */
static bool ask_section(iso_periodic_work *w, iso_rotation *r, iso_wide *trace)
{
    const iso_periodic_map *map = &w->map;
    iso_periodic_fine found;
    const iso_wide z[2] = {r->x == 0 && r->l > 0 ? WIDE_PI / 2 : 0, 0};
    if (!iso_periodic_far(map, iso_periodic_code(w->options.polish), z, 1, NULL, &found)) return false;
    *trace = -(found.slope[0][0] + found.slope[1][1]);
    for (int c = 0; c < ISO_CLOCKS; c++) r->clock[c] = 2 * (double)found.clock[c] * w->unit_clock[c];
    return true;
}

/* The clocks of a whole turn: dphi = (2 eps)^(1/2) q^(-1/(2k)) ds, the others by their rates; the rule of equal steps
 * converges like a power of the distance to the zeros of q. */
static void find_clocks(const iso_periodic_work *w, iso_rotation *r)
{
    const iso_params *p = &w->map.p;
    const double Ja = p->J[(r->axis + 1) % 3], Jb = p->J[(r->axis + 2) % 3];
    const int steps = (int)(80 * (1 + sqrt(fmax(Ja, Jb) / fmin(Ja, Jb))));
    for (int c = 0; c < ISO_CLOCKS; c++) r->clock[c] = 0;
    for (int i = 0; i < steps; i++) {
        const double phi = ISO_PI * i / steps, C = cos(phi), S = sin(phi), q = Ja * C * C + Jb * S * S;
        const double ds = 2 * ISO_PI / steps / (sqrt(2) * pow(q, -1 / (2 * p->k)));
        for (iso_clock c = 0; c < ISO_CLOCKS; c++)
            r->clock[c] += ds * iso_clock_rate(p, c, q, NULL) / iso_clock_rate(p, ISO_CLOCK_S, q, NULL);
    }
    for (int c = 0; c < ISO_CLOCKS; c++) r->clock[c] *= w->unit_clock[c];
}

/* How far apart the two ways are that give the trace; Y: by numbers of 128 bits. Polished, the section has as many
 * digits as Hill's equation; its own axis, which it does not see, has the determinant in its place. */
static double error_of(const iso_periodic_work *w, iso_wide Y[2][2], double rough, const iso_wide *section)
{
    const iso_wide trace = Y[0][0] + Y[1][1];
    const double size = fabs((double)trace), apart = section ? fabs((double)(*section - trace)) : 0;
    if (!w->options.polish) return fmax(apart, fmax(fabs(rough - (double)trace), 0x1p-53 * size));
    const double off = fabs((double)(Y[0][0] * Y[1][1] - Y[0][1] * Y[1][0] - 1));
    return fmax(apart, 1e-31 * size) + (section ? 0 : 4 * off * (1 + size));
}

static bool find_rotation(iso_periodic_work *w, int axis)
{
    iso_rotation *r = &w->out->rotation[axis];
    const iso_params *p = &w->map.p;
    long double y[2][2];
    iso_wide Y[2][2], section;
    double error;
    *r = (iso_rotation){.axis = axis, .by_section = NAN};
    place(&w->map, r);
    const double rough = iso_hill_trace(p->k, p->J, axis, &error);
    iso_hill_matrix(p->k, p->J, axis, y);
    iso_hill_matrix_wide(p->k, p->J, axis, Y);
    const iso_fine trace = iso_fine_of(Y[0][0] + Y[1][1]);
    r->half_turn_trace = trace.head;
    r->tail = trace.tail;
    find_clocks(w, r);
    const bool seen = axis != w->map.axis;
    if (seen && !ask_section(w, r, &section)) return false;
    if (seen) r->by_section = (double)section;
    r->error = error_of(w, Y, rough, seen ? &section : NULL);
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
                       : iso_context_fail(w->ctx, ISO_STOPPED, "", "stopped on request");
    return ISO_OK;
}

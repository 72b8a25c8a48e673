/* return_map_impl.h - the return map of the global section in numbers of 64 and of 113 bits: see return_impl.h. */
#ifndef ISO_METHOD_TAYLOR_RETURN_MAP_IMPL_H
#define ISO_METHOD_TAYLOR_RETURN_MAP_IMPL_H

#include "model/model.h"

/* The number head + tail, |tail| <= half a unit in the last place of head: 106 bits or so. */
typedef struct iso_fine {
    double head, tail;
} iso_fine;

/* Where a return begins. from[0] and from[1] are its coordinates there.
 *
 * The equations are odd in gamma, so that (-gamma, -gamma') of a crossing begins an orbit as well. There gamma_a goes
 * down, and passes 0 upwards after half a return. The square of this map is the return map, and it keeps the fixed
 * points (rotations) as they are: its derivative there has the half-turn trace, up to its sign.
 *
 * The others begin half way between two crossings, where a reversor leaves the state as it is: the motion before is
 * the mirror image of the motion after. (b, c, a) are the axes in cyclic order, gamma' = v (...), v^2 = F(q). */
typedef enum iso_return_start {
    ISO_FROM_CHART,   /* (l, x) of a crossing upwards                                                       */
    ISO_FROM_BELOW,   /* (l, x) of a crossing upwards: its -gamma, -gamma'. Half a return                    */
    ISO_FROM_POLE,    /* gamma = -e_a, gamma' = v (cos u, sin u, 0); c moves gamma across gamma'             */
    ISO_FROM_PLANE_B, /* gamma = (0, cos u, -sin u), gamma' = v e_b; c turns gamma' out of its direction      */
    ISO_FROM_PLANE_C  /* gamma = (cos u, 0, -sin u), gamma' = v e_c; likewise. from = (u, c), c = 0            */
} iso_return_start;

/* One return: the start, and what is found. */
typedef struct iso_return {
    iso_return_start start;
    iso_fine from[2], to[2];    /* (l, x), or (u, c) of a start half way       */
    iso_fine slope[2][2];       /* d to[i]/d from[j]                           */
    iso_fine clock[ISO_CLOCKS]; /* how long it took; of clocks that the model carries, and its own */
} iso_return;

typedef struct iso_return_build {
    double error; /* of one operation, relative */
    /* model: the free point on H = 0. zeros: see iso_lane_job. tolerance: as of other Taylor methods where their
     * numbers are doubles; it is multiplied by error/1e-16.
     * False: no memory, or no crossing. */
    bool (*go)(const iso_model *model, int axis, double zeros, double tolerance, iso_return *r);
} iso_return_build;

extern const iso_return_build iso_return_extended, iso_return_quad;

#endif

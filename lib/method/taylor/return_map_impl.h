/* return_map_impl.h - the return map of the global section in numbers of 64 and of 113 bits: see return_impl.h. */
#ifndef ISO_METHOD_RETURN_MAP_IMPL_H
#define ISO_METHOD_RETURN_MAP_IMPL_H

#include "model/model.h"

/* The number head + tail, |tail| <= half a unit in the last place of head: 106 bits or so. */
typedef struct iso_fine {
    double head, tail;
} iso_fine;

/* One return: the start, and what is found.
 *
 * Half a return: the equations are odd in gamma, so that (-gamma, -gamma') of a crossing begins an orbit as well.
 * There gamma_a goes down, and passes 0 upwards after half a return. The square of this map is the return map, and
 * it keeps the fixed points (rotations) as they are: its derivative there has the half-turn trace, up to its sign. */
typedef struct iso_return {
    iso_fine from[2], to[2];    /* (l, x)                                      */
    bool half;                  /* half a return: the start is the point with -gamma and -gamma' instead */
    iso_fine slope[2][2];       /* d to[i]/d from[j]                           */
    iso_fine clock[ISO_CLOCKS]; /* how long it took; of clocks that the model carries, and its own */
} iso_return;

typedef struct iso_return_code {
    const char *name;
    double error; /* of one operation, relative */
    /* model: the free point on H = 0. zeros: see iso_lane_job. tolerance: of terms, in units of `error` times 1e16.
     * False: no memory, or no crossing. */
    bool (*go)(const iso_model *model, int axis, double zeros, double tolerance, iso_return *r);
} iso_return_code;

extern const iso_return_code iso_return_extended, iso_return_quad;

#endif

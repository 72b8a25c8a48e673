/* taylor_lanes_plain.c - two orbits at a time, for any processor: all have vectors of two doubles, or do without. */
#include "method/taylor_double_impl.h"

#define LANES 2

#include "method/taylor_lanes_impl.h"

static bool always(void)
{
    return true;
}

const iso_lane_code iso_lanes_plain = {"plain", LANES, always, solve};

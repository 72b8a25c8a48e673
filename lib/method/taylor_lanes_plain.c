/* taylor_lanes_plain.c - two orbits at a time, for any processor: all have vectors of two doubles, or do without. */
#define NUMBER double
#define ROOT sqrt
#define LOG log
#define EXP exp
#define FMA fma
#define EPSILON DBL_EPSILON
#define FINER 1
#define FINEST_ORDER 32
#define NODES 8
#define LANES 2

#include "method/taylor_lanes_impl.h"

static bool always(void)
{
    return true;
}

const iso_lane_code iso_lanes_plain = {"plain", LANES, always, solve};

/* hard_loss.h - what a way may lose of the state in a radian of the motion, by error analysis.
 *
 * A step errs by a tolerance at most; one-step methods take up to 100 steps a radian (order 2 at 1e-6). The errors of
 * linear multistep methods carry over from step to step, and theirs are not projected away: 100 times more. A ball's
 * series beside a principal plane is exact to 3/4 of the tolerance's digits. Taylor and rk8pd are asked for 1e-15,
 * and the closed solution takes no steps: rounding is left, some units in the last place a radian.
 */
#ifndef ISO_TESTS_HARD_LOSS_H
#define ISO_TESTS_HARD_LOSS_H

#include <math.h>
#include <string.h>

#include "hard.h"

static inline bool hard_is(const hard_road *way, const char *method)
{
    return way->method && strncmp(way->method->name, method, strlen(method)) == 0;
}

/* The way at the tolerance where rounding is what is left. */
static inline hard_road hard_finest(const hard_road *way)
{
    hard_road finest = *way;
    if (hard_is(way, "taylor") || hard_is(way, "rk8pd")) finest.tolerance = 1e-15;
    return finest;
}

static inline double hard_loss(const hard_road *way)
{
    const bool multistep = hard_is(way, "adams") || hard_is(way, "bdf") || hard_is(way, "ms");
    if (way->backend == ISO_EXACT || way->tolerance == 1e-15) return 1e-14;
    return (multistep ? 1e4 : 100) * way->tolerance;
}

/* The larger error, NaN the largest */
static inline double hard_worse(double error, double worst)
{
    return isnan(worst) || error <= worst ? worst : error;
}

#endif

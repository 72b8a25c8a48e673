/* hard_loss.h - the error that a way may make in a radian of the motion, from error analysis.
 *
 * - The error of a step is at most the tolerance. One-step methods take up to 100 steps a radian (order 2 at
 *   1e-6).
 * - Linear multistep methods carry errors from step to step and do not project: 100 times more.
 * - A ball's series beside a principal plane has 3/4 of the digits of its tolerance.
 * - taylor and rk8pd run at 1e-15, the closed solution takes no steps: some units in the last place a radian are
 *   left.
 */
#ifndef ISO_TESTS_HARD_LOSS_H
#define ISO_TESTS_HARD_LOSS_H

#include "hard.h"

static inline bool hard_is(const hard_road *way, const char *method)
{
    return way->method && strncmp(way->method->name, method, strlen(method)) == 0;
}

/* The way at the tolerance where only rounding is left. */
static inline hard_road hard_finest(const hard_road *way)
{
    hard_road finest = *way;
    if (hard_is(way, "taylor") || hard_is(way, "rk8pd")) finest.tolerance = 1e-15;
    return finest;
}

static inline double hard_loss(const hard_road *way)
{
    const bool multistep = hard_is(way, "adams") || hard_is(way, "bdf") || hard_is(way, "ms");
    if (way->backend == ISO_BACKEND_EXACT || way->tolerance == 1e-15) return 1e-14;
    return (multistep ? 1e4 : 100) * way->tolerance;
}

/* The larger error, NaN the largest */
static inline double hard_worse(double error, double worst)
{
    return isnan(worst) || error <= worst ? worst : error;
}

#endif

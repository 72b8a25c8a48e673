/* yardstick.h - the rival of isoroll's lanes: the fastest code for this one problem that we know how to write.
 *
 * Free balls of one k and J from w, n at t = 0 to t = end, as points on a sphere by Taylor series. It does nothing
 * else: no effects, no rows on the way, no other clocks, no bound on the steps, no word about what went wrong. So its
 * order is a constant and its loops are written out. What isoroll's lanes lose to it is the price of being general.
 */
#ifndef ISO_TESTS_YARDSTICK_H
#define ISO_TESTS_YARDSTICK_H

#include <stdbool.h>
#include <stddef.h>

typedef struct yardstick_job {
    double k, J[3];
    const double (*start)[6]; /* w, n */
    double (*end)[6];
    size_t count;
    double time, tolerance;
    long steps; /* of all orbits together; found */
} yardstick_job;

enum { YARDSTICK_ORDERS = 5 };

typedef struct yardstick_code {
    const char *name;
    int lanes, order[YARDSTICK_ORDERS];
    bool (*runs_here)(void);
    void (*solve[YARDSTICK_ORDERS])(yardstick_job *job);
} yardstick_code;

extern const yardstick_code yardstick_avx512, yardstick_avx2, yardstick_plain;

#endif

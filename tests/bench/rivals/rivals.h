/* rivals.h - what a user of other libraries would write in an hour. The benchmarks race against these programs, and
 * check that their results are right before they print how fast they are.
 *
 * They are compiled with -O3 for the processor of the machine.
 */
#ifndef ISO_TESTS_RIVALS_H
#define ISO_TESTS_RIVALS_H

#include <stdbool.h>
#include <stddef.h>

#include "equations.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- one orbit to its end --------------------------------------------------------------------------------------- */

typedef bool rival_solve(const rival_problem *p, double tolerance, double end, double y[6]);

/* The list ends with the name NULL. */
typedef struct rival {
    const char *name;
    rival_solve *solve;
} rival;

extern const rival rivals[];

rival_solve rival_gsl_rk8pd, rival_cvode_adams, rival_arkode_fehlberg;
rival_solve rival_odeint_fehlberg, rival_odeint_stoer; /* Boost, where it was found */

enum { RIVAL_STEPS = 10000 }; /* in a time of 1: who needs more gives up */

/* --- an orbit at any time: the ends of steps are kept, and one shorter step leads from there ---------------------- */

typedef struct rival_path rival_path;

rival_path *rival_path_create(const rival_problem *p, double tolerance, const double y[6]);
bool rival_path_at(rival_path *path, double t, double y[6]);
void rival_path_free(rival_path *path);

/* --- crossings of a plane ----------------------------------------------------------------------------------------- */

enum { RIVAL_MOST = 18 };

/* At the crossing `turn`, 0, 1, ...: the time, the state and its variations. growth[v]: ln of the lengths by which the
 * variation v was divided on the way. */
typedef void rival_seen(void *data, int turn, double time, const double y[], const double growth[2]);

/* Follows y to its next `turns` crossings of y[3 + axis] = 0 upwards. */
typedef bool rival_follow(const rival_problem *p, int axis, double tolerance, int turns, const double y[],
                          rival_seen *seen, void *data);

typedef struct rival_walker {
    const char *name;
    rival_follow *follow;
} rival_walker;

/* The list ends with the name NULL. */
extern const rival_walker rival_walkers[];

rival_follow rival_follow_gsl;
rival_follow rival_follow_fehlberg, rival_follow_stoer; /* Boost, where it was found */

#ifdef __cplusplus
}
#endif

#endif

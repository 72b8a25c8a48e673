/* sections.h - the rival of iso_crossings: a plain loop over GSL's steps of rk8pd. */
#ifndef ISO_TESTS_RIVALS_SECTIONS_H
#define ISO_TESTS_RIVALS_SECTIONS_H

#include <stdbool.h>

#include "equations.h"

enum { RIVAL_MOST = 18 };

/* At the crossing `turn`, 0, 1, ...: the time, the state and its variations. growth[v]: ln of the lengths by which the
 * variation v was divided on the way. */
typedef void rival_seen(void *data, int turn, double time, const double y[], const double growth[2]);

/* Follows y to its next `turns` crossings of y[3 + axis] = 0 upwards. */
bool rival_follow(const rival_problem *p, bool point, int axis, double tolerance, int turns, const double y[],
                  rival_seen *seen, void *data);

#endif

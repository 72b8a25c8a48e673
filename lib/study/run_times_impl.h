/* run_times_impl.h - the order in which an orbit is followed to times that come in any order.
 *
 * The orbit is followed away from its start, and keeps no ends of steps. For a time that lies behind, it begins at
 * the start again. So the order of the work is: times after the start, then those before it; on each side the nearer
 * times come first, and equal times as they are asked for.
 */
#ifndef ISO_STUDY_RUN_TIMES_IMPL_H
#define ISO_STUDY_RUN_TIMES_IMPL_H

#include <stdbool.h>
#include <stddef.h>

/* A time asked for, and the row of the result that it belongs to. */
typedef struct iso_asked_time {
    double time;
    size_t row;
} iso_asked_time;

/* Whether the times already stand in the order of the work. */
bool iso_times_in_order(const double times[], size_t count);

/* The times in the order of the work, for the caller to free; count is above 0. NULL: no memory. */
iso_asked_time *iso_times_sorted(const double times[], size_t count);

#endif

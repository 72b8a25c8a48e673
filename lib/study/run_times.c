/* run_times.c - times put in the order in which an orbit is followed to them, see study_impl.h. */
#include "study/study_impl.h"

#include <math.h>
#include <stdlib.h>

static int by_work(const void *first, const void *second)
{
    const iso_asked_time *a = first, *b = second;
    if ((a->time < 0) != (b->time < 0)) return a->time < 0 ? 1 : -1;
    if (a->time != b->time) return fabs(a->time) > fabs(b->time) ? 1 : -1;
    return (a->row > b->row) - (a->row < b->row);
}

bool iso_times_in_order(const double times[], size_t count)
{
    for (size_t i = 1; i < count; i++)
        if (by_work(&(iso_asked_time){times[i - 1], i - 1}, &(iso_asked_time){times[i], i}) > 0) return false;
    return true;
}

iso_asked_time *iso_times_sorted(const double times[], size_t count)
{
    iso_asked_time *order = malloc(count * sizeof *order);
    if (!order) return NULL;
    for (size_t i = 0; i < count; i++) order[i] = (iso_asked_time){times[i], i};
    qsort(order, count, sizeof *order, by_work);
    return order;
}

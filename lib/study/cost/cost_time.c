/* cost_time.c - how long an orbit takes, measured by repeats on a machine that also does other things. */
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

#include "base/vec3_impl.h"
#include "study/cost/cost_impl.h"

/* Short orbits are timed several at once, up to TOGETHER of them, so that they take about SHORT seconds: reading the
 * clock takes time itself. */
enum { TOGETHER = 16 };
static const double SHORT = 1e-4;

static iso_status run_some(cost_problem *p, const iso_cost_cell *cell, double end, int count, double *setup,
                           double *stepping, iso_statistics *statistics)
{
    iso_orbit *orbit[TOGETHER] = {NULL};
    iso_sample sample;
    iso_status status = ISO_OK;
    const double begin = processor_seconds();
    for (int i = 0; status == ISO_OK && i < count; i++)
        status = iso_cost_orbit_open(p, cell->backend, cell->method, cell->tolerance, false, &orbit[i]);
    const double between = processor_seconds();
    for (int i = 0; status == ISO_OK && i < count; i++) status = iso_orbit_at(orbit[i], end, &sample);
    *stepping = (processor_seconds() - between) / count;
    *setup = (between - begin) / count;
    if (status == ISO_OK) *statistics = iso_orbit_statistics(orbit[0]);
    for (int i = 0; i < count; i++) iso_orbit_free(orbit[i]);
    return status;
}

iso_status iso_cost_time(cost_problem *p, const iso_cost_cell *cell, double end, double about, double *setup,
                         double *stepping, iso_statistics *statistics)
{
    const int count = about < SHORT / TOGETHER ? TOGETHER : about < SHORT ? (int)ceil(SHORT / about) : 1;
    if (about < 10 * SHORT) { /* fills the caches, which hold the data of another cell */
        ISO_TRY(run_some(p, cell, end, 1, setup, stepping, statistics));
    }
    return run_some(p, cell, end, count, setup, stepping, statistics);
}

/* The median of x, which is sorted by this. */
static double median_of(int count, double x[])
{
    gsl_sort(x, 1, (size_t)count);
    return gsl_stats_median_from_sorted_data(x, 1, (size_t)count);
}

/* Of n sorted times the true median lies between those about sqrt(n)/2 places before and after the middle, in two
 * cases of three. */
bool iso_cost_times_settled(const cost_times *times)
{
    double x[COST_REPEATS];
    const int n = times->count, reach = (int)ceil(sqrt(n) / 2);
    if (n < 5) return false;
    if (n == COST_REPEATS) return true;
    copy(times->stepping, x, n);
    const double median = median_of(n, x);
    return x[n / 2 + reach] - x[(n - 1) / 2 - reach] < 0.1 * median && x[1] - x[0] < 0.05 * x[0];
}

void iso_cost_times_read(const cost_times *times, iso_cost_cell *cell)
{
    double x[COST_REPEATS], setup[COST_REPEATS];
    const int n = times->count;
    cell->repeats = n;
    if (n == 0) return;
    copy(times->stepping, x, n);
    copy(times->setup, setup, n);
    cell->median = median_of(n, x);
    cell->fastest = x[0];
    cell->slowest = x[n - 1];
    cell->setup = median_of(n, setup);
    cell->total = cell->setup + cell->median;
}

double iso_cost_slope(int count, const double x[], const double y[], double apart)
{
    const size_t most = (size_t)count * (size_t)count / 2 + 1;
    double *slope = malloc(most * sizeof *slope), median = NAN;
    int found = 0;
    for (int i = 0; slope && i < count; i++)
        for (int j = 0; j < i; j++)
            if (fabs(x[i] - x[j]) >= apart) slope[found++] = (y[i] - y[j]) / (x[i] - x[j]);
    if (found > 0) median = median_of(found, slope);
    free(slope);
    return median;
}

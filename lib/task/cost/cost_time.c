/* cost_time.c - how long an orbit takes, measured by repeats on a machine that also does other things; and from
 * measured cells: which are worth their time, and how error, time and steps depend on each other. */
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

#include "base/vec3_impl.h"
#include "task/cost/cost_impl.h"

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

/* --- what is worth its time ------------------------------------------------------------------------------------- */

/* A cell is faster if another takes FASTER times as long; an error above LOST is no result; a series has stopped
 * gaining at AT_FLOOR times its least error. */
static const double FASTER = 1.05, LOST = 0.1, AT_FLOOR = 2;

/* A fit uses pairs of points that are at least so many decades apart. */
static const double APART = 0.3;

bool iso_cost_is_measured(const void *row)
{
    const iso_cost_cell *cell = row;
    return cell->status == ISO_OK && cell->repeats > 0;
}

/* An error below the uncertainty of the reference counts as large as that. */
static double known_error(const iso_cost *cost, const iso_cost_cell *cell)
{
    return cell->below ? fmax(cell->error, cost->uncertainty) : cell->error;
}

static bool reaches(const iso_cost *cost, const iso_cost_cell *cell, double want)
{
    return iso_cost_is_measured(cell) && known_error(cost, cell) <= want;
}

const iso_cost_cell *iso_cost_choose(const iso_cost *cost, bool steps, const iso_cost_series *series, double want)
{
    const iso_cost_cell *best = NULL;
    const int first = series ? series->first : 0, end = series ? first + series->count : cost->cells;
    for (int i = first; i < end; i++) {
        const iso_cost_cell *c = &cost->cell[i];
        if ((c->method || !steps) && reaches(cost, c, want) && (!best || c->total < best->total)) best = c;
    }
    return best;
}

static bool is_pareto(const iso_cost *cost, const iso_cost_cell *cell)
{
    if (!iso_cost_is_measured(cell) || !(cell->error < LOST)) return false;
    for (int i = 0; i < cost->cells; i++) {
        const iso_cost_cell *other = &cost->cell[i];
        if (reaches(cost, other, known_error(cost, cell)) && FASTER * other->total < cell->total) return false;
    }
    return true;
}

/* --- series ------------------------------------------------------------------------------------------------------ */

static void find_floor(const iso_cost_cell cell[], iso_cost_series *series)
{
    int last = -1;
    for (int i = 0; i < series->count; i++) {
        if (!iso_cost_is_measured(&cell[i])) continue;
        last = i;
        if (!(cell[i].error >= series->least)) series->least = cell[i].error;
    }
    for (int i = 0; i < last; i++) { /* the last cell may still gain */
        if (!iso_cost_is_measured(&cell[i]) || cell[i].error > AT_FLOOR * series->least || cell[i].below) continue;
        series->stops_at = cell[i].tolerance;
        return;
    }
}

/* Whether a tighter tolerance still makes this cell's error smaller. */
static bool gains(const iso_cost_cell *cell, const iso_cost_series *series)
{
    const bool above = isnan(series->stops_at) || cell->error > AT_FLOOR * series->least;
    return iso_cost_is_measured(cell) && !cell->below && cell->error < LOST && cell->error > 0 && above;
}

static void fit(const iso_cost_cell cell[], iso_cost_series *series)
{
    double error[64], time[64], steps[64];
    int count = 0;
    for (int i = 0; i < series->count && count < 64; i++) {
        if (!gains(&cell[i], series)) continue;
        error[count] = log10(cell[i].error);
        time[count] = log10(cell[i].median);
        steps[count++] = log10((double)cell[i].statistics.steps);
    }
    series->digit = pow(10, -iso_cost_slope(count, error, time, APART));
    const double order = -1 / iso_cost_slope(count, error, steps, APART);
    series->order = isfinite(order) && series->method && series->method->order > 0 ? order : NAN;
}

void iso_cost_evaluate(iso_cost *cost)
{
    for (int l = 0; l < cost->series_count; l++) {
        iso_cost_series *series = &cost->series[l];
        find_floor(&cost->cell[series->first], series);
        fit(&cost->cell[series->first], series);
    }
    for (int i = 0; i < cost->cells; i++) cost->cell[i].pareto = is_pareto(cost, &cost->cell[i]);
}

/* cost_judge.c - from measured cells: which are worth their time, and how error, time and steps depend on each
 * other. */
#include <math.h>
#include <stdlib.h>

#include "study/cost/cost_impl.h"

/* A cell is faster if another takes FASTER times as long; an error above LOST is no result; a line has stopped
 * gaining at AT_FLOOR times its least error. */
static const double FASTER = 1.05, LOST = 0.1, AT_FLOOR = 2;

/* A fit uses pairs of points that are at least so many decades apart. */
static const double APART = 0.3;

bool iso_cost_is_measured(const iso_cost_cell *cell)
{
    return cell->status == ISO_OK && cell->repeats > 0;
}

/* An error below the uncertainty of the reference counts as large as that. */
static double known_error(const iso_cost *cost, const iso_cost_cell *cell)
{
    return cell->below ? fmax(cell->error, cost->uncertainty) : cell->error;
}

bool iso_cost_reaches(const iso_cost *cost, const iso_cost_cell *cell, double want)
{
    return iso_cost_is_measured(cell) && known_error(cost, cell) <= want;
}

const iso_cost_cell *iso_cost_choose(const iso_cost *cost, double want)
{
    const iso_cost_cell *best = NULL;
    for (int i = 0; i < cost->cells; i++) {
        const iso_cost_cell *cell = &cost->cell[i];
        if (iso_cost_reaches(cost, cell, want) && (!best || cell->total < best->total)) best = cell;
    }
    return best;
}

static bool is_pareto(const iso_cost *cost, const iso_cost_cell *cell)
{
    if (!iso_cost_is_measured(cell) || !(cell->error < LOST)) return false;
    for (int i = 0; i < cost->cells; i++) {
        const iso_cost_cell *other = &cost->cell[i];
        if (iso_cost_reaches(cost, other, known_error(cost, cell)) && FASTER * other->total < cell->total)
            return false;
    }
    return true;
}

/* --- lines ------------------------------------------------------------------------------------------------------ */

static void find_floor(const iso_cost_cell cell[], iso_cost_series *line)
{
    int last = -1;
    for (int i = 0; i < line->count; i++) {
        if (!iso_cost_is_measured(&cell[i])) continue;
        last = i;
        if (!(cell[i].error >= line->least)) line->least = cell[i].error;
    }
    for (int i = 0; i < last; i++) { /* the last cell may still gain */
        if (!iso_cost_is_measured(&cell[i]) || cell[i].error > AT_FLOOR * line->least || cell[i].below) continue;
        line->stops_at = cell[i].tolerance;
        return;
    }
}

/* Whether a tighter tolerance still makes this cell's error smaller. */
static bool gains(const iso_cost_cell *cell, const iso_cost_series *line)
{
    const bool above = isnan(line->stops_at) || cell->error > AT_FLOOR * line->least;
    return iso_cost_is_measured(cell) && !cell->below && cell->error < LOST && cell->error > 0 && above;
}

static void fit(const iso_cost_cell cell[], iso_cost_series *line)
{
    double error[64], time[64], steps[64];
    int count = 0;
    for (int i = 0; i < line->count && count < 64; i++) {
        if (!gains(&cell[i], line)) continue;
        error[count] = log10(cell[i].error);
        time[count] = log10(cell[i].median);
        steps[count++] = log10((double)cell[i].statistics.steps);
    }
    line->digit = pow(10, -iso_cost_slope(count, error, time, APART));
    const double order = -1 / iso_cost_slope(count, error, steps, APART);
    line->order = isfinite(order) && line->method && line->method->order > 0 ? order : NAN;
}

void iso_cost_judge(iso_cost *cost)
{
    for (int l = 0; l < cost->lines; l++) {
        iso_cost_series *line = &cost->line[l];
        find_floor(&cost->cell[line->first], line);
        fit(&cost->cell[line->first], line);
    }
    for (int i = 0; i < cost->cells; i++) cost->cell[i].pareto = is_pareto(cost, &cost->cell[i]);
}

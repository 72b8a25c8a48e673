/* cost_report.c - counts, chooses and sorts the cells that `isoroll cost` measured, and puts them into words. */
#include <math.h>
#include <stdlib.h>

#include "cost_report.h"
#include "study/cost/cost_impl.h"

bool cost_is_failed(const iso_cost_cell *cell)
{
    return cell->status != ISO_OK && cell->status != ISO_STOPPED;
}

int cost_count(const iso_cost *cost, bool (*is)(const iso_cost_cell *cell))
{
    int count = 0;
    for (int i = 0; i < cost->cells; i++) count += is(&cost->cell[i]);
    return count;
}

const iso_cost_cell *cost_choose_steps(const iso_cost *cost, const iso_cost_series *line, double want)
{
    const iso_cost_cell *best = NULL;
    const int first = line ? line->first : 0, end = line ? first + line->count : cost->cells;
    for (int i = first; i < end; i++) {
        const iso_cost_cell *c = &cost->cell[i];
        if (c->method && iso_cost_reaches(cost, c, want) && (!best || c->total < best->total)) best = c;
    }
    return best;
}

static bool is_faster(const iso_cost *cost, const iso_cost_series *a, const iso_cost_series *b)
{
    static const double wants[] = {1e-9, 1e-6, 1e-3};
    if (!a->method || !b->method) return !a->method && b->method;
    for (int i = 0; i < 3; i++) {
        const iso_cost_cell *x = cost_choose_steps(cost, a, wants[i]), *y = cost_choose_steps(cost, b, wants[i]);
        if (x && y && x->total != y->total) return x->total < y->total;
        if (!x != !y) return x != NULL;
    }
    return false;
}

const iso_cost_series **cost_sort_lines(const iso_cost *cost)
{
    const iso_cost_series **line = calloc((size_t)cost->lines + 1, sizeof *line);
    for (int i = 0; line && i < cost->lines; i++) {
        int at = i;
        for (; at > 0 && is_faster(cost, &cost->line[i], line[at - 1]); at--) line[at] = line[at - 1];
        line[at] = &cost->line[i];
    }
    return line;
}

const char *cost_options_of(const iso_cost_cell *cell, char words[COST_OPTIONS])
{
    const char *backend = iso_backend_name((int)cell->backend);
    if (cell->method)
        snprintf(words, COST_OPTIONS, "--backend %s --method %s --tol %g", backend, cell->method->name,
                 cell->tolerance);
    else
        snprintf(words, COST_OPTIONS, "--backend %s", backend);
    return words;
}

const char *cost_seconds(double seconds, char words[COST_SECONDS])
{
    static const char *const units[] = {"ns", "us", "ms", "s"};
    int unit = 0;
    double x = 1e9 * seconds;
    while (unit < 3 && x >= 999.5) x /= 1000, unit++;
    if (isnan(x))
        snprintf(words, COST_SECONDS, "-");
    else
        snprintf(words, COST_SECONDS, x < 9.995 ? "%.2f %s" : x < 99.95 ? "%.1f %s" : "%.0f %s", x, units[unit]);
    return words;
}

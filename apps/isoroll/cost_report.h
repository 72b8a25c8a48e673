/* cost_report.h - how the measurements of `isoroll cost` are shown: tables and words, CSV, JSON.
 *
 * A cell is one measurement: a backend, a method and a tolerance. A line is all cells of a backend and a method. */
#ifndef ISOROLL_COST_REPORT_H
#define ISOROLL_COST_REPORT_H

#include "scene_options.h"
#include "study/cost/cost.h"

/* How error and time of one cell grow with the length of the orbit. */
typedef struct cost_growth {
    const iso_cost_cell *cell;
    char why[160]; /* why it failed; "" if it did not */
    iso_cost_growth growth;
} cost_growth;

enum { COST_GROWTHS = 3 };

typedef struct cost_report {
    const iso_scene *scene;
    const iso_cost *cost;
    double want;                 /* --want; NAN: not given        */
    const iso_cost_cell *choice; /* for --want; NULL: there is none */
    int growths;
    cost_growth growth[COST_GROWTHS];
} cost_report;

/* Whether a cell failed. Cells that were left out for lack of time did not. */
bool cost_is_failed(const iso_cost_cell *cell);

/* How many cells there are for which `is` is true. */
int cost_count(const iso_cost *cost, bool (*is)(const iso_cost_cell *cell));

/* As iso_cost_choose, but only among the methods that take steps, and in one line (NULL: in all). */
const iso_cost_cell *cost_choose_steps(const iso_cost *cost, const iso_cost_series *line, double want);

/* All lines: the closed solution first, then the methods, the fastest to an error of 1e-9 first. Methods that do
 * not reach it are sorted by 1e-6, then by 1e-3. The caller frees the list. NULL: no memory. */
const iso_cost_series **cost_sort_lines(const iso_cost *cost);

/* The options of `run` for a cell: "--backend point --method taylor --tol 1e-11". */
enum { COST_OPTIONS = 96 };
const char *cost_options_of(const iso_cost_cell *cell, char words[COST_OPTIONS]);

/* A time in ns, us, ms or s: "0.81 ms". */
enum { COST_SECONDS = 24 };
const char *cost_seconds(double seconds, char words[COST_SECONDS]);

/* Prints everything on standard output: as tables and words, with the lines in this order (cost_table.c); as JSON,
 * false: no memory. */
void cost_print(const cost_report *r, const iso_cost_series *const line[]);
bool cost_print_json(const cost_report *r);

/* The cells as a table, to be freed, with the lines in this order. */
iso_status cost_table(iso_context *ctx, const cost_report *r, const iso_cost_series *const line[],
                      iso_record **table);

#endif

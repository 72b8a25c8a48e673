/* cost_report.h - how measurements of `isoroll cost` are shown: tables and words, CSV, JSON. */
#ifndef ISOROLL_COST_REPORT_H
#define ISOROLL_COST_REPORT_H

#include "scene_options.h"

/* How error and time of one cell grow with the length of the orbit. */
typedef struct cost_growth {
    const iso_cost_cell *cell;
    char why[160]; /* of a failure; "" */
    iso_cost_growth growth;
} cost_growth;

enum { COST_GROWTHS = 3 };

typedef struct cost_report {
    const iso_scene *scene;
    const iso_cost *cost;
    double want; /* --want; NAN */
    int growths;
    cost_growth growth[COST_GROWTHS];
} cost_report;

/* Whether a cell has no result for another reason than time. */
bool cost_is_failed(const iso_cost_cell *cell);

/* How many cells of a kind there are. */
int cost_count(const iso_cost *cost, bool (*is)(const iso_cost_cell *cell));

/* As iso_cost_choose, among those of one line (NULL: of any) that take steps. */
const iso_cost_cell *cost_choose_steps(const iso_cost *cost, const iso_cost_line *line, double want);

/* The closed solution and then the lines in the order in which they get to an error of 1e-9; those that do not, to
 * 1e-6 or 1e-3. To be freed by the caller; NULL: no memory. */
const iso_cost_line **cost_sort_lines(const iso_cost *cost);

/* The options that ask for a cell: "--backend point --method taylor --tol 1e-11". */
enum { COST_OPTIONS = 96 };
const char *cost_options_of(const iso_cost_cell *cell, char words[COST_OPTIONS]);

/* Seconds in a unit that suits them: "0.81 ms". */
enum { COST_SECONDS = 24 };
const char *cost_seconds(double seconds, char words[COST_SECONDS]);

/* Everything on standard output: in tables and words, the lines sorted (cost_table.c); as JSON (cost_data.c; false:
 * no memory). */
void cost_print(const cost_report *r, const iso_cost_line *const line[]);
bool cost_print_json(const cost_report *r);

/* The cells as CSV. */
void cost_write_csv(const cost_report *r, FILE *to);

#endif

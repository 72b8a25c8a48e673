/* cost_report.h - the measurements of `isoroll cost` in words (cost_table.c).
 *
 * A cell is one measurement: a backend, a method and a tolerance. A line is all cells of a backend and a method. */
#ifndef ISOROLL_COST_REPORT_H
#define ISOROLL_COST_REPORT_H

#include "shell.h"
#include "task/cost/cost_impl.h"

/* The options of `run` for a cell: "--backend point --method taylor --tol 1e-11". */
enum { COST_OPTIONS = 96 };
const char *cost_options_of(const iso_cost_cell *cell, char words[COST_OPTIONS]);

/* A time in ns, us, ms or s: "0.81 ms". */
enum { COST_SECONDS = 24 };
const char *cost_seconds(double seconds, char words[COST_SECONDS]);

/* Prints everything on standard output, as tables and words. */
void cost_print(const iso_scene *scene, const iso_cost_found *found);

#endif

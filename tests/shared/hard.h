/* hard.h - the book of the hard cases. For each case it keeps: why it is hard, what must hold, and what was
 * measured, for every backend and method that can serve it.
 *
 *     hard_topic("1. Geometry numbers");
 *     hard_case("k = 1e-6", "the ball's n at 3 turns against taylor_quad", "q^(1/k) spans 1e5 decades");
 *     for (int i = 0; i < hard_ways; i++) ... hard_hold(&hard_way[i], error, 1e-9);
 *     hard_naive("(24) as it stands, by rk8pd", error, 1e-9);
 *     return hard_summary();
 *
 * Every entry is a test (gsl_test.h), and a line of hard_<topic>.tsv in the working folder. hard_table.sh reads
 * these and makes tests/hard/README.md and hard_cases.md of the build folder.
 */
#ifndef ISO_TESTS_HARD_H
#define ISO_TESTS_HARD_H

#include "laws.h"
#include "orbit/orbit.h"

/* One way to find an orbit. Tolerances are what a user of the method would ask for: 1e-12, of methods of low order
 * less. */
typedef struct hard_road {
    iso_backend backend;
    const iso_method *method; /* NULL with ISO_BACKEND_EXACT */
    double tolerance;
} hard_road;

/* Filled by hard_topic: the ball's ways, the point's, then exact. No taylor_extended or taylor_quad, which are what
 * others are measured by; at the short length every third method, taylor and rk8pd. */
enum { HARD_WAYS = 80 };
extern hard_road hard_way[HARD_WAYS];
extern int hard_ways;

/* A title with its number in the list; first of all calls, once in a program. */
void hard_topic(const char *title);

/* Begins a case: its name (short, heads a column), the quantity that must hold, and the reason why it is hard. */
void hard_case(const char *name, const char *quantity, const char *why);

/* What was measured passes up to its bound; NaN never does. way NULL: it is no matter of backends and methods. */
void hard_hold(const hard_road *way, double measured, double bound);

/* The right answer is to refuse, in these words (of iso_context_message, say). */
void hard_refused(const hard_road *way, bool refused, const char *words);

/* The naive formulation, kept here to show that the case is hard: passes where it breaks the bound, or is NaN. */
void hard_naive(const char *how, double measured, double bound);

/* Writes the table; the program's exit status. */
int hard_summary(void);

/* The orbit at one time of `clock` by one way: ISO_OK, or what iso_orbit_create or iso_orbit_at say. Both models
 * and all clocks are shown where the orbit has them (`both`), else the start's own alone. max_steps bounds the
 * work. */
iso_status hard_solve(iso_context *ctx, const hard_road *way, const iso_params *p, const iso_start *start,
                      const iso_effects *effects, bool both, iso_clock clock, double time, iso_sample *sample);

/* Largest error of the six numbers, relative to each vector's length. */
double hard_error(const double a[ISO_STATE], const double b[ISO_STATE]);

/* --- for naive formulations -------------------------------------------------------------------------------------- */

/* The squares of x by (13), from the roots z1 <= z2 of sum_i x_i^2 (J_j - z)(J_l - z) = 0 as numbers. */
void hard_naive_squares(const double J[3], const double x[3], double square[3]);

#endif

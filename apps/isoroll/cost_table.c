/* cost_table.c - `isoroll cost` on a terminal: a table of all that was measured, and the answer in words. */
#include <math.h>

#include "base/number_impl.h"
#include "cost_report.h"
#include "terminal.h"
#include "study/study_impl.h"

/* --- words ------------------------------------------------------------------------------------------------------ */

const char *cost_options_of(const iso_cost_cell *cell, char words[COST_OPTIONS])
{
    const char *backend = iso_backend_name((int)cell->backend);
    if (cell->method)
        snprintf(words, COST_OPTIONS, "--backend %s --method %s --tol %s", backend, cell->method->name,
                 ISO_SHORT(cell->tolerance));
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

/* --- the table -------------------------------------------------------------------------------------------------- */

enum { MOST_DIGITS = 16 }; /* that a double has; an error may be 0 */

static const char *method_name(const iso_method *method)
{
    return method ? method->name : "closed solution";
}

static void print_head(const iso_scene *scene, const iso_cost *c)
{
    iso_params_print(say_to(), &scene->params);
    say(" (%s); from 0 to %s = %.10g, about %.3g turns\n\n", iso_surface_name((int)scene->params.body.surface),
        scene->start.model == ISO_BALL ? "t" : "s", c->end, c->turns);
    if (iso_effects_watch_contact(&scene->effects))
        say("the motion is followed to the end, also where contact is lost\n\n");
    say("error: the largest relative error of (omega, n), against a reference\nreference: %s\n", c->reference);
    if (isfinite(c->uncertainty))
        say("  uncertain by %.1e: its distance from %s\n\n", c->uncertainty, c->second);
    else
        say("  of unknown uncertainty: there is no second reference to compare it with\n\n");
}

static void say_number(double x)
{
    if (isnan(x))
        say("\t-");
    else
        say("\t%.1e", x);
}

/* Which cell it is: backend, method, tolerance. */
static void say_name(const iso_cost_cell *c, const char *between)
{
    say("%s%s%s", iso_backend_name((int)c->backend), between, method_name(c->method));
    say("%s%s", between, c->method ? ISO_SHORT(c->tolerance) : "-");
}

static void print_cell(const iso_cost_cell *c)
{
    char median[COST_SECONDS], setup[COST_SECONDS];
    say_name(c, "\t");
    if (isnan(c->error))
        say("\t-");
    else
        say("\t%s%s%.1e", c->pareto ? "*" : "", c->below ? "~" : "", c->error);
    say_number(c->clock_error);
    say_number(c->energy_drift);
    say("\t%s\t%.0f %%\t%ld\t%ld\t%s\n", cost_seconds(c->median, median), 100 * (c->slowest - c->fastest) / c->median,
        c->statistics.steps, c->statistics.rhs, cost_seconds(c->setup, setup));
}

static void print_cells(const iso_cost *cost, const iso_cost_series *const *series)
{
    say("\n");
    say_table(3);
    say("backend\tmethod\ttol\terror\tclocks\tenergy\ttime\tspread\tsteps\trhs\tset-up\n");
    for (int l = 0; l < cost->series_count; l++)
        for (int i = series[l]->first; i < series[l]->first + series[l]->count; i++)
            if (iso_cost_is_measured(&cost->cell[i])) print_cell(&cost->cell[i]);
    say_table_end();
    say("  *  nothing else is both more exact and faster\n"
        "  ~  less than the uncertainty of the reference\n"
        "  clocks  error of another clock along the orbit\n"
        "  energy  its drift\n"
        "  time    processor time, median of repeats\n"
        "  spread  slowest - fastest\n"
        "  rhs     evaluations of the equations\n"
        "  set-up  time before the first step\n");
}

static void print_failed(const iso_cost *cost)
{
    if (iso_cost_count(cost, iso_cost_has_failed) > 0) say("\nfailed\n");
    for (int i = 0; i < cost->cells; i++) {
        const iso_cost_cell *c = &cost->cell[i];
        if (!iso_cost_has_failed(c)) continue;
        say("  ");
        say_name(c, " ");
        say("  %s\n", c->why);
    }
}

/* Cells that were not run to the end for want of time: of each series the loosest tolerance of those. */
static void print_left_out(const iso_cost *cost)
{
    int lines = 0;
    for (int l = 0; l < cost->series_count; l++) {
        const iso_cost_series *series = &cost->series[l];
        const iso_cost_cell *c = &cost->cell[series->first], *end = c + series->count;
        while (c < end && c->status != ISO_STOPPED) c++;
        if (c == end) continue;
        if (lines++ == 0) say("\nnot run, because it would take too long\n");
        say("  ");
        say_name(c, " ");
        say(c->method ? " and tighter\n" : "\n");
    }
}

/* --- what the methods give for more time ------------------------------------------------------------------------ */

static void say_time_to(const iso_cost *cost, const iso_cost_series *series, double want)
{
    char words[COST_SECONDS];
    const iso_cost_cell *c = iso_cost_choose_steps(cost, series, want);
    say("\t%s", cost_seconds(c ? c->total : (double)NAN, words));
}

static void print_line(const iso_cost *cost, const iso_cost_series *m)
{
    say("%s\t%s", iso_backend_name((int)m->backend), m->method->name);
    say_time_to(cost, m, 1e-6);
    say_time_to(cost, m, 1e-9);
    say_time_to(cost, m, 1e-12);
    if (isnan(m->digit))
        say("\t-");
    else
        say("\t%.2f times", m->digit);
    if (isnan(m->order) || m->method->order == 0)
        say("\t-");
    else
        say("\t%.1f of %d", m->order, m->method->order);
    say("\t%.1e", m->least);
    if (isnan(m->stops_at))
        say("\t-\n");
    else
        say("\t%s\n", ISO_SHORT(m->stops_at));
}

static void print_lines(const iso_cost *cost, const iso_cost_series *const *series)
{
    say("\nmethods, sorted by their time to an error of 1e-9: time to reach an error, factor in time for one more "
        "digit, order (measured, and of the method), least error, tolerance below which nothing is gained\n");
    say_table(2);
    say("backend\tmethod\tto 1e-6\tto 1e-9\tto 1e-12\ta digit\torder\tleast error\tno gain below\n");
    for (int l = 0; l < cost->series_count; l++)
        if (series[l]->method && !isnan(series[l]->least)) print_line(cost, series[l]);
    say_table_end();
}

/* --- the answer ------------------------------------------------------------------------------------------------- */

static const iso_cost_cell *choose_steps(const iso_cost *cost, double want)
{
    return iso_cost_choose_steps(cost, NULL, want);
}

static void print_choice(const iso_cost_cell *c, int digits)
{
    char words[COST_OPTIONS], seconds[COST_SECONDS];
    say("  for 1e-%-2d  %s: %s (error %.1e%s)\n", digits, cost_options_of(c, words), cost_seconds(c->total, seconds),
        c->error, c->below ? ", or less: the reference is no better" : "");
}

typedef const iso_cost_cell *chooser(const iso_cost *cost, double want);

static const iso_cost_cell *choose_digits(const iso_cost *cost, chooser *choose, int digits)
{
    return digits <= MOST_DIGITS ? choose(cost, pow(10, -digits)) : NULL;
}

/* Each choice once, with the most digits for which it is the choice, beginning with `digits`. Returns the first
 * number of digits that nothing reaches. */
static int print_choices(const iso_cost *cost, chooser *choose, int digits)
{
    const iso_cost_cell *c = choose_digits(cost, choose, digits);
    for (; c; digits++) {
        const iso_cost_cell *next = choose_digits(cost, choose, digits + 1);
        if (next != c) print_choice(c, digits);
        c = next;
    }
    return digits;
}

/* Where the closed solution is the choice, also the best of the methods that take steps. */
static void print_answer(const iso_cost *cost)
{
    say("what to take for an error (times with set-up, on this machine; on others the ratios are similar)\n");
    const int beyond = print_choices(cost, iso_cost_choose, 1);
    if (beyond <= MOST_DIGITS) say("  nothing measured reaches 1e-%d\n", beyond);
    for (int digits = 1; digits < beyond; digits++) {
        if (choose_digits(cost, iso_cost_choose, digits)->method) continue;
        if (!choose_digits(cost, choose_steps, digits)) return;
        say("without the closed solution\n");
        print_choices(cost, choose_steps, digits);
        return;
    }
}

void cost_print(const iso_scene *scene, const iso_cost_found *f)
{
    print_head(scene, f->cost);
    print_answer(f->cost);
    print_cells(f->cost, f->series);
    if (f->cost->complete) print_left_out(f->cost);
    print_failed(f->cost);
    if (iso_cost_choose_steps(f->cost, NULL, INFINITY)) print_lines(f->cost, f->series);
}

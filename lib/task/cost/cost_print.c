/* cost_print.c - what cost tells people: a table of all that was measured, and the answer (study/study.h). */
#include <math.h>

#include "base/number_impl.h"
#include "model/effects/effects_impl.h"
#include "study/study_impl.h"
#include "task/cost/cost_impl.h"

enum { COST_OPTIONS = 96, COST_SECONDS = 24 };

/* --- words ------------------------------------------------------------------------------------------------------ */

static const char *options_of(const iso_cost_cell *cell, char words[COST_OPTIONS])
{
    const char *backend = iso_backend_name((int)cell->backend);
    if (cell->method)
        snprintf(words, COST_OPTIONS, "--backend %s --method %s --tol %s", backend, cell->method->name,
                 ISO_SHORT(cell->tolerance));
    else
        snprintf(words, COST_OPTIONS, "--backend %s", backend);
    return words;
}

static const char *seconds_text(double seconds, char words[COST_SECONDS])
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

static void print_head(FILE *to, const iso_scene *scene, const iso_cost *c)
{
    iso_params_print(to, &scene->params);
    fprintf(to, " (%s); from 0 to %s = %.10g, about %.3g turns\n\n",
            iso_surface_name((int)scene->params.body.surface), scene->start.model == ISO_BALL ? "t" : "s", c->end,
            c->turns);
    if (iso_effects_watch_contact(&scene->effects))
        fputs("the motion is followed to the end, also where contact is lost\n\n", to);
    fprintf(to, "error: the largest relative error of (omega, n), against a reference\nreference: %s\n",
            c->reference);
    if (isfinite(c->uncertainty))
        fprintf(to, "  uncertain by %.1e: its distance from %s\n\n", c->uncertainty, c->second);
    else
        fputs("  of unknown uncertainty: there is no second reference to compare it with\n\n", to);
}

/* Which cell it is: backend, method, tolerance. */
static void print_name(FILE *to, const iso_cost_cell *c, const char *between)
{
    fprintf(to, "%s%s%s", iso_backend_name((int)c->backend), between, method_name(c->method));
    fprintf(to, "%s%s", between, c->method ? ISO_SHORT(c->tolerance) : "-");
}

static void print_cells(FILE *to, const iso_cost *cost, const iso_cost_series *const *series)
{
    char median[COST_SECONDS], setup[COST_SECONDS];
    fputs("\n", to);
    iso_table_begin(to, 3);
    fputs("backend\tmethod\ttol\terror\tclocks\tenergy\ttime\tspread\tsteps\trhs\tset-up\n", to);
    for (int l = 0; l < cost->series_count; l++)
        for (int i = series[l]->first; i < series[l]->first + series[l]->count; i++) {
            const iso_cost_cell *c = &cost->cell[i];
            if (!iso_cost_is_measured(c)) continue;
            print_name(to, c, "\t");
            fprintf(to, isnan(c->error) ? "\t-" : "\t%s%s%.1e", c->pareto ? "*" : "", c->below ? "~" : "", c->error);
            fprintf(to, isnan(c->clock_error) ? "\t-" : "\t%.1e", c->clock_error);
            fprintf(to, isnan(c->energy_drift) ? "\t-" : "\t%.1e", c->energy_drift);
            fprintf(to, "\t%s\t%.0f %%\t%ld\t%ld\t%s\n", seconds_text(c->median, median),
                    100 * (c->slowest - c->fastest) / c->median, c->statistics.steps, c->statistics.rhs,
                    seconds_text(c->setup, setup));
        }
    iso_table_end(to);
    fprintf(to, "  *  nothing else is both more exact and faster\n"
                "  ~  less than the uncertainty of the reference\n"
                "  clocks  error of another clock along the orbit\n"
                "  energy  its drift\n"
                "  time    processor time, median of repeats\n"
                "  spread  slowest - fastest\n"
                "  rhs     evaluations of the equations\n"
                "  set-up  time before the first step\n");
}

static void print_failed(FILE *to, const iso_cost *cost)
{
    if (iso_cost_count(cost, iso_cost_has_failed) > 0) fputs("\nfailed\n", to);
    for (int i = 0; i < cost->cells; i++) {
        const iso_cost_cell *c = &cost->cell[i];
        if (!iso_cost_has_failed(c)) continue;
        fputs("  ", to);
        print_name(to, c, " ");
        fprintf(to, "  %s\n", c->why);
    }
}

/* Cells that were not run to the end for want of time: of each series the loosest tolerance of those. */
static void print_left_out(FILE *to, const iso_cost *cost)
{
    int lines = 0;
    for (int l = 0; l < cost->series_count; l++) {
        const iso_cost_series *series = &cost->series[l];
        const iso_cost_cell *c = &cost->cell[series->first], *end = c + series->count;
        while (c < end && c->status != ISO_STOPPED) c++;
        if (c == end) continue;
        if (lines++ == 0) fputs("\nnot run, because it would take too long\n", to);
        fputs("  ", to);
        print_name(to, c, " ");
        fprintf(to, c->method ? " and tighter\n" : "\n");
    }
}

/* The cheapest cell with an error of so many digits. */
static const iso_cost_cell *choose_digits(const iso_cost *cost, bool steps, const iso_cost_series *series, int digits)
{
    return digits <= MOST_DIGITS ? iso_cost_choose(cost, steps, series, pow(10, -digits)) : NULL;
}

/* --- what the methods give for more time ------------------------------------------------------------------------ */

static void print_lines(FILE *to, const iso_cost *cost, const iso_cost_series *const *series)
{
    char words[COST_SECONDS];
    fprintf(
        to,
        "\nmethods, sorted by their time to an error of 1e-9: time to reach an error, factor in time for one more "
        "digit, order (measured, and of the method), least error, tolerance below which nothing is gained\n");
    iso_table_begin(to, 2);
    fputs("backend\tmethod\tto 1e-6\tto 1e-9\tto 1e-12\ta digit\torder\tleast error\tno gain below\n", to);
    for (int l = 0; l < cost->series_count; l++) {
        const iso_cost_series *m = series[l];
        if (!m->method || isnan(m->least)) continue;
        fprintf(to, "%s\t%s", iso_backend_name((int)m->backend), m->method->name);
        for (int digits = 6; digits <= 12; digits += 3) {
            const iso_cost_cell *c = choose_digits(cost, true, m, digits);
            fprintf(to, "\t%s", seconds_text(c ? c->total : (double)NAN, words));
        }
        fprintf(to, isnan(m->digit) ? "\t-" : "\t%.2f times", m->digit);
        fprintf(to, isnan(m->order) || m->method->order == 0 ? "\t-" : "\t%.1f of %d", m->order, m->method->order);
        fprintf(to, isnan(m->stops_at) ? "\t%.1e\t-\n" : "\t%.1e\t%s\n", m->least, ISO_SHORT(m->stops_at));
    }
    iso_table_end(to);
}

/* --- the answer ------------------------------------------------------------------------------------------------- */

/* Each choice once, with the most digits for which it is the choice, beginning with `digits`. Returns the first
 * number of digits that nothing reaches. */
static int print_choices(FILE *to, const iso_cost *cost, bool steps, int digits)
{
    char words[COST_OPTIONS], seconds[COST_SECONDS];
    const iso_cost_cell *c = choose_digits(cost, steps, NULL, digits);
    for (; c; digits++) {
        const iso_cost_cell *next = choose_digits(cost, steps, NULL, digits + 1);
        if (next != c)
            fprintf(to, "  for 1e-%-2d  %s: %s (error %.1e%s)\n", digits, options_of(c, words),
                    seconds_text(c->total, seconds), c->error,
                    c->below ? ", or less: the reference is no better" : "");
        c = next;
    }
    return digits;
}

/* Where the closed solution is the choice, also the best of the methods that take steps. */
static void print_answer(FILE *to, const iso_cost *cost)
{
    fputs("what to take for an error (times with set-up, on this machine; on others the ratios are similar)\n", to);
    const int beyond = print_choices(to, cost, false, 1);
    if (beyond <= MOST_DIGITS) fprintf(to, "  nothing measured reaches 1e-%d\n", beyond);
    for (int digits = 1; digits < beyond; digits++) {
        if (choose_digits(cost, false, NULL, digits)->method) continue;
        if (!choose_digits(cost, true, NULL, digits)) return;
        fputs("without the closed solution\n", to);
        print_choices(to, cost, true, digits);
        return;
    }
}

void iso_cost_expected(const iso_cost_found *f, char text[static ISO_COST_EXPECTED])
{
    char seconds[COST_SECONDS];
    const iso_cost_cell *c = f->choice;
    if (!c)
        snprintf(text, ISO_COST_EXPECTED, "nothing measured reaches an error of %s: try a larger --want",
                 ISO_SHORT(f->want));
    else
        snprintf(text, ISO_COST_EXPECTED, "expected: error %.1e%s, time %s", c->error,
                 c->below ? ", or less: the reference is no better" : "", seconds_text(c->total, seconds));
}

void iso_cost_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    char words[COST_OPTIONS];
    const iso_cost_found *f = result->found;
    (void)options;
    if (!f->series) return;
    if (!isnan(f->want)) { /* the choice, as options of `run` */
        if (f->choice) fprintf(to, "%s\n", options_of(f->choice, words));
        return;
    }
    print_head(to, scene, f->cost);
    print_answer(to, f->cost);
    print_cells(to, f->cost, f->series);
    if (f->cost->complete) print_left_out(to, f->cost);
    print_failed(to, f->cost);
    if (iso_cost_choose(f->cost, true, NULL, INFINITY)) print_lines(to, f->cost, f->series);
}

iso_status iso_cost_describe(iso_context *ctx, const iso_scene *scene, const void *options, iso_study_result *result)
{
    const iso_cost *c = ((const iso_cost_found *)result->found)->cost;
    iso_record *table = result->table[0];
    char ball[ISO_BALL_SIZE];
    (void)options;
    ISO_TRY(iso_record_set_numbers(ctx, table, "end", 1, &c->end));
    ISO_TRY(iso_record_set(ctx, table, "reference", c->reference));
    ISO_TRY(iso_record_set(ctx, table, "second reference", c->second));
    if (!isnan(c->uncertainty)) ISO_TRY(iso_record_set_numbers(ctx, table, "uncertainty", 1, &c->uncertainty));
    return iso_study_title(ctx, result, "%s, %s = %.6g, about %.3g turns", iso_ball_text(ball, &scene->params),
                           scene->start.model == ISO_BALL ? "t" : "s", c->end, c->turns);
}

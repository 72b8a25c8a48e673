/* cost_growth.c - how error and time of one cell grow with the length of the orbit. */
#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "method/methods_impl.h"
#include "study/chaos/chaos.h"
#include "study/cost/cost_impl.h"

/* Output times in each doubling of the length, and in all. */
enum { TIMES = 20, MOST_TIMES = TIMES * ISO_COST_HORIZONS, REPEATS = 7, LEAST_REPEATS = 3 };

/* Seconds for everything, of these for the references and for the errors of the cell. A horizon is timed again until
 * its runs have taken MOMENT. */
static const double SECONDS = 40, REFERENCES = 20, ERRORS = 10, MOMENT = 0.1;

/* The growth is fitted to errors that are larger than so many uncertainties of the reference, and smaller than
 * LOST. */
static const double UNCERTAINTIES = 3, LOST = 0.1;

typedef struct grower {
    cost_problem p;
    iso_cost_cell cell;
    cost_reference reference;
    cost_track track;
    double time[MOST_TIMES], error[MOST_TIMES], uncertainty[MOST_TIMES];
    iso_cost_growth *out;
} grower;

/* --- how far ---------------------------------------------------------------------------------------------------- */

/* The time that the scene's own end takes. */
static iso_status probe(grower *g, iso_backend backend, const iso_method *method, double tolerance, double *seconds)
{
    cost_track track;
    iso_status status = iso_cost_track_make(&g->p, TIMES, g->time, &track);
    if (status == ISO_OK) status = iso_cost_walk(&g->p, backend, method, tolerance, false, ERRORS, &track);
    *seconds = track.seconds;
    iso_cost_track_free(&track);
    return status;
}

/* As many horizons as fit into SECONDS. Time is proportional to length, except for the closed solution; a cell is run
 * about eight times, references twice. */
static iso_status choose_horizons(grower *g, int *horizons)
{
    double own, series;
    const iso_cost_cell *c = &g->cell;
    const iso_status status = probe(g, c->backend, c->method, c->tolerance, &own);
    if (status != ISO_OK)
        return iso_cost_is_stopped(&g->p) ? iso_context_stopped(g->p.user)
                                          : ISO_FAIL_NUMERICAL(g->p.user, "the run does not get to %s: %s",
                                                               ISO_SHORT(g->p.end), iso_context_message(g->p.ctx));
    const iso_method *const fine = iso_method_with_more_digits(ISO_DOUBLE_DIGITS); /* as for a reference */
    if (!fine || probe(g, (iso_backend)g->p.scene->start.model, fine, 1e-15, &series) != ISO_OK) series = 0;
    const double unit = (c->method ? 8 * own : 0) + 2.5 * series, most = 1 + floor(log2(fmax(1, SECONDS / unit)));
    if (most >= *horizons) return ISO_OK;
    *horizons = (int)most;
    snprintf(g->out->why, sizeof g->out->why, "longer orbits would take more than %g s", SECONDS);
    return ISO_OK;
}

static void fill_times(grower *g, int horizons)
{
    for (int h = 0; h < horizons; h++)
        for (int i = 0; i < TIMES; i++) {
            const double share = (i + 1.0) / TIMES, half = ldexp(g->p.end, h - 1);
            g->time[TIMES * h + i] = h == 0 ? g->p.end * share : half * (1 + share);
        }
}

/* --- errors and times ------------------------------------------------------------------------------------------- */

/* The largest error up to each time, and the uncertainty of the reference. The error of the closed solution is
 * measured against the second reference, whose uncertainty is not known. */
static void measure_errors(grower *g)
{
    const cost_reference *r = &g->reference;
    const cost_track *against = g->cell.backend == ISO_BACKEND_EXACT ? &r->second : &r->first;
    double error = 0, uncertainty = 0;
    for (int i = 0; i < g->track.reached; i++) {
        g->error[i] = error = fmax(error, iso_cost_distance_at(&g->track, against, i));
        uncertainty = r->doubted ? fmax(uncertainty, iso_cost_distance_at(&r->first, &r->second, i)) : INFINITY;
        g->uncertainty[i] = g->cell.backend == ISO_BACKEND_EXACT ? NAN : uncertainty;
    }
}

static iso_status find_errors(grower *g, int horizons)
{
    const iso_cost_cell *c = &g->cell;
    ISO_TRY(iso_cost_reference_find(&g->p, TIMES * horizons, g->time, REFERENCES, true, &g->reference));
    const int reached = g->reference.first.reached / TIMES;
    if (reached == 0) return ISO_FAIL_NUMERICAL(g->p.user, "no reference gets to %s", ISO_SHORT(g->p.end));
    ISO_TRY(iso_cost_track_make(&g->p, TIMES * reached, g->time, &g->track));
    if (reached < horizons) snprintf(g->out->why, sizeof g->out->why, "no reference gets farther");
    const iso_status status = iso_cost_walk(&g->p, c->backend, c->method, c->tolerance, false, ERRORS, &g->track);
    if (iso_cost_is_stopped(&g->p)) return iso_context_stopped(g->p.user);
    if (status != ISO_OK)
        snprintf(g->out->why, sizeof g->out->why, "%.159s",
                 status == ISO_STOPPED ? "it would take too long" : iso_context_message(g->p.ctx));
    measure_errors(g);
    return ISO_OK;
}

static bool time_horizon(grower *g, double end, cost_times *times)
{
    double about = 0, sum = 0;
    iso_statistics unused;
    for (int i = 0; i < REPEATS && (i < LEAST_REPEATS || sum < MOMENT) && !iso_cost_is_stopped(&g->p); i++) {
        if (iso_cost_time(&g->p, &g->cell, end, about, &times->setup[i], &times->stepping[i], &unused) != ISO_OK)
            return false;
        about = times->stepping[i];
        sum += about;
        times->count++;
    }
    return times->count > 0;
}

static void measure_horizons(grower *g)
{
    iso_cost_growth *out = g->out;
    for (int h = 0; h < g->track.reached / TIMES; h++) {
        const int last = TIMES * (h + 1) - 1;
        cost_times times = {0};
        iso_cost_cell timed = g->cell;
        if (!time_horizon(g, g->time[last], &times)) return;
        iso_cost_times_read(&times, &timed);
        out->at[h].end = g->time[last];
        out->at[h].error = g->error[last];
        out->at[h].uncertainty = g->uncertainty[last];
        out->at[h].seconds = timed.median;
        out->count = h + 1;
    }
}

/* --- fits ------------------------------------------------------------------------------------------------------- */

/* y = a + slope x by least squares; gives the mean square of what is left. */
static double fit(int count, const double x[], const double y[], double *slope)
{
    double a, covariance[3], rest;
    gsl_fit_linear(x, 1, y, 1, (size_t)count, &a, slope, &covariance[0], &covariance[1], &covariance[2], &rest);
    return rest / count;
}

/* The indicators of chaos (chaos.h) tell whether the orbit is chaotic, and its exponent. So all cells of a scene have
 * the same answer, whatever part of the growth their errors show. If the indicators do not decide, or cannot be
 * computed, the errors decide. Errors on regular orbits grow like t or t^2. If the fitted power is above STEEP and an
 * exponential fits better, the orbit is chaotic. */
static const double STEEP = 3, INDICATORS = 5;

static iso_status ask_indicators(grower *g, iso_verdict *verdict, double *exponent)
{
    const int model = g->cell.backend == ISO_BACKEND_BALL ? ISO_BALL : ISO_POINT;
    iso_chaos *c;
    *exponent = NAN;
    iso_cost_allow(&g->p, INDICATORS);
    const iso_status status = iso_chaos_run(g->p.ctx, g->p.scene, NULL, &c);
    *verdict = status == ISO_OK ? c->own.verdict : ISO_UNDECIDED;
    if (status == ISO_OK) *exponent = c->own.result[c->with[model] ? model : 1 - model].exponent[g->p.clock];
    iso_chaos_free(c);
    return status == ISO_NO_MEMORY ? iso_context_no_memory(g->p.user, "the indicators") : ISO_OK;
}

static void fit_errors(const grower *g, iso_verdict verdict, double exponent)
{
    double t[MOST_TIMES], log_t[MOST_TIMES], e[MOST_TIMES], rate;
    iso_cost_growth *out = g->out;
    int count = 0;
    for (int i = 0; i < TIMES * out->count; i++) {
        if (g->error[i] < UNCERTAINTIES * g->uncertainty[i] || !(g->error[i] > 0 && g->error[i] < LOST)) continue;
        t[count] = fabs(g->time[i]);
        log_t[count] = log(t[count]);
        e[count++] = log(g->error[i]);
    }
    out->chaotic = verdict == ISO_CHAOTIC;
    out->power = NAN;
    out->lyapunov_time = out->chaotic ? 1 / exponent : (double)NAN;
    if (count < TIMES / 2) return;
    const double by_power = fit(count, log_t, e, &out->power), exponential = fit(count, t, e, &rate);
    if (verdict != ISO_UNDECIDED) return;
    out->chaotic = out->power > STEEP && exponential < by_power;
    if (out->chaotic) out->lyapunov_time = 1 / rate;
}

static void fit_seconds(iso_cost_growth *out)
{
    double t[ISO_COST_HORIZONS], s[ISO_COST_HORIZONS];
    for (int h = 0; h < out->count; h++) {
        t[h] = log(fabs(out->at[h].end));
        s[h] = log(out->at[h].seconds);
    }
    out->time_power = NAN;
    if (out->count > 1) fit(out->count, t, s, &out->time_power);
}

/* --- all of it -------------------------------------------------------------------------------------------------- */

static iso_status grow(grower *g, int horizons)
{
    fill_times(g, horizons);
    iso_verdict verdict;
    double exponent;
    ISO_TRY(choose_horizons(g, &horizons));
    ISO_TRY(find_errors(g, horizons));
    snprintf(g->out->reference, sizeof g->out->reference, "%s",
             g->cell.backend == ISO_BACKEND_EXACT ? g->reference.second_what : g->reference.what);
    snprintf(g->out->second, sizeof g->out->second, "%s", g->reference.second_what);
    measure_horizons(g);
    ISO_TRY(ask_indicators(g, &verdict, &exponent));
    fit_errors(g, verdict, exponent);
    fit_seconds(g->out);
    return iso_cost_is_stopped(&g->p) ? iso_context_stopped(g->p.user) : ISO_OK;
}

iso_status iso_cost_grow(iso_context *ctx, const iso_scene *scene, const iso_cost_cell *cell, int horizons,
                         iso_cost_growth *growth)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_cost_options o = iso_cost_defaults();
    *growth = (iso_cost_growth){.power = NAN, .time_power = NAN, .lyapunov_time = NAN};
    if (horizons < 1 || horizons > ISO_COST_HORIZONS)
        return ISO_FAIL_ARGUMENT(ctx, "horizons", "horizons = %d is not in [1, %d]", horizons, ISO_COST_HORIZONS);
    grower *g = calloc(1, sizeof *g);
    if (!g) return iso_context_no_memory(ctx, "the horizons");
    g->cell = *cell;
    g->out = growth;
    o.backend = cell->backend;
    o.method = cell->method;
    if (cell->method) o.tolerance = cell->tolerance;
    iso_status status = iso_cost_problem_open(&g->p, ctx, scene, &o);
    if (status == ISO_OK) status = grow(g, horizons);
    iso_cost_reference_free(&g->reference);
    iso_cost_track_free(&g->track);
    iso_cost_problem_close(&g->p);
    free(g);
    return status;
}

/* cost.c - measures error and time of every backend, method and tolerance on one scene, see cost.h. */
#include "task/cost/cost.h"
#include "base/number_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/arithmetic_impl.h"
#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "task/cost/cost_impl.h"

/* How the time is divided: REFERENCES is the part for references. Of the rest each cell may use so much that it can
 * be run RUNS times. */
static const double QUICK = 3, LONG = 40, REFERENCES = 0.3, RUNS = 5;

/* A run that takes less than this many seconds is run once more before it is timed. */
static const double MOMENT = 1e-3;

/* A cell may take so many times its fair share of the time, because most cells take less. */
static const double GENEROUS = 8;

enum { LEAST_REPEATS = 3, MOST_LINES = 128, MOST_TOLERANCES = 8 };

static const double quick_tolerances[] = {1e-6, 1e-9, 1e-12};
static const double all_tolerances[] = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15};

typedef struct measurer {
    cost_problem p;
    const iso_cost_options *options;
    iso_cost *out;
    cost_reference reference;
    double *time, begin, seconds;
    cost_times *times; /* of each cell */
    int tolerances;
    const double *tolerance;
    double promised; /* seconds that the least repeats of what was checked will take */
    double share;    /* done */
} measurer;

static double elapsed(const measurer *m)
{
    return processor_seconds() - m->begin;
}

static void report_progress(measurer *m, const char *what)
{
    m->share = fmax(m->share, fmin(1, elapsed(m) / m->seconds));
    if (m->options->progress) m->options->progress(m->options->data, m->share, what);
}

/* --- which cells ------------------------------------------------------------------------------------------------ */

static iso_cost_series *add_line(measurer *m, iso_backend backend, const iso_method *method, int count)
{
    iso_cost *c = m->out;
    iso_cost_series *series = &c->series[c->series_count++];
    *series = (iso_cost_series){backend, method, c->cells, count, NAN, NAN, NAN, NAN};
    for (int i = 0; i < count; i++) {
        iso_cost_cell *cell = &c->cell[c->cells++];
        *cell = (iso_cost_cell){.backend = backend, .method = method, .status = ISO_STOPPED, .why = "not reached"};
        cell->tolerance = method ? m->tolerance[i] : NAN;
        cell->error = cell->clock_error = cell->energy_drift = cell->constraint_drift = cell->setup = NAN;
        cell->fastest = cell->median = cell->slowest = cell->total = NAN;
    }
    return series;
}

/* Whether this backend and method can compute the scene at all. */
static bool serves(measurer *m, iso_backend backend, const iso_method *method)
{
    iso_orbit *orbit;
    const iso_system *system = backend == ISO_BACKEND_BALL ? &iso_system_ball : &iso_system_point;
    if (method && method->system && method->system != system) return false;
    const iso_status status = iso_cost_orbit_open(&m->p, backend, method, 1e-6, false, &orbit);
    iso_orbit_free(orbit);
    return status == ISO_OK;
}

static void list_lines(measurer *m)
{
    const iso_cost_options *o = m->options;
    for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
        if ((o->backend != ISO_BACKEND_AUTO && o->backend != backend) || !serves(m, backend, NULL)) continue;
        if (o->method && serves(m, backend, o->method)) add_line(m, backend, o->method, m->tolerances);
        for (int i = 0; !o->method && iso_methods[i] && m->out->series_count < MOST_LINES - 1; i++)
            if (!iso_methods[i]->reference && serves(m, backend, iso_methods[i]))
                add_line(m, backend, iso_methods[i], m->tolerances);
    }
    if ((o->backend == ISO_BACKEND_AUTO || o->backend == ISO_BACKEND_EXACT) && !o->method &&
        serves(m, ISO_BACKEND_EXACT, NULL))
        add_line(m, ISO_BACKEND_EXACT, NULL, 1);
}

static iso_status choose_cells(measurer *m)
{
    const bool quick = m->options->quick, one = m->options->tolerance != 0;
    m->tolerance = one ? &m->options->tolerance : quick ? quick_tolerances : all_tolerances;
    m->tolerances = one ? 1 : (int)((quick ? sizeof quick_tolerances : sizeof all_tolerances) / sizeof(double));
    const size_t most = (size_t)MOST_LINES * MOST_TOLERANCES;
    m->out->series = calloc(MOST_LINES, sizeof *m->out->series);
    m->out->cell = calloc(most, sizeof *m->out->cell);
    m->times = calloc(most, sizeof *m->times);
    if (!m->out->series || !m->out->cell || !m->times) return iso_context_no_memory(m->p.user, "the cells");
    list_lines(m);
    return ISO_OK;
}

/* --- errors ----------------------------------------------------------------------------------------------------- */

static void __attribute__((format(printf, 3, 4)))
fail(iso_cost_cell *cell, iso_status status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(cell->why, sizeof cell->why, format, args);
    va_end(args);
    cell->status = status;
}

/* The error of one cell, from a run that may take so many seconds, and that of its clock, from another run. *about is
 * the time of the first run. */
static void check_cell(measurer *m, iso_cost_cell *cell, double seconds, double *about)
{
    const cost_reference *r = &m->reference;
    const bool exact = cell->backend == ISO_BACKEND_EXACT;
    const cost_track *against = exact ? &r->second : &r->first;
    cost_track track;
    iso_status status = iso_cost_track_make(&m->p, m->reference.first.times, m->time, &track);
    if (status != ISO_OK) {
        fail(cell, status, "%s", iso_context_message(m->p.user));
        return;
    }
    status = iso_cost_walk(&m->p, cell->backend, cell->method, cell->tolerance, false, seconds, &track);
    *about = track.seconds;
    if (status == ISO_OK) {
        cell->status = ISO_OK;
        cell->why[0] = 0;
        /* the closed solution is compared with the second reference, because the first may be itself */
        cell->error = exact && !r->doubted ? NAN : iso_cost_distance(&track, against);
        cell->energy_drift = track.energy_drift;
        cell->constraint_drift = track.constraint_drift;
        cell->statistics = track.statistics;
        cell->below = !exact && cell->error < 3 * r->uncertainty;
        if (iso_cost_walk(&m->p, cell->backend, cell->method, cell->tolerance, true, 2 * seconds, &track) == ISO_OK)
            cell->clock_error = iso_cost_clock_distance(&track, against);
    } else if (status != ISO_STOPPED) {
        fail(cell, status, "%s", iso_context_message(m->p.ctx));
    } else if (!iso_cost_is_stopped(&m->p)) {
        fail(cell, ISO_STOPPED, "it would take more than %.2g s, its share of the time", seconds);
    }
    iso_cost_track_free(&track);
}

/* How long the next of `left` cells may run. */
static double share_of(const measurer *m, int left)
{
    const double rest = fmax(m->seconds - elapsed(m) - m->promised, 0.01 * m->seconds);
    return rest / RUNS * fmin(1, GENEROUS / left);
}

/* All series at the loosest tolerance, then all at the next: when the time is over every series has some cells. */
static void check_cells(measurer *m, double about[])
{
    int left = m->out->cells;
    bool alive[MOST_LINES];
    for (int l = 0; l < m->out->series_count; l++) alive[l] = true;
    for (int i = 0; i < m->tolerances || i == 0; i++)
        for (int l = 0; l < m->out->series_count && !iso_cost_is_stopped(&m->p); l++) {
            const iso_cost_series *series = &m->out->series[l];
            if (i >= series->count || !alive[l]) continue;
            iso_cost_cell *cell = &m->out->cell[series->first + i];
            double *took = &about[series->first + i];
            check_cell(m, cell, share_of(m, left--), took);
            if (cell->status == ISO_OK) /* short runs are run once before, and several are timed at once */
                m->promised += LEAST_REPEATS * (*took < MOMENT ? 2 * *took + MOMENT / 10 : *took);
            report_progress(m, cell->method ? cell->method->name : "exact");
            if (cell->status != ISO_STOPPED || iso_cost_is_stopped(&m->p)) continue;
            alive[l] = false;
            for (int j = i + 1; j < series->count; j++)
                fail(&m->out->cell[series->first + j], ISO_STOPPED, "not tried: it takes too long at tolerance %s",
                     ISO_SHORT(m->tolerance[i]));
            left -= series->count - i - 1;
        }
}

/* --- times ------------------------------------------------------------------------------------------------------ */

/* Times all cells once in each round, until all times are settled or the time is over. */
static void time_cells(measurer *m, const double about[])
{
    int open = 1;
    for (int round = 0; open > 0; round++) {
        open = 0;
        for (int i = 0; i < m->out->cells; i++) {
            iso_cost_cell *cell = &m->out->cell[i];
            if (iso_cost_is_stopped(&m->p) || (round >= LEAST_REPEATS && elapsed(m) > m->seconds)) return;
            if (cell->status != ISO_OK || iso_cost_times_settled(&m->times[i])) continue;
            cost_times *times = &m->times[i];
            const int n = times->count;
            const iso_status status = iso_cost_time(&m->p, cell, m->p.end, n > 0 ? times->stepping[n - 1] : about[i],
                                                    &times->setup[n], &times->stepping[n], &cell->statistics);
            times->count += status == ISO_OK;
            if (status != ISO_OK && !m->p.monitor.stopped) fail(cell, status, "%s", iso_context_message(m->p.ctx));
            open++;
            report_progress(m, "times");
        }
    }
}

/* --- all of it -------------------------------------------------------------------------------------------------- */

static iso_status find_reference(measurer *m)
{
    const int times = m->options->times > 0 ? m->options->times : 20;
    m->time = calloc((size_t)times, sizeof *m->time);
    if (!m->time) return iso_context_no_memory(m->p.user, "%d times", times);
    for (int i = 0; i < times; i++) m->time[i] = i + 1 == times ? m->p.end : m->p.end * ((i + 1.0) / times);
    report_progress(m, "reference");
    ISO_TRY(iso_cost_reference_find(&m->p, times, m->time, REFERENCES * m->seconds, &m->reference));
    snprintf(m->out->reference, sizeof m->out->reference, "%s", m->reference.what);
    snprintf(m->out->second, sizeof m->out->second, "%s", m->reference.second_what);
    m->out->uncertainty = m->reference.uncertainty;
    const cost_track *t = &m->reference.first;
    double mean = 0;
    for (int i = 0; i < t->reached; i++) { /* the normal's speed is |k omega x n| */
        double speed[3];
        cross(t->row[i].ball, t->row[i].ball + 3, speed);
        mean += hypot(hypot(speed[0], speed[1]), speed[2]) / t->reached;
    }
    const double end = m->p.clock == ISO_CLOCK_T ? m->p.end : t->row[t->reached - 1].clock;
    m->out->turns = fabs(m->p.scene->params.k * mean * end) / (2 * ISO_PI);
    return ISO_OK;
}

static iso_status measure(measurer *m)
{
    iso_cost *c = m->out;
    ISO_TRY(find_reference(m));
    ISO_TRY(choose_cells(m));
    double *about = calloc((size_t)c->cells + 1, sizeof *about);
    if (!about) return iso_context_no_memory(m->p.user, "the cells");
    check_cells(m, about);
    time_cells(m, about);
    for (int i = 0; i < c->cells; i++) {
        cost_times *times = &m->times[i];
        /* a stop leaves it without a time: it gets that of the run that gave its error, with set-up */
        if (c->cell[i].status == ISO_OK && times->count == 0) times->count = 1, times->stepping[0] = about[i];
        iso_cost_times_read(times, &c->cell[i]);
    }
    free(about);
    iso_cost_evaluate(c);
    c->complete = !iso_cost_is_stopped(&m->p);
    return c->complete ? ISO_OK : iso_context_stopped(m->p.user);
}

iso_status iso_cost_measure(iso_context *ctx, const iso_scene *scene, const iso_cost_options *options,
                            iso_cost **cost)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_cost_options own = iso_cost_defaults();
    measurer m = {.options = &own, .begin = processor_seconds()};
    *cost = NULL;
    if (options) own = *options;
    m.seconds = own.seconds > 0 ? own.seconds : own.quick ? QUICK : LONG;
    ISO_TRY(iso_cost_problem_open(&m.p, ctx, scene, &own));
    m.out = calloc(1, sizeof *m.out);
    iso_status status = m.out ? ISO_OK : iso_context_no_memory(ctx, "the measurement");
    if (status == ISO_OK) {
        *m.out = (iso_cost){.end = m.p.end, .turns = NAN, .uncertainty = INFINITY};
        status = measure(&m);
        m.out->seconds = elapsed(&m);
        m.share = 1;
        report_progress(&m, "done");
    }
    iso_cost_reference_free(&m.reference);
    free(m.time);
    free(m.times);
    iso_cost_problem_close(&m.p);
    if (status == ISO_OK || (status == ISO_STOPPED && m.out->cells > 0))
        *cost = m.out;
    else
        iso_cost_free(m.out);
    return status;
}

void iso_cost_free(iso_cost *cost)
{
    if (!cost) return;
    free(cost->cell);
    free(cost->series);
    free(cost);
}

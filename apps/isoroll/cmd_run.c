/* isoroll run - integrate a scene and write its trajectory. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene_options.h"
#include "times.h"

/* What run can be told. */
typedef struct options {
    scene_options scene;
    const char *output;
    const char *times; /* NULL: not given */
    bool verbose;
} options;

/* What is being done, for the bar. */
typedef struct work {
    const iso_orbit *orbit;
    double farthest; /* time */
} work;

static iso_status describe(iso_context *ctx, const iso_scene *scene, const iso_orbit *orbit, const int columns[],
                           int count, iso_record **header)
{
    const char *names[ISO_TRAJECTORY_COLUMNS];
    for (int i = 0; i < count; i++) names[i] = iso_trajectory_columns[columns[i]];
    const iso_picture as = scene->as == ISO_AUTO ? scene->start.model : scene->as;
    iso_status status = iso_record_create(ctx, (size_t)count, names, header);
    if (status == ISO_OK)
        status = iso_record_describe(ctx, *header, iso_picture_name((int)as), &scene->params, orbit);
    if (status == ISO_OK)
        status = iso_record_set(ctx, *header, "backend", iso_picture_name((int)iso_orbit_backend(orbit)));
    if (status == ISO_OK) status = iso_record_set(ctx, *header, "method", iso_orbit_method(orbit)->name);
    if (status == ISO_OK && !iso_orbit_exact(orbit))
        status = iso_record_set_numbers(ctx, *header, "tolerance", 1, &scene->tolerance);
    if (status == ISO_OK) status = iso_record_set(ctx, *header, "isoroll", ISO_VERSION);
    return status;
}

/* Asked at each step: shows how far the orbit is on its way to the farthest time. */
static bool go_on(void *data)
{
    static unsigned steps;
    const work *w = data;
    if (steps++ % 256 == 0 && w->farthest != 0) progress_show(fabs(iso_orbit_reached(w->orbit) / w->farthest));
    return !interrupted();
}

/* Where the ball leaves the support it is pressed to: looked for from row to row, before and after the start apart. */
typedef struct contact {
    bool watched, lost[2]; /* after the start, and before it                 */
    double last[2];        /* times looked at so far, or where contact is lost */
} contact;

/* Nothing presses the ball at the start: on which sides of it does the support pull a moment later? */
static iso_status look_both_ways(const iso_scene *scene, iso_orbit *orbit, contact *c)
{
    c->watched = true;
    for (int side = 0; side < 2; side++) {
        iso_sample sample;
        const double moment = (side ? -1e-6 : 1e-6) * (scene->end != 0 ? fabs(scene->end) : 1);
        const iso_status status = iso_orbit_at(orbit, moment, &sample);
        if (status != ISO_OK) return status;
        c->lost[side] = sample.pressure < 0;
    }
    if (c->lost[scene->end < 0]) complain("contact is lost at 0: there is a row there, and none beyond");
    return ISO_OK;
}

/* A ball that is pressed to its support at the start can lose it. */
static iso_status watch_contact(const iso_scene *scene, iso_orbit *orbit, contact *c)
{
    iso_sample sample;
    *c = (contact){.watched = false};
    if (!scene->effects.on[ISO_REACTIONS] || scene->effects.two_sided) return ISO_OK;
    const iso_status status = iso_orbit_at(orbit, 0, &sample);
    if (status != ISO_OK) return status;
    c->watched = sample.pressure > 0;
    if (sample.pressure == 0 && scene->effects.on[ISO_GRAVITY] && scene->params.k != 1)
        return look_both_ways(scene, orbit, c);
    if (sample.pressure < 0)
        complain("the support would have to pull the ball from the start (pressure %.3g): this is the motion of a "
                 "two-sided contact",
                 sample.pressure);
    return ISO_OK;
}

/* The sample at `time`; where contact is lost on the way there, the one at the loss, once: *row false for times beyond. */
static iso_status take_sample(iso_orbit *orbit, double time, contact *c, iso_sample *sample, bool *row)
{
    const int side = time < 0;
    const iso_clock clock = iso_orbit_model(orbit)->clock;
    *row = true;
    if (!c->watched || fabs(time) <= fabs(c->last[side])) return iso_orbit_at(orbit, time, sample);
    *row = !c->lost[side];
    if (c->lost[side]) return ISO_OK;
    const iso_status status = iso_orbit_lost_contact(orbit, c->last[side], time, &c->lost[side], sample);
    if (status != ISO_OK) return status;
    c->last[side] = c->lost[side] ? sample->clock[clock] : time;
    if (!c->lost[side]) return iso_orbit_at(orbit, time, sample);
    complain("contact is lost at %s = %.17g: there is a row there, and none beyond", iso_clock_name(clock),
             c->last[side]);
    return ISO_OK;
}

/* Rows that are found in another order than that of the file, until all are there. */
typedef struct shelf {
    double *numbers;
    bool *filled;
} shelf;

static iso_status make_shelf(iso_context *ctx, const times *t, int count, shelf *s)
{
    *s = (shelf){.filled = NULL};
    if (!t->order) return ISO_OK;
    s->numbers = malloc(t->count * (size_t)count * sizeof *s->numbers);
    s->filled = calloc(t->count, sizeof *s->filled);
    return s->numbers && s->filled ? ISO_OK : iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for the rows");
}

static void fill_row(const iso_sample *sample, const int columns[], int count, double row[])
{
    for (int c = 0; c < count; c++) row[c] = iso_sample_column(sample, columns[c]);
}

/* What there is, in the order of the file; after a failure, too. */
static iso_status empty_shelf(iso_context *ctx, shelf *s, const times *t, int count, iso_trajectory_writer *writer,
                              size_t *written)
{
    iso_status status = ISO_OK;
    for (size_t i = 0; s->filled && s->numbers && i < t->count && status == ISO_OK; i++) {
        if (!s->filled[i]) continue;
        status = iso_trajectory_write_row(ctx, writer, s->numbers + i * (size_t)count, (size_t)count);
        *written += status == ISO_OK;
    }
    free(s->numbers);
    free(s->filled);
    return status;
}

static iso_status write_rows(iso_context *ctx, iso_orbit *orbit, const times *t, const int columns[], int count,
                             iso_trajectory_writer *writer, iso_error_rows *rows, size_t *written)
{
    work w = {orbit, times_farthest(t)};
    contact c;
    shelf s;
    iso_status status = make_shelf(ctx, t, count, &s);
    if (status == ISO_OK) status = watch_contact(t->scene, orbit, &c);
    iso_context_watch(ctx, go_on, &w);
    *written = 0;
    for (size_t i = 0; status == ISO_OK && i < t->count; i++) {
        const output_time at = times_at(t, i);
        double numbers[ISO_TRAJECTORY_COLUMNS];
        iso_sample sample;
        bool row = true;
        status = interrupted() ? iso_context_fail(ctx, ISO_STOPPED, "", "stopped on request")
                               : take_sample(orbit, at.time, &c, &sample, &row);
        if (status != ISO_OK || !row) continue;
        fill_row(&sample, columns, count, t->order ? s.numbers + at.row * (size_t)count : numbers);
        if (t->order)
            s.filled[at.row] = true;
        else if ((status = iso_trajectory_write_row(ctx, writer, numbers, (size_t)count)) == ISO_OK)
            ++*written;
        if (status == ISO_OK && rows) iso_error_keep(rows, &sample);
    }
    const iso_status shelved = empty_shelf(ctx, &s, t, count, writer, written);
    return status == ISO_OK ? shelved : status;
}

static void tell(const iso_orbit *orbit, size_t rows)
{
    const iso_statistics s = iso_orbit_statistics(orbit);
    if (iso_orbit_exact(orbit)) {
        complain("%zu rows; backend exact: %ld states", rows, s.states);
        return;
    }
    complain("%zu rows; backend %s, method %s: %ld steps, %ld rejected, %ld right-hand sides, %ld Jacobians; largest "
             "correction by projection %.2g",
             rows, iso_picture_name((int)iso_orbit_backend(orbit)), iso_orbit_method(orbit)->name, s.steps,
             s.rejected, s.rhs, s.jacobians, s.correction);
}

/* Up to two digits: what is said to be at most so large must be. */
static double rounded_up(double x)
{
    const double unit = x > 0 && isfinite(x) ? pow(10, floor(log10(x)) - 1) : 1;
    return ceil(x / unit) * unit;
}

static void tell_error(const char *what, const char *clock, const iso_error_of *e)
{
    if (!isnan(e->worst))
        complain("error of %s at most %.2g, at %s = %.6g; %.2g at the end", what, rounded_up(e->worst), clock,
                 e->worst_time, rounded_up(e->last));
}

/* The error of the rows, or why it is not known. */
static void tell_errors(iso_context *ctx, const iso_scene *scene, const iso_orbit_options *o, const iso_orbit *orbit,
                        const iso_error_rows *rows)
{
    iso_error e;
    iso_context_watch(ctx, not_interrupted, NULL);
    const iso_status status = iso_error_find(ctx, &scene->params, &scene->start, o, orbit, rows, &e);
    iso_context_watch(ctx, NULL, NULL);
    if (status != ISO_OK) {
        complain("error not known: %s", iso_context_message(ctx));
        return;
    }
    const char *clock = iso_clock_name(o->clock);
    tell_error("(omega, n)", clock, &e.state[ISO_BALL]);
    tell_error("(M, gamma)", clock, &e.state[ISO_POINT]);
    for (int c = 0; c < ISO_CLOCKS; c++) tell_error(iso_clock_name((iso_clock)c), clock, &e.clock[c]);
    complain(
        "errors are relative, in %zu rows: from the same orbit by %s at tolerance %.2g, in %.2g s; of the first, "
        "%.2g is the rounding of the start",
        e.rows, e.method->name, e.tolerance, e.seconds, e.start);
}

/* Writes all rows it can: what was computed before a failure or an interruption is kept. `rows` (may be NULL) is given
 * them, too. */
static int write_file(iso_context *ctx, const options *o, iso_orbit *orbit, const times *t, const iso_record *header,
                      const int columns[], int count, iso_error_rows *rows)
{
    iso_trajectory_writer *writer;
    size_t written = 0;
    stop_gently();
    iso_status status = iso_trajectory_open(ctx, o->output, &writer);
    if (status != ISO_OK) return finish(ctx, status);
    status = iso_trajectory_write_header(ctx, writer, header);
    if (status == ISO_OK) status = write_rows(ctx, orbit, t, columns, count, writer, rows, &written);
    iso_context_watch(ctx, NULL, NULL);
    const bool keep = status == ISO_OK || status == ISO_STOPPED || (status == ISO_NUMERICAL && written > 0);
    const int result = finish(ctx, status);
    const iso_status closed = iso_trajectory_close(ctx, writer, keep);
    if (closed != ISO_OK) return result == EXIT_DONE ? finish(ctx, closed) : result;
    if (o->verbose) tell(orbit, written);
    if (result == EXIT_NUMERICAL || status == ISO_STOPPED)
        complain("%s%zu of %zu rows were written", status == ISO_STOPPED ? "interrupted: " : "", keep ? written : 0,
                 t->count);
    return result;
}

static iso_status check_files(iso_context *ctx, const options *o)
{
    if (o->times && strcmp(o->times, "-") == 0 && strcmp(o->scene.file, "-") == 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "times", "standard input is the scene or the times, not both");
    return ISO_OK;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_scene scene = {.places = 0};
    iso_orbit *orbit = NULL;
    iso_record *header = NULL;
    int columns[ISO_MAX_COLUMNS], count = 0, result;
    times t = {.scene = &scene};
    iso_effects effects;
    iso_orbit_options how;
    iso_error_rows *rows = NULL;
    iso_status status = check_files(ctx, o);
    if (status == ISO_OK) status = scene_with_options(ctx, &o->scene, &scene);
    if (status == ISO_OK && o->times) status = times_read(ctx, o->times, &t);
    if (status == ISO_OK) {
        if (!t.list) t.count = iso_scene_rows(&scene);
        count = iso_scene_columns(&scene, columns);
        how = options_for_columns(&scene, columns, count, &effects);
        status = iso_orbit_create(ctx, &scene.params, &scene.start, &how, &orbit);
    }
    if (status == ISO_OK) status = iso_orbit_check_time(orbit, times_farthest(&t));
    if (status == ISO_OK) status = describe(ctx, &scene, orbit, columns, count, &header);
    if (status == ISO_OK && o->verbose) {
        rows = calloc(1, sizeof *rows);
        if (!rows) status = iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for the rows");
    }
    result = status == ISO_OK ? write_file(ctx, o, orbit, &t, header, columns, count, rows)
                              : finish_scene(ctx, &o->scene, &scene, status);
    if (rows && result != EXIT_FILE) tell_errors(ctx, &scene, &how, orbit, rows);
    free(rows);
    iso_record_free(header);
    iso_orbit_free(orbit);
    times_free(&t);
    return result;
}

static const options defaults = {.scene = SCENE_OPTIONS_UNSET, .output = "-"};

static const option_row rows[] = {
    ROW_OUTPUT(options, output),
    ROW_BACKEND(options, scene),
    ROW_METHOD(options, scene),
    ROW_TOLERANCE(options, scene),
    ROW_AS(options, scene),
    ROW_T_END(options, scene),
    ROW_STEP(options, scene),
    ROW_OF_FILE("times", "FILE", "a file", "output times from FILE, in any order; # begins a comment", set_text,
                options, times, 0, OPTION_READS),
    ROW("verbose", NULL, NULL, "tell on stderr how the run went, and the error of the rows", set_flag, options,
        verbose),
    ROW_END,
};

const command command_run = {
    .name = "run",
    .argument = "SCENE",
    .doc = "compute a scene's orbit and write its trajectory",
    .rows = rows,
    .defaults = &defaults,
    .size = sizeof defaults,
    .file = offsetof(options, scene.file),
    .description =
        "The times of --t-end, --step and --times are those of the scene's model: t of a ball, s of a point. A row "
        "does not depend on which other times are asked for.\n\n"
        "Backend exact is the closed solution, where there is one ('isoroll explain' says so). Every time costs the "
        "same, near or far. It takes no method and no tolerance.\n\n"
        "--verbose computes the orbit a second time, with smaller steps, and tells the largest error of the rows. "
        "This "
        "covers the error of the method and the rounding of the start. It does not cover the rounding of k, of the "
        "effects' numbers and of the times.\n\n"
        "After Ctrl-C, the rows computed so far are kept.",
    .example = "isoroll run scene.yaml -o trajectory.csv",
    .exits = "1: interrupted\n4: the computation failed; the rows before the failure are kept",
    .run = run,
};

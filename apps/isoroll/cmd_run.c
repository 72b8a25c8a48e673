/* isoroll run - integrate a scene and write its trajectory. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "certified.h"
#include "io/scene_literals_impl.h"
#include "scene_options.h"

typedef struct options {
    iso_scene_changes change;
    const char *file, *output;
    const char *times; /* NULL: not given */
    bool verbose, certify;
    int digits, work_digits; /* 0: not given */
} options;

/* Where the rows go. */
typedef struct target {
    iso_context *ctx;
    const options *o;
    bool opened; /* the orbit could be made: what goes wrong from here on is no mistake in the scene */
    iso_table_writer *writer;
} target;

static iso_status open_file(void *data, const iso_record *header)
{
    target *t = data;
    t->opened = true;
    stop_gently();
    progress_begin_rows(t->o->output);
    const iso_status status = iso_table_writer_open(t->ctx, t->o->output, "trajectory", &t->writer);
    return status == ISO_OK ? iso_table_write_header(t->ctx, t->writer, header) : status;
}

static iso_status write_row(void *data, const double row[], size_t count)
{
    target *t = data;
    (void)count;
    return iso_table_write_row(t->ctx, t->writer, row);
}

static void tell_note(void *data, iso_run_note note, const char *words)
{
    (void)data, (void)note;
    complain("%s", words);
}

static void show_progress(void *data, double part)
{
    static unsigned steps;
    (void)data;
    if (steps++ % 256 == 0) progress_show(part);
}

static bool go_on(void *data)
{
    (void)data;
    return !interrupted();
}

static void report_run(const iso_run_result *r)
{
    const iso_statistics *s = &r->statistics;
    if (r->backend == ISO_BACKEND_EXACT) {
        complain("%zu rows; backend exact: %ld states", r->rows, s->states);
        return;
    }
    complain("%zu rows; backend %s, method %s: %ld steps, %ld rejected, %ld right-hand sides, %ld Jacobians; largest "
             "correction by projection %.2g",
             r->rows, iso_backend_name((int)r->backend), r->method->name, s->steps, s->rejected, s->rhs, s->jacobians,
             s->correction);
}

/* To two digits: what is at most x is at most this. */
static double rounded_up(double x)
{
    const double unit = x > 0 && isfinite(x) ? pow(10, floor(log10(x)) - 1) : 1;
    return ceil(x / unit) * unit;
}

static void report_error(const char *what, const char *clock, const iso_error_of *e)
{
    if (!isnan(e->worst))
        complain("error of %s at most %.2g, at %s = %.6g; %.2g at the end", what, rounded_up(e->worst), clock,
                 e->worst_time, rounded_up(e->last));
}

/* The error of the rows, or why it is not known. */
static void tell_errors(const iso_run_result *r)
{
    const iso_error *e = &r->error;
    const char *clock = iso_clock_name(r->clock);
    if (r->error_status != ISO_OK) {
        complain("error not known: %s", r->error_words);
        return;
    }
    report_error("(omega, n)", clock, &e->state[ISO_BALL]);
    report_error("(M, gamma)", clock, &e->state[ISO_POINT]);
    for (int c = 0; c < ISO_CLOCKS; c++) report_error(iso_clock_name((iso_clock)c), clock, &e->clock[c]);
    complain(
        "errors are relative, in %zu rows: from the same orbit by %s at tolerance %.2g, in %.2g s; of the first, "
        "%.2g is the rounding of the start",
        e->rows, e->method->name, e->tolerance, e->seconds, e->start);
}

/* Ends the file with all rows there are: what was computed before a failure or an interruption is kept. */
static int close_file(const target *t, iso_status status, const iso_run_result *r)
{
    const bool keep = status == ISO_OK || ((status == ISO_STOPPED || status == ISO_NUMERICAL) && r->rows > 0);
    const int result = finish(t->ctx, status);
    if (!t->writer) return result;
    const iso_status closed = iso_table_writer_close(t->ctx, t->writer, keep);
    if (closed != ISO_OK) return result == EXIT_DONE ? finish(t->ctx, closed) : result;
    if (t->o->verbose) report_run(r);
    if (result == EXIT_NUMERICAL || status == ISO_STOPPED)
        complain("%s%zu of %zu rows were written", status == ISO_STOPPED ? "interrupted: " : "", keep ? r->rows : 0,
                 r->asked);
    return result;
}

static int run_scene(iso_context *ctx, const options *o, const iso_scene *scene, const iso_record *times)
{
    target t = {ctx, o, .opened = false};
    const iso_run_sink sink = {open_file, write_row, tell_note, show_progress, &t, NULL};
    iso_run_options how = iso_run_defaults();
    iso_run_result r;
    how.times = times ? iso_record_const_row(times, 0) : NULL;
    how.count = times ? iso_record_rows(times) : 0;
    how.errors = o->verbose;
    iso_context_set_monitor(ctx, go_on, NULL);
    const iso_status status = iso_run(ctx, scene, &how, &sink, &r);
    if (!t.opened) return finish_scene(ctx, o->file, scene, status);
    const int result = close_file(&t, status, &r);
    if (o->verbose && result != EXIT_FILE) tell_errors(&r);
    return result;
}

/* --- certified rows --------------------------------------------------------------------------------------------- */

static void report_certified(const iso_certify_result *r)
{
    complain("%zu rows; backend %s: %ld steps with numbers of %d digits, attempt %d", r->rows,
             iso_backend_name((int)r->backend), r->steps, r->work_digits, r->attempts);
}

static int certify(iso_context *ctx, const options *o, const iso_scene *scene, const iso_literals *literals)
{
    enum { DIGITS = 30 };
    certified_file file = {ctx, o->output, NULL};
    const iso_certify_sink sink = {certified_line, certified_progress, &file};
    const iso_certify_options how = {o->digits ? o->digits : DIGITS, o->work_digits};
    iso_certify_result r;
    iso_context_set_monitor(ctx, go_on, NULL);
    const iso_status status = iso_certify(ctx, scene, literals, &how, &sink, &r);
    const bool ended = status == ISO_STOPPED || status == ISO_NUMERICAL; /* before the last row */
    if (!file.out) return finish_scene(ctx, o->file, scene, status);
    const int result = certified_close(&file, status, status == ISO_OK || ended);
    if (o->verbose && result != EXIT_FILE) report_certified(&r);
    if (ended)
        complain("%s%zu of %zu rows were written", status == ISO_STOPPED ? "interrupted: " : "", r.rows, r.asked);
    return result;
}

/* --- the command ------------------------------------------------------------------------------------------------ */

/* Which options belong together. */
static iso_status check_certify(iso_context *ctx, const options *o)
{
    const certified_option others[] = {{o->times != NULL, "times"},
                                       {o->change.method != NULL, "method"},
                                       {!isnan(o->change.tolerance), "tol"},
                                       {iso_table_is_hdf5(o->output), "output"},
                                       {false, NULL}};
    const certified_option own[] = {{o->digits > 0, "digits"}, {o->work_digits > 0, "work-digits"}, {false, NULL}};
    if (!o->certify) return certified_refuse(ctx, own, "this is for --certify");
    return certified_refuse(ctx, others,
                            "--certify has no use for it: rows at the scene's times, by Taylor series in "
                            "balls, into a text file");
}

static iso_status check_files(iso_context *ctx, const options *o)
{
    if (o->times && strcmp(o->times, "-") == 0 && strcmp(o->file, "-") == 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "times", "standard input is the scene or the times, not both");
    return ISO_OK;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_scene scene = {.places = 0};
    iso_literals literals = {.count = 0};
    iso_record *times = NULL;
    iso_status status = check_files(ctx, o);
    if (status == ISO_OK) status = check_certify(ctx, o);
    if (status == ISO_OK) status = iso_scene_read_literals(ctx, o->file, &scene, &literals);
    if (status == ISO_OK) status = iso_scene_apply(ctx, &o->change, &scene);
    if (status == ISO_OK && o->times) status = times_read(ctx, o->times, &times);
    const int result = status != ISO_OK ? finish_scene(ctx, o->file, &scene, status)
                       : o->certify     ? certify(ctx, o, &scene, &literals)
                                        : run_scene(ctx, o, &scene, times);
    iso_record_free(times);
    iso_literals_clear(&literals);
    return result;
}

static const options defaults = {.change = ISO_SCENE_AS_IT_IS, .output = "-"};

static const option_row rows[] = {
    ROW_OUTPUT(options, output),
    ROWS_OF_STUDY(iso_scene_change_option),
    ROW_OF_FILE("times", "FILE", "a file", "output times from FILE, in any order; # begins a comment", iso_set_text,
                options, times, 0, OPTION_READS),
    ROW("verbose", NULL, NULL, "tell on stderr how the run went, and the error of the rows", iso_set_flag, options,
        verbose),
    ROW("certify", NULL, NULL, "write enclosures, a midpoint and a radius for each number: nothing is rounded away",
        iso_set_flag, options, certify),
    ROW("digits", "D", "a whole number from 1 to 1000", "digits that certified rows hold (default: 30)",
        iso_set_count_int, options, digits),
    ROW("work-digits", "N", "a whole number, at least D",
        "digits that certified rows are computed with (default: as many as it takes)", iso_set_count_int, options,
        work_digits),
    ROW_END,
};

const command command_run = {
    COMMAND("run", "SCENE", "compute a scene's orbit and write its trajectory", file),
    .takes = FILE_SCENE,
    .description =
        "The times of --t-end, --step and --times are those of the scene's model: t of a ball, s of a point. With "
        "a backend by name, a row does not depend on the other times. Backend exact is an exception: with --step the "
        "other times can change its last digits. Backend auto may take another backend for other times.\n\n"
        "Backend exact is the closed solution, where there is one ('isoroll explain' says so). Every time costs the "
        "same, near or far. It takes no method and no tolerance.\n\n"
        "--verbose computes the orbit a second time, with smaller steps, and tells the largest error of the rows. "
        "This "
        "covers the error of the method and the rounding of the start. It does not cover the rounding of k, of the "
        "effects' numbers and of the times.\n\n"
        "--certify writes enclosures: each number has a midpoint and a radius, and the number of the true orbit lies "
        "between, whatever was rounded. It is for the free ball, rotors and levels. The scene's numbers are taken "
        "exactly as they are written. It takes no method and no tolerance (those of the scene are not used); backend "
        "ball or point says whose equations are enclosed. lib/doc/certify.md explains it. It needs Arb (package "
        "libflint-arb-dev; Debian 13: libflint-dev) when isoroll is built. The run stops, and says what to "
        "change, if at this pace it would take more than about ten hours, or if more digits do not help. The rows "
        "before are kept.\n\n"
        "After Ctrl-C, the rows computed so far are kept.",
    .example =
        "isoroll run scene.yaml -o trajectory.csv\nisoroll run scene.yaml --certify --digits 100 -o certified.csv",
    .exits =
        "1: interrupted\n4: the computation failed, or the enclosures no longer hold their digits; the rows before "
        "are kept",
};

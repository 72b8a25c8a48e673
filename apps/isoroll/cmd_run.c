/* isoroll run - integrate a scene and write its trajectory. */
#include <math.h>
#include <string.h>

#include "command.h"
#include "instrument/certify/certify_impl.h"
#include "io/scene_file.h"
#include "stream.h"
#include "task/run.h"
#include "task/task_impl.h"

typedef struct options {
    iso_run_request study;
    const char *file, *output;
    const char *times; /* NULL: not given */
    bool certify;
    int digits, work_digits; /* 0: not given */
} options;

/* --- rows that are computed in doubles -------------------------------------------------------------------------- */

static int run_scene(iso_context *ctx, const options *o, const iso_scene *scene, const iso_record *times)
{
    stream to = {.ctx = ctx, .output = o->output, .kind = "trajectory"};
    iso_study_result r = {.sink = stream_sink(&to)};
    iso_context_set_monitor(ctx, not_interrupted, NULL);
    const iso_status status =
        iso_study_answer(ctx, &iso_run_study, &(iso_study_subject){.scene = scene, .record = times}, &o->study, &r);
    const iso_run_result *found = r.found;
    int result;
    if (!to.opened) {
        result = finish_scene(ctx, o->file, scene, status);
    } else {
        const bool keep = status == ISO_OK || ((status == ISO_STOPPED || status == ISO_NUMERICAL) && found->rows > 0);
        result = stream_close(&to, status, keep);
        if (result == EXIT_NUMERICAL || status == ISO_STOPPED)
            warn("%s%zu of %zu rows were written", status == ISO_STOPPED ? "interrupted: " : "",
                 keep ? found->rows : 0, found->asked);
    }
    if (to.opened && result != EXIT_FILE) warn_lines(r.text);
    iso_study_result_free(&r);
    return result;
}

/* --- certified rows --------------------------------------------------------------------------------------------- */

static int certify(iso_context *ctx, const options *o, const iso_scene *scene, const iso_literals *literals)
{
    enum { DIGITS = 30 };
    stream to = {.ctx = ctx, .output = o->output};
    const iso_certify_sink sink = {stream_line, progress_sink, &to};
    const iso_certify_options how = {o->digits ? o->digits : DIGITS, o->work_digits};
    iso_certify_result r;
    iso_context_set_monitor(ctx, not_interrupted, NULL);
    const iso_status status = iso_certify(ctx, scene, literals, &how, &sink, &r);
    const bool ended = status == ISO_STOPPED || status == ISO_NUMERICAL; /* before the last row */
    if (!to.out) return finish_scene(ctx, o->file, scene, status);
    const int result = stream_close(&to, status, status == ISO_OK || ended);
    if (o->study.verbose && result != EXIT_FILE)
        warn("%zu rows; backend %s: %ld steps with numbers of %d digits, attempt %d", r.rows,
             iso_backend_name((int)r.backend), r.steps, r.work_digits, r.attempts);
    if (ended) warn("%s%zu of %zu rows were written", status == ISO_STOPPED ? "interrupted: " : "", r.rows, r.asked);
    return result;
}

/* Which options belong together. */
static iso_status check_certify(iso_context *ctx, const options *o)
{
    const given_option others[] = {{o->times != NULL, "times"},
                                   {o->study.change.method != NULL, "method"},
                                   {!isnan(o->study.change.tolerance), "tol"},
                                   {iso_table_is_hdf5(o->output), "output"},
                                   {false, NULL}};
    const given_option own[] = {{o->digits > 0, "digits"}, {o->work_digits > 0, "work-digits"}, {false, NULL}};
    if (!o->certify) return refuse_given(ctx, own, "this is for --certify");
    return refuse_given(ctx, others,
                        "--certify has no use for it: rows at the scene's times, by Taylor series in "
                        "balls, into a text file");
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_scene scene = {.places = 0};
    iso_literals literals = {.count = 0};
    iso_record *times = NULL;
    const bool both = o->times && strcmp(o->times, "-") == 0 && strcmp(o->file, "-") == 0;
    iso_status status = both ? ISO_FAIL_ARGUMENT(ctx, "times", "standard input is the scene or the times, not both")
                             : check_certify(ctx, o);
    if (status == ISO_OK) status = iso_scene_read_literals(ctx, o->file, &scene, &literals);
    if (status == ISO_OK) status = iso_scene_apply(ctx, &o->study.change, &scene);
    if (status == ISO_OK && o->times) status = times_read(ctx, o->times, &times);
    const int result = status != ISO_OK ? finish_scene(ctx, o->file, &scene, status)
                       : o->certify     ? certify(ctx, o, &scene, &literals)
                                        : run_scene(ctx, o, &scene, times);
    iso_record_free(times);
    iso_literals_clear(&literals);
    return result;
}

static const options defaults = {.output = "-"};

static const option_row rows[] = {
    ROW_OUTPUT(options, output),
    ROWS_OF_STUDY(iso_run_option),
    ROW_OF_FILE("times", "FILE", "a file", "output times from FILE, in any order; # begins a comment", iso_set_text,
                options, times, 0, OPTION_READS),
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
    COMMAND_OF_STUDY(run, "SCENE", file),
    .defaults = &defaults,
    .run = run,
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

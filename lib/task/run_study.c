/* run_study.c - a run by its name: its options, what it tells people (study/study.h). */
#include <math.h>
#include <stdlib.h>

#include "method/methods_impl.h"
#include "task/run.h"
#include "task/task_impl.h"

ISO_STUDY_BEGIN(iso_run_request, (iso_run_request){.change = ISO_SCENE_AS_IT_IS})

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    static const char *const keys[] = {"errors.ball", "errors.point", "errors.t", "errors.tau", "errors.s"};
    const iso_run_request *r = options;
    const iso_record *times = subject->record;
    iso_scene scene = *subject->scene;
    iso_run_options how = iso_run_defaults();
    iso_run_result *found = iso_study_keep(result, calloc(1, sizeof *found), NULL, free);
    if (!found) return iso_context_no_memory(ctx, "a run");
    ISO_TRY(iso_scene_apply(ctx, &r->change, &scene));
    if (times && iso_record_columns(times) != 1)
        return ISO_FAIL_ARGUMENT(ctx, "record", "the times of a run are a table of one column");
    if (times && iso_record_rows(times) == 0) return ISO_FAIL_ARGUMENT(ctx, "times", "there are no times");
    how.times = times ? iso_record_const_row(times, 0) : NULL;
    how.count = times ? iso_record_rows(times) : 0;
    how.errors = r->verbose;
    const iso_status status =
        iso_run(ctx, &scene, &how, &result->sink, result->sink.row ? NULL : &result->table[0], found);
    if (result->table[0]) iso_record_set_kind(result->table[0], "trajectory");
    for (int i = 0; result->table[0] && r->verbose && found->error_status == ISO_OK && i < 5; i++) {
        const double *worst = i < 2 ? &found->error.state[i].worst : &found->error.clock[i - 2].worst;
        if (!isnan(*worst)) ISO_TRY(iso_record_set_numbers(ctx, result->table[0], keys[i], 1, worst));
    }
    if (r->verbose && found->error_status != ISO_OK && !result->sink.row)
        iso_study_note(result, "error not known: %s", found->error_words);
    return status;
}

/* --- what it tells ---------------------------------------------------------------------------------------------- */

static void print_steps(FILE *to, const iso_run_result *r)
{
    const iso_statistics *s = &r->statistics;
    if (r->backend == ISO_BACKEND_EXACT)
        fprintf(to, "%zu rows; backend exact: %ld states\n", r->rows, s->states);
    else
        fprintf(to,
                "%zu rows; backend %s, method %s: %ld steps, %ld rejected, %ld right-hand sides, %ld Jacobians; "
                "largest correction by projection %.2g\n",
                r->rows, iso_backend_name((int)r->backend), r->method->name, s->steps, s->rejected, s->rhs,
                s->jacobians, s->correction);
}

/* To two digits: what is at most x is at most this. */
static double rounded_up(double x)
{
    const double unit = x > 0 && isfinite(x) ? pow(10, floor(log10(x)) - 1) : 1;
    return ceil(x / unit) * unit;
}

static void print_error(FILE *to, const char *what, const char *clock, const iso_error_of *e)
{
    if (!isnan(e->worst))
        fprintf(to, "error of %s at most %.2g, at %s = %.6g; %.2g at the end\n", what, rounded_up(e->worst), clock,
                e->worst_time, rounded_up(e->last));
}

static void print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_run_result *r = result->found;
    const iso_error *e = &r->error;
    const char *clock = iso_clock_name(r->clock);
    (void)scene;
    if (!((const iso_run_request *)options)->verbose || !r->method) return;
    print_steps(to, r);
    if (r->error_status != ISO_OK) {
        fprintf(to, "error not known: %s\n", r->error_words);
        return;
    }
    print_error(to, "(omega, n)", clock, &e->state[ISO_BALL]);
    print_error(to, "(M, gamma)", clock, &e->state[ISO_POINT]);
    for (int c = 0; c < ISO_CLOCKS; c++) print_error(to, iso_clock_name((iso_clock)c), clock, &e->clock[c]);
    fprintf(to,
            "errors are relative, in %zu rows: from the same orbit by %s at tolerance %.2g, in %.2g s; of the first, "
            "%.2g is the rounding of the start\n",
            e->rows, e->method->name, e->tolerance, e->seconds, e->start);
}

const iso_option iso_run_option[] = {
    ISO_OPTIONS_OF_SCENE(iso_run_request, change),
    ISO_OPTION("verbose", NULL, NULL, "tell how the run went, and the error of the rows", iso_set_flag,
               iso_run_request, verbose),
    ISO_OPTION_END,
};

const iso_study iso_run_study = {
    ISO_STUDY_AS("run", iso_run_request, iso_run_option, "compute a scene's orbit and write its trajectory"),
    .run = run, .of = ISO_STUDY_OF_SCENE | ISO_STUDY_USES_RECORD | ISO_STUDY_STREAMS, .print = print};

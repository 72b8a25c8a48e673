/* isoroll check - tests whether a trajectory solves its model. */
#include "base/number_impl.h"
#include "command.h"
#include "json.h"
#include "stream.h"
#include "task/check/check_impl.h"

typedef struct options {
    iso_check_request study;
    const char *file, *scene, *columns; /* NULL: not given */
    bool json;
} options;

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_table_reader *in = NULL;
    iso_scene scene;
    iso_study_result r = {.text = NULL};
    iso_status status = iso_table_reader_open(ctx, o->file, "trajectory", o->columns, &in);
    if (status == ISO_OK && o->scene) status = iso_scene_load(ctx, o->scene, &scene);
    if (status == ISO_OK) {
        const iso_row_source rows = {stream_next, in};
        iso_table_pass_nan(in);
        progress_begin();
        status = iso_study_answer(
            ctx, &iso_check_study,
            &(iso_study_subject){.scene = o->scene ? &scene : NULL, .record = iso_table_header(in), .rows = &rows}, o,
            &r);
        progress_end();
    }
    iso_table_reader_close(in);
    int result = finish(ctx, name_the_file(ctx, o->file, status));
    if (status == ISO_OK && o->json && !json_print(json_of(r.fields, r.found))) result = EXIT_NUMERICAL;
    if (status == ISO_OK && !o->json) iso_fold(stdout, r.text, terminal_width(stdout));
    if (result == EXIT_DONE && r.failed) {
        warn("%s: a residual is above %s", o->file, ISO_SHORT(o->study.bound));
        result = EXIT_SOME_FAILED;
    }
    iso_study_result_free(&r);
    return result;
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_check_option),
    ROW_OF_ITS_SCENE(options, scene),
    ROW_COLUMNS(options, columns),
    ROW_JSON(options, json),
    ROW_END,
};

const command command_check = {
    COMMAND_OF_STUDY(check, "[FILE]", file),
    .run = run,
    .takes = FILE_ROWS,
    .description =
        "Prints residuals: of constraints, of integrals, of every column, and of the # lines that state an energy "
        "or the start. Residuals are relative. The residual 'flow' integrates each row to the time of the next row "
        "and compares. Rows are read one after the other, in constant memory.\n\n"
        "The last line, 'not looked at', names the columns and # lines on which no residual depends: they may hold "
        "anything. Any other number that is off by a millionth of the size of its vector is noticed.\n\n"
        "A file can hold several orbits of one energy: of section with --as, and of periodic -o, where each row is "
        "an orbit. Another orbit begins where the column 'orbit' changes. No flow goes from one orbit to the "
        "next.\n\n"
        "Rows of nan, which convert writes, are passed over and counted.",
    .example = "isoroll check trajectory.csv --max 1e-9",
    .exits = "1: a residual is larger than --max",
};

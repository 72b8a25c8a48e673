/* cmd_convert.c - `isoroll convert`: a filter that reads a trajectory of one model and writes that of the other. */
#include <math.h>

#include "command.h"
#include "instrument/certify/certify_impl.h"
#include "stream.h"
#include "task/convert/convert_impl.h"

typedef struct options {
    iso_convert_request study;
    const char *file, *scene, *columns, *output;
    int digits;
} options;

enum { ALL_DIGITS = 17 };

/* --- certified orbits ------------------------------------------------------------------------------------------- */

static iso_status check_certified(iso_context *ctx, const options *o)
{
    const iso_convert_request *r = &o->study;
    const iso_file_parameters *added = &r->added;
    const given_option others[] = {{o->digits != ALL_DIGITS, "digits"},
                                   {!isnan(r->tolerance), "tol"},
                                   {!isnan(added->k), "k"},
                                   {!isnan(added->J[0]), "J"},
                                   {!isnan(added->eps), "eps"},
                                   {!isnan(added->h), "h"},
                                   {o->scene != NULL, "scene"},
                                   {o->columns != NULL, "columns"},
                                   {added->row_tolerance != ISO_ROW_TOLERANCE, "row-tolerance"},
                                   {!isnan(r->max_defect), "max-defect"},
                                   {r->shift_J, "shift-J"},
                                   {iso_table_is_hdf5(o->output), "output"},
                                   {false, NULL}};
    return refuse_given(ctx, others,
                        "a certified orbit has all numbers in its file, and becomes a text file with as many digits");
}

static int convert_certified(iso_context *ctx, const options *o)
{
    stream to = {.ctx = ctx, .output = o->output};
    const iso_certify_sink sink = {stream_line, NULL, &to};
    iso_status status = check_certified(ctx, o);
    size_t rows = 0;
    FILE *file = status == ISO_OK ? fopen(o->file, "re") : NULL;
    if (status == ISO_OK && !file)
        status = iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "'%s': cannot be read", o->file);
    if (file) {
        begin_work(ctx, o->output);
        status = iso_certify_convert(ctx, file, o->file, o->study.to, &sink, &rows);
        fclose(file);
    }
    const int result = stream_close(&to, status, status == ISO_OK || status == ISO_STOPPED);
    if (status == ISO_STOPPED) warn("interrupted: %zu rows were converted", rows);
    if (result == EXIT_DONE && !o->study.quiet) warn("%s: %zu rows, all enclosed", o->file, rows);
    return result;
}

/* --- other orbits ------------------------------------------------------------------------------------------------ */

/* Two lines at the end of the file: how the other clock was computed, and its error. */
static iso_status write_clock(const stream *to, const iso_conversion_summary *s)
{
    char key[2][ISO_NAME_SIZE], text[2][160];
    if (!to->writer || !iso_conversion_clock_lines(s, key, text)) return ISO_OK;
    ISO_TRY(iso_table_write_line(to->ctx, to->writer, key[0], text[0]));
    return iso_table_write_line(to->ctx, to->writer, key[1], text[1]);
}

static int convert(iso_context *ctx, const options *o, const iso_scene *scene, iso_table_reader *in)
{
    stream to = {.ctx = ctx, .output = o->output, .kind = "trajectory", .digits = &o->digits};
    iso_study_result r = {.sink = stream_sink(&to)};
    const iso_row_source rows = {stream_next, in};
    const iso_study_subject subject = {
        .scene = scene, .name = iso_text_name(o->file), .record = iso_table_header(in), .rows = &rows};
    begin_work(ctx, o->output);
    iso_status status = iso_study_answer(ctx, &iso_convert_study, &subject, &o->study, &r);
    const iso_convert_found *f = r.found;
    const bool keep = status == ISO_OK || status == ISO_STOPPED;
    iso_context_set_monitor(ctx, NULL, NULL);
    const iso_status written = keep && f ? write_clock(&to, &f->all) : ISO_OK;
    if (status == ISO_OK) status = written;
    int result = stream_close(&to, name_the_file(ctx, o->file, status), keep);
    if (status == ISO_STOPPED && result != EXIT_FILE)
        warn("interrupted: %zu rows were converted", f->all.rows - f->all.bad);
    if (status == ISO_OK && result == EXIT_DONE) {
        warn_lines(r.text);
        if (r.failed) result = EXIT_SOME_FAILED;
    }
    iso_study_result_free(&r);
    return result;
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_table_reader *in = NULL;
    iso_scene scene;
    if (file_kind(o->file, (char[ISO_KIND_SIZE]){0}) == FILE_CERTIFIED) return convert_certified(ctx, o);
    iso_status status = iso_table_reader_open(ctx, o->file, "trajectory", o->columns, &in);
    if (status == ISO_OK && o->scene) status = iso_scene_load(ctx, o->scene, &scene);
    const int result = status == ISO_OK ? convert(ctx, o, o->scene ? &scene : NULL, in)
                                        : finish(ctx, name_the_file(ctx, o->file, status));
    iso_table_reader_close(in);
    return result;
}

static const options defaults = {.file = "-", .output = "-", .digits = ALL_DIGITS};

static const option_row rows[] = {
    ROW_OUTPUT(options, output),
    ROW_OF_FILE("digits", "N", "1 to 17, or hex", "significant digits of numbers, 1 to 17 (default), or hex",
                set_digits, options, digits, 'p', OPTION_NO_FILE),
    ROWS_OF_STUDY(iso_convert_option),
    ROW_OF_ITS_SCENE(options, scene),
    ROW_COLUMNS(options, columns),
    ROW_END,
};

const command command_convert = {
    COMMAND_OF_STUDY(convert, "[FILE]", file),
    .defaults = &defaults,
    .run = run,
    .takes = FILE_ROWS | FILE_CERTIFIED,
    .description =
        "A filter: row by row, in constant memory. It reads files of other programs, too. k, J and h or eps come "
        "from the # lines of the file, from --scene, or from --k and --J.\n\n"
        "States are mapped by (18) of the paper. The clock of the other model, unless the file has it, is computed "
        "from the rows by two-point Taylor quadrature to --tol. Where the rows are too far apart it is integrated. "
        "It is 0 at the first row.\n\n"
        "A file may have several orbits of one energy, told apart by a column `orbit`, such as a section with "
        "states. They are converted one after the other. Each begins with the other clock at 0.\n\n"
        "A row that cannot be converted becomes a row of nan. A row that is not on the orbit of the row before is "
        "converted as it stands: one of the two is damaged, and `isoroll check` shows more. The first 20 of both are "
        "named. Rows with few digits need a --row-tolerance.\n\n"
        "If the # line h, eps or level.c does not fit the first row, beyond rounding, a message names it, and the "
        "row's own number is written.\n\n"
        "A point off the level H = 0 becomes a ball in the potential of the effect 'level'; with --shift-J it "
        "becomes a free ball.\n\n"
        "Rows of 'run --certify' become enclosures of the other model, all clocks with them; they are read from a "
        "file, by its name.",
    .example = "isoroll convert --to point ball.csv -o point.csv",
    .exits = "1: a row was bad, or the rows do not lie on one orbit",
};

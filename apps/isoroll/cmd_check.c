/* isoroll check - tests whether a trajectory solves its model. */
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "json.h"
#include "parameters.h"
#include "terminal.h"
#include "task/check/check_impl.h"

typedef struct options {
    iso_check_request study;
    const char *file, *scene, *columns; /* NULL: not given */
    bool json;
} options;

/* --- what is printed -------------------------------------------------------------------------------------------- */

static void print_unseen(const iso_check_found *f)
{
    say("not looked at:");
    for (size_t i = 0; i < f->unseen_count; i++) say(" %s%s", f->unseen[i], i + 1 < f->unseen_count ? "," : "\n");
}

static void print_table(const iso_check_found *f)
{
    say("%zu rows", f->rows);
    if (f->passed > 0) say(", %zu of nan passed over", f->passed);
    say("\n");
    say_table(1);
    say("residual\tworst\tat row\tof\n");
    for (int i = 0; i < f->count; i++) {
        const iso_residual *x = &f->checked[i].residual;
        say("%s\t%.2e\t%zu\t%s%s\n", x->name, x->worst, x->row, x->what,
            iso_checked_is_bad(&f->checked[i]) ? "  ABOVE THE BOUND" : "");
    }
    say_table_end();
    if (f->unseen_count > 0) print_unseen(f);
}

static int report(const options *o, const iso_check_found *f)
{
    bool bad = false;
    if (!o->json)
        print_table(f);
    else if (!json_print(json_of(iso_check_fields, f)))
        return EXIT_NUMERICAL;
    for (int i = 0; i < f->count; i++) bad = bad || iso_checked_is_bad(&f->checked[i]);
    if (!bad) return EXIT_DONE;
    return complain("%s: a residual is above %s", o->file, ISO_SHORT(f->bound)), EXIT_SOME_FAILED;
}

/* --- the check -------------------------------------------------------------------------------------------------- */

/* Rows of a file come one after the other, as they are read. */
static iso_status next_row(iso_context *ctx, void *data, iso_check_row *row)
{
    iso_table_reader *in = data;
    const iso_status status = iso_table_next(ctx, in, row->number, &row->more);
    row->passed = iso_table_at(in)->passed;
    row->begins_orbit = iso_table_at(in)->begins_orbit;
    row->ignored = iso_table_at(in)->ignored;
    return status;
}

static iso_status check_file(iso_context *ctx, const options *o, iso_check_found *f)
{
    iso_table_reader *in = NULL;
    iso_scene scene;
    iso_status status = iso_table_reader_open(ctx, o->file, "trajectory", o->columns, &in);
    if (status != ISO_OK) return status;
    iso_table_pass_nan(in);
    progress_begin();
    if (o->scene) status = iso_scene_load(ctx, o->scene, &scene);
    if (status == ISO_OK)
        status = iso_check_rows(ctx, &o->study, o->scene ? &scene : NULL, iso_table_header(in),
                                &(iso_check_source){next_row, in}, f);
    progress_end();
    iso_table_reader_close(in);
    return status;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_check_found *f = calloc(1, sizeof *f);
    if (!f) return finish(ctx, iso_context_no_memory(ctx, "a check"));
    const iso_status status = check_file(ctx, o, f);
    const int result = status == ISO_OK ? report(o, f) : finish(ctx, name_the_file(ctx, o->file, status));
    iso_check_found_free(f);
    return result;
}

static const options defaults = {.file = "-"};

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_check_option),
    ROW_OF_ITS_SCENE(options, scene),
    ROW_COLUMNS(options, columns),
    ROW_JSON(options, json),
    ROW_END,
};

const command command_check = {
    COMMAND_OF_STUDY(check, "[FILE]", file),
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

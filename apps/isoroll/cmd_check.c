/* isoroll check - tests whether a trajectory solves its model. */
#include <math.h>

#include "parameters.h"
#include "study/check.h"

/* What check can be told. */
typedef struct options {
    file_options from;
    double tolerance, bound; /* NAN: not given */
} options;

/* True: a bound is given, and a residual is above it. */
static bool print_residuals(const iso_residuals *r, double bound)
{
    bool failed = false;
    printf("%zu rows", r->rows);
    if (r->passed > 0) printf(", %zu of nan passed over", r->passed);
    printf("\n%-18s %10s %9s  %s\n", "residual", "worst", "at row", "of");
    for (int i = 0; i < r->count; i++) {
        const iso_residual *x = &r->residual[i];
        const bool bad = !isnan(bound) && !(x->worst <= bound);
        failed = failed || bad;
        printf("%-18s %10.2e %9zu  %s%s\n", x->name, x->worst, x->row, x->what, bad ? "  ABOVE THE BOUND" : "");
    }
    return failed;
}

/* Checks the rows one after the other, as they are read. A mistake in the first one is told before what the header
 * lacks. */
static iso_status check_rows(iso_context *ctx, const options *o, iso_trajectory_reader *in, iso_residuals *residuals)
{
    double row[ISO_TRAJECTORY_COLUMNS];
    iso_params params;
    iso_checking *checking = NULL;
    iso_record *const header = iso_trajectory_header(in);
    bool more;
    size_t passed = 0;
    iso_status status = iso_trajectory_next(ctx, in, row, &more);
    if (status == ISO_OK) status = parameters_of_file(ctx, &o->from, header, &params);
    if (status == ISO_OK)
        status = iso_checking_create(ctx, &params, header, isnan(o->tolerance) ? 1e-13 : o->tolerance, &checking);
    while (status == ISO_OK) {
        for (; passed < iso_trajectory_passed(in); passed++) iso_checking_pass(checking);
        if (!more) break;
        status = iso_checking_put(checking, row);
        if (status == ISO_OK) status = iso_trajectory_next(ctx, in, row, &more);
    }
    if (status == ISO_OK) status = iso_checking_end(checking, residuals);
    iso_checking_free(checking);
    return status;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_trajectory_reader *in = NULL;
    iso_residuals residuals;
    bool failed = false;
    iso_status status = iso_trajectory_reader_open(ctx, o->from.file, o->from.columns, &in);
    if (status == ISO_OK) {
        iso_trajectory_pass_nan(in);
        progress_begin();
        status = check_rows(ctx, o, in, &residuals);
        progress_end();
    }
    iso_trajectory_reader_close(in);
    if (status == ISO_OK)
        failed = print_residuals(&residuals, o->bound);
    else if (status != ISO_BAD_ARGUMENT && status != ISO_FILE_TROUBLE)
        status = name_the_file(ctx, o->from.file, status);
    if (failed) complain("%s: a residual is above %g", o->from.file, o->bound);
    return status == ISO_OK && failed ? EXIT_SOME_FAILED : finish(ctx, status);
}

static const options defaults = {.from = FILE_OPTIONS_UNSET, .tolerance = NAN, .bound = NAN};

static const option_row rows[] = {
    ROW("tol", "X", "a number in [1e-15, 0.1]", "tolerance of the flow from row to row (default 1e-13)",
        set_tolerance, options, tolerance),
    ROWS_OF_FILE(options, from),
    ROW("max", "X", "a number from 0 on", "exit with status 1 if a residual is larger than X", set_bound, options,
        bound),
    ROW_END,
};

const command command_check = {
    .name = "check",
    .argument = "[FILE]",
    .doc = "test whether a trajectory solves its model",
    .rows = rows,
    .defaults = &defaults,
    .size = sizeof defaults,
    .file = offsetof(options, from.file),
    .takes = FILE_ROWS,
    .description = "Prints residuals: of constraints, of integrals, and of every column. Residuals are relative. The "
                   "residual 'flow' integrates each row to the time of the next row and compares. Rows are read one "
                   "after the other, in constant memory.\n\nRows of nan, which convert writes, are passed over and "
                   "counted.",
    .example = "isoroll check trajectory.csv --max 1e-9",
    .exits = "1: a residual is larger than --max",
    .run = run,
};

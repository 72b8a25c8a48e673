/* isoroll check - does a trajectory file solve its model? */
#include <math.h>

#include "parameters.h"

/* True if a bound is given and any residual is above it. */
static bool print_residuals(const iso_residuals *r, double bound)
{
    bool failed = false;
    printf("%zu rows\n%-18s %10s %9s  %s\n", r->rows, "residual", "worst", "at row", "of");
    for (int i = 0; i < r->count; i++) {
        const iso_residual *x = &r->residual[i];
        const bool bad = !isnan(bound) && !(x->worst <= bound);
        failed = failed || bad;
        printf("%-18s %10.2e %9zu  %s%s\n", x->name, x->worst, x->row, x->what, bad ? "  ABOVE THE BOUND" : "");
    }
    return failed;
}

static int run(iso_context *ctx, const options *o)
{
    iso_record *record = NULL;
    iso_params params;
    iso_residuals residuals;
    bool failed = false;
    iso_status status = iso_trajectory_read(ctx, o->file, o->columns, &record);
    if (status == ISO_OK) status = parameters_of_file(ctx, o, record, &params);
    if (status == ISO_OK)
        status = iso_check(ctx, &params, record, isnan(o->tolerance) ? 1e-13 : o->tolerance, &residuals);
    if (status == ISO_OK)
        failed = print_residuals(&residuals, o->bound);
    else if (status != ISO_BAD_ARGUMENT && status != ISO_FILE_TROUBLE)
        status = name_the_file(ctx, o, status);
    iso_record_free(record);
    if (failed) complain("%s: a residual is above %g", o->file, o->bound);
    return status == ISO_OK && failed ? EXIT_SOME_FAILED : finish(ctx, status);
}

const command command_check = {
    .name = "check",
    .argument = "[FILE]",
    .doc = "residuals of a trajectory: constraints, integrals, whether it solves its model",
    .options = " k J eps h scene columns row-tolerance tol max ",
    .more = "Residuals are relative. 'flow' integrates each row to the time of the next at --tol (default 1e-13).",
    .run = run,
};

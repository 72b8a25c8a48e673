/* isoroll convert - a trajectory of one model in, the other's out. */
#include <math.h>
#include <string.h>

#include "command.h"
#include "parameters.h"

static int run(iso_context *ctx, const options *o)
{
    iso_record *in = NULL, *out = NULL;
    iso_params params;
    if ((int)o->to < 0) return complain("convert: --to ball or --to point is missing"), EXIT_USAGE;
    iso_status status = iso_trajectory_read(ctx, o->file, &in);
    if (status == ISO_OK) status = parameters_of_file(ctx, o, in, &params);
    if (status == ISO_OK)
        status = iso_convert(ctx, &params, in, o->to, isnan(o->tolerance) ? 1e-14 : o->tolerance, &out);
    if (status == ISO_OK) {
        stop_gently(); /* no half file, and no temporary one, is left */
        status = iso_trajectory_write(ctx, o->output, out);
    } else if (status != ISO_BAD_ARGUMENT && status != ISO_FILE_TROUBLE && in) {
        status = name_the_file(ctx, o, status);
    }
    const int result = finish(ctx, status);
    iso_record_free(in);
    iso_record_free(out);
    return result;
}

const command command_convert = {
    .name = "convert",
    .argument = "[FILE]",
    .doc = "a trajectory of one model in, the other model's out",
    .options = " to output k J eps h tol ",
    .more =
        "States are mapped row by row. The other model's clock is integrated from row to row (--tol, default 1e-14), "
        "from 0 at\nthe first row, unless the file has it. k, J and h or eps are read from the file's # lines.",
    .run = run,
};

/* isoroll explain - tells what would be simulated, and why. */
#include <math.h>
#include <stdlib.h>

#include "command.h"
#include "sweep/sweep_impl.h"

OPTIONS_OF_SCENE(iso_scene_request);

static int run_sweep(iso_context *ctx, const options *o)
{
    iso_sweep_file *file;
    char *text;
    const iso_scene_changes *c = &o->study.change;
    const bool changes = c->method || (int)c->backend >= 0 || (int)c->as >= 0 || !isnan(c->tolerance) ||
                         !isnan(c->end) || !isnan(c->step);
    iso_status status =
        changes
            ? ISO_FAIL_ARGUMENT(ctx, "", "explain: options are for scenes, not for a sweep, whose scene has its own")
            : iso_sweep_read(ctx, o->shell.file, &file);
    if (status != ISO_OK) return finish(ctx, status);
    progress_begin();
    status = iso_sweep_explain(ctx, file, &text);
    progress_end();
    if (status == ISO_OK) iso_fold(stdout, text, terminal_width(stdout));
    free(text);
    iso_sweep_file_free(file);
    return finish(ctx, status);
}

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts parts = {.change = shell_change};
    const options *o = options_given;
    if (file_kind(o->shell.file, (char[ISO_KIND_SIZE]){0}) == FILE_SWEEP) return run_sweep(ctx, o);
    return shell_run(ctx, &iso_explain_study, &parts, o, &o->shell);
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_scene_change_option),
    ROW_END,
};

const command command_explain = {
    COMMAND_OF_STUDY(explain, "SCENE", shell.file),
    .run = run,
    .takes = FILE_SCENE | FILE_SWEEP,
    .description =
        "Tells the ball's parameters, the effects that act, whether the orbit has a twin, which Poincare section is "
        "global, whether there is a closed solution, the backend and the method, which integrals hold, and the "
        "measured cost of one right-hand side.\n\n"
        "Of a sweep: how many points it has, its columns, what its quantities cost, and how long it takes here. For "
        "this a few of its points are computed.",
    .example = "isoroll explain scene.yaml",
};

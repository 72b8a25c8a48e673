/* isoroll explain - tells what would be simulated, and why. */
#include "say.h"
#include "shell.h"
#include "study/explain/explain_impl.h"
#include "sweep_team.h"

typedef struct options {
    iso_explain_request study;
    shell_options shell;
} options;

static void print_text(const shell *s)
{
    say("%s", ((const iso_explanation *)s->result.found)->text);
}

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts parts = {.study = &iso_explain_study, .change = shell_change, .print = print_text};
    const options *o = options_given;
    return file_kind(o->shell.file, (char[ISO_KIND_SIZE]){0}) == FILE_SWEEP ? explain_sweep(ctx, o->shell.file)
                                                                            : shell_run(ctx, &parts, o, &o->shell);
}

static const options defaults = {.shell = {.file = "-"}};

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_explain_option, 0, 6),
    ROW_END,
};

const command command_explain = {
    COMMAND_OF_STUDY(explain, "SCENE", shell.file),
    .takes = FILE_SCENE | FILE_SWEEP,
    .description =
        "Tells the ball's parameters, the effects that act, whether the orbit has a twin, which Poincare section is "
        "global, whether there is a closed solution, the backend and the method, which integrals hold, and the "
        "measured cost of one right-hand side.\n\n"
        "Of a sweep: how many points it has, its columns, what its quantities cost, and how long it takes here. For "
        "this a few of its points are computed.",
    .example = "isoroll explain scene.yaml",
};

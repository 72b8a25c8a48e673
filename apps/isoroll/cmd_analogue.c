/* isoroll analogue - finds a ball for a problem of a point: a report in # lines, then the ball as a scene. */
#include <string.h>

#include "command.h"
#include "task/task_impl.h"

typedef struct options {
    iso_analogue_request study;
    const char *file;
} options;

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    const bool stated = iso_analogue_is_stated(&o->study);
    iso_scene scene = {.places = 0};
    iso_study_result r = {.text = NULL};
    if (stated && strcmp(o->file, "-") != 0)
        return warn("analogue: '%s' and a problem in options: leave one of them out", o->file), EXIT_USAGE;
    iso_status status = stated ? ISO_OK : iso_scene_load(ctx, o->file, &scene);
    begin_work(ctx, NULL);
    if (status == ISO_OK)
        status = iso_study_answer(ctx, &iso_analogue_study, &(iso_study_subject){.scene = stated ? NULL : &scene},
                                  &o->study, &r);
    progress_end();
    if (status == ISO_OK) iso_fold(stdout, r.text, terminal_width(stdout));
    iso_study_result_free(&r);
    if (!stated) status = name_the_file(ctx, o->file, iso_scene_blame(ctx, &scene, iso_text_name(o->file), status));
    return finish(ctx, status);
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_analogue_option),
    ROW_END,
};

const command command_analogue = {
    COMMAND_OF_STUDY(analogue, "[SCENE]", file),
    .run = run,
    .takes = FILE_SCENE,
    .description =
        "The problem is a scene of a 'point', or --neumann, or --k, --J and --eps. If the problem is a "
        "scene, its start is kept; otherwise a start is chosen. The answer is a scene of a ball, with a report in "
        "# lines.\n\n"
        "The ball is free (no potential acts on it) where that is possible. It is a body with mass and radius where "
        "there is one, else k and J alone. Mass and radius that are not given are round numbers, chosen so that the "
        "angular velocity is of order one.",
    .example = "isoroll analogue --neumann 1,2,2.5 --energy 2 > ball.yaml\nisoroll compare ball.yaml",
};

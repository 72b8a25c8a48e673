/* isoroll compare - computes one orbit by every backend and shows the differences: table, picture, JSON. */
#include "command.h"
#include "model/effects/effects_impl.h"
#include "picture/picture_impl.h"
#include "plot/draw.h"
#include "task/task_impl.h"

OPTIONS_OF_SCENE(iso_compare_request);

static json_t *json(const shell *s)
{
    const iso_comparison *c = s->result.found;
    json_t *o = json_of_scene(&s->scene, s->result.fields, c);
    json_put(o, "tolerance", json_number(s->scene.tolerance));
    json_put(o, "effects", json_effects(&c->effects, false));
    return o;
}

static int draw(const shell *s)
{
    char result[200], unused[ISO_COMPARISON_SIZE];
    double worst;
    const iso_comparison *c = s->result.found;
    const size_t rows = iso_record_rows(c->difference);
    iso_record *curve, *states;
    if (rows == 0) return EXIT_DONE;
    const double end = iso_record_const_row(c->run[ISO_BALL].trajectory, rows - 1)[ISO_CLOCK_T];
    iso_status status = iso_picture_stretch(s->ctx, &s->scene, end, &states, &curve);
    const bool same = iso_comparison_text(&s->scene, c, &worst, unused);
    snprintf(result, sizeof result, "%s %s %.1e",
             c->runs == ISO_BACKENDS
                 ? "three computations, by the ball's equations, the point's, and the closed solution,"
                 : "two computations, by the ball's equations and by the point's,",
             same ? "agree to" : "differ by", worst);
    if (status == ISO_OK) status = iso_record_set(s->ctx, states, "result", result);
    if (status == ISO_OK)
        status = plot_tables(s->ctx, &s->common->plot, (const iso_record *[]){states, curve, NULL}, NULL);
    iso_record_free(curve);
    iso_record_free(states);
    return finish(s->ctx, status);
}

static void warn_interrupted(const shell *s)
{
    const iso_comparison *c = s->result.found;
    if (c)
        warn("interrupted: %zu of %zu rows were compared", iso_record_rows(c->difference), iso_scene_rows(&s->scene));
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_compare_option),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_compare = {
    COMMAND_OF_SCENE(compare),
    .parts = {.change = shell_change, .interrupted = warn_interrupted, .json = json, .draw = draw},
    .description =
        "The backends are ball, point and, where there is a closed solution, exact. The table shows states, "
        "clocks and integrals by each of them. Differences of states are relative to the size of the "
        "vector, those of clocks to the largest value of the clock.",
    .example = "isoroll compare scene.yaml --plot orbit.svg",
};

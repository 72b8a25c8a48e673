/* isoroll frequencies - tells how fast a motion turns and swings: exactly where a closed solution does it, else by an
 * estimate from an orbit. */
#include "command.h"
#include "instrument/frequencies/frequencies.h"
#include "instrument/frequencies/momentum.h"
#include "plot/draw.h"

OPTIONS_OF_SCENE(iso_frequencies_options);

/* The map (h, F), or the spectral lines of n(t). After a closed solution without a map they are estimated here. */
static iso_status draw_found(const shell *s, iso_frequencies *f)
{
    const options *o = s->options;
    iso_frequencies_options how = o->study;
    iso_record *table = NULL;
    iso_momentum m;
    how.progress = progress_sink;
    const bool mapped = f->integral && iso_momentum_at(&s->scene.params, f->H, f->h, f->integral->name, f->F, &m);
    iso_status status = mapped || f->estimated ? ISO_OK : iso_frequencies_estimate(s->ctx, &s->scene, &how, f);
    progress_end();
    if (status == ISO_OK)
        status = iso_study_table(s->ctx, "frequencies", &s->scene, s->result.fields, f, NULL, &table);
    if (status == ISO_OK) status = plot_tables(s->ctx, &o->shell.plot, (const iso_record *[]){table, NULL}, NULL);
    iso_record_free(table);
    return status;
}

static int draw(const shell *s)
{
    iso_frequencies f = *(const iso_frequencies *)s->result.found;
    return finish(s->ctx, draw_found(s, &f));
}

/* --t-end says the end, not the scene. */
static iso_status forget_end(shell *s)
{
    iso_scene_forget_place(&s->scene, "end");
    return ISO_OK;
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_frequencies_option),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_frequencies = {
    COMMAND_OF_SCENE(frequencies),
    .parts = {.change = forget_end, .stopped = "no frequencies", .draw = draw},
    .description =
        "Where there is a closed solution (k = 1, k = -1, equal moments, principal planes; no rotor) the numbers are "
        "exact. Elsewhere they are estimated from an orbit in the ball's time t, by Laskar's frequency analysis. "
        "--turns, --t-end and --samples are about this orbit; the scene's own times are not read.\n\n"
        "--plot draws the image of the momentum map (h, F) with the orbit in it. Where there is no such map, it "
        "draws the spectral lines of n(t).",
    .example = "isoroll frequencies scene.yaml --plot map.svg",
};

/* isoroll frequencies - tells how fast a motion turns and swings: exactly where a closed solution does it, else by an
 * estimate from an orbit. */
#include <math.h>
#include <string.h>

#include "instrument/frequencies/frequencies.h"
#include "instrument/frequencies/momentum.h"
#include "plot/draw.h"
#include "terminal.h"
#include "shell.h"
#include "study/options_impl.h"
#include "study/study_impl.h"

/* What frequencies can be told. */
typedef struct options {
    iso_frequencies_options study;
    shell_options shell;
} options;

/* --- the table -------------------------------------------------------------------------------------------------- */

static void print_head(const iso_scene *scene, const iso_frequencies *f)
{
    iso_params_print(say_to(), &scene->params);
    say("\nh = %.15g", f->h);
    if (!isnan(f->eps)) say(", eps = %.15g", f->eps);
    if (f->integral) say(", %s = %.15g", f->integral->name, f->F);
    say("\n\n");
    if (!f->estimated) {
        say("closed solution: %s\n", f->motion);
        if (!isnan(f->c))
            say("  it separates in sphero-conical coordinates u and v, with the constant c = %.15g\n", f->c);
        return;
    }
    say("ESTIMATED from an orbit: %s\n  %s: %s\n", f->motion,
        f->unresolved ? "the closed solution was not resolved" : "no closed solution", f->why);
    say("  orbit: %.6g turns, to t = %.10g, %zu samples\n", f->estimate.turns, f->estimate.length,
        f->estimate.samples);
    say("  a frequency differs between the halves of the orbit by %.1e, between the halves of its first quarter by "
        "%.1e\n",
        f->estimate.drift, f->estimate.drift_before);
    if (f->estimate.verdict == ISO_CHAOTIC)
        say("  a chaotic motion has no fixed frequencies: the numbers below hold for this orbit only\n");
    if (f->estimate.unexplained > 1e-4)
        say("  part of the amplitudes that two frequencies do not explain: %.2g\n", f->estimate.unexplained);
    if (f->angles == 2 && isnan(f->rotation) && f->estimate.verdict != ISO_CHAOTIC)
        say("  that is most of them: there is no rotation number\n");
}

static void print_separatrices(const iso_frequencies *f)
{
    say("\nrelative distance from the separatrix of an unstable rotation\n");
    for (int i = 0; i < f->separatrices; i++) say("  %s: %.15g\n", f->separatrix[i].what, f->separatrix[i].distance);
}

/* One line: a number in each clock, - where it is not known. */
static void print_clocks(const char *what, const double x[ISO_CLOCKS])
{
    say("%s", what);
    for (int c = 0; c < ISO_CLOCKS; c++)
        if (isnan(x[c]))
            say("\t-");
        else
            say("\t%.15g", x[c]);
    say("\n");
}

static void print_angles(const iso_frequencies *f)
{
    say("\n");
    say_table(1);
    say("angles in rad\tt\ttau\ts\n");
    for (int i = 0; i < f->angles; i++) {
        const iso_angle *a = &f->angle[i];
        say("angle %d: %s\n", i + 1, a->what);
        print_clocks("frequency", a->frequency);
        if (f->estimated) print_clocks("its error", a->error);
        print_clocks("period", a->period);
        if (!isnan(a->action)) say("action\t%.15g\t\t\n", a->action);
    }
    say_table_end();
}

static void print_resonances(const iso_frequencies *f)
{
    if (!isnan(f->rotation)) say("\nrotation number, frequency 1 / frequency 2: %.15g\n", f->rotation);
    if (f->resonances > 0) {
        say("near resonances: p times frequency 1 is almost q times frequency 2\n");
        say_table(1);
        say("p:q\trelative gap\tp angle 1 - q angle 2 makes one turn in\n");
    }
    for (int i = 0; i < f->resonances; i++) {
        const iso_resonance *r = &f->resonance[i];
        say("%d:%d\t%.1e\t", r->p, r->q, r->gap);
        if (r->met)
            say(f->estimated ? "- (the gap is within the error of the estimate)\n" : "- (resonant)\n");
        else
            say("t = %.6g\n", r->beat[ISO_CLOCK_T]);
    }
    if (f->resonances > 0) say_table_end();
    if (isnan(f->closed[ISO_CLOCK_T])) return;
    say("\nthe orbit is closed\n");
    say_table(1);
    say("in\tt\ttau\ts\n");
    print_clocks("period", f->closed);
    say_table_end();
}

static void print_table(const shell *s)
{
    const iso_frequencies *f = s->result.found;
    print_head(&s->scene, f);
    if (f->separatrices > 0) print_separatrices(f);
    if (f->angles > 0) print_angles(f);
    print_resonances(f);
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

/* The map (h, F), or the spectral lines of n(t). After a closed solution without a map they are estimated here. */
static iso_status draw_found(const shell *s, iso_frequencies *f)
{
    const options *o = s->options;
    iso_frequencies_options how = o->study;
    iso_record *table = NULL;
    iso_momentum m;
    how.progress = progress_told;
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

/* --- the command ------------------------------------------------------------------------------------------------ */

/* --t-end says the end, not the scene. */
static iso_status forget_end(shell *s)
{
    iso_scene_forget_place(&s->scene, "end");
    return ISO_OK;
}

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts parts = {.study = &iso_frequencies_study,
                                      .change = forget_end,
                                      .stopped = "no frequencies",
                                      .print = print_table,
                                      .draw = draw};
    return shell_run(ctx, &parts, options_given, &((const options *)options_given)->shell);
}

static const options defaults = {.shell = {.file = "-"}};

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_frequencies_option),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_frequencies = {
    COMMAND_OF_STUDY(frequencies, "SCENE", shell.file),
    .takes = FILE_SCENE,
    .description =
        "Where there is a closed solution (k = 1, k = -1, equal moments, principal planes; no rotor) the numbers are "
        "exact. Elsewhere they are estimated from an orbit in the ball's time t, by Laskar's frequency analysis. "
        "--turns, --t-end and --samples are about this orbit; the scene's own times are not read.\n\n"
        "--plot draws the image of the momentum map (h, F) with the orbit in it. Where there is no such map, it "
        "draws the spectral lines of n(t).",
    .example = "isoroll frequencies scene.yaml --plot map.svg",
};

/* isoroll chaos - tells whether an orbit is chaotic, and which part of the section is chaotic. */
#include <math.h>
#include <string.h>

#include "instrument/chaos/chaos_impl.h"
#include "plot/draw.h"
#include "terminal.h"
#include "shell.h"
#include "study/study_impl.h"

/* What chaos can be told. */
typedef struct options {
    iso_chaos_request study;
    shell_options shell;
} options;

/* --- the table -------------------------------------------------------------------------------------------------- */

static void print_head(const iso_scene *scene, const iso_chaos *c)
{
    say("this orbit: %s%s\n", iso_verdict_name(c->own.verdict), c->own.disagree ? ": ball and point disagree" : "");
    if (c->plane >= 0)
        say("  it is the rotation about axis %d in a principal plane, which is periodic\n", c->plane + 1);
    if (c->integral) say("  %s is an additional integral: no orbit is chaotic\n", c->integral->name);
    say("\n");
    iso_params_print(say_to(), &scene->params);
    say("\n");
    if (c->axis < 0)
        say("a turn is a step of %.6g in t: no section n_a = 0 is known to be global here\n", c->turn);
    else
        say("a turn is a return to the section n_%d = 0, n_%d increasing\n", c->axis + 1, c->axis + 1);
    if (c->plane < 0) say("\nlargest exponents per unit of t, tau and s\n");
}

/* x +- error; an error that is not known is "?" */
static void print_rate(double x, double error)
{
    if (isnan(x))
        say("\t-");
    else if (isnan(error))
        say("\t%.2e +- ?", x);
    else
        say("\t%.2e +- %.0e", x, error);
}

static void print_model(const iso_chaos *c, int model)
{
    const iso_indication *i = &c->own.result[model];
    if (!c->with[model]) return;
    say("%s\t%s\t%ld\t%.4g\t%.1e", iso_model_kind_name(model), iso_verdict_name(i->verdict), i->turns, i->megno,
        i->gali2);
    for (int clock = 0; clock < ISO_CLOCKS; clock++) print_rate(i->exponent[clock], i->error[clock]);
    say("\n");
}

static void print_models(const iso_chaos *c)
{
    say_table(1);
    say("model\tverdict\tturns\tMEGNO\tGALI_2\tper t\tper tau\tper s\n");
    for (int m = 0; m < 2; m++) print_model(c, m);
    say_table_end();
}

/* lam_t by the ball and by the point */
static void print_agreement(const iso_chaos *c)
{
    const iso_indication *one = &c->own.result[ISO_BALL], *other = &c->own.result[ISO_POINT];
    const double apart = fabs(one->exponent[ISO_CLOCK_T] - other->exponent[ISO_CLOCK_T]),
                 error = hypot(one->error[ISO_CLOCK_T], other->error[ISO_CLOCK_T]);
    if (!c->with[ISO_BALL] || !c->with[ISO_POINT] || isnan(apart) || isnan(error)) return;
    say("  the exponents per t of both models are %.2g errors apart\n", apart / error);
}

/* What the exponents are worth. */
static void print_worth(const iso_chaos *c)
{
    bool rough = false;
    long longest = 0;
    for (int m = 0; m < 2; m++) {
        const iso_indication *i = &c->own.result[m];
        if (!c->with[m] || i->verdict != ISO_CHAOTIC) continue;
        rough = rough || isnan(i->error[ISO_CLOCK_T] + i->per_turn_error);
        if (i->exponent_turns > i->turns && i->exponent_turns > longest) longest = i->exponent_turns;
    }
    if (c->own.verdict == ISO_REGULAR)
        say("  the exponents of a regular orbit are 0: these estimates fall like 1/turns\n");
    if (longest > 0) say("  the exponents are from %ld turns\n", longest);
    if (rough) say("  +- ?: the orbit is too short to know this error; --exponent-turns makes it longer\n");
}

/* How many of the starts were followed, if not all. */
static void print_followed(const iso_chaos_fraction *s)
{
    if (s->count == s->asked) return;
    say("  %zu of them were followed", s->count);
    if (s->failed > 0) say("; %zu failed", s->failed);
    say(s->count > 0 ? ": the shares are of these\n" : ": no share is known\n");
}

static void print_share(const iso_chaos *c)
{
    const iso_chaos_fraction *s = &c->share;
    if (s->asked == 0) return;
    const double count = (double)s->count;
    say("\n%zu starts spread evenly over the section, by its area dL dl, with a tolerance of %g:\n", s->asked,
        s->tolerance);
    print_followed(s);
    if (s->count == 0) return;
    say("  chaotic    %8.4f   (%zu); 95 %% interval %.4f to %.4f\n"
        "  regular    %8.4f   (%zu)\n"
        "  undecided  %8.4f   (%zu)\n",
        s->share, s->chaotic, s->low, s->high, (double)s->regular / count, s->regular, (double)s->undecided / count,
        s->undecided);
    if (s->undecided > 0 && c->integral)
        say("  undecided ones are not chaotic: the integral excludes it\n");
    else if (s->undecided > 0)
        say("  undecided ones count as not chaotic in the share and at the low end of the interval, as chaotic at\n"
            "  its high end; the middle of what is possible is %.4f\n",
            ((double)s->chaotic + (double)s->undecided / 2) / count);
    if (s->checked > 0 && s->disagree == 0)
        say("  ball and point both decided %zu of them, and never disagree\n", s->checked);
    else if (s->disagree > 0)
        say("  ball and point both decided %zu of them, and disagree about %zu: undecided\n", s->checked,
            s->disagree);
}

static void print_table(const shell *s)
{
    const iso_chaos *c = s->result.found;
    print_head(&s->scene, c);
    if (c->plane < 0) print_models(c);
    if (c->plane < 0) print_worth(c);
    print_agreement(c);
    print_share(c);
}

/* --- files ------------------------------------------------------------------------------------------------------ */

/* Orbit 0 is the scene's own. Other orbits that were not followed have no row. */
static iso_status describe(shell *s)
{
    const iso_chaos_options *how = &((const options *)s->options)->study.how;
    const iso_chaos *c = s->result.found;
    const iso_chaos_fraction *part = &c->share;
    if (part->count > 0)
        iso_plot_title(s->title, &s->scene.params,
                       ": %.3g of the section is chaotic (95 %%: %.3g to %.3g), %.3g beside it undecided",
                       part->share, part->low, part->high, (double)part->undecided / (double)part->count);
    else
        iso_plot_title(s->title, &s->scene.params, ": this orbit is %s", iso_verdict_name(c->own.verdict));
    return shell_lines(
        s, (const table_line[]){
               {.key = "turns", .number = (double)how->turns},
               {.key = "exponent_turns", .number = (double)how->exponent_turns},
               {.key = "starts", .number = (double)how->starts},
               {.key = "seed", .number = (double)how->seed},
               {.key = "axis", .number = c->chart + 1},
               {.key = "tolerance", .number = isnan(how->tolerance) ? s->scene.tolerance : how->tolerance},
               {.key = "starts_tolerance", .number = part->tolerance},
               {.key = "orbit 0", .text = "the scene's own; l and x are nan: it need not start on the section"},
               {.key = "nan elsewhere", .text = "not known; an orbit that was not followed has no row"},
               {.key = "title", .text = s->title},
               {.key = NULL}});
}

/* Of a model that was not followed there is no table. */
static int draw_indicators(const shell *s)
{
    const iso_record *table[3] = {NULL};
    int count = 0;
    iso_status status = ISO_OK;
    for (int i = 1; i <= 2; i++) {
        iso_record *r = s->result.table[i];
        if (!r || iso_record_rows(r) == 0) continue;
        if (status == ISO_OK) status = iso_record_set(s->ctx, r, "title", s->title);
        table[count++] = r;
    }
    if (status == ISO_OK && count == 0)
        status = iso_context_fail(s->ctx, ISO_BAD_INPUT, "", "no picture: there is no row of indicators");
    if (status == ISO_OK) status = plot_tables(s->ctx, &s->told->plot, table, NULL);
    return finish(s->ctx, status);
}

static int draw(const shell *s)
{
    const iso_chaos *c = s->result.found;
    if (c->share.count > 0) return shell_draw(s, s->result.table[0]);
    if (c->plane < 0) return draw_indicators(s);
    return finish(s->ctx, iso_context_fail(s->ctx, ISO_BAD_INPUT, "",
                                           "no picture: a rotation in a principal plane is periodic, and was not "
                                           "followed; --starts N draws the section of its energy"));
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static iso_status check(const shell *s)
{
    if (!s->told->table || strcmp(s->told->table, "-") != 0 || !s->told->json) return ISO_OK;
    return iso_context_fail(s->ctx, ISO_BAD_ARGUMENT, "csv",
                            "chaos: standard output has room for one of --csv - and --json");
}

static void complain_interrupted(const shell *s)
{
    const iso_chaos_options *how = &((const options *)s->options)->study.how;
    const iso_chaos *c = s->result.found;
    if (how->starts > 0)
        complain("interrupted: %zu of %zu starts were followed, some of them not for all turns",
                 c ? c->share.count : 0, how->starts);
    else
        complain("interrupted: without a verdict so far, the orbit is undecided");
}

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts parts = {.study = &iso_chaos_study,
                                      .kind = "chaos",
                                      .check = check,
                                      .interrupted = complain_interrupted,
                                      .print = print_table,
                                      .describe = describe,
                                      .draw = draw};
    return shell_run(ctx, &parts, options_given, &((const options *)options_given)->shell);
}

static const options defaults = {.shell = {.file = "-"}};

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_chaos_option),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_OF_FILE("output", "FILE", "a file", "write one row for each orbit to FILE; - is standard output",
                iso_set_text, options, shell.table, 'o', OPTION_WRITES),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_chaos = {
    COMMAND_OF_STUDY(chaos, "SCENE", shell.file),
    .takes = FILE_SCENE,
    .description =
        "Follows the scene's orbit from turn to turn, with two deviations beside it, until the indicators decide: "
        "regular, chaotic, or undecided after --turns. A turn is a return to a global section n_A = 0, on every "
        "level of the energy; with effects other than 'level', it is a step of the time t. The indicators are "
        "MEGNO, GALI_2, and the largest exponent with its error, per unit of t, tau and s. MEGNO is 2 on regular "
        "orbits, or 0 if all neighbours turn equally fast; on chaotic orbits it grows. Shown is its limit if the "
        "orbit is regular and the limit is known, else its mean so far, which may not have settled. GALI_2 is the "
        "sine of the angle between the deviations; on chaotic orbits it falls exponentially. Each model is "
        "integrated by itself. Of the scene's times and solver, only the tolerance is read.\n\n"
        "The error of an exponent is chosen so that at most one orbit in ten should be off by more than two "
        "errors. A chaotic orbit ends with its verdict, and is then often too short to know the error, which is "
        "shown as a question mark; --exponent-turns makes it longer.\n\n"
        "With --starts, M more orbits of the same energy start on the section, spread evenly. The part of them "
        "that is chaotic is printed with its confidence interval of 95 %. The interval comes from the scatter of "
        "16 sets of starts, each with a random shift of its own. Undecided orbits count both ways: as not chaotic "
        "at its low end, as chaotic at its high end. Orbits that were not followed do not count.\n\n"
        "--plot draws the indicators against the number of turns. With --starts it draws the section, coloured by "
        "exponent. After Ctrl-C, what is known so far is printed.\n\n"
        "Effects that keep the energy, such as gravity, are allowed. Effects that take energy are refused: such a "
        "motion comes to rest.",
    .example = "isoroll chaos scene.yaml --starts 1000 --plot chaos.png",
    .exits = "1: interrupted, or some orbits were not followed to the end\n"
             "4: the computation failed, or no memory",
};

/* isoroll chaos - tells whether an orbit is chaotic, and which part of the section is chaotic. */
#include <string.h>

#include "command.h"
#include "instrument/chaos/chaos_impl.h"
#include "plot/draw.h"

OPTIONS_OF_SCENE(iso_chaos_request);

/* Of a model that was not followed there is no table. */
static int draw_indicators(const shell *s)
{
    const iso_record *table[3] = {NULL};
    int count = 0;
    iso_status status = ISO_OK;
    for (int i = 1; i <= 2; i++) {
        iso_record *r = s->result.table[i];
        if (!r || iso_record_rows(r) == 0) continue;
        if (status == ISO_OK)
            status = iso_record_set(s->ctx, r, "title", iso_record_get(s->result.table[0], "title"));
        table[count++] = r;
    }
    if (status == ISO_OK && count == 0)
        status = ISO_FAIL_INPUT(s->ctx, "", "no picture: there is no row of indicators");
    if (status == ISO_OK) status = plot_tables(s->ctx, &s->common->plot, table, NULL);
    return finish(s->ctx, status);
}

static int draw(const shell *s)
{
    const iso_chaos *c = s->result.found;
    if (c->share.count > 0) return shell_draw(s, s->result.table[0]);
    if (c->plane < 0) return draw_indicators(s);
    return finish(s->ctx, ISO_FAIL_INPUT(s->ctx, "",
                                         "no picture: a rotation in a principal plane is periodic, and was not "
                                         "followed; --starts N draws the section of its energy"));
}

static iso_status check(const shell *s)
{
    if (!s->common->table || strcmp(s->common->table, "-") != 0 || !s->common->json) return ISO_OK;
    return ISO_FAIL_ARGUMENT(s->ctx, "csv", "chaos: standard output has room for one of --csv - and --json");
}

static void warn_interrupted(const shell *s)
{
    const iso_chaos_options *how = &((const options *)s->options)->study.how;
    const iso_chaos *c = s->result.found;
    if (how->starts > 0)
        warn("interrupted: %zu of %zu starts were followed, some of them not for all turns", c ? c->share.count : 0,
             how->starts);
    else
        warn("interrupted: without a verdict so far, the orbit is undecided");
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_chaos_option),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_OF_FILE("output", "FILE", "a file", "write one row for each orbit to FILE; - is standard output",
                iso_set_text, options, shell.table, 'o', OPTION_WRITES),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_chaos = {
    COMMAND_OF_SCENE(chaos),
    .parts = {.kind = "chaos", .check = check, .interrupted = warn_interrupted, .draw = draw},
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

/* isoroll chaos - tells whether an orbit is chaotic, and which part of the section is chaotic. */
#include <math.h>
#include <string.h>

#include "io/output.h"
#include "json.h"
#include "plot/plot.h"
#include "progress.h"
#include "scene_options.h"
#include "study/chaos/chaos.h"
#include "table.h"

/* What chaos can be told. */
typedef struct options {
    scene_options scene;           /* only its file and tolerance are used */
    const char *axis, *csv, *plot; /* NULL: not given                      */
    double turns, exponent_turns, starts, seed, threads;
    iso_models models; /* ISO_SHOW_START: not given */
    bool json;
} options;

/* --- the table -------------------------------------------------------------------------------------------------- */

static void print_head(const iso_scene *scene, const iso_chaos *c)
{
    const double *J = scene->params.J;
    printf("k = %.15g, J = %.15g %.15g %.15g\n", scene->params.k, J[0], J[1], J[2]);
    if (c->axis < 0)
        printf("a turn is a step of %.6g in t: no section n_a = 0 is known to be global here\n", c->turn);
    else
        printf("a turn is a return to the section n_%d = 0, n_%d increasing\n", c->axis + 1, c->axis + 1);
    if (c->integral) printf("%s is a further integral: no orbit is chaotic\n", c->integral->name);
    printf("\nthis orbit: %s", iso_verdict_name(c->own.verdict));
    if (c->own.disagree) printf(": ball and point disagree");
    if (c->plane >= 0) {
        printf("\n  it is the rotation about axis %d in a principal plane, which is periodic\n", c->plane + 1);
        return;
    }
    printf(
        "\n\n%47s largest exponent per unit of\n  model  verdict      turns     MEGNO   GALI_2  %18s  %18s  %18s\n",
        "", "t", "tau", "s");
}

/* x +- error, in 20 columns; an error that is not known is "?" */
static void print_rate(double x, double error)
{
    if (isnan(x))
        printf("  %18s", "-");
    else if (isnan(error))
        printf("  %9.2e +- %5s", x, "?");
    else
        printf("  %9.2e +- %5.0e", x, error);
}

static void print_model(const iso_chaos *c, int model)
{
    const iso_indication *i = &c->own.told[model];
    if (!c->with[model]) return;
    printf("  %-5s  %-9s  %7ld  %8.4g  %7.1e", iso_model_kind_name(model), iso_verdict_name(i->verdict), i->turns,
           i->megno, i->gali2);
    for (int clock = 0; clock < ISO_CLOCKS; clock++) print_rate(i->exponent[clock], i->error[clock]);
    printf("\n");
}

/* lam_t by the ball and by the point */
static void print_agreement(const iso_chaos *c)
{
    const iso_indication *one = &c->own.told[ISO_BALL], *other = &c->own.told[ISO_POINT];
    const double apart = fabs(one->exponent[ISO_CLOCK_T] - other->exponent[ISO_CLOCK_T]),
                 error = hypot(one->error[ISO_CLOCK_T], other->error[ISO_CLOCK_T]);
    if (!c->with[ISO_BALL] || !c->with[ISO_POINT] || isnan(apart) || isnan(error)) return;
    printf("  the exponents per t of both models are %.2g errors apart\n", apart / error);
}

/* What the exponents are worth. */
static void print_worth(const iso_chaos *c)
{
    bool rough = false;
    long longest = 0;
    for (int m = 0; m < 2; m++) {
        const iso_indication *i = &c->own.told[m];
        if (!c->with[m] || i->verdict != ISO_CHAOTIC) continue;
        rough = rough || isnan(i->error[ISO_CLOCK_T] + i->per_turn_error);
        if (i->exponent_turns > i->turns && i->exponent_turns > longest) longest = i->exponent_turns;
    }
    if (c->own.verdict == ISO_REGULAR)
        printf("  the exponents of a regular orbit are 0: these estimates fall like 1/turns\n");
    if (longest > 0) printf("  the exponents are from %ld turns\n", longest);
    if (rough) printf("  +- ?: the orbit is too short to know this error; --exponent-turns makes it longer\n");
}

/* How many of the starts were followed, if not all. */
static void print_followed(const iso_chaos_fraction *s)
{
    if (s->count == s->asked) return;
    printf("  %zu of them were followed", s->count);
    if (s->failed > 0) printf("; %zu failed", s->failed);
    printf(s->count > 0 ? ": the shares are of these\n" : ": no share is known\n");
}

static void print_share(const iso_chaos_fraction *s)
{
    if (s->asked == 0) return;
    const double count = (double)s->count;
    printf("\n%zu starts spread evenly over the section, by its area dL dl:\n", s->asked);
    print_followed(s);
    if (s->count == 0) return;
    printf("  chaotic    %8.4f   (%zu); 95 %% interval %.4f to %.4f\n"
           "  regular    %8.4f   (%zu)\n"
           "  undecided  %8.4f   (%zu)\n",
           s->share, s->chaotic, s->low, s->high, (double)s->regular / count, s->regular,
           (double)s->undecided / count, s->undecided);
    if (s->undecided > 0)
        printf("  undecided ones count both ways: not chaotic at the low end, chaotic at the high end\n");
    if (s->disagree > 0) printf("  of the undecided: ball and point disagree about %zu\n", s->disagree);
}

static void print_table(const iso_scene *scene, const iso_chaos *c)
{
    print_head(scene, c);
    for (int m = 0; m < 2 && c->plane < 0; m++) print_model(c, m);
    if (c->plane < 0) print_worth(c);
    print_agreement(c);
    print_share(&c->share);
}

/* --- JSON ------------------------------------------------------------------------------------------------------- */

static json_t *clocks_of(const double x[ISO_CLOCKS])
{
    return json_pack("{s:o, s:o, s:o}", "t", json_number(x[0]), "tau", json_number(x[1]), "s", json_number(x[2]));
}

static json_t *model_of(const iso_chaos *c, int model)
{
    const iso_indication *i = &c->own.told[model];
    if (!c->with[model]) return json_null();
    return json_pack("{s:s, s:I, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "verdict",
                     iso_verdict_name(i->verdict), "turns", (json_int_t)i->turns, "exponent_turns",
                     (json_int_t)i->exponent_turns, "exponent", clocks_of(i->exponent), "error", clocks_of(i->error),
                     "exponent_per_turn", json_number(i->per_turn), "error_per_turn", json_number(i->per_turn_error),
                     "megno", json_number(i->megno), "megno_now", json_number(i->megno_now), "megno_mean",
                     json_number(i->megno_mean), "gali2", json_number(i->gali2), "digits", json_number(i->digits));
}

static json_t *share_of(const iso_chaos_fraction *s)
{
    const double n = (double)s->count; /* 0: then every part of it is NaN, and null in the file */
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:I, s:I, s:I, s:I, s:I, s:I, s:I}", "chaotic",
                     json_number(s->share), "error", json_number((s->high - s->low) / 2), "low", json_number(s->low),
                     "high", json_number(s->high), "regular", json_number((double)s->regular / n), "undecided",
                     json_number((double)s->undecided / n), "starts", (json_int_t)s->asked, "followed",
                     (json_int_t)s->count, "chaotic_starts", (json_int_t)s->chaotic, "regular_starts",
                     (json_int_t)s->regular, "undecided_starts", (json_int_t)s->undecided, "disagree",
                     (json_int_t)s->disagree, "failed", (json_int_t)s->failed);
}

static long turns_of(const iso_chaos *c)
{
    long turns = 0;
    for (int m = 0; m < 2; m++)
        if (c->with[m] && c->own.told[m].turns > turns) turns = c->own.told[m].turns;
    return turns;
}

/* False: there is no memory. */
static bool print_json(const iso_scene *scene, const iso_chaos *c)
{
    const iso_params *p = &scene->params;
    json_t *section = c->axis < 0 ? json_null() : json_pack("{s:i}", "axis", c->axis + 1);
    json_t *o =
        json_pack("{s:s, s:o, s:[o,o,o], s:o, s:o, s:s?, s:s, s:b, s:I, s:o, s:o}", "isoroll", iso_version(), "k",
                  json_number(p->k), "J", json_number(p->J[0]), json_number(p->J[1]), json_number(p->J[2]), "section",
                  section, "turn", json_number(c->turn), "integral", c->integral ? c->integral->name : NULL,
                  "verdict", iso_verdict_name(c->own.verdict), "disagree", (int)c->own.disagree, "turns",
                  (json_int_t)turns_of(c), "ball", model_of(c, ISO_BALL), "point", model_of(c, ISO_POINT));
    if (o && c->share.asked > 0) json_object_set_new(o, "share", share_of(&c->share));
    return json_print(o);
}

/* --- files ------------------------------------------------------------------------------------------------------ */

/* The exponent per turn, from the first model whose verdict is that of the orbit; regular: 0; undecided: NaN. */
static double exponent_of(const iso_chaos *c, const iso_chaos_orbit *o)
{
    if (o->verdict == ISO_REGULAR) return 0;
    if (o->verdict == ISO_UNDECIDED) return NAN;
    for (int m = 0; m < 2; m++)
        if (c->with[m] && o->told[m].verdict == o->verdict) return o->told[m].per_turn;
    return NAN;
}

/* How many of the spread starts the result has; some of them may not have been followed. */
static size_t spread_of(const iso_chaos *c)
{
    return c->starts < c->share.asked ? c->starts : c->share.asked;
}

/* The beginning of the table. */
static iso_status begin_csv(iso_context *ctx, const options *o, const iso_scene *scene, const iso_chaos *c,
                            iso_output *csv)
{
    static const char *const names[] = {"ball", "point"}, *const kept[] = {"verdict", "turns", "exponent",
                                                                           "error",   "megno", "gali2"};
    char columns[400] = "orbit,l,x,verdict";
    const table_line lines[] = {
        {.key = "turns", .number = o->turns},
        {.key = "exponent_turns", .number = o->exponent_turns},
        {.key = "starts", .number = o->starts},
        {.key = "seed", .number = o->seed},
        {.key = "tolerance", .number = isnan(o->scene.tolerance) ? scene->tolerance : o->scene.tolerance},
        {.key = "orbit 0", .text = "the scene's own; l and x are nan: it need not start on the section"},
        {.key = "nan elsewhere", .text = "not known; an orbit that was not followed has no row"},
        {.key = NULL}};
    for (int m = 0; m < 2; m++)
        for (size_t i = 0; c->with[m] && i < sizeof kept / sizeof *kept; i++)
            snprintf(columns + strlen(columns), sizeof columns - strlen(columns), ",%s_%s", names[m], kept[i]);
    return table_begin(ctx, csv, "chaos", scene, lines, columns);
}

/* Orbit 0 is the scene's own. Other orbits that were not followed have no row. */
static void write_rows(const iso_chaos *c, FILE *to)
{
    for (size_t i = 0; i <= spread_of(c); i++) {
        const iso_chaos_orbit *o = i == 0 ? &c->own : &c->start[i - 1];
        if (i > 0 && !iso_chaos_followed(o)) continue;
        fprintf(to, "%zu,%.17g,%.17g,%s", i, o->l, o->x, iso_verdict_name(o->verdict));
        for (int m = 0; m < 2; m++)
            if (c->with[m])
                fprintf(to, ",%s,%ld,%.17g,%.17g,%.17g,%.17g", iso_verdict_name(o->told[m].verdict), o->told[m].turns,
                        o->told[m].exponent[ISO_CLOCK_T], o->told[m].error[ISO_CLOCK_T], o->told[m].megno,
                        o->told[m].gali2);
        fputc('\n', to);
    }
}

/* Columns l, x, exponent per turn (0: regular, NaN: undecided) of the starts that were followed. */
static iso_status draw_section(iso_context *ctx, const options *o, const iso_chaos *c, const char *title)
{
    static const char *const names[] = {"l", "x", "exponent"};
    iso_record *r;
    iso_status status = iso_record_create(ctx, 3, names, &r);
    for (size_t i = 0; i < spread_of(c) && status == ISO_OK; i++) {
        double *row;
        if (!iso_chaos_followed(&c->start[i])) continue;
        status = iso_record_append(ctx, r, &row);
        if (status != ISO_OK) break;
        row[0] = c->start[i].l;
        row[1] = c->start[i].x;
        row[2] = exponent_of(c, &c->start[i]);
    }
    if (status == ISO_OK) status = iso_plot_exponents(ctx, o->plot, title, c->axis, r);
    iso_record_free(r);
    return status;
}

static iso_status draw(iso_context *ctx, const options *o, const iso_scene *scene, const iso_chaos *c)
{
    const double *J = scene->params.J;
    char title[200];
    if (c->share.count > 0) {
        snprintf(title, sizeof title,
                 "k = %.6g, J = %.6g %.6g %.6g: %.3g of the area is chaotic (95 %%: %.3g to %.3g), %.3g undecided",
                 scene->params.k, J[0], J[1], J[2], c->share.share, c->share.low, c->share.high,
                 (double)c->share.undecided / (double)c->share.count);
        return draw_section(ctx, o, c, title);
    }
    snprintf(title, sizeof title, "k = %.6g, J = %.6g %.6g %.6g: %s", scene->params.k, J[0], J[1], J[2],
             iso_verdict_name(c->own.verdict));
    return iso_plot_indicators(ctx, o->plot, title, c->trace[ISO_BALL], c->trace[ISO_POINT]);
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static int report(iso_context *ctx, const options *o, const iso_scene *scene, const iso_chaos *c, iso_output *csv)
{
    int result = c->failure == ISO_OK ? EXIT_DONE : EXIT_SOME_FAILED;
    if (c->failure != ISO_OK) complain("an orbit was not followed to the end: %s", c->words);
    if (o->json)
        result = print_json(scene, c) ? result : EXIT_NUMERICAL;
    else if (!o->csv || strcmp(o->csv, "-") != 0)
        print_table(scene, c);
    if (csv) {
        const iso_status status = begin_csv(ctx, o, scene, c, csv);
        if (status == ISO_OK) write_rows(c, iso_output_stream(csv));
        result = worse(result, finish(ctx, table_end(ctx, csv, status)));
    }
    if (o->plot && c->plane >= 0 && c->share.count == 0)
        complain("no picture: a rotation in a principal plane is periodic, and was not followed");
    else if (o->plot)
        result = worse(result, finish(ctx, draw(ctx, o, scene, c)));
    return result;
}

/* Reads the scene and opens the files. Refuses wrong options before the work begins. */
static iso_status prepare(iso_context *ctx, const options *o, iso_scene *scene, iso_chaos_options *how,
                          iso_output **csv)
{
    *how = iso_chaos_defaults();
    if (o->csv && strcmp(o->csv, "-") == 0 && o->json)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "csv",
                                "chaos: standard output has room for one of --csv - and --json");
    iso_status status = o->plot ? iso_plot_check_format(ctx, o->plot) : ISO_OK;
    if (status == ISO_OK) status = read_axis(ctx, o->axis, &how->axis);
    how->turns = (long)o->turns;
    how->exponent_turns = (long)o->exponent_turns;
    how->starts = (size_t)o->starts;
    how->seed = (uint64_t)o->seed;
    how->threads = as_int(o->threads);
    how->models = o->models;
    how->tolerance = o->scene.tolerance;
    how->progress = progress_told;
    if (status == ISO_OK) status = iso_scene_read(ctx, o->scene.file, scene);
    return status == ISO_OK && o->csv ? iso_output_open(ctx, o->csv, csv) : status;
}

static void complain_interrupted(const iso_chaos_options *how, const iso_chaos *c)
{
    if (how->starts > 0)
        complain("interrupted: %zu of %zu starts were followed, some of them not for all turns",
                 c ? c->share.count : 0, how->starts);
    else
        complain("interrupted: without a verdict so far, the orbit is undecided");
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_scene scene = {.places = 0};
    iso_output *csv = NULL;
    iso_chaos *c = NULL;
    iso_chaos_options how;
    iso_status status = prepare(ctx, o, &scene, &how, &csv);
    if (status != ISO_OK) return finish(ctx, status);
    stop_gently();
    progress_begin();
    iso_context_set_monitor(ctx, not_interrupted, NULL);
    status = iso_chaos_run(ctx, &scene, &how, &c);
    iso_context_set_monitor(ctx, NULL, NULL);
    progress_end();
    int result = finish_scene(ctx, &o->scene, &scene, status);
    if (status == ISO_STOPPED) complain_interrupted(&how, c);
    if (c)
        result = worse(result, report(ctx, o, &scene, c, csv));
    else
        iso_output_close(ctx, csv, false);
    iso_chaos_free(c);
    return result;
}

static const options defaults = {.scene = SCENE_OPTIONS_UNSET, .turns = 3000, .models = ISO_SHOW_START};

static const option_row rows[] = {
    ROW("turns", "N", "a whole number from 1 on",
        "follow each orbit for at most N turns (default 3000); it ends earlier once there is a verdict", set_count,
        options, turns),
    ROW("exponent-turns", "N", "a whole number from 0 on",
        "go on with a chaotic orbit until it has N turns, for its exponent; default 0: it ends with the verdict",
        set_whole, options, exponent_turns),
    ROW("starts", "M", "a whole number from 0 on",
        "M more orbits of the same energy, spread evenly over the section: tells which part of it is chaotic",
        set_whole, options, starts),
    ROW_SEED(options, seed),
    ROW_MODELS(options, models),
    ROW("axis", "A", "auto, 1, 2 or 3",
        "a turn is a return to n_A = 0, n_A increasing, which must be global; auto (default): one that is", set_text,
        options, axis),
    ROW_TOLERANCE(options, scene),
    ROW_THREADS(options, threads),
    ROW_PLOT(options, plot),
    ROW_OF_FILE("csv", "FILE", "a file", "write one row for each orbit to FILE; - is standard output", set_text,
                options, csv, 0, OPTION_WRITES),
    ROW_JSON(options, json),
    ROW_END,
};

const command command_chaos = {
    .name = "chaos",
    .argument = "SCENE",
    .doc = "tell whether an orbit is chaotic, and which part of the section is chaotic",
    .rows = rows,
    .defaults = &defaults,
    .size = sizeof defaults,
    .file = offsetof(options, scene.file),
    .takes = FILE_SCENE,
    .description =
        "Follows the scene's orbit from turn to turn, with two deviations beside it, until the indicators decide: "
        "regular, chaotic, or undecided after --turns. A turn is a return to a global section n_A = 0, on every "
        "level of the energy; with effects other than 'level', it is a step of the time t. The indicators are "
        "MEGNO, GALI_2, and the largest exponent with its error, per unit of t, tau and s. MEGNO is 2 on regular "
        "orbits, or 0 if all neighbours turn equally fast; on chaotic orbits it grows. GALI_2 is the sine of the "
        "angle between the deviations; on chaotic orbits it falls exponentially. Each model is integrated by "
        "itself. Of the scene's times and solver, only the tolerance is read.\n\n"
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
    .run = run,
};

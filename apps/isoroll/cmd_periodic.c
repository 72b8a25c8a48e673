/* isoroll periodic - finds periodic orbits and tells whether they are stable; follows them; draws a chart. */
#include <math.h>
#include <stdlib.h>

#include "base/number_impl.h"
#include "instrument/periodic/periodic_study_impl.h"
#include "terminal.h"
#include "scene_options.h"
#include "shell.h"
#include "study/study_impl.h"

/* What periodic can be told. */
typedef struct options {
    iso_periodic_request study;
    shell_options shell;
} options;

/* --- the list --------------------------------------------------------------------------------------------------- */

static void print_level(double level)
{
    if (level != 0) say("level of the point, (H/eps) J2^(1/k): %s\n", ISO_SHORT(level));
}

static void print_multipliers(const iso_multipliers *m)
{
    if (m->krein)
        say("exp(+-%.9g i), Krein %+d", atan2(m->value[0][1], m->value[0][0]), m->krein);
    else
        say("%.9g, %.9g", m->value[0][0], m->value[1][0]);
}

static void print_rotations(const iso_periodic *found, bool polish)
{
    say("rotations about the principal axes, half a turn (Hill's equation)\n");
    say_table(1);
    say("axis\ttrace\terror\tstability\tmultipliers\n");
    for (int a = 0; a < 3; a++) {
        const iso_rotation *o = &found->rotation[a];
        char text[ISO_DIGITS_SIZE];
        iso_periodic_digits(o->half_turn_trace, o->tail, text);
        if (o->oscillates) {
            say("%d\tnone on this level: an oscillation between two places of rest\n", a + 1);
            continue;
        }
        say("%d\t%s\t%.1e\t%s\t", a + 1, polish ? text : ISO_ROUNDED(o->half_turn_trace, 15), o->error,
            iso_stability_name(o->half.stability));
        print_multipliers(&o->half);
        say("\n");
    }
    say_table_end();
}

static void print_orbit(const iso_periodic *found, bool polish, size_t i)
{
    const iso_periodic_orbit *o = &found->orbit[i];
    char words[ISO_DIGITS_SIZE], l[ISO_DIGITS_SIZE], x[ISO_DIGITS_SIZE], trace[ISO_DIGITS_SIZE];
    iso_symmetry_words(o->symmetry, words);
    if (!polish) {
        say("%zu\t%d\t%.15f\t%.15f\t%.11g\t%.0e\t%s\t%s\t%d\t%.9g\n", i + 1, o->period, o->l, o->x, o->trace,
            o->error, iso_stability_name(o->multipliers.stability), words, o->copies, o->clock[0]);
        return;
    }
    iso_periodic_digits(o->l, o->l_tail, l);
    iso_periodic_digits(o->x, o->x_tail, x);
    iso_periodic_digits(o->trace, o->trace_tail, trace);
    say("%zu\t%d\t%s\t%s\t%s\t%.0e\t%.0e\t%s\t%s\n", i + 1, o->period, l, x, trace, o->error, o->closure,
        iso_stability_name(o->multipliers.stability), words);
}

static void print_list(const shell *s)
{
    const iso_periodic_options *how = &((const options *)s->options)->study.how;
    const iso_periodic *f = s->result.found;
    const iso_params *p = &s->scene.params;
    size_t copies = 0, tori = 0;
    iso_params_print(say_to(), p);
    say("; section n_%d = 0, n_%d increasing\n", f->axis + 1, f->axis + 1);
    print_level(f->level);
    say("\n");
    print_rotations(f, how->polish);
    say("\n%s orbits of %d returns at most, but the rotations: %zu\n", how->all ? "periodic" : "symmetric periodic",
        f->longest, f->count);
    if (f->count > 0) {
        say_table(2);
        say("no\tperiod\tl\tx\ttrace\terror\t%s\n",
            how->polish ? "closure\tstability\tsymmetry" : "stability\tsymmetry\tcopies\tt");
    }
    for (size_t i = 0; i < f->count; i++) {
        print_orbit(f, how->polish, i);
        copies += (size_t)f->orbit[i].copies;
        tori += f->orbit[i].torus;
    }
    if (f->count > 0) say_table_end();
    if (f->count > 0) say("with their copies by R, S1 S2 and T%s: %zu\n", how->all ? " (and S1)" : "", copies);
    if (tori > 0)
        say("k = %s: %zu of them lie on resonant tori, which are full of such orbits: the trace is 2, and they are "
            "degenerate\n",
            ISO_SHORT(p->k), tori);
}

static iso_status describe_list(shell *s)
{
    const iso_periodic *f = s->result.found;
    return shell_lines(s, (const table_line[]){{.key = "level", .number = f->level},
                                               {.key = "longest_period", .number = f->longest},
                                               {.key = "axis", .number = f->axis + 1},
                                               {.key = NULL}});
}

/* A row for each crossing of each orbit, as it is drawn. */
static iso_status put_crossings(iso_context *ctx, const iso_periodic *found, iso_record *table)
{
    iso_status status = ISO_OK;
    for (size_t i = 0; i < found->count; i++) {
        iso_periodic_orbit o = found->orbit[i];
        for (int n = 0; status == ISO_OK && n < 2 * o.period; n++) {
            o.l = found->orbit[i].half[n][0], o.x = found->orbit[i].half[n][1];
            status = iso_columns_append(ctx, iso_periodic_orbit_fields, &o, table);
        }
    }
    return status;
}

static int draw_list(const shell *s)
{
    const iso_periodic *f = s->result.found;
    char title[ISO_PLOT_TITLE];
    iso_record *whole = NULL;
    if (f->count == 0) return complain("no picture: there is no orbit"), EXIT_SOME_FAILED;
    iso_plot_title(title, &s->scene.params, ": periodic orbits of %d returns at most", f->longest);
    iso_status status = iso_record_create_like(s->ctx, s->result.table[0], 0, NULL, &whole);
    if (status == ISO_OK) status = iso_record_set(s->ctx, whole, "title", title);
    if (status == ISO_OK) status = put_crossings(s->ctx, f, whole);
    const int result = status == ISO_OK ? shell_draw(s, whole) : finish(s->ctx, status);
    iso_record_free(whole);
    return result;
}

/* --- branches --------------------------------------------------------------------------------------------------- */

static void print_branch(const iso_continuations *f, size_t i, const char *name)
{
    const iso_branch *b = &f->branch[i];
    double low = INFINITY, high = -INFINITY;
    for (size_t j = 0; j < b->points; j++) low = fmin(low, b->point[j].value), high = fmax(high, b->point[j].value);
    say("\nbranch %zu: period %d, on the line of %s, %s from %.12g to %.12g, %zu points", i + 1, b->period,
        iso_symmetry_line_name(b->line), name, low, high, b->points);
    if (b->parent >= 0) say(", from branch %d", b->parent + 1);
    say("\n");
    if (b->events == 0) return;
    say_table(1);
    say("event\t%s\tl\tx\ttrace\twhat happens\n", name);
    for (size_t j = 0; j < b->events; j++)
        say("%s\t%.13g\t%.9g\t%.9g\t%.8g\t%s\n", iso_branch_kind_name(b->event[j].kind), b->event[j].at.value,
            b->event[j].at.l, b->event[j].at.x, b->event[j].at.trace, b->event[j].words);
    say_table_end();
}

static void print_branches(const shell *s)
{
    const iso_continuations *f = s->result.found;
    for (size_t i = 0; i < f->count; i++) print_branch(f, i, iso_vary_name((int)f->vary));
}

static iso_status describe_branches(shell *s)
{
    const iso_continuations *f = s->result.found;
    iso_plot_title(s->title, &s->scene.params, ": periodic orbits followed along %s", iso_vary_name((int)f->vary));
    return shell_lines(s, (const table_line[]){{.key = "title", .text = s->title}, {.key = NULL}});
}

static int draw_branches(const shell *s)
{
    return ((const iso_continuations *)s->result.found)->count > 0 ? shell_draw(s, s->result.table[0]) : EXIT_DONE;
}

/* Interrupted while orbits were sought, or followed. */
static void complain_branches(const shell *s)
{
    complain(s->result.found ? "interrupted: branches are missing or cut" : "interrupted: orbits are missing");
}

/* --- the chart -------------------------------------------------------------------------------------------------- */

#define EDGE 1e-9 /* with equal moments a trace is 2 or -2 up to rounding */

static void print_chart(const shell *s)
{
    const iso_chart_found *f = s->result.found;
    const iso_stability_options *o = &f->how;
    const iso_record *grid = f->grid;
    size_t count[2][3] = {{0}}, none[2] = {0};
    static const char *const axes[] = {"least", "greatest"};
    for (size_t i = 0; i < iso_record_rows(grid); i++)
        for (int which = 0; which < 2; which++) {
            const double T = iso_record_const_row(grid, i)[2 + which];
            if (!isnan(T))
                count[which][T < -2 - EDGE ? 0 : T > 2 + EDGE ? 2 : 1]++;
            else
                none[which] += fabs(iso_record_const_row(grid, i)[0]) >= ISO_LEAST_K;
        }
    say("k from %s to %s, %s from %s to %s; share of the grid points\n", ISO_SHORT(o->from[0]), ISO_SHORT(o->to[0]),
        iso_chart_name(o->moment), ISO_SHORT(o->from[1]), ISO_SHORT(o->to[1]));
    say_table(1);
    say("rotation about\tT < -2\tstable\tT > 2\n");
    for (int which = 0; which < 2; which++) {
        const double all = (double)(count[which][0] + count[which][1] + count[which][2]);
        say("%s moment\t%.4f\t%.4f\t%.4f\n", axes[which], (double)count[which][0] / all,
            (double)count[which][1] / all, (double)count[which][2] / all);
    }
    say_table_end();
    print_level(o->level);
    for (int which = 0; which < 2; which++)
        if (none[which] > 0)
            say("left out: %zu grid points, where there is no rotation about the axis of the %s moment, but an "
                "oscillation between two places of rest\n",
                none[which], axes[which]);
    say("%zu points of the borders T = 2 and T = -2: see -o, --json and --plot\n", iso_record_rows(f->borders));
}

static iso_status describe_chart(shell *s)
{
    const iso_stability_options *o = &((const iso_chart_found *)s->result.found)->how;
    const double *J = o->J;
    const bool by_level = o->moment == ISO_CHART_LEVEL;
    const int a = o->moment == 0 ? 1 : 0, b = o->moment == 2 ? 1 : 2; /* the other moments */
    if (by_level)
        snprintf(s->title, sizeof s->title, "stable rotations: J = (%.6g, %.6g, %.6g)", J[0], J[1], J[2]);
    else if (o->level == 0)
        snprintf(s->title, sizeof s->title, "stable rotations: J%d = %.6g, J%d = %.6g", a + 1, J[a], b + 1, J[b]);
    else
        snprintf(s->title, sizeof s->title, "stable rotations: J%d = %.6g, J%d = %.6g, level %.6g", a + 1, J[a],
                 b + 1, J[b], o->level);
    return shell_lines(s, (const table_line[]){{.key = "title", .text = s->title},
                                               {.key = by_level ? NULL : "level", .number = o->level},
                                               {.key = NULL}});
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static json_t *json_without_scene(const shell *s)
{
    return json_of(s->result.fields, s->result.found);
}

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts list = {.study = &iso_periodic_study,
                                     .kind = "periodic",
                                     .stopped = "orbits are missing",
                                     .print = print_list,
                                     .describe = describe_list,
                                     .draw = draw_list},
                             follow = {.study = &iso_periodic_study,
                                       .kind = "periodic follow",
                                       .interrupted = complain_branches,
                                       .json = json_without_scene,
                                       .print = print_branches,
                                       .describe = describe_branches,
                                       .draw = draw_branches},
                             chart = {.study = &iso_periodic_study,
                                      .kind = "periodic chart",
                                      .stopped = "no chart",
                                      .json = json_without_scene,
                                      .print = print_chart,
                                      .describe = describe_chart};
    const options *o = options_given;
    return shell_run(ctx, o->study.chart ? &chart : o->study.follow ? &follow : &list, o, &o->shell);
}

static const options defaults = {.shell = {.file = "-"}};

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_periodic_option),
    ROW_OUTPUT(options, shell.table),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_periodic = {
    COMMAND_OF_STUDY(periodic, "SCENE", shell.file),
    .takes = FILE_SCENE,
    .description =
        "Shows the rotations about the principal axes first: the trace of Hill's equation over half a turn, found "
        "in two ways, stable between -2 and 2. Then it searches for all symmetric periodic orbits of at most P "
        "returns to the section n_a = 0, as roots along the six symmetry lines: x = 0, l = 0 and l = pi/2 of the "
        "section, for the reversors S1, S2, S3; and three lines half way between two crossings, for T S1, T S2, T "
        "S3. A message says where some may be missing. Orbits without a symmetry need --all.\n\n"
        "For each orbit: a point (l, x) of the section, the trace of the return map's derivative over the period "
        "with its error, stability, which reversors map the orbit to itself, how many copies R, S1 S2 and T make "
        "of it (itself among them), and its period in t. JSON and -o add the start in both models, the periods in "
        "tau and s, and how well the orbit closes. lib/doc/theory.md explains R, S1, S2, S3 and T.\n\n"
        "Only k, J and the energy of the scene are read. Orbits of the free ball do not depend on the energy, only "
        "their clocks do. A point off H = 0, or a ball with the effect 'level', has a level (H/eps) J2^(1/k), J2 "
        "the middle moment: a number without a unit. Orbits depend on it. On a low level the point cannot reach "
        "the whole sphere. Then a rotation may be missing, and the point oscillates between two places of rest "
        "instead.\n\n"
        "For k = 1 and k = -1 most periodic orbits fill tori, on every level. Those on the symmetry lines are "
        "listed as degenerate (trace 2).\n\n"
        "--follow k=A:B follows symmetric orbits from the scene's k to A and to B, or until they end: folds, "
        "period doublings, touches of the trace -2, symmetry breaking and collisions with rotations are located. "
        "Where a branch cannot be followed, a line says where and why, and the part so far is kept. --branches "
        "follows what branches off as well, but not what branches off from that. While k or a moment changes, the "
        "level stays that of the scene; --follow level=A:B changes it.\n\n"
        "--chart J2 shows in which part of the plane of k and J2 the rotations about the axes of the least and of "
        "the greatest moment are stable, and the borders on which a trace is 2 or -2. (The axis of the middle "
        "moment is never stable.) The level is that of the scene, or --level; --chart level=A:B has the level in "
        "place of J2.\n\n"
        "-o FILE writes one row for each orbit, in doubles. --plot draws all orbits and their copies on the "
        "section, unstable ones in grey.",
    .example = "isoroll periodic scene.yaml --period 8 --plot orbits.svg",
    .exits = "1: interrupted, or a branch could not be followed to its end\n"
             "2: wrong usage, or a range without the scene's value\n"
             "3: bad input: an effect that acts, other than 'level', two equal moments, a ball at rest",
};

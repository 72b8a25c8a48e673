/* isoroll splitting - how far the separatrix of the middle axis' rotation splits: why only k = 1 and k = -1. */
#include <math.h>

#include "base/number_impl.h"
#include "instrument/separatrix/separatrix_study_impl.h"
#include "picture/picture_impl.h"
#include "plot/draw.h"
#include "terminal.h"
#include "scene_options.h"
#include "shell.h"

/* What splitting can be told. */
typedef struct options {
    iso_separatrix_request study;
    shell_options shell;
} options;

/* --- the table -------------------------------------------------------------------------------------------------- */

/* The axes are those of each row that did not fail; NULL: all did. */
static const iso_separatrix_splitting *first_good(const iso_separatrix_table *s)
{
    for (size_t i = 0; i < s->rows; i++)
        if (s->row[i].status == ISO_OK) return &s->row[i];
    return NULL;
}

/* What differs from row to row. */
static double number_of(const iso_separatrix_splitting *s, bool by_level)
{
    return by_level ? s->level : s->k;
}

static void print_head(const double J[3], const iso_separatrix_splitting *row, bool by_level)
{
    say("J = %s %s %s\n", ISO_ROUNDED(J[0], 15), ISO_ROUNDED(J[1], 15), ISO_ROUNDED(J[2], 15));
    if (!row) return;
    if (by_level) say("k = %s\n", ISO_ROUNDED(row->k, 15));
    if (!by_level && row->level != 0) say("level of the point, (H/eps) J2^(1/k): %s\n", ISO_ROUNDED(row->level, 15));
    say("The unstable manifold of the rotation about axis %d meets l = pi/2 on the section n_%d = 0 at x, "
        "with the slope m. The stable one has -m: they are one curve only if m = 0.\n\n",
        row->middle + 1, row->axis + 1);
}

/* Digits behind the point of the slope, until its error. */
static int digits_of(const iso_separatrix_splitting *s)
{
    return (int)fmax(1, fmin(16, ceil(log10(fabs(s->m) / s->error))));
}

static void print_row(const iso_separatrix_splitting *s, bool by_level)
{
    const double at = number_of(s, by_level);
    if (s->status == ISO_STOPPED) return;
    if (s->status != ISO_OK) {
        say("%.15g\t%s\n", at, s->words);
        return;
    }
    say("%.15g\t%.8g\t%.16g\t", at, s->lambda, s->x);
    if (s->from_zero)
        say("%.*e\t%.1e\t%d\t\n", digits_of(s), s->m, s->error, s->digits);
    else if (fabs(s->m) > s->error)
        say("%.*e\t%.1e\t%d\tundecided: less than 100 errors from 0\n", digits_of(s), s->m, s->error, s->digits);
    else /* 1.05: rounding of the bound to two digits must not make it smaller */
        say("0\t%.1e\t%d\tnot distinguishable from 0: below %.1e\n", s->error, s->digits,
            1.05 * (fabs(s->m) + s->error));
    if (s->words[0]) say("\t%s\n", s->words);
}

static void print_zero(const iso_separatrix_splitting *s, bool by_level)
{
    say("\nm = 0 at %s = %.15g +- %.1e, where the manifolds touch at x = %.15g.\n", by_level ? "level" : "k",
        number_of(s, by_level), by_level ? s->level_error : s->k_error, s->x);
    if (isfinite(s->next_m))
        say("On the section n_%d = 0 they meet next at l = %.12g, x = %.12g, "
            "and there with slopes %.6e above and below their mean: %s.",
            s->section + 1, s->next_l, s->next_x, fabs(s->next_m),
            fabs(s->next_m) > 100 * fmax(s->error, fabs(s->m)) ? "they cross there"
                                                               : "too small for these digits, undecided");
    say("\n");
}

static void print_table(const shell *s)
{
    const iso_separatrix_table *t = s->result.found;
    const bool by_level = iso_separatrix_by_level(t);
    print_head(s->scene.params.J, first_good(t), by_level);
    say_table(1);
    say("%s\tmultiplier\tx\tm\terror\tdigits\tremark\n", by_level ? "level" : "k");
    for (size_t i = 0; i < t->rows; i++) print_row(&t->row[i], by_level);
    say_table_end();
    for (size_t i = 0; i < t->zeros; i++) print_zero(&t->zero[i], by_level);
}

static json_t *json(const shell *s)
{
    static const iso_field J[] = {ISO_MEMBER(iso_params, "J", J, "moment of inertia", "about the contact"),
                                  ISO_FIELD_END};
    json_t *o = json_of(J, &s->scene.params);
    json_add(o, s->result.fields, s->result.found);
    return o;
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

/* The row whose curves are best seen: |m| is about 1/30. */
static const iso_separatrix_splitting *clearest(const iso_separatrix_table *s)
{
    const iso_separatrix_splitting *best = NULL;
    double least = INFINITY;
    for (size_t i = 0; i < s->rows; i++) {
        const double apart = fabs(log(fmax(fabs(s->row[i].m), 1e-40) * 30));
        if (s->row[i].status == ISO_OK && apart < least) best = &s->row[i], least = apart;
    }
    return best;
}

/* As many half returns beyond the crossing as the lobes need to be seen: they grow like lambda^(1/2) each. */
static int halves_of(const iso_separatrix_splitting *s)
{
    const double needed = log(0.3 / fmax(fabs(s->section_m), 1e-4)) / (log(s->lambda) / 2);
    return (int)fmin(fmax(needed, 2) + 2, 60);
}

static iso_status describe(shell *s)
{
    const iso_separatrix_table *t = s->result.found;
    const iso_separatrix_splitting *at = clearest(t);
    const double *J = s->scene.params.J;
    const bool by_level = iso_separatrix_by_level(t);
    char k[ISO_PICTURE_FRACTION + 8] = "", level[32] = "", number[ISO_PICTURE_FRACTION];
    if (at && (by_level || t->rows == 1)) snprintf(k, sizeof k, "k = %s, ", iso_picture_fraction(number, at->k));
    if (at && !by_level && at->level != 0) snprintf(level, sizeof level, ", level %.6g", at->level);
    snprintf(s->title, sizeof s->title, "Splitting of the separatrix        %sJ = (%.6g, %.6g, %.6g)%s", k, J[0],
             J[1], J[2], level);
    return shell_lines(s, (const table_line[]){{.key = "title", .text = s->title}, {.key = NULL}});
}

/* |m| over k or the level, where there are several rows, and both curves of one of them. */
static int draw(const shell *s)
{
    const iso_separatrix_table *t = s->result.found;
    const iso_separatrix_splitting *at = clearest(t);
    iso_record *curve = NULL;
    char at_number[ISO_PICTURE_FRACTION + 16], number[ISO_PICTURE_FRACTION];
    const bool by_level = iso_separatrix_by_level(t);
    if (interrupted()) return EXIT_DONE;
    iso_status status = iso_separatrix_curve(s->ctx, at->k, s->scene.params.J, at->level, halves_of(at), &curve);
    snprintf(at_number, sizeof at_number, "%s = %s", by_level ? "level" : "k",
             iso_picture_fraction(number, number_of(at, by_level)));
    if (status == ISO_OK) {
        iso_record_set_kind(curve, "separatrix");
        status = iso_record_set(s->ctx, curve, "at", at_number);
    }
    if (status == ISO_OK) status = iso_record_set_numbers(s->ctx, curve, "axis", 1, (double[]){at->section + 1});
    if (status == ISO_OK)
        status = plot_tables(s->ctx, &s->told->plot, (const iso_record *[]){s->result.table[0], curve, NULL}, NULL);
    iso_record_free(curve);
    return finish(s->ctx, status);
}

/* --- the command ------------------------------------------------------------------------------------------------ */

static int run(iso_context *ctx, const void *options_given)
{
    static const shell_parts parts = {.study = &iso_splitting_study,
                                      .kind = "splitting",
                                      .stopped = "only rows that are done are shown",
                                      .json = json,
                                      .print = print_table,
                                      .describe = describe,
                                      .draw = draw};
    return shell_run(ctx, &parts, options_given, &((const options *)options_given)->shell);
}

static const options defaults = {.shell = {.file = "-"}};

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_splitting_option),
    ROW_OUTPUT(options, shell.table),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_splitting = {
    COMMAND_OF_STUDY(splitting, "SCENE", shell.file),
    .takes = FILE_SCENE,
    .description =
        "The rotation about the middle axis is unstable. On the section n_a = 0, a the axis after the middle one, "
        "it is a point (l, x); l and x are those of isoroll section. One curve leaves it: the orbits that come "
        "from this rotation. Another one enters its mirror: the orbits that end in the opposite rotation. If there "
        "is an additional analytic integral, both are one curve. If they cross, there is none. This command follows "
        "the curve that leaves to its first point with l = pi/2. It finds x = M_a/|M| there, and the slope m = "
        "dx/dl; the other curve has the slope -m. So m = 0 at k = 1 and k = -1, on every level. Where m is not 0, "
        "the curves cross. The command shows this numerically, with an estimated error; it does not prove that "
        "there is no additional analytic integral.\n\n"
        "Each m has its error, from a second computation. m falls very fast with |k|: where 64 bits do not "
        "distinguish it from 0, 128 bits are taken, which need from seconds to a minute for each k. Other zeros of "
        "m between two values of k or the level are located. There the curves touch at one point. The slope at the "
        "next common point is printed: if it is not 0, they cross there. Where the multiplier of the rotation is "
        "below 1.02, as between nearly equal moments, m is too small for 128 bits and not computed.\n\n"
        "The level is (H/eps) J2^(1/k), J2 the middle moment, H the energy of the point: a number without a unit. "
        "It is 0 for the free ball, and another number for a point off H = 0 and for a ball with the effect "
        "'level'. --level takes other levels than the scene's. On a low level there is no such rotation: the point "
        "oscillates between two places of rest instead.\n\n"
        "Only k, J and the level of the scene are read. Nothing else of its start matters, nor do its times. -o "
        "FILE writes one row for each k or level. --plot draws |m| over k or the level, and both curves where they "
        "are seen best. After Ctrl-C the rows that are done are printed.",
    .example = "isoroll splitting scene.yaml --k 0.25:3:0.25 --plot splitting.png",
    .exits = "1: interrupted, or some rows failed\n"
             "3: bad input: an effect that acts, other than 'level', equal or nearly equal moments, or a level "
             "without the rotation\n"
             "4: the computation failed, or no memory",
};

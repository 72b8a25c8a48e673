/* isoroll splitting - how far the separatrix of the middle axis' rotation splits: why only k = 1 and k = -1. */
#include <math.h>

#include "command.h"
#include "instrument/separatrix/separatrix.h"
#include "picture/picture_impl.h"
#include "plot/draw.h"

OPTIONS_OF_SCENE(iso_separatrix_request);

static json_t *json(const shell *s)
{
    static const iso_field J[] = {ISO_MEMBER(iso_params, "J", J, "moment of inertia", "about the contact"),
                                  ISO_FIELD_END};
    json_t *o = json_of(J, &s->scene.params);
    json_add(o, s->result.fields, s->result.found);
    return o;
}

/* |m| over k or the level, where there are several rows, and both curves of one of them. */
static int draw(const shell *s)
{
    const iso_separatrix_table *t = s->result.found;
    const iso_separatrix_splitting *at = iso_separatrix_clearest(t);
    iso_record *curve = NULL;
    char at_number[ISO_FRACTION_SIZE + 16], number[ISO_FRACTION_SIZE];
    const bool by_level = t->by_level;
    if (interrupted()) return EXIT_DONE;
    iso_status status =
        iso_picture_separatrix(s->ctx, at->k, s->scene.params.J, at->level, at->section_m, at->lambda, &curve);
    snprintf(at_number, sizeof at_number, "%s = %s", by_level ? "level" : "k",
             iso_fraction_text(number, by_level ? at->level : at->k));
    if (status == ISO_OK) {
        iso_record_set_kind(curve, "separatrix");
        status = iso_record_set(s->ctx, curve, "at", at_number);
    }
    if (status == ISO_OK) status = iso_record_set_numbers(s->ctx, curve, "axis", 1, (double[]){at->section + 1});
    if (status == ISO_OK)
        status = plot_tables(s->ctx, &s->common->plot, (const iso_record *[]){s->result.table[0], curve, NULL}, NULL);
    iso_record_free(curve);
    return finish(s->ctx, status);
}

static const option_row rows[] = {
    ROWS_OF_STUDY(iso_splitting_option),
    ROW_OUTPUT(options, shell.table),
    ROWS_OF_PLOT(options, shell.plot),
    ROW_JSON(options, shell.json),
    ROW_END,
};

const command command_splitting = {
    COMMAND_OF_SCENE(splitting),
    .parts = {.kind = "splitting", .stopped = "only rows that are done are shown", .json = json, .draw = draw},
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

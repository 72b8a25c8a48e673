/* section.c - the kinds "section" and "periodic": crossings on both charts (see section_impl.h).
 *
 * With a section may be given: a second "section", the same crossings by the point; "chaos", whose starts are first
 * crossings of the section's orbits: their verdicts; "periodic" and "splitting", which are drawn over it.
 */
#include <math.h>
#include <stdio.h>

#include "orbit/description.h"
#include "picture/section_impl.h"

/* The verdict of a row of chaos. */
static iso_verdict verdict_of(const iso_record *chaos, size_t i)
{
    const iso_verdict all[] = {ISO_REGULAR, ISO_CHAOTIC, ISO_INTEGRABLE};
    for (int v = 0; v < 3; v++)
        if (iso_picture_is(chaos, i, "verdict", iso_verdict_name(all[v]))) return all[v];
    return ISO_UNDECIDED;
}

static iso_status put_rows(iso_context *ctx, const iso_picture_request *q, iso_picture_points *p)
{
    const iso_record *r = q->table[0], *point = iso_picture_given(q, "section"),
                     *chaos = iso_picture_given(q, "chaos");
    const bool pairs = point && iso_record_rows(point) == iso_record_rows(r) && iso_record_find(r, "l") >= 0;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        ISO_TRY(iso_picture_points_row(ctx, p, iso_record_const_row(r, i)));
        if (!pairs) continue;
        ISO_TRY(iso_picture_points_pair(
            ctx, p, (double[]){iso_picture_number(r, i, "l"), iso_picture_number(r, i, "x")},
            (double[]){iso_picture_number(point, i, "l"), iso_picture_number(point, i, "x")}));
    }
    for (size_t i = 0; chaos && i < iso_record_rows(chaos); i++)
        ISO_TRY(iso_picture_points_judge(ctx, p, iso_picture_number(chaos, i, "l"), iso_picture_number(chaos, i, "x"),
                                         verdict_of(chaos, i)));
    return ISO_OK;
}

static iso_status make_section(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    iso_picture_points *p = NULL;
    iso_status status = iso_picture_points_create(ctx, q->table[0], &p);
    if (status == ISO_OK) status = put_rows(ctx, q, p);
    if (status == ISO_OK) status = iso_picture_points_make(ctx, p, q->table + 1, q->options, picture);
    iso_picture_points_free(p);
    return status;
}

/* --- periodic orbits -------------------------------------------------------------------------------------------- */

/* The hues of successive orbits differ by the golden section of the circle. The first is a strong blue. */
static double hue_of(double orbit)
{
    return fmod(0.6 + (orbit - 1) * 0.61803398874989485, 1);
}

/* All crossings with their images by the reversors and by half turns. */
static iso_status put_orbits(iso_context *ctx, const iso_record *r, iso_record *crossings)
{
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double l = iso_picture_number(r, i, "l"), x = iso_picture_number(r, i, "x");
        const bool grey =
            iso_picture_is(r, i, "stability", "unstable") || iso_picture_is(r, i, "stability", "inverse");
        const double row[] = {l,
                              x,
                              l,
                              x,
                              grey ? ISO_PICTURE_GREY : ISO_PICTURE_COLOURED,
                              grey ? 0 : hue_of(iso_picture_number(r, i, "orbit")),
                              0xFF};
        ISO_TRY(iso_record_add(ctx, crossings, 1, row));
    }
    return ISO_OK;
}

static iso_status make_periodic(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    char title[ISO_PICTURE_TITLE];
    const iso_record *r = q->table[0];
    iso_record *crossings = NULL;
    iso_picture_charts c = {.axis = iso_picture_axis(r), .few = true};
    ISO_TRY(iso_record_params(ctx, r, &c.params));
    picture->layout = "section";
    iso_status status = iso_record_create(ctx, ISO_PICTURE_COLUMNS, iso_picture_crossing_names, &crossings);
    if (status == ISO_OK) status = put_orbits(ctx, r, crossings);
    if (status == ISO_OK) status = iso_picture_charts_put(ctx, &c, crossings, picture);
    iso_record_free(crossings);
    ISO_TRY(status);
    /* a file has one crossing of each orbit */
    snprintf(title, sizeof title, "%s%s", q->title,
             iso_record_get(r, "title") ? "" : ": a crossing of each orbit, its images");
    ISO_TRY(iso_picture_say(ctx, picture, "title", title));
    ISO_TRY(iso_picture_say(ctx, picture, "grey_means", "unstable; each stable orbit has a colour"));
    ISO_TRY(iso_picture_say(ctx, picture, "dark_means", ""));
    return iso_picture_over(ctx, &c, NULL, picture);
}

const iso_picture_maker iso_picture_section = {"section",    "Poincaré section",           {"orbit", "l", "x"},
                                               .axis = true, .options = " window points ", .make = make_section};
const iso_picture_maker iso_picture_periodic = {
    "periodic", "Periodic orbits", {"orbit", "l", "x", "stability"}, .axis = true, .make = make_periodic};

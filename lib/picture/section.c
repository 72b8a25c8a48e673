/* section.c - the kinds "section" and "periodic": crossings on both charts (see section_impl.h).
 *
 * With a section may be given: a second "section", the same crossings by the point; "chaos", whose starts are first
 * crossings of the section's orbits: their verdicts; "periodic" and "splitting", which are drawn over it.
 */
#include <math.h>

#include "orbit/description.h"
#include "picture/section_impl.h"

static iso_status add_rows(iso_context *ctx, const iso_picture_request *q, iso_picture_points *p)
{
    const iso_record *r = q->table[0], *point = iso_picture_given(q, "section"),
                     *chaos = iso_picture_given(q, "chaos");
    const bool pairs = point && iso_record_rows(point) == iso_record_rows(r) && iso_record_find(r, "l") >= 0;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        ISO_TRY(iso_picture_points_row(ctx, p, iso_record_const_row(r, i)));
        if (pairs)
            iso_picture_points_pair(p, (double[]){iso_picture_number(r, i, "l"), iso_picture_number(r, i, "x")},
                                    (double[]){iso_picture_number(point, i, "l"), iso_picture_number(point, i, "x")});
    }
    for (size_t i = 0; chaos && i < iso_record_rows(chaos); i++)
        iso_picture_points_verdict(p, iso_picture_number(chaos, i, "l"), iso_picture_number(chaos, i, "x"),
                                   iso_record_word(chaos, iso_picture_number(chaos, i, "verdict")));
    return ISO_OK;
}

static iso_status make_section(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    iso_picture_points *p = NULL;
    iso_status status = iso_picture_points_create(ctx, q->table[0], &p);
    if (status == ISO_OK) status = add_rows(ctx, q, p);
    if (status == ISO_OK) status = iso_picture_points_make(ctx, p, q->table + 1, q->options, picture);
    iso_picture_points_free(p);
    return status;
}

/* Each crossing of periodic orbits is drawn with its images by the reversors and by half turns. The hues of successive
 * orbits differ by the golden section of the circle. The first is a strong blue. */
static iso_status make_periodic(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    char ball[ISO_BALL_SIZE];
    const iso_record *r = q->table[0];
    iso_record **crossings = iso_picture_aside(picture);
    iso_picture_charts c = {.axis = iso_picture_axis(r), .few = true};
    ISO_TRY(iso_record_params(ctx, r, &c.params));
    picture->layout = "section";
    ISO_TRY(iso_record_create(ctx, ISO_PICTURE_COLUMNS, iso_picture_crossing_names, crossings));
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double l = iso_picture_number(r, i, "l"), x = iso_picture_number(r, i, "x"),
                     hue = fmod(0.6 + (iso_picture_number(r, i, "orbit") - 1) * 0.61803398874989485, 1);
        const bool grey =
            iso_picture_is(r, i, "stability", "unstable") || iso_picture_is(r, i, "stability", "inverse");
        const double shade = grey ? ISO_PICTURE_GREY : ISO_PICTURE_COLOURED, colour = grey ? 0 : hue;
        ISO_TRY(iso_record_add(ctx, *crossings, 1, (double[]){l, x, l, x, shade, colour, 0xFF}));
    }
    ISO_TRY(iso_picture_charts_add(ctx, &c, *crossings, picture));
    if (!iso_record_get(r, "title")) /* a file has one crossing of each orbit */
        ISO_TRY(iso_picture_say(ctx, picture, "title", ISO_PICTURE_TITLE ": a crossing of each orbit, its images",
                                "Periodic orbits", iso_ball_text(ball, &c.params)));
    ISO_TRY(iso_picture_say(ctx, picture, "grey_means", "unstable; each stable orbit has a colour"));
    ISO_TRY(iso_picture_say(ctx, picture, "dark_means", "%s", ""));
    return iso_picture_over(ctx, &c, NULL, picture);
}

const iso_picture_maker iso_picture_section = {"section",    "Poincaré section",           {"orbit", "l", "x"},
                                               .axis = true, .options = " window points ", .make = make_section};
const iso_picture_maker iso_picture_periodic = {
    "periodic", "Periodic orbits", {"orbit", "l", "x", "stability"}, .axis = true, .make = make_periodic};

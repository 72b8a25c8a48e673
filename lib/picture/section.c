/* section.c - the kinds "section" and "periodic": crossings on both charts, and what is drawn over them: periodic orbits,
 * and the manifolds of the middle axis' rotation (see section_impl.h).
 *
 * With a section may be given: a second "section", the same crossings by the point; "chaos", whose starts are first
 * crossings of the section's orbits: their verdicts; "periodic" and "splitting", which are drawn over it.
 */
#include <math.h>
#include <string.h>

#include "instrument/separatrix/separatrix.h"
#include "map/section_impl.h"
#include "orbit/description.h"
#include "picture/section_impl.h"

/* --- over a section --------------------------------------------------------------------------------------------- */

/* The tables of both sides, the ball's first. */
typedef struct over {
    const iso_picture_charts *charts;
    iso_record *orbits[2], *curve[2][2]; /* curve: leaves, enters */
    bool stable[2];                      /* there are unstable ones, stable ones */
} over;

static bool is_near(double a, double b)
{
    return fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b));
}

/* A table that was read has a line with the name of its file. */
static iso_status refuse(iso_context *ctx, const iso_record *table, const char *why)
{
    const char *file = iso_record_get(table, "file");
    return ISO_FAIL_INPUT(ctx, "over", "over the section '%s': %s", file ? file : iso_record_kind(table), why);
}

static iso_status check_moments(iso_context *ctx, const iso_record *table, const iso_params *wanted, bool k)
{
    iso_params p;
    ISO_TRY(iso_record_params(ctx, table, &p));
    bool same = !k || is_near(p.k, wanted->k);
    for (int i = 0; i < 3; i++) same = same && is_near(p.J[i], wanted->J[i]);
    return same ? ISO_OK : refuse(ctx, table, "it has other k or J than the section");
}

static iso_status add_orbits(iso_context *ctx, over *o, const iso_record *table)
{
    ISO_TRY(check_moments(ctx, table, &o->charts->params, true));
    if (iso_picture_axis(table) != o->charts->axis) return refuse(ctx, table, "its section is about another axis");
    for (size_t i = 0; i < iso_record_rows(table); i++) {
        const bool stable = iso_picture_is(table, i, "stability", "stable");
        o->stable[stable] = true;
        for (int n = 0; n < 16; n++) {
            double at[2];
            iso_picture_image(n / 2, iso_picture_number(table, i, "l"), iso_picture_number(table, i, "x"), at);
            const iso_picture_spot s = iso_picture_place(o->charts, n % 2 == 0, at[0], at[1]);
            if (!isfinite(s.right) || !isfinite(s.up)) continue;
            ISO_TRY(iso_record_add(ctx, o->orbits[n % 2], 1, (double[]){s.right, s.up, stable}));
            if (fabs(s.right) > M_PI - 1e-9) /* on the other edge, too */
                ISO_TRY(iso_record_add(ctx, o->orbits[n % 2], 1, (double[]){-s.right, s.up, stable}));
        }
    }
    return ISO_OK;
}

/* All images of the curve on both sides. An image by one of the reversors enters where the curve leaves: it turns the
 * section over. A row of NaN is a gap of the line. */
static iso_status add_curve(iso_context *ctx, const over *o, const iso_record *curve, double corner)
{
    for (int n = 0; n < 16; n++) {
        iso_record *to = o->curve[n / 8][(n & 1) != (n >> 2 & 1)];
        double last = INFINITY, at[2];
        for (size_t i = 0; i < iso_record_rows(curve); i++) {
            iso_picture_image(n % 8, iso_picture_at(curve, i, 0) + corner, iso_picture_at(curve, i, 1), at);
            const iso_picture_spot s = iso_picture_place(o->charts, n < 8, at[0], at[1]);
            if (!isfinite(s.right) || !isfinite(s.up)) continue;
            if (fabs(s.right - last) > M_PI) ISO_TRY(iso_record_add(ctx, to, 1, (double[]){NAN, NAN}));
            ISO_TRY(iso_record_add(ctx, to, 1, (double[]){s.right, s.up}));
            last = s.right;
        }
    }
    return ISO_OK;
}

/* The lobes grow like lambda^(1/2) with each half return. */
iso_status iso_picture_separatrix(iso_context *ctx, double k, const double J[3], double level, double m,
                                  double lambda, iso_record **curve)
{
    const double needed = log(0.3 / fmax(fabs(m), 1e-4)) / (log(lambda) / 2);
    return iso_separatrix_curve(ctx, k, J, level, (int)fmin(fmax(needed, 2) + 2, 60), curve);
}

/* The row of the section's k and level; its curves are computed anew, which takes less than a second. */
static iso_status add_manifolds(iso_context *ctx, const over *o, const iso_record *table)
{
    const iso_picture_charts *charts = o->charts;
    const iso_params *p = &charts->params;
    const int axis = iso_section_axis((iso_point_motion){p, charts->eps, charts->energy});
    const double level = iso_level_of(p, charts->energy / charts->eps);
    size_t i = 0;
    ISO_TRY(check_moments(ctx, table, p, false));
    while (i < iso_record_rows(table) && !(is_near(iso_picture_number(table, i, "k"), p->k) &&
                                           fabs(iso_picture_number(table, i, "level") - level) <= 1e-12))
        i++;
    if (i == iso_record_rows(table)) return refuse(ctx, table, "no row has the k and the level of the section");
    if (axis != charts->axis) return refuse(ctx, table, "its section is about another axis");
    /* l of the rotation about the middle axis. The section is about the axis of the largest moment if k > 0, else of
     * the smallest: of the other two axes b and c the middle one is nearer to it. */
    const double b = p->J[(axis + 1) % 3], c = p->J[(axis + 2) % 3];
    const double corner = (p->k > 0 ? c > b : c < b) ? 0 : M_PI / 2;
    iso_record *curve = NULL;
    iso_status status = iso_picture_separatrix(ctx, p->k, p->J, level, iso_picture_number(table, i, "m"),
                                               iso_picture_number(table, i, "multiplier"), &curve);
    if (status == ISO_OK) status = add_curve(ctx, o, curve, corner);
    iso_record_free(curve);
    return status;
}

iso_status iso_picture_over(iso_context *ctx, const iso_picture_charts *c, const iso_record *const table[],
                            iso_picture *picture)
{
    static const char *const names[2][3] = {{"ball_orbits", "ball_leaves", "ball_enters"},
                                            {"point_orbits", "point_leaves", "point_enters"}};
    over o = {.charts = c};
    for (int side = 0; side < 2; side++) {
        ISO_TRY(iso_picture_add(ctx, picture, names[side][0], "right up stable", &o.orbits[side]));
        for (int enters = 0; enters < 2; enters++)
            ISO_TRY(iso_picture_add(ctx, picture, names[side][1 + enters], "right up", &o.curve[side][enters]));
    }
    for (; table && *table; table++) {
        const bool orbits = strcmp(iso_record_kind(*table), "periodic") == 0;
        if (!orbits && strcmp(iso_record_kind(*table), "splitting") != 0) continue;
        if (!c->alone) return refuse(ctx, *table, "the section must be of a free ball, or of one on a level");
        ISO_TRY(orbits ? add_orbits(ctx, &o, *table) : add_manifolds(ctx, &o, *table));
    }
    return iso_picture_set(ctx, picture, "stable unstable curves",
                           (double[]){o.stable[true], o.stable[false], iso_record_rows(o.curve[0][0]) > 0});
}

/* --- the kinds --------------------------------------------------------------------------------------------------- */

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
        ISO_TRY(iso_picture_line(ctx, picture, "title", ISO_PICTURE_TITLE ": a crossing of each orbit, its images",
                                 "Periodic orbits", iso_ball_text(ball, &c.params)));
    ISO_TRY(iso_picture_line(ctx, picture, "grey_means", "unstable; each stable orbit has a colour"));
    ISO_TRY(iso_picture_line(ctx, picture, "dark_means", "%s", ""));
    return iso_picture_over(ctx, &c, NULL, picture);
}

const iso_picture_maker iso_picture_section = {"section",    "Poincaré section",           {"orbit", "l", "x"},
                                               .axis = true, .options = " window points ", .make = make_section};
const iso_picture_maker iso_picture_periodic = {
    "periodic", "Periodic orbits", {"orbit", "l", "x", "stability"}, .axis = true, .make = make_periodic};

/* sweep.c - the result of a sweep: a value over one number that varies as a curve, over two as maps.
 *
 * Layout "sweep_curve": curve (at, value, low, high: a band; by growing `at`, a gap where there is no value and at
 * k = 0, where there is no ball) and marks. Lines: over, value: names; error: what the band is, "" if there is none.
 * Layout "sweep_map": cells (see maps_impl.h; of `missing` ones there is no value), maps (name) and marks. Lines:
 * x, y, value: names of axes; low, high: the range of colours; logarithmic_y; missing: whether a value is.
 * Both: marks (axis: 1: x, 2: y; at): k = 1 and k = -1, where the free ball is integrable. Lines: sizes: |value| is
 * drawn, on a logarithmic axis; logarithmic_x.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/names_impl.h"
#include "picture/maps_impl.h"

enum { SUGGESTED = 64, AXES = 64, NAME = 64, MAPS = 6 };

/* The rows of a result, and which columns are drawn. */
typedef struct swept {
    const iso_record *r;
    int axis[AXES], axes; /* those that vary, and differ from row to row */
    int value, low, high; /* -1: there is none; low -1: high is an error +- */
    char text[2 * NAME];  /* what the value is */
} swept;

/* --- the columns ------------------------------------------------------------------------------------------------ */

/* A column, what it is, and those of its error. */
static const struct {
    const char *value, *text, *low, *high; /* low NULL: high is an error +- */
} known[] = {{"chaos_share", "chaotic share of the section", "chaos_share_low", "chaos_share_high"},
             {"splitting_m", "slope m of the splitting", NULL, "splitting_error"},
             {"splitting_x", "place x of the splitting", NULL, "splitting_x_error"},
             {"frequencies_f1_t", "frequency 1, in t", NULL, "frequencies_f1_error"},
             {"frequencies_f2_t", "frequency 2, in t", NULL, "frequencies_f2_error"},
             {"frequencies_ratio", "frequency ratio", NULL, NULL},
             {"frequencies_rotation", "frequency ratio", NULL, NULL}, /* of 0.3 and before */
             {"rotations_trace1", "trace of the rotation about axis 1", NULL, "rotations_error1"},
             {"rotations_trace2", "trace of the rotation about axis 2", NULL, "rotations_error2"},
             {"rotations_trace3", "trace of the rotation about axis 3", NULL, "rotations_error3"},
             {"backends_largest", "largest difference of the computations", NULL, NULL},
             {"contact_time", "time at which contact is lost", NULL, NULL}};
enum { KNOWN = sizeof known / sizeof *known };

/* What varies, where its name does not say it. */
static const char *axis_text(const swept *s, int column)
{
    static const char *const texts[][2] = {{"level", "level H of the point, in ε J₂^(−1/k)"},
                                           {"l", "place l of the start on the section, in rad"},
                                           {"x", "place x of the start on the section"}};
    const char *name = iso_record_name(s->r, (size_t)column);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (strcmp(texts[i][0], name) == 0) return texts[i][1];
    return iso_picture_symbol(name);
}

static bool is_k(const swept *s, int column)
{
    return strcmp(iso_record_name(s->r, (size_t)column), "k") == 0;
}

static int find(const swept *s, const char *name)
{
    return name ? iso_record_find(s->r, name) : -1;
}

/* The group of a column and its name in it: the line "names" has "vary/k chaos/share" of all but the number of the
 * point, in older files the line "columns". False: of the point, its status and its reason. */
static bool group_of(const swept *s, int column, char group[static NAME], char name[static NAME])
{
    const char *text = iso_record_get(s->r, iso_record_get(s->r, "names") ? "names" : "columns");
    for (int c = 1; text && c < column; c++) text = strchr(text, ' ') ? strchr(text, ' ') + 1 : NULL;
    return column > 0 && text && sscanf(text, "%63[^/ ]/%63[^ ]", group, name) == 2;
}

static bool varies(const swept *s, int column)
{
    char group[NAME], name[NAME];
    return group_of(s, column, group, name) && strcmp(group, "vary") == 0;
}

/* The column that is wanted, else the first that is known, else the last that was measured; what it is, and which
 * columns are its error. */
static iso_status choose_value(iso_context *ctx, const char *wanted, swept *s)
{
    char group[NAME], name[NAME], suggested[ISO_SUGGEST_SIZE];
    const char *names[SUGGESTED];
    size_t count = 0;
    s->value = find(s, wanted);
    for (int c = 1; c < (int)iso_record_columns(s->r) && count < SUGGESTED; c++)
        if (group_of(s, c, group, name)) names[count++] = iso_record_name(s->r, (size_t)c);
    if (wanted && !group_of(s, s->value, group, name))
        return ISO_FAIL_INPUT(ctx, "value", "--value %s: there is no such column; %s", wanted,
                              iso_suggest(suggested, wanted, count, names));
    for (size_t i = 0; i < KNOWN && s->value < 0; i++) s->value = find(s, known[i].value);
    for (int c = 0; c < (int)iso_record_columns(s->r) && s->value < 0; c++) {
        if (!group_of(s, c, group, name)) continue;
        const bool clock = strcmp(group, "state") == 0 && strcmp(name, "t") == 0; /* it is often constant */
        if (strcmp(group, "vary") != 0 && !clock) s->value = c;
    }
    if (s->value < 0) return ISO_FAIL_INPUT(ctx, "value", "nothing was measured");
    if (varies(s, s->value))
        return ISO_FAIL_INPUT(ctx, "value", "--value %s: it varies: name one that was measured", wanted);
    if (group_of(s, s->value, group, name))
        snprintf(s->text, sizeof s->text, "%.60s: %.60s", group, iso_picture_symbol(name));
    for (size_t i = 0; i < KNOWN; i++) {
        if (find(s, known[i].value) != s->value) continue;
        snprintf(s->text, sizeof s->text, "%s", known[i].text);
        s->low = find(s, known[i].low), s->high = find(s, known[i].high);
    }
    return ISO_OK;
}

/* --- what both share -------------------------------------------------------------------------------------------- */

/* k = 1 and k = -1, if they are on this axis. */
static iso_status add_marks(iso_context *ctx, const iso_picture_scale *scale, int axis, iso_record *marks)
{
    for (int k = -1; k <= 1 && scale->k && scale->count > 0; k += 2)
        if (k >= scale->at[0] && k <= scale->at[scale->count - 1])
            ISO_TRY(iso_record_add(ctx, marks, 1, (double[]){axis, k}));
    return ISO_OK;
}

static iso_status set_value(iso_context *ctx, iso_picture *picture, const swept *s, bool sizes)
{
    ISO_TRY(iso_picture_set(ctx, picture, "sizes", (double[]){sizes}));
    return iso_picture_line(ctx, picture, "value", sizes ? "|%s|" : "%s", s->text);
}

/* of: the number of which they are values; NULL: points. */
static iso_status set_title(iso_context *ctx, iso_picture *picture, const swept *s, const char *of)
{
    if (iso_record_get(s->r, "title")) return ISO_OK;
    return iso_picture_line(ctx, picture, "title", "A sweep of %zu %s%s", iso_record_rows(s->r),
                            of ? "values of " : "points", of ? of : "");
}

/* --- one number varies ------------------------------------------------------------------------------------------ */

/* Where it is, the value, and its band. With sizes the band may not reach 0. False: there is no value. */
static bool find_point(const swept *s, size_t i, bool sizes, double row[4])
{
    const double value = iso_picture_at(s->r, i, s->value),
                 high = s->high < 0 ? (double)NAN : iso_picture_at(s->r, i, s->high);
    row[0] = iso_picture_at(s->r, i, s->axis[0]), row[1] = value;
    row[3] = s->low < 0 ? value + high : high;
    row[2] = s->low < 0 ? value - high : iso_picture_at(s->r, i, s->low);
    if (sizes) {
        const double error = (row[3] - row[2]) / 2;
        row[1] = fabs(value);
        row[2] = fmax(row[1] - error, row[1] / 1e3);
        row[3] = row[1] + error;
    }
    if (!isfinite(row[2]) || !isfinite(row[3])) row[2] = row[3] = row[1];
    return isfinite(value) && !(sizes && value == 0);
}

/* By growing numbers; *band: whether a value has one. */
static iso_status fill_curve(iso_context *ctx, const swept *s, bool sizes, bool k, iso_record *all, iso_record *curve,
                             bool *band)
{
    static const double gap[] = {NAN, NAN, NAN, NAN};
    for (size_t i = 0; i < iso_record_rows(s->r); i++) {
        double row[4];
        if (!find_point(s, i, sizes, row)) row[1] = NAN;
        ISO_TRY(iso_record_add(ctx, all, 1, row));
    }
    qsort(iso_record_row(all, 0), iso_record_rows(all), 4 * sizeof(double), iso_picture_by_size);
    for (size_t i = 0; i < iso_record_rows(all); i++) {
        const double *row = iso_record_const_row(all, i);
        if (k && i > 0 && iso_picture_at(all, i - 1, 0) < 0 && row[0] > 0)
            ISO_TRY(iso_record_add(ctx, curve, 1, gap));
        ISO_TRY(iso_record_add(ctx, curve, 1, isnan(row[1]) ? gap : row));
        *band = *band || (isfinite(row[1]) && row[3] > row[2]);
    }
    return ISO_OK;
}

static iso_status make_curve(iso_context *ctx, const swept *s, iso_picture *picture)
{
    const char *over = axis_text(s, s->axis[0]);
    iso_record *curve, *marks, **all = iso_picture_aside(picture);
    iso_picture_spread spread;
    iso_picture_scale x;
    bool band = false;
    picture->layout = "sweep_curve";
    ISO_TRY(iso_picture_add(ctx, picture, "curve", "at value low high", &curve));
    ISO_TRY(iso_picture_add(ctx, picture, "marks", "axis at", &marks));
    ISO_TRY(iso_record_create_like(ctx, curve, 0, NULL, all));
    ISO_TRY(iso_picture_spread_of(ctx, picture, s->r, s->value, &spread));
    ISO_TRY(iso_picture_scale_of(ctx, picture, s->r, s->axis[0], is_k(s, s->axis[0]), &x));
    ISO_TRY(fill_curve(ctx, s, spread.sizes, x.k, *all, curve, &band));
    ISO_TRY(add_marks(ctx, &x, 1, marks));
    ISO_TRY(iso_picture_set(ctx, picture, "logarithmic_x", (double[]){x.logarithmic}));
    ISO_TRY(set_value(ctx, picture, s, spread.sizes));
    ISO_TRY(iso_picture_line(ctx, picture, "over", "%s", over));
    ISO_TRY(iso_picture_line(ctx, picture, "error", "%s",
                             !band        ? ""
                             : s->low < 0 ? "± estimated error"
                                          : "95 % confidence, undecided orbits included"));
    return set_title(ctx, picture, s, over);
}

/* --- maps: more than one number varies -------------------------------------------------------------------------- */

/* What the axes of the maps are, and which column differs between them. */
typedef struct layout {
    int x, y, panel;       /* columns of the table; panel -1: one map */
    bool ratios, triangle; /* x and y come from J: J1/J3 and J2/J3, or places in the triangle of J */
    int J;
    const char *x_name, *y_name;
    double key[MAPS]; /* of each map, the number in `panel` */
    int maps;
} layout;

/* From a place in the triangle of J to J1/J3 and J2/J3; J3 is a third of the sum at least. Straight lines stay so. */
static void to_ratios(const double uv[2], double xy[2])
{
    const double c = fmax(uv[1] / sqrt(0.75), 0.2), b = uv[0] - c / 2, a = 1 - b - c;
    xy[0] = a / c, xy[1] = b / c;
}

static void keep(const double uv[2], double xy[2])
{
    xy[0] = uv[0], xy[1] = uv[1];
}

/* The place of a number in a list, to which it is added; -1: the list is full. */
static int place_in(double list[MAPS], int *count, double x)
{
    int i = 0;
    while (i < *count && list[i] != x) i++;
    if (i == MAPS) return -1;
    list[i] = x;
    if (i == *count) ++*count;
    return i;
}

/* The three moments are one point of a triangle. Of three other numbers that vary the one with the fewest values is
 * that of the maps. */
static iso_status choose_layout(iso_context *ctx, const swept *s, layout *l)
{
    int rest[AXES], others = 0, moments = 0, fewest = MAPS + 2;
    for (int i = 0; i < s->axes; i++) {
        const char *name = iso_record_name(s->r, (size_t)s->axis[i]);
        const bool moment = name[0] == 'J' && name[1] >= '1' && name[1] <= '3' && name[2] == '\0';
        if (moment && moments++ == 0) l->J = s->axis[i];
        if (!moment) rest[others++] = s->axis[i];
    }
    const bool triangle = moments == 3;
    const int left = triangle ? others : s->axes - 2;
    if (left < 0 || left > 1)
        return ISO_FAIL_INPUT(ctx, "", "%d numbers vary: a picture shows one, two, or three (J counts as two)",
                              s->axes);
    if (triangle) {
        if (left == 1) l->panel = rest[0];
        l->ratios = true;
        for (size_t i = 0; i < iso_record_rows(s->r); i++) {
            const double *J = iso_record_const_row(s->r, i) + l->J;
            l->ratios = l->ratios && J[0] <= J[1] && J[1] <= J[2];
        }
        l->triangle = !l->ratios;
        l->x_name = l->ratios ? "J₁/J₃" : "(J₂ + J₃/2)/(J₁ + J₂ + J₃)";
        l->y_name = l->ratios ? "J₂/J₃" : "(√3/2) J₃/(J₁ + J₂ + J₃)";
        return ISO_OK;
    }
    for (int i = 0; i < s->axes && left == 1; i++) {
        double seen[MAPS];
        int values = 0;
        for (size_t row = 0; values <= MAPS && row < iso_record_rows(s->r); row++)
            if (place_in(seen, &values, iso_picture_at(s->r, row, s->axis[i])) < 0) values = MAPS + 1;
        if (values < fewest) fewest = values, l->panel = s->axis[i];
    }
    l->x = s->axis[0] == l->panel ? s->axis[1] : s->axis[0];
    l->y = s->axis[s->axes - 1] == l->panel ? s->axis[s->axes - 2] : s->axis[s->axes - 1];
    l->x_name = axis_text(s, l->x);
    l->y_name = axis_text(s, l->y);
    return ISO_OK;
}

static iso_status collect(iso_context *ctx, const swept *s, layout *l, iso_record *points)
{
    for (size_t i = 0; i < iso_record_rows(s->r); i++) {
        const double *from = iso_record_const_row(s->r, i);
        const int map = place_in(l->key, &l->maps, l->panel < 0 ? 0 : from[l->panel]);
        double x = from[l->x], y = from[l->y], u = 0, v = 0;
        if (map < 0)
            return ISO_FAIL_INPUT(ctx, "", "more than %d values of '%s': a picture has no room", MAPS,
                                  axis_text(s, l->panel));
        if (l->ratios || l->triangle) {
            const double a = from[l->J], b = from[l->J + 1], c = from[l->J + 2], sum = a + b + c;
            u = (b + c / 2) / sum, v = c * sqrt(0.75) / sum;
            x = l->ratios ? a / c : u, y = l->ratios ? b / c : v;
        }
        if (isfinite(x) && isfinite(y))
            ISO_TRY(iso_record_add(ctx, points, 1, (double[]){map + 1, x, y, from[s->value], u, v}));
    }
    return ISO_OK;
}

/* One scale of colours for all maps. */
static iso_status set_colours(iso_context *ctx, iso_picture *picture, const iso_record *points,
                              const iso_picture_spread *s)
{
    double low = s->sizes ? s->least : s->low, high = s->sizes ? fmax(fabs(s->low), fabs(s->high)) : s->high;
    bool missing = false;
    if (!(low < high)) low = isfinite(low) ? low : 0, high = low + 1;
    for (size_t i = 0; i < iso_record_rows(points); i++) {
        const double value = iso_picture_at(points, i, ISO_POINT_VALUE);
        missing = missing || !isfinite(value) || (s->sizes && value == 0);
    }
    return iso_picture_set(ctx, picture, "low high missing", (double[]){low, high, missing});
}

static iso_status add_names(iso_context *ctx, const swept *s, const layout *l, iso_record *maps)
{
    char name[2 * NAME] = "", number[ISO_FRACTION_SIZE];
    for (int i = 0; i < l->maps; i++) {
        double word;
        if (l->panel >= 0)
            snprintf(name, sizeof name, "%s = %s", axis_text(s, l->panel), iso_fraction_text(number, l->key[i]));
        ISO_TRY(iso_record_intern(ctx, maps, name, &word));
        ISO_TRY(iso_record_add(ctx, maps, 1, &word));
    }
    return ISO_OK;
}

static iso_status make_maps(iso_context *ctx, const swept *s, iso_picture *picture)
{
    static const char *const point[] = {"map", "x", "y", "value", "u", "v"};
    layout l = {.panel = -1};
    iso_picture_maps m = {.points = NULL};
    iso_picture_spread spread;
    iso_record *cells, *maps, *marks, **points = iso_picture_aside(picture);
    picture->layout = "sweep_map";
    ISO_TRY(iso_picture_add(ctx, picture, "cells", "cell map missing value x y", &cells));
    ISO_TRY(iso_picture_add(ctx, picture, "maps", "name'", &maps));
    ISO_TRY(iso_picture_add(ctx, picture, "marks", "axis at", &marks));
    ISO_TRY(choose_layout(ctx, s, &l));
    ISO_TRY(iso_record_create(ctx, ISO_POINT_COLUMNS, point, points));
    ISO_TRY(collect(ctx, s, &l, *points));
    m.points = *points;
    m.count = l.maps;
    m.back = l.ratios ? to_ratios : l.triangle ? keep : NULL;
    ISO_TRY(iso_picture_scale_of(ctx, picture, *points, ISO_POINT_X, !m.back && is_k(s, l.x), &m.x));
    ISO_TRY(iso_picture_scale_of(ctx, picture, *points, ISO_POINT_Y, !m.back && is_k(s, l.y), &m.y));
    ISO_TRY(iso_picture_spread_of(ctx, picture, s->r, s->value, &spread));
    ISO_TRY(iso_picture_cells(ctx, &m, spread.sizes, cells));
    ISO_TRY(add_names(ctx, s, &l, maps));
    ISO_TRY(add_marks(ctx, &m.x, 1, marks));
    ISO_TRY(add_marks(ctx, &m.y, 2, marks));
    ISO_TRY(
        iso_picture_set(ctx, picture, "logarithmic_x logarithmic_y", (double[]){m.x.logarithmic, m.y.logarithmic}));
    ISO_TRY(set_value(ctx, picture, s, spread.sizes));
    ISO_TRY(set_colours(ctx, picture, *points, &spread));
    ISO_TRY(iso_picture_line(ctx, picture, "x", "%s", l.x_name));
    ISO_TRY(iso_picture_line(ctx, picture, "y", "%s", l.y_name));
    return set_title(ctx, picture, s, NULL);
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    char value[ISO_PICTURE_OPTION];
    swept s = {.r = q->table[0], .low = -1, .high = -1};
    ISO_TRY(choose_value(ctx, iso_picture_option(q, "value", value) ? value : NULL, &s));
    for (int c = 0; c < (int)iso_record_columns(s.r) && s.axes < AXES; c++) {
        bool differs = false;
        for (size_t i = 1, vary = varies(&s, c); vary && i < iso_record_rows(s.r) && !differs; i++)
            differs = iso_picture_at(s.r, i, c) != iso_picture_at(s.r, 0, c);
        if (differs) s.axis[s.axes++] = c;
    }
    if (s.axes == 0) return ISO_FAIL_INPUT(ctx, "", "nothing varies in this sweep");
    return s.axes == 1 ? make_curve(ctx, &s, picture) : make_maps(ctx, &s, picture);
}

static iso_status refuse(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    (void)q, (void)picture;
    return ISO_FAIL_INPUT(ctx, "", "a part of a sweep: merge the parts first");
}

const iso_picture_maker iso_picture_sweep = {"sweep", "A sweep", {"status"}, .options = " value ", .make = make},
                        iso_picture_sweep_part = {
                            "sweep part", "A part of a sweep", {"status"}, .options = " value ", .make = refuse};

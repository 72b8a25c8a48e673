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

#include "base/nearest_impl.h"
#include "picture/maps_impl.h"

enum { MOST_AXES = 64, SUGGESTED = 64, NAME = 64, MAPS = 6 };

/* The rows of a result, and which columns are drawn. */
typedef struct sweep {
    const iso_record *r;
    int axis[MOST_AXES], axes; /* those that vary, and differ from row to row */
    int value, low, high;      /* -1: there is none; low -1: high is an error +- */
    char words[2 * NAME];      /* what the value is */
} sweep;

static double at(const iso_record *r, size_t row, int column)
{
    return iso_record_const_row(r, row)[column];
}

/* --- the columns ------------------------------------------------------------------------------------------------ */

/* A column, in words, and those of its error. */
static const struct {
    const char *value, *words, *low, *high; /* low NULL: high is an error +- */
} known[] = {{"chaos_share", "chaotic share of the section", "chaos_share_low", "chaos_share_high"},
             {"splitting_m", "slope m of the splitting", NULL, "splitting_error"},
             {"splitting_x", "place x of the splitting", NULL, "splitting_x_error"},
             {"frequencies_f1_t", "frequency 1, in t", NULL, "frequencies_f1_error"},
             {"frequencies_f2_t", "frequency 2, in t", NULL, "frequencies_f2_error"},
             {"frequencies_rotation", "rotation number", NULL, NULL},
             {"rotations_trace1", "trace of the rotation about axis 1", NULL, "rotations_error1"},
             {"rotations_trace2", "trace of the rotation about axis 2", NULL, "rotations_error2"},
             {"rotations_trace3", "trace of the rotation about axis 3", NULL, "rotations_error3"},
             {"backends_largest", "largest difference of the computations", NULL, NULL},
             {"contact_time", "time at which contact is lost", NULL, NULL}};
enum { KNOWN = sizeof known / sizeof *known };

/* What varies, in words, where its name does not say it. */
static const char *axis_of(const sweep *s, int column)
{
    static const char *const words[][2] = {{"level", "level H of the point, in ε J₂^(−1/k)"},
                                           {"l", "place l of the start on the section, in rad"},
                                           {"x", "place x of the start on the section"}};
    const char *name = iso_record_name(s->r, (size_t)column);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(words[i][0], name) == 0) return words[i][1];
    return iso_picture_symbol(name);
}

static bool is_k(const sweep *s, int column)
{
    return strcmp(iso_record_name(s->r, (size_t)column), "k") == 0;
}

static int find(const sweep *s, const char *name)
{
    return name ? iso_record_find(s->r, name) : -1;
}

/* The group of a column and its name in it: the line "names" has "vary/k chaos/share" of all but the number of the
 * point, in older files the line "columns". False: of the point, its status and its reason. */
static bool group_of(const sweep *s, int column, char group[static NAME], char name[static NAME])
{
    const char *text = iso_record_get(s->r, iso_record_get(s->r, "names") ? "names" : "columns");
    for (int c = 1; text && c < column; c++) text = strchr(text, ' ') ? strchr(text, ' ') + 1 : NULL;
    return column > 0 && text && sscanf(text, "%63[^/ ]/%63[^ ]", group, name) == 2;
}

static bool varies(const sweep *s, int column)
{
    char group[NAME], name[NAME];
    return group_of(s, column, group, name) && strcmp(group, "vary") == 0;
}

static iso_status no_such_column(iso_context *ctx, const char *wanted, const sweep *s)
{
    char suggested[ISO_SUGGEST_SIZE], unused[2][NAME];
    const char *names[SUGGESTED];
    size_t count = 0;
    for (size_t c = 1; c < iso_record_columns(s->r) && count < SUGGESTED; c++)
        if (group_of(s, (int)c, unused[0], unused[1])) names[count++] = iso_record_name(s->r, c);
    return ISO_FAIL_INPUT(ctx, "value", "--value %s: there is no such column; %s", wanted,
                          iso_suggest(suggested, wanted, count, names));
}

/* Says what the value is, and which columns are its error. */
static void describe_value(sweep *s, const char *group, const char *name)
{
    snprintf(s->words, sizeof s->words, "%.60s: %.60s", group, iso_picture_symbol(name));
    s->low = s->high = -1;
    for (size_t i = 0; i < KNOWN; i++) {
        if (find(s, known[i].value) != s->value) continue;
        snprintf(s->words, sizeof s->words, "%s", known[i].words);
        s->low = find(s, known[i].low), s->high = find(s, known[i].high);
    }
}

static iso_status choose_value(iso_context *ctx, const char *wanted, sweep *s)
{
    char group[NAME], name[NAME];
    s->value = find(s, wanted);
    if (wanted && !group_of(s, s->value, group, name)) return no_such_column(ctx, wanted, s);
    for (size_t i = 0; i < KNOWN && s->value < 0; i++) s->value = find(s, known[i].value);
    for (int c = 0; c < (int)iso_record_columns(s->r) && s->value < 0; c++) {
        if (!group_of(s, c, group, name)) continue;
        const bool clock = strcmp(group, "state") == 0 && strcmp(name, "t") == 0; /* it is often constant */
        if (strcmp(group, "vary") != 0 && !clock) s->value = c;
    }
    if (s->value < 0) return ISO_FAIL_INPUT(ctx, "value", "nothing was measured");
    if (varies(s, s->value))
        return ISO_FAIL_INPUT(ctx, "value", "--value %s: it varies: name one that was measured", wanted);
    if (group_of(s, s->value, group, name)) describe_value(s, group, name);
    return ISO_OK;
}

static void find_axes(sweep *s)
{
    for (int c = 0; c < (int)iso_record_columns(s->r) && s->axes < MOST_AXES; c++) {
        bool differs = false;
        for (size_t i = 1, vary = varies(s, c); vary && i < iso_record_rows(s->r) && !differs; i++)
            differs = at(s->r, i, c) != at(s->r, 0, c);
        if (differs) s->axis[s->axes++] = c;
    }
}

/* --- what both share -------------------------------------------------------------------------------------------- */

/* k = 1 and k = -1, if they are on this axis. */
static iso_status add_marks(iso_context *ctx, const iso_picture_scale *scale, int axis, iso_record *marks)
{
    const size_t count = iso_record_rows(scale->at);
    for (int k = -1; k <= 1 && scale->k && count > 0; k += 2)
        if (k >= iso_picture_scale_at(scale, 0) && k <= iso_picture_scale_at(scale, count - 1))
            ISO_TRY(iso_record_add(ctx, marks, 1, (double[]){axis, k}));
    return ISO_OK;
}

static iso_status say_scale(iso_context *ctx, iso_picture *picture, const char *key, const iso_picture_scale *scale)
{
    return iso_picture_count(ctx, picture, key, scale->logarithmic);
}

static iso_status say_value(iso_context *ctx, iso_picture *picture, const sweep *s, bool sizes)
{
    char size[2 * NAME + 2];
    snprintf(size, sizeof size, sizes ? "|%s|" : "%s", s->words);
    ISO_TRY(iso_picture_count(ctx, picture, "sizes", sizes));
    return iso_picture_say(ctx, picture, "value", size);
}

static iso_status say_title(iso_context *ctx, iso_picture *picture, const sweep *s, const char *of)
{
    char title[160];
    if (iso_record_get(s->r, "title")) return ISO_OK;
    snprintf(title, sizeof title, "A sweep of %zu %s%s", iso_record_rows(s->r), of ? "values of " : "points",
             of ? of : "");
    return iso_picture_say(ctx, picture, "title", title);
}

/* --- one number varies ------------------------------------------------------------------------------------------ */

static int by_x(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return (*one > *other) - (*one < *other);
}

/* Where it is, the value, and its band. With sizes the band may not reach 0. False: there is no value. */
static bool find_point(const sweep *s, size_t i, bool sizes, double row[4])
{
    const double value = at(s->r, i, s->value), high = s->high < 0 ? (double)NAN : at(s->r, i, s->high);
    row[0] = at(s->r, i, s->axis[0]), row[1] = value;
    row[3] = s->low < 0 ? value + high : high;
    row[2] = s->low < 0 ? value - high : at(s->r, i, s->low);
    if (sizes) {
        const double error = (row[3] - row[2]) / 2;
        row[1] = fabs(value);
        row[2] = fmax(row[1] - error, row[1] / 1e3);
        row[3] = row[1] + error;
    }
    if (!isfinite(row[2]) || !isfinite(row[3])) row[2] = row[3] = row[1];
    return isfinite(value) && !(sizes && value == 0);
}

static iso_status fill_curve(iso_context *ctx, const sweep *s, bool sizes, bool k, iso_record *curve, bool *band)
{
    static const double gap[] = {NAN, NAN, NAN, NAN};
    iso_record *all = NULL;
    iso_status status = iso_record_create_like(ctx, curve, 0, NULL, &all);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(s->r); i++) {
        double row[4];
        if (!find_point(s, i, sizes, row)) row[1] = NAN;
        status = iso_record_add(ctx, all, 1, row);
    }
    const size_t rows = status == ISO_OK ? iso_record_rows(all) : 0;
    if (rows > 0) qsort(iso_record_row(all, 0), rows, 4 * sizeof(double), by_x);
    for (size_t i = 0; status == ISO_OK && i < rows; i++) {
        const double *row = iso_record_const_row(all, i);
        if (k && i > 0 && at(all, i - 1, 0) < 0 && row[0] > 0) status = iso_record_add(ctx, curve, 1, gap);
        if (status == ISO_OK) status = iso_record_add(ctx, curve, 1, isnan(row[1]) ? gap : row);
        *band = *band || (isfinite(row[1]) && row[3] > row[2]);
    }
    iso_record_free(all);
    return status;
}

static iso_status make_curve(iso_context *ctx, const sweep *s, iso_picture *picture)
{
    static const char *const names[] = {"at", "value", "low", "high"};
    iso_record *curve, *marks;
    iso_picture_spread spread;
    iso_picture_scale x;
    bool band = false;
    picture->layout = "sweep_curve";
    ISO_TRY(iso_picture_add(ctx, picture, "curve", 4, names, &curve));
    ISO_TRY(iso_picture_add(ctx, picture, "marks", 2, (const char *const[]){"axis", "at"}, &marks));
    ISO_TRY(iso_picture_spread_of(ctx, s->r, s->value, &spread));
    iso_status status = iso_picture_scale_of(ctx, s->r, s->axis[0], is_k(s, s->axis[0]), &x);
    if (status == ISO_OK) status = fill_curve(ctx, s, spread.sizes, x.k, curve, &band);
    if (status == ISO_OK) status = add_marks(ctx, &x, 1, marks);
    if (status == ISO_OK) status = say_scale(ctx, picture, "logarithmic_x", &x);
    iso_record_free(x.at);
    ISO_TRY(status);
    ISO_TRY(say_value(ctx, picture, s, spread.sizes));
    ISO_TRY(iso_picture_say(ctx, picture, "over", axis_of(s, s->axis[0])));
    ISO_TRY(iso_picture_say(ctx, picture, "error",
                            !band           ? ""
                            : s->low < 0 ? "± estimated error"
                                         : "95 % confidence, undecided orbits included"));
    return say_title(ctx, picture, s, axis_of(s, s->axis[0]));
}

/* --- maps ------------------------------------------------------------------------------------------------------- */

/* What the axes of the maps are, and which column tells the maps apart. */
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

/* Fills x, y, u and v of a point. */
static void place(const sweep *s, const layout *l, size_t row, double point[ISO_POINT_COLUMNS])
{
    const double *from = iso_record_const_row(s->r, row);
    if (!l->ratios && !l->triangle) {
        point[ISO_POINT_X] = from[l->x], point[ISO_POINT_Y] = from[l->y];
        return;
    }
    const double a = from[l->J], b = from[l->J + 1], c = from[l->J + 2], sum = a + b + c;
    const double uv[] = {(b + c / 2) / sum, c * sqrt(0.75) / sum};
    memcpy(point + ISO_POINT_U, uv, sizeof uv);
    point[ISO_POINT_X] = l->ratios ? a / c : uv[0];
    point[ISO_POINT_Y] = l->ratios ? b / c : uv[1];
}

/* The three moments vary: they are one point of a triangle. */
static bool takes_moments(const sweep *s, layout *l, int rest[], int *others)
{
    int moments = 0;
    *others = 0;
    for (int i = 0; i < s->axes; i++) {
        const char *name = iso_record_name(s->r, (size_t)s->axis[i]);
        const bool moment = name[0] == 'J' && name[1] >= '1' && name[1] <= '3' && name[2] == '\0';
        if (moment && moments++ == 0) l->J = s->axis[i];
        if (!moment) rest[(*others)++] = s->axis[i];
    }
    if (moments != 3) return false;
    l->ratios = true;
    for (size_t i = 0; i < iso_record_rows(s->r); i++) {
        const double *J = iso_record_const_row(s->r, i) + l->J;
        l->ratios = l->ratios && J[0] <= J[1] && J[1] <= J[2];
    }
    l->triangle = !l->ratios;
    l->x_name = l->ratios ? "J₁/J₃" : "(J₂ + J₃/2)/(J₁ + J₂ + J₃)";
    l->y_name = l->ratios ? "J₂/J₃" : "(√3/2) J₃/(J₁ + J₂ + J₃)";
    return true;
}

/* The place of a number in a list, at whose end it is put; -1: the list is full. */
static int place_in(double list[MAPS], int *count, double x)
{
    int i = 0;
    while (i < *count && list[i] != x) i++;
    if (i == MAPS) return -1;
    list[i] = x;
    if (i == *count) ++*count;
    return i;
}

/* Of three numbers that vary the one with the fewest values tells the maps apart. */
static void take_columns(const sweep *s, layout *l)
{
    int panel = -1, fewest = MAPS + 2, rest[3], others = 0;
    for (int i = 0; i < s->axes && s->axes == 3; i++) {
        double seen[MAPS];
        int values = 0;
        for (size_t row = 0; values <= MAPS && row < iso_record_rows(s->r); row++)
            if (place_in(seen, &values, at(s->r, row, s->axis[i])) < 0) values = MAPS + 1;
        if (values < fewest) fewest = values, panel = i;
    }
    for (int i = 0; i < s->axes; i++)
        if (i != panel) rest[others++] = s->axis[i];
    if (panel >= 0) l->panel = s->axis[panel];
    l->x = rest[0];
    l->y = rest[1];
    l->x_name = axis_of(s, l->x);
    l->y_name = axis_of(s, l->y);
}

static iso_status choose_layout(iso_context *ctx, const sweep *s, layout *l)
{
    int rest[MOST_AXES], others;
    const bool moments = takes_moments(s, l, rest, &others);
    const int left = moments ? others : s->axes - 2;
    if (left < 0 || left > 1)
        return ISO_FAIL_INPUT(ctx, "", "%d numbers vary: a picture shows one, two, or three (J counts as two)",
                              s->axes);
    if (!moments) take_columns(s, l);
    if (moments && left == 1) l->panel = rest[0];
    return ISO_OK;
}

static iso_status collect(iso_context *ctx, const sweep *s, layout *l, iso_record *points)
{
    for (size_t i = 0; i < iso_record_rows(s->r); i++) {
        const int map = place_in(l->key, &l->maps, l->panel < 0 ? 0 : at(s->r, i, l->panel));
        double point[ISO_POINT_COLUMNS] = {map + 1, [ISO_POINT_VALUE] = at(s->r, i, s->value)};
        if (map < 0)
            return ISO_FAIL_INPUT(ctx, "", "more than %d values of '%s': a picture has no room", MAPS,
                                  axis_of(s, l->panel));
        place(s, l, i, point);
        ISO_TRY(iso_record_add(ctx, points, 1, point));
    }
    return ISO_OK;
}

static iso_status name_maps(iso_context *ctx, const sweep *s, const layout *l, iso_record *maps)
{
    char name[2 * NAME], number[ISO_PICTURE_FRACTION];
    for (int i = 0; i < l->maps; i++) {
        double word;
        snprintf(name, sizeof name, "%s = %s", l->panel < 0 ? "" : axis_of(s, l->panel),
                 iso_picture_fraction(number, l->key[i]));
        ISO_TRY(iso_record_intern(ctx, maps, l->panel < 0 ? "" : name, &word));
        ISO_TRY(iso_record_add(ctx, maps, 1, &word));
    }
    return ISO_OK;
}

/* One scale of colours for all maps. */
static iso_status say_colours(iso_context *ctx, iso_picture *picture, const iso_record *points, bool sizes,
                              const iso_picture_spread *s)
{
    double low = sizes ? s->least : s->low, high = sizes ? fmax(fabs(s->low), fabs(s->high)) : s->high;
    bool missing = false;
    if (!(low < high)) low = isfinite(low) ? low : 0, high = low + 1;
    for (size_t i = 0; i < iso_record_rows(points); i++) {
        const double value = at(points, i, ISO_POINT_VALUE);
        missing = missing || !isfinite(value) || (sizes && value == 0);
    }
    ISO_TRY(iso_picture_count(ctx, picture, "low", low));
    ISO_TRY(iso_picture_count(ctx, picture, "high", high));
    return iso_picture_count(ctx, picture, "missing", missing);
}

static iso_status fill_maps(iso_context *ctx, const sweep *s, layout *l, iso_picture_maps *m, iso_picture *picture)
{
    iso_picture_spread spread;
    ISO_TRY(collect(ctx, s, l, m->points));
    m->count = l->maps;
    m->back = l->ratios ? to_ratios : l->triangle ? keep : NULL;
    ISO_TRY(iso_picture_scale_of(ctx, m->points, ISO_POINT_X, !m->back && is_k(s, l->x), &m->x));
    ISO_TRY(iso_picture_scale_of(ctx, m->points, ISO_POINT_Y, !m->back && is_k(s, l->y), &m->y));
    ISO_TRY(iso_picture_spread_of(ctx, s->r, s->value, &spread));
    ISO_TRY(iso_picture_cells(ctx, m, spread.sizes, picture->table[0]));
    ISO_TRY(name_maps(ctx, s, l, picture->table[1]));
    ISO_TRY(add_marks(ctx, &m->x, 1, picture->table[2]));
    ISO_TRY(add_marks(ctx, &m->y, 2, picture->table[2]));
    ISO_TRY(say_scale(ctx, picture, "logarithmic_x", &m->x));
    ISO_TRY(say_scale(ctx, picture, "logarithmic_y", &m->y));
    ISO_TRY(say_value(ctx, picture, s, spread.sizes));
    ISO_TRY(say_colours(ctx, picture, m->points, spread.sizes, &spread));
    ISO_TRY(iso_picture_say(ctx, picture, "x", l->x_name));
    ISO_TRY(iso_picture_say(ctx, picture, "y", l->y_name));
    return say_title(ctx, picture, s, NULL);
}

static iso_status make_maps(iso_context *ctx, const sweep *s, iso_picture *picture)
{
    static const char *const names[] = {"cell", "map", "missing", "value", "x", "y"},
                             *const point[] = {"map", "x", "y", "value", "u", "v"};
    layout l = {.panel = -1};
    iso_picture_maps m = {.points = NULL};
    iso_record *table;
    picture->layout = "sweep_map";
    ISO_TRY(iso_picture_add(ctx, picture, "cells", 6, names, &table));
    ISO_TRY(iso_picture_add(ctx, picture, "maps", 1, (const char *const[]){"name"}, &table));
    iso_record_set_words(table, 0, true);
    ISO_TRY(iso_picture_add(ctx, picture, "marks", 2, (const char *const[]){"axis", "at"}, &table));
    iso_status status = choose_layout(ctx, s, &l);
    if (status == ISO_OK) status = iso_record_create(ctx, ISO_POINT_COLUMNS, point, &m.points);
    if (status == ISO_OK) status = fill_maps(ctx, s, &l, &m, picture);
    iso_record_free(m.points);
    iso_record_free(m.x.at);
    iso_record_free(m.y.at);
    return status;
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    char value[ISO_PICTURE_OPTION];
    sweep s = {.r = q->table[0]};
    ISO_TRY(choose_value(ctx, iso_picture_option(q, "value", value) ? value : NULL, &s));
    find_axes(&s);
    if (s.axes == 0) return ISO_FAIL_INPUT(ctx, "", "nothing varies in this sweep");
    return s.axes == 1 ? make_curve(ctx, &s, picture) : make_maps(ctx, &s, picture);
}

static iso_status refuse(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    (void)q, (void)picture;
    return ISO_FAIL_INPUT(ctx, "", "a part of a sweep: merge the parts first");
}

const iso_picture_maker iso_picture_sweep = {"sweep", "A sweep", {"status"}, .options = " value ", .make = make},
                        iso_picture_sweep_part = {"sweep part", "A part of a sweep", {"status"}, .options = " value ",
                                                  .make = refuse};

/* sweep_maps.c - what the maps of a sweep show: which numbers are their axes, and which one differs between them.
 * sweep.c says which tables they are. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "picture/maps_impl.h"

enum { NAME = ISO_SWEPT_NAME, MAPS = 6 };

/* --- maps ------------------------------------------------------------------------------------------------------- */

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
static iso_status choose_layout(iso_context *ctx, const iso_swept *s, layout *l)
{
    int rest[ISO_SWEPT_AXES], others = 0, moments = 0, fewest = MAPS + 2;
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
    l->x_name = iso_swept_axis(s, l->x);
    l->y_name = iso_swept_axis(s, l->y);
    return ISO_OK;
}

static iso_status collect(iso_context *ctx, const iso_swept *s, layout *l, iso_record *points)
{
    for (size_t i = 0; i < iso_record_rows(s->r); i++) {
        const double *from = iso_record_const_row(s->r, i);
        const int map = place_in(l->key, &l->maps, l->panel < 0 ? 0 : from[l->panel]);
        double x = from[l->x], y = from[l->y], u = 0, v = 0;
        if (map < 0)
            return ISO_FAIL_INPUT(ctx, "", "more than %d values of '%s': a picture has no room", MAPS,
                                  iso_swept_axis(s, l->panel));
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
static iso_status say_colours(iso_context *ctx, iso_picture *picture, const iso_record *points,
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

static iso_status add_names(iso_context *ctx, const iso_swept *s, const layout *l, iso_record *maps)
{
    char name[2 * NAME] = "", number[ISO_FRACTION_SIZE];
    for (int i = 0; i < l->maps; i++) {
        double word;
        if (l->panel >= 0)
            snprintf(name, sizeof name, "%s = %s", iso_swept_axis(s, l->panel), iso_fraction_text(number, l->key[i]));
        ISO_TRY(iso_record_intern(ctx, maps, name, &word));
        ISO_TRY(iso_record_add(ctx, maps, 1, &word));
    }
    return ISO_OK;
}

iso_status iso_swept_maps(iso_context *ctx, const iso_swept *s, iso_picture *picture)
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
    ISO_TRY(iso_picture_scale_of(ctx, picture, *points, ISO_POINT_X, !m.back && iso_swept_is_k(s, l.x), &m.x));
    ISO_TRY(iso_picture_scale_of(ctx, picture, *points, ISO_POINT_Y, !m.back && iso_swept_is_k(s, l.y), &m.y));
    ISO_TRY(iso_picture_spread_of(ctx, picture, s->r, s->value, &spread));
    ISO_TRY(iso_picture_cells(ctx, &m, spread.sizes, cells));
    ISO_TRY(add_names(ctx, s, &l, maps));
    ISO_TRY(iso_swept_marks(ctx, &m.x, 1, marks));
    ISO_TRY(iso_swept_marks(ctx, &m.y, 2, marks));
    ISO_TRY(
        iso_picture_set(ctx, picture, "logarithmic_x logarithmic_y", (double[]){m.x.logarithmic, m.y.logarithmic}));
    ISO_TRY(iso_swept_say_value(ctx, picture, s, spread.sizes));
    ISO_TRY(say_colours(ctx, picture, *points, &spread));
    ISO_TRY(iso_picture_say(ctx, picture, "x", "%s", l.x_name));
    ISO_TRY(iso_picture_say(ctx, picture, "y", "%s", l.y_name));
    return iso_swept_say_title(ctx, picture, s, NULL);
}

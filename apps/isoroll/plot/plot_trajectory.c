/* plot_trajectory.c - the picture of one trajectory: a sheet of panels, in rows of two.
 *
 * Square panels come first: the path in space, the spheres. Charts follow. A square that would stand alone has charts
 * on its right, and a chart that would stand alone is as wide as the sheet: no part of the sheet is empty.
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

/* In pixels. */
enum { WIDTH = 900, TITLE = 50, SQUARE = 420, VIEW = 320, WIDE = 270, CHART = 260, LINE = 40, UNITS = 26, FOOT = 12 };

typedef enum square { FROM_ABOVE, FROM_SIDE, ON_BALL, ON_POINT, SQUARES } square;
typedef enum chart { ENERGIES, PRESSURE, DRIFT, PACES, CHARTS } chart;

typedef struct sheet {
    FILE *f;
    const iso_plot_orbit *plot;
    iso_plot_scenery scenery;
    iso_record *trace; /* of a ball without its point: unit vectors; NULL: n is drawn */
    int ball, point;   /* first columns of n or the trace, and of gamma; -1: not there */
    square square[SQUARES];
    chart chart[CHARTS];
    int squares, charts, beside; /* beside: charts on the right of the last square */
    bool narrow, noise;
    size_t lost[ISO_PLOT_MARKS];
    int losses;
    int height, y; /* of the sheet; of the next row, from above */
} sheet;

/* --- what there is ---------------------------------------------------------------------------------------------- */

/* The contact on the ball as unit vectors, if the ball has the columns trace1..3. */
static iso_status find_trace(iso_context *ctx, sheet *s)
{
    static const char *const names[] = {"trace1", "trace2", "trace3"};
    const iso_record *r = s->plot->ball;
    int column[3];
    if (s->plot->point || !iso_record_find_all(r, 3, names, column, NULL)) return ISO_OK;
    iso_status status = iso_record_create(ctx, 3, names, &s->trace);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(r); i++) {
        double to[3];
        for (int c = 0; c < 3; c++) to[c] = iso_record_const_row(r, i)[column[c]];
        if (norm(to) == 0)
            return iso_context_fail(ctx, ISO_NUMERICAL, names[0], "a picture: the trace is 0 in row %zu", i + 1);
        scale(to, 1 / norm(to));
        status = iso_record_add(ctx, s->trace, 1, to);
    }
    return status == ISO_OK ? iso_plot_find(ctx, s->trace, 3, names, &s->ball) : status;
}

static bool is_constant(const iso_record *r)
{
    double range[2], size = 0, most = 0;
    for (int c = 1; c < (int)iso_record_columns(r) && c < 4; c++) {
        iso_plot_range(r, c, range);
        size = fmax(size, fmax(fabs(range[0]), fabs(range[1])));
        most = fmax(most, range[1] - range[0]);
    }
    return !(most > 1e-9 * size);
}

static double largest_of(const iso_record *r, size_t column)
{
    double range[2];
    iso_plot_range(r, (int)column, range);
    return fmax(0, range[1]);
}

static bool is_noise(const iso_record *drift)
{
    bool noise = drift != NULL;
    for (size_t c = 1; noise && c < iso_record_columns(drift); c++) noise = largest_of(drift, c) < 1000 * DBL_EPSILON;
    return noise;
}

/* The first clock of a record, or -1. */
static int clock_of(const iso_record *r)
{
    static const char *const clocks[] = {"t", "tau", "s"};
    int column = -1;
    for (int i = 0; column < 0 && i < 3; i++) column = iso_record_find(r, clocks[i]);
    return column;
}

static bool has_pressure(const iso_plot_orbit *plot)
{
    return plot->ball && iso_record_find(plot->ball, "pressure") >= 0 && clock_of(plot->ball) >= 0;
}

static void choose_panels(sheet *s)
{
    const iso_plot_orbit *p = s->plot;
    if (p->space && !s->narrow) s->square[s->squares++] = FROM_ABOVE;
    if (p->space && !(s->scenery.plane && s->scenery.level)) s->square[s->squares++] = FROM_SIDE;
    if (s->ball >= 0) s->square[s->squares++] = ON_BALL;
    if (s->point >= 0) s->square[s->squares++] = ON_POINT;
    s->noise = is_noise(p->drift);
    if (p->energies && !is_constant(p->energies)) s->chart[s->charts++] = ENERGIES;
    if (has_pressure(p)) s->chart[s->charts++] = PRESSURE;
    const bool drift = p->drift && !s->noise, odd = s->squares % 2;
    if (drift && !odd) s->chart[s->charts++] = DRIFT;
    if (p->paces) s->chart[s->charts++] = PACES;
    s->beside = !odd ? 0 : s->charts < 2 ? s->charts : 2;
    if (drift && odd) s->chart[s->charts++] = DRIFT; /* its key needs room: not beside a square */
    if (p->ball) s->losses = iso_plot_losses(p->ball, s->lost);
}

static bool is_view(square which)
{
    return which == FROM_ABOVE || which == FROM_SIDE;
}

/* The height of a row of squares: that of two views can be less. */
static int row_height(const sheet *s, int first)
{
    const bool views = is_view(s->square[first]) && first + 1 < s->squares && is_view(s->square[first + 1]);
    return views ? SQUARE - (int)(VIEW * (1 - iso_plot_view_shape(&s->scenery))) : SQUARE;
}

static void choose_height(sheet *s)
{
    int rows = 0;
    for (int i = 0; i < s->squares; i += 2) rows += row_height(s, i);
    s->height = TITLE + (s->narrow ? WIDE : 0) + rows + (s->charts - s->beside + 1) / 2 * CHART +
                (s->noise ? LINE : 0) + (s->plot->space ? UNITS : 0) + FOOT;
}

/* --- where it stands -------------------------------------------------------------------------------------------- */

/* Pixels from the left and from above as parts of the sheet. */
static iso_plot_box box_of(const sheet *s, int left, int right, int top, int bottom)
{
    return (iso_plot_box){(double)left / WIDTH, (double)right / WIDTH, 1 - (double)bottom / s->height,
                          1 - (double)top / s->height};
}

/* --- squares ---------------------------------------------------------------------------------------------------- */

static void put_key(const sheet *s, square which, double x, int from_above)
{
    char text[512];
    if (is_view(which)) iso_plot_view_key(&s->scenery, text);
    iso_plot_key(s->f, x, 1 - (double)from_above / s->height,
                 is_view(which) ? text
                                : "NaN w l lw 1.8 lc rgb " ISO_PLOT_BLUE " title 'near side',"
                                  " NaN w l lw 1.8 lc rgb " ISO_PLOT_FAR_BLUE " title 'far side',"
                                  " " ISO_PLOT_ENDS);
}

static void put_sphere(const sheet *s, const iso_plot_box *box, const iso_record *r, int column, const char *title)
{
    fprintf(s->f, "unset grid; unset object; unset xlabel; unset ylabel; set title '%s' offset 0,0\n", title);
    iso_plot_sphere(s->f, box, r, column);
}

static void put_square(const sheet *s, square which, int left, int height)
{
    const int y = s->y;
    const iso_plot_box view = box_of(s, left + 75, left + 435, y + 25, y + height - 75);
    const iso_plot_box sphere = box_of(s, left + 9, left + 441, y + 25, y + height - 40);
    if (is_view(which))
        iso_plot_view(s->f, &view, &s->scenery, which == FROM_ABOVE);
    else if (which == ON_POINT)
        put_sphere(s, &sphere, s->plot->point, s->point, ISO_PLOT_OF_POINT);
    else
        put_sphere(s, &sphere, s->trace ? s->trace : s->plot->ball, s->ball,
                   s->trace ? "on the ball: where it touched the support" : ISO_PLOT_OF_BALL);
}

/* --- charts ----------------------------------------------------------------------------------------------------- */

/* mu grows without bound where the pressure falls to 0: then its axis ends at about 3 times its usual size. 0: all of
 * mu is drawn. */
static double top_of_mu(const iso_record *r, int mu)
{
    const size_t rows = iso_record_rows(r);
    double sum = 0, most = 0;
    for (size_t i = 0; i < rows; i++) {
        const double x = iso_record_const_row(r, i)[mu];
        sum += x / (1 + x), most = fmax(most, x); /* the mean of x/(1+x) stays below 1 */
    }
    const double middle = sum / (double)rows, usual = middle / (1 - fmin(middle, 0.9));
    return most > 5 * usual ? fmax(3 * usual, 2 * iso_record_const_row(r, 0)[mu]) : 0;
}

/* The curves of charts; those whose column is not there are left out. The last one is drawn on top. */
static const struct {
    const char *column, *name, *colour;
    bool right;
} curves[CHARTS][3] = {
    [ENERGIES] = {{"h", "energy h", "'black'", false},
                  {"kinetic", "kinetic", ISO_PLOT_BLUE, false},
                  {"potential", "potential", ISO_PLOT_ORANGE, false}},
    [PRESSURE] = {{"mu", "μ needed (right)", ISO_PLOT_ORANGE, true}, {"pressure", "pressure", ISO_PLOT_BLUE, false}},
    [PACES] = {{"ds/dt", "ds/dt", ISO_PLOT_BLUE, false}, {"dtau/dt", "dτ/dt", ISO_PLOT_ORANGE, false}},
};

static void put_curves(const sheet *s, chart which, const iso_plot_box *box)
{
    const iso_plot_orbit *plot = s->plot;
    const iso_record *r = which == PACES ? plot->paces : which == ENERGIES ? plot->energies : plot->ball;
    iso_plot_curve curve[3];
    iso_plot_panel p = {.box = *box, .rows = r, .curve = curve};
    for (int i = 0; i < 3 && curves[which][i].colour; i++) {
        const int column = iso_record_find(r, curves[which][i].column);
        if (column < 0) continue;
        curve[p.count++] =
            (iso_plot_curve){column, curves[which][i].name, curves[which][i].colour, curves[which][i].right};
        if (curves[which][i].right) p.top[1] = top_of_mu(r, column);
    }
    if (which == PRESSURE) p.over = clock_of(r);
    if (which == PACES) {
        p.title = "speed (mean 1)";
    } else {
        p.mark = s->lost, p.marks = s->losses;
        p.marked = iso_plot_loss_name(plot->ball, s->lost, s->losses);
    }
    iso_plot_curves(s->f, &p);
}

/* A chart in this part of the sheet, with its title above and its numbers around it. */
static void put_chart(const sheet *s, chart which, int left, int right, int top, int height)
{
    const iso_plot_box box = box_of(s, left + 75, right - (which == DRIFT ? 180 : 55), top + 40, top + height - 52);
    if (which == DRIFT)
        iso_plot_differences(s->f, s->plot->drift, &box, "relative drift of the integrals");
    else
        put_curves(s, which, &box);
}

/* "integrals hold up to rounding: no drift above 3e-16 of h, omega.n, |n|" */
static void put_noise(const sheet *s)
{
    const iso_record *r = s->plot->drift;
    char names[200] = "", text[300];
    size_t used = 0;
    double largest = 0;
    for (size_t c = 1; c < iso_record_columns(r); c++) {
        largest = fmax(largest, largest_of(r, c));
        if (used < 100)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%.31s", c > 1 ? ", " : "",
                                     iso_plot_symbol(iso_record_name(r, c)));
    }
    snprintf(text, sizeof text, "integrals hold up to rounding: no drift above %.0e of %s", largest, names);
    iso_plot_words(s->f, text, 130, 1 - (s->y + LINE / 2.0) / s->height, "tc rgb " ISO_PLOT_INK);
}

/* --- the sheet -------------------------------------------------------------------------------------------------- */

static void put_squares(sheet *s)
{
    for (int i = 0; i < s->squares; i += 2) {
        const int height = row_height(s, i);
        const bool pair = i + 1 < s->squares, alike = pair && is_view(s->square[i]) == is_view(s->square[i + 1]);
        const int beside = pair ? 0 : s->beside, left = pair || beside ? 0 : WIDTH / 4;
        put_square(s, s->square[i], left, height);
        if (pair) put_square(s, s->square[i + 1], WIDTH / 2, height);
        put_key(s, s->square[i], alike ? 0.5 : (left + WIDTH / 4.0) / WIDTH, s->y + height - 19);
        if (pair && !alike) put_key(s, s->square[i + 1], 0.75, s->y + height - 19);
        for (int c = 0; c < beside; c++)
            put_chart(s, s->chart[c], WIDTH / 2, WIDTH, s->y + c * SQUARE / 2 - (beside == 1 ? 0 : 8),
                      beside == 1 ? SQUARE - 50 : SQUARE / 2);
        s->y += height;
    }
}

static void put_sheet(sheet *s)
{
    s->y = TITLE;
    if (s->narrow) {
        const iso_plot_box wide = box_of(s, 75, WIDTH - 35, s->y + 30, s->y + WIDE - 80);
        iso_plot_view(s->f, &wide, &s->scenery, true);
        put_key(s, FROM_ABOVE, 0.5, s->y + WIDE - 20);
        s->y += WIDE;
    }
    put_squares(s);
    for (int used = s->beside; used < s->charts; used += 2, s->y += CHART) {
        const bool pair = used + 1 < s->charts;
        put_chart(s, s->chart[used], 0, pair ? WIDTH / 2 : WIDTH, s->y, CHART);
        if (pair) put_chart(s, s->chart[used + 1], WIDTH / 2, WIDTH, s->y, CHART);
    }
    if (s->noise) put_noise(s);
    if (s->plot->space)
        iso_plot_words(s->f, "lengths, times and forces are in the units of the scene", 130,
                       (FOOT + UNITS / 2.0) / s->height, "tc rgb " ISO_PLOT_WORDS);
}

static iso_status look_at(iso_context *ctx, sheet *s)
{
    const iso_plot_orbit *plot = s->plot;
    if (plot->ball) ISO_TRY(iso_plot_find(ctx, plot->ball, 3, iso_plot_normal, &s->ball));
    if (plot->ball) ISO_TRY(find_trace(ctx, s));
    if (plot->point) ISO_TRY(iso_plot_find(ctx, plot->point, 3, iso_plot_place_of_point, &s->point));
    if (plot->space) ISO_TRY(iso_plot_look_around(ctx, plot->space, &s->scenery));
    if (s->ball < 0 && s->point < 0 && !plot->space)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "a picture needs the path of the ball or of the point");
    s->narrow = plot->space && iso_plot_is_narrow(&s->scenery);
    choose_panels(s);
    choose_height(s);
    return ISO_OK;
}

iso_status iso_plot_trajectory(iso_context *ctx, const iso_plot_page *page, const iso_plot_orbit *plot)
{
    sheet s = {.plot = plot, .ball = -1, .point = -1};
    iso_status status = look_at(ctx, &s);
    if (status == ISO_OK) {
        s.f = iso_gnuplot_open(ctx, page, WIDTH, s.height);
        fputs("set multiplot\n", s.f);
        iso_plot_words(s.f, iso_plot_titled(page, s.plot->title), 95, 1 - 22.0 / s.height, "font ',12'");
        put_sheet(&s);
        status = iso_gnuplot_close(ctx, true);
    }
    iso_record_free(s.trace);
    return status;
}

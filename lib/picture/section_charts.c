/* section_charts.c - from points (l, x) of a section to the spots of both charts (see section_impl.h).
 *
 * At (l, x), for a = 3,
 *
 *     gamma = (cos l, -sin l, 0),     M/|M| = (sqrt(1-x^2) sin l, sqrt(1-x^2) cos l, x)
 *     n ~ J^(1/2) gamma,              omega ~ J^(-1/2) M, for k < 0 against it                                 (18)
 *
 * The ball's coordinates are the angle psi of n = (cos psi, -sin psi, 0) and omega_a/|omega|. The point's are l and
 * L = G(l) x.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "map/section_impl.h"
#include "picture/section_impl.h"

enum { BOUNDARY = 240, CELLS = ISO_PICTURE_CELLS };
#define TOP 1.05 /* of the axis of L, by the largest L  */
#define ROOM 1.2 /* beyond the crossings, if they are few */

const char *const iso_picture_crossing_names[] = {"l", "x", "point_l", "point_x", "shade", "colour", "images"};

void iso_picture_image(int n, double l, double x, double image[2])
{
    image[0] = remainder((n & 1 ? -l : l) + (n & 2 ? M_PI : 0), 2 * M_PI);
    image[1] = n & 4 ? -x : x;
}

/* --- options ---------------------------------------------------------------------------------------------------- */

bool iso_picture_window(const char *text, double window[2][2])
{
    double *l = window[0], *x = window[1];
    for (int i = 0; i < 4; i++) { /* "L0:L1,X0:X1" */
        const size_t length = i == 3 ? strlen(text) : strcspn(text, i == 1 ? "," : ":");
        if (!iso_number_read(text, length, &window[i / 2][i % 2]) || (i < 3 && !text[length])) return false;
        text += length + 1;
    }
    if (!(l[0] >= -3.15 && l[1] <= 3.15 && l[0] < l[1] && x[0] >= -1 && x[1] <= 1 && x[0] < x[1])) return false;
    for (int i = 0; i < 2; i++) l[i] = fmin(fmax(l[i], -M_PI), M_PI);
    return l[0] < l[1];
}

iso_status iso_picture_charts_options(iso_context *ctx, const iso_picture_request *q, iso_picture_charts *c)
{
    char text[ISO_PICTURE_OPTION];
    double points;
    c->windowed = iso_picture_option(q, "window", text);
    if (c->windowed && !iso_picture_window(text, c->window))
        return ISO_FAIL_ARGUMENT(
            ctx, "window", "window '%s': expected two ranges such as 0.5:1.2,-0.3:0.3, l up to pi and x up to 1",
            text);
    if (!iso_picture_option(q, "points", text)) return ISO_OK;
    if (!iso_number_read(text, strlen(text), &points) || !(points >= 1 && points <= 1e9))
        return ISO_FAIL_ARGUMENT(ctx, "points", "points '%s': expected a number of points", text);
    c->points = (size_t)points;
    return ISO_OK;
}

/* --- places ----------------------------------------------------------------------------------------------------- */

/* G(l). If more acts than a level, 1: then x is drawn in place of L. */
static double largest_momentum(const iso_picture_charts *c, double l)
{
    return c->eps > 0 ? iso_section_momentum((iso_point_motion){&c->params, c->eps, c->energy}, c->axis, l) : 1;
}

iso_picture_spot iso_picture_place(const iso_picture_charts *chart, bool ball, double l, double x)
{
    if (!ball) return (iso_picture_spot){l, x * largest_momentum(chart, l)};
    const iso_params *p = &chart->params;
    const int a = chart->axis, b = (a + 1) % 3, c = (a + 2) % 3;
    const double across = sqrt((1 - x) * (1 + x)), sign = copysign(1, p->k), sine = sin(l), cosine = cos(l);
    const double omega[3] = {sign * across * sine / p->root_J[b], sign * across * cosine / p->root_J[c],
                             sign * x / p->root_J[a]};
    return (iso_picture_spot){atan2(p->root_J[c] * sine, p->root_J[b] * cosine), omega[2] / norm(omega)};
}

/* A chart's rectangle, and how its cells are counted. */
typedef struct frame {
    double low[2], high[2]; /* right, up */
} frame;

/* The rectangle that holds the window, or the whole chart. most: how far up the spots go. */
static frame frame_of(const iso_picture_charts *c, bool ball, double most)
{
    const double *l = c->window[0], *x = c->window[1];
    frame f = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (int i = 0; c->windowed && i <= 2 * BOUNDARY + 1; i++) {
        const iso_picture_spot at = iso_picture_place(c, ball, l[0] + (l[1] - l[0]) * (i / 2) / BOUNDARY, x[i % 2]);
        f = (frame){{fmin(f.low[0], at.right), fmin(f.low[1], at.up)},
                    {fmax(f.high[0], at.right), fmax(f.high[1], at.up)}};
    }
    if (c->windowed) return f;
    double top = ball ? 1 : 0;
    for (int i = 0; !ball && i <= BOUNDARY; i++) top = fmax(top, largest_momentum(c, M_PI * i / BOUNDARY));
    if (c->few) top = fmin(top, ROOM * most + 1e-3 * top);
    if (!ball) top *= TOP;
    return (frame){{-M_PI, -top}, {M_PI, top}};
}

/* --- spots ------------------------------------------------------------------------------------------------------ */

typedef struct spot {
    iso_picture_spot at;
    const double *crossing;
} spot;

/* Of few spots one at pi is one at -pi, and is seen at both. */
static bool is_at_edge(const iso_picture_charts *c, iso_picture_spot at)
{
    return c->few && !c->windowed && fabs(at.right) > M_PI - 1e-9;
}

/* All crossings with their images by one model; NULL: no memory. The caller frees them. */
static spot *place_all(const iso_picture_charts *c, const iso_record *r, bool ball, size_t *count)
{
    const int l = ball ? ISO_PICTURE_L : ISO_PICTURE_POINT_L, x = ball ? ISO_PICTURE_X : ISO_PICTURE_POINT_X;
    spot *all = malloc((8 * iso_record_rows(r) + 1) * sizeof *all);
    *count = 0;
    for (size_t i = 0; all && i < iso_record_rows(r); i++) {
        const double *row = iso_record_const_row(r, i);
        for (int n = 0; n < 8; n++) {
            double image[2];
            if (!((unsigned)row[ISO_PICTURE_IMAGES] >> n & 1)) continue;
            iso_picture_image(n, row[l], row[x], image);
            all[*count] = (spot){iso_picture_place(c, ball, image[0], image[1]), row};
            if (is_at_edge(c, all[*count].at)) all[*count].at.right = -M_PI;
            *count += isfinite(all[*count].at.right) && isfinite(all[*count].at.up);
        }
    }
    return all;
}

/* -1: outside of the frame. */
static int cell_of(const frame *f, iso_picture_spot at)
{
    const double u = (at.right - f->low[0]) / (f->high[0] - f->low[0]),
                 v = (at.up - f->low[1]) / (f->high[1] - f->low[1]);
    if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1)) return -1;
    return (int)fmin(v * CELLS, CELLS - 1) * CELLS + (int)fmin(u * CELLS, CELLS - 1);
}

/* Digits that are not seen only make files large. */
static double rounded(double x, double low, double high)
{
    const double unit = pow(10, 5 - ceil(log10(high - low)));
    return fmin(fmax(nearbyint(x * unit) / unit, low), high);
}

/* From behind to before, one spot in each cell: the first of those that are before all others. cells: zeros. Grey lies
 * behind dark, and both behind colours. */
static iso_status add_spots(iso_context *ctx, const iso_picture_charts *c, const frame *f, const spot *all,
                            size_t count, unsigned char cells[], iso_record *to)
{
    static const unsigned char layer_of[] = {
        [ISO_PICTURE_GREY] = 1, [ISO_PICTURE_DARK] = 2, [ISO_PICTURE_COLOURED] = 3};
    enum { LAYERS = 3, DONE };
    for (size_t i = 0; i < count; i++) {
        const int cell = cell_of(f, all[i].at);
        const unsigned char layer = layer_of[(int)all[i].crossing[ISO_PICTURE_SHADE]];
        if (cell >= 0 && layer > cells[cell]) cells[cell] = layer;
    }
    for (int layer = 1; layer <= LAYERS; layer++)
        for (size_t i = 0; i < count; i++) {
            const iso_picture_spot at = all[i].at;
            const double shade = all[i].crossing[ISO_PICTURE_SHADE], colour = all[i].crossing[ISO_PICTURE_COLOUR];
            const int cell = cell_of(f, at);
            if (cell < 0 || cells[cell] != layer || layer_of[(int)shade] != layer) continue;
            cells[cell] = DONE;
            const double right = rounded(at.right, f->low[0], f->high[0]), up = rounded(at.up, f->low[1], f->high[1]);
            ISO_TRY(iso_record_add(ctx, to, 1, (double[]){right, up, shade, colour}));
            if (is_at_edge(c, at)) ISO_TRY(iso_record_add(ctx, to, 1, (double[]){-right, up, shade, colour}));
        }
    return ISO_OK;
}

/* In place of the spots of a table: an image. A spot is three cells wide, without the corners. */
static iso_status add_image(iso_context *ctx, const frame *f, const iso_record *spots, iso_record *image)
{
    for (int i = 0; i < CELLS; i++) {
        double *row;
        ISO_TRY(iso_record_append(ctx, image, &row));
        for (int j = 0; j < CELLS; j++) row[j] = ISO_PICTURE_CELL_EMPTY;
    }
    for (size_t i = 0; i < iso_record_rows(spots); i++) {
        const double *s = iso_record_const_row(spots, i);
        const int cell = cell_of(f, (iso_picture_spot){s[0], s[1]});
        static const int across[] = {0, -1, 1, 0, 0}, up[] = {0, 0, 0, -1, 1};
        for (int n = 0; n < 5 && cell >= 0; n++) {
            const int x = cell % CELLS + across[n], y = cell / CELLS + up[n];
            if (x >= 0 && x < CELLS && y >= 0 && y < CELLS)
                iso_record_row(image, (size_t)y)[x] = s[2] == ISO_PICTURE_GREY   ? ISO_PICTURE_CELL_GREY
                                                      : s[2] == ISO_PICTURE_DARK ? ISO_PICTURE_CELL_DARK
                                                                                 : rounded(s[3], 0, 1);
        }
    }
    return ISO_OK;
}

/* --- the tables ------------------------------------------------------------------------------------------------- */

/* The spots of one side, and where they are. */
static iso_status find_spots(iso_context *ctx, const iso_picture_charts *c, const iso_record *crossings, bool ball,
                             frame *f, iso_record *spots)
{
    size_t count;
    double most = 0;
    spot *all = place_all(c, crossings, ball, &count);
    unsigned char *cells = calloc(CELLS, CELLS);
    iso_status status = all && cells ? ISO_OK : iso_context_no_memory(ctx, "a picture");
    for (size_t i = 0; all && i < count; i++) most = fmax(most, fabs(all[i].at.up));
    *f = frame_of(c, ball, most);
    if (status == ISO_OK) status = add_spots(ctx, c, f, all, count, cells, spots);
    free(cells);
    free(all);
    return status;
}

/* The table of one side: its spots, or their image; the ends and the names of its axes. */
static iso_status add_side(iso_context *ctx, const iso_picture_charts *c, const frame *f, const iso_record *spots,
                           bool ball, bool image, iso_picture *picture)
{
    static const char *const keys[2][4] = {
        {"point_x0 point_x1 point_y0 point_y1", "point_title", "point_right", "point_up"},
        {"ball_x0 ball_x1 ball_y0 ball_y1", "ball_title", "ball_right", "ball_up"}};
    const char *const *key = keys[ball], *const *index = iso_picture_index + c->axis, *n = ball ? "n" : "γ",
                      *angle = ball ? "ψ" : "l";
    const double ends[] = {f->low[0], f->high[0], f->low[1], f->high[1]};
    const size_t rows = iso_record_rows(spots);
    char columns[4 * CELLS] = "right up shade colour";
    iso_record *table;
    for (int i = 0, used = 0; image && i < CELLS; i++)
        used += snprintf(columns + used, sizeof columns - (size_t)used, "%d ", i + 1);
    ISO_TRY(iso_picture_add(ctx, picture, ball ? "ball" : "point", columns, &table));
    ISO_TRY(iso_picture_set(ctx, picture, key[0], ends));
    if (image) ISO_TRY(add_image(ctx, f, spots, table));
    if (!image && rows > 0) ISO_TRY(iso_record_add(ctx, table, rows, iso_record_const_row(spots, 0)));
    ISO_TRY(iso_picture_line(ctx, picture, key[1], "%s: %s%s = 0, %s%s increasing",
                             ball         ? "ball"
                             : c->eps > 0 ? "point"
                                          : "directions of γ and M",
                             n, index[0], n, index[0]));
    ISO_TRY(iso_picture_line(ctx, picture, key[2], "%s,  where %s%s = cos %s, %s%s = −sin %s", angle, n, index[1],
                             angle, n, index[2], angle));
    if (ball) return iso_picture_line(ctx, picture, key[3], "ω%s / |ω|", index[0]);
    return c->eps > 0 ? iso_picture_line(ctx, picture, key[3], "L = M%s, in the units of the scene", index[0])
                      : iso_picture_line(ctx, picture, key[3], "x = M%s / |M|", index[0]);
}

iso_status iso_picture_charts_add(iso_context *ctx, const iso_picture_charts *c, const iso_record *crossings,
                                  iso_picture *picture)
{
    iso_record *boundary, **spots[2]; /* the ball's, the point's */
    double low = INFINITY, high = -INFINITY;
    frame f[2];
    bool image = false;
    for (int i = 0; i < 2; i++) {
        spots[i] = iso_picture_aside(picture);
        ISO_TRY(iso_record_create(ctx, 4, (const char *const[]){"right", "up", "shade", "colour"}, spots[i]));
        ISO_TRY(find_spots(ctx, c, crossings, i == 0, &f[i], *spots[i]));
        image = image || (c->points > 0 && iso_record_rows(*spots[i]) > c->points);
    }
    for (int i = 0; i < 2; i++) ISO_TRY(add_side(ctx, c, &f[i], *spots[i], i == 0, image, picture));
    ISO_TRY(iso_picture_set(ctx, picture, "images window few", (double[]){image, c->windowed, c->few}));
    for (size_t i = 0; !c->few && i < iso_record_rows(crossings); i++) { /* the scale of the rotation numbers */
        const double *row = iso_record_const_row(crossings, i), x = row[ISO_PICTURE_COLOUR];
        if (row[ISO_PICTURE_SHADE] == ISO_PICTURE_COLOURED) low = fmin(low, x), high = fmax(high, x);
    }
    const bool bar = low <= high; /* else there are none, or the colours are hues */
    if (bar && high - low < 1e-3) low -= 5e-4, high += 5e-4;
    ISO_TRY(iso_picture_set(ctx, picture, "bar low high", (double[]){bar, bar ? low : 0, bar ? high : 1}));
    ISO_TRY(iso_picture_add(ctx, picture, "boundary", "l low high", &boundary));
    for (int i = 0; i <= BOUNDARY; i++) {
        const double l = M_PI * (2.0 * i / BOUNDARY - 1), G = largest_momentum(c, l);
        ISO_TRY(iso_record_add(ctx, boundary, 1, (double[]){l, -G, G}));
    }
    return ISO_OK;
}

/* maps.c - scales of pictures of sweeps, and the cells of their maps (see maps_impl.h). */
#include "picture/maps_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- scales ----------------------------------------------------------------------------------------------------- */

int iso_picture_by_size(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return (*one > *other) - (*one < *other);
}

/* The finite numbers of a column, or their sizes without 0, in order. */
static iso_status sort_column(iso_context *ctx, iso_picture *picture, const iso_record *r, int column, bool sizes,
                              double **numbers, size_t *count)
{
    iso_record **sorted = iso_picture_aside(picture);
    ISO_TRY(iso_record_create(ctx, 1, (const char *const[]){"at"}, sorted));
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double x = iso_picture_at(r, i, column), here = sizes ? fabs(x) : x;
        if (isfinite(x) && !(sizes && x == 0)) ISO_TRY(iso_record_add(ctx, *sorted, 1, &here));
    }
    *count = iso_record_rows(*sorted);
    *numbers = *count > 0 ? iso_record_row(*sorted, 0) : NULL;
    if (*count > 0) qsort(*numbers, *count, sizeof(double), iso_picture_by_size);
    return ISO_OK;
}

/* Sizes are drawn if a tenth of them are smaller than the largest by 1e4, or by 1e3 if there are both signs. One
 * small number does not count: every smooth function that changes its sign has one. */
iso_status iso_picture_spread_of(iso_context *ctx, iso_picture *picture, const iso_record *r, int column,
                                 iso_picture_spread *s)
{
    double *size;
    size_t count;
    *s = (iso_picture_spread){.low = INFINITY, .high = -INFINITY};
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double x = iso_picture_at(r, i, column);
        if (isfinite(x)) s->low = fmin(s->low, x), s->high = fmax(s->high, x);
    }
    ISO_TRY(sort_column(ctx, picture, r, column, true, &size, &count));
    if (count == 0) return ISO_OK;
    s->least = size[0];
    s->sizes = size[count - 1] > (s->low < 0 && s->high > 0 ? 1e3 : 1e4) * size[count / 10];
    return ISO_OK;
}

/* Ratios that differ by little, steps that differ by much. */
static bool grows_by_ratios(const iso_picture_scale *s)
{
    double ratios[2] = {INFINITY, 0}, steps[2] = {INFINITY, 0}; /* least and largest */
    if (s->count < 4 || !(s->at[0] > 0)) return false;
    for (size_t i = 1; i < s->count; i++) {
        const double last = s->at[i - 1], here = s->at[i];
        ratios[0] = fmin(ratios[0], log(here / last)), ratios[1] = fmax(ratios[1], log(here / last));
        steps[0] = fmin(steps[0], here - last), steps[1] = fmax(steps[1], here - last);
    }
    return ratios[1] < 1.2 * ratios[0] && steps[1] > 3 * steps[0];
}

iso_status iso_picture_scale_of(iso_context *ctx, iso_picture *picture, const iso_record *r, int column, bool k,
                                iso_picture_scale *s)
{
    size_t all;
    *s = (iso_picture_scale){.k = k};
    ISO_TRY(sort_column(ctx, picture, r, column, false, &s->at, &all));
    for (size_t i = 0; i < all; i++)
        if (i == 0 || s->at[i] != s->at[s->count - 1]) s->at[s->count++] = s->at[i];
    s->logarithmic = grows_by_ratios(s);
    return ISO_OK;
}

static double range_of(const iso_picture_scale *s)
{
    return s->count > 1 ? s->at[s->count - 1] - s->at[0] : 1;
}

/* --- the cells of a grid ---------------------------------------------------------------------------------------- */

/* Half way to a neighbour, but not across k = 0, and not much farther than to the other neighbour. */
static double edge_of(const iso_picture_scale *s, double x, double step, double other)
{
    const double half = (fabs(step) < 1.5 * fabs(other) ? step : copysign(1.5 * other, step)) / 2;
    return s->k && x * (x + half) < 0 ? 0 : x + half;
}

/* Of a logarithmic axis the steps are those of the logarithm. */
static void edges_of(const iso_picture_scale *s, double x, double edge[2])
{
    const double *here = bsearch(&x, s->at, s->count, sizeof x, iso_picture_by_size);
    const bool first = here == s->at, last = here == s->at + s->count - 1;
    const double left = here[first ? 0 : -1], right = here[last ? 0 : 1];
    if (s->logarithmic) {
        const double before = first ? right / x : x / left, after = last ? before : right / x;
        edge[0] = x / sqrt(before);
        edge[1] = x * sqrt(after);
        return;
    }
    const double before = first ? right - x : x - left, after = last ? x - left : right - x;
    edge[0] = edge_of(s, x, -before, after);
    edge[1] = edge_of(s, x, after, before);
}

/* --- the cells of scattered points ------------------------------------------------------------------------------ */

enum { CORNERS = 64 };
typedef struct polygon {
    double at[CORNERS][2];
    int corners;
} polygon;

/* Points in order of map and u: neighbours are near in it. */
static int by_map(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return one[ISO_POINT_MAP] != other[ISO_POINT_MAP]
               ? iso_picture_by_size(one + ISO_POINT_MAP, other + ISO_POINT_MAP)
               : iso_picture_by_size(one + ISO_POINT_U, other + ISO_POINT_U);
}

/* What is left of a polygon where (x, direction) <= most. */
static void cut(polygon *p, const double direction[2], double most)
{
    polygon left = {.corners = 0};
    for (int i = 0; i < p->corners && left.corners < CORNERS - 2; i++) {
        const double *a = p->at[i], *b = p->at[(i + 1) % p->corners];
        const double beyond[2] = {a[0] * direction[0] + a[1] * direction[1] - most,
                                  b[0] * direction[0] + b[1] * direction[1] - most};
        if (beyond[0] <= 0) memcpy(left.at[left.corners++], a, sizeof *p->at);
        if ((beyond[0] <= 0) == (beyond[1] <= 0)) continue;
        const double part = beyond[0] / (beyond[0] - beyond[1]);
        for (int c = 0; c < 2; c++) left.at[left.corners][c] = a[c] + part * (b[c] - a[c]);
        left.corners++;
    }
    *p = left;
}

/* The cell of point i: a square, cut half way to each neighbour. `mirrored`: and as far on the other side, so that the
 * cells at the rim of a lattice are as large as the others. The distance of the nearest neighbour; infinite: none. */
static double cell_of(const iso_record *points, size_t i, double half, bool mirrored, polygon *p)
{
    const double *here = iso_record_const_row(points, i), *from = here + ISO_POINT_U;
    double nearest = INFINITY;
    *p = (polygon){.corners = 4};
    for (int c = 0; c < 4; c++) {
        p->at[c][0] = from[0] + (c == 0 || c == 3 ? -half : half);
        p->at[c][1] = from[1] + (c < 2 ? -half : half);
    }
    for (int side = -1; side <= 1; side += 2)
        for (size_t j = i + (size_t)side; j < iso_record_rows(points); j += (size_t)side) {
            const double *there = iso_record_const_row(points, j);
            const double to[2] = {there[ISO_POINT_U] - from[0], there[ISO_POINT_V] - from[1]},
                         d = hypot(to[0], to[1]), middle = from[0] * to[0] + from[1] * to[1];
            double reach = 0;
            for (int c = 0; c < p->corners; c++)
                reach = fmax(reach, hypot(p->at[c][0] - from[0], p->at[c][1] - from[1]));
            if (there[ISO_POINT_MAP] != here[ISO_POINT_MAP] || fabs(to[0]) > 2 * reach) break;
            if (!(d > 0)) continue;
            nearest = fmin(nearest, d);
            cut(p, to, middle + d * d / 2);
            if (mirrored) cut(p, (double[]){-to[0], -to[1]}, -middle + d * d / 2);
        }
    return nearest;
}

/* --- all -------------------------------------------------------------------------------------------------------- */

static iso_status add_cell(iso_context *ctx, const iso_picture_maps *m, size_t i, bool sizes, const polygon *p,
                           iso_record *cells)
{
    const double *point = iso_record_const_row(m->points, i), value = point[ISO_POINT_VALUE];
    const bool missing = !isfinite(value) || (sizes && value == 0);
    for (int c = 0; c <= p->corners; c++) {
        const double *corner = p->at[c % p->corners];
        double row[] = {(double)i + 1, point[ISO_POINT_MAP],
                        missing,       missing ? (double)NAN : sizes ? fabs(value) : value,
                        corner[0],     corner[1]};
        ISO_TRY(iso_record_add(ctx, cells, 1, row));
    }
    return iso_record_add(ctx, cells, 1, (double[]){NAN, NAN, NAN, NAN, NAN, NAN});
}

static iso_status add_scattered(iso_context *ctx, const iso_picture_maps *m, bool sizes, iso_record *cells)
{
    const size_t rows = iso_record_rows(m->points);
    double least = INFINITY, half = fmin(0.5, 2 / sqrt((double)rows / m->count));
    size_t regular = 0;
    polygon p;
    for (size_t i = 0; i < rows && !m->back; i++) {
        double *row = iso_record_row(m->points, i);
        row[ISO_POINT_U] = row[ISO_POINT_X] / range_of(&m->x), row[ISO_POINT_V] = row[ISO_POINT_Y] / range_of(&m->y);
    }
    qsort(iso_record_row(m->points, 0), rows, ISO_POINT_COLUMNS * sizeof(double), by_map);
    for (size_t i = 0; i < rows; i++) least = fmin(least, cell_of(m->points, i, half, false, &p));
    for (size_t i = 0; i < rows; i++) regular += cell_of(m->points, i, half, false, &p) < 1.05 * least;
    const bool lattice = 2 * regular > rows;
    if (!lattice) half /= 2;
    if (lattice && m->back) half = least / sqrt(3); /* as far as a hexagon reaches */
    for (size_t i = 0; i < rows; i++) {
        const double *place = iso_record_const_row(m->points, i) + ISO_POINT_X;
        cell_of(m->points, i, half, lattice, &p);
        if (m->x.k) cut(&p, (double[]){place[0] > 0 ? -1 : 1, 0}, 0); /* no cell reaches across k = 0 */
        if (m->y.k) cut(&p, (double[]){0, place[1] > 0 ? -1 : 1}, 0);
        for (int c = 0; c < p.corners; c++)
            if (m->back)
                m->back((double[]){p.at[c][0], p.at[c][1]}, p.at[c]);
            else
                p.at[c][0] *= range_of(&m->x), p.at[c][1] *= range_of(&m->y);
        ISO_TRY(add_cell(ctx, m, i, sizes, &p, cells));
    }
    return ISO_OK;
}

iso_status iso_picture_cells(iso_context *ctx, const iso_picture_maps *m, bool sizes, iso_record *cells)
{
    const double rows = (double)iso_record_rows(m->points), x = (double)m->x.count, y = (double)m->y.count;
    if (!(x > 1 && y > 1 && x * y < 1.2 * fmax(1, rows / m->count))) return add_scattered(ctx, m, sizes, cells);
    for (size_t i = 0; i < iso_record_rows(m->points); i++) {
        double across[2], up[2];
        edges_of(&m->x, iso_picture_at(m->points, i, ISO_POINT_X), across);
        edges_of(&m->y, iso_picture_at(m->points, i, ISO_POINT_Y), up);
        const polygon p = {{{across[0], up[0]}, {across[1], up[0]}, {across[1], up[1]}, {across[0], up[1]}},
                           .corners = 4};
        ISO_TRY(add_cell(ctx, m, i, sizes, &p, cells));
    }
    return ISO_OK;
}

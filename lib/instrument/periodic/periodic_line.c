/* periodic_line.c - the six symmetry lines of the return map, and shots from one of them to itself.
 *
 * Between the crossings g^(p-1) z and g^p z an orbit passes a line half way if g^p z = S g^(p-1) z. So what stands
 * for the distance from the line is the middle of the two crossings, and its derivative (1 + D g)/2.
 */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "instrument/periodic/periodic_impl.h"

/* At u = 0 and u = pi/2: the axis of the rotation there, and the axis on which the point is; 0, 1, 2: a, b, c. */
static const int turns_about[LINES][2] = {{2, 1}, {2, 0}, {1, 0}, {2, 1}, {0, 2}, {0, 1}};
static const int stands_on[LINES][2] = {{1, 2}, {1, 1}, {2, 2}, {0, 0}, {2, 0}, {1, 0}};

int iso_symmetry_line_axis_at(int axis, int line, bool end)
{
    return (axis + turns_about[line][end]) % 3;
}

/* q along a line goes one way, so that the point can move up to one place, or from one on. */
bool iso_symmetry_line_range(const iso_periodic_map *map, int line, double u[2])
{
    const double *J = map->p.J, k = map->p.k;
    const double q[2] = {J[(map->axis + stands_on[line][0]) % 3], J[(map->axis + stands_on[line][1]) % 3]};
    u[0] = 0, u[1] = ISO_PI / 2;
    const bool moves[2] = {1 + map->energy * pow(q[0], 1 / k) > 0, 1 + map->energy * pow(q[1], 1 / k) > 0};
    if (moves[0] == moves[1]) return moves[0];
    const double border = pow(-map->energy, -k), part = (border - q[0]) / (q[1] - q[0]); /* sin^2 u */
    u[moves[0]] = asin(sqrt(fmin(fmax(part, 0), 1)));
    return true;
}

void iso_periodic_reverse(int reversor, const double z[2], double to[2])
{
    to[0] = reversor == 0 ? z[0] : reversor == 1 ? -z[0] : ISO_PI - z[0];
    to[1] = reversor == 0 ? -z[1] : z[1];
}

static iso_return_start start_of(int line)
{
    return line == LINE_POLE ? ISO_FROM_POLE : line == LINE_PLANE_B ? ISO_FROM_PLANE_B : ISO_FROM_PLANE_C;
}

/* --- in doubles ------------------------------------------------------------------------------------------------- */

/* The slopes are differences: they need few digits, for they only guide the search. */
static iso_status place_half_way(const iso_periodic_map *map, int line, size_t count, const double u[],
                                 double (*z)[2], double (*by_u)[2])
{
    const double h = 1e-5;
    double *near = calloc(3 * count, sizeof *near);
    iso_periodic_point *to = malloc(3 * count * sizeof *to);
    iso_status status = near && to ? ISO_OK : iso_context_no_memory(map->ctx, "the search");
    for (size_t i = 0; i < 3 * count && status == ISO_OK; i++) near[i] = u[i / 3] + h * ((double)(i % 3) - 1);
    if (status == ISO_OK) status = iso_periodic_enter_many(map, start_of(line), 3 * count, near, to);
    for (size_t i = 0; i < count && status == ISO_OK; i++) {
        const iso_periodic_point *at = &to[3 * i];
        z[i][0] = at[1].l, z[i][1] = at[1].x;
        by_u[i][0] = remainder(at[2].l - at[0].l, 2 * ISO_PI) / (2 * h);
        by_u[i][1] = (at[2].x - at[0].x) / (2 * h);
    }
    free(near);
    free(to);
    return status;
}

iso_status iso_periodic_place(const iso_periodic_map *map, int line, size_t count, const double u[], double (*z)[2],
                              double (*by_u)[2])
{
    if (iso_symmetry_line_is_half_way(line)) return place_half_way(map, line, count, u, z, by_u);
    const bool flat = line == LINE_X;
    for (size_t i = 0; i < count; i++) {
        z[i][0] = flat ? u[i] : line == LINE_0 ? 0 : ISO_PI / 2;
        z[i][1] = flat ? 0 : sin(u[i]);
        by_u[i][0] = flat ? 1 : 0;
        by_u[i][1] = flat ? 0 : cos(u[i]);
    }
    return ISO_OK;
}

double iso_periodic_miss(int line, const iso_periodic_point *before, const iso_periodic_point *at,
                         const double by_u[2], double *slope, bool *there)
{
    const double part = iso_symmetry_line_is_half_way(line) ? 1 : 0, l = at->l + part * before->l,
                 x = at->x + part * before->x;
    double image[2], change[2]; /* change: of l and x by u */
    for (int i = 0; i < 2; i++)
        change[i] = (at->slope[i][0] + part * before->slope[i][0]) * by_u[0] +
                    (at->slope[i][1] + part * before->slope[i][1]) * by_u[1];
    iso_periodic_reverse(iso_symmetry_line_reversor(line), (const double[2]){before->l, before->x}, image);
    *there = !iso_symmetry_line_is_half_way(line) ||
             (fabs(remainder(at->l - image[0], 2 * ISO_PI)) < 1e-3 && fabs(at->x - image[1]) < 1e-3);
    if (iso_symmetry_line_reversor(line) == 0) return *slope = change[1], x;
    if (line == LINE_QUARTER) return *slope = -sin(l) * change[0], cos(l);
    return *slope = cos(l) * change[0], sin(l);
}

/* --- shots ------------------------------------------------------------------------------------------------------ */

/* The crossings around the line: before and behind, with their derivatives by (u, c). On the section they are one. */
typedef struct arrival {
    const iso_wide *before, *behind;
    iso_wide (*A)[2], (*B)[2];
    iso_wide det; /* of A */
} arrival;

/* S behind = before on the line, so that K = A^-1 S B = D^-1 E D. The trace is 2 K_00. Of K_00 - 1 and K_00 + 1 the
 * smaller one has more digits. */
static void find_trace(const arrival *a, const double S[2], iso_periodic_shot *s)
{
    iso_wide part[2]; /* of (S B - A, S B + A) */
    double terms[2];
    for (int i = 0; i < 2; i++) {
        const int sign = i == 0 ? -1 : 1;
        const iso_wide l = S[0] * a->B[0][0] + sign * a->A[0][0], x = S[1] * a->B[1][0] + sign * a->A[1][0];
        part[i] = 2 * (a->A[1][1] * l - a->A[0][1] * x) / a->det;
        terms[i] = 2 * (double)((WIDE_ABS(a->A[1][1] * l) + WIDE_ABS(a->A[0][1] * x)) / WIDE_ABS(a->det));
    }
    const int smaller = WIDE_ABS(part[0]) < WIDE_ABS(part[1]) ? 0 : 1;
    s->trace = smaller == 0 ? 2 + part[0] : part[1] - 2;
    s->terms = 2 + terms[smaller];
}

static void invert(const iso_wide A[2][2], iso_wide inverse[2][2])
{
    const iso_wide det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
    inverse[0][0] = A[1][1] / det, inverse[0][1] = -A[0][1] / det;
    inverse[1][0] = -A[1][0] / det, inverse[1][1] = A[0][0] / det;
}

/* s->back = R first^-1 E, E the derivative of the line's reversor S. From the section the way back is S g^-p S: R = E,
 * first = D g^p. Half way z = g S z, so that g^p at S g^(p-1) z is g S g^(1-p) S: R = D(g S), first = D g^(p-1). */
static void find_back(int line, const iso_wide R[2][2], const iso_wide first[2][2], iso_periodic_shot *s)
{
    const int over = iso_symmetry_line_reversor(line) == 0;
    iso_wide inverse[2][2];
    invert(first, inverse);
    iso_wide_multiply(R, (const iso_wide(*)[2])inverse, s->back);
    for (int i = 0; i < 2; i++) s->back[i][over] = -s->back[i][over];
}

static void arrive(int line, const arrival *a, iso_periodic_shot *s)
{
    const int reversor = iso_symmetry_line_reversor(line),
              odd = reversor == 0 ? 1 : 0; /* which of l, x it turns over */
    const double S[2] = {odd == 0 ? -1 : 1, odd == 1 ? -1 : 1};
    for (int i = 0; i < 2; i++) {
        s->miss[i] = a->behind[i] - S[i] * a->before[i];
        s->miss_by_u[i] = a->B[i][0] - S[i] * a->A[i][0];
    }
    s->miss[0] = iso_wide_wrap(s->miss[0] - (reversor == 2 ? WIDE_PI : 0), 2 * WIDE_PI);
    for (int j = 0; j < 2; j++) {
        s->D[0][j] = (a->A[1 - odd][j] + a->B[1 - odd][j]) / 2;
        s->D[1][j] = (a->A[odd][j] + a->B[odd][j]) / 2;
    }
    const iso_wide middle = (a->before[odd] + a->behind[odd]) / 2;
    s->off = odd == 1 ? middle : iso_wide_wrap(middle - (reversor == 1 ? 0 : WIDE_PI / 2), WIDE_PI);
    find_trace(a, S, s);
}

static bool shoot_from_section(const iso_periodic_map *map, const iso_return_build *code, int line, int period,
                               iso_periodic_shot *s)
{
    const bool flat = line == LINE_X;
    s->z[0] = flat ? s->u : line == LINE_0 ? 0 : WIDE_PI / 2;
    s->z[1] = flat ? 0 : WIDE_SIN(s->u);
    if (!(WIDE_ABS(s->z[1]) < 1) || !iso_periodic_far(map, code, s->z, period, s->path, &s->half)) return false;
    const iso_wide stretch = flat ? 1 : WIDE_COS(s->u), law = iso_periodic_determinant(map, s->z[0], s->half.to[0]);
    iso_wide A[2][2];
    for (int i = 0; i < 2; i++) {
        A[i][0] = s->half.slope[i][flat ? 0 : 1] * stretch;
        A[i][1] = s->half.slope[i][flat ? 1 : 0];
    }
    arrive(line, &(arrival){s->half.to, s->half.to, A, A, flat ? law : -law * stretch}, s);
    const iso_wide E[2][2] = {{flat ? 1 : -1, 0}, {0, flat ? -1 : 1}};
    find_back(line, E, (const iso_wide(*)[2])s->half.slope, s);
    memcpy(s->clock, s->half.clock, sizeof s->clock);
    return true;
}

/* in: from the line to z; before: from z to the last crossing before the line at the end; last: from there on. */
static bool shoot_from_half_way(const iso_periodic_map *map, const iso_return_build *code, int line, int period,
                                iso_periodic_shot *s)
{
    iso_periodic_fine in, before, last;
    iso_wide A[2][2], B[2][2], from_u[2][2], R[2][2];
    if (!iso_periodic_enter(map, code, start_of(line), s->u, &in)) return false;
    memcpy(s->z, in.to, sizeof s->z);
    if (!iso_periodic_far(map, code, s->z, period - 1, s->path, &before)) return false;
    if (!iso_periodic_far(map, code, before.to, 1, s->path + period - 1, &last)) return false;
    iso_wide_multiply((const iso_wide(*)[2])before.slope, (const iso_wide(*)[2])in.slope, A);
    iso_wide_multiply((const iso_wide(*)[2])last.slope, (const iso_wide(*)[2])A, B);
    arrive(line, &(arrival){before.to, last.to, A, B, before.determinant * in.determinant}, s);
    iso_periodic_join(&before, &last, &s->half);
    /* D(g S) at z turns over c, and leaves u as it is */
    const iso_wide turned[2][2] = {{in.slope[0][0], -in.slope[0][1]}, {in.slope[1][0], -in.slope[1][1]}};
    invert((const iso_wide(*)[2])in.slope, from_u);
    iso_wide_multiply(turned, (const iso_wide(*)[2])from_u, R);
    find_back(line, (const iso_wide(*)[2])R, (const iso_wide(*)[2])before.slope, s);
    for (int c = 0; c < ISO_CLOCKS; c++) s->clock[c] = in.clock[c] + before.clock[c] + last.clock[c] / 2;
    return true;
}

bool iso_periodic_shoot(const iso_periodic_map *map, const iso_return_build *code, int line, iso_wide u, int period,
                        iso_periodic_shot *shot)
{
    shot->u = u;
    if (iso_symmetry_line_is_half_way(line)) return shoot_from_half_way(map, code, line, period, shot);
    return shoot_from_section(map, code, line, period, shot);
}

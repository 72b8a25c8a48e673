/* section_rotation.c - the rotation number of an orbit from its crossings (see section_impl.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "instrument/section/section_impl.h"

/* Of a scale from 0 to 1/2 a 250th part is not seen. */
#define CLOSE 2e-3
#define STEADY 1e-2
enum { LEAST = 24 /* crossings */ };

static int by_size(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return (*one > *other) - (*one < *other);
}

/* The angle in the middle of the largest arc without one of the angles, and the length of this arc. The angles are
 * put in order. */
static double widest_gap(double angle[], size_t count, double *length)
{
    double middle = 0;
    for (size_t i = 0; i < count; i++) angle[i] -= 2 * M_PI * floor(angle[i] / (2 * M_PI));
    qsort(angle, count, sizeof *angle, by_size);
    *length = 0;
    for (size_t i = 0; i < count; i++) {
        const double next = i + 1 < count ? angle[i + 1] : angle[0] + 2 * M_PI;
        if (next - angle[i] > *length) *length = next - angle[i], middle = (next + angle[i]) / 2;
    }
    return middle;
}

/* The weighted Birkhoff average of the steps: it converges faster than any power of their number, if the orbit is
 * regular. The steps are angles; they are counted from `cut`, which none is near. In turns. */
static double average(const double angle[], size_t from, size_t to, double cut)
{
    double sum = 0, weights = 0;
    for (size_t i = from; i + 1 < to; i++) {
        const double weight = iso_smooth_weight((double)(i + 1 - from) / (double)(to - from));
        const double step = (angle[i + 1] - angle[i] - cut) / (2 * M_PI);
        sum += weight * (step - floor(step));
        weights += weight;
    }
    return sum / weights + cut / (2 * M_PI);
}

/* How much the angles turn from one to the next, from 0 to 1/2, as the mirror image of an orbit turns the other way;
 * NaN if both halves do not tell the same. `work` has the same room. */
static double rotation_of(const double angle[], size_t count, double work[])
{
    double gap;
    for (size_t i = 0; i + 1 < count; i++) work[i] = angle[i + 1] - angle[i];
    const double cut = widest_gap(work, count - 1, &gap);
    if (gap < 0.05) return NAN; /* the steps are of all sizes */
    const double halves[] = {average(angle, 0, count / 2, cut), average(angle, count / 2, count, cut)};
    const double turns = average(angle, 0, count, cut);
    return fabs(halves[0] - halves[1]) < CLOSE ? fabs(turns - nearbyint(turns)) : (double)NAN;
}

/* Angles about the centre of crossings that keep to a part of the circle of l, in units of their spread. */
static void turn_to_centre(const double (*z)[2], size_t count, double angle[])
{
    double mean[3] = {0, 0, 0}, spread[2] = {0, 0};
    for (size_t i = 0; i < count; i++) mean[0] += cos(z[i][0]), mean[1] += sin(z[i][0]), mean[2] += z[i][1];
    const double centre = atan2(mean[1], mean[0]), x = mean[2] / (double)count;
    double l = 0;
    for (size_t i = 0; i < count; i++) l += remainder(z[i][0] - centre, 2 * M_PI) / (double)count;
    for (size_t i = 0; i < count; i++) {
        spread[0] = fmax(spread[0], fabs(remainder(z[i][0] - centre, 2 * M_PI) - l));
        spread[1] = fmax(spread[1], fabs(z[i][1] - x));
    }
    for (size_t i = 0; i < count; i++)
        angle[i] = atan2((z[i][1] - x) * spread[0], (remainder(z[i][0] - centre, 2 * M_PI) - l) * spread[1]);
}

/* Of a regular orbit the weighted averages of any smooth number over both halves are almost the same. Of a chaotic one
 * they differ, even where its mean turn is by chance the same in both halves. */
static bool is_steady(const double (*z)[2], size_t count)
{
    double sum[2][2] = {{0, 0}, {0, 0}}, weights = 0;
    const size_t half = count / 2;
    for (size_t i = 0; i < half; i++) {
        const double weight = iso_smooth_weight((double)(i + 1) / (double)(half + 1));
        weights += weight;
        for (int h = 0; h < 2; h++) {
            const double *at = z[i + (h ? count - half : 0)];
            sum[h][0] += weight * cos(2 * at[0]);
            sum[h][1] += weight * at[1];
        }
    }
    return fmax(fabs(sum[0][0] - sum[1][0]), fabs(sum[0][1] - sum[1][1])) < STEADY * weights;
}

double iso_section_rotation(const double (*z)[2], size_t count)
{
    double *angle = count < LEAST || !is_steady(z, count) ? NULL : malloc(2 * count * sizeof *angle), gap;
    if (!angle) return NAN;
    for (size_t i = 0; i < count; i++) angle[i] = z[i][0];
    double rotation = rotation_of(angle, count, angle + count);
    memcpy(angle + count, angle, count * sizeof *angle);
    widest_gap(angle + count, count, &gap);
    if (rotation < CLOSE && gap > 0.3) { /* it does not go around the axis */
        turn_to_centre(z, count, angle);
        rotation = rotation_of(angle, count, angle + count);
    }
    free(angle);
    return rotation;
}

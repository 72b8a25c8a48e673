/* quarter.c - angles with a given density (quarter_impl.h). */
#include "map/quarter_impl.h"

#include <math.h>

#include "base/pi_impl.h"

#define STEP 0.5
#define FIRST (-ISO_QUARTER_STEPS * STEP / 2)

/* Adds the integrals of both densities from u to u + length. */
static void integrate(void (*density)(const void *, double, double, double[2]), const void *data, double u,
                      double length, double sum[2])
{
    static const double node[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    static const double weight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    for (int i = 0; i < 8; i++) {
        const double at = u + length / 2 * (1 + (i < 4 ? node[i] : -node[i - 4])), e = exp(2 * at);
        double value[2];
        density(data, e / (1 + e), 1 / (1 + e), value);
        for (int j = 0; j < 2; j++) sum[j] += length / 2 * weight[i % 4] * value[j];
    }
}

void iso_quarter_tabulate(void (*density)(const void *data, double sin2, double cos2, double value[2]),
                          const void *data, double *part[2])
{
    part[0][0] = part[1][0] = 0;
    for (int i = 0; i < ISO_QUARTER_STEPS; i++) {
        double sum[2] = {part[0][i], part[1][i]};
        integrate(density, data, FIRST + STEP * i, STEP, sum);
        part[0][i + 1] = sum[0];
        part[1][i + 1] = sum[1];
    }
}

static double table(const iso_quarter *q, int i)
{
    return q->part[0][i] + q->mix * q->part[1][i];
}

/* The u up to which the integral is `part` of the whole, by Newton's method inside a bracket. Each step integrates
 * only over its own length. */
static double invert(const iso_quarter *q, double part)
{
    const double wanted = part * table(q, ISO_QUARTER_STEPS);
    int low = 0, high = ISO_QUARTER_STEPS;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (table(q, middle) <= wanted)
            low = middle;
        else
            high = middle;
    }
    double left = FIRST + STEP * low, right = left + STEP, u = left, sum[2] = {q->part[0][low], q->part[1][low]};
    double next = left + STEP * (wanted - table(q, low)) / (table(q, high) - table(q, low));
    for (int i = 0; i < 60 && fabs(next - u) > 1e-14; i++) {
        integrate(q->density, q->data, u, next - u, sum);
        u = next;
        const double error = sum[0] + q->mix * sum[1] - wanted, e = exp(2 * u);
        double value[2];
        if (error > 0)
            right = u;
        else
            left = u;
        q->density(q->data, e / (1 + e), 1 / (1 + e), value);
        next = u - error / (value[0] + q->mix * value[1]);
        if (!(next >= left && next <= right)) next = (left + right) / 2;
    }
    return next;
}

double iso_quarter_angle(const iso_quarter *q, double part)
{
    const int quarter = (int)(4 * part);
    const double f = 4 * part - quarter, angle = atan(exp(invert(q, quarter % 2 ? 1 - f : f)));
    const double turned[] = {angle, ISO_PI - angle, angle - ISO_PI, -angle};
    return turned[quarter];
}

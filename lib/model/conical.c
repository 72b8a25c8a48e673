#include "model/conical.h"

#include <math.h>

/* Indices of b in ascending order. */
static void sort(const double b[3], int order[3])
{
    for (int i = 0; i < 3; i++) order[i] = i;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < 2; i++)
            if (b[order[i]] > b[order[i + 1]]) {
                const int swap = order[i];
                order[i] = order[i + 1];
                order[i + 1] = swap;
            }
}

/* Measured from the middle one, z = b2 + x, the roots straddle 0:
 *
 *     x^2 + B x - a c x2^2 = 0,   a = b2 - b1,  c = b3 - b2,  B = a (x2^2 + x3^2) - c (x1^2 + x2^2),
 *
 * so the quadratic formula cancels nothing. The distances from b1 and b3, which (13) and A(z) need and which a
 * difference would lose near the coordinate planes, come from (13) itself, e.g. (z1 - b1)(z2 - b1) = x1^2 a (a + c). */
void iso_conical_from_vector(const double b[3], const double x[3], const double velocity[3], iso_conical *out)
{
    int o[3];
    sort(b, o);
    const double a = b[o[1]] - b[o[0]], c = b[o[2]] - b[o[1]];
    const double x1 = x[o[0]] * x[o[0]], x2 = x[o[1]] * x[o[1]], x3 = x[o[2]] * x[o[2]];
    const double B = a * (x2 + x3) - c * (x1 + x2), gap = sqrt(B * B + 4 * a * c * x2); /* z2 - z1 */
    const double far = -(B + copysign(gap, B)) / 2, near = far == 0 ? 0 : -a * c * x2 / far;
    const double root[2] = {fmin(far, near), fmax(far, near)};
    for (int r = 0; r < 2; r++) {
        out->z[r] = b[o[1]] + root[r];
        out->above[r][o[1]] = root[r];
        out->rate[r] = 0;
    }
    out->above[1][o[0]] = a + root[1];
    out->above[0][o[2]] = root[0] - c;
    out->above[0][o[0]] = out->above[1][o[0]] > 0 ? x1 * a * (a + c) / out->above[1][o[0]] : 0;
    out->above[1][o[2]] = out->above[0][o[2]] < 0 ? x3 * c * (a + c) / out->above[0][o[2]] : 0;
    if (!velocity || gap == 0) return;
    const double d1 = 2 * x[o[0]] * velocity[o[0]], d2 = 2 * x[o[1]] * velocity[o[1]],
                 d3 = 2 * x[o[2]] * velocity[o[2]];
    const double dB = a * (d2 + d3) - c * (d1 + d2);
    /* each from the nearer of the two ends of its interval, where its terms are as small as itself */
    out->rate[0] = out->above[0][o[0]] < -root[0] ? (a * (a + c) * d1 + dB * out->above[0][o[0]]) / gap
                                                  : (a * c * d2 - dB * root[0]) / -gap;
    out->rate[1] = -out->above[1][o[2]] < root[1] ? -(c * (a + c) * d3 + dB * out->above[1][o[2]]) / gap
                                                  : (a * c * d2 - dB * root[1]) / gap;
}

void iso_conical_to_squares(const double b[3], const double z[2], double squares[3])
{
    for (int i = 0; i < 3; i++) {
        const double bj = b[(i + 1) % 3], bl = b[(i + 2) % 3];
        squares[i] = (b[i] - z[0]) * (b[i] - z[1]) / ((b[i] - bj) * (b[i] - bl));
    }
}

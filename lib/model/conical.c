/* conical.c - sphero-conical coordinates of a vector: from a vector to its two angles, and back (conical_impl.h). */
#include "model/conical_impl.h"

#include <math.h>
#include <stdbool.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"

/* --- twofold numbers: high + low, some 105 bits ----------------------------------------------------------------- */

typedef struct twofold {
    double high, low;
} twofold;

static twofold sum(twofold x, twofold y)
{
    double lost;
    const double s = iso_two_sum(x.high, y.high, &lost), low = lost + (x.low + y.low), high = s + low;
    return (twofold){high, low - (high - s)};
}

static twofold difference(twofold x, twofold y)
{
    return sum(x, (twofold){-y.high, -y.low});
}

static twofold product(twofold x, twofold y)
{
    const double p = x.high * y.high;
    return (twofold){p, fma(x.high, y.high, -p) + (x.high * y.low + x.low * y.high)};
}

/* --- the axes --------------------------------------------------------------------------------------------------- */

/* The b in ascending order, kappa^2 = (b2 - b1)/(b3 - b1) and kappa'^2 = 1 - kappa^2. */
typedef struct axes {
    int axis[3];
    double b[3], range, kappa, kappa1;
    twofold low, high; /* b2 - b1, b3 - b2 */
} axes;

static axes sort_axes(const double b[3])
{
    axes a;
    sort_by(b, a.axis);
    for (int i = 0; i < 3; i++) a.b[i] = b[a.axis[i]];
    a.low = difference((twofold){a.b[1], 0}, (twofold){a.b[0], 0});
    a.high = difference((twofold){a.b[2], 0}, (twofold){a.b[1], 0});
    a.range = a.low.high + a.high.high;
    a.kappa = a.range > 0 ? sqrt(a.low.high / a.range) : 0;
    a.kappa1 = a.range > 0 ? sqrt(a.high.high / a.range) : 1;
    return a;
}

/* --- vector and angles ------------------------------------------------------------------------------------------ */

/* (z2 - b1), (b3 - z1), (z2 - z1), each the root of it over b3 - b1, and the unit vector along (kappa cos phi,
 * kappa' cos psi), which at an umbilic is a matter of choice. */
typedef struct distances {
    double above, below, gap, xi, eta;
} distances;

static distances distances_of(const axes *a, const iso_conical *c)
{
    const double x = a->kappa * c->cosine[0], y = a->kappa1 * c->cosine[1];
    distances d = {.above = hypot(a->kappa, y), .below = hypot(a->kappa1, x), .gap = hypot(x, y)};
    d.xi = d.gap > 0 ? x / d.gap : a->kappa > 0 ? copysign(1, c->cosine[0]) : 0;
    d.eta = d.gap > 0 ? y / d.gap : a->kappa > 0 ? 0 : 1;
    return d;
}

/* kappa^2 cos^2 phi - kappa'^2 cos^2 psi = (2 b2 - z1 - z2)/(b3 - b1) times |x|^2, which next to an umbilic cancels:
 * [(b2 - b1)(x2^2 + x3^2) - (b3 - b2)(x1^2 + x2^2)]/(b3 - b1) */
static double imbalance(const axes *a, const double x[3])
{
    twofold square[3];
    for (int i = 0; i < 3; i++) square[i] = product((twofold){x[i], 0}, (twofold){x[i], 0});
    const twofold first = product(a->low, sum(square[1], square[2]));
    const twofold last = product(a->high, sum(square[0], square[1]));
    return a->range > 0 ? difference(first, last).high / a->range : 0;
}

/* kappa^2 cos^2 phi and -kappa'^2 cos^2 psi are the roots of t^2 - imbalance t - (kappa kappa' x2)^2. The larger one
 * is a sum, the other follows from cos phi cos psi = x2. With two equal b they are the cosines of latitude and
 * longitude. */
static void find_cosines(const axes *a, const double x[3], double length, iso_conical *c)
{
    const double balance = imbalance(a, x) / length / length, middle = fabs(x[1]) / length;
    const double root = hypot(balance, 2 * a->kappa * a->kappa1 * middle), square = (fabs(balance) + root) / 2;
    const bool first = balance > 0 || a->kappa1 == 0, sphere = a->kappa == 0 || a->kappa1 == 0;
    const double larger =
        sphere ? hypot(x[1], x[first ? 2 : 0]) / length : sqrt(square) / (first ? a->kappa : a->kappa1);
    const double other = larger > 0 ? middle / larger : sphere ? 1 : 0;
    c->cosine[0] = copysign(first ? larger : other, x[1]);
    c->cosine[1] = first ? other : larger;
}

/* x, and the unit vectors along dx/dphi and dx/dpsi, orthogonal to it and to each other */
static void find_frame(const axes *a, const iso_conical *c, double x[3], double along_phi[3], double along_psi[3])
{
    const distances d = distances_of(a, c);
    const double first = a->kappa > 0 ? d.xi * (d.above / a->kappa) : c->cosine[0];   /* cos phi above/gap */
    const double last = a->kappa1 > 0 ? d.eta * (d.below / a->kappa1) : c->cosine[1]; /* cos psi below/gap */
    const double sines = c->sine[0] * c->sine[1];
    x[0] = c->sine[0] * d.above;
    x[1] = c->cosine[0] * c->cosine[1];
    x[2] = c->sine[1] * d.below;
    along_phi[0] = first * d.below;
    along_phi[1] = -c->sine[0] * last;
    along_phi[2] = -a->kappa * d.xi * sines;
    along_psi[0] = -a->kappa1 * d.eta * sines;
    along_psi[1] = -c->sine[1] * first;
    along_psi[2] = last * d.above;
}

static void find_distances(const axes *a, iso_conical *c)
{
    const distances d = distances_of(a, c);
    const int *o = a->axis;
    c->above[0][o[0]] = a->low.high * c->sine[0] * c->sine[0];
    c->above[0][o[1]] = -a->low.high * c->cosine[0] * c->cosine[0];
    c->above[0][o[2]] = -a->range * d.below * d.below;
    c->above[1][o[0]] = a->range * d.above * d.above;
    c->above[1][o[1]] = a->high.high * c->cosine[1] * c->cosine[1];
    c->above[1][o[2]] = -a->high.high * c->sine[1] * c->sine[1];
    c->gap = a->range * d.gap * d.gap;
    for (int r = 0; r < 2; r++) {
        const int nearer = fabs(c->above[r][o[r]]) < fabs(c->above[r][o[r + 1]]) ? r : r + 1;
        c->z[r] = a->b[nearer] + c->above[r][o[nearer]];
    }
    c->length[0] = d.below > 0 ? d.gap / d.below : 1;
    c->length[1] = d.above > 0 ? d.gap / d.above : 1;
}

void iso_conical_from_vector(const double b[3], const double x[3], const double velocity[3], iso_conical *c)
{
    const axes a = sort_axes(b);
    const double range[2] = {a.low.high, -a.high.high};
    double sorted[3], unused[3], along[2][3];
    for (int i = 0; i < 3; i++) {
        sorted[i] = x[a.axis[i]];
        c->b[i] = a.b[i];
        c->axis[i] = a.axis[i];
    }
    const double length = norm(sorted);
    find_cosines(&a, sorted, length, c);
    const distances d = distances_of(&a, c);
    c->sine[0] = d.above > 0 ? sorted[0] / length / d.above : copysign(0, sorted[0]);
    c->sine[1] = d.below > 0 ? sorted[2] / length / d.below : copysign(0, sorted[2]);
    find_frame(&a, c, unused, along[0], along[1]);
    find_distances(&a, c);
    for (int r = 0; r < 2; r++) {
        c->speed[r] = 0;
        for (int i = 0; velocity && i < 3; i++) c->speed[r] += along[r][i] * velocity[a.axis[i]];
        c->rate[r] = c->length[r] > 0 ? 2 * range[r] * c->sine[r] * c->cosine[r] * c->speed[r] / c->length[r] : 0;
    }
}

void iso_conical_to_vector(const double b[3], const iso_conical *c, double x[3], double velocity[3])
{
    const axes a = sort_axes(b);
    double sorted[3], along_phi[3], along_psi[3];
    find_frame(&a, c, sorted, along_phi, along_psi);
    for (int i = 0; i < 3; i++) {
        x[a.axis[i]] = sorted[i];
        velocity[a.axis[i]] = c->speed[0] * along_phi[i] + c->speed[1] * along_psi[i];
    }
}

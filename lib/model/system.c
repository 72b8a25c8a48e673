/* system.c - the list of the systems, their clocks, and questions about k and J (system.h). */
#include "model/model_impl.h"

#include <float.h>
#include <math.h>

#include "base/names_impl.h"
#include "base/vec3_impl.h"

const iso_system *const iso_systems[] = {&iso_system_ball, &iso_system_point, NULL};

ISO_NAMES(iso_clock_name, iso_clock, "t", "tau", "s")

iso_dimension iso_clock_dimension(iso_clock clock)
{
    static const iso_dimension dimensions[ISO_CLOCKS] = {{0, 0, -1}, {1, -1, -1}, {-2, 1, -1}};
    return dimensions[clock];
}

double iso_clock_rate(const iso_params *p, iso_clock clock, double q, double *exponent)
{
    const double half = 1 / (2 * p->k);
    double e = 0, factor = 1;
    switch (clock) {
    case ISO_CLOCK_TAU: e = 1 - half; break; /* N of (16) with g = 1/q */
    case ISO_CLOCK_S: e = 1 + half, factor = p->k * p->k / p->det_J; break;
    default: break;
    }
    if (exponent) *exponent = e;
    return e == 0 ? factor : factor * pow(q, e);
}

bool iso_params_steep(const iso_params *p)
{
    return log10(max3(p->J) / min3(p->J)) > 10 * fabs(p->k);
}

bool iso_params_symmetric(const iso_params *p, int axis)
{
    const double a = p->J[(axis + 1) % 3], b = p->J[(axis + 2) % 3];
    return fabs(a - b) <= 4 * DBL_EPSILON * fmin(a, b);
}

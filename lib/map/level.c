/* level.c - the level of the point's energy as one number (level.h). */
#include "map/level_impl.h"

#include <math.h>

static double middle(const double J[3])
{
    return fmax(fmin(J[0], J[1]), fmin(fmax(J[0], J[1]), J[2]));
}

double iso_level_energy(const iso_params *p, double level)
{
    return level == 0 ? 0 : level * pow(middle(p->J), -1 / p->k);
}

double iso_level_of(const iso_params *p, double energy)
{
    return energy == 0 ? 0 : energy * pow(middle(p->J), 1 / p->k);
}

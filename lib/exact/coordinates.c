/* coordinates.c - states in separated coordinates, the constant of separation, and where
 * the motion changes its kind. */
#include "exact/coordinates_impl.h"

#include <math.h>

#include "base/vec3_impl.h"

/* --- states ----------------------------------------------------------------------------------------------------- */

static const double *moments(const iso_params *p)
{
    return p->k == 1 ? p->inv_J : p->J;
}

void iso_separation_coordinates(const iso_params *p, const double point[ISO_STATE], iso_conical *c)
{
    double velocity[3];
    cross(point + 3, point, velocity);
    iso_conical_from_vector(moments(p), point + 3, velocity, c);
}

void iso_separation_point(const iso_params *p, const iso_conical *c, double point[ISO_STATE])
{
    double velocity[3];
    iso_conical_to_vector(moments(p), c, point + 3, velocity);
    cross(velocity, point + 3, point);
}

/* --- the constant of separation --------------------------------------------------------------------------------- */

/* R, and what it depends on */
typedef struct potential {
    bool neumann, separates;
    double b[3], eps, H;
} potential;

static potential potential_of(const iso_problem *problem, const double b[3])
{
    const double k = problem->p.k;
    const bool separates = k == -1 || (k == 1 && problem->energy == 0);
    return (potential){k == -1, separates, {b[0], b[1], b[2]}, problem->eps, problem->energy};
}

/* (R(x) - R(y))/(x - y) */
static double slope(const potential *f, double x, double y)
{
    const double *b = f->b;
    return f->neumann ? f->eps * (b[0] + b[1] + b[2] - x - y) + f->H : f->eps * (b[0] / x) * (b[1] / y) * b[2];
}

static double value(const potential *f, double z)
{
    const double *b = f->b;
    return f->neumann ? z * slope(f, z, 0) : -f->eps * (b[0] / z) * b[1] * b[2];
}

/* R(b_j) + c is R(b_j) - R(u) - speed1^2 (v - u)/2 and R(b_j) - R(v) + speed2^2 (v - u)/2; c is then taken from the
 * b_j where no terms cancel. */
double iso_separation_constant(const iso_problem *problem, const iso_conical *at, double excess[3])
{
    const potential f = potential_of(problem, at->b);
    if (!f.separates) {
        for (int j = 0; excess && j < 3; j++) excess[j] = NAN;
        return NAN;
    }
    const double *b = f.b, *u = at->above[0], *v = at->above[1];
    const int *o = at->axis;
    const double along_u = at->gap * at->speed[0] * at->speed[0] / 2,
                 along_v = at->gap * at->speed[1] * at->speed[1] / 2;
    const double from_u = -u[o[1]] * slope(&f, b[1], at->z[0]), from_v = v[o[1]] * slope(&f, b[1], at->z[1]);
    const double first = -u[o[0]] * slope(&f, b[0], at->z[0]) - along_u;
    const double last = -v[o[2]] * slope(&f, b[2], at->z[1]) + along_v;
    if (excess) {
        excess[0] = first;
        excess[1] = fabs(from_u) + along_u < fabs(from_v) + along_v ? from_u - along_u : along_v - from_v;
        excess[2] = last;
    }
    return f.neumann ? first - value(&f, b[0]) : last - value(&f, b[2]);
}

/* --- where the motion changes ----------------------------------------------------------------------------------- */

/* Motion needs R(u) <= -c <= R(v) for some u and v: -c is between R(b1) and the summit, the largest R on [b2, b3]: R is
 * concave there, so the summit is at an end, or where the slope of R is 0. */
int iso_bifurcations(const iso_problem *problem, iso_bifurcation list[ISO_MOST_BIFURCATIONS])
{
    iso_conical at;
    iso_conical_from_vector(moments(&problem->p), (const double[]){0, 0, 1}, NULL, &at); /* for b and the axes */
    const potential f = potential_of(problem, at.b);
    const double *b = f.b;
    if (!f.separates || !(f.eps > 0) || !(slope(&f, b[0], b[1]) > 0)) return 0;
    const double summit = slope(&f, b[2], b[2]) >= 0   ? b[2]
                          : slope(&f, b[1], b[1]) <= 0 ? b[1]
                                                       : (b[0] + b[1] + b[2] + f.H / f.eps) / 2;
    const double z[ISO_MOST_BIFURCATIONS] = {b[0], b[1], b[2], summit};
    int count = 0;
    for (int j = 0; j < ISO_MOST_BIFURCATIONS; j++) {
        bool known = j == 2 && slope(&f, b[0], b[2]) <= 0; /* R(b3) is not between them */
        for (int i = 0; i < count; i++) known = known || list[i].z == z[j];
        if (known) continue;
        const bool end = z[j] == b[0] || z[j] == summit;
        const iso_bifurcation one = {-value(&f, z[j]), z[j], j < 3 ? at.axis[j] : -1, !end};
        int place = count++; /* by descending c */
        for (; place > 0 && list[place - 1].c < one.c; place--) list[place] = list[place - 1];
        list[place] = one;
    }
    return count;
}

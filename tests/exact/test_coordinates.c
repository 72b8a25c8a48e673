/* Separated coordinates of point and ball: nothing is lost on the way there and back, wherever the state is; they are
 * canonical; the constant of separation; where the motion changes. */
#include "exact/coordinates_impl.h"
#include "exact/exact_impl.h"
#include "orbits.h"
#include "reduction.h"

static iso_context *ctx;
static int umbilics; /* exactly there */

/* --- there and back --------------------------------------------------------------------------------------------- */

/* 0, or 1e-3 to 1e-300, of either sign */
static double small(iso_random *random)
{
    static const int exponent[] = {3, 7, 8, 15, 16, 30, 100, 160, 300};
    const int which = (int)iso_random_uniform(random, 0, 10);
    const double size = which == 9 ? 0 : pow(10, -exponent[which]);
    return iso_random_uniform(random, -1, 1) < 0 ? -size : size;
}

/* An umbilic in the b given, or something near it. */
static void near_umbilic(const double b[3], iso_random *random, double x[3])
{
    iso_conical at;
    iso_conical_from_vector(b, x, NULL, &at);
    const double *c = at.b, range = c[2] - c[0];
    if (range == 0) return;
    x[at.axis[0]] = copysign(sqrt((c[1] - c[0]) / range), x[at.axis[0]]) * (1 + small(random));
    x[at.axis[1]] = small(random);
    x[at.axis[2]] = copysign(sqrt((c[2] - c[1]) / range), x[at.axis[2]]);
}

/* Unit vectors everywhere, and often next to coordinate planes, axes and umbilics. */
static void any_direction(const double b[3], int kind, iso_random *random, double x[3])
{
    iso_random_direction(random, x);
    for (int i = 0; i < 3; i++)
        if (kind < 7 && kind >> i & 1) x[i] *= small(random);
    if (kind >= 7) near_umbilic(b, random, x);
    make_unit(x);
}

/* Ratios of moments up to 1e6; nearly equal ones; such that umbilics are unit vectors in binary, x1 = x3; every fifth
 * body with two or three equal ones. */
static iso_params any_params(double k, int i, iso_random *random)
{
    double J[3];
    for (int j = 0; j < 3; j++) {
        J[j] = i % 10 == 1 ? 1 + j * 1e-9 : pow(10, iso_random_uniform(random, -3, 3));
        if (i % 10 == 2) J[j] = k == 1 ? 1.0 / (1 + (i + j) % 3) : 1 + (i + j) % 3;
    }
    if (i % 5 == 4) J[i % 3] = J[(i + 1) % 3];
    if (i % 25 == 4) J[0] = J[1] = J[2];
    return laws_params(k, J);
}

typedef void forward(const iso_params *, const double y[], iso_conical *);
typedef void backward(const iso_params *, const iso_conical *, double y[]);

/* Each component of the unit vector keeps its digits, and the sign of a zero; the other vector those of its size. */
static void note_round_trip(const iso_params *p, const double y[ISO_STATE], forward *forth, backward *back,
                            laws_worst *worst)
{
    iso_conical s;
    double z[ISO_STATE];
    forth(p, y, &s);
    iso_conical kept = {.sine = {s.sine[0], s.sine[1]}, .cosine = {s.cosine[0], s.cosine[1]}};
    copy(s.speed, kept.speed, 2);
    back(p, &kept, z);
    for (int i = 0; i < 3; i++) {
        laws_note(worst, fabs(z[3 + i] - y[3 + i]), 6 * DBL_EPSILON * fabs(y[3 + i]) + DBL_TRUE_MIN, p, "unit");
        laws_note(worst, signbit(z[3 + i]) != signbit(y[3 + i]), 0.5, p, "octant");
        laws_note(worst, fabs(z[i] - y[i]), 12 * DBL_EPSILON * norm(y), p, "fast");
    }
    for (int i = 0; i < 2; i++)
        laws_note(worst, fabs(hypot(s.sine[i], s.cosine[i]) - 1), 6 * DBL_EPSILON, p, "angle");
    umbilics += s.gap == 0 && s.b[0] < s.b[1] && s.b[1] < s.b[2];
}

static void check_round_trips(void)
{
    static const double k[] = {1, -1, 1, -1, 0.35};
    iso_random *random = iso_random_create(7);
    laws_worst point = {0}, ball = {0};
    for (int i = 0; i < 40000; i++) {
        const iso_params p = any_params(k[i % 5], i / 5, random);
        double y[ISO_STATE];
        for (int pass = 0; pass < 2; pass++) {
            any_direction(pass == 0 && p.k == 1 ? p.inv_J : p.J, i / 5 % 9, random, y + 3);
            iso_random_direction(random, y);
            for (int j = 0; j < 3; j++)
                if (i >> j & 8) y[j] *= small(random);
            if (norm(y) < 1e-3) copy((double[]){0, 0, 1}, y, 3);
            for (int j = 0; j < 2; j++) remove_along(y, y + 3);
            if (norm(y) < 1e-3) continue;
            if (pass == 0)
                note_round_trip(&p, y, iso_separation_coordinates, iso_separation_point, &point);
            else
                note_round_trip(&p, y, reduction_coordinates, reduction_ball, &ball);
        }
    }
    laws_report(&point, "point: there and back");
    laws_report(&ball, "ball: there and back");
    gsl_test(!(umbilics > 50), "%d of them on an umbilic", umbilics);
    iso_random_free(random);
}

/* --- against the reduction -------------------------------------------------------------------------------------- */

/* p_phi = p_lam dlam/dphi, p_psi = p_mu dmu/dpsi; T = (mu speed1^2 + lam speed2^2)/(2 k^2), everywhere */
static void momenta_of_ball(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    iso_conical at;
    double momenta[2], of_angles[2];
    reduction_coordinates(p, c->y, &at);
    const double T = at.z[1] * pow(at.speed[0], 2) + at.z[0] * pow(at.speed[1], 2), h = c->problem.energy;
    laws_note(worst, fabs(T / (2 * p->k * p->k) - h), 16 * DBL_EPSILON * laws_spread(p) * h, p, "T");
    if (!laws_regular(c)) return;
    reduction_momenta(p, &at, momenta);
    reduction_angle_momenta(p, &at, of_angles);
    const double range[2] = {at.b[1] - at.b[0], at.b[1] - at.b[2]}, size = hypot(of_angles[0], of_angles[1]);
    for (int r = 0; r < 2; r++) {
        const double expected = momenta[r] * 2 * range[r] * at.sine[r] * at.cosine[r];
        laws_note(worst, fabs(of_angles[r] - expected), laws_conditioning(p) * size, p, "momentum");
    }
}

/* k = 1: u = 1/mu, v = 1/lam; tan phi of the point and tan psi of the ball differ by a factor. */
static void ball_and_point(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    iso_conical of_point, of_ball;
    double point[ISO_STATE];
    iso_ball_to_point(p, c->y, point);
    iso_separation_coordinates(p, point, &of_point);
    reduction_coordinates(p, c->y, &of_ball);
    if (p->k != 1 || of_ball.b[0] == of_ball.b[1] || of_ball.b[1] == of_ball.b[2]) return;
    const double gap = fmin(of_ball.b[1] - of_ball.b[0], of_ball.b[2] - of_ball.b[1]); /* 1/J are rounded */
    const double tan_psi = fabs(of_ball.sine[1]) * sqrt(of_ball.b[1] / of_ball.b[2]);
    for (int r = 0; r < 2; r++) laws_note(worst, fabs(of_point.z[r] * of_ball.z[1 - r] - 1), 8 * DBL_EPSILON, p, "z");
    laws_note(worst, fabs(fabs(of_point.sine[0]) * of_ball.cosine[1] - tan_psi * fabs(of_point.cosine[0])),
              16 * DBL_EPSILON * of_ball.b[2] / gap, p, "angles");
}

/* --- they are canonical, and separate --------------------------------------------------------------------------- */

/* gamma in the plane of an axis where V is least, M along the axis; false: this energy does not get there */
static bool rotation(const iso_problem *f, int axis, double y[ISO_STATE])
{
    const int j = (axis + 1) % 3, l = (axis + 2) % 3, deepest = (f->p.J[j] > f->p.J[l]) == (f->p.k < 0) ? j : l;
    const double square = 2 * (f->energy + f->eps * pow(f->p.J[deepest], -1 / f->p.k));
    for (int i = 0; i < ISO_STATE; i++) y[i] = 0;
    y[axis] = sqrt(fmax(square, 0));
    y[3 + deepest] = 1;
    return square > 0;
}

static double function(const iso_problem *f, const double b[3], double z)
{
    const double sum = b[0] + b[1] + b[2];
    return f->p.k == 1 ? -f->eps * b[0] * b[1] * b[2] / z : f->eps * z * (sum - z) + f->energy * z;
}

static iso_conical separate(const iso_problem *f, const double y[])
{
    iso_conical s;
    iso_separation_coordinates(&f->p, y, &s);
    return s;
}

/* phi, psi, p_phi, p_psi */
static void canonical(const void *data, const double y[], double value[])
{
    const iso_conical s = separate(data, y);
    for (int r = 0; r < 2; r++) {
        value[r] = atan2(s.sine[r], s.cosine[r]);
        value[2 + r] = s.length[r] * s.speed[r];
    }
}

/* H = [((b3 - u) p_phi^2 + (v - b1) p_psi^2)/2 - R(v) + R(u)]/(v - u), from the two separated equations */
static void hamiltonian(const void *data, const double x[], double value[])
{
    const iso_problem *f = data;
    const double at_pole[ISO_STATE] = {0, 1, 0, 0, 0, 1};
    const iso_conical s = separate(f, at_pole);
    iso_problem level = *f;
    level.energy = 0;
    const double u = s.b[0] + (s.b[1] - s.b[0]) * pow(sin(x[0]), 2),
                 v = s.b[2] - (s.b[2] - s.b[1]) * pow(sin(x[1]), 2);
    const double T = ((s.b[2] - u) * x[2] * x[2] + (v - s.b[0]) * x[3] * x[3]) / 2;
    *value = (T - function(&level, s.b, v) + function(&level, s.b, u)) / (v - u);
}

/* dphi/ds = dH/dp_phi, dp_phi/ds = -dH/dphi, away from where an angle jumps */
static void moves_canonically(const laws_case *c, laws_worst *worst)
{
    const iso_problem *f = &c->problem;
    if (fabs(f->p.k) != 1 || !laws_regular(c)) return;
    double x[4], slope[4], H, dy[ISO_STATE];
    canonical(f, c->y, x);
    hamiltonian(f, x, &H);
    c->system->rhs(f, c->y, dy);
    const double h = laws_step(c, dy) / 16, size = norm(c->y);
    laws_slope_flow(canonical, f, 4, c, h, slope);
    for (int i = 0; i < 4; i++) {
        const double direction[4] = {i == 2, i == 3, i == 0, i == 1};
        const double step = i < 2 ? size / 1024 : 1.0 / 1024;
        double expected, angle_rate = size;
        laws_slope(hamiltonian, f, 1, 4, x, direction, step, &expected);
        if (i < 2) angle_rate = 1;
        laws_note(worst, fabs(slope[i] - (i < 2 ? 1 : -1) * expected), 1e-8 * size * angle_rate, &f->p,
                  i < 2 ? "angle" : "momentum");
    }
    laws_note(worst, fabs(H - f->energy), 64 * laws_conditioning(&f->p) * size * size, &f->p, "H");
}

/* (1/2) sum_i (b_j - b_i) M_i^2 - eps {1 | 1/(q b_j)} (b_j - b_k)(b_j - b_l) gamma_j^2, q = (gamma, b^-1 gamma) */
static double excess_of(const iso_problem *f, const iso_conical *s, const double y[ISO_STATE], int j, double *size)
{
    const bool plane = f->p.k == 1;
    const double *b = s->b, gamma = y[3 + s->axis[j]];
    long double gap[3], sum = 0, fall = f->eps * gamma * gamma, reach = 0;
    for (int i = 0; i < 3; i++) {
        const double M = y[s->axis[i]];
        gap[i] = (long double)b[j] - b[i];
        sum += gap[i] * M * M / 2;
        reach += fabsl(gap[i]) * M * M / 2;
    }
    fall *= gap[(j + 1) % 3] * gap[(j + 2) % 3] / (plane ? b[j] * dot_diag(y + 3, f->p.J, y + 3) : 1);
    *size = (double)(reach + fabsl(fall));
    return (double)(sum - fall);
}

/* c is the polynomial, excess the sums above, and both equations hold. */
static void note_constant(const iso_problem *f, const double y[ISO_STATE], laws_worst *worst)
{
    const bool plane = f->p.k == 1;
    const iso_conical at = separate(f, y);
    const double *b = at.b, *M = y, *gamma = y + 3, spread = laws_spread(&f->p);
    const double *to = plane ? f->p.inv_J : f->p.J, *under = plane ? f->p.J : f->p.inv_J;
    const double q = dot_diag(gamma, under, gamma), turning = dot_diag(M, to, M) / 2;
    const double height = plane ? (b[0] + b[1] + b[2] - dot_diag(gamma, to, gamma)) / q : -f->p.det_J * q;
    const double size = turning + f->eps * fabs(height) + b[2] * dot(M, M) / 2; /* H is known to rounding */
    double excess[3], terms;
    const double c = iso_separation_constant(f, &at, excess);
    laws_note(worst, fabs(c - (f->eps * height - turning)), 32 * DBL_EPSILON * size, &f->p, "c");
    for (int j = 0; j < 3; j++) {
        const double expected = excess_of(f, &at, y, j, &terms);
        laws_note(worst, fabs(excess[j] - expected), 64 * DBL_EPSILON * spread * terms, &f->p, "excess");
    }
    for (int r = 0; r < 2; r++) {
        const double p = at.length[r] * at.speed[r], over = r == 0 ? at.z[0] - b[2] : at.z[1] - b[0];
        laws_note(worst, fabs(function(f, b, at.z[r]) + c - over * p * p / 2), 64 * DBL_EPSILON * size * spread,
                  &f->p, r == 0 ? "u" : "v");
    }
}

/* Next to the rotation in a principal plane one excess is small, and has its digits. */
static void note_next_to_plane(const laws_case *c, const iso_problem *f, int axis, double by, laws_worst *worst)
{
    double y[ISO_STATE];
    if (!rotation(f, axis, y) || dot(y, y) < fabs(f->energy)) return; /* what is left of H after V is rounded */
    for (int i = 0; i < ISO_STATE; i++)
        if (i % 3 == axis ? i >= 3 : i < 3) y[i] += by * iso_random_normal(c->random);
    c->system->project(f, y);
    note_constant(f, y, worst);
}

/* On the level H = 0, and for k = -1 on others */
static void constant_of(const laws_case *c, laws_worst *worst)
{
    iso_problem f = c->problem;
    double y[ISO_STATE], size;
    if (fabs(f.p.k) != 1) return;
    copy(c->y, y, ISO_STATE);
    if (f.p.k == -1) scale(y, iso_random_uniform(c->random, 0.5, 2));
    make_unit(y + 3);
    if (f.p.k == -1) f.energy = c->system->energy(&f, y, &size);
    note_constant(&f, y, worst);
    for (int axis = 0; axis < 3; axis++)
        for (double by = 1e-2; by > 1e-10; by /= 100) note_next_to_plane(c, &f, axis, by, worst);
}

static void constant_elsewhere(const laws_case *c, laws_worst *worst)
{
    const iso_conical s = separate(&c->problem, c->y);
    double excess[3];
    iso_problem f = c->problem;
    if (f.p.k == 1) f.energy = 1;
    if (f.p.k == -1) return;
    laws_note(worst, isnan(iso_separation_constant(&f, &s, excess)) && isnan(excess[1]) ? 0 : 1, 0.5, &f.p, "");
    laws_note(worst, iso_bifurcations(&f, (iso_bifurcation[ISO_MOST_BIFURCATIONS]){{0}}), 0.5, &f.p, "none");
}

/* Along orbits, through coordinate planes and past umbilics; and the closed solution has the same. */
static void check_orbits(void)
{
    double worst = 0, worst_exact = 0;
    for (int i = 0; i < 8; i++) {
        const double J[2][3] = {{1.4, 2.1, 3.0}, {1.1, 4.0, 1.3}};
        orbit o = orbit_sample(ctx, &iso_system_point, i % 2 == 0 ? -1 : 1, J[i / 2 % 2], 40 + (unsigned long)i);
        const iso_conical start = separate(&o.model.problem, o.y0);
        const double c = iso_separation_constant(&o.model.problem, &start, NULL);
        iso_integrator *it =
            orbit_start(&o, iso_method_find("taylor_extended"), &(iso_method_options){.tolerance = 1e-15});
        for (int j = 1; j <= 100; j++) {
            double y[ISO_MAX_STATE];
            if (iso_integrator_at(it, 0.37 * j * o.unit, y) != ISO_OK) y[0] = NAN;
            const iso_conical s = separate(&o.model.problem, y);
            const double error = fabs(iso_separation_constant(&o.model.problem, &s, NULL) / c - 1);
            worst = error <= worst ? worst : error;
        }
        iso_integrator_free(it);
        iso_exact *exact;
        if (iso_exact_create(ctx, &o.model.problem, o.y0, (const bool[ISO_CLOCKS]){false}, &exact) != ISO_OK)
            continue;
        worst_exact = fmax(worst_exact, fabs(iso_exact_describe(exact).c / c - 1));
        iso_exact_free(exact);
    }
    gsl_test(!(worst < 1e-14), "c is constant along orbits: %.1e", worst);
    gsl_test(!(worst_exact < 1e-14), "and that of the closed solution: %.1e", worst_exact);
}

/* --- where the motion changes ----------------------------------------------------------------------------------- */

static iso_problem field_of(double k, const double J[3], double H)
{
    return (iso_problem){.p = laws_params(k, J), .eps = 1.3, .energy = H};
}

/* How far a small disturbance off the plane goes: order one when the rotation is unstable. */
static double strays(const iso_problem *f, int axis)
{
    orbit o = {.ctx = ctx, .model = {.system = &iso_system_point, .problem = *f}};
    double far = 0;
    rotation(f, axis, o.y0);
    o.y0[3 + axis] = 1e-9;
    remove_along(o.y0, o.y0 + 3);
    make_unit(o.y0 + 3);
    o.model.problem.energy = f->energy;
    orbit_clocks(&o, ISO_CLOCK_S, false, false, false);
    iso_integrator *it = orbit_start(&o, iso_method_find("taylor"), &(iso_method_options){.tolerance = 1e-13});
    for (int j = 1; j <= 400; j++) {
        double y[ISO_MAX_STATE];
        if (iso_integrator_at(it, 2 * j * o.unit, y) != ISO_OK) break;
        far = fmax(far, fabs(y[3 + axis]));
    }
    iso_integrator_free(it);
    return far;
}

/* At a double root v stays where it is. */
static double constant_at_double_root(const iso_problem *f, const iso_bifurcation *at)
{
    const double pole[ISO_STATE] = {0, 1, 0, 0, 0, 1};
    iso_conical s = separate(f, pole);
    double y[ISO_STATE];
    s.sine[1] = sqrt((s.b[2] - at->z) / (s.b[2] - s.b[1]));
    s.cosine[1] = sqrt((at->z - s.b[1]) / (s.b[2] - s.b[1]));
    s.sine[0] = 0.6, s.cosine[0] = 0.8;
    const double u = s.b[0] + (s.b[1] - s.b[0]) * 0.36;
    s.speed[0] = sqrt(2 * (f->eps * (s.b[0] + s.b[1] + s.b[2] - u - at->z) + f->energy)), s.speed[1] = 0;
    iso_separation_point(&f->p, &s, y);
    s = separate(f, y);
    return iso_separation_constant(f, &s, NULL);
}

/* Each plane where this energy can be has its value, which a rotation in it has; unstable ones are marked. */
static void check_bifurcations(const char *what, const iso_problem *f, int expected)
{
    iso_bifurcation list[ISO_MOST_BIFURCATIONS];
    const int count = iso_bifurcations(f, list);
    int planes = 0, found = 0;
    gsl_test_int(count, expected, "%s: values of c where the motion changes", what);
    for (int axis = 0; axis < 3; axis++) {
        double y[ISO_STATE];
        planes += rotation(f, axis, y);
    }
    for (int i = 0; i < count; i++) {
        if (i > 0) gsl_test(!(list[i].c < list[i - 1].c), "%s: descending", what);
        if (list[i].axis < 0) {
            gsl_test_rel(constant_at_double_root(f, &list[i]), list[i].c, 1e-14, "%s: at the double root", what);
            gsl_test(list[i].separatrix, "%s: which is an end", what);
            continue;
        }
        double y[ISO_STATE];
        found += rotation(f, list[i].axis, y);
        const iso_conical s = separate(f, y);
        gsl_test_rel(iso_separation_constant(f, &s, NULL), list[i].c, 1e-14, "%s: in a plane", what);
        gsl_test((strays(f, list[i].axis) > 1e-3) != list[i].separatrix, "%s: axis %d, %s", what, list[i].axis,
                 list[i].separatrix ? "unstable" : "stable");
    }
    gsl_test_int(found, planes, "%s: planes", what);
}

static void check_all_bifurcations(void)
{
    static const double near[3] = {2.1, 1.4, 3.0}, far[3] = {4, 1, 1.2}; /* J3 > J1 + J2 */
    const iso_problem cases[] = {field_of(1, near, 0),     field_of(-1, near, 0),    field_of(-1, far, 0),
                                 field_of(-1, near, 1.5),  field_of(-1, near, -1.5), field_of(-1, near, -2.3),
                                 field_of(-1, near, -3.5), field_of(-1, near, -4)};
    static const char *const what[] = {"k = 1",    "k = -1",   "J3 > J1 + J2", "H = 1.5",
                                       "H = -1.5", "H = -2.3", "H = -3.5",     "no motion"};
    static const int count[] = {3, 3, 4, 3, 4, 4, 2, 0};
    for (int i = 0; i < 8; i++) check_bifurcations(what[i], &cases[i], count[i]);
}

/* c of every state is between the ends, and equal moments give one value. */
static void between_ends(const laws_case *c, laws_worst *worst)
{
    const iso_problem *f = &c->problem;
    if (fabs(f->p.k) != 1) return;
    iso_bifurcation list[ISO_MOST_BIFURCATIONS];
    const int count = iso_bifurcations(f, list);
    const iso_conical s = separate(f, c->y);
    const double value = iso_separation_constant(f, &s, NULL), size = 16 * DBL_EPSILON * fabs(value);
    laws_note(worst, fmax(value - list[0].c, list[count - 1].c - value), size, &f->p, "between");
    for (int i = 1; i < count; i++) laws_note(worst, list[i].z == list[i - 1].z, 0.5, &f->p, "each once");
    for (int i = 0; i < count; i++)
        laws_note(worst, list[i].separatrix == (i == 0 || i == count - 1), 0.5, &f->p, "ends");
}

int main(void)
{
    ctx = iso_context_create();
    check_round_trips();
    laws_hold("momenta of the angles", &iso_system_ball, momenta_of_ball);
    laws_hold("u = 1/mu, v = 1/lam", &iso_system_ball, ball_and_point);
    laws_hold("canonical", &iso_system_point, moves_canonically);
    laws_hold("constant of separation", &iso_system_point, constant_of);
    laws_hold("no constant", &iso_system_point, constant_elsewhere);
    check_orbits();
    check_all_bifurcations();
    laws_hold("c between its ends", &iso_system_point, between_ends);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

/* First integrals hold where the table says so, and nowhere else; projection restores what they fix. */
#include "laws.h"

typedef struct integral_at {
    const iso_integral *integral;
    const iso_problem *problem;
} integral_at;

static void value(const void *data, const double y[], double I[])
{
    const integral_at *at = data;
    double size;
    I[0] = at->integral->value(at->problem, y, &size);
}

/* (dI/dt)/size in units of the time in which the state changes, at rest or for equal moments that of a turn at full
 * speed: the drift of I, of order one where it is none.
 * *rounding is what rounding alone makes of it. */
static double drift(const laws_case *c, const iso_integral *integral, double *rounding)
{
    const integral_at at = {integral, &c->problem};
    double f[ISO_STATE], slope, size;
    c->system->rhs(&c->problem, c->y, f);
    const double turn =
        c->system->speed(&c->problem, c->y) * (c->system == &iso_system_ball ? fabs(c->problem.p.k) : 1);
    const double h = fmin(laws_step(c, f), laws_reach(&c->problem.p) / (128 * turn));
    const double time = 128 * h / laws_reach(&c->problem.p);
    laws_slope(value, &at, 1, ISO_STATE, c->y, f, h, &slope);
    integral->value(&c->problem, c->y, &size);
    *rounding = laws_rounding(&c->problem.p) * time / h;
    return fabs(slope) * time / size;
}

static void note_holding(const laws_case *c, laws_worst *worst)
{
    for (const iso_integral *i = c->system->integrals; i->name; i++) {
        if (i->holds && !i->holds(&c->problem)) continue;
        double rounding;
        const double d = drift(c, i, &rounding);
        laws_note(worst, d, rounding, &c->problem.p, i->name);
    }
}

/* The point's integrals hold on every level: H > 0 and H < 0, at rest too. */
static void off_the_level(const laws_case *c, laws_worst *worst)
{
    static const double stretch[] = {0.3, 1.7, 0.0, 1e-3};
    for (int i = 0; i < 4; i++) {
        laws_case moved = *c;
        double size;
        scale(moved.y, stretch[i]);
        moved.problem.energy = c->system->energy(&moved.problem, moved.y, &size);
        note_holding(&moved, worst);
    }
}

/* Where an integral is not claimed it is none: it must drift by a hundredth of its size somewhere. At this k (0: at
 * any). */
static struct {
    const char *name;
    double k;
} unclaimed;

static void drifts(const laws_case *c, laws_worst *worst)
{
    double rounding;
    const iso_integral *integral = laws_integral(c->system, unclaimed.name);
    if ((unclaimed.k != 0 && c->problem.p.k != unclaimed.k) || integral->holds(&c->problem)) return;
    laws_note(worst, drift(c, integral, &rounding), 0.01, &c->problem.p, unclaimed.name);
}

static void check_unclaimed(const char *name, double k)
{
    unclaimed.name = name, unclaimed.k = k;
    laws_fail(name, NULL, drifts);
}

/* Which rows hold where: the table's conditions themselves. */
static void conditions(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    const bool holds[] = {p->k == 1, p->k == -1, p->J[1] == p->J[2], p->J[2] == p->J[0], p->J[0] == p->J[1]};
    static const char *const names[] = {"F_plane", "F_shell", "F_axis1", "F_axis2", "F_axis3"};
    for (int i = 0; i < 5; i++) {
        const iso_integral *integral = laws_integral(c->system, names[i]);
        laws_note(worst, integral->holds(&c->problem) == holds[i] ? 0 : 1, 0.5, p, names[i]);
    }
}

/* Distance of a state from the constraints and its energy; (w,n) may be off by `spin` roundings. */
static void note_restored(const laws_case *c, const double y[ISO_STATE], double spin, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    double size;
    const double energy = c->system->energy(&c->problem, y, &size);
    laws_note(worst, fabs(norm(y + 3) - 1), 2 * DBL_EPSILON, p, "unit");
    laws_note(worst, fabs(dot(y, y + 3)), spin * DBL_EPSILON * norm(y), p, "orthogonal");
    laws_note(worst, fabs(energy - c->problem.energy), 2 * laws_rounding(p) * size, p, "energy");
}

/* A state pushed off by 1e-6 ... 1e-12 comes back near where it was, with all relations restored; a second projection
 * finds nothing to do. What a push of gamma by x does to q is 2 x sqrt(max J/q), to M by q^(-1/(2k)) that / (2k). */
static void projection_restores(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    const double gain = 3 * sqrt(laws_spread(p)) * (1 + 1 / fabs(p->k));
    for (double push = 1e-6; push > 1e-13; push /= 10) {
        double y[ISO_STATE], again[ISO_STATE], direction[3];
        copy(c->y, y, ISO_STATE);
        iso_random_direction(c->random, direction);
        add_scaled(y, push * norm(c->y), direction);
        iso_random_direction(c->random, direction);
        add_scaled(y + 3, push, direction);
        const double correction = c->system->project(&c->problem, y);
        note_restored(c, y, 2, worst);
        laws_note(worst, correction, gain * push, p, "correction");
        laws_note(worst, laws_distance(y, c->y) / norm(c->y), gain * push, p, "fast moved");
        laws_note(worst, laws_distance(y + 3, c->y + 3), 2 * push, p, "unit moved");
        copy(y, again, ISO_STATE);
        laws_note(worst, c->system->project(&c->problem, again), 2 * laws_rounding(p), p, "second correction");
        laws_note(worst, laws_distance(y, again), 2 * laws_rounding(p) * norm(y), p, "fast again");
        laws_note(worst, laws_distance(y + 3, again + 3), 4 * DBL_EPSILON, p, "unit again");
    }
}

/* A part of the fast vector along the unit one, of that share of its length: a ball's as an impulse of the contact
 * gives it, along J^-1 n, a point's along gamma. */
static void add_spin(const laws_case *c, double share, double y[ISO_STATE])
{
    double along[3];
    copy(c->y + 3, along, 3);
    if (c->system == &iso_system_ball) diag(c->problem.p.inv_J, c->y + 3, along);
    add_scaled(y, share * norm(y) / dot(along, c->y + 3), along);
}

/* Each relation broken alone, by a known amount: the correction is that amount, and the state is back. */
static void correction_reported(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    static const char *const what[] = {"length", "spin", "energy"};
    const double gain = laws_spread(p) * (1 + 1 / fabs(p->k));
    for (double push = 1e-6; push > 1e-13; push /= 10)
        for (int relation = 0; relation < 3; relation++) {
            double y[ISO_STATE];
            copy(c->y, y, ISO_STATE);
            if (relation == 0) scale(y + 3, 1 + push);
            if (relation == 1) add_spin(c, push, y);
            if (relation == 2) scale(y, 1 + push);
            const double correction = c->system->project(&c->problem, y);
            laws_note(worst, fabs(correction - push), 4 * laws_rounding(p) + 2 * gain * push * push, p,
                      what[relation]);
            laws_note(worst, laws_distance(y, c->y) / norm(y), 4 * laws_rounding(p) + gain * push * push, p,
                      "fast back");
            laws_note(worst, laws_distance(y + 3, c->y + 3), 4 * DBL_EPSILON, p, "unit back");
        }
}

/* A point of the same gamma with another M, off the level H = 0; pushed off by 1e-8 in length, spin and size. */
static laws_case off_the_level_by(const laws_case *c, double stretch, double pushed[ISO_STATE])
{
    laws_case moved = *c;
    double size;
    scale(moved.y, stretch);
    moved.problem.energy = c->system->energy(&moved.problem, moved.y, &size);
    copy(moved.y, pushed, ISO_STATE);
    scale(pushed + 3, 1 + 1e-8);
    add_scaled(pushed, 1e-8 * norm(pushed), c->y + 3);
    scale(pushed, 1 + 1e-8);
    return moved;
}

/* The energy of the point is restored on every level, H < 0 and H > 0. */
static void projection_off_the_level(const laws_case *c, laws_worst *worst)
{
    static const double stretch[] = {0.5, 0.9, 1.7, 30};
    for (int i = 0; i < 4; i++) {
        double y[ISO_STATE];
        const laws_case moved = off_the_level_by(c, stretch[i], y);
        const double correction = c->system->project(&moved.problem, y), rounding = laws_rounding(&c->problem.p);
        note_restored(&moved, y, 2, worst);
        laws_note(worst, fabs(correction - 1e-8), 1e-15 + 8 * rounding, &c->problem.p, "correction");
        laws_note(worst, laws_distance(y, moved.y) / norm(y), 1e-15 + 8 * rounding, &c->problem.p, "M back");
    }
}

/* Near a turning point T is the small difference of energy and potential: only the geometry is restored. */
static void projection_near_a_turn(const laws_case *c, laws_worst *worst)
{
    double y[ISO_STATE];
    const laws_case moved = off_the_level_by(c, 0.1, y);
    c->system->project(&moved.problem, y);
    laws_note(worst, fabs(norm(y + 3) - 1), 2 * DBL_EPSILON, &c->problem.p, "unit");
    laws_note(worst, fabs(dot(y, y + 3)), 2 * DBL_EPSILON * norm(y), &c->problem.p, "orthogonal");
    laws_note(worst, fabs(norm(y) / norm(moved.y) - (1 + 1e-8)), 1e-15, &c->problem.p, "M kept");
}

/* At rest there is nothing to scale: no NaN. */
static void projection_at_rest(const laws_case *c, laws_worst *worst)
{
    laws_case rest = *c;
    scale(rest.y, 0);
    rest.problem.energy = rest.problem.eps = 0;
    scale(rest.y + 3, 1.5);
    laws_note(worst, fabs(c->system->project(&rest.problem, rest.y) - 0.5), 4 * DBL_EPSILON, &c->problem.p,
              "correction");
    laws_note(worst, norm(rest.y), DBL_MIN, &c->problem.p, "rest");
    laws_note(worst, fabs(norm(rest.y + 3) - 1), 2 * DBL_EPSILON, &c->problem.p, "unit");
}

/* The spin is taken out of a random w once: where w was nearly along n, rounding leaves more than an ulp of it. */
static void sample_valid(const laws_case *c, laws_worst *worst)
{
    note_restored(c, c->y, 32, worst);
}

int main(void)
{
    laws_hold("sampled states are valid", NULL, sample_valid);
    laws_hold("integrals constant along the flow", NULL, note_holding);
    laws_hold("integrals constant off the level H = 0", &iso_system_point, off_the_level);
    laws_hold("where integrals are said to hold", NULL, conditions);
    check_unclaimed("F_plane", -1);
    check_unclaimed("F_plane", 0.75);
    check_unclaimed("F_shell", 1);
    for (int axis = 0; axis < 3; axis++) check_unclaimed((const char *[]){"F_axis1", "F_axis2", "F_axis3"}[axis], 0);
    laws_hold("projection restores", NULL, projection_restores);
    laws_hold("projection reports its correction", NULL, correction_reported);
    laws_hold("projection off the level H = 0", &iso_system_point, projection_off_the_level);
    laws_hold("projection near a turning point", &iso_system_point, projection_near_a_turn);
    laws_hold("projection at rest", NULL, projection_at_rest);
    exit(gsl_test_summary());
}

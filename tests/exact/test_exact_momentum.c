/* The momentum of the closed solution for one angle (a principal plane, two equal moments) keeps its digits for every
 * k and J, however much the rates of its clocks change along the orbit. */
#include "exact_orbits.h"

static iso_context *ctx;

enum { TIMES = 40, BODIES = 60 };

/* Random moments with ratios up to 1e5, k from 0.05 to 5 of either sign. */
static void random_body(iso_random *random, double *k, double J[3])
{
    const double wide = iso_random_uniform(random, 0.1, 5);
    *k = exact_sign(random) * 0.05 * pow(100, iso_random_uniform(random, 0, 1));
    for (int i = 0; i < 3; i++) J[i] = pow(10, iso_random_uniform(random, -wide / 2, wide / 2));
}

/* A ball that rolls in a principal plane turns about the third axis at one speed: omega is a constant. */
static void note_omega(const iso_params *p, int across, iso_random *random, laws_worst *worst)
{
    const double angle = iso_random_uniform(random, 0, 2 * M_PI);
    double ball[ISO_STATE] = {0}, point[ISO_STATE], clocks[ISO_CLOCKS], now[ISO_STATE];
    iso_problem f = {.p = *p};
    iso_exact *exact;
    ball[across] = exact_sign(random);
    ball[3 + (across + 1) % 3] = cos(angle), ball[3 + (across + 2) % 3] = sin(angle);
    f.eps = iso_coupling(p, iso_ball_energy(p, ball));
    iso_ball_to_point(p, ball, point);
    if (iso_exact_create(ctx, &f, point, exact_clocks, &exact) != ISO_OK) return; /* too sharp a body */
    for (int i = 0; i < TIMES; i++) {
        const double turn = iso_random_uniform(random, -20, 20) / fabs(p->k);
        if (iso_exact_at(ctx, exact, ISO_CLOCK_T, turn, point, clocks) != ISO_OK) point[0] = NAN;
        iso_point_to_ball(p, point, now);
        laws_note(worst, laws_distance(now, ball), 16 * DBL_EPSILON, p, "omega");
    }
    iso_exact_free(exact);
}

static void check_planes(iso_random *random)
{
    laws_worst worst[3];
    memset(worst, 0, sizeof worst);
    for (int i = 0; i < BODIES; i++) {
        double k, J[3];
        random_body(random, &k, J);
        const iso_params p = laws_params(k, J);
        for (int across = 0; across < 3; across++) note_omega(&p, across, random, &worst[across]);
    }
    for (int across = 0; across < 3; across++) {
        char name[64];
        snprintf(name, sizeof name, "omega across the plane of axis %d", across + 1);
        laws_report(&worst[across], name);
    }
}

/* The body: rates of its clocks differ by 1e10 along the orbit. */
static void check_sharp_plane(iso_random *random)
{
    static const double J[3] = {352.8178935200162, 0.06393673223402149, 0.006435000728723503},
                        ks[] = {0.1, -0.1, 0.3};
    laws_worst worst = {0};
    for (int i = 0; i < 3; i++) {
        const iso_params p = laws_params(ks[i], J);
        for (int n = 0; n < 10; n++) note_omega(&p, 0, random, &worst);
    }
    laws_report(&worst, "omega where the clocks' rates differ by 1e10");
}

/* H is that of the start, as gamma is rounded here and there: q has 2 units in the last place, q^(-1/k) has 1/|k|
 * times as many. M along the axis of two equal moments is a constant to the bit. */
static void note_energy(const orbit *o, bool plane, iso_random *random, laws_worst *worst)
{
    const iso_problem *f = &o->model.problem;
    double y[ISO_STATE], clocks[ISO_CLOCKS], size, first, along = NAN;
    const double H0 = iso_system_point.energy(f, o->y0, &first);
    iso_exact *exact;
    if (iso_exact_create(ctx, f, o->y0, exact_clocks, &exact) != ISO_OK) return;
    int axis = 0;
    while (!plane && f->p.J[(axis + 1) % 3] != f->p.J[(axis + 2) % 3]) axis++;
    for (int i = 0; i < TIMES; i++) {
        const double time = iso_random_uniform(random, -20, 20) * o->unit;
        if (iso_exact_at(ctx, exact, ISO_CLOCK_S, time, y, clocks) != ISO_OK) y[0] = NAN;
        const double H = iso_system_point.energy(f, y, &size);
        laws_note(worst, fabs(H - H0) / fmax(size, first), (8 + 8 / fabs(f->p.k)) * DBL_EPSILON, &f->p, "H");
        if (i == 0) along = y[axis];
        if (!plane) laws_note(worst, fabs(y[axis] - along), 0, &f->p, "M along the axis");
    }
    iso_exact_free(exact);
}

static void check_energy(iso_random *random)
{
    laws_worst plane = {0}, axis = {0};
    for (int i = 0; i < BODIES; i++) {
        const int a = i % 3, b = (a + 1) % 3, c = (a + 2) % 3;
        const double rho = i % 2 ? iso_random_uniform(random, -0.9, 0.9) : 0;
        orbit o = {.ctx = ctx, .model.system = &iso_system_point};
        double k, J[3], g[3], M[3];
        random_body(random, &k, J);
        iso_random_direction(random, g), iso_random_direction(random, M);
        exact_start(&o, k, (const double[3]){J[0], J[1], J[1]}, g, M, rho);
        note_energy(&o, false, random, &axis);
        g[a] = M[b] = M[c] = 0;
        exact_start(&o, k, J, g, M, rho);
        note_energy(&o, true, random, &plane);
    }
    laws_report(&plane, "H in a plane");
    laws_report(&axis, "H of two equal moments");
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *random = iso_random_create(44);
    check_planes(random);
    check_sharp_plane(random);
    check_energy(random);
    iso_random_free(random);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

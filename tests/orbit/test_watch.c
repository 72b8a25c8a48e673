/* Laws of what is watched along an orbit: the drift of its integrals, and the distance of two states. */
#include "orbit/watch_impl.h"
#include "scenes.h"

static iso_context *ctx;

/* Nothing drifts at the start, and little along the orbit; the worst is the largest of all; a longer vector shows in
 * the energy or as a constraint; a NaN counts as infinite. */
static void check_drifts(iso_orbit *orbit, const iso_system *system, double time, laws_worst *worst)
{
    enum { ROWS = 5 };
    const iso_params *p = &iso_orbit_model(orbit)->problem.p;
    const double level = system == &iso_system_point ? orbit->level : (double)NAN;
    const iso_sample first = scene_at(ctx, orbit, 0);
    iso_drift list[ISO_MAX_INTEGRALS];
    double most[ISO_MAX_INTEGRALS] = {0};
    const int count = iso_watch_begin(orbit, system, level, &first, list, ISO_MAX_INTEGRALS);
    for (int row = 0; row < ROWS; row++) {
        const iso_sample s = scene_at(ctx, orbit, time * row);
        iso_watch_follow(orbit, &s, list, count);
        for (int i = 0; i < count; i++) {
            const char *name = list[i].integral->name;
            most[i] = fmax(most[i], fabs(list[i].now));
            laws_note(worst, list[i].worst, row == 0 ? 16 * laws_rounding(p) : 1e-9, p, name);
            laws_note(worst, fabs(list[i].worst - most[i]), 0, p, "the worst is the largest");
        }
    }
    for (int vector = 0; vector < 2; vector++) {
        iso_sample longer = first;
        scale(longer.ball + 3 * vector, 1 + 1e-6);
        scale(longer.point + 3 * vector, 1 + 1e-6);
        iso_watch_follow(orbit, &longer, list, count);
        for (int i = 0; i < count; i++)
            if (vector == 0 ? list[i].integral->value == system->energy : list[i].integral->known == ISO_ONE)
                laws_note(worst, 1e-8, fabs(list[i].now), p, list[i].integral->name);
    }
    iso_sample lost;
    iso_sample_blank(&lost);
    iso_watch_follow(orbit, &lost, list, count);
    for (int i = 0; i < count; i++) laws_note(worst, isinf(list[i].worst) ? 0 : 1, 0, p, "NaN is infinite");
}

static void check_distance(const double a[ISO_STATE], const double b[ISO_STATE], const iso_params *p,
                           laws_worst *worst)
{
    double longer[ISO_STATE];
    copy(a, longer, ISO_STATE);
    scale(longer, 1 + 1e-6);
    laws_note(worst, iso_distance(a, a), 0, p, "equal states");
    laws_note(worst, fabs(iso_distance(a, b) - iso_distance(b, a)), 0, p, "a and b, b and a");
    laws_note(worst, iso_distance(a, b), 2, p, "no more than opposite");
    laws_note(worst, fabs(iso_distance(a, longer) - 1e-6), 1e-11, p, "1 + 1e-6 times as long");
    longer[4] = NAN;
    laws_note(worst, isnan(iso_distance(a, longer)) && isnan(iso_distance(longer, a)) ? 0 : 1, 0, p, "NaN");
}

static void check_orbit(const laws_case *c, laws_worst *worst)
{
    if (!iso_point_is_better(&c->problem.p)) return; /* powers of q leave the range of doubles */
    iso_start start = {.model = c->system == &iso_system_ball ? ISO_BALL : ISO_POINT, .eps = c->problem.eps};
    copy(c->y, start.y, ISO_STATE);
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.shown = ISO_SHOW_BOTH;
    iso_orbit *orbit = scene_by(ctx, &c->problem.p, &start, &o);
    const double time = 0.1 / c->system->speed(&c->problem, c->y);
    for (int s = 0; iso_systems[s]; s++) check_drifts(orbit, iso_systems[s], time, worst);
    const iso_sample first = scene_at(ctx, orbit, 0), later = scene_at(ctx, orbit, time);
    check_distance(first.ball, later.ball, &c->problem.p, worst);
    check_distance(first.point, later.point, &c->problem.p, worst);
    iso_orbit_free(orbit);
}

int main(void)
{
    ctx = iso_context_create();
    laws_hold("drifts and distances", NULL, check_orbit);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

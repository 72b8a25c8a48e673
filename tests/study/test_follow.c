/* Following periodic orbits (lib/instrument/periodic/continuation.h): points of a branch are periodic orbits, events
 * are where their law says, branches that meet agree; refusals. */
#define _GNU_SOURCE /* functions of _Float128 */
#include "instrument/periodic/continuation.h"
#include "periodics.h"

static const iso_branch_event *event_of(const iso_branch *b, iso_branch_kind kind)
{
    for (size_t i = 0; i < b->events; i++)
        if (b->event[i].kind == kind) return &b->event[i];
    gsl_test(1, "there is an event '%s'", iso_branch_kind_name((int)kind));
    exit(gsl_test_summary());
}

/* The trace on both sides of an event: above -2 both times where it touches -2, else above and below. */
static void check_sides(const iso_branch *b, const iso_branch_event *e, bool touches)
{
    size_t i = 0;
    while (i + 2 < b->points && b->point[i + 1].arc < e->at.arc) i++;
    const double before = b->point[i].trace + 2, behind = b->point[i + 1].trace + 2;
    gsl_test((before * behind > 0) != touches, "trace %g before and %g behind -2 at %.9g: %s", before, behind,
             e->at.value, iso_branch_kind_name((int)e->kind));
}

/* A point of a branch is found again by the search along lines, at its value of k. */
static void check_point(const iso_branch *b, const iso_branch_point *p, const double J[3])
{
    const iso_scene scene = ball_scene(p->value, J);
    iso_periodic *f = orbits_to(&scene, b->period);
    double best = INFINITY;
    for (size_t i = 0; i < f->count; i++)
        if (f->orbit[i].period == b->period) best = fmin(best, fabs(f->orbit[i].trace - p->trace));
    gsl_test_abs(best, 0, 1e-8 * (1 + fabs(p->trace)), "k = %g: the search finds the orbit of the branch", p->value);
    iso_periodic_free(f);
}

/* J = (1, 2, 5), the fixed point of period 1: where its trace touches -2 (it has two symmetries, so that its trace is
 * that of half of it squared, less 2), its collision with the rotation about axis 1, whose trace is there 2, and the
 * branch of period 2 that begins at the touch. */
static void check_branch(void)
{
    static const double J[3] = {1, 2, 5};
    const iso_scene scene = ball_scene(0.5, J);
    iso_periodic *f = orbits_to(&scene, 1);
    iso_continuation_options o = iso_continuation_defaults();
    iso_continuations *follow;
    o.from = 0.3, o.to = 0.8, o.branches = true, o.longest = 0.08;
    gsl_test_int((int)iso_continuation_run(ctx, &scene, f->orbit, f->count, &o, &follow), ISO_OK, "followed");
    const iso_branch *b = &follow->branch[0];
    const iso_branch_event *touch = event_of(b, ISO_BRANCH_TOUCH), *end = event_of(b, ISO_BRANCH_END);
    const iso_branch_event *collision = event_of(b, ISO_BRANCH_COLLISION);
    gsl_test_abs(touch->at.trace, -2, 1e-9, "trace at a touch");
    check_sides(b, touch, true);
    for (size_t i = 0; i < b->events; i++)
        gsl_test(b->event[i].kind == ISO_BRANCH_DOUBLING, "a touch is no period doubling");
    gsl_test_abs(event_of(b, ISO_BRANCH_BREAKING)->at.trace, 2, 1e-6, "trace where a symmetry breaks");
    gsl_test_abs(end->at.value, 0.3, 0, "the end of the range");
    gsl_test_int(collision->axis, 0, "the rotation that it meets");
    gsl_test_abs(iso_hill_trace(collision->at.value, J, 0, 0, NULL), 2, 1e-9, "its trace at the collision");
    check_point(b, &b->point[b->points / 2], J);
    check_point(b, &b->point[0], J);
    gsl_test(follow->count < 2, "branches are switched to: %zu", follow->count);
    bool meets = false;
    for (size_t i = 1; i < follow->count; i++) {
        const iso_branch *other = &follow->branch[i];
        gsl_test_int(other->parent, 0, "its parent");
        for (size_t j = 0; j < other->events && other->period == 2; j++)
            meets = meets || (other->event[j].joins && fabs(other->event[j].at.value - touch->at.value) < 1e-9);
    }
    gsl_test(!meets, "a branch of period 2 begins at the touch");
    iso_continuation_free(follow);
    iso_periodic_free(f);
}

/* The touch of k = 0.3767, J = (1.4, 2.1, 3); and, of an orbit with one symmetry, true period doublings on levels. */
static void check_touch(void)
{
    static const double J[3] = {1.4, 2.1, 3};
    iso_scene scene = ball_scene(0.38, J);
    iso_continuation_options o = iso_continuation_defaults();
    iso_continuations *follow;
    iso_periodic *f = orbits_to(&scene, 1);
    o.from = 0.37, o.to = 0.39;
    gsl_test_int((int)iso_continuation_run(ctx, &scene, f->orbit, f->count, &o, &follow), ISO_OK, "followed");
    const iso_branch_event *e = event_of(&follow->branch[0], ISO_BRANCH_TOUCH);
    gsl_test_abs(e->at.value, 0.3767272689, 1e-9, "k of the touch");
    check_sides(&follow->branch[0], e, true);
    iso_continuation_free(follow);
    iso_periodic_free(f);
    scene.params = laws_params(0.5, J);
    scene.start = (iso_start){.model = ISO_POINT, .y = {0, 0.5, 0, 0.6, 0, 0.8}, .eps = 1};
    f = orbits_to(&scene, 2);
    o.vary = ISO_VARY_LEVEL, o.from = -0.25, o.to = -0.19;
    gsl_test_int((int)iso_continuation_run(ctx, &scene, f->orbit, f->count, &o, &follow), ISO_OK, "followed");
    size_t doublings = 0;
    for (size_t i = 0; i < follow->count; i++)
        for (size_t j = 0; j < follow->branch[i].events; j++) {
            const iso_branch_event *d = &follow->branch[i].event[j];
            if (d->kind != ISO_BRANCH_DOUBLING || d->joins) continue;
            check_sides(&follow->branch[i], d, false);
            doublings++;
        }
    gsl_test(doublings == 0, "there are period doublings");
    iso_continuation_free(follow);
    iso_periodic_free(f);
}

/* Through k = 1, where the orbit is one of a torus. */
static void check_torus(void)
{
    static const double J[3] = {1.4, 2.1, 3};
    const iso_scene scene = ball_scene(0.97, J);
    iso_periodic *f = orbits_to(&scene, 5);
    iso_continuation_options o = iso_continuation_defaults();
    iso_continuations *follow;
    o.from = 0.96, o.to = 1.02, o.longest = 0.1;
    gsl_test(f->count < 2, "there are orbits");
    gsl_test_int((int)iso_continuation_run(ctx, &scene, f->orbit, 2, &o, &follow), ISO_OK, "followed");
    int tori = 0;
    for (size_t i = 0; i < follow->count; i++)
        for (size_t j = 0; j < follow->branch[i].events; j++) {
            const iso_branch_event *e = &follow->branch[i].event[j];
            if (e->kind != ISO_BRANCH_TORUS) continue;
            gsl_test_abs(e->at.value, 1, 1e-7, "k of a torus");
            tori++;
        }
    gsl_test(tori == 0, "branches pass tori");
    iso_continuation_free(follow);
    iso_periodic_free(f);
}

static void check_refusals(void)
{
    static const double J[3] = {1.4, 2.1, 3};
    static const struct {
        iso_vary vary;
        double from, to;
    } wrong[] = {{ISO_VARY_K, 0.6, 0.4}, {ISO_VARY_K, -1, 1},  {ISO_VARY_K, 0.6, 0.8},
                 {ISO_VARY_J2, 2, 4},    {ISO_VARY_J2, -1, 3}, {ISO_VARY_K, NAN, 1}};
    const iso_scene scene = ball_scene(0.5, J);
    iso_periodic *f = orbits_to(&scene, 4);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        iso_continuation_options o = iso_continuation_defaults();
        iso_continuations *follow;
        o.vary = wrong[i].vary, o.from = wrong[i].from, o.to = wrong[i].to;
        gsl_test_int((int)iso_continuation_run(ctx, &scene, f->orbit, f->count, &o, &follow), ISO_BAD_ARGUMENT,
                     "range %zu", i);
        gsl_test(strcmp(iso_context_about(ctx), "range") != 0, "about the range");
        gsl_test(follow != NULL, "nothing is given");
    }
    iso_periodic_free(f);
}

int main(void)
{
    ctx = iso_context_create();
    check_branch();
    check_touch();
    check_torus();
    check_refusals();
    iso_context_free(ctx);
    return gsl_test_summary();
}

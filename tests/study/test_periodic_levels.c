/* Rotations and periodic orbits on every level of the point's energy: Hill's equation by GSL and by
 * the section, orbits in direct integration by both models, a branch against searches at its ends, and what does not
 * exist on a level. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "base/math_impl.h"
#include "instrument/periodic/continuation.h"
#include "instrument/periodic/stability_chart.h"
#include "instrument/separatrix/separatrix.h"
#include "map/section.h"
#include "map/section_impl.h"
#include "map/state.h"
#include "orbit/orbit.h"
#include "periodics.h"
#include "study/level.h"

/* A point of the section with eps and this level. */
static iso_scene scene_on(double k, const double J[3], double eps, double level)
{
    iso_scene scene = iso_scene_default();
    scene.params = laws_params(k, J);
    const iso_point_motion m = {&scene.params, eps, eps * iso_level_energy(&scene.params, level)};
    const int axis = iso_section_axis(m);
    const double l = iso_section_momentum(m, axis, 0) > iso_section_momentum(m, axis, ISO_PI / 2) ? 0 : ISO_PI / 2;
    scene.start = (iso_start){.model = ISO_POINT, .eps = eps};
    iso_section_point(m, axis, l, 0.4, scene.start.y);
    return scene;
}

/* --- rotations -------------------------------------------------------------------------------------------------- */

/* Random J that differ by a twentieth or more, k, and a level on which the whole sphere can be reached. */
static double draw(iso_random *random, double most_k, double J[3], double *k)
{
    draw_moments(random, 1, 0.05, J);
    *k = (iso_random_uniform(random, 0, 1) < 0.5 ? 1 : -1) *
         exp(iso_random_uniform(random, log(1 / most_k), log(most_k)));
    const iso_params p = laws_params(*k, J);
    const double far = J[iso_section_axis(iso_free_point(&p, 1))], lowest = -iso_level_of(&p, pow(far, -1 / *k));
    const double part = iso_random_uniform(random, -0.95, 3);
    return part < 0 ? -part * lowest : part;
}

/* The linear equation of gamma_i beside the rotation about axis i, in the time s with eps = 1:
 * y'' = ((2/k) q^(-1-1/k) ((1-k) q - J_i) - 2 E) y. */
typedef struct hill {
    double k, Ji, Ja, Jb, energy;
} hill;

static int hill_slope(double phi, const double y[], double dy[], void *data)
{
    const hill *p = data;
    const double C = cos(phi), S = sin(phi), q = p->Ja * C * C + p->Jb * S * S, depth = pow(q, -1 / p->k);
    const double pace = sqrt(2 * (p->energy + depth)); /* dphi/ds */
    for (int i = 0; i < 4; i += 2) {
        dy[i] = y[i + 1] / pace;
        dy[i + 1] = (2 / p->k * depth / q * ((1 - p->k) * q - p->Ji) - 2 * p->energy) * y[i] / pace;
    }
    return GSL_SUCCESS;
}

/* The trace by Hill's equation is that of this one by GSL; two of three on the level H = 0. */
static void check_by_gsl(void)
{
    iso_random *random = iso_random_create(17);
    for (int i = 0; i < tests_length(30, 150); i++) {
        double J[3], k, y[4] = {1, 0, 0, 1}, phi = 0, error;
        const double level = draw(random, 3, J, &k);
        const iso_params p = laws_params(k, J);
        const int a = i % 3;
        hill h = {k, J[a], J[(a + 1) % 3], J[(a + 2) % 3], i / 3 % 3 ? 0 : iso_level_energy(&p, level)};
        gsl_odeiv2_system system = {hill_slope, NULL, 4, &h};
        gsl_odeiv2_driver *d = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-3, 1e-14, 1e-14);
        gsl_odeiv2_driver_apply(d, &phi, ISO_PI, y);
        gsl_odeiv2_driver_free(d);
        const double trace = iso_hill_trace(k, J, h.energy, a, &error), size = fabs(y[0]) + fabs(y[3]) + 1;
        gsl_test_abs(trace, y[0] + y[3], 1e-11 * size, "k = %g, E = %g, axis %d: trace by GSL", k, h.energy, a + 1);
        gsl_test(!(error < 1e-12 * size), "its error %g", error);
    }
    iso_random_free(random);
}

/* In a scene. With another eps the traces are the same, and the clocks are shorter. */
static void check_scenes(void)
{
    static const struct row {
        double k, J[3], energy; /* eps = 1 */
    } table[] = {{0.5, {1, 2, 5}, 0.4},     {0.5, {1, 2, 5}, -0.03}, {-0.5, {1.4, 2.1, 3}, 0.4},
                 {1, {1.4, 2.1, 3}, -0.03}, {-1, {1, 2, 5}, 5},      {-2, {1.4, 2.1, 3}, 0},
                 {-1, {1.4, 2.1, 3}, 0},    {0.5, {1, 2, 5}, 0},     {2, {1, 2, 5}, 0}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const struct row *t = &table[i];
        const iso_params p = laws_params(t->k, t->J);
        const double level = iso_level_of(&p, t->energy);
        const iso_scene one = scene_on(t->k, t->J, 1, level), other = scene_on(t->k, t->J, 7, level);
        iso_periodic *f = orbits_to(&one, 0), *g = orbits_to(&other, 0);
        gsl_test_rel(f->level, level, 1e-13, "k = %g, E = %g: the scene's level", t->k, t->energy);
        for (int a = 0; a < 3; a++) {
            const double T = iso_hill_trace(t->k, t->J, t->energy, a, NULL);
            const iso_rotation *r = &f->rotation[a], *s = &g->rotation[a];
            gsl_test_rel(r->half_turn_trace, T, 1e-11, "axis %d, in a scene", a + 1);
            gsl_test_rel(r->by_section, r->half_turn_trace, 1e-12, "axis %d by the section", a + 1);
            gsl_test_rel(s->half_turn_trace, T, 1e-11, "axis %d, eps = 7", a + 1);
            const double trace = r->half_turn_trace, size = fmax(1, fabs(trace)), (*m)[2] = r->half.value;
            gsl_test(!(r->error < 1e-12 * size), "error %g", r->error);
            gsl_test((r->half.stability == ISO_STABLE) != (fabs(trace) < 2), "stability");
            gsl_test((r->half.krein != 0) != (fabs(trace) < 2), "Krein's sign");
            gsl_test_abs(m[0][0] + m[1][0], trace, 1e-13 * size, "sum of the multipliers");
            gsl_test_abs(m[0][0] * m[1][0] - m[0][1] * m[1][1], 1, 1e-13 * size, "their product");
            gsl_test_rel(s->clock[ISO_CLOCK_S] * sqrt(7), r->clock[ISO_CLOCK_S], 1e-12, "its clock s");
        }
        iso_periodic_free(f);
        iso_periodic_free(g);
    }
}

/* In 128 bits, where there are any, Hill's equation and the section agree to 28 digits. */
static void check_polish(void)
{
    const iso_scene scene = scene_on(0.5, (const double[3]){1, 2, 5}, 1.7, -0.1);
    iso_periodic_options o = iso_periodic_defaults();
    iso_periodic *f;
    o.polish = o.rotations_alone = true;
    const iso_status status = iso_periodic_run(ctx, &scene, &o, &f);
    if (status == ISO_BAD_ARGUMENT) return;
    must(status, "rotations in 128 bits");
    for (int a = 0; a < 3; a++)
        gsl_test(!(f->rotation[a].error < 1e-28 * (1 + fabs(f->rotation[a].half_turn_trace))), "axis %d: %g +- %.1e",
                 a + 1, f->rotation[a].half_turn_trace, f->rotation[a].error);
    iso_periodic_free(f);
}

/* study.md 9.1: T < -2 about the middle axis, for every k and J and on every level with this rotation. */
static void check_middle_axis(void)
{
    iso_random *random = iso_random_create(91);
    double most = -INFINITY;
    for (int i = 0; i < tests_length(1000, 10000); i++) {
        double J[3], k, error;
        const double level = draw(random, 5, J, &k);
        const iso_params p = laws_params(k, J);
        int middle = 0;
        while ((J[middle] - J[(middle + 1) % 3]) * (J[middle] - J[(middle + 2) % 3]) > 0) middle++;
        const double T = iso_hill_trace(k, J, iso_level_energy(&p, level), middle, &error);
        most = fmax(most, isnan(T) ? INFINITY : T + error);
    }
    gsl_test(!(most < -2), "the middle axis: the largest trace is -2 %+.2g", most + 2);
    iso_random_free(random);
}

/* J = 1, 2, 5, k = 0.5: V on the axes is -1, -1/4, -1/25. */
static void check_none(void)
{
    static const double J[3] = {1, 2, 5}, energies[] = {-0.1, -0.5};
    static const bool there[2][3] = {{false, false, true}, {false, false, false}};
    for (int i = 0; i < 2; i++) {
        const iso_params p = laws_params(0.5, J);
        const iso_scene scene = scene_on(0.5, J, 1, iso_level_of(&p, energies[i]));
        iso_periodic *f = orbits_to(&scene, 1);
        gsl_test(!f->closed, "E = %g: part of the sphere is closed", energies[i]);
        for (int a = 0; a < 3; a++) {
            const iso_rotation *r = &f->rotation[a];
            gsl_test(r->oscillates == there[i][a], "E = %g, axis %d: a rotation or none", energies[i], a + 1);
            gsl_test(isnan(r->half_turn_trace) != r->oscillates, "E = %g, axis %d: its trace", energies[i], a + 1);
        }
        gsl_test(f->unresolved > 0, "E = %g: the lines are resolved", energies[i]);
        iso_separatrix_splitting s;
        gsl_test(iso_separatrix_at(ctx, 0.5, J, f->level, ISO_SEPARATRIX_DOUBLE, &s) != ISO_BAD_INPUT ||
                     strcmp(iso_context_about(ctx), "level") != 0,
                 "E = %g: no splitting: %s", energies[i], iso_context_message(ctx));
        iso_periodic_free(f);
    }
}

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* The orbit in direct integration, of this model, comes back after its period in each clock. */
static void check_model(const iso_scene *scene, double H, const iso_periodic_orbit *o, iso_model_kind model)
{
    iso_start start = {.model = model, .eps = model == ISO_POINT ? scene->start.eps : (double)NAN};
    iso_effects effects = iso_effects_default();
    iso_orbit_options how = iso_orbit_defaults(&start);
    iso_sample end;
    iso_orbit *orbit;
    memcpy(start.y, model == ISO_POINT ? o->point : o->ball, sizeof start.y);
    iso_effects_set_level(&effects, H != 0, iso_energy(&scene->params, H));
    if (model == ISO_BALL) how.effects = &effects;
    how.backend = (iso_backend)model, how.shown = ISO_SHOW_BOTH, how.tolerance = 1e-14;
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) how.with_clock[c] = true;
    if (iso_orbit_create(ctx, &scene->params, &start, &how, &orbit) != ISO_OK ||
        iso_orbit_at(orbit, o->clock[how.clock], &end) != ISO_OK) {
        gsl_test(1, "an orbit: %s", iso_context_message(ctx));
        return;
    }
    const double far = 1e-11 * (1 + fabs(o->trace));
    double apart = 0;
    for (int i = 0; i < ISO_STATE; i++) {
        apart = fmax(apart, fabs(end.ball[i] - o->ball[i]) / (1 + largest(o->ball)));
        apart = fmax(apart, fabs(end.point[i] - o->point[i]) / (1 + largest(o->point)));
    }
    gsl_test(!(apart < far), "k = %g, H = %g, period %d, trace %g: it comes back to %.1e by the %s", scene->params.k,
             H, o->period, o->trace, apart, iso_model_kind_name((int)model));
    for (iso_clock c = 0; c < ISO_CLOCKS; c++)
        gsl_test_rel(end.clock[c], o->clock[c], 1e-10 * (1 + fabs(o->trace)), "its period in %s", iso_clock_name(c));
    iso_orbit_free(orbit);
}

/* Also on levels that close a part of the sphere. */
static void check_orbits(void)
{
    iso_random *random = iso_random_create(7);
    size_t seen = 0;
    for (int i = 0; i < tests_length(4, 24); i++) {
        const double J[3] = {iso_random_uniform(random, 1, 1.5), iso_random_uniform(random, 1.6, 2.5),
                             iso_random_uniform(random, 2.6, 4)};
        const double k = (i % 2 ? -1 : 1) * iso_random_uniform(random, 0.4, 0.8),
                     eps = iso_random_uniform(random, 0.5, 2);
        const double level = iso_random_uniform(random, -0.35, 0.3);
        const iso_scene scene = scene_on(k, J, eps, level);
        const double H = eps * iso_level_energy(&scene.params, level);
        iso_periodic *f = orbits_to(&scene, 3);
        gsl_test_rel(f->level, level, 1e-12, "the level of the scene");
        for (size_t j = 0; j < f->count; j++) {
            gsl_test(!(f->orbit[j].closure <= 1e-14), "closure %g", f->orbit[j].closure);
            const double size = 1 + fabs(f->orbit[j].trace);
            gsl_test(!(fabs(f->orbit[j].determinant) <= 1e-15 * size), "trace %g: determinant 1 %+g", size - 1,
                     f->orbit[j].determinant);
            if (fabs(f->orbit[j].trace) > 1000) continue;
            for (iso_model_kind model = ISO_BALL; model <= ISO_POINT; model++)
                check_model(&scene, H, &f->orbit[j], model);
            seen++;
        }
        iso_periodic_free(f);
    }
    gsl_test(seen < 8, "%zu orbits", seen);
    iso_random_free(random);
}

/* The ball in the potential of `level`, with an effect that only observes, has the orbits of its point. */
static void check_ball(void)
{
    static const double J[3] = {1.4, 2.1, 3};
    const iso_scene point = scene_on(0.5, J, 1.3, -0.2);
    iso_scene ball = point;
    iso_periodic *f = orbits_to(&point, 2), *g;
    ball.start.model = ISO_BALL, ball.start.eps = NAN;
    iso_point_to_ball(&ball.params, point.start.y, ball.start.y);
    iso_effects_set_level(&ball.effects, true, iso_energy(&ball.params, 1.3 * iso_level_energy(&ball.params, -0.2)));
    if (iso_effects_set(ctx, &ball.effects, "attitude", NULL, 0, NULL) != ISO_OK) gsl_test(1, "attitude");
    g = orbits_to(&ball, 2);
    gsl_test(f->count == 0 || f->count != g->count, "the ball has as many orbits as its point: %zu", f->count);
    for (size_t i = 0; i < f->count && i < g->count; i++) {
        gsl_test_abs(g->orbit[i].trace, f->orbit[i].trace, 1e-9 * (1 + fabs(f->orbit[i].trace)), "trace");
        for (int c = 0; c < ISO_CLOCKS; c++)
            gsl_test_rel(g->orbit[i].clock[c], f->orbit[i].clock[c], 1e-11, "its period, clock %d", c);
    }
    iso_periodic_free(f);
    iso_periodic_free(g);
}

/* At each end of a range of levels the search finds the orbit of the branch. */
static void check_branch(void)
{
    static const double J[3] = {1.4, 2.1, 3};
    const iso_scene scene = scene_on(0.5, J, 1, -0.1);
    iso_periodic *f = orbits_to(&scene, 2);
    iso_continuation_options o = iso_continuation_defaults();
    iso_continuations *follow = NULL;
    size_t ends = 0;
    o.vary = ISO_VARY_LEVEL, o.from = -0.16, o.to = -0.05, o.longest = 0.1;
    gsl_test_int((int)iso_continuation_run(ctx, &scene, f->orbit, f->count, &o, &follow), ISO_OK, "followed: %s",
                 iso_context_message(ctx));
    for (size_t i = 0; follow && i < follow->count; i++)
        for (size_t j = 0; j < follow->branch[i].events; j++) {
            const iso_branch_event *e = &follow->branch[i].event[j];
            if (e->kind != ISO_BRANCH_END) continue;
            const iso_scene there = scene_on(0.5, J, 1, e->at.value);
            iso_periodic *g = orbits_to(&there, follow->branch[i].period);
            double best = INFINITY;
            for (size_t n = 0; n < g->count; n++) best = fmin(best, fabs(g->orbit[n].trace - e->at.trace));
            gsl_test(!(best < 1e-7 * (1 + fabs(e->at.trace))), "level %g, trace %g: the search finds it: %.1e",
                     e->at.value, e->at.trace, best);
            iso_periodic_free(g);
            ends++;
        }
    gsl_test(ends < 2, "%zu ends", ends);
    iso_continuation_free(follow);
    iso_periodic_free(f);
}

/* On its borders the trace is 2 or -2: on H = 0, on another level, and against the level. */
static void check_chart(void)
{
    iso_record *grid, *borders;
    iso_stability_options o = iso_stability_defaults();
    for (int i = 0; i < 3; i++) {
        const bool by_level = i == 2;
        o.J[0] = 1, o.J[1] = 2, o.J[2] = 5;
        o.steps = i == 0 ? 24 : 16, o.level = i == 0 ? 0 : -0.1, o.moment = by_level ? ISO_CHART_LEVEL : 1;
        o.from[1] = by_level ? -0.3 : 1.5, o.to[1] = by_level ? 1 : 4.5;
        must(iso_stability_chart(ctx, &o, &grid, &borders), "a chart");
        gsl_test_int((int)iso_record_rows(grid), (int)((o.steps + 1) * (o.steps + 1)), "its grid");
        gsl_test(iso_record_rows(borders) < (i == 0 ? 20 : 5), "its borders");
        for (size_t j = 0; j < iso_record_rows(borders); j++) {
            const double *row = iso_record_const_row(borders, j), at[3] = {1, by_level ? 2 : row[3], 5};
            const iso_params p = laws_params(row[2], at);
            const double energy = iso_level_energy(&p, by_level ? row[3] : o.level);
            gsl_test_abs(iso_hill_trace(row[2], at, energy, row[0] > 0 ? 2 : 0, NULL), row[1], i == 0 ? 1e-8 : 1e-7,
                         "border at k = %g and %g", row[2], row[3]);
        }
        iso_record_free(grid);
        iso_record_free(borders);
    }
    o.steps = 1;
    gsl_test_int((int)iso_stability_chart(ctx, &o, &grid, &borders), ISO_BAD_ARGUMENT, "steps");
}

int main(void)
{
    ctx = iso_context_create();
    check_by_gsl();
    check_scenes();
    check_polish();
    check_middle_axis();
    check_none();
    check_orbits();
    check_ball();
    check_branch();
    check_chart();
    iso_context_free(ctx);
    return gsl_test_summary();
}

/* What accuracy costs (study/cost.h): that the errors told are the true ones, that fits find orders and what is broken,
 * and that what is chosen is the cheapest. How long anything takes is no test. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "laws.h"
#include "method/integrator_impl.h"
#include "reference.h"
#include "scenes.h"
#include "study/cost.h"
#include "study/cost_impl.h"

static iso_context *ctx;

/* --- scenes ----------------------------------------------------------------------------------------------------- */

static iso_scene scene_of(double k, const double J[3], double end)
{
    static const double omega[3] = {0.8, -0.6, 0}, normal[3] = {0.36, 0.48, 0.8};
    iso_scene s = iso_scene_default();
    s.params = laws_params(k, J);
    s.end = end;
    if (iso_start_ball(ctx, omega, normal, ISO_SPIN_REFUSE, &s.start) != ISO_OK) scene_stops("a start", ctx);
    return s;
}

static iso_scene plane_scene(void)
{
    return scene_of(1, (const double[]){1, 2, 4}, 40);
}

static iso_cost *measure(const iso_scene *scene, const iso_cost_options *o)
{
    iso_cost *c;
    if (iso_cost_measure(ctx, scene, o, &c) != ISO_OK) scene_stops("a measurement", ctx);
    return c;
}

static bool is_measured(const iso_cost_cell *cell)
{
    return cell->status == ISO_OK && cell->repeats > 0;
}

static const char *name_of(const iso_cost_cell *cell)
{
    return cell->method ? cell->method->name : "exact";
}

/* --- errors against quadruple precision ------------------------------------------------------------------------- */

/* The error of a cell at one time, from the file. */
static double true_error(const reference *r, const iso_cost_cell *cell)
{
    iso_orbit *orbit;
    iso_sample s;
    iso_orbit_options o = iso_orbit_defaults(&r->start);
    o.backend = cell->backend;
    o.method = cell->method;
    o.tolerance = cell->tolerance;
    if (iso_orbit_create(ctx, &r->p, &r->start, &o, &orbit) != ISO_OK || iso_orbit_at(orbit, r->t, &s) != ISO_OK)
        scene_stops("an orbit", ctx);
    iso_orbit_free(orbit);
    return fmax(relative_difference(r->ball, s.ball), relative_difference(r->ball + 3, s.ball + 3));
}

/* The numbers of the file are no doubles: a start that is rounded is that of a neighbour. */
static double rounding_of(const reference *r)
{
    return 4e-16 * (1 + r->t * norm(r->start.y));
}

static void compare_with(const reference *r, const char *method, laws_worst *high, laws_worst *low, laws_worst *below)
{
    iso_scene s = iso_scene_default();
    iso_cost_options o = iso_cost_defaults();
    s.params = r->p;
    s.start = r->start;
    s.end = r->t;
    o.quick = true;
    o.times = 1;
    o.seconds = 0.2;
    o.method = iso_method_find(method);
    iso_cost *c = measure(&s, &o);
    for (int i = 0; i < c->cells; i++) {
        const iso_cost_cell *cell = &c->cell[i];
        char where[64];
        snprintf(where, sizeof where, "%s at %g, t = %g", name_of(cell), cell->tolerance, r->t);
        if (cell->status != ISO_OK) continue;
        const double error = true_error(r, cell), rounding = rounding_of(r) + c->uncertainty;
        laws_note(cell->below ? below : high, error, cell->below ? 4 * rounding : 2 * cell->error + rounding, &r->p,
                  where);
        laws_note(low, cell->error, 2 * error + 3 * rounding, &r->p, where);
    }
    iso_cost_free(c);
}

static void check_references(void)
{
    static const char *const methods[] = {"rk8pd", "dormand_prince", "adams", "taylor"};
    reference rows[REFERENCE_ROWS];
    laws_worst high = {0}, low = {0}, below = {0};
    const int count = reference_read(ctx, rows);
    for (int i = 0; i < count; i++)
        for (int m = 0; m < 4; m++)
            if (rows[i].t <= 100) compare_with(&rows[i], methods[m], &high, &low, &below);
    laws_report(&high, "a true error is at most twice what is told");
    laws_report(&low, "what is told is at most twice the true error");
    if (below.cases > 0) laws_report(&below, "what is told as below the reference's uncertainty is");
}

/* --- orders, and a broken method -------------------------------------------------------------------------------- */

/* rk8pd with an error of second order in each step, as of a wrong coefficient. */
static iso_status broken_step(iso_integrator *it, double y[], double *h)
{
    double f[ISO_MAX_STATE];
    const iso_status status = iso_method_find("rk8pd")->step(it, y, h);
    it->model.rhs(&it->model, y, f);
    for (int i = 0; status == ISO_OK && i < it->model.dim; i++) y[i] += 1e-3 * *h * fabs(*h) * f[i];
    return status;
}

static void check_broken(void)
{
    iso_method broken = *iso_method_find("rk8pd");
    const iso_scene s = plane_scene();
    iso_cost_options o = iso_cost_defaults();
    o.seconds = 1;
    o.backend = ISO_BALL;
    o.method = iso_method_find("rk8pd");
    iso_cost *good = measure(&s, &o);
    broken.step = broken_step;
    o.method = &broken;
    iso_cost *bad = measure(&s, &o);
    gsl_test(!(fabs(good->line[0].order - 8) < 1.5), "rk8pd has order %.2f", good->line[0].order);
    gsl_test(!(bad->line[0].order > 0 && bad->line[0].order < 2), "broken, it has order %.2f", bad->line[0].order);
    gsl_test(!(bad->line[0].least > 1e-6 && good->line[0].least < 1e-12), "broken, it reaches %.1e, otherwise %.1e",
             bad->line[0].least, good->line[0].least);
    iso_cost_free(good);
    iso_cost_free(bad);
}

/* Lines of fewer than four cells have too few for a slope; that of embedded pairs may be one more than their order. */
static void check_orders(const iso_cost *c)
{
    int lines = 0;
    for (int l = 0; l < c->lines; l++) {
        const iso_cost_line *line = &c->line[l];
        int cells = 0;
        for (int i = 0; i < line->count; i++) cells += is_measured(&c->cell[line->first + i]);
        if (!line->method || line->method->order == 0 || line->method->order > 8 || cells < 4) continue;
        const double least = 0.8 * line->method->order, most = 1.15 * line->method->order + 2;
        gsl_test(!(line->order > least && line->order < most), "%s %s: order %d is found as %.2f",
                 iso_picture_name((int)line->backend), line->method->name, line->method->order, line->order);
        lines++;
    }
    gsl_test(lines < 20, "orders of %d lines", lines);
}

/* --- cells, what is chosen -------------------------------------------------------------------------------------- */

static void check_cells(const iso_cost *c, const char *scene)
{
    int measured = 0, strange = 0;
    for (int i = 0; i < c->cells; i++) {
        const iso_cost_cell *x = &c->cell[i];
        if (x->status != ISO_OK) strange += x->why[0] == 0;
        if (!is_measured(x)) continue;
        measured++;
        strange += !(x->error >= 0 && x->setup >= 0 && x->fastest > 0 && x->fastest <= x->median &&
                     x->median <= x->slowest && x->total == x->setup + x->median && x->repeats >= 3);
        strange += x->below != (x->error < 3 * c->uncertainty) && x->backend != ISO_EXACT;
        strange += x->backend != ISO_EXACT && x->statistics.steps == 0;
    }
    gsl_test(strange > 0 || measured == 0, "%s: %d cells make sense, %d do not", scene, measured, strange);
    gsl_test(!c->complete || !(c->turns > 0) || c->lines == 0, "%s: %d lines, %.1f turns", scene, c->lines, c->turns);
}

/* As exact as can be told, and faster by more than 5 %. */
static bool is_beaten(const iso_cost *c, const iso_cost_cell *by, const iso_cost_cell *cell)
{
    const double a = by->below ? fmax(by->error, c->uncertainty) : by->error;
    const double b = cell->below ? fmax(cell->error, c->uncertainty) : cell->error;
    return is_measured(by) && a <= b && 1.05 * by->total < cell->total;
}

static void check_front(const iso_cost *c)
{
    int wrong = 0, front = 0;
    for (int i = 0; i < c->cells; i++) {
        bool beaten = !is_measured(&c->cell[i]) || !(c->cell[i].error < 0.1);
        for (int j = 0; j < c->cells; j++) beaten = beaten || is_beaten(c, &c->cell[j], &c->cell[i]);
        wrong += c->cell[i].pareto == beaten;
        front += c->cell[i].pareto;
    }
    gsl_test(wrong > 0 || front < 3, "%d cells are beaten by none (%d wrong)", front, wrong);
}

static void check_choice(const iso_cost *c)
{
    int wrong = 0;
    double before = 0;
    for (double want = 1e-1; want > 1e-17; want /= 10) {
        const iso_cost_cell *best = iso_cost_choose(c, want);
        for (int i = 0; i < c->cells; i++) {
            const iso_cost_cell *x = &c->cell[i];
            const bool may = is_measured(x) && x->error <= want && (!x->below || c->uncertainty <= want);
            wrong += may && (!best || x->total < best->total);
            wrong += best == x && !may;
        }
        if (!best) continue;
        wrong += best->total < before;
        before = best->total;
    }
    gsl_test(wrong, "the choice is the cheapest that is exact enough");
    gsl_test(iso_cost_choose(c, 0) != NULL, "nothing is exact");
    gsl_test(iso_cost_choose(c, 1e-9) == NULL, "something reaches 1e-9");
}

/* Pairs of lines whose times for 1e-6 differ by more than 1.5, and those of which the order is another in two
 * measurements: for the eye. */
static double time_at(const iso_cost *c, const iso_cost_line *l, double error)
{
    for (int i = 0; i + 1 < l->count; i++) {
        const iso_cost_cell *a = &c->cell[l->first + i], *b = a + 1;
        if (!is_measured(a) || !is_measured(b) || !(a->error >= error && b->error <= error && b->error > 0)) continue;
        const double share = a->error > b->error ? log(a->error / error) / log(a->error / b->error) : 0;
        return a->median * pow(b->median / a->median, share);
    }
    return NAN;
}

static void print_ranking(const iso_cost *a, const iso_cost *b)
{
    static const double errors[] = {1e-5, 1e-8, 1e-11};
    int pairs = 0, turned = 0;
    for (int e = 0; e < 3; e++)
        for (int i = 0; i < a->lines && a->lines == b->lines; i++)
            for (int j = 0; j < i; j++) {
                const double one = time_at(a, &a->line[i], errors[e]) / time_at(a, &a->line[j], errors[e]);
                const double two = time_at(b, &b->line[i], errors[e]) / time_at(b, &b->line[j], errors[e]);
                if (!(fabs(log(one)) > log(1.5)) || isnan(two)) continue;
                pairs++;
                turned += (one > 1) != (two > 1);
            }
    printf("ranking of %d pairs of lines more than 1.5 apart: %d change sides when measured again\n", pairs, turned);
}

static void check_plane(void)
{
    iso_cost_options o = iso_cost_defaults();
    const iso_scene s = plane_scene();
    o.seconds = 6;
    iso_cost *c = measure(&s, &o), *again = measure(&s, &o);
    check_cells(c, "a ball on a plane");
    check_orders(c);
    check_front(c);
    check_choice(c);
    const iso_cost_cell *exact = &c->cell[c->cells - 1];
    gsl_test(exact->backend != ISO_EXACT || !(exact->error < 1e-13), "the closed solution, by another: %.1e",
             exact->error);
    gsl_test(strstr(c->reference, "closed") == NULL, "measured against %s", c->reference);
    gsl_test(!(c->uncertainty < 1e-13), "which is known to %.1e", c->uncertainty);
    print_ranking(c, again);
    iso_cost_free(c);
    iso_cost_free(again);
}

/* --- other scenes ----------------------------------------------------------------------------------------------- */

static void check_scene(const iso_scene *s, const char *name, bool point, bool exact, double uncertainty)
{
    bool has_point = false, has_exact = false;
    iso_cost_options o = iso_cost_defaults();
    o.quick = true;
    o.seconds = 1;
    iso_cost *c = measure(s, &o);
    check_cells(c, name);
    for (int i = 0; i < c->lines; i++) {
        has_point = has_point || c->line[i].backend == ISO_POINT;
        has_exact = has_exact || c->line[i].backend == ISO_EXACT;
        gsl_test(c->line[i].method && c->line[i].method->reference, "%s: no slow reference among the lines", name);
    }
    gsl_test(has_point != point || has_exact != exact, "%s: the backends that it has", name);
    gsl_test(!(c->uncertainty < uncertainty), "%s: known to %.1e by %s and %s", name, c->uncertainty, c->reference,
             c->second);
    iso_cost_free(c);
}

static void check_scenes(void)
{
    static const double J[3] = {1.4, 2.1, 3.0}, M[3] = {0.64, 1, -0.48}, gamma[3] = {0.6, 0, 0.8}, eps = 0.5;
    iso_scene s = scene_of(0.7, J, 20);
    check_scene(&s, "k = 0.7", true, false, 1e-13);
    add_field(&s.effects);
    check_scene(&s, "field", true, false, 1e-13);
    s = scene_of(0.7, J, -20);
    s.effects.on[ISO_GRAVITY] = true;
    s.effects.mgb = 0.5;
    s.effects.up[2] = 1;
    check_scene(&s, "gravity, backwards", false, false, 1e-11);
    s = scene_of(0.7, J, 5);
    if (iso_params_set_D(ctx, 0.4, &s.params) != ISO_OK) scene_stops("D", ctx);
    add_twist(300, &s.effects);
    check_scene(&s, "stiff twist", false, false, 1e-6);
    s = scene_of(-1, J, 20);
    if (iso_start_point(ctx, M, gamma, &eps, false, &s.start) != ISO_OK) scene_stops("a point", ctx);
    check_scene(&s, "a point", true, true, 1e-13);
}

/* --- refusals and ends ------------------------------------------------------------------------------------------ */

static void refuse(const iso_scene *s, const iso_cost_options *o, iso_status status, const char *field)
{
    iso_cost *c;
    const iso_status got = iso_cost_measure(ctx, s, o, &c);
    gsl_test(got != status || c || strcmp(iso_context_field(ctx), field) != 0, "refused about '%s': %s", field,
             iso_context_message(ctx));
}

static void check_refusals(void)
{
    const iso_cost_options all = iso_cost_defaults();
    iso_cost_options o = all;
    iso_cost_growth growth;
    iso_scene s = scene_of(0.7, (const double[]){1, 2, 4}, 0);
    refuse(&s, &all, ISO_BAD_ARGUMENT, "end");
    s.end = INFINITY;
    refuse(&s, &all, ISO_BAD_ARGUMENT, "end");
    s.end = 10;
    o.backend = ISO_EXACT;
    refuse(&s, &o, ISO_BAD_ARGUMENT, "k");
    o = all;
    o.tolerance = 0.5;
    refuse(&s, &o, ISO_BAD_ARGUMENT, "tolerance");
    o = all;
    o.backend = ISO_BALL;
    o.method = iso_method_find("strang");
    refuse(&s, &o, ISO_BAD_ARGUMENT, "method");
    s.effects.on[ISO_GRAVITY] = true;
    s.effects.mgb = 1;
    s.effects.up[2] = 1;
    o.method = NULL;
    o.backend = ISO_POINT;
    refuse(&s, &o, ISO_NOT_MAPPED, "gravity");
    s.effects.mgb = NAN;
    refuse(&s, &all, ISO_BAD_INPUT, "mgb");
    gsl_test(iso_cost_grow(ctx, &s, &(iso_cost_cell){0}, 0, &growth) != ISO_BAD_ARGUMENT ||
                 strcmp(iso_context_field(ctx), "horizons") != 0,
             "no horizons are refused");
}

/* A method that cannot get there in time does not hold up the others. */
static void check_hopeless(void)
{
    const iso_scene s = plane_scene();
    iso_cost_options o = iso_cost_defaults();
    o.seconds = 0.5;
    o.method = iso_method_find("strang");
    iso_cost *c = measure(&s, &o);
    const iso_cost_cell *last = &c->cell[c->cells - 1];
    gsl_test(last->status != ISO_STOPPED || last->repeats > 0 || !strstr(last->why, "not tried"), "hopeless: %s",
             last->why);
    gsl_test(!is_measured(&c->cell[0]) || !c->complete, "what is loose is measured");
    gsl_test(!(c->seconds < 5), "it ends, after %.2g s for 0.5", c->seconds);
    iso_cost_free(c);
}

static bool count_down(void *data)
{
    int *left = data;
    return --*left > 0;
}

static void check_stops(void)
{
    const iso_scene s = plane_scene();
    iso_cost_options o = iso_cost_defaults();
    iso_cost *c = NULL;
    iso_cost_growth growth;
    int left = 0;
    o.quick = true;
    iso_context_watch(ctx, count_down, &left);
    gsl_test(iso_cost_measure(ctx, &s, &o, &c) != ISO_STOPPED || c, "stopped at once, nothing is told");
    left = 2000;
    gsl_test(iso_cost_measure(ctx, &s, &o, &c) != ISO_STOPPED || !c || c->complete || c->cells == 0,
             "stopped later, there is what was measured");
    iso_cost_free(c);
    left = 3;
    const iso_cost_cell cell = {.backend = ISO_BALL, .method = iso_method_find("rk8pd"), .tolerance = 1e-9};
    gsl_test(iso_cost_grow(ctx, &s, &cell, 4, &growth) != ISO_STOPPED, "growth is stopped");
    iso_context_watch(ctx, NULL, NULL);
}

/* --- growth ----------------------------------------------------------------------------------------------------- */

static iso_cost_growth grow(const iso_scene *s, const char *method, double tolerance, int horizons)
{
    iso_cost_growth g;
    const iso_cost_cell cell = {.backend = ISO_BALL, .method = iso_method_find(method), .tolerance = tolerance};
    if (iso_cost_grow(ctx, s, &cell, horizons, &g) != ISO_OK) scene_stops("growth", ctx);
    return g;
}

/* The e-fold time of the distance of two orbits that start 1e-13 apart, over [end, 4 end]. */
static double lyapunov_time(const iso_scene *s)
{
    iso_sample a, b;
    iso_orbit *one, *other;
    iso_scene moved = *s;
    iso_orbit_options o = iso_orbit_defaults(&s->start);
    double distance[2], aside[3];
    o.method = iso_method_find("taylor_extended");
    o.tolerance = 1e-15;
    cross(s->start.y + 3, s->start.y, aside); /* another speed would be the same path */
    add_scaled(moved.start.y, 1e-13, aside);
    if (iso_orbit_create(ctx, &s->params, &s->start, &o, &one) != ISO_OK ||
        iso_orbit_create(ctx, &s->params, &moved.start, &o, &other) != ISO_OK)
        scene_stops("an orbit", ctx);
    for (int i = 0; i < 2; i++) {
        const double t = (1 + 3 * i) * s->end;
        if (iso_orbit_at(one, t, &a) != ISO_OK || iso_orbit_at(other, t, &b) != ISO_OK) scene_stops("an orbit", ctx);
        distance[i] = fmax(relative_difference(a.ball, b.ball), relative_difference(a.ball + 3, b.ball + 3));
    }
    iso_orbit_free(one);
    iso_orbit_free(other);
    return 3 * s->end / log(distance[1] / distance[0]);
}

static void check_growth(void)
{
    iso_scene s = plane_scene();
    iso_cost_growth g = grow(&s, "rk8pd", 1e-9, 7);
    gsl_test(g.count != 7 || g.end[6] != 64 * s.end || g.chaotic, "seven horizons of a regular orbit");
    gsl_test(!(g.power > 0.8 && g.power < 2.3), "its error grows like t^%.2f", g.power);
    gsl_test(!isnan(g.lyapunov_time), "it has no Lyapunov time");
    for (int i = 1; i < g.count; i++)
        gsl_test(!(g.error[i] >= g.error[i - 1]), "t = %g: error %.1e, never less", g.end[i], g.error[i]);
    printf("time grows like t^%.2f\n", g.time_power);
    s = scene_of(0.3, (const double[]){1, 2, 5}, 60);
    g = grow(&s, "rk8pd", 1e-12, 5);
    gsl_test(!g.chaotic, "a chaotic orbit: t^%.2f", g.power);
    gsl_test(!(fabs(log(g.lyapunov_time / lyapunov_time(&s))) < log(1.5)), "Lyapunov time %.3g, of neighbours %.3g",
             g.lyapunov_time, lyapunov_time(&s));
}

/* --- numbers ---------------------------------------------------------------------------------------------------- */

static void check_numbers(void)
{
    cost_times times = {.count = 4};
    double x[7], y[7];
    iso_cost_cell cell = {.repeats = 0};
    for (int i = 0; i < COST_REPEATS; i++) times.stepping[i] = 1 + 1e-3 * (i % 3), times.setup[i] = 0.5;
    gsl_test(cost_times_settled(&times), "four times are too few");
    times.count = 5;
    gsl_test(!cost_times_settled(&times), "five that agree are enough");
    for (int i = 0; i < 5; i++) times.stepping[i] = 1 + i;
    gsl_test(cost_times_settled(&times), "five that do not agree are not");
    cost_times_tell(&times, &cell);
    gsl_test(cell.median != 3 || cell.fastest != 1 || cell.slowest != 5 || cell.total != 3.5,
             "least, median, largest");
    for (int i = 0; i < 7; i++) x[i] = i, y[i] = 2 - 3 * i;
    y[3] = 100;
    gsl_test_rel(cost_slope(7, x, y, 0.5), -3, 1e-12, "a slope, whatever one point says");
    gsl_test(!isnan(cost_slope(7, x, y, 10)), "no slope of points that are too near");
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx) return 1;
    check_numbers();
    check_refusals();
    check_stops();
    check_hopeless();
    check_references();
    check_broken();
    check_plane();
    check_scenes();
    check_growth();
    iso_context_free(ctx);
    return gsl_test_summary();
}

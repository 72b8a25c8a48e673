/* What accuracy costs (task/cost/cost.h): that the errors told are the true ones, that fits find orders and what is
 * broken, and that what is chosen is the cheapest. How long anything takes is no test. */
#include "method/integrator_impl.h"
#include "orbit/watch_impl.h"
#include "reference.h"
#include "scenes.h"
#include "studies.h"
#include "task/cost/cost_impl.h"

static iso_scene cost_scene(double k, const double J[3], double end)
{
    static const double omega[3] = {0.8, -0.6, 0}, normal[3] = {0.36, 0.48, 0.8};
    iso_scene s = ball_scene(k, J);
    s.end = end;
    must(iso_start_ball(ctx, omega, normal, ISO_SPIN_REFUSE, &s.start), "a start");
    return s;
}

static iso_scene cost_plane(void)
{
    return cost_scene(1, (const double[]){1, 2, 4}, 40);
}

/* The measured cost. A machine that is too slow for a reference in this time gets more of it. Ends the test when there
 * is none. */
static iso_cost *cost_of(const iso_scene *scene, const iso_cost_options *o)
{
    iso_cost_options longer = *o;
    iso_cost *c;
    while (iso_cost_measure(ctx, scene, &longer, &c) != ISO_OK) {
        laws_stop_if(ctx, !strstr(iso_context_message(ctx), "too long") || longer.seconds > 100, "a measurement");
        longer.seconds *= 4;
    }
    return c;
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
    laws_stop_if(
        ctx, iso_orbit_create(ctx, &r->p, &r->start, &o, &orbit) != ISO_OK || iso_orbit_at(orbit, r->t, &s) != ISO_OK,
        "an orbit");
    iso_orbit_free(orbit);
    return iso_distance(r->ball, s.ball);
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
    iso_cost *c = cost_of(&s, &o);
    /* the numbers of the file are no doubles: a start that is rounded is that of a neighbour */
    const double of_start = 4e-16 * (1 + r->t * norm(r->start.y));
    for (int i = 0; i < c->cells; i++) {
        const iso_cost_cell *cell = &c->cell[i];
        char where[64];
        snprintf(where, sizeof where, "%s at %g, t = %g", cell->method ? cell->method->name : "exact",
                 cell->tolerance, r->t);
        if (cell->status != ISO_OK) continue;
        const double error = true_error(r, cell), rounding = of_start + c->uncertainty;
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
    for (int i = 0; i < count; i += tests_length(3, 1))
        for (int m = i % 2; m < 4; m += 2)
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
    const iso_scene s = cost_plane();
    iso_cost_options o = iso_cost_defaults();
    o.seconds = 1;
    o.backend = ISO_BACKEND_BALL;
    o.method = iso_method_find("rk8pd");
    iso_cost *good = cost_of(&s, &o);
    broken.step = broken_step;
    o.method = &broken;
    iso_cost *bad = cost_of(&s, &o);
    gsl_test(!(fabs(good->series[0].order - 8) < 1.5), "rk8pd has order %.2f", good->series[0].order);
    gsl_test(!(bad->series[0].order > 0 && bad->series[0].order < 2), "broken, it has order %.2f",
             bad->series[0].order);
    gsl_test(!(bad->series[0].least > 1e-6 && good->series[0].least < 1e-12),
             "broken, it reaches %.1e, otherwise %.1e", bad->series[0].least, good->series[0].least);
    iso_cost_free(good);
    iso_cost_free(bad);
}

/* Lines of fewer than four cells have too few for a slope; methods may be better than their order. */
static void check_orders(const iso_cost *c)
{
    int lines = 0;
    for (int l = 0; l < c->series_count; l++) {
        const iso_cost_series *series = &c->series[l];
        int cells = 0;
        for (int i = 0; i < series->count; i++) cells += iso_cost_is_measured(&c->cell[series->first + i]);
        if (!series->method || series->method->order == 0 || series->method->order > 8 || cells < 4) continue;
        const double least = 0.8 * series->method->order, most = 1.15 * series->method->order + 2;
        gsl_test(!(series->order > least && series->order < most), "%s %s: order %d is found as %.2f",
                 iso_backend_name((int)series->backend), series->method->name, series->method->order, series->order);
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
        if (!iso_cost_is_measured(x)) continue;
        measured++;
        strange += !(x->error >= 0 && x->setup >= 0 && x->fastest > 0 && x->fastest <= x->median &&
                     x->median <= x->slowest && x->total == x->setup + x->median && x->repeats >= 3);
        strange += x->below != (x->error < 3 * c->uncertainty) && x->backend != ISO_BACKEND_EXACT;
        strange += x->backend != ISO_BACKEND_EXACT && x->statistics.steps == 0;
    }
    gsl_test(strange > 0 || measured == 0, "%s: %d cells make sense, %d do not", scene, measured, strange);
    gsl_test(!c->complete || !(c->turns > 0) || c->series_count == 0, "%s: %d lines, %.1f turns", scene,
             c->series_count, c->turns);
}

/* As exact as can be told, and faster by more than 5 %. */
static bool is_beaten(const iso_cost *c, const iso_cost_cell *by, const iso_cost_cell *cell)
{
    const double a = by->below ? fmax(by->error, c->uncertainty) : by->error;
    const double b = cell->below ? fmax(cell->error, c->uncertainty) : cell->error;
    return iso_cost_is_measured(by) && a <= b && 1.05 * by->total < cell->total;
}

static void check_front(const iso_cost *c)
{
    int wrong = 0, front = 0;
    for (int i = 0; i < c->cells; i++) {
        bool beaten = !iso_cost_is_measured(&c->cell[i]) || !(c->cell[i].error < 0.1);
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
        const iso_cost_cell *best = iso_cost_choose(c, false, NULL, want);
        for (int i = 0; i < c->cells; i++) {
            const iso_cost_cell *x = &c->cell[i];
            const bool may = iso_cost_is_measured(x) && x->error <= want && (!x->below || c->uncertainty <= want);
            wrong += may && (!best || x->total < best->total);
            wrong += best == x && !may;
        }
        if (!best) continue;
        wrong += best->total < before;
        before = best->total;
    }
    gsl_test(wrong, "the choice is the cheapest that is exact enough");
    gsl_test(iso_cost_choose(c, false, NULL, 0) != NULL, "nothing is exact");
    gsl_test(iso_cost_choose(c, false, NULL, 1e-9) == NULL, "something reaches 1e-9");
}

static void check_plane(void)
{
    iso_cost_options o = iso_cost_defaults();
    const iso_scene s = cost_plane();
    o.seconds = 4;
    iso_cost *c = cost_of(&s, &o);
    check_cells(c, "a ball on a plane");
    check_orders(c);
    check_front(c);
    check_choice(c);
    const iso_cost_cell *exact = &c->cell[c->cells - 1];
    gsl_test(exact->backend != ISO_BACKEND_EXACT || !(exact->error < 1e-13), "the closed solution, by another: %.1e",
             exact->error);
    gsl_test(strstr(c->reference, "closed") == NULL, "measured against %s", c->reference);
    gsl_test(!(c->uncertainty < 1e-13), "which is known to %.1e", c->uncertainty);
    iso_cost_free(c);
}

/* --- other scenes ----------------------------------------------------------------------------------------------- */

static void check_scene(const iso_scene *s, const char *name, bool point, bool exact, double uncertainty)
{
    bool has_point = false, has_exact = false;
    iso_cost_options o = iso_cost_defaults();
    o.quick = true;
    iso_cost *c = NULL;
    for (o.seconds = 1; !c || (!(c->uncertainty < uncertainty) && o.seconds < 100); o.seconds *= 8) {
        iso_cost_free(c); /* a slow machine had no time for a second reference */
        c = cost_of(s, &o);
    }
    check_cells(c, name);
    for (int i = 0; i < c->series_count; i++) {
        has_point = has_point || c->series[i].backend == ISO_BACKEND_POINT;
        has_exact = has_exact || c->series[i].backend == ISO_BACKEND_EXACT;
        gsl_test(c->series[i].method && c->series[i].method->reference, "%s: no slow reference among the lines",
                 name);
    }
    gsl_test(has_point != point || has_exact != exact, "%s: the backends that it has", name);
    gsl_test(!(c->uncertainty < uncertainty), "%s: known to %.1e by %s and %s", name, c->uncertainty, c->reference,
             c->second);
    iso_cost_free(c);
}

static void check_scenes(void)
{
    static const double J[3] = {1.4, 2.1, 3.0}, M[3] = {0.64, 1, -0.48}, gamma[3] = {0.6, 0, 0.8}, eps = 0.5;
    iso_scene s = cost_scene(0.7, J, 20);
    check_scene(&s, "k = 0.7", true, false, 1e-13);
    add_field(&s.effects);
    check_scene(&s, "field", true, false, 1e-13);
    s = cost_scene(0.7, J, -20);
    s.effects.on[ISO_GRAVITY] = true;
    GRAVITY_MGB(&s.effects) = 0.5;
    GRAVITY_UP(&s.effects)[2] = 1;
    check_scene(&s, "gravity, backwards", false, false, 1e-11);
    s = cost_scene(0.7, J, 5);
    laws_stop_if(ctx, iso_params_set_D(ctx, 0.4, &s.params) != ISO_OK, "D");
    add_twist(300, &s.effects);
    check_scene(&s, "stiff twist", false, false, 1e-6);
    s = cost_scene(-1, J, 20);
    laws_stop_if(ctx, iso_start_point(ctx, M, gamma, &eps, false, &s.start) != ISO_OK, "a point");
    check_scene(&s, "a point", true, true, 1e-13);
}

static void check_numbers(void)
{
    cost_times times = {.count = 4};
    double x[7], y[7];
    iso_cost_cell cell = {.repeats = 0};
    for (int i = 0; i < COST_REPEATS; i++) times.stepping[i] = 1 + 1e-3 * (i % 3), times.setup[i] = 0.5;
    gsl_test(iso_cost_times_settled(&times), "four times are too few");
    times.count = 5;
    gsl_test(!iso_cost_times_settled(&times), "five that agree are enough");
    for (int i = 0; i < 5; i++) times.stepping[i] = 1 + i;
    gsl_test(iso_cost_times_settled(&times), "five that do not agree are not");
    iso_cost_times_read(&times, &cell);
    gsl_test(cell.median != 3 || cell.fastest != 1 || cell.slowest != 5 || cell.total != 3.5,
             "least, median, largest");
    for (int i = 0; i < 7; i++) x[i] = i, y[i] = 2 - 3 * i;
    y[3] = 100;
    gsl_test_rel(iso_cost_slope(7, x, y, 0.5), -3, 1e-12, "a slope, whatever one point says");
    gsl_test(!isnan(iso_cost_slope(7, x, y, 10)), "no slope of points that are too near");
}

/* --- refusals and ends ------------------------------------------------------------------------------------------ */

static void refuse(const iso_scene *s, const iso_cost_options *o, iso_status status, const char *field)
{
    iso_cost *c;
    const iso_status got = iso_cost_measure(ctx, s, o, &c);
    gsl_test(got != status || c || strcmp(iso_context_about(ctx), field) != 0, "refused about '%s': %s", field,
             iso_context_message(ctx));
}

static void check_refusals(void)
{
    const iso_cost_options all = iso_cost_defaults();
    iso_cost_options o = all;
    iso_scene s = cost_scene(0.7, (const double[]){1, 2, 4}, 0);
    refuse(&s, &all, ISO_BAD_ARGUMENT, "end");
    s.end = INFINITY;
    refuse(&s, &all, ISO_BAD_ARGUMENT, "end");
    s.end = 10;
    o.backend = ISO_BACKEND_EXACT;
    refuse(&s, &o, ISO_BAD_ARGUMENT, "k");
    o = all;
    o.tolerance = 0.5;
    refuse(&s, &o, ISO_BAD_ARGUMENT, "tolerance");
    o = all;
    o.backend = ISO_BACKEND_BALL;
    o.method = iso_method_find("strang");
    refuse(&s, &o, ISO_BAD_ARGUMENT, "method");
    s.effects.on[ISO_GRAVITY] = true;
    GRAVITY_MGB(&s.effects) = 1;
    GRAVITY_UP(&s.effects)[2] = 1;
    o.method = NULL;
    o.backend = ISO_BACKEND_POINT;
    refuse(&s, &o, ISO_NOT_MAPPED, "gravity");
    GRAVITY_MGB(&s.effects) = NAN;
    refuse(&s, &all, ISO_BAD_INPUT, "mgb");
}

/* A method that cannot get there in time does not hold up the others. */
static void check_hopeless(void)
{
    const iso_scene s = cost_plane();
    iso_cost_options o = iso_cost_defaults();
    o.seconds = 0.5;
    o.method = iso_method_find("strang");
    iso_cost *c = cost_of(&s, &o);
    const iso_cost_cell *last = &c->cell[c->cells - 1];
    gsl_test(last->status != ISO_STOPPED || last->repeats > 0 || !strstr(last->why, "not tried"), "hopeless: %s",
             last->why);
    gsl_test(!iso_cost_is_measured(&c->cell[0]) || !c->complete, "what is loose is measured");
    gsl_test(!(c->seconds < 50), "it ends, after %.2g s for 0.5", c->seconds);
    iso_cost_free(c);
}

static void check_stops(void)
{
    const iso_scene s = cost_plane();
    iso_cost_options o = iso_cost_defaults();
    iso_cost *c = NULL;
    int left = 0;
    o.quick = true;
    iso_context_set_monitor(ctx, some_times, &left);
    gsl_test(iso_cost_measure(ctx, &s, &o, &c) != ISO_STOPPED || c, "stopped at once, nothing is told");
    left = 2000;
    gsl_test(iso_cost_measure(ctx, &s, &o, &c) != ISO_STOPPED || !c || c->complete || c->cells == 0,
             "stopped later, there is what was measured");
    iso_cost_free(c);
    iso_context_set_monitor(ctx, NULL, NULL);
}

int main(void)
{
    ctx = iso_context_create();
    check_numbers();
    check_references();
    check_broken();
    check_plane();
    check_scenes();
    check_refusals();
    check_stops();
    check_hopeless();
    iso_context_free(ctx);
    return gsl_test_summary();
}

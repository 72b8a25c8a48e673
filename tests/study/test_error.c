/* The estimated error of an orbit (study/error.h) covers the true one, and is not much larger. */
#include "orbit/watch_impl.h"
#include "reference.h"
#include "scenes.h"
#include "study/study_impl.h"

static iso_context *ctx;

/* An orbit run to t in a number of rows, and what is thought of its error. */
typedef struct trial {
    iso_orbit *orbit;
    iso_sample last;
    iso_error error;
    iso_status found;
} trial;

static trial *try(const iso_params *p, const iso_start *start, const iso_orbit_options *o, double t, size_t rows)
{
    trial *r = calloc(1, sizeof *r);
    iso_error_finder *finder;
    laws_stop_if(ctx, !r || iso_orbit_create(ctx, p, start, o, &r->orbit) != ISO_OK, "an orbit");
    r->found = iso_error_finder_create(ctx, p, start, o, r->orbit, &finder);
    for (size_t i = 0; i < rows; i++) {
        laws_stop_if(
            ctx, iso_orbit_at(r->orbit, i + 1 == rows ? t : t * (double)i / (double)(rows - 1), &r->last) != ISO_OK,
            "an orbit stops");
        if (r->found == ISO_OK) r->found = iso_error_finder_add(finder, &r->last);
    }
    if (r->found == ISO_OK) r->error = iso_error_finder_read(finder);
    iso_error_finder_free(finder);
    return r;
}

static void end(trial *r)
{
    iso_orbit_free(r->orbit);
    free(r);
}

/* How a true error compares with its estimate: to be covered, by at most 50 times and what rounding may be. */
static void compare(laws_worst *covered, laws_worst *tight, double true_error, double estimate, const iso_params *p,
                    const char *where)
{
    laws_note(covered, true_error, estimate, p, where);
    laws_note(tight, estimate, 50 * true_error + 1e-12, p, where);
}

static void check_references(const char *method, double tolerance, iso_backend backend, double longest)
{
    reference rows[REFERENCE_ROWS];
    laws_worst state = {0}, state_tight = {0}, clock = {0}, clock_tight = {0};
    const int count = reference_read(ctx, rows);
    for (int i = 0; i < count; i++) {
        const reference *r = &rows[i];
        char where[64], title[128];
        if (r->t > longest) continue;
        iso_orbit_options o = iso_orbit_defaults(&r->start);
        o.backend = backend;
        o.method = iso_method_find(method);
        o.tolerance = tolerance;
        o.with_clock[ISO_CLOCK_S] = true;
        trial *run = try(&r->p, &r->start, &o, r->t, 5);
        snprintf(where, sizeof where, "t = %g", r->t);
        snprintf(title, sizeof title, "%s at %g, backend %s", method, tolerance, iso_backend_name((int)backend));
        gsl_test(run->found != ISO_OK, "%s, row %d: an estimate", title, i);
        compare(&state, &state_tight, iso_distance(run->last.ball, r->ball), run->error.state[ISO_BALL].last, &r->p,
                where);
        compare(&clock, &clock_tight, fabs(run->last.clock[ISO_CLOCK_S] / r->s - 1),
                run->error.clock[ISO_CLOCK_S].last, &r->p, where);
        end(run);
    }
    printf("%s at %g, backend %s:\n", method, tolerance, iso_backend_name((int)backend));
    laws_report(&state, "the error of (w, n) is covered");
    laws_report(&state_tight, "and not much overestimated");
    laws_report(&clock, "the error of s is covered");
    laws_report(&clock_tight, "and not much overestimated");
}

static const double J[3] = {1.4, 2.1, 3.0};

/* A contact that resists twisting as strongly as this; the truth is by bsimp at 1e-14. */
static void check_stiff(double c)
{
    iso_params p = laws_params(-0.6, J);
    const iso_start start = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    iso_effects effects = {.on[ISO_TWIST] = true, .number[ISO_TWIST] = {c}};
    iso_orbit_options o = iso_orbit_defaults(&start);
    laws_stop_if(ctx, iso_params_set_D(ctx, 0.4, &p) != ISO_OK, "D");
    o.effects = &effects;
    for (double tolerance = 1e-6; tolerance > 1e-12; tolerance *= 1e-2) {
        laws_worst covered = {0}, tight = {0};
        o.tolerance = tolerance;
        o.method = NULL;
        trial *run = try(&p, &start, &o, 10, 5);
        gsl_test(run->found != ISO_OK || run->error.method != iso_orbit_method(run->orbit), "c = %g: by %s again", c,
                 iso_orbit_method(run->orbit)->name);
        o.method = iso_method_find("bsimp");
        o.tolerance = 1e-14;
        trial *truth = try(&p, &start, &o, 10, 5);
        compare(&covered, &tight, iso_distance(run->last.ball, truth->last.ball), run->error.state[ISO_BALL].last, &p,
                "t = 10");
        printf("c = %g, tolerance %g:\n", c, tolerance);
        laws_report(&covered, "the error is covered");
        laws_report(&tight, "and not much overestimated");
        end(run);
        end(truth);
    }
}

/* --- every row -------------------------------------------------------------------------------------------------- */

/* The largest true error of the rows of r; the truth is by the finest method there is. */
static double true_error(const trial *r, const iso_params *p, const iso_start *start,
                         const iso_orbit_options *options, double t, size_t rows)
{
    iso_orbit_options o = *options;
    iso_orbit *truth;
    iso_sample a, b;
    double worst = 0;
    o.method = iso_method_find(iso_method_find("taylor_quad") ? "taylor_quad" : "taylor_extended");
    o.tolerance = 1e-15;
    laws_stop_if(ctx, iso_orbit_create(ctx, p, start, &o, &truth) != ISO_OK, "the truth");
    for (size_t i = 0; i < rows; i++) {
        const double time = i + 1 == rows ? t : t * (double)i / (double)(rows - 1);
        laws_stop_if(ctx, iso_orbit_at(r->orbit, time, &a) != ISO_OK || iso_orbit_at(truth, time, &b) != ISO_OK,
                     "the truth stops");
        worst = fmax(worst, iso_distance(a.ball, b.ball));
    }
    iso_orbit_free(truth);
    return worst;
}

/* What is said to be the largest error covers that of every row, however many there are: for balls on a plane, max J/
 * min J = 400, in a linear field. From time to time they turn over quickly, and their error is large for a moment. */
static void check_every_row(int scenes)
{
    enum { ROWS = 5001 };
    const double t = 20;
    iso_random *random = iso_random_create(15);
    laws_worst covered = {0}, tight = {0};
    for (int i = 0; i < scenes; i++) {
        const iso_params p = laws_params(1, (const double[]){400, exp(iso_random_uniform(random, 0, log(400))), 1});
        iso_effects effects = {.on[ISO_FIELD] = true};
        iso_start start;
        char where[32];
        double n[3], omega[3];
        for (int j = 0; j < 3; j++) {
            FIELD_LINEAR(&effects)[j] = 0.3 * iso_random_normal(random);
            omega[j] = iso_random_normal(random);
        }
        iso_random_direction(random, n);
        laws_stop_if(ctx, iso_start_ball(ctx, omega, n, ISO_SPIN_REMOVE, &start) != ISO_OK, "a start");
        iso_orbit_options o = iso_orbit_defaults(&start);
        o.effects = &effects;
        o.tolerance = 1e-9;
        trial *r = try(&p, &start, &o, t, ROWS);
        snprintf(where, sizeof where, "scene %d", i);
        gsl_test(r->found != ISO_OK || r->error.rows != ROWS, "%s: the error of %zu rows", where, r->error.rows);
        compare(&covered, &tight, true_error(r, &p, &start, &o, t, ROWS), r->error.state[ISO_BALL].worst, &p, where);
        end(r);
    }
    laws_report(&covered, "the largest error of all rows is covered");
    laws_report(&tight, "and not much overestimated");
    iso_random_free(random);
}

/* A point's orbit backwards in s; what is not shown is not judged; nothing finer than the finest. */
static void check_others(void)
{
    const iso_params p = laws_params(-1, J);
    const iso_start start = {.model = ISO_POINT, .y = {0.64, 1, -0.48, 0.6, 0, 0.8}, .eps = NAN};
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.tolerance = 1e-3;
    trial *run = try(&p, &start, &o, -30, 1000);
    const iso_error *e = &run->error;
    gsl_test(run->found != ISO_OK || e->rows != 1000 || !isnan(e->state[ISO_BALL].worst) || !isnan(e->clock[0].worst),
             "a point alone has no omega, and no t");
    gsl_test(!(e->state[ISO_POINT].worst > 1e-6) || !(e->state[ISO_POINT].worst >= e->state[ISO_POINT].last) ||
                 !(e->state[ISO_POINT].worst_time < 0),
             "a loose tolerance makes a large error: %.1e at s = %g", e->state[ISO_POINT].worst,
             e->state[ISO_POINT].worst_time);
    gsl_test(!(e->start > 0 && e->start < 1e-10), "the start makes %.1e of it", e->start);
    end(run);
    o.method = iso_method_find("taylor_quad") ? iso_method_find("taylor_quad") : iso_method_find("taylor_extended");
    run = try(&p, &start, &o, 1, 2);
    gsl_test(run->found != ISO_BAD_ARGUMENT, "nothing is finer than %s: %s", o.method->name,
             iso_context_message(ctx));
    end(run);
}

/* Without a row nothing is known. */
static void check_no_rows(void)
{
    const iso_params p = laws_params(-1, J);
    const iso_start start = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    const iso_orbit_options o = iso_orbit_defaults(&start);
    trial *r = try(&p, &start, &o, 1, 0);
    gsl_test(r->found != ISO_OK || r->error.rows != 0 || !isnan(r->error.state[ISO_BALL].worst), "no rows, no error");
    end(r);
}

int main(void)
{
    const double longest = tests_length(100, 1000);
    ctx = iso_context_create();
    for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
        check_references("taylor", 1e-6, backend, 100);
        check_references("taylor", 1e-12, backend, longest);
        check_references("taylor", 1e-15, backend, longest);
        if (iso_method_find("taylor_quad"))
            check_references("taylor_extended", 1e-15, backend, tests_length(10, 100)); /* by gcc */
        check_references("rk8pd", 1e-12, backend, longest);
        check_references("adams", 1e-9, backend, 100);
    }
    check_references("blanes_moan6", 1e-8, ISO_BACKEND_POINT, 100);
    check_stiff(1e2);
    check_stiff(1e5);
    check_every_row(tests_length(2, 6));
    check_no_rows();
    check_others();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

/* test_sweep.c - the rows of sweeps: laws that hold for every quantity.
 *
 * - A row does not depend on the chunk it is computed in, on threads, or on the order of the chunks.
 * - No thread has more than one chunk that is not given away: so much is lost when a program is killed.
 * - Rows are what the functions of the library give for the scene.
 * - A point that fails is a row with its reason; the others are there.
 */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instrument/chaos/chaos.h"
#include "instrument/separatrix/separatrix.h"
#include "length.h"
#include "studies.h"
#include "sweep/sweep_impl.h"
#include "task/compare.h"

/* --- a plan by hand: k and J2 vary ------------------------------------------------------------------------------ */

enum { COUNT = 21 };

static const char names[][ISO_NAME_SIZE] = {"k", "J2"};
static iso_scene base;

/* k = -1 + 0.25 i; k = 0, of point 4, is no ball. */
static iso_status scene_of(iso_context *of, const void *data, size_t i, iso_scene *scene, double numbers[])
{
    (void)data;
    numbers[0] = -1 + 0.25 * (double)(i % 13);
    numbers[1] = 2 + 0.1 * (double)(i % 4);
    *scene = base;
    return iso_params_reduced(of, numbers[0], (double[]){1, numbers[1], 5}, &scene->params);
}

static int quantity(const char *name)
{
    int i = 0;
    while (strcmp(iso_sweep_quantities()[i]->name, name) != 0) i++;
    return i;
}

static void ask(iso_sweep_plan *plan, const char *name)
{
    iso_sweep_request *request = &plan->request[plan->requests++];
    request->quantity = quantity(name);
    const iso_sweep_setting *s = iso_sweep_quantities()[request->quantity]->settings;
    for (int i = 0; s && s[i].name; i++) request->setting[i] = s[i].usual;
    if (strcmp(name, "splitting") == 0) request->setting[0] = ISO_SEPARATRIX_DOUBLE; /* 128 bits take long */
}

static iso_sweep_plan plan_of(double turns, double time, size_t chunk)
{
    base = ball_scene(0.5, (double[]){1, 2, 5});
    base.end = 20;
    iso_sweep_plan plan = {.turns = turns, .time = time, .chunk = chunk};
    plan.family = (iso_family){.count = COUNT, .columns = 2, .name = names, .scene = scene_of, .base = &base};
    return plan;
}

/* --- laws ------------------------------------------------------------------------------------------------------- */

/* The rows of all points, and who computes them. */
typedef struct all {
    iso_sweep_rows rows;
    size_t next, chunks, step, seen;
    size_t away, most_away; /* chunks that are computed at the moment */
} all;

static bool next_chunk(void *data, size_t *c)
{
    all *a = data;
    if (a->next == a->chunks) return false;
    *c = a->next++ * a->step % a->chunks; /* in an order that jumps */
    if (++a->away > a->most_away) a->most_away = a->away;
    return true;
}

static iso_status take_chunk(void *data, iso_context *of, size_t c, const iso_sweep_rows *rows)
{
    all *a = data;
    (void)of, (void)c;
    const size_t width = (size_t)rows->columns;
    memcpy(a->rows.number + rows->first * width, rows->number, rows->count * width * sizeof(double));
    memcpy(a->rows.status + rows->first, rows->status, rows->count * sizeof *rows->status);
    memcpy(a->rows.reason + rows->first, rows->reason, rows->count * sizeof *rows->reason);
    a->seen += rows->count;
    a->away--;
    return ISO_OK;
}

static all measure(const iso_sweep_plan *plan, int threads, size_t step)
{
    iso_sweep *sweep;
    must(iso_sweep_create(ctx, plan, &sweep), "a sweep");
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    all a = {.chunks = iso_sweep_chunks(head), .step = step};
    const iso_sweep_source source = {next_chunk, take_chunk, &a};
    must(iso_sweep_rows_create(ctx, head->columns, head->count, &a.rows), "rows");
    must(iso_sweep_run(ctx, sweep, threads, &source), "the run");
    gsl_test(a.seen != COUNT, "all points are there: %zu", a.seen);
    gsl_test(a.most_away > (size_t)threads, "%zu chunks are computed at a time by %d threads", a.most_away, threads);
    iso_sweep_free(sweep);
    return a;
}

/* Bits; two numbers that are none are the same. */
static bool same_rows(const all *a, const all *b)
{
    for (size_t i = 0; i < COUNT * (size_t)a->rows.columns; i++)
        if (memcmp(&a->rows.number[i], &b->rows.number[i], sizeof(double)) != 0 &&
            !(isnan(a->rows.number[i]) && isnan(b->rows.number[i])))
            return false;
    for (size_t i = 0; i < COUNT; i++)
        if (a->rows.status[i] != b->rows.status[i] || strcmp(a->rows.reason[i], b->rows.reason[i]) != 0) return false;
    return true;
}

/* Whether something was measured; not all need be numbers: a chaotic orbit has no rotation number. */
static bool measured(const iso_sweep_rows *rows, size_t i)
{
    bool any = false;
    for (int c = 2; c < rows->columns; c++) any = any || !isnan(rows->number[i * (size_t)rows->columns + (size_t)c]);
    return any;
}

static void check_ways(const char *name, double turns, double time)
{
    static const struct {
        int threads;
        size_t chunk, step;
    } ways[] = {{1, 1, 1}, {2, 5, 3}, {3, 2, 5}, {2, 64, 1}};
    const int count = isnan(turns) && isnan(time) ? 2 : 4; /* what goes on as long as it must takes long */
    all first = {.seen = 0};
    for (int w = 0; w < count; w++) {
        iso_sweep_plan plan = plan_of(turns, time, ways[w].chunk);
        ask(&plan, name);
        all a = measure(&plan, ways[w].threads, ways[w].step);
        if (w == 0)
            first = a;
        else
            gsl_test(!same_rows(&first, &a), "%s: the same rows, way %d", name, w);
        for (size_t i = 0; i < COUNT; i++) {
            const bool ball = a.rows.number[i * (size_t)a.rows.columns] != 0;
            gsl_test(ball != (a.rows.status[i] == ISO_OK), "%s, point %zu: %s", name, i, a.rows.reason[i]);
            gsl_test(ball != measured(&a.rows, i), "%s, point %zu: numbers if there is a ball", name, i);
        }
        if (w > 0) iso_sweep_rows_free(&a.rows);
    }
    iso_sweep_rows_free(&first.rows);
}

/* --- what the library gives ------------------------------------------------------------------------------------- */

/* near: the orbit begins next to the rotation about the middle axis, whose neighbours leave it exponentially also
 * where k = 1 or -1. */
static void check_chaos(bool near, long turns)
{
    iso_sweep_plan plan = plan_of((double)turns, NAN, 64);
    iso_chaos_options o = iso_chaos_defaults();
    ask(&plan, "chaos");
    if (near)
        must(iso_start_ball(ctx, (double[]){1e-5, 1, 0}, (double[]){0, 0, 1}, ISO_SPIN_REMOVE, &base.start),
             "a start");
    all a = measure(&plan, 1, 1);
    o.turns = turns;
    for (size_t i = 0; i < COUNT; i += (size_t)tests_length(3, 1)) {
        const double *row = a.rows.number + i * (size_t)a.rows.columns;
        double numbers[2];
        iso_scene scene;
        iso_chaos *c;
        if (scene_of(ctx, NULL, i, &scene, numbers) != ISO_OK) continue;
        must(iso_chaos_run(ctx, &scene, &o, &c), "chaos");
        gsl_test((int)row[2] != (int)c->own.verdict, "verdict of point %zu", i);
        for (int m = 0; m < 2; m++) {
            gsl_test(row[5 + 11 * m] != c->own.result[m].megno, "MEGNO of point %zu: %.17g, %.17g", i,
                     row[5 + 11 * m], c->own.result[m].megno);
            gsl_test(row[8 + 11 * m] != c->own.result[m].exponent[ISO_CLOCK_T], "exponent of point %zu", i);
        }
        iso_chaos_free(c);
    }
    iso_sweep_rows_free(&a.rows);
}

static void check_backends(void)
{
    iso_sweep_plan plan = plan_of(NAN, 15, 4);
    ask(&plan, "backends");
    all a = measure(&plan, 2, 1);
    for (size_t i = 0; i < COUNT; i += 5) {
        double numbers[2];
        iso_scene scene;
        iso_comparison *c;
        if (scene_of(ctx, NULL, i, &scene, numbers) != ISO_OK) continue;
        scene.end = 15;
        must(iso_compare(ctx, &scene, NULL, NULL, &c), "compare");
        for (int d = 1; d < ISO_DIFFERENCES; d++)
            gsl_test(a.rows.number[i * (size_t)a.rows.columns + 1 + (size_t)d] != c->worst[d], "difference %d", d);
        iso_comparison_free(c);
    }
    iso_sweep_rows_free(&a.rows);
}

/* --- failures --------------------------------------------------------------------------------------------------- */

/* k = 0 is no ball: the numbers that vary are there, and nothing else. */
static void check_failure(void)
{
    iso_sweep_plan plan = plan_of(NAN, NAN, 8);
    ask(&plan, "splitting");
    ask(&plan, "state");
    iso_sweep *sweep;
    iso_sweep_rows rows;
    must(iso_sweep_create(ctx, &plan, &sweep), "a sweep");
    must(iso_sweep_rows_create(ctx, iso_sweep_head_of(sweep)->columns, 8, &rows), "rows");
    must(iso_sweep_compute_points(ctx, sweep, 4, 1, &rows), "point 4");
    gsl_test(rows.status[0] != ISO_BAD_INPUT || strstr(rows.reason[0], "k = 0") == NULL, "k = 0: %s", rows.reason[0]);
    for (int c = 2; c < rows.columns; c++) gsl_test(!isnan(rows.number[c]), "k = 0: column %d is empty", c);
    gsl_test(rows.number[0] != 0, "k = 0: k is there");
    iso_sweep_rows_free(&rows);
    iso_sweep_free(sweep);
}

static void check_refusals(void)
{
    iso_sweep_plan plan = plan_of(NAN, NAN, 0);
    iso_sweep *sweep;
    ask(&plan, "contact");
    gsl_test(iso_sweep_create(ctx, &plan, &sweep) != ISO_BAD_INPUT || strcmp(iso_context_about(ctx), "contact") != 0,
             "contact without reactions is refused: %s", iso_context_message(ctx));
    plan = plan_of(NAN, NAN, 0);
    ask(&plan, "state");
    strcpy(plan.vectors, "none");
    gsl_test(iso_sweep_create(ctx, &plan, &sweep) != ISO_BAD_ARGUMENT, "unknown vectors are refused");
}

/* A chunk takes about a second, so that little is lost when a program is killed: points that take long come alone. */
static void check_chunk(double turns, double time, size_t least, size_t most)
{
    iso_sweep_plan plan = plan_of(turns, time, 0);
    iso_sweep *sweep;
    plan.family.count = 1000000;
    ask(&plan, "state");
    must(iso_sweep_create(ctx, &plan, &sweep), "a sweep");
    const size_t chunk = iso_sweep_head_of(sweep)->chunk;
    gsl_test(chunk < least || chunk > most, "state, %g turns or to %g: %zu points in a chunk", turns, time, chunk);
    iso_sweep_free(sweep);
}

int main(void)
{
    ctx = iso_context_create();
    check_ways("state", NAN, 10);
    check_ways("state", 7, NAN);
    check_ways("chaos", 40, NAN);
    check_ways("backends", NAN, 5);
    check_ways("error", NAN, 5);
    if (tests_length(0, 1)) {
        check_ways("rotations", NAN, NAN);
        check_ways("splitting", NAN, NAN);
        check_ways("frequencies", NAN, NAN);
    }
    check_chunk(NAN, 10, 64, 64);
    check_chunk(NAN, 1e5, 2, 20); /* 0.2 s a point */
    check_chunk(NAN, -1e7, 1, 1);
    check_chunk(10, NAN, 64, 64);
    check_chunk(1000, NAN, 2, 20);
    check_chunk(1e6, NAN, 1, 1);
    check_chaos(false, 300);
    check_chaos(true, 240);
    check_backends();
    check_failure();
    check_refusals();
    iso_context_free(ctx);
    return gsl_test_summary();
}

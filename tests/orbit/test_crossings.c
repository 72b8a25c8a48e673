/* Crossings of orbits one by one, lib/orbit/crossings.h: reference/section.csv, parts, limits, refusals. */
#include "base/math_impl.h"
#include "crossed.h"
#include "map/section_impl.h"
#include "numbers.h"
#include "orbit/crossings_impl.h"
#include "reference.h"

static iso_context *ctx;

/* --- the reference ---------------------------------------------------------------------------------------------- */

enum { SECTION_ROWS = 10, SECTION_NUMBERS = 18, MOST_CROSSINGS = 20 };

/* One row: the ball, the axis, and its crossing number `crossing`. */
typedef struct section_row {
    char name[16];
    iso_params p;
    iso_start start;
    int axis, crossing;
    double t, s, l, x;
} section_row;

static int read_rows(section_row rows[SECTION_ROWS])
{
    FILE *file = fopen(ISO_TEST_DATA "/section.csv", "r");
    char line[2048];
    int count = 0;
    while (file && count < SECTION_ROWS && fgets(line, sizeof line, file))
        if (line[0] == 's') {
            section_row *r = &rows[count++];
            double v[SECTION_NUMBERS];
            snprintf(r->name, sizeof r->name, "%.*s", (int)strcspn(line, ","), line);
            laws_stop_if(ctx, !reference_numbers(line, SECTION_NUMBERS, v), "a row of section.csv");
            r->p = laws_params(v[0], v + 1);
            r->axis = (int)v[10] - 1, r->crossing = (int)v[11];
            r->t = v[12], r->s = v[13], r->l = v[14], r->x = v[15];
            laws_stop_if(ctx, iso_start_ball(ctx, v + 7, v + 4, ISO_SPIN_REMOVE, &r->start) != ISO_OK, "its start");
        }
    if (file) fclose(file);
    gsl_test_int(count, SECTION_ROWS, "rows of section.csv");
    return count;
}

static iso_crossings *follow(const iso_batch_orbit *orbit, size_t count, const iso_crossings_options *o)
{
    iso_crossings *c;
    if (iso_crossings_create(ctx, orbit, count, o, &c) != ISO_OK) {
        gsl_test(1, "crossings are refused: %s", iso_context_message(ctx));
        exit(gsl_test_summary());
    }
    return c;
}

/* Of t and s the error is relative; each crossing adds the error of a turn. */
static void note_row(const section_row *r, iso_backend backend, laws_worst *chart, laws_worst *clocks)
{
    const iso_batch_orbit orbit = {&r->p, &r->start, NULL};
    iso_crossings_options o = iso_crossings_defaults();
    o.backend = backend;
    iso_crossing at[MOST_CROSSINGS];
    gsl_test_int(iso_section_axis(iso_free_point(&r->p, 1)), r->axis, "%s: its global axis", r->name);
    if (!crossed(ctx, &orbit, &o, (size_t)r->crossing, at, NULL)) return;
    const iso_crossing *last = &at[r->crossing - 1];
    laws_note(chart, fabs(remainder(last->l - r->l, 2 * ISO_PI)), 1e-11, &r->p, r->name);
    laws_note(chart, fabs(last->x - r->x), 1e-11, &r->p, r->name);
    laws_note(clocks, fabs(last->clock[ISO_CLOCK_T] / r->t - 1), 1e-11, &r->p, r->name);
    laws_note(clocks, fabs(last->clock[ISO_CLOCK_S] / r->s - 1), 1e-11, &r->p, r->name);
}

static void check_reference(void)
{
    section_row rows[SECTION_ROWS];
    const int count = read_rows(rows);
    for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_AUTO; backend++) {
        laws_worst chart = {0}, clocks = {0};
        char name[64];
        for (int i = 0; i < count; i++) note_row(&rows[i], backend, &chart, &clocks);
        snprintf(name, sizeof name, "backend %s: l and x of section.csv", iso_backend_name((int)backend));
        laws_report(&chart, name);
        snprintf(name, sizeof name, "backend %s: t and s of section.csv", iso_backend_name((int)backend));
        laws_report(&clocks, name);
    }
}

/* --- in parts and at once --------------------------------------------------------------------------------------- */

static int differ(const void *a, const void *b, size_t size)
{
    const double *x = a, *y = b;
    int wrong = 0;
    for (size_t i = 0; i < size / sizeof *x; i++) wrong += !(x[i] == y[i] || (isnan(x[i]) && isnan(y[i])));
    return wrong;
}

/* Two orbits; the second is asked for 3 + 2 crossings, while the first rests. */
static void check_parts(const char *name, const iso_batch_orbit orbit[2], const iso_crossings_options *o)
{
    enum { ALL = 5, FIRST = 3 };
    iso_crossing whole[2 * ALL], part[2 * ALL];
    iso_sample all[2 * ALL], some[2 * ALL];
    size_t done[2];
    iso_status status[2];
    iso_crossings *c = follow(orbit, 2, o);
    gsl_test_int((int)iso_crossings_go(c, NULL, ALL, whole, all, done, status), ISO_OK, "%s at once: %s", name,
                 iso_context_message(ctx));
    gsl_test(done[0] != ALL || done[1] != ALL, "%s: all crossings", name);
    iso_crossings_free(c);
    c = follow(orbit, 2, o);
    const bool second[2] = {false, true};
    iso_crossings_go(c, second, FIRST, part, some, done, status);
    gsl_test(done[0] != 0 || done[1] != FIRST, "%s: only the one that is wanted", name);
    gsl_test_int(differ(part + FIRST, whole + ALL, FIRST * sizeof *part), 0, "%s: the first three", name);
    gsl_test_int(differ(some + FIRST, all + ALL, FIRST * sizeof *some), 0, "%s: their samples", name);
    iso_crossings_go(c, second, ALL - FIRST, part, some, done, status);
    gsl_test_int(differ(part + ALL - FIRST, whole + ALL + FIRST, (ALL - FIRST) * sizeof *part), 0,
                 "%s: 3 + 2 crossings are 5", name);
    gsl_test_int(differ(some + ALL - FIRST, all + ALL + FIRST, (ALL - FIRST) * sizeof *some), 0,
                 "%s: and their samples", name);
    iso_crossings_free(c);
}

/* Free, with effects that keep and that break the isomorphism, on sections of all kinds. */
static void check_all_parts(void)
{
    const iso_params p = laws_params(0.5, (const double[]){1.4, 2.1, 3.0});
    const iso_start start = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    iso_effects gravity = iso_effects_default(), field = iso_effects_default();
    iso_effects_set(ctx, &gravity, "gravity", "mgb", 1, (double[]){0.3});
    iso_effects_set(ctx, &gravity, "gravity", "up", 3, (double[]){0, 0.6, 0.8});
    iso_effects_set(ctx, &field, "field", "linear", 3, (double[]){0.1, 0.05, -0.1});
    for (int kind = ISO_SECTION_AXIS; kind <= ISO_SECTION_CLOCK; kind++) {
        iso_crossings_options o = iso_crossings_defaults();
        o.kind = (iso_section_kind)kind;
        o.column = iso_column_find("n1");
        o.value = kind == ISO_SECTION_CLOCK ? 1.7 : 0.1;
        o.shown = ISO_SHOW_BALL;
        check_parts("free", (const iso_batch_orbit[]){{&p, &start, NULL}, {&p, &start, NULL}}, &o);
        check_parts("gravity and a field", (const iso_batch_orbit[]){{&p, &start, &gravity}, {&p, &start, &field}},
                    &o);
    }
}

/* --- laws ------------------------------------------------------------------------------------------------------- */

/* Starts with n_a = 0 up to rounding, on either side: none of them is a crossing. */
static void check_start_on_section(void)
{
    const iso_params p = laws_params(0.5, (const double[]){1, 2, 5});
    double first[2][3];
    for (int side = 0; side < 3; side++)
        for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
            iso_start start = {.model = ISO_POINT, .eps = 1};
            const iso_batch_orbit orbit = {&p, &start, NULL};
            iso_crossings_options o = iso_crossings_defaults();
            iso_crossing crossing;
            o.backend = backend;
            iso_section_point(iso_free_point(&p, 1), 2, 0.7, 0.2, start.y);
            start.y[5] = (side - 1) * 3e-10;
            start.eps = NAN;
            crossed(ctx, &orbit, &o, 1, &crossing, NULL);
            first[backend][side] = crossing.clock[ISO_CLOCK_S];
        }
    for (int i = 1; i < 6; i++)
        gsl_test_rel(first[i % 2][i / 2], first[0][0], 1e-8, "a start on the section is no crossing (%d)", i);
}

/* Where n_a falls through 0, half an oscillation is missing. Nearly equal moments make the bounds narrow. */
static void check_falling_start(void)
{
    for (int i = 0; i < 4; i++) {
        const iso_params p = laws_params(i / 2 ? -0.8 : 1, (const double[]){2.05, 2.1, 2});
        const int axis = iso_section_axis(iso_free_point(&p, 1));
        iso_start start = {.model = ISO_POINT, .eps = NAN};
        const iso_batch_orbit orbit = {&p, &start, NULL};
        iso_crossings_options o = iso_crossings_defaults();
        iso_crossing at[2];
        double W[2];
        o.backend = i % 2 ? ISO_BACKEND_BALL : ISO_BACKEND_POINT;
        iso_section_point(iso_free_point(&p, 1), axis, 0.7, 0.2, start.y);
        scale(start.y, -1);
        iso_section_bounds(iso_free_point(&p, 1), axis, W);
        crossed(ctx, &orbit, &o, 2, at, NULL);
        gsl_test_rel(at[0].clock[ISO_CLOCK_S] * (W[0] + W[1]) / 2, ISO_PI, 0.06, "half an oscillation %d", i);
    }
}

/* The same orbit in other units gives the same (l, x). */
static void check_units(void)
{
    const iso_start start = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    iso_start fast = start;
    iso_params p[2];
    iso_crossing at[2][3];
    for (int i = 0; i < 3; i++) fast.y[i] *= 1e30;
    for (int u = 0; u < 2; u++) {
        const double J = u ? 1e-40 : 1;
        p[u] = laws_params(-0.7, (const double[]){1.4 * J, 2.1 * J, 3.0 * J});
        const iso_batch_orbit orbit = {&p[u], u ? &fast : &start, NULL};
        crossed(ctx, &orbit, NULL, 3, at[u], NULL);
    }
    gsl_test_abs(at[0][2].l - at[1][2].l, 0, 1e-10, "l in other units");
    gsl_test_abs(at[0][2].x - at[1][2].x, 0, 1e-10, "x in other units");
    gsl_test_rel(at[1][2].clock[0] * 1e30, at[0][2].clock[0], 1e-10, "t in other units");
}

/* On a column, upwards only; on a clock, equal steps. */
static void check_column_and_clock(void)
{
    const iso_params p = laws_params(-1, (const double[]){1.4, 2.1, 3.0});
    const iso_start start = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    const iso_batch_orbit orbit = {&p, &start, NULL};
    iso_crossings_options o = iso_crossings_defaults();
    iso_crossing at[4];
    iso_sample sample[4], later;
    o.kind = ISO_SECTION_COLUMN;
    o.column = iso_column_find("gamma1");
    o.value = 0.25;
    o.shown = ISO_SHOW_BOTH;
    crossed(ctx, &orbit, &o, 4, at, sample);
    iso_orbit_options how = iso_orbit_defaults(&start);
    iso_orbit *path;
    how.shown = ISO_SHOW_BOTH;
    iso_orbit_create(ctx, &p, &start, &how, &path);
    for (int i = 0; i < 4; i++) {
        gsl_test_abs(iso_sample_column(&sample[i], o.column), 0.25, 1e-14, "the column has its value");
        iso_orbit_at(path, at[i].clock[ISO_CLOCK_T] + 1e-3, &later);
        gsl_test(iso_sample_column(&later, o.column) <= 0.25, "and passes it upwards");
        gsl_test(!isnan(at[i].l), "there is no chart of such a section");
    }
    iso_orbit_free(path);
    o.kind = ISO_SECTION_CLOCK;
    o.clock = ISO_CLOCK_S;
    crossed(ctx, &orbit, &o, 4, at, sample);
    for (int i = 0; i < 4; i++) gsl_test_rel(at[i].clock[ISO_CLOCK_S], 0.25 * (i + 1), 1e-15, "steps of s");
}

/* --- what is refused -------------------------------------------------------------------------------------------- */

static void refuse(const char *name, const iso_crossings_options *o, const char *about)
{
    const iso_params p = laws_params(0.5, (const double[]){1, 2, 3});
    const iso_start start = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    const iso_batch_orbit orbit = {&p, &start, NULL};
    iso_crossings *c;
    gsl_test_int((int)iso_crossings_create(ctx, &orbit, 1, o, &c), ISO_BAD_ARGUMENT, "%s", name);
    gsl_test_str(iso_context_about(ctx), about, "%s: what it is about", name);
    gsl_test(c != NULL, "%s: no object", name);
}

static void check_refusals(void)
{
    const iso_crossings_options good = iso_crossings_defaults();
    iso_crossings_options o = good;
    o.axis = 3, refuse("axis 3", &o, "axis");
    o.axis = -2, refuse("axis -2", &o, "axis");
    o = good, o.backend = ISO_BACKEND_EXACT, refuse("backend exact", &o, "backend");
    o = good, o.tolerance = 1, refuse("tolerance 1", &o, "tolerance");
    o = good, o.threads = -1, refuse("threads -1", &o, "threads");
    o = good, o.vectors = "none", refuse("vectors", &o, "vectors");
    o = good, o.kind = ISO_SECTION_COLUMN, o.column = ISO_CLOCK_T, refuse("a clock as column", &o, "column");
    o.column = -1, refuse("column -1", &o, "column");
    o.column = 1000, refuse("column 1000", &o, "column");
    o.column = iso_column_find("n1"), o.value = NAN, refuse("value NaN", &o, "value");
    o.value = 0, o.deviations = true, refuse("deviations on a column", &o, "deviations");
    o = good, o.kind = ISO_SECTION_CLOCK, o.value = 0, refuse("no step", &o, "value");
    o.value = INFINITY, refuse("an infinite step", &o, "value");
}

/* Orbits that cannot go on are told with number and reason, for ever; the others go on. */
static void check_failures(void)
{
    const iso_params p = laws_params(0.5, (const double[]){1, 2, 3});
    const iso_start good = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    const iso_start rest = {.model = ISO_BALL, .y = {0, 0, 0, 0.36, 0.48, 0.8}};
    const iso_start plane = {.model = ISO_BALL, .y = {0, 0, 2, 0.6, 0.8, 0}};
    const iso_batch_orbit orbit[3] = {{&p, &good, NULL}, {&p, &rest, NULL}, {&p, &plane, NULL}};
    iso_crossing at[6];
    size_t done[3];
    iso_status status[3];
    iso_crossings *c = follow(orbit, 3, NULL);
    for (int again = 0; again < 2; again++) {
        gsl_test_int((int)iso_crossings_go(c, NULL, 2, at, NULL, done, status), ISO_NUMERICAL, "the first failure");
        gsl_test(!strstr(iso_context_message(ctx), "orbit 1: the ball rests"), "in words: %s",
                 iso_context_message(ctx));
        gsl_test_int((int)done[0], 2, "a good orbit goes on");
        gsl_test_int((int)status[0], ISO_OK, "its status");
        gsl_test_int((int)status[1], ISO_NUMERICAL, "a ball at rest");
        gsl_test_int((int)status[2], ISO_BAD_INPUT, "an orbit on the boundary");
        gsl_test(done[1] || done[2] || !isnan(at[2].l), "nothing of those");
    }
    const bool third[3] = {false, false, true};
    iso_crossings_go(c, third, 2, at, NULL, done, status);
    gsl_test(!strstr(iso_context_message(ctx), "boundary of the section"), "in words: %s", iso_context_message(ctx));
    iso_crossings_free(c);
}

/* A tolerance of 1/10 loses the section: that is said, never hidden. */
static void check_sturm(void)
{
    const double bound[2] = {2, 3};
    gsl_test(!iso_crossings_apart(bound, true, 2.5, 10, 1e-12), "between the bounds");
    gsl_test(iso_crossings_apart(bound, true, 1.9, 10, 1e-12), "too close");
    gsl_test(!iso_crossings_apart(bound, false, 1.9, 10, 1e-12), "the first may be close");
    gsl_test(iso_crossings_apart(bound, false, 3.1, 10, 1e-12), "too far");
    gsl_test(!iso_crossings_apart(bound, true, 3 + 1e-10, 10, 1e-12), "rounding is allowed");
    gsl_test(!iso_crossings_apart((double[]){NAN, NAN}, true, 100, 10, 1e-12), "without bounds all is allowed");
}

int main(void)
{
    ctx = iso_context_create();
    check_reference();
    check_all_parts();
    check_start_on_section();
    check_falling_start();
    check_units();
    check_column_and_clock();
    check_refusals();
    check_failures();
    check_sturm();
    iso_context_free(ctx);
    return gsl_test_summary();
}

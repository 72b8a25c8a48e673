/* test_run.c - iso_run (task/run.h): every row is that of a new orbit asked for this time alone. Times come in any
 * order; the sink, the monitor or a failure may end the run early. */
#include "base/context_impl.h"
#include "runs.h"

/* Scenes of every kind, none of which loses contact. */
static const char *const kinds[] = {
    REDUCED("-1") TIME,
    REDUCED("1") TIME "solver: {backend: exact}\noutput: {as: both}\n",
    REDUCED("0.7") TIME "solver: {backend: point, tolerance: 1e-9}\noutput: {as: both}\n",
    REDUCED("-1") TIME "output: {columns: [s, n3, t, gamma1, omega2]}\n",
    REDUCED("-0.4") "time: {end: -3, step: 0.5}\nsolver: {method: rk8pd}\n",
    REDUCED("3") TIME "effects: {field: {linear: [0.1, 0.2, 0.3]}, level: {c: 0.3}}\noutput: {as: both}\n",
    REDUCED("-1") "time: {end: 0}\n",
    POINT TIME,
    POINT TIME "solver: {method: kahan_li8}\noutput: {as: ball}\n",
    OUTSIDE START TIME "effects: {" GRAVITY ", attitude: {}, reactions: {two_sided: true}}\n",
    OUTSIDE START TIME "effects: {" GRAVITY ", twist: {resistance: 3000}, rolling_resistance: {coefficient: 0.1}}\n",
    HEAVY "surface: {kind: plane}\n" START TIME "effects: {" GRAVITY ", attitude: {}, clock: {}}\n",
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void check_kind(int kind)
{
    const iso_scene scene = parse(kinds[kind]);
    double times[MOST];
    kept *grid = run(&scene, NULL, 0);
    int wrong = 0;
    gsl_test(grid->status != ISO_OK || grid->headers != 1, "scene %d runs: %s", kind, iso_context_message(ctx));
    gsl_test(grid->rows != iso_scene_rows(&scene) || grid->result.asked != grid->rows, "scene %d: all rows", kind);
    for (size_t i = 0; i < grid->rows; i++) wrong += different(&scene, grid, i, iso_scene_time(&scene, i));
    gsl_test(wrong, "scene %d: %zu rows, each the one of an orbit asked for it alone", kind, grid->rows);
    gsl_test(grid->wrong_progress || (scene.backend != ISO_BACKEND_EXACT && scene.end != 0 && !(grid->part > 0.5)),
             "scene %d: progress is a part, to %g", kind, grid->part);
    free(grid);
    const size_t count = shuffle(&scene, 0.001, times);
    kept *any = run(&scene, times, count);
    wrong = any->status != ISO_OK || any->rows != count;
    for (size_t i = 0; i < any->rows; i++) wrong += different(&scene, any, i, times[i]);
    gsl_test(wrong, "scene %d: %zu times in any order have the same rows", kind, count);
    free(any);
}

/* Of an orbit: what made it, and what it took. */
static void check_result(void)
{
    static const struct expected {
        int kind;
        iso_backend backend;
        const char *method;
        iso_clock clock;
    } list[] = {{0, ISO_BACKEND_BALL, "taylor", ISO_CLOCK_T},
                {1, ISO_BACKEND_EXACT, "exact", ISO_CLOCK_T},
                {4, ISO_BACKEND_BALL, "rk8pd", ISO_CLOCK_T},
                {7, ISO_BACKEND_POINT, "taylor", ISO_CLOCK_S}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        const iso_scene scene = parse(kinds[list[i].kind]);
        kept *k = run(&scene, NULL, 0);
        const iso_run_result *r = &k->result;
        gsl_test(r->backend != list[i].backend || r->clock != list[i].clock || !r->method ||
                     strcmp(r->method->name, list[i].method) != 0,
                 "scene %d: the orbit is found by %s", list[i].kind, list[i].method);
        gsl_test((r->statistics.steps > 0) == (r->backend == ISO_BACKEND_EXACT), "scene %d: %ld steps", list[i].kind,
                 r->statistics.steps);
        gsl_test(r->lost[0] || r->lost[1] || k->notes != 0, "scene %d: no contact is lost", list[i].kind);
        free(k);
    }
    const iso_scene scene = parse(kinds[0]);
    const iso_sink none = {.data = NULL};
    gsl_test(iso_run(ctx, &scene, NULL, &none, NULL, NULL) != ISO_OK, "nobody takes anything: that is a run as well");
}

/* Times in any order take no more steps than one way forth and one way back. */
static void check_order(void)
{
    iso_scene scene = parse(kinds[0]);
    double times[MOST];
    scene.backend = ISO_BACKEND_BALL; /* auto may take another one for other times */
    scene.end = 60;
    scene.step = 1;
    const size_t count = shuffle(&scene, 1, times);
    kept *forth = run(&scene, NULL, 0), *any = run(&scene, times, count);
    scene.end = -60;
    kept *back = run(&scene, NULL, 0);
    const long both = forth->result.statistics.steps + back->result.statistics.steps;
    gsl_test(any->rows != count || any->result.statistics.steps > both || both < 20,
             "%zu times in any order: %ld steps, %ld", count, any->result.statistics.steps, both);
    free(forth);
    free(any);
    free(back);
}

/* --- who ends it early ------------------------------------------------------------------------------------------ */

/* Rows of a run that ended early: the first ones of the whole. */
static bool begins(const kept *part, const kept *whole)
{
    bool same = part->rows <= whole->rows;
    for (size_t i = 0; same && i < part->rows; i++)
        same = memcmp(part->row[i], whole->row[i], whole->columns * sizeof(double)) == 0;
    return same;
}

static void check_sink_stops(void)
{
    const iso_scene scene = parse(kinds[0]);
    kept *whole = run(&scene, NULL, 0), like = {.refuses_header = true};
    kept *k = run_like(&like, &scene, NULL, 0, false);
    gsl_test(k->status != ISO_FILE_TROUBLE || k->rows != 0 || strstr(iso_context_message(ctx), "no header") == NULL,
             "a sink that wants no header gets no row");
    free(k);
    for (size_t stop = 1; stop <= whole->rows; stop++) {
        like = (kept){.stop_at = stop};
        k = run_like(&like, &scene, NULL, 0, stop % 2);
        gsl_test(k->status != ISO_FILE_TROUBLE || k->rows + 1 != stop || !begins(k, whole),
                 "a sink that refuses row %zu has those before: %s", stop, iso_context_message(ctx));
        free(k);
    }
    free(whole);
}

/* Stopped by the monitor: whatever was found is there, in the order asked for. */
static void check_monitor_stops(bool ordered)
{
    const iso_scene scene = parse(kinds[4]);
    double times[MOST];
    const size_t count = ordered ? 0 : shuffle(&scene, 1, times);
    kept *whole = run(&scene, ordered ? NULL : times, count);
    size_t most = 0, least = MOST;
    bool done = false;
    for (int asked = 0; !done && asked < 100000; asked++) {
        int left = asked;
        iso_context_set_monitor(ctx, some_times, &left);
        kept *k = run(&scene, ordered ? NULL : times, count);
        done = k->status == ISO_OK;
        bool right = done || k->status == ISO_STOPPED, mine = iso_context_goes_on(ctx) == (left >= 0);
        for (size_t i = 0, at = 0; right && i < k->rows; i++) { /* its rows are rows of the whole, in their order */
            while (at < whole->rows && memcmp(k->row[i], whole->row[at], whole->columns * sizeof(double)) != 0) at++;
            right = at++ < whole->rows;
        }
        if (!right || !mine) gsl_test(1, "stopped after %d steps: %s", asked, iso_context_message(ctx));
        if (!done) most = k->rows > most ? k->rows : most, least = k->rows < least ? k->rows : least;
        free(k);
    }
    iso_context_set_monitor(ctx, NULL, NULL);
    gsl_test(!done || least != 0 || most + 1 < whole->rows, "stopped anywhere, %s: the rows before are there, to %zu",
             ordered ? "on the grid" : "with times in any order", most);
    free(whole);
}

/* Backwards, resistance drives the ball until it is refused: what was found before stays, on both sides. */
static void check_failure(void)
{
    const iso_scene scene = parse(OUTSIDE START TIME "effects: {rolling_resistance: {coefficient: 20}}\n");
    static const double times[] = {-0.25, 1, -1000, 0.5, -0.5, -2000, 2};
    kept *k = run(&scene, times, 7);
    static const double found[] = {-0.25, 1, 0.5, -0.5, 2};
    int wrong = k->status != ISO_NUMERICAL || k->rows != 5 || k->result.asked != 7;
    gsl_test(wrong, "a failure after 5 of 7 times: %zu rows, %s", k->rows, iso_context_message(ctx));
    for (size_t i = 0; !wrong && i < k->rows; i++) wrong += different(&scene, k, i, found[i]);
    gsl_test(wrong, "those rows are right");
    free(k);
    iso_scene back = scene;
    back.end = -1000;
    back.step = 0.25;
    k = run(&back, NULL, 0);
    wrong = k->status != ISO_NUMERICAL || k->rows < 3;
    for (size_t i = 0; i < k->rows; i++) wrong += different(&back, k, i, iso_scene_time(&back, i));
    gsl_test(wrong, "a failure on the grid keeps %zu rows: %s", k->rows, iso_context_message(ctx));
    free(k);
}

/* What cannot be asked for is refused before there is a header. */
static void check_refusals(void)
{
    const iso_scene usual = parse(kinds[0]);
    iso_scene scene = usual;
    static const double odd[] = {1, NAN}, far[] = {1, 1e300};
    const struct refusal {
        const char *what, *field;
        const double *times;
        size_t count;
    } list[] = {
        {"no times", "times", odd, 0}, {"a time that is NaN", "times", odd, 2}, {"a far time", "end", far, 2}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        kept *k = run(&scene, list[i].times, list[i].count);
        gsl_test(k->status != ISO_BAD_ARGUMENT || k->headers || strcmp(iso_context_about(ctx), list[i].field) != 0,
                 "%s: %s", list[i].what, iso_context_message(ctx));
        free(k);
    }
    for (int i = 0; i < 3; i++) {
        scene = usual;
        if (i == 0) snprintf(scene.method, sizeof scene.method, "sundial");
        if (i == 1) scene.columns = 1, snprintf(scene.column[0], sizeof scene.column[0], "e1");
        if (i == 2) scene.end = INFINITY;
        kept *k = run(&scene, NULL, 0);
        gsl_test(k->status != (i == 1 ? ISO_BAD_INPUT : ISO_BAD_ARGUMENT) || k->headers || k->result.method, "%s",
                 iso_context_message(ctx));
        free(k);
    }
}

static void check_errors(void)
{
    for (int kind = 0; kind < KINDS; kind++) {
        const iso_scene scene = parse(kinds[kind]);
        double times[MOST];
        const size_t count = shuffle(&scene, 0.001, times);
        kept *plain = run(&scene, times, count), *k = run_like(&nothing, &scene, times, count, true);
        const iso_error *e = &k->result.error;
        gsl_test(plain->result.error_status == ISO_OK, "scene %d: errors that nobody asked for are not known", kind);
        gsl_test(k->rows != plain->rows || !begins(k, plain), "scene %d: errors change no row", kind);
        gsl_test(k->result.error_status != ISO_OK || e->rows != k->rows ||
                     !(fmax(e->state[0].worst, e->state[1].worst) > 0),
                 "scene %d: the error of all %zu rows: %s", kind, e->rows, k->result.error_words);
        free(plain);
        free(k);
    }
    iso_scene scene = parse(kinds[4]);
    scene.tolerance = 1e-15;
    snprintf(scene.method, sizeof scene.method, iso_method_find("taylor_quad") ? "taylor_quad" : "taylor_extended");
    kept *k = run_like(&nothing, &scene, NULL, 0, true);
    gsl_test(k->status != ISO_OK || k->result.error_status != ISO_BAD_ARGUMENT || !*k->result.error_words,
             "an error that is not known is no failure: %s", k->result.error_words);
    free(k);
    const kept like = {.stop_at = 1};
    scene = parse(kinds[0]);
    k = run_like(&like, &scene, NULL, 0, true);
    gsl_test(k->status != ISO_FILE_TROUBLE || strstr(iso_context_message(ctx), "no more rows") == NULL,
             "the words of a failure stay: %s", iso_context_message(ctx));
    free(k);
}

/* --- a ball that leaves its support, or is not pressed to it ---------------------------------------------------- */

static int place_of(const iso_scene *scene, const char *name)
{
    int columns[ISO_MAX_COLUMNS];
    const int count = iso_scene_column_list(scene, columns);
    for (int c = 0; c < count; c++)
        if (strcmp(iso_column_name(columns[c]), name) == 0) return c;
    laws_stop_if(ctx, true, "a column is missing");
    return -1;
}

/* The ball rolls down the outside of a sphere, after the start as before it, and leaves it. */
static void check_loss(void)
{
    const iso_scene scene = parse(OUTSIDE "initial: {normal: [0, 0, 1], angular_velocity: [0.3, 0.2, 0]}\n"
                                          "time: {end: 6, step: 0.25}\n"
                                          "effects: {gravity: {g: 9.81, up: [0, 0, 1]}, reactions: {}}\n");
    const int pressure = place_of(&scene, "pressure");
    double times[MOST];
    kept *k = run(&scene, NULL, 0);
    const double lost = k->result.lost_at[0], weight = 2 * 9.81;
    bool pressed = true;
    for (size_t i = 0; i + 1 < k->rows; i++) pressed = pressed && k->row[i][pressure] > 0;
    gsl_test(k->status != ISO_OK || !k->result.lost[0] || k->result.lost[1] || !(lost > 0 && lost < 6), "lost at %g",
             lost);
    gsl_test(k->notes != 1 || !strstr(k->note, "contact is lost at") || k->rows_at_note + 1 != k->rows,
             "said once, before its row");
    gsl_test(!pressed || k->row[k->rows - 1][0] != lost || !(fabs(k->row[k->rows - 1][pressure]) < 1e-12 * weight),
             "pressed until then, and not there: %.1e", k->row[k->rows - 1][pressure]);
    gsl_test(k->rows != (size_t)floor(lost / 0.25) + 2, "%zu rows: those before, and that one", k->rows);
    free(k);
    const size_t count = shuffle(&scene, 1, times);
    k = run(&scene, times, count);
    const double before = k->result.lost_at[1];
    size_t expected = 2; /* the two moments of loss */
    int wrong = k->status != ISO_OK || !k->result.lost[0] || !k->result.lost[1] || k->notes != 2;
    for (size_t i = 0, at = 0; i < count; i++) {
        const double time = at < k->rows ? k->row[at][0] : NAN;
        expected += times[i] < lost && times[i] > before;
        if (time == times[i])
            wrong += different(&scene, k, at++, times[i]);
        else if ((times[i] > lost && time == lost) || (times[i] < before && time == before))
            at++;
        else
            wrong += times[i] < lost && times[i] > before;
    }
    gsl_test(wrong || k->rows != expected || k->result.lost_at[0] != lost,
             "times in any order: rows between %.6g and %.6g, and at both", before, lost);
    free(k);
}

/* Nothing presses the ball at the start, or the support would have to pull it there. */
static void check_no_pressure(void)
{
    iso_scene scene = parse(OUTSIDE "initial: {normal: [0, 0, 1], angular_velocity: [0.3, 0.2, 0]}\n"
                                    "time: {end: 1, step: 0.25}\n"
                                    "effects: {gravity: {g: 9.81, up: [0, 0, -1]}, reactions: {}}\n");
    kept *k = run(&scene, NULL, 0);
    gsl_test(k->status != ISO_OK || k->notes != 1 || !strstr(k->note, "the support would have to pull") ||
                 k->rows_at_note != 0 || k->rows != 5 || k->result.lost[0],
             "below the sphere: two-sided, %zu rows", k->rows);
    free(k);
    scene = parse(OUTSIDE "initial: {normal: [0, 0, 1], angular_velocity: [0, 0, 0]}\n"
                          "time: {end: 1, step: 0.25}\n"
                          "effects: {gravity: {g: 9.81, up: [0, 1, 0]}, reactions: {}}\n");
    k = run(&scene, NULL, 0);
    gsl_test(k->status != ISO_OK || k->notes != 1 || !strstr(k->note, "contact is lost at 0:") || k->rows != 1 ||
                 !k->result.lost[0] || k->result.lost_at[0] != 0,
             "at rest beside the sphere: one row, %zu", k->rows);
    free(k);
}

int main(void)
{
    ctx = iso_context_create();
    for (int kind = 0; kind < KINDS; kind++) check_kind(kind);
    check_result();
    check_order();
    check_sink_stops();
    check_monitor_stops(true);
    check_monitor_stops(false);
    check_failure();
    check_refusals();
    check_errors();
    check_loss();
    check_no_pressure();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

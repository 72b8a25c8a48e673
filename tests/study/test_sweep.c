/* test_sweep.c - the rows of sweeps: laws that hold for every quantity.
 *
 * - A row does not depend on the chunk it is computed in, on threads, or on the order of the chunks.
 * - No thread has more than one chunk that is not given away: so much is lost when a program is killed.
 * - Rows are what the functions of the library give for the scene, and every study that has numbers can be swept.
 * - A point that fails is a row with its reason; the others are there.
 */
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

static void ask_with(iso_sweep_plan *plan, const char *name, const char *options)
{
    plan->request[plan->requests++] = (iso_sweep_request){.name = name, .options = options};
}

static void ask(iso_sweep_plan *plan, const char *name)
{
    ask_with(plan, name, strcmp(name, "splitting") == 0 ? "digits=double" : NULL); /* 128 bits take long */
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
            bool any = false; /* not all need be numbers: a chaotic orbit has no rotation number */
            for (int c = 2; c < a.rows.columns; c++)
                any = any || !isnan(a.rows.number[i * (size_t)a.rows.columns + (size_t)c]);
            gsl_test(ball != any, "%s, point %zu: numbers if there is a ball", name, i);
        }
        if (w > 0) iso_sweep_rows_free(&a.rows);
    }
    iso_sweep_rows_free(&first.rows);
}

/* --- what the library gives ------------------------------------------------------------------------------------- */

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

/* --- every study -------------------------------------------------------------------------------------------------- */

/* "rotations.0.error" is rotations1_error. Of a proof the lines have what stands in its only row. */
static void column_of(const char *study, const char *key, char column[])
{
    int place;
    column += sprintf(column, strcmp(study, "prove") == 0 ? "%s_rows1_" : "%s_", study);
    for (; *key; key++) {
        int length = 0;
        if (sscanf(key, ".%d%n", &place, &length) == 1 && (key[length] == '.' || !key[length])) {
            column += sprintf(column, key[length] || column[-1] < '0' || column[-1] > '9' ? "%d" : "_%d", place + 1);
            key += length - 1;
        } else {
            *column++ = *key == '.' ? '_' : *key;
        }
    }
    *column = '\0';
}

/* The lines of a study's table have its result, whatever the sweep makes of it. Gives how many numbers are the same. */
static int compare_lines(const iso_sweep_head *head, const double *row, const char *study, const iso_record *table)
{
    const char *key, *value;
    char column[400], name[2 * ISO_NAME_SIZE + 40], *end;
    int same = 0;
    for (size_t i = 0; iso_record_line(table, i, &key, &value); i++) {
        const double number = strtod(value, &end);
        column_of(study, key, column);
        for (int c = 2; c < head->columns; c++) {
            snprintf(name, sizeof name, "%s_%s", head->column[c].group, head->column[c].name);
            if (*end || strcmp(name, column) != 0) continue;
            const bool equal = row[c] == number || (isnan(row[c]) && isnan(number));
            gsl_test(!equal, "%s: %.17g is %s", column, row[c], value);
            same += equal;
        }
    }
    return same;
}

static void check_study(const iso_study *study, const char *options, const iso_scene *scene_asked)
{
    iso_sweep_plan plan = plan_of(NAN, NAN, 2);
    int same = 0;
    base = *scene_asked;
    ask_with(&plan, study->name, options);
    iso_sweep *sweep;
    iso_sweep_rows rows;
    must(iso_sweep_create(ctx, &plan, &sweep), study->name);
    const iso_sweep_head *head = iso_sweep_head_of(sweep);
    must(iso_sweep_rows_create(ctx, head->columns, 3, &rows), "rows");
    must(iso_sweep_compute_points(ctx, sweep, 5, 3, &rows), "three points"); /* k = 0.25, 0.5, 0.75 */
    gsl_test(head->columns < 4, "%s has columns", study->name);
    for (size_t i = 0; i < 3; i++) {
        iso_study_result result = {.found = NULL};
        iso_scene scene;
        double numbers[2];
        must(scene_of(ctx, NULL, 5 + i, &scene, numbers), "a scene");
        const iso_status status =
            iso_study_ask_text(ctx, study, &(iso_study_subject){.scene = &scene}, options, &result);
        gsl_test(status != rows.status[i], "%s, point %zu: %s", study->name, i, rows.reason[i]);
        const double *row = rows.number + i * (size_t)rows.columns;
        if (status == ISO_OK && result.fields)
            same += compare_lines(head, row, study->name, result.table[0]);
        else if (status == ISO_OK)
            for (int c = 2; c < head->columns; c++) {
                const int column = iso_record_find(result.table[0], head->column[c].name);
                const size_t last = iso_record_rows(result.table[0]) - 1;
                same += column >= 0 && row[c] == iso_record_const_row(result.table[0], last)[column];
            }
        iso_study_result_free(&result);
        if (status != ISO_OK) same++; /* this build cannot */
    }
    gsl_test(same < 3, "%s: numbers were compared", study->name);
    iso_sweep_rows_free(&rows);
    iso_sweep_free(sweep);
}

static void check_studies(void)
{
    static const struct {
        const char *name, *options;
    } quick[] = {{"section", "crossings=9"},     {"chaos", "turns=50\nstarts=2"}, {"frequencies", "turns=40"},
                 {"splitting", "digits=double"}, {"periodic", "period=1"},        {"integrals", "orbits=8\nturns=5"}};
    const iso_study *study;
    plan_of(NAN, NAN, 0);
    const iso_scene ball = base;
    iso_scene point = base;
    must(iso_start_point(ctx, (double[]){0.9, -0.3, -0.225}, (double[]){0.36, 0.48, 0.8}, NULL, true, &point.start),
         "a point");
    for (int i = 0; (study = iso_study_at(i)) != NULL; i++) {
        const char *options = NULL;
        for (size_t q = 0; q < sizeof quick / sizeof *quick; q++)
            if (strcmp(quick[q].name, study->name) == 0) options = quick[q].options;
        if (study->fields) check_study(study, options, study->of & ISO_STUDY_OF_SCENE ? &ball : &point);
    }
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
    plan = plan_of(NAN, NAN, 0);
    ask_with(&plan, "periodic", "steps=7\n");
    gsl_test(iso_sweep_create(ctx, &plan, &sweep) != ISO_BAD_INPUT, "options that exclude each other are refused");
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
    check_backends();
    check_studies();
    check_failure();
    check_refusals();
    iso_context_free(ctx);
    return gsl_test_summary();
}

/* test_api_studies.c - every study by its name, with options as text (iso_study_ask): the numbers of the calls
 * with structs, to the bit; sweeps; and what the library says of its studies, options and columns. */
#include "asked.h"

#include "instrument/frequencies/frequencies.h"
#include "instrument/integrals/integrals.h"
#include "instrument/periodic/periodic.h"
#include "instrument/periodic/stability_chart.h"
#include "instrument/separatrix/separatrix.h"
#include "runs.h"
#include "study/study.h"
#include "task/check/check.h"
#include "task/compare.h"

#define FREE REDUCED("0.5") TIME

static char notes[400];
static iso_record *table[ISO_STUDY_TABLES];

static iso_scene *made(const char *text)
{
    iso_scene *scene;
    laws_stop_if(ctx, iso_scene_parse(ctx, "scene", text, strlen(text), &scene) != ISO_OK, text);
    return scene;
}

/* --- asking ----------------------------------------------------------------------------------------------------- */

/* What progress is told. Threads may tell it at the same time: each flag only rises. */
typedef struct watch {
    bool told, wrong;
} watch;

static void look(void *data, double part)
{
    watch *w = data;
    w->told = true;
    if (!(part >= 0 && part <= 1)) w->wrong = true;
}

static iso_status ask_of(const iso_scene *scene, const iso_record *record, const char *name, const char *options)
{
    watch w = {false, false};
    for (int i = 0; i < ISO_STUDY_TABLES; i++) iso_record_free(table[i]);
    const iso_status status = asked(ctx, scene, record, name, options, look, &w, table, notes, sizeof notes);
    gsl_test(w.wrong, "%s: progress is in [0, 1]", name);
    return status;
}

static iso_status ask(const iso_scene *scene, const char *name, const char *options)
{
    return ask_of(scene, NULL, name, options);
}

static double line(const char *key)
{
    const char *value = table[0] ? iso_record_get(table[0], key) : NULL;
    return value ? strtod(value, NULL) : (double)NAN;
}

static bool says(const char *key, const char *value)
{
    const char *said = table[0] ? iso_record_get(table[0], key) : NULL;
    return said && strcmp(said, value) == 0;
}

static double cell(const iso_record *r, size_t row, const char *column)
{
    const int c = iso_record_find(r, column);
    return c >= 0 && row < iso_record_rows(r) ? iso_record_const_row(r, row)[c] : (double)NAN;
}

static const char *word(const iso_record *r, size_t row, const char *column)
{
    return iso_record_word(r, cell(r, row, column));
}

static bool refused(const iso_scene *scene, const iso_record *record, const char *name, const char *options,
                    const char *about)
{
    const iso_status status = ask_of(scene, record, name, options);
    return status == ISO_BAD_ARGUMENT && !table[0] && strcmp(iso_context_about(ctx), about) == 0;
}

/* --- each study ------------------------------------------------------------------------------------------------- */

static void check_splitting(const iso_scene *scene, const iso_scene *same)
{
    iso_separatrix_splitting s;
    gsl_test(ask(scene, "splitting", "k=0.5,3/4,1:1.5:0.25\ndigits=double") != ISO_OK ||
                 iso_record_rows(table[0]) != 5 || strcmp(iso_record_kind(table[0]), "splitting") != 0,
             "splitting: %s", iso_context_message(ctx));
    int wrong = 0;
    for (size_t i = 0; i < 5; i++) {
        const double k = 0.5 + 0.25 * (double)i;
        iso_separatrix_at(ctx, k, same->params.J, 0, ISO_SEPARATRIX_DOUBLE, &s);
        wrong += cell(table[0], i, "k") != k || cell(table[0], i, "m") != s.m || cell(table[0], i, "x") != s.x;
    }
    gsl_test(wrong, "splitting: m at each k");
    gsl_test(ask(scene, "splitting", NULL) != ISO_OK || iso_record_rows(table[0]) != 1 ||
                 cell(table[0], 0, "k") != 0.5,
             "splitting: the scene's k");
    gsl_test(!refused(scene, NULL, "splitting", "k=0.5,1\nlevel=0,1", ""), "splitting: many k and many levels");
    gsl_test(!refused(scene, NULL, "splitting", "k=0.5:1:0", ""), "splitting: a step of 0");
    gsl_test(ask(scene, "splitting", "k=500") != ISO_BAD_INPUT || table[0], "splitting: every row fails");
    gsl_test(ask(scene, "splitting", "k=500,0.5\ndigits=double") != ISO_OK || iso_record_rows(table[0]) != 1 ||
                 !strstr(notes, "1 of 2 values of k failed"),
             "splitting: one row fails: %s", notes);
}

static void check_periodic(const iso_scene *scene, const iso_scene *same)
{
    iso_periodic_options how = iso_periodic_defaults();
    iso_periodic *found;
    how.period = 2;
    gsl_test(iso_periodic_run(ctx, same, &how, &found) != ISO_OK, "periodic orbits");
    gsl_test(ask(scene, "periodic", "period=2") != ISO_OK || iso_record_rows(table[0]) != found->count ||
                 found->count == 0,
             "periodic: %zu orbits", found->count);
    int wrong = 0;
    for (size_t i = 0; i < found->count; i++)
        wrong += cell(table[0], i, "trace") != found->orbit[i].trace || cell(table[0], i, "l") != found->orbit[i].l;
    gsl_test(wrong || line("rotations.0.half_turn_trace") != found->rotation[0].half_turn_trace, "periodic: traces");
    iso_periodic_free(found);
    gsl_test(ask(scene, "periodic", "period=2\nfollow=k=0.45:0.55") != ISO_OK ||
                 strcmp(iso_record_kind(table[0]), "periodic follow") != 0 || !says("parameter", "k"),
             "periodic: branches: %s", iso_context_message(ctx));
    if (!table[0]) return;
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < iso_record_rows(table[0]); i++)
        low = fmin(low, cell(table[0], i, "k")), high = fmax(high, cell(table[0], i, "k"));
    gsl_test(low != 0.45 || high != 0.55, "periodic: from %g to %g", low, high);
    gsl_test(ask(scene, "periodic", "period=2\nfollow=k=5:6") != ISO_BAD_ARGUMENT || table[0],
             "periodic: out of range");
    gsl_test(!refused(scene, NULL, "periodic", "chart=J2\nfollow=k=0.4:0.6", "chart"), "periodic: chart and follow");
    gsl_test(!refused(scene, NULL, "periodic", "steps=3", "steps"), "periodic: steps of no chart");
}

static void check_chart(const iso_scene *scene, const iso_scene *same)
{
    iso_stability_options o = iso_stability_defaults();
    iso_record *grid, *borders;
    memcpy(o.J, same->params.J, sizeof o.J);
    o.steps = 6, o.from[0] = 0.5, o.to[0] = 2, o.from[1] = 1.6, o.to[1] = 2.8;
    gsl_test(iso_stability_chart(ctx, &o, &grid, &borders) != ISO_OK, "a chart");
    gsl_test(ask(scene, "periodic", "chart=J2=1.6:2.8\nk=0.5:2\nsteps=6") != ISO_OK ||
                 iso_record_rows(table[0]) != iso_record_rows(grid) + iso_record_rows(borders) ||
                 !says("moment", "J2") || line("level") != 0,
             "chart: its rows");
    int wrong = 0;
    for (size_t i = 0; i < iso_record_rows(grid); i++)
        wrong += cell(table[0], i, "J2") != iso_record_row(grid, i)[1] ||
                 strcmp(word(table[0], i, "kind"), "grid") != 0 ||
                 !(cell(table[0], i, "least") == iso_record_row(grid, i)[2] || isnan(iso_record_row(grid, i)[2]));
    gsl_test(wrong, "chart: the grid");
    iso_record_free(grid);
    iso_record_free(borders);
}

static void check_search(const iso_scene *scene, const iso_scene *same)
{
    iso_frequencies f;
    iso_frequencies_options how = iso_frequencies_defaults();
    how.turns = 30;
    gsl_test(ask(scene, "frequencies", "turns=30") != ISO_OK || iso_frequencies_find(ctx, same, &how, &f) != ISO_OK ||
                 line("rotation_number") != f.rotation || !says("solution", "estimated"),
             "frequencies: %s", iso_context_message(ctx));
    gsl_test(ask(scene, "integrals", "turns=5\norbits=20") != ISO_OK || !says("verdict", "none") ||
                 line("degree") != 2 || line("orbits") != 20 || !says("energy", "1"),
             "integrals: no additional one");
    iso_scene *neumann = made(REDUCED("-1") TIME);
    gsl_test(ask(neumann, "integrals", "turns=5\norbits=20") != ISO_OK || !says("verdict", "found") ||
                 line("independent") != 1,
             "integrals: one at k = -1");
    iso_scene_free(neumann);
}

static void check_areas(const iso_scene *scene)
{
    gsl_test(ask(scene, "section", "area=true\nstarts=2\ncrossings=10") != ISO_OK || iso_record_rows(table[0]) != 6 ||
                 strcmp(word(table[0], 5, "model"), "point") != 0,
             "areas: three orbits by both models");
    for (size_t i = 0; i < 6; i++)
        gsl_test(strcmp(word(table[0], i, "area"), "kept") != 0 || !(cell(table[0], i, "worst") < 1e-8),
                 "area %zu is kept", i);
    gsl_test(!refused(scene, NULL, "section", "area=true\nevent=n1=0.1", ""), "an event has no area");
    gsl_test(!refused(scene, NULL, "section", "cloud=640", "cloud") ||
                 !strstr(iso_context_message(ctx), "any more: section --area"),
             "clouds are gone");
}

static void check_compare(const iso_scene *scene, const iso_scene *same)
{
    iso_scene shorter = *same;
    iso_comparison *c;
    shorter.end = 1;
    gsl_test(iso_compare(ctx, &shorter, NULL, NULL, &c) != ISO_OK, "a comparison");
    gsl_test(ask(scene, "compare", "t-end=1") != ISO_OK || iso_record_rows(table[0]) != 5 || !table[1] || !table[2] ||
                 table[3] || line("worst_difference.omega") != c->worst[1] || !(c->worst[1] < 1e-10),
             "compare: the differences: %s", iso_context_message(ctx));
    if (!table[1]) return;
    gsl_test(iso_record_rows(table[1]) != 5 ||
                 memcmp(iso_record_row(table[2], 4), iso_record_row(c->run[ISO_POINT].trajectory, 4), 80) != 0,
             "compare: the orbits");
    iso_comparison_free(c);
    iso_scene *closed = made(REDUCED("1") TIME);
    gsl_test(ask(closed, "compare", NULL) != ISO_OK || !table[3] || !table[4] || !table[5] ||
                 !(line("from_exact.ball.worst_difference.n") < 1e-10),
             "compare: the closed solution");
    iso_scene_free(closed);
}

static void check_cost(const iso_scene *scene)
{
    gsl_test(ask(scene, "cost", "backend=ball\nmethod=rk8pd\ntol=1e-9\nwant=1e-5") != ISO_OK ||
                 iso_record_rows(table[0]) != 1 || strcmp(word(table[0], 0, "method"), "rk8pd") != 0 ||
                 !(cell(table[0], 0, "error") < 1e-6) || !(cell(table[0], 0, "total") > 0) ||
                 !says("choice.method", "rk8pd"),
             "cost: one cell: %s", iso_context_message(ctx));
    gsl_test(ask(scene, "cost", "method=rk8pd\ntol=1e-9\nwant=1e-30") != ISO_OK || says("choice.method", "rk8pd"),
             "cost: nothing is so exact");
    gsl_test(!refused(scene, NULL, "cost", "method=magic", "method"), "cost: no method");
}

/* A trajectory solves its model; with another k, or a damaged number, it does not. The record stays as it is. */
static void check_check(const iso_scene *scene)
{
    iso_record *rows;
    gsl_test(asked_run(ctx, scene, NULL, 0, NULL, &rows, notes, sizeof notes) != ISO_OK, "a run");
    gsl_test(ask_of(NULL, rows, "check", "max=1e-9") != ISO_OK || line("rows") != 9 || line("bound") != 1e-9,
             "check: %s", iso_context_message(ctx));
    int above = 0, named = 0;
    for (size_t i = 0; i < iso_record_rows(table[0]); i++) {
        above += cell(table[0], i, "above_the_bound") != 0 || !(cell(table[0], i, "worst") < 1e-9);
        named += strcmp(word(table[0], i, "name"), "ball flow") == 0;
    }
    gsl_test(above || named != 1, "check: no residual is above");
    iso_record_row(rows, 4)[1] *= 1 + 1e-6;
    gsl_test(ask_of(NULL, rows, "check", "max=1e-9") != ISO_OK, "check: a damaged number");
    for (size_t i = 0; i < iso_record_rows(table[0]); i++) above += cell(table[0], i, "above_the_bound") == 1;
    gsl_test(above == 0, "check: is noticed");
    for (int c = 0; c < 7; c++) iso_record_row(rows, 4)[c] = NAN;
    gsl_test(ask_of(NULL, rows, "check", NULL) != ISO_OK || line("passed_over") != 1, "check: a row of nan");
    gsl_test(ask_of(NULL, rows, "check", "k=0.3") != ISO_BAD_INPUT || table[0], "check: another k");
    iso_record_set(ctx, rows, "k", NULL);
    gsl_test(ask_of(NULL, rows, "check", NULL) != ISO_BAD_INPUT, "check: without k");
    gsl_test(ask_of(NULL, rows, "check", "k=0.5") != ISO_OK || iso_record_get(rows, "k"), "check: k as an option");
    gsl_test(ask_of(scene, rows, "check", NULL) != ISO_OK, "check: k of a scene");
    gsl_test(!refused(scene, NULL, "check", NULL, "record"), "check needs a record");
    gsl_test(!refused(scene, rows, "chaos", NULL, "record"), "chaos takes none");
    gsl_test(!refused(NULL, NULL, "chaos", NULL, "scene"), "chaos needs a scene");
    iso_record_free(rows);
}

/* The text of analogue is a scene, whose point has the energy that was asked for. */
static void check_texts(const iso_scene *scene)
{
    double values[6];
    gsl_test(ask(scene, "explain", "method=rk8pd\nas=both") != ISO_OK || !says("method", "rk8pd") ||
                 !says("twin", "1") || line("rows") != 9 ||
                 strncmp(iso_record_get(table[0], "text"), "This orbit has a twin", 21) != 0,
             "explain: %s", iso_context_message(ctx));
    gsl_test(ask(NULL, "analogue", "neumann=1,2,2.5\nenergy=2") != ISO_OK, "analogue: %s", iso_context_message(ctx));
    iso_scene *ball = made(iso_record_get(table[0], "text"));
    iso_scene_numbers(ball, "k", values);
    gsl_test(values[0] != -1 || line("k") != -1 || line("level") != 0, "analogue: a free ball of k = -1");
    gsl_test(ask(ball, "explain", NULL) != ISO_OK || !says("twin", "1"), "analogue: the ball has a twin");
    iso_scene_free(ball);
    gsl_test(!refused(scene, NULL, "analogue", "neumann=1,2,3", "scene"), "analogue: two problems");
    gsl_test(!refused(NULL, NULL, "analogue", NULL, "scene"), "analogue: no problem");
    gsl_test(!refused(NULL, NULL, "analogue", "k=1", "J"), "analogue: half a problem");
}

/* --- sweeps ----------------------------------------------------------------------------------------------------- */

#define SWEEP                                                                                                        \
    "scene: {reduced: {k: 0.5, J: [1.4, 2.1, 3.0]}, initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, "   \
    "-0.3, -0.225]}, time: {end: 2}}\nvary: {k: [0.5, 0, {from: 0.6, to: 2, count: 28}]}\nmeasure: {rotations: "     \
    "{}}\nchunk: 4\n"

static iso_status sweep(int threads, iso_record **record)
{
    watch w = {false, false};
    const iso_status status = iso_sweep_ask(ctx, "a sweep", SWEEP, strlen(SWEEP), threads, look, &w, record);
    gsl_test(w.wrong || (status == ISO_OK && !w.told), "sweep: progress");
    return status;
}

#define BODY                                                                                                         \
    "scene: {ball: {mass: 6.8, radius: 0.11, inertia: [0.027, 0.028, 0.029]}, surface: {kind: plane}, initial: "     \
    "{normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}, time: {end: 2}, effects: "
#define BY_TURNS                                                                                                     \
    BODY "{}}\nvary: {mass: [6.8]}\nuntil: {turns: 2}\nmeasure: {state: {as: both}, chaos: {starts: 1}, "            \
         "frequencies: "                                                                                             \
         "{}, splitting: {}, rotations: {}}\n"
#define BY_TIME                                                                                                      \
    BODY "{attitude: {}, reactions: {}}}\nvary: {mass: [6.8]}\nuntil: {time: 2}\nmeasure: {state: {}, frequencies: " \
         "{}, backends: {}, error: {}, contact: {}}\n"

/* Each column of a sweep is one of the list, but what varies. */
static void check_sweep_columns(const char *text)
{
    iso_record *all = NULL;
    const char *column[2];
    char name[64];
    gsl_test(iso_sweep_ask(ctx, "a sweep", text, strlen(text), 1, NULL, NULL, &all) != ISO_OK, "all: %s",
             iso_context_message(ctx));
    for (size_t c = 0; all && c < iso_record_columns(all); c++) {
        const char *wanted = iso_record_name(all, c);
        int i = 0;
        while (iso_kind_column("sweep", i, name, column) && strcmp(name, wanted) != 0) i++;
        gsl_test(strcmp(wanted, "mass") != 0 && strcmp(name, wanted) != 0, "sweep: what is '%s'", wanted);
    }
    iso_record_free(all);
}

static bool stop(void *data)
{
    return (*(int *)data)-- > 0;
}

static void check_sweep(const iso_scene *scene)
{
    iso_record *one = NULL, *two = NULL, *none = NULL;
    gsl_test(sweep(1, &one) != ISO_OK || sweep(2, &two) != ISO_OK || iso_record_rows(one) != 30, "sweep: %s",
             iso_context_message(ctx));
    if (!one || !two) return;
    int wrong = 0;
    for (size_t i = 0; i < 30; i++) {
        wrong += cell(one, i, "point") != (double)i || (cell(one, i, "status") != 0) != (i == 1);
        wrong += i != 1 && cell(one, i, "rotations_trace1") != cell(two, i, "rotations_trace1");
    }
    gsl_test(wrong || !*word(one, 1, "reason") || *word(one, 2, "reason"), "sweep: points in order, k = 0 fails");
    gsl_test(ask(scene, "periodic", "period=1") != ISO_OK, "the command of this quantity");
    char name[2][ISO_COLUMN_SIZE];
    int found = 0;
    for (size_t c = 0; c < iso_record_columns(one); c++)
        for (int a = 0; a < 3; a++) {
            snprintf(name[0], sizeof name[0], "rotations.%d.half_turn_trace", a);
            found += iso_record_row(one, 0)[c] == line(name[0]);
        }
    gsl_test(found < 3, "sweep: the traces of periodic, %d of 3", found);
    iso_record_free(one);
    iso_record_free(two);
    int left = 2;
    iso_context_set_monitor(ctx, stop, &left);
    gsl_test(sweep(1, &none) != ISO_STOPPED || (none && iso_record_rows(none) == 30), "sweep: stopped");
    iso_context_set_monitor(ctx, NULL, NULL);
    iso_record_free(none);
    gsl_test(iso_sweep_ask(ctx, "a sweep", "vary: {", 7, 1, NULL, NULL, &none) != ISO_BAD_INPUT || none,
             "sweep: a mistake");
    gsl_test(iso_sweep_ask(ctx, "absent.yaml", NULL, 0, 1, NULL, NULL, &none) != ISO_FILE_TROUBLE || none,
             "sweep: no file");
}

/* --- what there is ---------------------------------------------------------------------------------------------- */

static bool is_type(const char *type)
{
    static const char *const types[] = {"flag", "whole", "number", "numbers", "word", "text"};
    int known = 0;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) known += strcmp(types[i], type) == 0;
    return known == 1;
}

/* Every option is complete, and reads each of its own words. */
static void check_option(const char *study, int i)
{
    const char *text[5];
    char given[80];
    iso_study_option(study, i, text);
    const bool flag = strcmp(text[1], "flag") == 0, words = strcmp(text[1], "word") == 0;
    gsl_test(!is_type(text[1]) || !*text[4] || flag != !*text[2] || flag != !*text[3] ||
                 words != (iso_study_option_word(study, i, 0) != NULL),
             "%s --%s is complete", study, text[0]);
    void *how = malloc(iso_study_find(study)->size);
    if (how) iso_study_find(study)->begin(how);
    for (int w = 0; how && iso_study_option_word(study, i, w); w++) {
        snprintf(given, sizeof given, "%s", iso_study_option_word(study, i, w));
        gsl_test(iso_study_set(ctx, iso_study_find(study), text[0], given, how) != ISO_OK, "%s --%s %s", study,
                 text[0], given);
    }
    free(how);
}

static void check_lists(void)
{
    static const char *const names[] = {"run",       "section", "chaos",     "frequencies", "periodic",
                                        "splitting", "prove",   "integrals", "cost",        "compare",
                                        "check",     "explain", "analogue"};
    enum { STUDIES = sizeof names / sizeof *names };
    const char *text[5], *column[2];
    char name[64];
    for (int i = 0; i < STUDIES; i++) {
        int options = 0;
        gsl_test(!iso_study_doc(names[i]) || iso_study_of(names[i]) == 0, "%s is there", names[i]);
        for (; iso_study_option(names[i], options, text); options++) check_option(names[i], options);
        gsl_test(options < 2, "%s has %d options", names[i], options);
    }
    gsl_test(!iso_study_name(STUDIES - 1) || iso_study_name(STUDIES), "%d studies", STUDIES);
    gsl_test(iso_study_doc("poetry") || iso_study_of("poetry") || iso_study_option("poetry", 0, text) ||
                 iso_study_option_word("poetry", 0, 0),
             "no other study");
    int kinds = 0;
    for (const char *kind; (kind = iso_kind_name(kinds)); kinds++) {
        int columns = 0, lacking = 0;
        for (; iso_kind_column(kind, columns, name, column); columns++)
            lacking += !*name || !column[0] || !*column[1];
        gsl_test(columns < 4 || lacking, "%s: %d columns", kind, columns);
    }
    gsl_test(kinds < 12 || iso_kind_column("poetry", 0, name, column), "%d kinds of tables", kinds);
    gsl_test(!iso_kind_column("splitting", 2, name, column) || strcmp(name, "m") != 0, "its third column is m");
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx) return 1;
    iso_scene *scene = made(FREE);
    const iso_scene same = parse(FREE);
    check_splitting(scene, &same);
    check_periodic(scene, &same);
    check_chart(scene, &same);
    check_search(scene, &same);
    check_areas(scene);
    check_compare(scene, &same);
    check_cost(scene);
    check_check(scene);
    check_texts(scene);
    check_sweep(scene);
    check_sweep_columns(BY_TURNS);
    check_sweep_columns(BY_TIME);
    check_lists();
    for (int i = 0; i < ISO_STUDY_TABLES; i++) iso_record_free(table[i]);
    iso_scene_free(scene);
    iso_context_free(ctx);
    return gsl_test_summary();
}

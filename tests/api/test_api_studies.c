/* test_api_studies.c - every study by its name, with options as text (iso_study_ask): the numbers of the calls
 * with structs, to the bit; sweeps; and what the library says of its studies, options and columns. */
#include "ask.h"

#include "instrument/chaos/chaos.h"
#include "instrument/frequencies/frequencies.h"
#include "instrument/periodic/periodic.h"
#include "instrument/separatrix/separatrix.h"
#include "task/compare.h"

static bool says(const char *key, const char *value)
{
    const char *said = table[0] ? iso_record_get(table[0], key) : NULL;
    return said && strcmp(said, value) == 0;
}

static double line(const char *key)
{
    const char *value = table[0] ? iso_record_get(table[0], key) : NULL;
    return value ? strtod(value, NULL) : (double)NAN;
}

static double cell(const iso_record *r, size_t row, const char *column)
{
    const int c = r ? iso_record_find(r, column) : -1;
    return c >= 0 && row < iso_record_rows(r) ? iso_record_const_row(r, row)[c] : (double)NAN;
}

static const char *word(const iso_record *r, size_t row, const char *column)
{
    return iso_record_word(r, cell(r, row, column));
}

/* --- each study: how many tables and rows, and a line of what it found ------------------------------------------- */

#define PENDULUM REDUCED("1") TIME /* a free ball that has a closed solution */

static const struct {
    const char *name, *options, *scene; /* NULL: it takes none */
    int tables, rows;
    const char *kind, *key, *value; /* key NULL: no line */
} asks[] = {
    {"run", NULL, FREE, 1, 9, "trajectory", "model", "ball"},
    {"section", "crossings=20\nstarts=2\nat=0.5,0.2\nas=both\n", FREE, 2, 80, "section", "tolerance", "1e-12"},
    {"section", "area=true\nstarts=2\ncrossings=10", FREE, 1, 6, "section area", NULL, NULL},
    {"chaos", "turns=50\nstarts=2\nat=0.5,0.2", FREE, 3, 4, "chaos", "k", "0.5"},
    {"frequencies", "turns=30", FREE, 1, 0, "frequencies", "solution", "estimated"},
    {"frequencies", NULL, PENDULUM, 1, 0, "frequencies", "solution", "closed"},
    {"periodic", "period=2", FREE, 1, 2, "periodic", NULL, NULL},
    {"periodic", "period=2\nfollow=k=0.45:0.55", FREE, 1, -1, "periodic follow", "parameter", "k"},
    {"periodic", "chart=J2=1.6:2.8\nk=0.5:2\nsteps=6", FREE, 1, -1, "periodic chart", "moment", "J2"},
    {"splitting", NULL, FREE, 1, 1, "splitting", NULL, NULL},
    {"integrals", "turns=5\norbits=20", FREE, 1, 0, "integrals", "verdict", "none"},
    {"cost", "backend=ball\nmethod=rk8pd\ntol=1e-9\nwant=1e-5", FREE, 1, 1, "cost", "choice.method", "rk8pd"},
    {"compare", "t-end=1", FREE, 3, 5, "compare", NULL, NULL},
    {"compare", NULL, PENDULUM, 6, 9, "compare", NULL, NULL},
    {"explain", "method=rk8pd\nas=both", FREE, 1, 0, "explain", "method", "rk8pd"},
    {"analogue", "neumann=1,2,2.5\nenergy=2", NULL, 1, 0, "analogue", "k", "-1"},
};

static void check_asks(void)
{
    for (size_t i = 0; i < sizeof asks / sizeof *asks; i++) {
        int tables = 0;
        iso_scene *scene = asks[i].scene ? made(asks[i].scene) : NULL;
        const char *name = asks[i].name, *options = asks[i].options ? asks[i].options : "";
        gsl_test(ask(scene, name, asks[i].options) != ISO_OK, "%s %s: %s", name, options, iso_context_message(ctx));
        for (int t = 0; t < ISO_STUDY_TABLES; t++) tables += table[t] != NULL;
        const int rows = table[0] ? (int)iso_record_rows(table[0]) : -1;
        gsl_test(tables != asks[i].tables || (asks[i].rows >= 0 ? rows != asks[i].rows : rows < 2),
                 "%s %s: %d tables, %d rows", name, options, tables, rows);
        gsl_test(table[0] && strcmp(iso_record_kind(table[0]), asks[i].kind) != 0, "%s: a table '%s'", name,
                 table[0] ? iso_record_kind(table[0]) : "");
        gsl_test(asks[i].key && !says(asks[i].key, asks[i].value), "%s %s: %s is %s", name, options, asks[i].key,
                 asks[i].key && table[0] ? iso_record_get(table[0], asks[i].key) : "");
        iso_scene_free(scene);
    }
    iso_scene *ball = made(iso_record_get(table[0], "text")); /* of analogue */
    gsl_test(ask(ball, "explain", NULL) != ISO_OK || !says("twin", "1") || !iso_record_get(table[0], "text"),
             "the text of analogue is a scene, whose ball has a twin");
    iso_scene_free(ball);
}

/* --- the numbers of the calls with structs ------------------------------------------------------------------------ */

static void check_rotations(const iso_scene *scene, const iso_scene *same)
{
    iso_separatrix_splitting s;
    int wrong = ask(scene, "splitting", "k=0.5,3/4,1:1.5:0.25\ndigits=double") != ISO_OK;
    for (size_t i = 0; i < 5; i++) {
        const double k = 0.5 + 0.25 * (double)i;
        iso_separatrix_at(ctx, k, same->params.J, 0, ISO_SEPARATRIX_DOUBLE, &s);
        wrong += cell(table[0], i, "k") != k || cell(table[0], i, "m") != s.m || cell(table[0], i, "x") != s.x;
    }
    gsl_test(wrong, "splitting: m at each k");
    gsl_test(ask(scene, "splitting", "k=500,0.5\ndigits=double") || !strstr(notes, "1 of 2 values of k failed"),
             "splitting: one row fails: %s", notes);
    iso_periodic_options how = iso_periodic_defaults();
    iso_periodic *found;
    how.period = 2;
    gsl_test(iso_periodic_run(ctx, same, &how, &found) != ISO_OK, "periodic orbits");
    wrong = ask(scene, "periodic", "period=2") != ISO_OK || iso_record_rows(table[0]) != found->count;
    for (size_t i = 0; i < found->count; i++)
        wrong += cell(table[0], i, "trace") != found->orbit[i].trace || cell(table[0], i, "l") != found->orbit[i].l;
    gsl_test(wrong || line("rotations.0.half_turn_trace") != found->rotation[0].half_turn_trace, "periodic: traces");
    iso_periodic_free(found);
}

static void check_orbits(const iso_scene *scene, const iso_scene *same)
{
    iso_frequencies f;
    iso_frequencies_options turns = iso_frequencies_defaults();
    turns.turns = 30;
    gsl_test(ask(scene, "frequencies", "turns=30") != ISO_OK ||
                 iso_frequencies_find(ctx, same, &turns, &f) != ISO_OK || line("frequency_ratio") != f.ratio,
             "frequencies: the frequency ratio");
    iso_chaos *chaos;
    iso_chaos_options o = iso_chaos_defaults();
    o.turns = 50;
    gsl_test(iso_chaos_run(ctx, same, &o, &chaos) != ISO_OK || ask(scene, "chaos", "turns=50") != ISO_OK ||
                 cell(table[0], 0, "ball_megno") != chaos->own.result[ISO_BALL].megno ||
                 cell(table[0], 0, "point_megno") != chaos->own.result[ISO_POINT].megno,
             "chaos: both models");
    iso_chaos_free(chaos);
    iso_comparison *c;
    iso_scene shorter = *same;
    shorter.end = 1;
    gsl_test(iso_compare(ctx, &shorter, NULL, NULL, &c) != ISO_OK || ask(scene, "compare", "t-end=1") != ISO_OK ||
                 line("worst_difference.omega") != c->worst[1] || !(c->worst[1] < 1e-10) ||
                 memcmp(iso_record_row(table[2], 4), iso_record_row(c->run[ISO_POINT].trajectory, 4), 80) != 0,
             "compare: the differences and the orbits");
    iso_comparison_free(c);
}

/* What `check` reads: k of the record, of an option or of a scene. The record stays as it is. */
static void check_check(const iso_scene *scene)
{
    iso_record *rows;
    gsl_test(asked_run(ctx, scene, NULL, 0, &rows, notes, sizeof notes) != ISO_OK, "a run");
    gsl_test(ask_of(NULL, rows, "check", "max=1e-9") != ISO_OK || line("rows") != 9 || line("bound") != 1e-9 ||
                 cell(table[0], 0, "above_the_bound") != 0,
             "check: %s", iso_context_message(ctx));
    gsl_test(ask_of(NULL, rows, "check", "k=0.3") != ISO_BAD_INPUT || table[0], "check: another k");
    iso_record_set(ctx, rows, "k", NULL);
    gsl_test(ask_of(NULL, rows, "check", NULL) != ISO_BAD_INPUT, "check: without k");
    gsl_test(ask_of(NULL, rows, "check", "k=0.5") != ISO_OK || iso_record_get(rows, "k"), "check: k as an option");
    gsl_test(ask_of(scene, rows, "check", NULL) != ISO_OK, "check: k of a scene");
    iso_record_free(rows);
}

/* There, through a file, and back: the same ball. */
static void check_convert(const iso_scene *scene)
{
    iso_record *ball, *read = NULL;
    int wrong = 0;
    gsl_test(asked_run(ctx, scene, NULL, 0, &ball, notes, sizeof notes) != ISO_OK, "a run");
    gsl_test(ask_of(NULL, ball, "convert", "to=point\ntol=1e-14") != ISO_OK || !says("model", "point"), "convert: %s",
             iso_context_message(ctx));
    gsl_test(iso_record_write(ctx, "asked.csv", table[0], 17, "trajectory") != ISO_OK ||
                 iso_record_read(ctx, "asked.csv", NULL, &read, notes, sizeof notes) != ISO_OK || *notes,
             "convert: through a file");
    remove("asked.csv");
    gsl_test(ask_of(NULL, read, "convert", "to=ball\ntol=1e-14") != ISO_OK || *notes, "convert: back: %s", notes);
    for (size_t i = 0; i < iso_record_rows(ball); i++)
        for (size_t c = 0; c < 7; c++)
            wrong += !(fabs(iso_record_row(ball, i)[c] - iso_record_row(table[0], i)[c]) <= 1e-13);
    gsl_test(wrong, "convert: the same ball");
    iso_record_free(ball);
    iso_record_free(read);
}

/* --- what each study needs, and does not take
 * ---------------------------------------------------------------------- */

static void check_subjects(const iso_scene *scene)
{
    static const struct {
        bool scene, record;
        const char *name, *options, *about;
    } bad[] = {{true, false, "check", NULL, "record"},       {true, true, "chaos", NULL, "record"},
               {false, false, "chaos", NULL, "scene"},       {true, false, "analogue", "neumann=1,2,3", "scene"},
               {false, false, "analogue", NULL, "scene"},    {false, false, "analogue", "k=1", "J"},
               {true, false, "poetry", NULL, "study"},       {true, false, "cost", "method=magic", "method"},
               {true, false, "periodic", "steps=3", "steps"}};
    iso_record *rows;
    gsl_test(asked_run(ctx, scene, NULL, 0, &rows, notes, sizeof notes) != ISO_OK, "a run");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        gsl_test(ask_of(bad[i].scene ? scene : NULL, bad[i].record ? rows : NULL, bad[i].name, bad[i].options) !=
                         ISO_BAD_ARGUMENT ||
                     table[0] || !about(bad[i].about),
                 "%s is refused: %s", bad[i].name, iso_context_message(ctx));
    iso_record_free(rows);
    iso_scene *braked = made(FREE "effects: {rolling_resistance: {coefficient: 0.1}}\n");
    gsl_test(ask(braked, "chaos", NULL) != ISO_BAD_INPUT || !begins("scene:4:31: 'rolling_resistance' takes energy"),
             "the place in the scene, as the command says it: %s", iso_context_message(ctx));
    iso_scene_free(braked);
}

/* --- sweeps ----------------------------------------------------------------------------------------------------- */

#define SWEEP                                                                                                        \
    "scene: {reduced: {k: 0.5, J: [1.4, 2.1, 3.0]}, initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, "   \
    "-0.3, -0.225]}, time: {end: 2}}\nvary: {k: [0.5, 0, {from: 0.6, to: 2, count: 28}]}\nmeasure: {rotations: "     \
    "{}}\nchunk: 4\n"
static iso_status sweep(const char *text, const char *options, iso_record **record)
{
    bool wrong = false;
    const iso_status status = iso_sweep_ask(ctx, "a sweep", text, strlen(text), options, look, &wrong, record);
    gsl_test(wrong, "sweep: progress is in [0, 1]");
    return status;
}

static bool stop(void *data)
{
    return (*(int *)data)-- > 0;
}

static void check_sweep(const iso_scene *scene)
{
    iso_record *one = NULL, *two = NULL, *none = NULL;
    gsl_test(sweep(SWEEP, "threads=1", &one) != ISO_OK || sweep(SWEEP, "threads=2", &two) != ISO_OK ||
                 iso_record_rows(one) != 30,
             "sweep: %s", iso_context_message(ctx));
    if (!one || !two) return;
    int wrong = ask(scene, "periodic", "period=1") != ISO_OK; /* the command of this quantity */
    for (size_t i = 0; i < 30; i++) {
        wrong += cell(one, i, "point") != (double)i || (cell(one, i, "status") != 0) != (i == 1);
        wrong += i != 1 && cell(one, i, "rotations_trace1") != cell(two, i, "rotations_trace1");
    }
    gsl_test(wrong || !*word(one, 1, "reason") || *word(one, 2, "reason"), "sweep: points in order, k = 0 fails");
    gsl_test(cell(one, 0, "rotations_trace1") != line("rotations.0.half_turn_trace"), "sweep: the study's numbers");
    const double last = cell(one, 29, "rotations_trace1");
    iso_record_free(one);
    iso_record_free(two);
    int left = 2;
    iso_context_set_monitor(ctx, stop, &left);
    gsl_test(sweep(SWEEP, "threads=1", &none) != ISO_STOPPED || (none && iso_record_rows(none) == 30),
             "sweep: stopped");
    iso_context_set_monitor(ctx, NULL, NULL);
    iso_record_free(none);
    remove("api_sweep.csv"), remove("api_sweep.csv.part");
    left = 2;
    iso_context_set_monitor(ctx, stop, &left);
    gsl_test(sweep(SWEEP, "threads=1\noutput=api_sweep.csv", &none) != ISO_STOPPED || none ||
                 !strstr(iso_context_message(ctx), "api_sweep.csv.part"),
             "sweep into a file, stopped: %s", iso_context_message(ctx));
    iso_context_set_monitor(ctx, NULL, NULL);
    gsl_test(sweep(SWEEP, "output=api_sweep.csv\nresume=true", &two) != ISO_OK || iso_record_rows(two) != 30 ||
                 cell(two, 29, "rotations_trace1") != last,
             "sweep into a file, resumed: %s", iso_context_message(ctx));
    iso_record_free(two);
    remove("api_sweep.csv");
    for (int i = 0; i < 3; i++) {
        static const char *const wrong_options[] = {"resume=true", "shard=1/2", "output=x.csv\nshard=3/2"};
        gsl_test(sweep(SWEEP, wrong_options[i], &none) != ISO_BAD_ARGUMENT || none, "sweep: %s", wrong_options[i]);
    }
    gsl_test(sweep("vary: {", NULL, &none) != ISO_BAD_INPUT || none, "sweep: a mistake");
    gsl_test(iso_sweep_ask(ctx, "absent.yaml", NULL, 0, NULL, NULL, NULL, &none) != ISO_FILE_TROUBLE || none,
             "sweep: no file");
}

/* --- what there is ---------------------------------------------------------------------------------------------- */

/* Every option is complete, and reads each of its own words. */
static void check_option(const char *study, int i)
{
    const char *text[5];
    char given[80];
    iso_study_option(study, i, text);
    const bool flag = strcmp(text[1], "flag") == 0, words = strcmp(text[1], "word") == 0;
    gsl_test(!strstr(" flag whole number numbers word text ", text[1]) || !*text[4] || flag != !*text[2] ||
                 flag != !*text[3] || words != (iso_study_option_word(study, i, 0) != NULL),
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
    const char *text[5], *column[2];
    char name[64];
    int studies = 0, kinds = 0;
    for (const char *study; (study = iso_study_name(studies)); studies++) {
        int options = 0;
        gsl_test(!iso_study_doc(study) || iso_study_of(study) == 0, "%s is there", study);
        for (; iso_study_option(study, options, text); options++) check_option(study, options);
        gsl_test(options < 2, "%s has %d options", study, options);
    }
    gsl_test(studies < 13 || iso_study_doc("poetry") || iso_study_of("poetry") ||
                 iso_study_option("poetry", 0, text) || iso_study_option_word("poetry", 0, 0),
             "%d studies, and no other", studies);
    for (const char *kind; (kind = iso_kind_name(kinds)); kinds++) {
        int columns = 0, lacking = 0;
        for (; iso_kind_column(kind, columns, name, column); columns++)
            lacking += !*name || !column[0] || !*column[1];
        gsl_test(columns < 4 || lacking, "%s: %d columns", kind, columns);
    }
    gsl_test(kinds < 12 || iso_kind_column("poetry", 0, name, column), "%d kinds of tables", kinds);
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx) return 1;
    iso_scene *scene = made(FREE);
    const iso_scene same = parse(FREE);
    check_asks();
    check_rotations(scene, &same);
    check_orbits(scene, &same);
    check_check(scene);
    check_convert(scene);
    check_subjects(scene);
    check_sweep(scene);
    check_lists();
    forget_tables();
    iso_scene_free(scene);
    iso_context_free(ctx);
    return gsl_test_summary();
}

/* test_api.c - the calls for other languages (api/interface.h): the same numbers as the calls with structs, to
 * the bit; words, notes, and a stop in the middle. tests/python tries the same calls from Python. */
#include "asked.h"

#include <unistd.h>

#include "runs.h"
#include "study/study.h"

#define FREE REDUCED("0.5") TIME
enum { WIDTH = 7 };

static char notes[400];

static iso_scene *made(const char *text)
{
    iso_scene *scene;
    laws_stop_if(ctx, iso_scene_parse(ctx, "scene", text, strlen(text), &scene) != ISO_OK, text);
    return scene;
}

static bool about(const char *words)
{
    return strcmp(iso_context_about(ctx), words) == 0;
}

static void check_scenes(void)
{
    iso_scene *scene = made(REDUCED("0.5") TIME "output: {columns: [s, n3]}\n"), *copy, *none;
    const char *const bad[][2] = {{"backend", "x"},  {"method", "x"},   {"tolerance", "2"}, {"end", "nan"},
                                  {"step", "0"},     {"as", "neither"}, {"columns", "t,t"}, {"columns", "t,,n1"},
                                  {"columns", "e1"}, {"columns", ""},   {"colour", "red"}};
    int columns[ISO_MAX_COLUMNS];
    double x[6];
    gsl_test(iso_scene_copy(ctx, scene, &copy) != ISO_OK, "a copy");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        gsl_test(iso_scene_set(ctx, scene, bad[i][0], bad[i][1]) != ISO_BAD_ARGUMENT || !about(bad[i][0]),
                 "%s = %s is refused: %s", bad[i][0], bad[i][1], iso_context_message(ctx));
    gsl_test(iso_scene_columns(scene, columns) != 2 || strcmp(iso_scene_word(scene, "method"), "auto"),
             "the scene is as it was");
    gsl_test(iso_scene_set(ctx, scene, "as", "both") != ISO_OK || iso_scene_columns(scene, columns) != 15 ||
                 iso_scene_columns(copy, columns) != 2,
             "'as' sets the columns, not those of the copy");
    gsl_test(iso_scene_set(ctx, scene, "end", "7.5") != ISO_OK || iso_scene_numbers(scene, "end", x) != 1 ||
                 x[0] != 7.5,
             "a number");
    gsl_test(iso_scene_numbers(scene, "J", x) != 3 || x[1] != 2.1, "J");
    gsl_test(iso_scene_numbers(scene, "eps", x) != 1 || !isnan(x[0]), "a ball has no eps of its own");
    gsl_test(iso_scene_numbers(scene, "mood", x) != 0 || iso_scene_word(scene, "mood"), "no key");
    gsl_test(iso_scene_read(ctx, "absent.yaml", &none) != ISO_FILE_TROUBLE || none, "no file");
    gsl_test(iso_scene_parse(ctx, "here", "a: 1", 4, &none) != ISO_BAD_INPUT || none ||
                 strncmp(iso_context_message(ctx), "here:1:1: ", 10) != 0,
             "no scene: %s", iso_context_message(ctx));
    iso_scene_free(scene);
    iso_scene_free(copy);
    iso_scene_free(NULL);
}

/* Texts that languages without YAML or without our structs need. */
static void check_texts(void)
{
    static const char yaml[] = "a: {x: 0.1, y: -0, \"z\\n\": [1e400, true, tr\"ue, '1', ~, ]}\nb:\n";
    static const char json[] = "{\"a\": {\"x\": 0.10000000000000001, \"y\": -0.0, \"z\\u000a\": [\"1e400\", true, "
                               "\"tr\\u0022ue\", \"1\", \"~\"]}, \"b\": null}";
    char text[200], part[8];
    const char *section = "", *key = "";
    size_t length = 0, whole = 0;
    int keys = 0;
    gsl_test(iso_yaml_json(ctx, "y", yaml, strlen(yaml), text, sizeof text, &length) != ISO_OK ||
                 strcmp(text, json) != 0 || length != strlen(json),
             "YAML as JSON: %s", text);
    gsl_test(iso_yaml_json(ctx, "y", yaml, strlen(yaml), part, sizeof part, &length) != ISO_OK ||
                 strcmp(part, "{\"a\": {") != 0 || length != strlen(json),
             "as much as there is room for: %s", part);
    gsl_test(iso_yaml_json(ctx, "y", "[a]: 1", 6, text, sizeof text, &length) != ISO_BAD_INPUT ||
                 strncmp(iso_context_message(ctx), "y:1:1: ", 7) != 0,
             "a key that is a list: %s", iso_context_message(ctx));
    iso_scene *scene = made(REDUCED("1/3") TIME);
    gsl_test(iso_scene_text(ctx, scene, text, sizeof text, &length) != ISO_OK || strlen(text) != length ||
                 strncmp(text, "reduced: {k: 1/3, J: [", 22) != 0 ||
                 iso_scene_text(ctx, scene, part, sizeof part, &whole) != ISO_OK || whole != length ||
                 strcmp(part, "reduced") != 0 || iso_scene_text(ctx, scene, NULL, 0, &whole) != ISO_OK,
             "a scene as text: %s", text);
    iso_scene_free(scene);
    while (iso_scene_key(keys, &section, &key)) keys++;
    gsl_test(keys < 30 || strcmp(section, "output") != 0 || strcmp(key, "columns") != 0, "%d keys, then %s.%s", keys,
             section, key);
    gsl_test(iso_list(ctx, NULL, NULL, 0, &whole) != ISO_OK ||
                 iso_list(ctx, "clocks", text, sizeof text, &length) != ISO_OK || length >= whole ||
                 strncmp(text, "clocks: ", 8) != 0,
             "lists: %zu of %zu", length, whole);
    gsl_test(iso_list(ctx, "clock", NULL, 0, &length) != ISO_BAD_ARGUMENT || !about("topic"), "no such list");
}

/* Rows of the scene by iso_foreign_run and by an orbit, times in two orders. */
static void check_rows(const char *text)
{
    iso_scene *scene = made(text);
    const iso_scene with_struct = parse(text);
    kept *wanted = run(&with_struct, NULL, 0);
    iso_solution *orbit = NULL;
    iso_record *record = NULL;
    static double times[MOST], table[MOST * ISO_MAX_COLUMNS];
    gsl_test(asked_run(ctx, scene, NULL, 0, NULL, &record, notes, sizeof notes) != ISO_OK || *notes, "it runs");
    const size_t rows = iso_record_rows(record), columns = iso_record_columns(record),
                 bytes = columns * sizeof *times;
    int wrong = rows != wanted->rows || columns != wanted->columns;
    for (size_t i = 0; i < rows; i++) wrong += memcmp(iso_record_row(record, i), wanted->row[i], bytes) != 0;
    gsl_test(wrong, "%zu rows are those of iso_run", rows);
    for (size_t i = 0; i < rows; i++) times[(i * 5 + 1) % rows] = iso_scene_time(&with_struct, i);
    wrong = iso_solution_create(ctx, scene, &orbit) != ISO_OK;
    for (int twice = 0; twice < 2 && !wrong; twice++) {
        wrong += iso_solution_at(orbit, times, rows, table, notes, sizeof notes) != ISO_OK;
        for (size_t i = 0; i < rows; i++)
            wrong += memcmp(table + (i * 5 + 1) % rows * columns, wanted->row[i], bytes) != 0;
    }
    gsl_test(wrong, "an orbit has them in any order");
    iso_solution_free(orbit);
    iso_record_free(record);
    iso_scene_free(scene);
    free(wanted);
}

/* The formulas against rows: the map and its inverse, the rates of the clocks by differences, the energy. */
static void check_formulas(void)
{
    enum { COLUMNS = 15 };
    const double d = 1e-4, times[2] = {1 - d, 1 + d}, at = 1;
    double side[2][COLUMNS], row[COLUMNS], point[6], ball[6], rates[2];
    iso_scene *scene = made(REDUCED("-0.6") TIME "output: {as: both}\n");
    iso_solution *solution;
    gsl_test(iso_solution_create(ctx, scene, &solution) != ISO_OK, "a solution");
    gsl_test(iso_solution_at(solution, times, 2, side[0], NULL, 0) != ISO_OK, "rows beside t = 1");
    gsl_test(iso_solution_at(solution, &at, 1, row, NULL, 0) != ISO_OK, "the row at t = 1");
    iso_scene_to_point(scene, row + 3, point);
    iso_scene_to_ball(scene, row + 9, ball);
    for (int i = 0; i < 6; i++) {
        gsl_test_abs(point[i], row[9 + i], 1e-10, "point %d", i);
        gsl_test_abs(ball[i], row[3 + i], 1e-10, "ball %d", i);
    }
    iso_scene_clock_rates(scene, row + 6, rates);
    for (int c = 0; c < 2; c++)
        gsl_test_rel(rates[c], (side[1][1 + c] - side[0][1 + c]) / (2 * d), 1e-6, "rate of clock %d", c);
    gsl_test_rel(iso_scene_energy(scene, row + 3), iso_solution_number(solution, "h"), 1e-10, "the energy");
    gsl_test(strcmp(iso_solution_word(solution, "models"), "both") != 0, "it has both models");
    iso_solution_free(solution);
    iso_scene_free(scene);
}

/* The example of interface.h: its lines as they stand there. */
static void check_example(void)
{
    const double times[3] = {0, 2, 1};
    double table[3 * WIDTH];
    iso_scene *scene = NULL;
    iso_solution *orbit = NULL;
    iso_record *record = NULL;
    char folder[] = "foreign-XXXXXX"; /* of its own: another scene.yaml is not ours */
    const bool there = mkdtemp(folder) && chdir(folder) == 0;
    FILE *file = there ? fopen("scene.yaml", "w") : NULL;
    gsl_test(!file, "a file");
    if (!file) return;
    fputs(FREE, file);
    fclose(file);
    iso_scene_read(ctx, "scene.yaml", &scene);
    asked_run(ctx, scene, NULL, 0, NULL, &record, notes, sizeof notes);
    iso_solution_create(ctx, scene, &orbit);
    iso_solution_at(orbit, times, 3, table, notes, sizeof notes);
    remove("scene.yaml");
    gsl_test(chdir("..") != 0 || rmdir(folder) != 0, "and its folder");
    gsl_test(iso_record_rows(record) != 9 ||
                 memcmp(table + WIDTH, iso_record_row(record, 8), WIDTH * sizeof *table) != 0,
             "the example");
    iso_solution_free(orbit);
    iso_record_free(record);
    iso_scene_free(scene);
}

/* Times that are not there: none at all are the scene's own; a number without a place is refused, and so is a place
 * without a number. */
static void check_no_times(void)
{
    iso_scene *scene = made(FREE);
    iso_record *record = NULL;
    double time = 1;
    gsl_test(asked_run(ctx, scene, &time, 0, NULL, &record, NULL, 0) != ISO_BAD_ARGUMENT || record || !about("times"),
             "no times: %s", iso_context_message(ctx));
    iso_solution *orbit;
    gsl_test(iso_solution_create(ctx, scene, &orbit) != ISO_OK, "an orbit");
    gsl_test(iso_solution_at(orbit, NULL, 1, &time, NULL, 0) != ISO_BAD_ARGUMENT, "a time at NULL");
    gsl_test(iso_solution_at(orbit, NULL, 0, NULL, NULL, 0) != ISO_OK, "no time for an orbit");
    iso_solution_free(orbit);
    iso_scene_free(scene);
}

/* Contact is lost: the words have no room in few bytes, and an orbit refuses what is beyond. */
static void check_contact(void)
{
    iso_scene *scene = made(OUTSIDE START "time: {end: 50, step: 1}\neffects: {" GRAVITY ", reactions: {}}\n");
    iso_solution *orbit;
    iso_record *record;
    double table[200];
    char few[8] = "xxxxxxx";
    gsl_test(asked_run(ctx, scene, NULL, 0, NULL, &record, few, sizeof few - 1) != ISO_OK || few[6] || few[7],
             "a note that is cut: '%s'", few);
    gsl_test(iso_record_rows(record) >= 50, "%zu rows to the loss", iso_record_rows(record));
    iso_record_free(record);
    gsl_test(asked_run(ctx, scene, NULL, 0, NULL, &record, NULL, 0) != ISO_OK, "no room for notes");
    const double lost = iso_record_row(record, iso_record_rows(record) - 1)[0];
    gsl_test(iso_solution_create(ctx, scene, &orbit) != ISO_OK, "an orbit");
    gsl_test(iso_solution_at(orbit, (double[]){lost / 2}, 1, table, NULL, 0) != ISO_OK || table[0] != lost / 2,
             "before the loss");
    gsl_test(iso_solution_at(orbit, (double[]){0, 2 * lost}, 2, table, NULL, 0) != ISO_NUMERICAL, "after it");
    iso_solution_free(orbit);
    iso_record_free(record);
    iso_scene_free(scene);
}

/* --- studies and files ------------------------------------------------------------------------------------------ */

static iso_record *table_of[ISO_STUDY_TABLES];

/* Runs a study; the tables of the one before are freed. */
static iso_status study(const iso_scene *scene, const char *name, const char *options)
{
    for (int i = 0; i < ISO_STUDY_TABLES; i++) iso_record_free(table_of[i]);
    return asked(ctx, scene, NULL, name, options, NULL, NULL, table_of, notes, sizeof notes);
}

static void check_studies(const iso_scene *scene)
{
    gsl_test(study(scene, "section", "crossings=20\nstarts=2\nat=0.5,0.2\nas=both\n") != ISO_OK ||
                 iso_record_rows(table_of[0]) != 80 || iso_record_rows(table_of[1]) != 80 || table_of[2],
             "a section of both models");
    gsl_test(strcmp(iso_record_kind(table_of[0]), "section") != 0, "is of kind section");
    gsl_test(study(scene, "chaos", "turns=50\nstarts=2\nat=0.5,0.2") != ISO_OK || iso_record_rows(table_of[0]) != 4 ||
                 iso_record_columns(table_of[0]) != 35 || !table_of[1] || !table_of[2] ||
                 !iso_record_get(table_of[0], "share.chaotic") ||
                 strcmp(iso_record_get(table_of[0], "k"), "0.5") != 0,
             "chaos");
    gsl_test(study(scene, "chaos", NULL) != ISO_OK || iso_record_rows(table_of[0]) != 1, "with its defaults");
}

/* What is refused: a number that went wrong, -1 in another language, a word that is none. It is not the scene that is
 * blamed. */
static void check_numbers(void)
{
    iso_scene *scene = made(FREE "solver: {tolerance: 1e-9}\n");
    static const char *const bad[][2] = {{"tol=nan", "tol"},      {"tol=-1e-9", "tol"},     {"tol=1e-16", "tol"},
                                         {"tol=0.2", "tol"},      {"tol=inf", "tol"},       {"tol=0", "tol"},
                                         {"starts=-1", "starts"}, {"starts=1.5", "starts"}, {"starts=1e17", "starts"},
                                         {"model=x", "model"},    {"seed=", "seed"},        {"at", "at"},
                                         {"mood=1", "mood"},      {"axis=4", ""},           {"at=1", ""},
                                         {"at=1,2;x", ""}};
    for (size_t i = 0; i < 2 * sizeof bad / sizeof *bad; i++)
        gsl_test(study(scene, i % 2 ? "chaos" : "section", bad[i / 2][0]) != ISO_BAD_ARGUMENT || table_of[0] ||
                     table_of[1] || !about(bad[i / 2][1]) || strstr(iso_context_message(ctx), "scene:"),
                 "%s: %s", bad[i / 2][0], iso_context_message(ctx));
    static const char *const section[] = {"crossings=0", "event=x=1", "event=t=1", "event=n1", "axis=1\nevent=n1=0"};
    for (size_t i = 0; i < sizeof section / sizeof *section; i++)
        gsl_test(study(scene, "section", section[i]) != ISO_BAD_ARGUMENT || table_of[0], "%s: %s", section[i],
                 iso_context_message(ctx));
    gsl_test(study(scene, "chaos", "turns=0") != ISO_BAD_ARGUMENT || !about("turns"), "no turns");
    gsl_test(study(scene, "poetry", NULL) != ISO_BAD_ARGUMENT || !about("study"), "no study");
    for (int own = 0; own < 2; own++)
        gsl_test(study(scene, "section", own ? "crossings=5\ntol=1e-6" : "crossings=5") != ISO_OK ||
                     strcmp(iso_record_get(table_of[0], "tolerance"), own ? "1e-06" : "1e-09"),
                 "the section says its tolerance");
    for (int i = 0; i < ISO_STUDY_TABLES; i++) iso_record_free(table_of[i]);
    iso_scene_free(scene);
}

static void check_files(const iso_scene *scene)
{
    iso_record *ball, *point = NULL, *read = NULL, *back = NULL;
    double errors[5] = {0};
    gsl_test(asked_run(ctx, scene, NULL, 0, errors, &ball, notes, sizeof notes) != ISO_OK || !(errors[0] < 1e-10) ||
                 !isnan(errors[1]) || !isnan(errors[2]),
             "errors of a run: %g", errors[0]);
    gsl_test(asked(ctx, NULL, ball, "convert", "to=point", NULL, NULL, table_of, notes, sizeof notes) != ISO_OK,
             "there");
    point = table_of[0];
    gsl_test(iso_record_write(ctx, "foreign.csv", point, 17, "trajectory") != ISO_OK, "written");
    gsl_test(iso_record_read(ctx, "foreign.csv", NULL, &read, notes, sizeof notes) != ISO_OK || *notes, "read");
    gsl_test(asked(ctx, NULL, read, "convert", "to=ball", NULL, NULL, table_of, notes, sizeof notes) != ISO_OK ||
                 *notes,
             "back: %s", notes);
    back = table_of[0];
    remove("foreign.csv");
    int wrong = 0;
    for (size_t i = 0; i < iso_record_rows(ball); i++)
        for (int c = 0; c < WIDTH; c++)
            wrong += !(fabs(iso_record_row(ball, i)[c] - iso_record_row(back, i)[c]) <= 1e-13);
    gsl_test(wrong, "the same ball");
    gsl_test(iso_record_write(ctx, "foreign.csv", ball, 18, "trajectory") != ISO_BAD_ARGUMENT, "18 digits");
    gsl_test(iso_record_write(ctx, "foreign.csv", ball, 17, "a/poem") != ISO_BAD_ARGUMENT, "no kind");
    iso_record_free(read);
    gsl_test(iso_record_read(ctx, "absent.csv", NULL, &read, notes, sizeof notes) != ISO_FILE_TROUBLE || read,
             "none");
    iso_record_free(ball);
    iso_record_free(point);
    iso_record_free(back);
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx) return 1;
    gsl_test(iso_interface() != ISO_INTERFACE, "the interface has its number");
    check_scenes();
    check_texts();
    check_rows(FREE);
    check_rows(REDUCED("-1") "time: {end: -3, step: 0.25}\noutput: {as: both}\n");
    check_rows(POINT TIME "output: {as: ball}\n");
    check_rows(OUTSIDE START TIME "effects: {" GRAVITY ", attitude: {}, reactions: {two_sided: true}}\n");
    check_formulas();
    check_example();
    check_no_times();
    check_contact();
    iso_scene *scene = made(FREE);
    check_studies(scene);
    check_numbers();
    check_files(scene);
    iso_scene_free(scene);
    iso_context_free(ctx);
    return gsl_test_summary();
}

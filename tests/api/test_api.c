/* test_api.c - the calls for other languages (api/interface.h): the same numbers as the calls with structs, to
 * the bit; words, notes, and rooms that are too small. tests/python tries the same calls from Python. */
#include "ask.h"

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
    gsl_test(iso_scene_parse(ctx, "here", "a: 1", 4, &none) != ISO_BAD_INPUT || none || !begins("here:1:1: "),
             "no scene: %s", iso_context_message(ctx));
    iso_scene_free(scene);
    iso_scene_free(copy);
    iso_scene_free(NULL);
}

/* Texts that languages without YAML or without our structs need: as much as there is room for, and how long all is. */
static void check_texts(void)
{
    static const char yaml[] = "a: {x: 0.1, y: -0, \"z\\n\": [1e400, true, tr\"ue, '1', ~, ]}\nb:\n";
    static const char json[] = "{\"a\": {\"x\": 0.10000000000000001, \"y\": -0.0, \"z\\u000a\": [\"1e400\", true, "
                               "\"tr\\u0022ue\", \"1\", \"~\"]}, \"b\": null}";
    iso_scene *scene = made(REDUCED("1/3") TIME);
    char text[400];
    size_t length = 0, all = 0;
    for (int what = 0; what < 3; what++)
        for (size_t room = sizeof text; room > 0; room = room > 8 ? 8 : 0) {
            static const char *const begin[] = {json, "reduced: {k: 1/3, J: [", "clocks: "};
            const iso_status status = what == 0   ? iso_yaml_json(ctx, "y", yaml, strlen(yaml), text, room, &length)
                                      : what == 1 ? iso_scene_text(ctx, scene, text, room, &length)
                                                  : iso_list(ctx, "clocks", text, room, &length);
            const size_t wanted = room > 8 ? strlen(begin[what]) : room - 1;
            if (room > 8) all = length;
            gsl_test(status != ISO_OK || strncmp(text, begin[what], wanted) != 0 || length != all ||
                         strlen(text) != (all < room ? all : room - 1),
                     "a text in %zu bytes: %s", room, text);
        }
    gsl_test(iso_yaml_json(ctx, "y", "[a]: 1", 6, text, sizeof text, &length) != ISO_BAD_INPUT || !begins("y:1:1: "),
             "a key that is a list: %s", iso_context_message(ctx));
    gsl_test(iso_scene_text(ctx, scene, NULL, 0, &length) != ISO_OK || length < 22, "no room at all");
    gsl_test(iso_list(ctx, NULL, NULL, 0, &length) != ISO_OK || length <= all, "all lists");
    gsl_test(iso_list(ctx, "clock", NULL, 0, &length) != ISO_BAD_ARGUMENT || !about("topic"), "no such list");
    iso_scene_free(scene);
}

/* Rows of the scene by text and by an orbit, times in two orders. */
static void check_rows(const char *text)
{
    iso_scene *scene = made(text);
    const iso_scene with_struct = parse(text);
    kept *wanted = run(&with_struct, NULL, 0);
    iso_solution *orbit = NULL;
    iso_record *record = NULL;
    static double times[MOST], got[MOST * ISO_MAX_COLUMNS];
    gsl_test(asked_run(ctx, scene, NULL, 0, &record, notes, sizeof notes) != ISO_OK || *notes, "it runs");
    const size_t rows = iso_record_rows(record), columns = iso_record_columns(record),
                 bytes = columns * sizeof *times;
    int wrong = rows != wanted->rows || columns != wanted->columns;
    for (size_t i = 0; i < rows; i++) wrong += memcmp(iso_record_row(record, i), wanted->row[i], bytes) != 0;
    gsl_test(wrong, "%zu rows are those of iso_run", rows);
    for (size_t i = 0; i < rows; i++) times[(i * 5 + 1) % rows] = iso_scene_time(&with_struct, i);
    wrong = iso_solution_create(ctx, scene, &orbit) != ISO_OK;
    for (int twice = 0; twice < 2 && !wrong; twice++) {
        wrong += iso_solution_at(orbit, times, rows, got, notes, sizeof notes) != ISO_OK;
        for (size_t i = 0; i < rows; i++)
            wrong += memcmp(got + (i * 5 + 1) % rows * columns, wanted->row[i], bytes) != 0;
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
    const double d = 1e-4, times[3] = {1 - d, 1, 1 + d};
    double rows[3][COLUMNS], point[6], ball[6], rates[2];
    iso_scene *scene = made(REDUCED("-0.6") TIME "output: {as: both}\n");
    iso_solution *solution;
    gsl_test(iso_solution_create(ctx, scene, &solution) != ISO_OK, "a solution");
    gsl_test(iso_solution_at(solution, times, 3, rows[0], NULL, 0) != ISO_OK, "rows around t = 1");
    const double *row = rows[1];
    iso_scene_to_point(scene, row + 3, point);
    iso_scene_to_ball(scene, row + 9, ball);
    for (int i = 0; i < 6; i++) {
        gsl_test_abs(point[i], row[9 + i], 1e-10, "point %d", i);
        gsl_test_abs(ball[i], row[3 + i], 1e-10, "ball %d", i);
    }
    iso_scene_clock_rates(scene, row + 6, rates);
    for (int c = 0; c < 2; c++)
        gsl_test_rel(rates[c], (rows[2][1 + c] - rows[0][1 + c]) / (2 * d), 1e-6, "rate of clock %d", c);
    gsl_test_rel(iso_scene_energy(scene, row + 3), iso_solution_number(solution, "h"), 1e-10, "the energy");
    gsl_test(strcmp(iso_solution_word(solution, "models"), "both") != 0, "it has both models");
    iso_solution_free(solution);
    iso_scene_free(scene);
}

/* A number of times without a place is refused, and so is a place without a number: none are the scene's own. Where
 * contact is lost, notes are cut to their room, and an orbit refuses what is beyond. */
static void check_times(void)
{
    iso_scene *scene = made(OUTSIDE START "time: {end: 50, step: 1}\neffects: {" GRAVITY ", reactions: {}}\n");
    iso_solution *orbit;
    iso_record *record = NULL;
    double row[2 * ISO_MAX_COLUMNS], time = 1;
    char few[8] = "xxxxxxx";
    gsl_test(asked_run(ctx, scene, &time, 0, &record, NULL, 0) != ISO_BAD_ARGUMENT || record || !about("times"),
             "no times: %s", iso_context_message(ctx));
    gsl_test(asked_run(ctx, scene, NULL, 0, &record, few, sizeof few - 1) != ISO_OK || few[6] || few[7],
             "a note that is cut: '%s'", few);
    const size_t rows = iso_record_rows(record);
    const double lost = rows < 50 ? iso_record_row(record, rows - 1)[0] : (double)NAN;
    gsl_test(iso_solution_create(ctx, scene, &orbit) != ISO_OK, "an orbit");
    gsl_test(iso_solution_at(orbit, NULL, 1, row, NULL, 0) != ISO_BAD_ARGUMENT, "a time at NULL");
    gsl_test(iso_solution_at(orbit, NULL, 0, NULL, NULL, 0) != ISO_OK, "no time for an orbit");
    gsl_test(iso_solution_at(orbit, (double[]){lost / 2}, 1, row, NULL, 0) != ISO_OK || row[0] != lost / 2,
             "before the loss");
    gsl_test(iso_solution_at(orbit, (double[]){0, 2 * lost}, 2, row, NULL, 0) != ISO_NUMERICAL, "after it");
    iso_solution_free(orbit);
    iso_record_free(record);
    iso_scene_free(scene);
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
    check_times();
    iso_context_free(ctx);
    return gsl_test_summary();
}

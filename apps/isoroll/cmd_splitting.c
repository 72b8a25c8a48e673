/* isoroll splitting - how far the separatrix of the middle axis' rotation splits: why only k = 1 and k = -1. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "plot/plot.h"
#include "scene_options.h"
#include "splitting_report.h"
#include "study/level.h"

/* What splitting can be told. */
typedef struct options {
    scene_options scene;                   /* only its file is used */
    const char *k, *level, *output, *plot; /* NULL: not given */
    iso_separatrix_digits digits;
    int threads;
    bool json;
} options;

enum { MOST_K = 100000 };

/* --- what is typed ---------------------------------------------------------------------------------------------- */

static bool set_splitting_digits(void *at, const char *text)
{
    int i = 0;
    while (i < 3 && strcmp(text, iso_separatrix_digits_name(i)) != 0) i++;
    *(iso_separatrix_digits *)at = (iso_separatrix_digits)i;
    return i < 3;
}

/* A number, or a fraction p/q. */
static bool read_number(const char *text, size_t length, double *x)
{
    const char *slash = memchr(text, '/', length);
    double below;
    if (!slash) return iso_number_read(text, length, x);
    const size_t first = (size_t)(slash - text);
    if (!iso_number_read(text, first, x) || !iso_number_read(slash + 1, length - first - 1, &below)) return false;
    *x /= below;
    return isfinite(*x);
}

/* The values of --k or --level. */
typedef struct numbers {
    const char *name;
    double *x;
    size_t count;
} numbers;

static iso_status bad_list(iso_context *ctx, const numbers *list, const char *text)
{
    return iso_context_fail(
        ctx, ISO_BAD_ARGUMENT, "",
        "--%s '%s': expected values and ranges A:B:STEP, STEP not 0, with commas between, at most "
        "%d values: 0.25:3:0.25, or 1/3,1/2,-0.5",
        list->name, text, MOST_K);
}

static iso_status append(iso_context *ctx, numbers *list, double x)
{
    double *more = realloc(list->x, (list->count + 1) * sizeof *more);
    if (!more) return iso_context_no_memory(ctx, "%zu values of %s", list->count + 1, list->name);
    list->x = more;
    list->x[list->count++] = x;
    return ISO_OK;
}

/* 0.1 + 2 0.1 shall be 0.3, -0.3 + 3 0.1 shall be 0, and 1/3 stay as it is. */
static double rounded(double k, double step)
{
    char digits[ISO_NUMBER_SIZE];
    double tidy;
    if (fabs(k) < 1e-9 * fabs(step)) return 0;
    iso_number_print_as(digits, k, 12);
    return iso_number_read(digits, strlen(digits), &tidy) && fabs(tidy - k) < 1e-15 * fmax(1, fabs(k)) ? tidy : k;
}

/* A, or A, A + STEP, ... up to B, which a rounding error does not cut off. STEP goes towards B, whatever its sign. */
static iso_status read_item(iso_context *ctx, const char *text, const char *item, size_t length, numbers *list)
{
    double number[3];
    int parts = 0;
    for (const char *c = item; c <= item + length; parts++) {
        const size_t left = (size_t)(item + length - c), part = strcspn(c, ":") < left ? strcspn(c, ":") : left;
        if (parts == 3 || !read_number(c, part, &number[parts])) return bad_list(ctx, list, text);
        c += part + 1;
    }
    if (parts == 1) return append(ctx, list, number[0]);
    const double way = number[1] - number[0], step = copysign(number[2], way), steps = floor(way / step + 1e-9);
    if (parts != 3 || number[2] == 0 || !(steps < MOST_K)) return bad_list(ctx, list, text);
    iso_status status = ISO_OK;
    for (double i = 0; i <= steps && status == ISO_OK; i++)
        status = append(ctx, list, rounded(number[0] + i * step, step));
    return status;
}

/* What is typed, or the scene's one. The values are the caller's to free. */
static iso_status read_list(iso_context *ctx, const char *text, double scenes, numbers *list)
{
    if (!text) return append(ctx, list, scenes);
    for (const char *c = text;; c++) {
        const size_t length = strcspn(c, ",");
        const iso_status status = read_item(ctx, text, c, length, list);
        if (status != ISO_OK) return status;
        if (list->count > MOST_K) return bad_list(ctx, list, text);
        c += length;
        if (!*c) return ISO_OK;
    }
}

/* Many k on one level, or many levels at one k: the shorter list is repeated. */
static iso_status read_lists(iso_context *ctx, const options *o, const iso_scene *scene, numbers *k, numbers *level)
{
    double own = 0;
    iso_status status = o->level ? ISO_OK : iso_level_of_scene(ctx, scene, "the splitting is measured", &own);
    if (status == ISO_OK) status = read_list(ctx, o->k, scene->params.k, k);
    if (status == ISO_OK) status = read_list(ctx, o->level, own, level);
    if (status == ISO_OK && k->count > 1 && level->count > 1)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                                "--k has %zu values and --level %zu: give many k and one level, or one k and many "
                                "levels",
                                k->count, level->count);
    while (status == ISO_OK && k->count < level->count) status = append(ctx, k, k->x[0]);
    while (status == ISO_OK && level->count < k->count) status = append(ctx, level, level->x[0]);
    return status;
}

/* --- the command ------------------------------------------------------------------------------------------------ */

/* All rows failed: the first one's reason is that of the command. Some: they are told. */
static int judge(iso_context *ctx, const iso_separatrix_table *s)
{
    size_t failed = 0, first = s->rows;
    for (size_t i = 0; i < s->rows; i++) {
        if (s->row[i].status == ISO_OK || s->row[i].status == ISO_STOPPED) continue;
        if (failed++ == 0) first = i;
    }
    if (failed == 0) return EXIT_DONE;
    if (failed == s->rows)
        return finish(ctx, iso_context_fail(ctx, s->row[first].status, "", "%s", s->row[first].words));
    complain("%zu of %zu values of %s failed: %s", failed, s->rows, splitting_is_by_level(s) ? "the level" : "k",
             s->row[first].words);
    return EXIT_SOME_FAILED;
}

static int report(iso_context *ctx, const options *o, const iso_scene *scene, const iso_separatrix_table *s,
                  iso_table_writer *csv)
{
    int result = judge(ctx, s);
    const bool some = splitting_has_rows(s);
    if (some && o->json)
        result = splitting_print_json(scene, s) ? result : EXIT_NUMERICAL;
    else if (some && (!o->output || strcmp(o->output, "-") != 0))
        splitting_print(scene, s);
    if (s->lost > 0) complain("%zu zeros of m lie between these values, but were not found", s->lost);
    result = worse(result, splitting_save(ctx, scene, s, csv, interrupted() ? NULL : o->plot));
    return result;
}

static iso_status prepare(iso_context *ctx, const options *o, iso_scene *scene, numbers *k, numbers *level,
                          iso_table_writer **csv)
{
    iso_status status = check_json_alone(ctx, "splitting", o->output, o->json);
    if (status == ISO_OK && o->plot) status = iso_plot_check_format(ctx, o->plot);
    if (status == ISO_OK) status = iso_scene_read(ctx, o->scene.file, scene);
    if (status == ISO_OK) status = read_lists(ctx, o, scene, k, level);
    return status == ISO_OK && o->output ? iso_table_writer_open(ctx, o->output, "splitting", csv) : status;
}

static int work(iso_context *ctx, const options *o, const iso_scene *scene, const numbers *k, const numbers *level,
                iso_table_writer *csv)
{
    iso_separatrix_table *s = NULL;
    iso_separatrix_options how = iso_separatrix_defaults();
    how.k = k->x, how.level = level->x, how.count = k->count;
    for (int i = 0; i < 3; i++) how.J[i] = scene->params.J[i];
    how.scene = scene;
    how.digits = o->digits;
    how.threads = o->threads;
    how.progress = progress_told;
    begin_work(ctx, NULL);
    const iso_status status = iso_separatrix_run(ctx, &how, &s);
    progress_end();
    int result = status == ISO_STOPPED ? EXIT_SOME_FAILED : finish_scene(ctx, &o->scene, scene, status);
    if (status == ISO_STOPPED) complain("interrupted: only rows that are done are shown");
    if (s)
        result = worse(result, report(ctx, o, scene, s, csv));
    else
        iso_table_writer_close(ctx, csv, false);
    iso_separatrix_free(s);
    return result;
}

static int run(iso_context *ctx, const void *options_given)
{
    const options *o = options_given;
    iso_scene scene = {.places = 0};
    iso_table_writer *csv = NULL;
    numbers k = {.name = "k"}, level = {.name = "level"};
    const iso_status status = prepare(ctx, o, &scene, &k, &level, &csv);
    const int result =
        status == ISO_OK ? work(ctx, o, &scene, &k, &level, csv) : finish_scene(ctx, &o->scene, &scene, status);
    free(k.x);
    free(level.x);
    return result;
}

static const options defaults = {.scene = SCENE_OPTIONS_UNSET, .digits = ISO_SEPARATRIX_AUTO};

static const option_row rows[] = {
    ROW("k", "LIST", "values and ranges A:B:STEP",
        "values of k in place of the scene's, with commas between: ranges A:B:STEP, numbers, fractions such as 1/3",
        iso_set_text, options, k),
    ROW("level", "LIST", "values and ranges A:B:STEP",
        "levels in place of the scene's, at one k: a list like that of --k", iso_set_text, options, level),
    ROW_OF_WORDS("digits", "D", "double, quad or auto",
                 "double: 64 bits of mantissa (19 digits); quad: 128 bits (32 digits); auto: 128 bits where 64 give "
                 "less than 3 "
                 "digits of m (default)",
                 set_splitting_digits, options, digits, iso_separatrix_digits_name),
    ROW_THREADS(options, threads),
    ROW_OUTPUT(options, output),
    ROW_PLOT(options, plot),
    ROW_JSON(options, json),
    ROW_END,
};

const command command_splitting = {
    COMMAND("splitting", "SCENE", "measure how far the separatrix splits: why only k = 1 and k = -1", scene.file),
    .takes = FILE_SCENE,
    .description =
        "The rotation about the middle axis is unstable. On the section n_a = 0, a the axis after the middle one, "
        "it is a point (l, x); l and x are those of isoroll section. One curve leaves it: the orbits that come "
        "from this rotation. Another one enters its mirror: the orbits that end in the opposite rotation. If there "
        "is an additional analytic integral, both are one curve. If they cross, there is none. This command follows "
        "the curve that leaves to its first point with l = pi/2. It finds x = M_a/|M| there, and the slope m = "
        "dx/dl; the other curve has the slope -m. So m = 0 at k = 1 and k = -1, on every level. Where m is not 0, "
        "the curves cross. The command shows this numerically, with an estimated error; it does not prove that "
        "there is no additional analytic integral.\n\n"
        "Each m has its error, from a second computation. m falls very fast with |k|: where 64 bits do not "
        "distinguish it from 0, 128 bits are taken, which need from seconds to a minute for each k. Other zeros of "
        "m between two values of k or the level are located. There the curves touch at one point. The slope at the "
        "next common point is printed: if it is not 0, they cross there. Where the multiplier of the rotation is "
        "below 1.02, as between nearly equal moments, m is too small for 128 bits and not computed.\n\n"
        "The level is (H/eps) J2^(1/k), J2 the middle moment, H the energy of the point: a number without a unit. "
        "It is 0 for the free ball, and another number for a point off H = 0 and for a ball with the effect "
        "'level'. --level takes other levels than the scene's. On a low level there is no such rotation: the point "
        "oscillates between two places of rest instead.\n\n"
        "Only k, J and the level of the scene are read. Nothing else of its start matters, nor do its times. -o "
        "FILE writes one row for each k or level. --plot draws |m| over k or the level, and both curves where they "
        "are seen best. After Ctrl-C the rows that are done are printed.",
    .example = "isoroll splitting scene.yaml --k 0.25:3:0.25 --plot splitting.png",
    .exits = "1: interrupted, or some rows failed\n"
             "3: bad input: an effect that acts, other than 'level', equal or nearly equal moments, or a level "
             "without the rotation\n"
             "4: the computation failed, or no memory",
};

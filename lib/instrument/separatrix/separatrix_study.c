/* separatrix_study.c - the splitting by its name: lists of k and of levels, and its table (study/study.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/rational_impl.h"
#include "instrument/separatrix/separatrix.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "study/level.h"
#include "study/study_impl.h"

enum { MOST = 100000 };

/* --- what is typed ---------------------------------------------------------------------------------------------- */

static bool set_digits(void *at, const char *text)
{
    int i = 0;
    while (i < 3 && strcmp(text, iso_separatrix_digits_name(i)) != 0) i++;
    *(iso_separatrix_digits *)at = (iso_separatrix_digits)i;
    return i < 3;
}

static iso_status bad_list(iso_context *ctx, const iso_separatrix_list *list)
{
    return iso_context_fail(
        ctx, ISO_BAD_ARGUMENT, "",
        "--%s '%s': expected values and ranges A:B:STEP, STEP not 0, with commas between, at most "
        "%d values: 0.25:3:0.25, or 1/3,1/2,-0.5",
        list->name, list->text, MOST);
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

/* Each item is A, or A, A + STEP, ... up to B, which a rounding error does not cut off. STEP goes towards B, whatever
 * its sign. */
static iso_status read_list(iso_context *ctx, iso_separatrix_list *list)
{
    for (const char *c = list->text; c; c = *c ? c + 1 : NULL) {
        double number[3] = {0};
        int parts = 0;
        do {
            if (parts > 0) c++;
            const size_t length = strcspn(c, ":,");
            if (parts == 3 || !iso_rational_read_double(c, length, &number[parts++])) return bad_list(ctx, list);
            c += length;
        } while (*c == ':');
        const double length = number[1] - number[0], step = copysign(number[2], length),
                     steps = parts == 1 ? 0 : floor(length / step + 1e-9);
        if (parts == 2 || (parts == 3 && step == 0) || !(steps < MOST)) return bad_list(ctx, list);
        for (double i = 0; i <= steps; i++) {
            double *more = realloc(list->x, (list->count + 1) * sizeof *more);
            if (!more) return iso_context_no_memory(ctx, "%zu values of %s", list->count + 1, list->name);
            list->x = more;
            list->x[list->count++] = parts == 1 ? number[0] : rounded(number[0] + i * step, step);
        }
        if (list->count > MOST) return bad_list(ctx, list);
    }
    return ISO_OK;
}

ISO_STUDY_BEGIN(iso_separatrix_request,
                (iso_separatrix_request){.k = {.name = "k"}, .level = {.name = "level"}, iso_separatrix_defaults()})

static void end(void *options)
{
    free(((iso_separatrix_request *)options)->k.x);
    free(((iso_separatrix_request *)options)->level.x);
}

static iso_status prepare(iso_context *ctx, void *options)
{
    iso_separatrix_request *r = options;
    ISO_TRY(read_list(ctx, &r->k));
    ISO_TRY(read_list(ctx, &r->level));
    if (r->k.count <= 1 || r->level.count <= 1) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "",
                            "--k has %zu values and --level %zu: give many k and one level, or one k and many "
                            "levels",
                            r->k.count, r->level.count);
}

/* Copies a list, or the scene's own number, to `count` places. */
static double *repeated(const iso_separatrix_list *list, double own, size_t count)
{
    double *x = malloc((count + 1) * sizeof *x);
    for (size_t i = 0; x && i < count; i++) x[i] = list->count == 0 ? own : list->x[list->count > 1 ? i : 0];
    return x;
}

/* --- what is found ---------------------------------------------------------------------------------------------- */

/* A row for each k or level that did not fail, then one for each zero. */
static iso_status fill(iso_context *ctx, const iso_scene *scene, const iso_separatrix_table *s, iso_record **table)
{
    iso_field fields[ISO_MOST_FIELDS];
    iso_fields_copy(iso_separatrix_table_fields, "rows", fields);
    iso_status status = iso_study_table(ctx, "splitting", scene, fields, s, iso_separatrix_fields, table);
    for (size_t i = 0; status == ISO_OK && i < s->rows + s->zeros; i++) {
        const iso_separatrix_splitting *row = i < s->rows ? &s->row[i] : &s->zero[i - s->rows];
        if (row->status == ISO_OK) status = iso_columns_append(ctx, iso_separatrix_fields, row, *table);
    }
    if (*table && iso_record_rows(*table) == 0) iso_record_free(*table), *table = NULL;
    return status;
}

/* If all rows failed, the first one's reason is that of the study. If some did, a note says so. */
static iso_status find(iso_context *ctx, const iso_scene *scene, const iso_separatrix_options *how,
                       iso_study_result *result)
{
    iso_separatrix_table *s = NULL;
    size_t failed = 0, first = 0;
    const iso_status status = iso_separatrix_run(ctx, how, &s);
    if (!iso_study_keep(result, s, iso_separatrix_table_fields, iso_separatrix_free)) return status;
    const iso_status made = fill(ctx, scene, s, &result->table[0]);
    for (size_t i = s->rows; i-- > 0;)
        if (s->row[i].status != ISO_OK && s->row[i].status != ISO_STOPPED) failed++, first = i;
    if (status == ISO_OK && made == ISO_OK && failed == s->rows)
        return iso_context_fail(ctx, s->row[first].status, "", "%s", s->row[first].text);
    result->failed = failed > 0;
    if (failed > 0)
        iso_study_note(result, "%zu of %zu values of %s failed: %s", failed, s->rows, s->by_level ? "the level" : "k",
                       s->row[first].text);
    if (s->lost > 0) iso_study_note(result, "%zu zeros of m lie between these values, but were not found", s->lost);
    return status == ISO_OK ? made : status;
}

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    const iso_separatrix_request *r = options;
    const iso_scene *scene = subject->scene;
    iso_separatrix_options how = r->how;
    double level = 0;
    const iso_effects acting = iso_scene_acting(scene);
    if (r->level.count == 0) ISO_TRY(iso_level_of_scene(ctx, scene, ISO_SPLITTING_IS, &level));
    ISO_TRY(iso_refuse_equal_moments(ctx, scene->params.J, ISO_NO_SPLITTING));
    ISO_TRY(iso_refuse_beyond_level(ctx, &acting, ISO_SPLITTING_IS));
    how.count = r->level.count > 1 ? r->level.count : r->k.count > 1 ? r->k.count : 1;
    double *k = repeated(&r->k, scene->params.k, how.count), *levels = repeated(&r->level, level, how.count);
    how.k = k, how.level = levels;
    for (int i = 0; i < 3; i++) how.J[i] = scene->params.J[i];
    how.progress = result->sink.progress;
    how.data = result->sink.data;
    const iso_status status =
        k && levels ? find(ctx, scene, &how, result) : iso_context_no_memory(ctx, "%zu values", how.count);
    free(k);
    free(levels);
    return status;
}

#define ROW(name, argument, expected, doc, set, member)                                                              \
    ISO_OPTION(name, argument, expected, doc, set, iso_separatrix_request, member)

const iso_option iso_splitting_option[] = {
    ROW("k", "LIST", "values and ranges A:B:STEP",
        "values of k in place of the scene's, with commas between: ranges A:B:STEP, numbers, fractions such as 1/3",
        iso_set_text, k.text),
    ROW("level", "LIST", "values and ranges A:B:STEP",
        "levels in place of the scene's, at one k: a list like that of --k", iso_set_text, level.text),
    ISO_OPTION_WORDS("digits", "D", "double, quad or auto",
                     "double: 64 bits of mantissa (19 digits); quad: 128 bits (32 digits); auto: 128 bits where 64 "
                     "give less than 3 digits of m (default)",
                     set_digits, iso_separatrix_request, how.digits, iso_separatrix_digits_name),
    ISO_OPTION_THREADS(iso_separatrix_request, how.threads),
    ISO_OPTION_END,
};

const iso_study iso_splitting_study = {"splitting",
                                       "measure how far the separatrix splits: why only k = 1 and k = -1",
                                       iso_splitting_option,
                                       sizeof(iso_separatrix_request),
                                       begin,
                                       end,
                                       prepare,
                                       run,
                                       ISO_STUDY_OF_SCENE,
                                       iso_separatrix_table_fields,
                                       .print = iso_separatrix_print,
                                       .describe = iso_separatrix_describe};

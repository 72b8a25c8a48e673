/* check_study.c - check by its name: what options add to the lines of a trajectory, its rows one after the other, its
 * residuals as a table (study/study.h), and which columns and lines no residual depends on. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "orbit/description.h"
#include "study/fields_impl.h"
#include "study/file_parameters_impl.h"
#include "task/check/check_impl.h"

/* --- what is found ---------------------------------------------------------------------------------------------- */

static bool is_bad(const void *checked)
{
    const iso_checked *c = checked;
    return !isnan(c->bound) && !(c->residual.worst <= c->bound);
}

const iso_field iso_checked_fields[] = {
    ISO_STRUCT(iso_checked, "", residual, iso_residual_fields, "what is 0"),
    ISO_IS("above_the_bound", is_bad, "whether it is larger than --max"),
    ISO_FIELD_END,
};

static const iso_field name_field[] = {{.name = "", .type = ISO_FIELD_TEXT}, ISO_FIELD_END};

#define FIELD(key, member, ...) ISO_MEMBER(iso_check_found, key, member, __VA_ARGS__)

static const iso_field check_fields[] = {
    FIELD("rows", rows, "", "of the file"),
    FIELD("passed_over", passed, "", "rows of nan"),
    FIELD("bound", bound, "", "of --max"),
    ISO_LIST(iso_check_found, "residuals", checked, count, iso_checked_fields, "all"),
    ISO_LIST_AT(iso_check_found, "not_looked_at", unseen, unseen_count, name_field, "on which no residual depends"),
    ISO_FIELD_END,
};
#undef FIELD

static void free_found(void *found)
{
    if (found) free(((iso_check_found *)found)->unseen);
    free(found);
}

/* --- what is not looked at -------------------------------------------------------------------------------------- */

/* A test changes every number of many files by a millionth: a residual notices, or the number is named here. */
static bool is_followed(const checker *c)
{
    return c->model[ISO_BALL].followed || c->model[ISO_POINT].followed;
}

/* A residual has the name of the line: it was compared with rows. */
static bool is_compared(const checker *c, const char *name)
{
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < c->model[k].found.count; i++)
            if (strcmp(c->model[k].found.residual[i].name, name) == 0) return true;
    return false;
}

/* Whether the line is a number or a text of the equations. What turns with the ball is taken from the rows. */
static bool is_of_equations(const checker *c, const char *key)
{
    char line[ISO_NAME_SIZE];
    if (strcmp(key, "k") == 0 || strcmp(key, "J") == 0 || strcmp(key, "effects") == 0) return true;
    const bool radius = strcmp(key, "radius") == 0, D = strcmp(key, "D") == 0;
    if ((radius || D) && iso_checker_has_effects(c)) return true;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        const size_t length = strlen(effect->name);
        if (D && effect->needs_D && c->effects.on[e] && !c->effects.idle[e]) return true;
        if (!c->effects.on[e] || strncmp(key, effect->name, length) != 0 || key[length] != '.') continue;
        for (const iso_effect_number *n = effect->numbers; n && n->name; n++) {
            iso_effect_line(line, effect, n->name);
            if (strcmp(line, key) == 0) return !n->turns_with && !c->effects.idle[e];
        }
        return true;
    }
    return false;
}

void iso_checking_unseen(iso_checking *c, void (*note)(void *data, const char *name), void *data)
{
    char name[ISO_NAME_SIZE + 8];
    const char *key, *value;
    if (!is_followed(c)) note(data, "the flow from row to row");
    for (size_t i = 0; i < c->width; i++) {
        const int column = iso_column_find(iso_record_name(c->record, i));
        const bool orbit = strcmp(iso_record_name(c->record, i), ISO_ORBIT_COLUMN) == 0;
        if (!orbit && (column < 0 || !c->looked[column])) note(data, iso_record_name(c->record, i));
    }
    for (size_t i = 0; iso_record_line(c->record, i, &key, &value); i++) {
        snprintf(name, sizeof name, "# %.*s", ISO_NAME_SIZE, key);
        if (!is_compared(c, name) && !(is_followed(c) && is_of_equations(c, key))) note(data, name);
    }
}

/* --- the rows --------------------------------------------------------------------------------------------------- */

/* Names that find no memory are counted as lost. */
typedef struct keeper {
    iso_check_found *found;
    bool lost;
} keeper;

static void keep_name(void *data, const char *name)
{
    keeper *k = data;
    iso_check_found *f = k->found;
    char(*more)[ISO_UNSEEN_SIZE] = realloc(f->unseen, (f->unseen_count + 1) * sizeof *more);
    k->lost = k->lost || !more;
    if (!more) return;
    f->unseen = more;
    snprintf(more[f->unseen_count++], sizeof *more, "%s", name);
}

/* Columns that are none of a trajectory never come so far that they could be compared. */
static iso_status end_check(iso_context *ctx, iso_checking *checking, const char *ignored, iso_check_found *f)
{
    iso_residuals all;
    keeper k = {f, false};
    ISO_TRY(iso_checking_end(checking, &all));
    f->rows = all.rows;
    f->passed = all.passed;
    f->count = all.count;
    for (int i = 0; i < all.count; i++) f->checked[i] = (iso_checked){all.residual[i], f->bound};
    char words[ISO_UNSEEN_SIZE];
    snprintf(words, sizeof words, "other columns: %s", ignored ? ignored : "");
    if (ignored) keep_name(&k, words);
    iso_checking_unseen(checking, keep_name, &k);
    return k.lost ? iso_context_no_memory(ctx, "the names of what is not looked at") : ISO_OK;
}

/* The rows one after the other. A mistake in the first one is reported before what the header lacks. */
static iso_status check_rows(iso_context *ctx, const iso_study_subject *subject, const iso_check_request *r,
                             const iso_row_source *from, iso_check_found *f)
{
    iso_params params;
    iso_record *header = NULL; /* with the lines that the request and the scene state */
    iso_checking *checking = NULL;
    iso_source_row row = {.number = calloc(iso_record_columns(subject->record) + 1, sizeof *row.number)};
    f->bound = r->bound;
    iso_status status = row.number ? iso_record_create_like(ctx, subject->record, 0, NULL, &header)
                                   : iso_context_no_memory(ctx, "a row");
    if (status == ISO_OK) status = from->next(ctx, from->data, &row);
    if (status == ISO_OK) status = iso_file_parameters_apply(ctx, &r->added, subject->scene, header, &params);
    if (status == ISO_OK) status = iso_checking_create(ctx, &params, header, r->tolerance, &checking);
    while (status == ISO_OK) {
        checking->passed = row.passed;
        if (!row.more) break;
        if (row.begins_orbit) checking->begins = true;
        status = iso_checking_put(checking, row.number);
        if (status == ISO_OK) status = from->next(ctx, from->data, &row);
    }
    if (status == ISO_OK) status = end_check(ctx, checking, row.ignored, f);
    iso_checking_free(checking);
    iso_record_free(header);
    free(row.number);
    return status;
}

/* --- the study -------------------------------------------------------------------------------------------------- */

ISO_STUDY_BEGIN(iso_check_request, (iso_check_request)ISO_CHECK_UNSET)

static void print_found(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_check_found *f = result->found;
    (void)scene, (void)options;
    fprintf(to, "%zu rows", f->rows);
    if (f->passed > 0) fprintf(to, ", %zu of nan passed over", f->passed);
    fputs("\n", to);
    iso_table_begin(to, 1);
    fputs("residual\tworst\tat row\tof\n", to);
    for (int i = 0; i < f->count; i++) {
        const iso_residual *x = &f->checked[i].residual;
        fprintf(to, "%s\t%.2e\t%zu\t%s%s\n", x->name, x->worst, x->row, x->what,
                is_bad(&f->checked[i]) ? "  ABOVE THE BOUND" : "");
    }
    iso_table_end(to);
    if (f->unseen_count > 0) fputs("not looked at:", to);
    for (size_t i = 0; i < f->unseen_count; i++)
        fprintf(to, " %s%s", f->unseen[i], i + 1 < f->unseen_count ? "," : "\n");
}

static iso_status run(iso_context *ctx, const iso_study_subject *subject, const void *options,
                      iso_study_result *result)
{
    iso_kept_rows at = {.record = subject->record, .sink = &result->sink, .passes_nan = true};
    const iso_row_source kept = {iso_kept_rows_next, &at};
    iso_field fields[ISO_MOST_FIELDS];
    iso_check_found *f = iso_study_keep(result, calloc(1, sizeof *f), check_fields, free_found);
    if (!f) return iso_context_no_memory(ctx, "a check");
    ISO_TRY(check_rows(ctx, subject, options, subject->rows ? subject->rows : &kept, f));
    iso_fields_copy(check_fields, "residuals", fields);
    iso_status status =
        iso_study_table(ctx, "check", subject->scene, fields, f, iso_checked_fields, &result->table[0]);
    for (int i = 0; i < f->count; i++) result->failed = result->failed || is_bad(&f->checked[i]);
    for (int i = 0; status == ISO_OK && i < f->count; i++)
        status = iso_columns_append(ctx, iso_checked_fields, &f->checked[i], result->table[0]);
    return status;
}

const iso_option iso_check_option[] = {
    ISO_OPTION_TOLERANCE("tolerance of the flow from row to row (default 1e-13)", iso_check_request, tolerance),
    ISO_OPTIONS_FILE_PARAMETERS(iso_check_request, added),
    ISO_OPTION_ROW_TOLERANCE(iso_check_request, added),
    ISO_OPTION("max", "X", "a number from 0 on", "exit with status 1 if a residual is larger than X", iso_set_bound,
               iso_check_request, bound),
    ISO_OPTION_END,
};

const iso_study iso_check_study = {
    ISO_STUDY_AS("check", iso_check_request, iso_check_option, "test whether a trajectory solves its model"),
    .run = run, .of = ISO_STUDY_OF_RECORD | ISO_STUDY_USES_SCENE, .print = print_found};

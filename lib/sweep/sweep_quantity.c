/* sweep_quantity.c - what can be measured at a point: studies. Their options, their columns, and their numbers. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_impl.h"
#include "instrument/chaos/chaos_impl.h"
#include "instrument/periodic/periodic_study_impl.h"
#include "instrument/section/section_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "study/options_impl.h"
#include "sweep/sweep_impl.h"

/* --- chaos: its columns are those of the models that are integrated; orbits of many scenes go together ----------- */

static const iso_chaos_options *chaos_options(const iso_sweep_job *job)
{
    return &((const iso_chaos_request *)job->options)->how;
}

static bool with_model(const iso_sweep_job *job, iso_models model)
{
    const iso_models asked = chaos_options(job)->models;
    return asked == ISO_SHOW_START || asked == ISO_SHOW_BOTH || asked == model;
}

static bool chaos_has(const iso_sweep_job *job, const char *name)
{
    if (strncmp(name, "ball_", 5) == 0) return with_model(job, ISO_SHOW_BALL);
    if (strncmp(name, "point_", 6) == 0) return with_model(job, ISO_SHOW_POINT);
    return strcmp(name, "verdict") == 0 || chaos_options(job)->starts > 0;
}

/* Starts that failed are counted in the share. */
static iso_status chaos_check(iso_context *ctx, const void *found)
{
    const iso_chaos *c = found;
    if (c->own.status[ISO_BALL] == ISO_OK && c->own.status[ISO_POINT] == ISO_OK) return ISO_OK;
    return iso_context_fail(ctx, c->failure, "", "%s", c->words);
}

/* Starts of one section already fill the lanes. */
static bool chaos_together(const iso_sweep_job *job)
{
    const iso_chaos_options *o = chaos_options(job);
    return o->starts == 0 && o->at_count == 0 && o->axis == ISO_AXIS_AUTO;
}

/* A turn takes about 15 microseconds by each model, and most orbits have a verdict after 1000. Orbits are followed in
 * the lanes of vectors, so points come in eights. With effects a turn takes 300 microseconds, and each orbit goes
 * alone. */
static size_t chaos_chunk(const iso_sweep_job *job)
{
    enum { MOST = 512, LANES = 8 };
    const iso_chaos_options *o = chaos_options(job);
    const double asked = fmax(fmin((double)o->turns, 1000), (double)o->exponent_turns),
                 models = with_model(job, ISO_SHOW_BALL) + with_model(job, ISO_SHOW_POINT);
    const iso_effects acting = job->base ? iso_scene_acting(job->base) : iso_effects_default();
    const bool effects = iso_effects_beyond_level(&acting);
    const double point = (effects ? 300e-6 : 15e-6) * asked * models * ((double)o->starts + 1),
                 fits = fmin(1 / point, MOST);
    if (o->starts > 0 || effects) return fits > 1 ? (size_t)fits : 1;
    return fits > LANES ? (size_t)(fits / LANES) * LANES : LANES;
}

/* --- the list ---------------------------------------------------------------------------------------------------- */

/* Of t and s one is the scene's own clock. */
static bool backends_has(const iso_sweep_job *job, const char *name)
{
    return strcmp(name, job->base->start.model == ISO_BALL ? "t" : "s") != 0;
}

#define CHAOS(m)                                                                                                     \
    m "_verdict " m "_turns " m "_megno " m "_gali2 " m "_per_turn=" m "_exponent_per_turn " m "_exponent_t " m      \
      "_exponent_tau " m "_exponent_s " m "_error_t " m "_error_tau " m "_error_s "
#define FREQUENCY(i)                                                                                                 \
    "f" i "_t=angles" i "_frequency_t f" i "_tau=angles" i "_frequency_tau f" i "_s=angles" i "_frequency_s "
#define ROW(name) name "=rows1_" name " "
#define WORST(name) name "=worst_difference_" name " "
#define AXIS(a) "trace" a "=rotations" a "_half_turn_trace "
#define ERROR(a) "error" a "=rotations" a "_error "

#define VECTORS(T, member) .vectors = offsetof(T, member) + 1

/* Those with columns or words of their own; other studies follow by their names. The words of older sweeps have the
 * columns of then. rotations: the search for other orbits takes long. */
static const iso_sweep_quantity special[] = {
    {"state", &iso_state_study, .chunk = iso_sweep_state_chunk, .add = iso_sweep_add_state,
     VECTORS(iso_state_request, vectors)},
    {"chaos", &iso_chaos_study,
     "verdict share=share_chaotic share_low share_high regular=share_regular undecided=share_undecided "
     "failed=share_failed " CHAOS("ball") CHAOS("point"),
     .chunk = chaos_chunk, .has = chaos_has, .check = chaos_check, .together = chaos_together,
     VECTORS(iso_chaos_request, how.vectors)},
    {"frequencies", &iso_frequencies_study,
     "ratio=frequency_ratio " FREQUENCY("1")
         FREQUENCY("2") "f1_error=angles1_error_t f2_error=angles2_error_t "
                        "verdict=estimate_verdict estimated=solution h F=integral_value",
     .points = 2},
    {"splitting", &iso_splitting_study,
     ROW("x") ROW("m") ROW("error") ROW("x_error") ROW("x_tail") ROW("m_tail") ROW("digits") ROW("multiplier")
         ROW("from_zero") "axis",
     .points = 2},
    {"rotations", &iso_periodic_study, AXIS("1") AXIS("2") AXIS("3") ERROR("1") ERROR("2") ERROR("3"), .points = 64,
     .flag = offsetof(iso_periodic_request, how.rotations_alone) + 1},
    {"backends", &iso_compare_study,
     WORST("omega") WORST("n") WORST("M") WORST("gamma") WORST("t") WORST("tau") WORST("s") "largest", .points = 8,
     .has = backends_has},
    {"error", &iso_error_study, .points = 8},
    {"contact", &iso_contact_study, .chunk = iso_sweep_state_chunk},
    {"section", &iso_section_study, .points = 2, VECTORS(iso_section_request, how.vectors)},
};
enum { SPECIAL = sizeof special / sizeof *special };

bool iso_sweep_quantity_at(int i, iso_sweep_quantity *q)
{
    const iso_study *study;
    if (i < SPECIAL) return *q = special[i], true;
    for (int s = 0; (study = iso_study_at(s)) != NULL; s++) {
        int listed = 0;
        while (listed < SPECIAL && strcmp(special[listed].name, study->name) != 0) listed++;
        if (study->fields && listed == SPECIAL && i-- == SPECIAL)
            return *q = (iso_sweep_quantity){study->name, study, .points = 2}, true;
    }
    return false;
}

const iso_study *iso_sweep_study(const char *quantity)
{
    iso_sweep_quantity q;
    for (int i = 0; iso_sweep_quantity_at(i, &q); i++)
        if (strcmp(q.name, quantity) == 0) return q.study;
    return NULL;
}

/* --- options ----------------------------------------------------------------------------------------------------- */

const char *iso_sweep_option(const char *options, const char *name)
{
    const size_t length = strlen(name);
    const char *value = NULL;
    for (const char *line = options; line && *line; line += strcspn(line, "\n"), line += *line == '\n')
        if (strncmp(line, name, length) == 0 && line[length] == '=') value = line + length + 1;
    return value;
}

/* Those that the plan makes, then those of the request. One thread: a chunk is computed by one. NULL: no memory. */
static char *options_text(const iso_sweep_plan *plan, const iso_sweep_request *request, const iso_study *study)
{
    char number[ISO_NUMBER_SIZE];
    iso_memory memory;
    FILE *to = iso_memory_open(&memory);
    if (!to) return NULL;
    const struct {
        const char *name;
        double value;
    } made[] = {{"threads", 1}, {"turns", plan->turns}, {"t-end", plan->time}};
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) {
        const bool has = iso_study_option_find(study, made[i].name, strlen(made[i].name));
        iso_number_print(number, made[i].value);
        if (!isnan(made[i].value) && has) fprintf(to, "%s=%s\n", made[i].name, number);
    }
    fputs(request->options ? request->options : "", to);
    return iso_memory_close(to, &memory);
}

/* --- columns ------------------------------------------------------------------------------------------------------ */

/* The next of columns with blanks between: its name, and the number of the study that it is. NULL: no more. */
static const char *next_column(const char *columns, char name[ISO_COLUMN_SIZE], char number[ISO_COLUMN_SIZE])
{
    int used = 0;
    if (sscanf(columns, "%63[^= ]%n", name, &used) != 1) return NULL;
    columns += used;
    strcpy(number, name);
    if (*columns == '=' && sscanf(++columns, "%63[^ ]%n", number, &used) == 1) columns += used;
    return columns + strspn(columns, " ");
}

void iso_sweep_add(iso_sweep_job *job, const char *columns)
{
    iso_sweep_column c;
    char name[ISO_COLUMN_SIZE], number[ISO_COLUMN_SIZE];
    while ((columns = next_column(columns, name, number)) && job->count < ISO_SWEEP_NUMBERS) {
        snprintf(c.group, sizeof c.group, "%s", job->quantity.name);
        snprintf(c.name, sizeof c.name, "%s", name);
        bool there = job->quantity.has && !job->quantity.has(job, name);
        for (int i = 0; i < job->count; i++) there = there || strcmp(job->column[i].name, c.name) == 0;
        if (there) continue;
        strcpy(job->number[job->count], number);
        job->column[job->count++] = c;
    }
}

static void add_column(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    (void)field, (void)value;
    iso_sweep_add(data, name);
}

/* --- jobs -------------------------------------------------------------------------------------------------------- */

static bool stop_at_once(void *unused)
{
    (void)unused;
    return false;
}

/* The study is asked for the base, and stopped as soon as it has refused nothing. What it refuses for an effect or for
 * columns it would refuse in every scene of the sweep. */
static iso_status refuse(iso_context *ctx, const iso_sweep_job *job)
{
    iso_context *own = iso_context_create();
    iso_study_result result = {.found = NULL};
    const iso_study_subject subject = {.scene = job->base};
    if (!own) return iso_context_no_memory(ctx, "a sweep");
    iso_context_set_monitor(own, stop_at_once, NULL);
    iso_status status = job->quantity.study->run(own, &subject, job->options, &result);
    const char *about = iso_context_about(own);
    bool all = strcmp(about, "effects") == 0 || strcmp(about, "columns") == 0;
    for (int e = 0; e < ISO_EFFECTS; e++)
        all = all || (job->base->effects.on[e] && strcmp(about, iso_effect_list[e]->name) == 0);
    if ((status == ISO_BAD_INPUT || status == ISO_NOT_MAPPED) && all)
        iso_context_fail(ctx, status, "", "%s", iso_context_message(own));
    else
        status = ISO_OK;
    iso_study_result_free(&result);
    iso_context_free(own);
    return status;
}

iso_status iso_sweep_job_begin(iso_context *ctx, const iso_sweep_plan *plan, const iso_sweep_request *request,
                               iso_sweep_job *job)
{
    iso_sweep_quantity *q = &job->quantity;
    for (int i = 0; !q->name || strcmp(q->name, request->name) != 0; i++)
        if (!iso_sweep_quantity_at(i, q))
            return ISO_FAIL_INPUT(ctx, request->name, "there is no quantity '%s'", request->name);
    job->base = plan->family.base;
    job->text = options_text(plan, request, q->study);
    job->options = malloc(q->study->size);
    if (!job->text || !job->options) return iso_context_no_memory(ctx, "a sweep");
    iso_status status = iso_study_read(ctx, q->study, job->text, job->options);
    if (status == ISO_BAD_ARGUMENT) status = ISO_BAD_INPUT; /* it stands in a file */
    job->begun = true;
    if (q->vectors > 0) *(const char **)(void *)((char *)job->options + q->vectors - 1) = job->vectors;
    if (q->flag > 0) *(bool *)((char *)job->options + q->flag - 1) = true;
    if (status == ISO_OK && job->base) status = refuse(ctx, job);
    if (status != ISO_OK && status != ISO_NO_MEMORY)
        iso_context_fail(ctx, status, q->name, "%s: %s", q->name, iso_context_message(ctx));
    if (status != ISO_OK) return status;
    if (q->add)
        q->add(job);
    else if (q->columns)
        iso_sweep_add(job, q->columns);
    else
        iso_numbers_visit(q->study->fields, NULL, add_column, job);
    return ISO_OK;
}

void iso_sweep_job_end(iso_sweep_job *job)
{
    if (job->begun && job->quantity.study->end) job->quantity.study->end(job->options);
    free(job->options);
    free(job->text);
}

/* --- numbers ----------------------------------------------------------------------------------------------------- */

typedef struct filled {
    const iso_sweep_job *job;
    double *number;
} filled;

static void fill(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    const filled *f = data;
    (void)field;
    for (int i = 0; value->there && i < f->job->count; i++)
        if (strcmp(f->job->number[i], name) == 0) f->number[i] = value->number;
}

static void keep_note(void *words, const char *note)
{
    snprintf(words, ISO_REASON_SIZE, "%s", note);
}

/* The numbers of point i: of the result's struct, or of the last row of its table. note: the last one of the study. */
static iso_status take(iso_context *ctx, const iso_sweep_job *job, const iso_study_result *r, const char *note,
                       const iso_sweep_rows *rows, size_t i)
{
    const iso_sweep_quantity *q = &job->quantity;
    filled f = {job, rows->number + i * (size_t)rows->columns + job->first};
    const size_t length = !r->fields && r->table[0] ? iso_record_rows(r->table[0]) : 0;
    if (r->found && r->fields == q->study->fields)
        iso_numbers_visit(r->fields, r->found, fill, &f);
    else if (length == 0)
        return ISO_FAIL_ARGUMENT(ctx, "", "with these options it has no numbers of one scene");
    for (int n = 0; length > 0 && n < job->count; n++) {
        const int column = iso_record_find(r->table[0], job->number[n]);
        if (column >= 0) f.number[n] = iso_record_const_row(r->table[0], length - 1)[column];
    }
    if (q->check) return q->check(ctx, r->found);
    return r->failed ? ISO_FAIL_NUMERICAL(ctx, "%s", note) : ISO_OK;
}

/* The points of a chunk, followed together. */
static iso_status chaos_find_all(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *b)
{
    iso_chaos **chaos = calloc(b->count + 1, sizeof *chaos);
    iso_status *status = calloc(b->count + 1, sizeof *status);
    iso_status answer = chaos && status
                            ? iso_chaos_run_many(ctx, b->count, b->scene, chaos_options(job), chaos, status)
                            : iso_context_no_memory(ctx, "the orbits of a chunk");
    for (size_t i = 0; i < b->count && answer == ISO_OK; i++) {
        const iso_study_result result = {.found = chaos[i], .fields = iso_chaos_fields};
        if (!b->scene[i]) continue;
        if (status[i] == ISO_OK)
            status[i] = take(ctx, job, &result, "", b->rows, i);
        else
            iso_context_fail(ctx, status[i], "", "%s", chaos[i] ? chaos[i]->words : "it failed");
        answer = iso_sweep_note(ctx, job, b, i, status[i]);
    }
    for (size_t i = 0; chaos && i < b->count; i++) iso_chaos_free(chaos[i]);
    free(chaos);
    free(status);
    return answer;
}

/* A point that has failed in an earlier quantity is still asked for the others, but not if it has no scene. */
iso_status iso_sweep_measure(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *b)
{
    if (job->quantity.together && job->quantity.together(job)) return chaos_find_all(ctx, job, b);
    for (size_t i = 0; i < b->count; i++) {
        char note[ISO_REASON_SIZE] = "it failed";
        iso_study_result result = {.sink = {.note = keep_note, .data = note}};
        const iso_study_subject subject = {.scene = b->scene[i]};
        if (!b->scene[i]) continue;
        iso_status status = job->quantity.study->run(ctx, &subject, job->options, &result);
        if (status == ISO_OK) status = take(ctx, job, &result, note, b->rows, i);
        iso_study_result_free(&result);
        ISO_TRY(iso_sweep_note(ctx, job, b, i, status));
    }
    return ISO_OK;
}

/* --- what the columns are ----------------------------------------------------------------------------------------- */

typedef struct described {
    iso_sweep_quantity quantity;
    const char *name, *number; /* of the column that is sought; NULL: all are */
    iso_column_visitor *visit;
    void *data;
} described;

/* "angles2_error" is as "angles1_error". */
static bool is_like(const char *a, const char *b)
{
    for (; *a && *b; a++, b++)
        if (*a != *b && !(*a >= '0' && *a <= '9' && *b >= '0' && *b <= '9')) return false;
    return *a == *b;
}

static void describe(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    described *d = data;
    char full[ISO_COLUMN_SIZE];
    if (d->number && !is_like(name, d->number)) return;
    snprintf(full, sizeof full, "%s_%s", d->quantity.name, d->name ? d->name : name);
    if (d->number) d->number = "";
    d->visit(d->data, full, field, value);
}

void iso_sweep_columns_visit(iso_column_visitor *visit, void *data)
{
    static const iso_field of_row[] = {
        {.name = "point", .unit = "", .doc = "number of the point, from 0 on"},
        {.name = "status", .unit = "", .doc = "0, or why the point failed: a number of iso_status"},
        {.name = "reason", .unit = "", .doc = "the same in words"},
        ISO_FIELD_END,
    };
    described d = {.visit = visit, .data = data};
    char name[ISO_COLUMN_SIZE], number[ISO_COLUMN_SIZE];
    iso_columns_visit(of_row, NULL, visit, data);
    for (int i = 0; iso_sweep_quantity_at(i, &d.quantity); i++) {
        const iso_sweep_quantity *q = &d.quantity;
        d.name = d.number = NULL;
        if (!q->columns) iso_numbers_visit(q->study->fields, NULL, describe, &d);
        for (const char *c = q->columns; c && (c = next_column(c, name, number));) {
            d.name = name, d.number = number;
            iso_numbers_visit(q->study->fields, NULL, describe, &d);
        }
        for (int c = 0; q->add && c < iso_columns_count(); c++) {
            iso_field field = {.name = iso_column_name(c)};
            field.doc = iso_column_doc(c, &field.unit);
            describe(&d, field.name, &field, NULL);
        }
    }
}

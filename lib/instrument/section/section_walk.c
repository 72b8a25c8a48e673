/* section_walk.c - the orbits of a section: what is walked, the header, rows, the comparison of both models. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/number_impl.h"
#include "base/version.h"
#include "instrument/section/section_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"

/* --- what is walked --------------------------------------------------------------------------------------------- */

iso_walk iso_section_plan(iso_section_walk *w, int model)
{
    const iso_section_options *o = &w->options;
    iso_walk walk = {.ctx = w->ctx, .count = w->result->orbits, .most = o->crossings, .models = 1, .user = w};
    iso_crossings_options *c = &walk.options[0];
    walk.starts = &w->starts;
    *c = iso_crossings_defaults();
    c->backend = (iso_backend)w->model[model];
    c->kind = w->chart ? ISO_SECTION_AXIS : ISO_SECTION_COLUMN;
    c->axis = w->chart ? o->axis : ISO_AXIS_AUTO;
    c->column = o->column;
    c->value = o->value;
    c->tolerance = o->tolerance;
    c->shown = o->shown == ISO_SHOW_START ? (iso_models)w->model[model] : o->shown;
    c->threads = o->threads;
    c->vectors = o->vectors;
    c->deviations = w->areas;
    if (!w->areas || iso_section_has_returns(w)) return walk;
    c->kind = ISO_SECTION_CLOCK;
    c->clock = w->model[model] == ISO_POINT ? ISO_CLOCK_S : ISO_CLOCK_T;
    c->value = iso_walk_turn(w->orbit, c->clock);
    return walk;
}

/* --- the header ------------------------------------------------------------------------------------------------- */

/* Of the columns before the states; the clocks are those of a trajectory. */
const iso_field iso_section_fields[] = {
    {.name = "orbit", .unit = "", .doc = "number of the orbit; 0 is the scene's own"},
    {.name = "crossing", .unit = "", .doc = "number of the crossing, from 1 on"},
    {.name = "t", .unit = "time", .doc = "the ball's time since the start of the orbit"},
    {.name = "tau", .unit = "time", .doc = "the same in the time in which the ball is Hamiltonian"},
    {.name = "s", .unit = "time", .doc = "the same in the point's time"},
    {.name = "l", .unit = "rad", .doc = "angle of the crossing on the section, in (-pi, pi]"},
    {.name = "x", .unit = "", .doc = "the other coordinate, M_a/|M| on the section n_a = 0, in (-1, 1)"},
    ISO_FIELD_END,
};

/* Numbers that are whole, as text. */
static iso_status set_whole(const iso_section_walk *w, iso_record *r, const char *key, uint64_t value)
{
    char text[32];
    snprintf(text, sizeof text, "%" PRIu64, value);
    return iso_record_set(w->ctx, r, key, text);
}

static iso_status describe(const iso_section_walk *w, int table, iso_record *r)
{
    enum { MOST_AT = 500 }; /* a line of a file has room for so many points; of more only the number is written */
    const iso_section_options *o = &w->options;
    const char *model = table ? "point" : iso_models_name((int)w->result->models);
    char text[96];
    ISO_TRY(iso_record_describe(w->ctx, r, model, &w->scene->params, w->orbit));
    ISO_TRY(iso_record_describe_start(w->ctx, r, &w->scene->start));
    if (w->chart)
        snprintf(text, sizeof text, "n%d = 0, increasing; %s", o->axis + 1,
                 w->result->nature.global ? "global" : "not known to be global");
    else
        snprintf(text, sizeof text, "%s = %s, increasing", iso_column_name(o->column), ISO_SHORT(o->value));
    ISO_TRY(iso_record_set(w->ctx, r, "section", text));
    if (w->chart) ISO_TRY(set_whole(w, r, "axis", (size_t)o->axis + 1));
    ISO_TRY(set_whole(w, r, "crossings", o->crossings));
    if (o->starts > 0) ISO_TRY(set_whole(w, r, "starts", o->starts));
    if (o->starts > 0) ISO_TRY(set_whole(w, r, "seed", o->seed));
    snprintf(text, sizeof text, "%zu points l, x", o->at_count);
    if (o->at_count > MOST_AT)
        ISO_TRY(iso_record_set(w->ctx, r, "at", text));
    else if (o->at_count > 0)
        ISO_TRY(iso_record_set_numbers(w->ctx, r, "at", 2 * o->at_count, o->at[0]));
    ISO_TRY(iso_record_set(w->ctx, r, "backend", iso_backend_name((int)w->model[0])));
    ISO_TRY(iso_record_set_numbers(w->ctx, r, "tolerance", 1, &o->tolerance));
    return iso_record_set(w->ctx, r, "isoroll", ISO_VERSION);
}

/* The header of table 0, or of table 1: the crossings as the point finds them. Just before the first row: a scene
 * without crossings opens no file. */
static iso_status begin_table(iso_section_walk *w, int table)
{
    const char *names[ISO_MAX_COLUMNS] = {"orbit", "crossing"};
    iso_record *header = NULL;
    size_t n = 2;
    for (iso_clock c = 0; c < (table || w->clocks ? ISO_CLOCKS : 1); c++) names[n++] = iso_clock_name(c);
    if (table || w->chart) names[n++] = "l", names[n++] = "x";
    for (int c = 0; c < w->count && !table; c++) names[n++] = iso_column_name(w->columns[c]);
    iso_status status = iso_record_create(w->ctx, n, names, &header);
    if (status == ISO_OK) status = describe(w, table, header);
    if (status == ISO_OK && w->sink->header) status = w->sink->header(w->sink->data, table, header);
    if (status == ISO_OK && w->tables)
        w->tables[table] = header;
    else
        iso_record_free(header);
    w->begun[table] = true;
    return status;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

double iso_section_distance(const iso_crossing *a, const iso_crossing *b)
{
    return fmax(fabs(remainder(a->l - b->l, 2 * ISO_PI)), fabs(a->x - b->x));
}

/* Compares a crossing by both models, unless they have parted before. An event has no chart: there the distance is
 * |dt|, divided by the mean time between crossings. */
static void compare(iso_section_walk *w, const iso_walk_stop *stop)
{
    iso_section_member *member = &w->member;
    iso_section_result *r = w->result;
    const iso_crossing *a = stop->crossing[0], *b = stop->crossing[1];
    const double t = a->clock[ISO_CLOCK_T];
    const double distance =
        w->chart ? iso_section_distance(a, b) : fabs(t - b->clock[ISO_CLOCK_T]) / (fabs(t) / (double)stop->number);
    if (member->parted) return;
    if (distance > member->distance) member->distance = distance, member->crossing = stop->number;
    member->parted = distance > ISO_SECTION_PARTED;
    if (!member->parted || (r->parted++ > 0 && stop->number >= r->parted_crossing)) return;
    r->parted_orbit = member->orbit;
    r->parted_crossing = stop->number;
}

/* Adds a finished orbit to the result. */
static void conclude(iso_section_walk *w)
{
    const iso_section_member *member = &w->member;
    iso_section_result *r = w->result;
    r->unequal += member->unequal && !w->walk.stopped;
    if (member->parted || !(member->distance > r->distance)) return;
    r->distance = member->distance;
    r->distance_orbit = member->orbit;
    r->distance_crossing = member->crossing;
}

static iso_status write_row(iso_section_walk *w, int table, const double row[], size_t count)
{
    iso_status status = w->begun[table] ? ISO_OK : begin_table(w, table);
    if (status == ISO_OK && w->tables) status = iso_record_add(w->ctx, w->tables[table], 1, row);
    return status == ISO_OK && w->sink->row ? w->sink->row(w->sink->data, table, row, count) : status;
}

static iso_status write_crossing(iso_section_walk *w, size_t i, const iso_walk_stop *stop)
{
    const iso_crossing *at = stop->crossing[0];
    double row[ISO_MAX_COLUMNS];
    size_t n = 0;
    row[n++] = (double)i;
    row[n++] = (double)stop->number;
    for (int c = 0; c < (w->clocks ? ISO_CLOCKS : 1); c++) row[n++] = at->clock[c];
    if (w->chart) row[n++] = at->l, row[n++] = at->x;
    for (int c = 0; c < w->count; c++) row[n++] = iso_sample_column(stop->sample, w->columns[c]);
    if (!all_finite(row, (int)n)) {
        iso_walk_fail(&w->walk, i, ISO_NUMERICAL, "a number of a crossing does not fit a double");
        return ISO_OK;
    }
    const iso_status status = write_row(w, 0, row, n);
    w->result->rows += status == ISO_OK;
    return status;
}

static iso_status visit(void *user, size_t i, const iso_walk_stop *stop)
{
    iso_section_walk *w = user;
    const iso_crossing *const *by = stop->crossing;
    const bool both = by[0] && by[1];
    if (stop->number == 1) {
        conclude(w);
        w->member = (iso_section_member){.orbit = i};
    }
    if (by[0]) ISO_TRY(write_crossing(w, i, stop));
    if (both) {
        const double *t = by[1]->clock;
        ISO_TRY(
            write_row(w, 1, (double[]){(double)i, (double)stop->number, t[0], t[1], t[2], by[1]->l, by[1]->x}, 7));
        compare(w, stop);
    }
    w->member.unequal = w->member.unequal || (w->models == 2 && !both);
    for (int m = 0; m < w->models; m++) w->result->crossings[w->model[m]] += by[m] != NULL;
    return ISO_OK;
}

static void show_progress(void *user, double part)
{
    const iso_section_walk *w = user;
    if (w->sink->progress) w->sink->progress(w->sink->data, part);
}

iso_status iso_section_walk_all(iso_section_walk *w)
{
    iso_section_result *r = w->result;
    w->walk = iso_section_plan(w, 0);
    w->walk.in_order = true;
    w->walk.samples = w->count > 0;
    w->walk.models = w->models;
    w->walk.options[1] = iso_section_plan(w, 1).options[0];
    w->walk.visit = visit;
    w->walk.progress = show_progress;
    const iso_status status = iso_walk_go(&w->walk);
    conclude(w);
    r->failed = w->walk.failed;
    r->failure = w->walk.failure;
    memcpy(r->words, w->walk.text, sizeof r->words);
    return status;
}

/* section_walk.c - one group of orbits of a section: starts, crossings by one model or two, rows, the header. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/finite_impl.h"
#include "base/number_impl.h"
#include "base/pi_impl.h"
#include "base/vec3_impl.h"
#include "base/version.h"
#include "map/section_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "study/section/section_impl.h"

/* Crossings that are kept in memory: about 50 MB for each model, and as much for samples. */
enum { ROOM = 1 << 19, ROOM_WITH_SAMPLES = 1 << 17, MOST_IN_GROUP = 4096, SLICES = 32 };

/* --- room ------------------------------------------------------------------------------------------------------- */

static void plan(iso_section_walk *w)
{
    const size_t room = w->count > 0 ? ROOM_WITH_SAMPLES : ROOM, most = w->options.crossings;
    const size_t fit = room / most, orbits = w->result->orbits;
    w->group = fit < 1 ? 1 : fit > MOST_IN_GROUP ? MOST_IN_GROUP : fit;
    if (w->group > orbits) w->group = orbits;
    const size_t slice = (most + SLICES - 1) / SLICES, largest_slice = room / SLICES;
    w->slice = slice > largest_slice ? largest_slice : slice;
    w->slices = w->group == 1
                    ? 1
                    : (most + w->slice - 1) / w->slice; /* a single orbit's rows go to the sink slice by slice */
}

iso_status iso_section_make_room(iso_section_walk *w)
{
    plan(w);
    const size_t cells = w->group * w->slice * w->slices;
    bool room = true;
    w->start = calloc(w->group, sizeof *w->start);
    w->batch = calloc(w->group, sizeof *w->batch);
    w->member = calloc(w->group, sizeof *w->member);
    w->wanted = calloc(w->group, sizeof *w->wanted);
    w->sample = w->count > 0 ? malloc(cells * sizeof *w->sample) : NULL;
    for (int m = 0; m < w->models; m++) {
        w->crossing[m] = malloc(cells * sizeof *w->crossing[m]);
        w->done[m] = calloc(w->group * w->slices, sizeof *w->done[m]);
        w->status[m] = calloc(w->group, sizeof *w->status[m]);
        room = room && w->crossing[m] && w->done[m] && w->status[m];
    }
    if (room && w->start && w->batch && w->member && w->wanted && (w->sample || w->count == 0)) return ISO_OK;
    return iso_context_no_memory(w->ctx, "the crossings of %zu orbits", w->group);
}

void iso_section_free_room(iso_section_walk *w)
{
    iso_section_close_group(w);
    free(w->start);
    free(w->batch);
    free(w->member);
    free(w->wanted);
    free(w->sample);
    for (int m = 0; m < w->models; m++) {
        free(w->crossing[m]);
        free(w->done[m]);
        free(w->status[m]);
    }
}

/* --- starts ----------------------------------------------------------------------------------------------------- */

void iso_section_state_level(const iso_orbit *orbit, iso_effects *effects)
{
    const iso_effects found = iso_orbit_effects(orbit);
    const double c = iso_effects_level(&found);
    if (iso_effects_have_level(&found) && isnormal(c)) iso_effects_set_level(effects, true, c);
}

/* The chart of start i, counted from 0: the first `starts` are spread, then come the given ones. */
static void chart_of_start(const iso_section_spread *spread, size_t starts, const double (*at)[2], size_t i,
                           double *l, double *x)
{
    if (i < starts) {
        iso_section_spread_point(spread, i, l, x);
    } else {
        *l = at[i - starts][0];
        *x = at[i - starts][1];
    }
}

static iso_start start_of(const iso_section_walk *w, size_t orbit)
{
    const iso_section_options *o = &w->options;
    double l, x;
    if (orbit == 0) return w->scene->start;
    chart_of_start(&w->spread, o->starts, o->at, orbit - 1, &l, &x);
    return iso_section_start(w->orbit, w->scene->start.model, o->axis, l, x);
}

/* About the time in which n or gamma turns once, in the clock of the model. */
static double turn_of(const iso_section_walk *w, int model)
{
    iso_sample start;
    const iso_units *units = iso_orbit_units(w->orbit);
    const bool point = w->model[model] == ISO_POINT, pulled = iso_effects_pull(&w->effects);
    if (iso_orbit_at(w->orbit, 0, &start) != ISO_OK) return NAN;
    const double unit = point ? iso_unit(units, iso_system_point.fast_dimension) : units->w;
    const double speed = norm(point ? start.point : start.ball);
    return 2 * ISO_PI / (fmax(speed, pulled ? unit : 0) * (point ? 1 : fabs(w->scene->params.k)));
}

static iso_crossings_options options_of(const iso_section_walk *w, int model)
{
    const iso_section_options *o = &w->options;
    iso_crossings_options c = iso_crossings_defaults();
    c.backend = (iso_backend)w->model[model];
    c.kind = w->chart ? ISO_SECTION_AXIS : ISO_SECTION_COLUMN;
    c.axis = w->chart ? o->axis : ISO_AXIS_AUTO;
    c.column = o->column;
    c.value = o->value;
    c.tolerance = o->tolerance;
    c.shown = o->shown == ISO_SHOW_START ? (iso_models)w->model[model] : o->shown;
    c.threads = o->threads;
    c.vectors = o->vectors;
    c.deviations = w->areas;
    if (!w->areas || iso_section_has_returns(w)) return c;
    c.kind = ISO_SECTION_CLOCK;
    c.clock = w->model[model] == ISO_POINT ? ISO_CLOCK_S : ISO_CLOCK_T;
    c.value = turn_of(w, model);
    return c;
}

iso_status iso_section_open_group(iso_section_walk *w)
{
    const size_t left = w->result->orbits - w->first;
    iso_status status = ISO_OK;
    w->members = left < w->group ? left : w->group;
    for (size_t i = 0; i < w->members; i++) {
        w->start[i] = start_of(w, w->first + i);
        w->batch[i] = (iso_batch_orbit){&w->scene->params, &w->start[i], &w->effects};
        w->member[i] = (iso_section_member){.failed = false};
    }
    for (int m = 0; m < w->models && status == ISO_OK; m++) {
        const iso_crossings_options o = options_of(w, m);
        status = iso_crossings_create(w->ctx, w->batch, w->members, &o, &w->crossings[m]);
    }
    return status;
}

void iso_section_close_group(iso_section_walk *w)
{
    for (int m = 0; m < w->models; m++) {
        iso_crossings_free(w->crossings[m]);
        w->crossings[m] = NULL;
    }
}

/* --- failures --------------------------------------------------------------------------------------------------- */

/* Counts an orbit that has failed, once. Keeps the words of the first. */
static void note_failure(iso_section_walk *w, size_t i, iso_status status, const char *words)
{
    iso_section_result *r = w->result;
    if (w->member[i].failed) return;
    w->member[i].failed = true;
    if (r->failed++ > 0) return;
    r->failure = status;
    snprintf(r->words, sizeof r->words, "orbit %zu: %s", w->first + i, words);
}

static void note_failures(iso_section_walk *w, int model)
{
    const iso_status *status = w->status[model];
    for (size_t i = 0; i < w->members; i++)
        if (status[i] != ISO_OK) note_failure(w, i, status[i], iso_crossings_why(w->crossings[model], i));
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

double iso_section_distance(const iso_crossing *a, const iso_crossing *b)
{
    return fmax(fabs(remainder(a->l - b->l, 2 * ISO_PI)), fabs(a->x - b->x));
}

/* The distance of the two models. An event has no chart: there it is |dt|, divided by the mean time between
 * crossings. */
static double distance_of(const iso_section_walk *w, const iso_crossing *a, const iso_crossing *b, size_t crossing)
{
    if (w->chart) return iso_section_distance(a, b);
    const double t = a->clock[ISO_CLOCK_T];
    return fabs(t - b->clock[ISO_CLOCK_T]) / (fabs(t) / (double)crossing);
}

/* Compares a crossing by both models, unless they have parted before. */
static void compare(iso_section_walk *w, size_t i, const iso_crossing *a, const iso_crossing *b, size_t crossing)
{
    iso_section_member *member = &w->member[i];
    iso_section_result *r = w->result;
    const double distance = distance_of(w, a, b, crossing);
    if (member->parted) return;
    if (distance > member->distance) {
        member->distance = distance;
        member->crossing = crossing;
    }
    member->parted = distance > ISO_SECTION_PARTED;
    if (!member->parted) return;
    if (r->parted++ > 0 && crossing >= r->parted_crossing) return;
    r->parted_orbit = w->first + i;
    r->parted_crossing = crossing;
}

/* Adds a finished group to the result. */
static void conclude(iso_section_walk *w)
{
    iso_section_result *r = w->result;
    for (size_t i = 0; i < w->members && w->models == 2; i++) {
        const iso_section_member *member = &w->member[i];
        r->unequal += member->found[0] != member->found[1];
        if (member->parted || !(member->distance > r->distance)) continue;
        r->distance = member->distance;
        r->distance_orbit = w->first + i;
        r->distance_crossing = member->crossing;
    }
}

static iso_status give_row(iso_section_walk *w, size_t i, const iso_crossing *at, const iso_sample *sample)
{
    double row[ISO_MAX_COLUMNS];
    size_t n = 0;
    row[n++] = (double)(w->first + i);
    row[n++] = (double)(w->member[i].found[0] + 1);
    for (int c = 0; c < (w->clocks ? ISO_CLOCKS : 1); c++) row[n++] = at->clock[c];
    if (w->chart) row[n++] = at->l;
    if (w->chart) row[n++] = at->x;
    for (int c = 0; c < w->count; c++) row[n++] = iso_sample_column(sample, w->columns[c]);
    if (!all_finite(row, (int)n)) {
        note_failure(w, i, ISO_NUMERICAL, "a number of a crossing does not fit a double");
        return ISO_OK;
    }
    iso_status status = w->begun ? ISO_OK : iso_section_give_header(w);
    if (status == ISO_OK && w->sink->record) status = iso_record_add(w->ctx, *w->sink->record, 1, row);
    if (status == ISO_OK && w->sink->row) status = w->sink->row(w->sink->data, row, n);
    w->result->rows += status == ISO_OK;
    return status;
}

/* The rows of one orbit in one slice that is kept. */
static iso_status give_cell(iso_section_walk *w, size_t slice, size_t i)
{
    const size_t cell = slice * w->group + i,
                 *done[2] = {&w->done[0][cell], w->models == 2 ? &w->done[1][cell] : NULL};
    iso_section_member *member = &w->member[i];
    iso_status status = ISO_OK;
    for (size_t j = 0; status == ISO_OK && (j < *done[0] || (done[1] && j < *done[1])); j++) {
        const size_t at = cell * w->slice + j;
        const bool both = done[1] && j < *done[0] && j < *done[1];
        if (j < *done[0]) status = give_row(w, i, &w->crossing[0][at], w->sample ? &w->sample[at] : NULL);
        if (status == ISO_OK && both && w->sink->pair)
            status = w->sink->pair(w->sink->data, w->first + i, &w->crossing[0][at], &w->crossing[1][at]);
        if (both) compare(w, i, &w->crossing[0][at], &w->crossing[1][at], member->found[0] + 1);
        for (int m = 0; m < w->models; m++) {
            member->found[m] += j < *done[m];
            w->result->crossings[w->model[m]] += j < *done[m];
        }
    }
    return status;
}

static iso_status give_rows(iso_section_walk *w, size_t slices)
{
    iso_status status = ISO_OK;
    for (size_t i = 0; i < w->members; i++)
        for (size_t k = 0; status == ISO_OK && k < slices; k++) status = give_cell(w, k, i);
    return status;
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

/* An orbit that the first model has found to stay away from the section. The second model would wait as long, and would
 * give nothing to compare. */
static bool stays_away(const iso_section_walk *w, size_t cell, size_t i)
{
    return w->status[0][i] == ISO_BAD_INPUT && w->done[0][cell + i] == 0;
}

/* Finds the next `each` crossings of all members. iso_crossings_go stores them `each` apart; rows want them w->slice
 * apart. */
static iso_status find_slice(iso_section_walk *w, size_t kept, size_t each)
{
    iso_status status = ISO_OK;
    for (int m = 0; m < w->models; m++) memset(w->done[m] + kept * w->group, 0, w->group * sizeof *w->done[m]);
    for (int m = 0; m < w->models && status == ISO_OK; m++) {
        const size_t cell = kept * w->group;
        iso_sample *sample = m == 0 && w->sample ? w->sample + cell * w->slice : NULL;
        iso_crossing *crossing = w->crossing[m] + cell * w->slice;
        for (size_t i = 0; i < w->members; i++) w->wanted[i] = m == 0 || !stays_away(w, cell, i);
        status =
            iso_crossings_go(w->crossings[m], w->wanted, each, crossing, sample, w->done[m] + cell, w->status[m]);
        for (size_t i = w->members; i-- > 0 && each < w->slice;) { /* the last slice may be shorter */
            memmove(crossing + i * w->slice, crossing + i * each, each * sizeof *crossing);
            if (sample) memmove(sample + i * w->slice, sample + i * each, each * sizeof *sample);
        }
        if (status == ISO_STOPPED || status == ISO_NO_MEMORY) break;
        if (status != ISO_OK) note_failures(w, m);
        status = ISO_OK;
    }
    return status;
}

static void show_progress(const iso_section_walk *w, size_t found)
{
    const double all = (double)w->result->orbits;
    const double part = (double)found / (double)w->options.crossings;
    if (w->sink->progress) w->sink->progress(w->sink->data, ((double)w->first + part * (double)w->members) / all);
}

iso_status iso_section_walk_group(iso_section_walk *w)
{
    const size_t most = w->options.crossings;
    iso_status status = ISO_OK, given = ISO_OK;
    for (size_t found = 0, kept = 0; status == ISO_OK && given == ISO_OK && found < most;) {
        const size_t each = most - found < w->slice ? most - found : w->slice;
        status = find_slice(w, kept++, each);
        found += each;
        show_progress(w, found);
        if (status == ISO_OK && found < most && w->slices > 1) continue; /* kept until all are there */
        if (status == ISO_OK || status == ISO_STOPPED) given = give_rows(w, kept);
        kept = 0;
    }
    if (status == ISO_OK && given == ISO_OK) conclude(w);
    return given == ISO_OK ? status : given;
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

static iso_status create_header(const iso_section_walk *w, iso_record **header)
{
    const char *names[ISO_MAX_COLUMNS] = {"orbit", "crossing"};
    size_t n = 2;
    for (iso_clock c = 0; c < (w->clocks ? ISO_CLOCKS : 1); c++) names[n++] = iso_clock_name(c);
    if (w->chart) names[n++] = "l";
    if (w->chart) names[n++] = "x";
    for (int c = 0; c < w->count; c++) names[n++] = iso_column_name(w->columns[c]);
    ISO_TRY(iso_record_create(w->ctx, n, names, header));
    return iso_record_describe(w->ctx, *header, iso_models_name((int)w->result->models), &w->scene->params, w->orbit);
}

/* Numbers that are whole, as text. */
static iso_status set_whole(const iso_section_walk *w, iso_record *r, const char *key, uint64_t value)
{
    char text[32];
    snprintf(text, sizeof text, "%" PRIu64, value);
    return iso_record_set(w->ctx, r, key, text);
}

static iso_status set_section(const iso_section_walk *w, iso_record *r)
{
    const iso_section_options *o = &w->options;
    char text[96];
    if (w->chart)
        snprintf(text, sizeof text, "n%d = 0, increasing; %s", o->axis + 1,
                 w->result->nature.global ? "global" : "not known to be global");
    else
        snprintf(text, sizeof text, "%s = %s, increasing", iso_column_name(o->column), ISO_SHORT(o->value));
    const iso_status status = iso_record_set(w->ctx, r, "section", text);
    return status == ISO_OK && w->chart ? set_whole(w, r, "axis", (size_t)o->axis + 1) : status;
}

/* A line of a file has room for MOST points; of more points only the number is written. */
static iso_status set_at(const iso_section_walk *w, iso_record *r)
{
    enum { MOST = 500 };
    const iso_section_options *o = &w->options;
    char text[64];
    if (o->at_count <= MOST) return iso_record_set_numbers(w->ctx, r, "at", 2 * o->at_count, o->at[0]);
    snprintf(text, sizeof text, "%zu points l, x", o->at_count);
    return iso_record_set(w->ctx, r, "at", text);
}

static iso_status describe(const iso_section_walk *w, iso_record *r)
{
    const iso_section_options *o = &w->options;
    ISO_TRY(iso_record_describe_start(w->ctx, r, &w->scene->start));
    ISO_TRY(set_section(w, r));
    ISO_TRY(set_whole(w, r, "crossings", o->crossings));
    if (o->starts > 0) ISO_TRY(set_whole(w, r, "starts", o->starts));
    if (o->starts > 0) ISO_TRY(set_whole(w, r, "seed", o->seed));
    if (o->at_count > 0) ISO_TRY(set_at(w, r));
    ISO_TRY(iso_record_set(w->ctx, r, "backend", iso_backend_name((int)w->model[0])));
    ISO_TRY(iso_record_set_numbers(w->ctx, r, "tolerance", 1, &o->tolerance));
    return iso_record_set(w->ctx, r, "isoroll", ISO_VERSION);
}

iso_status iso_section_give_header(iso_section_walk *w)
{
    iso_record *header = NULL;
    iso_status status = create_header(w, &header);
    if (status == ISO_OK) status = describe(w, header);
    if (status == ISO_OK && w->sink->header) status = w->sink->header(w->sink->data, header);
    if (status == ISO_OK && w->sink->record)
        *w->sink->record = header;
    else
        iso_record_free(header);
    w->begun = true;
    return status;
}

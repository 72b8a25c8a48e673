/* section.c - sections whose rows are kept: those of the file, and the same crossings as the point finds them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/nearest.h"
#include "foreign/foreign_impl.h"
#include "study/section/section.h"

typedef struct keeper {
    iso_context *ctx;
    iso_record *record;
    iso_record *point; /* NULL: not wanted, or no pair so far */
    bool wants_point;
    size_t orbit, crossing; /* of the last pair */
    notes notes;
} keeper;

static iso_status keep_header(void *data, const iso_record *header)
{
    keeper *k = data;
    return iso_record_create_like(k->ctx, header, 0, NULL, &k->record);
}

static iso_status keep_row(void *data, const double row[], size_t count)
{
    keeper *k = data;
    (void)count;
    return iso_foreign_record_append(k->ctx, k->record, 1, row);
}

static iso_status open_point(keeper *k)
{
    static const char *const names[] = {"orbit", "crossing", "t", "tau", "s", "l", "x"};
    iso_status status = iso_record_create(k->ctx, sizeof names / sizeof *names, names, &k->point);
    const char *key, *value;
    for (size_t i = 0; status == ISO_OK && iso_record_line(k->record, i, &key, &value); i++)
        status = iso_record_set(k->ctx, k->point, key, strcmp(key, "model") == 0 ? "point" : value);
    return status;
}

/* Called after the ball's row; a pair of the same orbit is its next crossing. */
static iso_status keep_pair(void *data, size_t orbit, const iso_crossing *ball, const iso_crossing *point)
{
    keeper *k = data;
    (void)ball;
    if (!k->wants_point) return ISO_OK;
    const iso_status status = k->point ? ISO_OK : open_point(k);
    if (status != ISO_OK) return status;
    k->crossing = orbit == k->orbit ? k->crossing + 1 : 1;
    k->orbit = orbit;
    const double row[] = {
        (double)orbit, (double)k->crossing, point->clock[0], point->clock[1], point->clock[2], point->l, point->x};
    return iso_foreign_record_append(k->ctx, k->point, 1, row);
}

static void keep_note(void *data, const char *words)
{
    keeper *k = data;
    iso_notes_add(&k->notes, words);
}

static void tell(const iso_section_result *r, notes *n)
{
    char words[640];
    if (r->failed > 0) {
        snprintf(words, sizeof words, "%zu of %zu orbits did not get to the end; %s", r->failed, r->orbits, r->words);
        iso_notes_add(n, words);
    }
}

static iso_status choose(iso_context *ctx, iso_section_options *o, const char *event, double value,
                         const char *models, const char *shown)
{
    iso_status status = iso_foreign_shown(ctx, "models", models, &o->models);
    if (status == ISO_OK) status = iso_foreign_shown(ctx, "as", shown, &o->shown);
    if (status != ISO_OK || !event) return status;
    o->column = iso_column_find(event);
    o->value = value;
    if (o->column >= ISO_CLOCKS) return ISO_OK;
    char suggested[ISO_SUGGEST_SIZE];
    if (o->column < 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "event", "there is no column '%s'; %s", event,
                                iso_suggest_word(suggested, event, iso_column_name));
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "event", "the clock '%s' passes each value only once", event);
}

iso_status iso_foreign_section(iso_context *ctx, const iso_foreign_scene *scene, size_t crossings, size_t starts,
                               uint64_t seed, const double at[], size_t at_count, int axis, const char *event,
                               double value, const char *models, const char *shown, double tolerance, int threads,
                               iso_record **record, iso_record **point, char text[], size_t room)
{
    keeper k = {.ctx = ctx, .wants_point = point != NULL, .orbit = SIZE_MAX, .notes = iso_notes_begin(text, room)};
    const iso_section_sink sink = {keep_header, keep_row, keep_pair, keep_note, NULL, &k};
    iso_section_options o = iso_section_defaults();
    iso_section_result r = {.rows = 0};
    o.crossings = crossings;
    o.starts = starts;
    o.seed = seed;
    o.at = (const double(*)[2])at;
    o.at_count = at_count;
    o.axis = axis;
    o.threads = threads;
    iso_status status = choose(ctx, &o, event, value, models, shown);
    if (status == ISO_OK) status = iso_foreign_count(ctx, "crossings", crossings);
    if (status == ISO_OK) status = iso_foreign_count(ctx, "starts", starts);
    if (status == ISO_OK) status = iso_foreign_tolerance(ctx, tolerance, &o.tolerance);
    const bool called = status == ISO_OK;
    if (called) status = iso_section_run(ctx, &scene->scene, &o, &sink, &r);
    if (called && !k.record) status = iso_foreign_blame(ctx, scene, status);
    if (status != ISO_OK && r.rows == 0) {
        iso_record_free(k.record);
        iso_record_free(k.point);
        k.record = k.point = NULL;
    }
    tell(&r, &k.notes);
    *record = k.record;
    if (point) *point = k.point;
    return status;
}

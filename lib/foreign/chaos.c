/* chaos.c - the verdicts on the orbits of a scene, as rows of a record. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "foreign/foreign_impl.h"
#include "study/chaos/chaos.h"

/* --- the lines -------------------------------------------------------------------------------------------------- */

static iso_status put_number(iso_context *ctx, iso_record *r, const char *key, double x, iso_status status)
{
    return status == ISO_OK ? iso_record_set_numbers(ctx, r, key, 1, &x) : status;
}

static iso_status put_share(iso_context *ctx, const iso_chaos_fraction *s, iso_record *r, iso_status status)
{
    if (s->asked == 0) return status;
    status = put_number(ctx, r, "asked", (double)s->asked, status);
    status = put_number(ctx, r, "count", (double)s->count, status);
    status = put_number(ctx, r, "chaotic", (double)s->chaotic, status);
    status = put_number(ctx, r, "regular", (double)s->regular, status);
    status = put_number(ctx, r, "undecided", (double)s->undecided, status);
    status = put_number(ctx, r, "failed", (double)s->failed, status);
    status = put_number(ctx, r, "share", s->share, status);
    status = put_number(ctx, r, "low", s->low, status);
    return put_number(ctx, r, "high", s->high, status);
}

static iso_status put_lines(iso_context *ctx, const iso_scene *scene, const iso_chaos *c, iso_record *r)
{
    char words[160];
    iso_status status =
        iso_record_set(ctx, r, "model", c->with[0] && c->with[1] ? "both" : iso_model_kind_name(c->with[1]));
    status = put_number(ctx, r, "k", scene->params.k, status);
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, r, "J", 3, scene->params.J);
    if (c->axis >= 0)
        snprintf(words, sizeof words, "n%d = 0, increasing; a turn is a return", c->axis + 1);
    else
        snprintf(words, sizeof words, "none; a turn is %.17g in t", c->turn);
    if (status == ISO_OK) status = iso_record_set(ctx, r, "section", words);
    if (c->plane >= 0) status = put_number(ctx, r, "plane", c->plane + 1, status);
    if (status == ISO_OK && c->integral) status = iso_record_set(ctx, r, "integral", c->integral->name);
    if (status == ISO_OK && c->failure != ISO_OK) status = iso_record_set(ctx, r, "failure", c->words);
    return put_share(ctx, &c->share, r, status);
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

static iso_status put_all(iso_context *ctx, const iso_scene *scene, const iso_chaos *c, iso_record **record)
{
    iso_field fields[ISO_MOST_FIELDS];
    iso_chaos_columns(c, fields);
    iso_status status = iso_columns_create(ctx, fields, record);
    if (status == ISO_OK) status = put_lines(ctx, scene, c, *record);
    if (status == ISO_OK) status = iso_columns_append(ctx, fields, &c->own, *record);
    for (size_t i = 0; status == ISO_OK && i < c->starts; i++)
        status = iso_columns_append(ctx, fields, &c->start[i], *record);
    return status;
}

iso_status iso_foreign_chaos(iso_context *ctx, const iso_foreign_scene *scene, long turns, long exponent_turns,
                             size_t starts, uint64_t seed, const double at[], size_t at_count, int axis,
                             const char *models, double tolerance, int threads, iso_record **record,
                             iso_record *trace[2])
{
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c = NULL;
    *record = NULL;
    if (trace) trace[0] = trace[1] = NULL;
    o.turns = turns;
    o.exponent_turns = exponent_turns;
    o.starts = starts;
    o.seed = seed;
    o.at = (const double(*)[2])at;
    o.at_count = at_count;
    o.axis = axis;
    o.threads = threads;
    iso_status status = iso_foreign_shown(ctx, "models", models, &o.models);
    if (status == ISO_OK) status = iso_foreign_count(ctx, "starts", starts);
    if (status == ISO_OK) status = iso_foreign_tolerance(ctx, tolerance, &o.tolerance);
    if (status == ISO_OK) status = iso_foreign_blame(ctx, scene, iso_chaos_run(ctx, &scene->scene, &o, &c));
    if (status == ISO_OK) status = put_all(ctx, &scene->scene, c, record);
    for (int m = 0; status == ISO_OK && trace && m < 2; m++) trace[m] = c->trace[m], c->trace[m] = NULL;
    if (status != ISO_OK) iso_record_free(*record), *record = NULL;
    iso_chaos_free(c);
    return status;
}

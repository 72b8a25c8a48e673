/* chaos.c - the verdicts on the orbits of a scene, as rows of a record. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "foreign/foreign_impl.h"
#include "study/chaos/chaos.h"

enum { COMMON = 5, TOLD = 15, MOST = COMMON + 2 * TOLD, NAME = 32 };

static const char *const common[COMMON] = {"orbit", "l", "x", "verdict", "disagree"};
static const char *const told[TOLD] = {"verdict",    "status",       "turns",      "per_turn", "per_turn_error",
                                       "exponent_t", "exponent_tau", "exponent_s", "error_t",  "error_tau",
                                       "error_s",    "megno",        "gali2",      "digits",   "exponent_turns"};

static iso_status create(iso_context *ctx, const iso_chaos *c, iso_record **record)
{
    char text[MOST][NAME];
    const char *names[MOST];
    size_t count = 0;
    for (int i = 0; i < COMMON; i++) snprintf(text[count++], NAME, "%s", common[i]);
    for (int m = 0; m < 2; m++)
        for (int i = 0; c->with[m] && i < TOLD; i++)
            snprintf(text[count++], NAME, "%s_%s", iso_model_kind_name(m), told[i]);
    for (size_t i = 0; i < count; i++) names[i] = text[i];
    return iso_record_create(ctx, count, names, record);
}

static double *put_told(const iso_indication *i, iso_status status, double *to)
{
    *to++ = (double)i->verdict;
    *to++ = (double)status;
    *to++ = (double)i->turns;
    *to++ = i->per_turn;
    *to++ = i->per_turn_error;
    for (int c = 0; c < ISO_CLOCKS; c++) *to++ = i->exponent[c];
    for (int c = 0; c < ISO_CLOCKS; c++) *to++ = i->error[c];
    *to++ = i->megno;
    *to++ = i->gali2;
    *to++ = i->digits;
    *to++ = (double)i->exponent_turns;
    return to;
}

static iso_status put_orbit(iso_context *ctx, const iso_chaos *c, const iso_chaos_orbit *o, size_t number,
                            iso_record *record)
{
    double row[MOST], *to = row;
    *to++ = (double)number;
    *to++ = o->l;
    *to++ = o->x;
    *to++ = (double)o->verdict;
    *to++ = o->disagree;
    for (int m = 0; m < 2; m++)
        if (c->with[m]) to = put_told(&o->told[m], o->status[m], to);
    return iso_foreign_record_append(ctx, record, 1, row);
}

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
    iso_status status = create(ctx, c, record);
    if (status == ISO_OK) status = put_lines(ctx, scene, c, *record);
    if (status == ISO_OK) status = put_orbit(ctx, c, &c->own, 0, *record);
    for (size_t i = 0; status == ISO_OK && i < c->starts; i++)
        status = put_orbit(ctx, c, &c->start[i], i + 1, *record);
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

/* sweep_chaos.c - the quantity chaos: the verdict on an orbit, its exponents and indicators; with starts, the chaotic
 * share of the section. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instrument/chaos/chaos_impl.h"
#include "orbit/orbit_impl.h"
#include "study/fields_impl.h"
#include "sweep/sweep_impl.h"

enum { STARTS, SEED, MODEL, EXPONENT_TURNS };

static bool with_model(const iso_sweep_job *job, int model)
{
    const double asked = job->setting[MODEL];
    return isnan(asked) || asked == ISO_SHOW_BOTH || asked == model;
}

static bool chaos_has(const iso_sweep_job *job, const char *name)
{
    if (strncmp(name, "ball_", 5) == 0) return with_model(job, ISO_BALL);
    if (strncmp(name, "point_", 6) == 0) return with_model(job, ISO_POINT);
    return strcmp(name, "verdict") == 0 || job->setting[STARTS] > 0;
}

#define OF_MODEL(m)                                                                                                  \
    m "_verdict " m "_turns " m "_megno " m "_gali2 " m "_per_turn " m "_exponent_t " m "_exponent_tau " m           \
      "_exponent_s " m "_error_t " m "_error_tau " m "_error_s"

/* status: of the study. Errors: that, or why the scene's own orbit was not followed. */
static iso_status take(iso_context *ctx, const iso_sweep_job *job, const iso_chaos *c, iso_status status,
                       double number[])
{
    iso_field fields[ISO_MOST_FIELDS];
    if (status != ISO_OK) return iso_context_fail(ctx, status, "", "%s", c ? c->words : "it failed");
    iso_chaos_columns(c, fields);
    iso_sweep_fill(job, fields, &c->own, number);
    if (job->setting[STARTS] > 0) iso_sweep_fill(job, iso_chaos_fraction_fields, &c->share, number);
    if (c->own.status[ISO_BALL] == ISO_OK && c->own.status[ISO_POINT] == ISO_OK) return ISO_OK;
    return iso_context_fail(ctx, c->failure, "", "%s", c->words);
}

static iso_chaos_options options_of(const iso_sweep_job *job)
{
    iso_chaos_options o = iso_chaos_defaults();
    if (!isnan(job->turns)) o.turns = (long)job->turns;
    o.exponent_turns = (long)job->setting[EXPONENT_TURNS];
    o.starts = (size_t)job->setting[STARTS];
    o.seed = (uint64_t)job->setting[SEED];
    if (!isnan(job->setting[MODEL])) o.models = (iso_models)job->setting[MODEL];
    o.threads = 1;
    o.vectors = job->vectors;
    return o;
}

static iso_status chaos_find(iso_context *ctx, const iso_sweep_job *job, const iso_scene *scene, double number[])
{
    const iso_chaos_options o = options_of(job);
    iso_chaos *c = NULL;
    iso_status status = iso_chaos_run(ctx, scene, &o, &c);
    if (status == ISO_OK) status = take(ctx, job, c, status, number);
    iso_chaos_free(c);
    return status;
}

/* The points of a chunk, followed together. */
static iso_status chaos_find_all(iso_context *ctx, const iso_sweep_job *job, iso_sweep_batch *b)
{
    const iso_chaos_options o = options_of(job);
    iso_chaos **chaos = calloc(b->count + 1, sizeof *chaos);
    iso_status *status = calloc(b->count + 1, sizeof *status);
    iso_status answer = chaos && status ? iso_chaos_run_many(ctx, b->count, b->scene, &o, chaos, status)
                                        : iso_context_no_memory(ctx, "the orbits of a chunk");
    for (size_t i = 0; i < b->count && answer == ISO_OK; i++)
        if (b->scene[i])
            answer =
                iso_sweep_note(ctx, job, b, i, take(ctx, job, chaos[i], status[i], iso_sweep_numbers(job, b, i)));
    for (size_t i = 0; chaos && i < b->count; i++) iso_chaos_free(chaos[i]);
    free(chaos);
    free(status);
    return answer;
}

/* Starts of one section already fill the lanes. */
static bool chaos_together(const iso_sweep_job *job)
{
    return job->setting[STARTS] == 0;
}

/* A turn takes about 15 microseconds by each model, and most orbits have a verdict after 1000. Orbits are followed in
 * the lanes of vectors, so points come in eights. With effects a turn takes 300 microseconds, and each orbit goes
 * alone. */
static size_t chaos_chunk(const iso_sweep_job *job)
{
    enum { MOST = 512, LANES = 8 };
    const double asked = fmax(isnan(job->turns) ? 1000 : fmin(job->turns, 1000), job->setting[EXPONENT_TURNS]),
                 models = with_model(job, 0) + with_model(job, 1);
    const iso_effects acting = job->base ? iso_scene_acting(job->base) : iso_effects_default();
    const bool effects = iso_effects_beyond_level(&acting);
    const double point = (effects ? 300e-6 : 15e-6) * asked * models * (job->setting[STARTS] + 1),
                 fits = fmin(1 / point, MOST);
    if (job->setting[STARTS] > 0 || effects) return fits > 1 ? (size_t)fits : 1;
    return fits > LANES ? (size_t)(fits / LANES) * LANES : LANES;
}

static const iso_sweep_setting chaos_settings[] = {
    [STARTS] = {.name = "starts", .usual = 0, .least = 0, .most = 1e9, .whole = true},
    [SEED] = {.name = "seed", .usual = 0, .least = 0, .most = 0x1p53, .whole = true},
    [MODEL] = {.name = "model", .word = iso_sweep_models, .usual = NAN},
    [EXPONENT_TURNS] = {.name = "exponent_turns", .usual = 0, .least = 0, .most = 1e9, .whole = true},
    {.name = NULL},
};

const iso_sweep_computation iso_sweep_chaos = {
    .quantity = {.name = "chaos",
                 .doc = "verdict, exponents and indicators; with starts, the chaotic share of the section",
                 .settings = chaos_settings,
                 .turns = true},
    .fields = {iso_chaos_orbit_fields, iso_chaos_fraction_fields},
    .names = "verdict share share_low share_high regular undecided failed " OF_MODEL("ball") " " OF_MODEL("point"),
    .has = chaos_has,
    .chunk = chaos_chunk,
    .find = chaos_find,
    .find_all = chaos_find_all,
    .together = chaos_together,
};

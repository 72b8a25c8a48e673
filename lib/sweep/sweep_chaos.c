/* sweep_chaos.c - the quantity chaos: the verdict on an orbit, its exponents and indicators; with starts, the chaotic
 * share of the section. */
#include <math.h>
#include <stdlib.h>

#include "model/model_impl.h"
#include "study/chaos/chaos.h"
#include "sweep/sweep_impl.h"

enum { STARTS, SEED, MODEL, EXPONENT_TURNS, OF_MODEL = 11 };

static const char *model_word(int i)
{
    static const char *const words[] = {"ball", "point", "both"};
    return i < 3 ? words[i] : NULL;
}

static bool with_model(const iso_sweep_job *ask, int model)
{
    const double asked = ask->setting[MODEL];
    return isnan(asked) || asked == ISO_SHOW_BOTH || asked == model;
}

static int chaos_columns(const iso_sweep_job *ask, const char *name[])
{
    static const char *const share[] = {"share", "share_low", "share_high", "regular", "undecided", "failed"};
    static const char *const models[2][OF_MODEL] = {
        {"ball_verdict", "ball_turns", "ball_megno", "ball_gali2", "ball_per_turn", "ball_exponent_t",
         "ball_exponent_tau", "ball_exponent_s", "ball_error_t", "ball_error_tau", "ball_error_s"},
        {"point_verdict", "point_turns", "point_megno", "point_gali2", "point_per_turn", "point_exponent_t",
         "point_exponent_tau", "point_exponent_s", "point_error_t", "point_error_tau", "point_error_s"}};
    int count = 0;
    name[count++] = "verdict";
    if (ask->setting[STARTS] > 0) count += iso_sweep_names(name + count, 6, share);
    for (int m = 0; m < 2; m++)
        if (with_model(ask, m)) count += iso_sweep_names(name + count, OF_MODEL, models[m]);
    return count;
}

static void tell_model(const iso_indication *i, double number[])
{
    number[0] = i->verdict;
    number[1] = (double)i->turns;
    number[2] = i->megno;
    number[3] = i->gali2;
    number[4] = i->per_turn;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        number[5 + c] = i->exponent[c];
        number[8 + c] = i->error[c];
    }
}

static void tell_share(const iso_chaos_fraction *s, double number[])
{
    const double n = (double)s->count;
    number[0] = s->share;
    number[1] = s->low;
    number[2] = s->high;
    number[3] = (double)s->regular / n;
    number[4] = (double)s->undecided / n;
    number[5] = (double)s->failed;
}

static void tell(const iso_sweep_job *ask, const iso_chaos_orbit *own, const bool with[2],
                 const iso_chaos_fraction *share, double number[])
{
    int at = 1;
    number[0] = own->verdict;
    if (ask->setting[STARTS] > 0) tell_share(share, number + at), at += 6;
    for (int m = 0; m < 2; m++) {
        if (!with_model(ask, m)) continue;
        if (with[m]) tell_model(&own->told[m], number + at);
        at += OF_MODEL;
    }
}

static iso_chaos_options options_of(const iso_sweep_job *ask)
{
    iso_chaos_options o = iso_chaos_defaults();
    if (!isnan(ask->turns)) o.turns = (long)ask->turns;
    o.exponent_turns = (long)ask->setting[EXPONENT_TURNS];
    o.starts = (size_t)ask->setting[STARTS];
    o.seed = (uint64_t)ask->setting[SEED];
    if (!isnan(ask->setting[MODEL])) o.models = (iso_models)ask->setting[MODEL];
    o.threads = 1;
    o.vectors = ask->vectors;
    return o;
}

static iso_status chaos_find(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *scene, double number[])
{
    const iso_chaos_options o = options_of(ask);
    iso_chaos *c = NULL;
    iso_status status = iso_chaos_run(ctx, scene, &o, &c);
    if (status == ISO_OK) {
        tell(ask, &c->own, c->with, &c->share, number);
        const iso_status *own = c->own.status; /* of other starts, only the number is told */
        if (own[0] != ISO_OK || own[1] != ISO_OK) status = iso_context_fail(ctx, c->failure, "", "%s", c->words);
    }
    iso_chaos_free(c);
    return status;
}

/* The points of a chunk, followed together. */
static iso_status find_together(iso_context *ctx, const iso_sweep_job *ask, iso_sweep_batch *b,
                                const iso_scene *scene[], iso_chaos *chaos[], iso_status status[])
{
    const iso_chaos_options o = options_of(ask);
    for (size_t i = 0; i < b->count; i++) scene[i] = b->made[i] ? &b->scene[i] : NULL;
    iso_status answer = iso_chaos_run_many(ctx, b->count, scene, &o, chaos, status);
    for (size_t i = 0; i < b->count && answer == ISO_OK; i++) {
        const iso_chaos *c = chaos[i];
        const bool followed = status[i] == ISO_OK;
        if (!b->made[i]) continue;
        if (followed) tell(ask, &c->own, c->with, &c->share, iso_sweep_numbers(ask, b, i));
        if (followed && c->own.status[0] == ISO_OK && c->own.status[1] == ISO_OK) continue;
        const iso_status why = followed ? c->failure : status[i];
        iso_context_fail(ctx, why, "", "%s", c ? c->words : "it failed");
        if (why == ISO_NO_MEMORY || why == ISO_STOPPED)
            answer = why; /* this computer failed now, not the point */
        else
            iso_sweep_note(ctx, ask, b, i, why);
    }
    for (size_t i = 0; i < b->count; i++) iso_chaos_free(chaos[i]);
    return answer;
}

static iso_status chaos_find_all(iso_context *ctx, const iso_sweep_job *ask, iso_sweep_batch *b)
{
    const iso_scene **scene = calloc(b->count + 1, sizeof *scene);
    iso_chaos **chaos = calloc(b->count + 1, sizeof *chaos);
    iso_status *status = calloc(b->count + 1, sizeof *status);
    const bool room = scene && chaos && status;
    const iso_status answer = room ? find_together(ctx, ask, b, scene, chaos, status)
                                   : iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for the orbits of a chunk");
    free(scene);
    free(chaos);
    free(status);
    return answer;
}

/* Starts of one section already fill the lanes. */
static bool chaos_together(const iso_sweep_job *ask)
{
    return ask->setting[STARTS] == 0;
}

/* A turn takes about 15 microseconds by each model, and most orbits have a verdict after 1000. Orbits are followed in
 * the lanes of vectors, so points come in eights. With effects a turn takes 300 microseconds, and each orbit goes
 * alone. */
static size_t chaos_chunk(const iso_sweep_job *ask)
{
    enum { MOST = 512, LANES = 8 };
    const double asked = fmax(isnan(ask->turns) ? 1000 : fmin(ask->turns, 1000), ask->setting[EXPONENT_TURNS]),
                 models = with_model(ask, 0) + with_model(ask, 1);
    const iso_effects acting = ask->base ? iso_scene_acting(ask->base) : iso_effects_default();
    const bool effects = iso_effects_beyond_level(&acting);
    const double point = (effects ? 300e-6 : 15e-6) * asked * models * (ask->setting[STARTS] + 1),
                 fits = fmin(1 / point, MOST);
    if (ask->setting[STARTS] > 0 || effects) return fits > 1 ? (size_t)fits : 1;
    return fits > LANES ? (size_t)(fits / LANES) * LANES : LANES;
}

static const iso_sweep_setting chaos_settings[] = {
    [STARTS] = {.name = "starts", .usual = 0, .least = 0, .most = 1e9, .whole = true},
    [SEED] = {.name = "seed", .usual = 0, .least = 0, .most = 0x1p53, .whole = true},
    [MODEL] = {.name = "model", .word = model_word, .usual = NAN},
    [EXPONENT_TURNS] = {.name = "exponent_turns", .usual = 0, .least = 0, .most = 1e9, .whole = true},
    {.name = NULL},
};

const iso_sweep_computation iso_sweep_chaos = {
    .topic = {.name = "chaos",
              .doc = "verdict, exponents and indicators; with starts, the chaotic share of the section",
              .settings = chaos_settings,
              .turns = true},
    .columns = chaos_columns,
    .chunk = chaos_chunk,
    .find = chaos_find,
    .find_all = chaos_find_all,
    .together = chaos_together,
};

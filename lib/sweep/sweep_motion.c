/* sweep_motion.c - quantities of the free ball: frequencies, the splitting of the separatrix, the rotations. */
#include <math.h>

#include "model/model_impl.h"
#include "study/frequencies/frequencies.h"
#include "study/periodic/periodic.h"
#include "study/separatrix/separatrix.h"
#include "sweep/sweep_impl.h"

/* --- frequencies ------------------------------------------------------------------------------------------------ */

static int frequencies_columns(const iso_sweep_job *ask, const char *name[])
{
    static const char *const names[] = {"rotation", "f1_t",     "f1_tau",  "f1_s",      "f2_t", "f2_tau", "f2_s",
                                        "f1_error", "f2_error", "verdict", "estimated", "h",    "F"};
    (void)ask;
    return iso_sweep_names(name, (int)(sizeof names / sizeof *names), names);
}

static iso_status frequencies_find(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *scene,
                                   double number[])
{
    iso_frequencies_options o = iso_frequencies_defaults();
    iso_frequencies f;
    o.turns = ask->turns;
    o.end = ask->time;
    const iso_status status = iso_frequencies_find(ctx, scene, &o, &f);
    if (status != ISO_OK) return status;
    number[0] = f.rotation;
    for (int a = 0; a < f.angles; a++) {
        for (int c = 0; c < ISO_CLOCKS; c++) number[1 + 3 * a + c] = f.angle[a].frequency[c];
        if (f.estimated) number[7 + a] = f.angle[a].error[ISO_CLOCK_T];
    }
    if (f.estimated) number[9] = f.estimate.verdict;
    number[10] = f.estimated;
    number[11] = f.h;
    number[12] = f.F;
    return ISO_OK;
}

static size_t two(const iso_sweep_job *ask)
{
    (void)ask;
    return 2;
}

const iso_sweep_computation iso_sweep_frequencies = {
    .topic = {.name = "frequencies", .doc = "frequencies and rotation number", .turns = true, .time = true},
    .columns = frequencies_columns,
    .chunk = two,
    .find = frequencies_find,
};

/* --- splitting -------------------------------------------------------------------------------------------------- */

static const char *digits_word(int i)
{
    static const char *const words[] = {"double", "quad", "auto"};
    return i < 3 ? words[i] : NULL;
}

static int splitting_columns(const iso_sweep_job *ask, const char *name[])
{
    static const char *const names[] = {"x",      "m",      "error",      "x_error",   "x_tail",
                                        "m_tail", "digits", "multiplier", "from_zero", "axis"};
    (void)ask;
    return iso_sweep_names(name, (int)(sizeof names / sizeof *names), names);
}

static iso_status free_refuse(iso_context *ctx, const iso_sweep_job *ask)
{
    const iso_effects acting = iso_scene_acting(ask->base);
    const iso_effect *effect = iso_effects_beyond_level(&acting);
    if (!effect) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_INPUT, effect->name,
                            "it is about the free ball, or the point on a level: remove '%s'", effect->name);
}

static iso_status splitting_find(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *scene, double number[])
{
    iso_separatrix_options o = iso_separatrix_defaults();
    iso_separatrix_table *found = NULL;
    o.k = &scene->params.k;
    o.count = 1;
    for (int i = 0; i < 3; i++) o.J[i] = scene->params.J[i];
    o.scene = scene;
    o.digits = (iso_separatrix_digits)ask->setting[0];
    o.zeros = false;
    o.threads = 1;
    iso_status status = iso_separatrix_run(ctx, &o, &found);
    if (status != ISO_OK) return status;
    const iso_separatrix_splitting *s = found->row;
    if (s->status == ISO_OK) {
        const double values[] = {s->x,      s->m,      s->error,  s->x_error,   s->x_tail,
                                 s->m_tail, s->digits, s->lambda, s->from_zero, s->axis + 1};
        for (int i = 0; i < ask->count; i++) number[i] = values[i];
    } else {
        status = iso_context_fail(ctx, s->status, "", "%s", s->words);
    }
    iso_separatrix_free(found);
    return status;
}

static const iso_sweep_setting splitting_settings[] = {
    {.name = "digits", .word = digits_word, .usual = ISO_SEPARATRIX_AUTO},
    {.name = NULL},
};

const iso_sweep_computation iso_sweep_splitting = {
    .topic = {.name = "splitting",
              .doc = "x and m of the separatrix, and their errors",
              .settings = splitting_settings},
    .columns = splitting_columns,
    .chunk = two,
    .refuse = free_refuse,
    .find = splitting_find,
};

/* --- rotations -------------------------------------------------------------------------------------------------- */

static int rotations_columns(const iso_sweep_job *ask, const char *name[])
{
    static const char *const names[] = {"trace1", "trace2", "trace3", "error1", "error2", "error3"};
    (void)ask;
    return iso_sweep_names(name, 6, names);
}

static iso_status rotations_find(iso_context *ctx, const iso_sweep_job *ask, const iso_scene *scene, double number[])
{
    iso_periodic_options o = iso_periodic_defaults();
    iso_periodic *found = NULL;
    o.rotations_alone = true;
    o.threads = 1;
    (void)ask;
    const iso_status status = iso_periodic_run(ctx, scene, &o, &found);
    for (int a = 0; a < 3 && status == ISO_OK; a++) {
        number[a] = found->rotation[a].half_turn_trace;
        number[3 + a] = found->rotation[a].error;
    }
    iso_periodic_free(found);
    return status;
}

static size_t many(const iso_sweep_job *ask)
{
    (void)ask;
    return 64;
}

const iso_sweep_computation iso_sweep_rotations = {
    .topic = {.name = "rotations", .doc = "half-turn traces of the rotations about the three axes"},
    .columns = rotations_columns,
    .chunk = many,
    .refuse = free_refuse,
    .find = rotations_find,
};

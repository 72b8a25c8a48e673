/* sweep_motion.c - quantities of the free ball: frequencies, the splitting of the separatrix, the rotations. */
#include "instrument/frequencies/frequencies.h"
#include "instrument/periodic/periodic.h"
#include "instrument/separatrix/separatrix.h"
#include "study/fields_impl.h"
#include "study/study_impl.h"
#include "sweep/sweep_impl.h"

static iso_status frequencies_find(iso_context *ctx, const iso_sweep_job *job, const iso_scene *scene,
                                   double number[])
{
    iso_frequencies_options o = iso_frequencies_defaults();
    iso_frequencies f;
    o.turns = job->turns;
    o.end = job->time;
    ISO_TRY(iso_frequencies_find(ctx, scene, &o, &f));
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

static const iso_field frequencies_fields[] = {
    {.name = "rotation", .unit = "", .doc = "frequency 1 by frequency 2"},
    {.name = "f1", .count = 3, .word = iso_clock_word, .unit = "rad/time", .doc = "frequency 1, in this clock"},
    {.name = "f2", .count = 3, .word = iso_clock_word, .unit = "rad/time", .doc = "frequency 2, in this clock"},
    {.name = "f1_error", .unit = "rad/time", .doc = "error of frequency 1 in t, if estimated"},
    {.name = "f2_error", .unit = "rad/time", .doc = "error of frequency 2 in t, if estimated"},
    {.name = "verdict", .unit = "", .doc = "if estimated: 0 regular, 1 chaotic, 2 undecided, 3 integrable"},
    {.name = "estimated", .unit = "", .doc = "1: estimated; 0: from the closed solution"},
    {.name = "h", .unit = "energy", .doc = "energy of the ball"},
    {.name = "F", .unit = "", .doc = "value of the additional integral"},
    ISO_FIELD_END,
};

const iso_sweep_computation iso_sweep_frequencies = {
    .quantity = {.name = "frequencies", .doc = "frequencies and rotation number", .turns = true, .time = true},
    .fields = {frequencies_fields},
    .points = 2,
    .find = frequencies_find,
};

static iso_status splitting_find(iso_context *ctx, const iso_sweep_job *job, const iso_scene *scene, double number[])
{
    iso_separatrix_options o = iso_separatrix_defaults();
    iso_separatrix_table *found = NULL;
    o.k = &scene->params.k;
    o.count = 1;
    for (int i = 0; i < 3; i++) o.J[i] = scene->params.J[i];
    o.scene = scene;
    o.digits = (iso_separatrix_digits)job->setting[0];
    o.zeros = false;
    o.threads = 1;
    iso_status status = iso_separatrix_run(ctx, &o, &found);
    if (status != ISO_OK) return status;
    const iso_separatrix_splitting *s = found->row;
    iso_sweep_fill(job, iso_separatrix_fields, s, number);
    if (s->status == ISO_OK)
        number[9] = s->axis + 1;
    else
        status = iso_context_fail(ctx, s->status, "", "%s", s->words);
    iso_separatrix_free(found);
    return status;
}

static const iso_sweep_setting splitting_settings[] = {
    {.name = "digits", .word = iso_separatrix_digits_name, .usual = ISO_SEPARATRIX_AUTO},
    {.name = NULL},
};

static const iso_field axis_field[] = {{.name = "axis", .unit = "", .doc = "a of the section n_a = 0 of x and m"},
                                       ISO_FIELD_END};

const iso_sweep_computation iso_sweep_splitting = {
    .quantity = {.name = "splitting",
                 .doc = "x and m of the separatrix, and their errors",
                 .settings = splitting_settings},
    .fields = {iso_separatrix_fields, axis_field},
    .names = "x m error x_error x_tail m_tail digits multiplier from_zero axis",
    .points = 2,
    .refuse = iso_sweep_refuse_effects,
    .find = splitting_find,
};

static iso_status rotations_find(iso_context *ctx, const iso_sweep_job *job, const iso_scene *scene, double number[])
{
    iso_periodic_options o = iso_periodic_defaults();
    iso_periodic *found = NULL;
    o.rotations_alone = true;
    o.threads = 1;
    (void)job;
    const iso_status status = iso_periodic_run(ctx, scene, &o, &found);
    for (int a = 0; a < 3 && status == ISO_OK; a++) {
        number[a] = found->rotation[a].half_turn_trace;
        number[3 + a] = found->rotation[a].error;
    }
    iso_periodic_free(found);
    return status;
}

static const iso_field rotations_fields[] = {
    {.name = "trace", .count = 3, .unit = "", .doc = "half-turn trace of the rotation about this axis"},
    {.name = "error", .count = 3, .unit = "", .doc = "its error"},
    ISO_FIELD_END,
};

const iso_sweep_computation iso_sweep_rotations = {
    .quantity = {.name = "rotations", .doc = "half-turn traces of the rotations about the three axes"},
    .fields = {rotations_fields},
    .points = 64,
    .refuse = iso_sweep_refuse_effects,
    .find = rotations_find,
};

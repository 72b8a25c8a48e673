/* scene.c - bytes as a scene: refused with a place and words, or an orbit all of whose numbers are finite. */
#define _GNU_SOURCE /* memfd_create */
#include <math.h>

#include "exact/exact_impl.h"
#include "fuzz.h"
#include "io/scene_file.h"
#include "model/model_impl.h"
#include "orbit/orbit_impl.h"

enum { STEPS = 2000, NAME_LENGTH = 6 /* "scene:" */ };

/* Whether a column was asked for: an effect's is filled where the effect is. */
static bool asked(const iso_orbit_options *o, const iso_effects *effects, int column)
{
    if (column < ISO_CLOCKS) return o->with_clock[column] || column == (int)o->clock;
    if (column < ISO_COLUMN_POINT) return o->shown != ISO_SHOW_POINT;
    if (column < ISO_COLUMN_EFFECTS) return o->shown != ISO_SHOW_BALL;
    return o->shown != ISO_SHOW_POINT && effects->on[iso_column_effect(column)];
}

static void check_sample(const iso_orbit *orbit, const iso_orbit_options *o, const iso_sample *sample, double time)
{
    const iso_effects effects = iso_orbit_effects(orbit);
    for (int c = 0; c < iso_columns_count(); c++)
        FUZZ_REQUIRE(!asked(o, &effects, c) || isfinite(iso_sample_column(sample, c)), "%s = %g at %g\n",
                     iso_column_name(c), iso_sample_column(sample, c), time);
}

/* What `run` writes above the rows can be read back as it was. */
static void check_description(iso_context *ctx, const iso_scene *scene, const iso_orbit *orbit)
{
    iso_record *record;
    iso_params p;
    iso_effects effects;
    if (iso_record_create(ctx, 0, NULL, &record) != ISO_OK) return;
    const iso_status status = iso_record_describe(ctx, record, "ball", &scene->params, orbit);
    FUZZ_REQUIRE(status == ISO_OK, "%s\n", iso_context_message(ctx));
    FUZZ_REQUIRE(iso_record_params(ctx, record, &p) == ISO_OK, "%s\n", iso_context_message(ctx));
    FUZZ_REQUIRE(p.k == scene->params.k && memcmp(p.J, scene->params.J, sizeof p.J) == 0, "k = %.17g\n", p.k);
    FUZZ_REQUIRE(iso_record_effects(ctx, record, &effects) == ISO_OK, "%s\n", iso_context_message(ctx));
    iso_record_free(record);
}

/* What `explain` looks at. */
static void look(const iso_orbit *orbit, const iso_sample *sample)
{
    const iso_model *m = iso_orbit_model(orbit);
    double size;
    (void)iso_effects_stiffness(&m->problem);
    (void)iso_orbit_coupling(orbit), (void)iso_orbit_has_twin(orbit), (void)iso_orbit_statistics(orbit);
    if (iso_orbit_exact(orbit)) (void)iso_exact_describe(iso_orbit_exact(orbit));
    for (const iso_integral *i = m->system->integrals; i->name; i++)
        if (!i->holds || i->holds(&m->problem)) (void)iso_orbit_integral(orbit, m->system, i, sample, &size);
}

static void follow(iso_context *ctx, const iso_scene *scene, iso_orbit *orbit, const iso_orbit_options *o)
{
    const size_t rows = iso_scene_rows(scene);
    const double times[] = {0,      scene->end, scene->end / 3, iso_scene_time(scene, rows / 2), -scene->end / 7,
                            1e-300, 1e14};
    iso_sample sample;
    bool lost;
    FUZZ_REQUIRE(rows > 0 && iso_scene_time(scene, rows - 1) == scene->end, "%zu rows\n", rows);
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        iso_status status = iso_orbit_at(orbit, times[i], &sample);
        if (status != ISO_OK)
            fuzz_failed(ctx, status), status = iso_orbit_at(orbit, nextafter(iso_orbit_reached(orbit), 0), &sample);
        if (status != ISO_OK) continue;
        check_sample(orbit, o, &sample, times[i]);
        look(orbit, &sample);
    }
    if (!scene->effects.on[ISO_REACTIONS] || o->shown == ISO_SHOW_POINT) return;
    const iso_status status = iso_orbit_lost_contact(orbit, 0, scene->end, &lost, &sample);
    if (status != ISO_OK) fuzz_failed(ctx, status);
    if (status == ISO_OK && lost) check_sample(orbit, o, &sample, scene->end);
}

/* One way to ask for the orbit; no more than STEPS steps are taken. */
static void ask(iso_context *ctx, const iso_scene *scene, iso_orbit_options *o)
{
    iso_orbit *orbit;
    long steps = STEPS;
    iso_context_set_monitor(ctx, fuzz_goes_on, &steps);
    const iso_status status = iso_orbit_create(ctx, &scene->params, &scene->start, o, &orbit);
    if (status == ISO_OK) {
        check_description(ctx, scene, orbit);
        follow(ctx, scene, orbit, o);
        iso_orbit_free(orbit);
    } else {
        fuzz_failed(ctx, status);
        (void)iso_scene_blame(ctx, scene, "scene", status);
        fuzz_failed(ctx, status);
    }
    iso_context_set_monitor(ctx, NULL, NULL);
}

/* As the scene says, then everything there is, then the closed solution. */
static void solve(iso_context *ctx, const iso_scene *scene)
{
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    o.effects = &scene->effects;
    o.backend = scene->backend;
    o.method = iso_method_find(scene->method);
    o.tolerance = scene->tolerance;
    o.max_steps = STEPS;
    if (scene->as == ISO_SHOW_BALL || scene->as == ISO_SHOW_POINT || scene->as == ISO_SHOW_BOTH) o.shown = scene->as;
    ask(ctx, scene, &o);
    o.shown = ISO_SHOW_BOTH;
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = true;
    ask(ctx, scene, &o);
    o.backend = ISO_BACKEND_EXACT;
    o.method = NULL;
    ask(ctx, scene, &o);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    iso_context *ctx = iso_context_create();
    iso_scene scene;
    if (!ctx) return 0;
    const iso_status status = iso_scene_load_text(ctx, "scene", (const char *)data, size, &scene);
    if (status == ISO_OK)
        solve(ctx, &scene);
    else {
        fuzz_failed(ctx, status);
        const char *words = iso_context_message(ctx);
        int line = 0, column = 0;
        FUZZ_REQUIRE(status == ISO_BAD_INPUT && strncmp(words, "scene:", NAME_LENGTH) == 0 &&
                         sscanf(words + NAME_LENGTH, "%d:%d: ", &line, &column) == 2 && line > 0 && column > 0,
                     "status %d says '%s'\n", (int)status, words);
    }
    iso_context_free(ctx);
    return 0;
}

/* test_version.c - the version is the same everywhere; option structs of programs compiled against other versions are
 * taken or refused; a failure says whether its message begins with a place. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/options_impl.h"
#include "instrument/frequencies/frequencies.h"
#include "isoroll.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"
#include "task/convert/convert_impl.h"
#include "task/cost/cost.h"

static void test_version(void)
{
    char words[64];
    snprintf(words, sizeof words, "%d.%d.%d", ISO_VERSION_MAJOR, ISO_VERSION_MINOR, ISO_VERSION_PATCH);
    gsl_test(strcmp(iso_version(), ISO_VERSION) != 0, "iso_version() is %s, the headers are %s", iso_version(),
             ISO_VERSION);
    gsl_test(strcmp(words, ISO_VERSION) != 0, "ISO_VERSION is made of its three numbers");
}

/* An option struct as it is now, as it was before `added`, and as it may be later. */
typedef struct now {
    size_t size;
    double old, added;
} now;

typedef struct later {
    now known;
    double unknown;
} later;

static iso_status take(iso_context *ctx, now *own, const void *given)
{
    *own = (now){sizeof *own, 1, 2};
    return iso_options_take(ctx, "now", own, sizeof *own, given);
}

static void test_sizes(iso_context *ctx)
{
    now own;
    const now full = {sizeof full, 3, 4}, unsaid = {0, 5, 6}, older = {offsetof(now, added), 7, NAN};
    const later newer = {{sizeof newer, 8, 9}, 10};
    bool good = take(ctx, &own, NULL) == ISO_OK && own.old == 1 && own.added == 2;
    gsl_test(!good, "no options: the defaults stay");
    good = take(ctx, &own, &full) == ISO_OK && own.old == 3 && own.added == 4;
    gsl_test(!good, "options of this version");
    good = take(ctx, &own, &unsaid) == ISO_OK && own.old == 5 && own.added == 6 && own.size == sizeof own;
    gsl_test(!good, "size 0: this version");
    good = take(ctx, &own, &older) == ISO_OK && own.old == 7 && own.added == 2 && own.size == sizeof own;
    gsl_test(!good, "options of an older version: what it does not know keeps its default");
    good = take(ctx, &own, &newer) == ISO_BAD_ARGUMENT && strcmp(iso_context_about(ctx), "size") == 0 &&
           strstr(iso_context_message(ctx), "newer isoroll") && own.old == 1;
    gsl_test(!good, "options of a newer version are refused: %s", iso_context_message(ctx));
}

static void refused(iso_context *ctx, iso_status status, const char *function)
{
    gsl_test(status != ISO_BAD_ARGUMENT || strcmp(iso_context_about(ctx), "size") != 0,
             "%s refuses options that are too large: %s", function, iso_context_message(ctx));
}

/* Each function that takes options looks at their size. */
static void test_refusals(iso_context *ctx)
{
    const double J[3] = {1, 2, 3}, omega[3] = {1, 0, 0}, n[3] = {0, 0, 1};
    iso_scene scene = iso_scene_default();
    gsl_test(iso_params_reduced(ctx, 1, J, &scene.params) != ISO_OK ||
                 iso_start_ball(ctx, omega, n, ISO_SPIN_REFUSE, &scene.start) != ISO_OK,
             "a ball");
    scene.end = 1;
    iso_orbit_options orbit_options = iso_orbit_defaults(&scene.start);
    iso_orbit *orbit = NULL, *none = NULL;
    gsl_test(iso_orbit_create(ctx, &scene.params, &scene.start, NULL, &orbit) != ISO_OK, "an orbit by the defaults");
    orbit_options.size++;
    refused(ctx, iso_orbit_create(ctx, &scene.params, &scene.start, &orbit_options, &none), "iso_orbit_create");
    iso_error_finder *finder = NULL;
    refused(ctx, iso_error_finder_create(ctx, &scene.params, &scene.start, &orbit_options, orbit, &finder),
            "iso_error_finder_create");
    iso_orbit_free(orbit);

    iso_batch_options batch = iso_batch_defaults();
    batch.size++;
    refused(ctx, iso_batch_run(ctx, NULL, 0, &batch, NULL, 0, NULL, NULL), "iso_batch_run");
    iso_run_options run = iso_run_defaults();
    const iso_run_sink sink = {.data = NULL};
    run.size++;
    refused(ctx, iso_run(ctx, &scene, &run, &sink, NULL), "iso_run");
    iso_frequencies frequencies;
    iso_frequencies_options find = iso_frequencies_defaults();
    find.size++;
    refused(ctx, iso_frequencies_find(ctx, &scene, &find, &frequencies), "iso_frequencies_find");
    refused(ctx, iso_frequencies_estimate(ctx, &scene, &find, &frequencies), "iso_frequencies_estimate");
    iso_cost *cost = NULL;
    iso_cost_options measure = iso_cost_defaults();
    measure.size++;
    refused(ctx, iso_cost_measure(ctx, &scene, &measure, &cost), "iso_cost_measure");
}

static void test_conversion(iso_context *ctx)
{
    static const char *const names[] = {"omega1", "omega2", "omega3", "n1", "n2", "n3"};
    const double J[3] = {1, 2, 3};
    iso_params params;
    iso_record *header = NULL;
    iso_conversion *conversion = NULL;
    iso_conversion_options options = iso_conversion_defaults();
    const iso_conversion_target target = {.data = NULL};
    gsl_test(iso_params_reduced(ctx, 1, J, &params) != ISO_OK ||
                 iso_record_create(ctx, ISO_STATE, names, &header) != ISO_OK,
             "a record");
    options.size++;
    refused(ctx, iso_conversion_create(ctx, &params, header, ISO_POINT, &options, &target, &conversion),
            "iso_conversion_create");
    gsl_test(conversion != NULL, "no conversion is made");
    iso_record_free(header);
}

/* A message that begins with a place is followed by one that does not, and the reverse. */
static void test_place(iso_context *ctx)
{
    iso_scene scene;
    static const char bad[] = "version: 1\nmodel: [";
    gsl_test(iso_context_has_place(ctx), "no place before a failure with one");
    gsl_test(iso_scene_load_text(ctx, "a.yaml", bad, sizeof bad - 1, &scene) != ISO_BAD_INPUT ||
                 !iso_context_has_place(ctx) || strncmp(iso_context_message(ctx), "a.yaml:", 7) != 0,
             "a bad scene's message has a place: %s", iso_context_message(ctx));
    scene = iso_scene_default();
    scene.places = 2;
    scene.place[0] = (iso_place){"end", 3, 1};
    scene.place[1] = (iso_place){"step", 4, 7};
    iso_context_fail(ctx, ISO_BAD_ARGUMENT, "step", "a bad step");
    gsl_test(iso_context_has_place(ctx), "a new failure has none");
    iso_scene_forget_place(&scene, "end");
    gsl_test(iso_scene_blame(ctx, &scene, "b.yaml", ISO_BAD_ARGUMENT) != ISO_BAD_INPUT ||
                 !iso_context_has_place(ctx) || strcmp(iso_context_message(ctx), "b.yaml:4:7: a bad step") != 0,
             "blame puts a place: %s", iso_context_message(ctx));
    iso_context_fail(ctx, ISO_BAD_ARGUMENT, "end", "a bad end");
    gsl_test(iso_scene_blame(ctx, &scene, "b.yaml", ISO_BAD_ARGUMENT) != ISO_BAD_ARGUMENT ||
                 iso_context_has_place(ctx) || strcmp(iso_context_message(ctx), "a bad end") != 0,
             "but not one that was forgotten: %s", iso_context_message(ctx));
}

int main(void)
{
    iso_context *ctx = iso_context_create();
    if (!ctx) return 1;
    test_place(ctx);
    test_version();
    test_sizes(ctx);
    test_refusals(ctx);
    test_conversion(ctx);
    iso_context_free(ctx);
    return gsl_test_summary();
}

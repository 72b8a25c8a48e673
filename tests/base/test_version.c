/* test_version.c - the version is the same everywhere; a failure says whether its message begins with a place. */
#include "api/typed_impl.h"
#include "laws.h"
#include "orbit/orbit_impl.h"

static void test_version(void)
{
    char words[64];
    snprintf(words, sizeof words, "%d.%d.%d", ISO_VERSION_MAJOR, ISO_VERSION_MINOR, ISO_VERSION_PATCH);
    gsl_test(strcmp(iso_version(), ISO_VERSION) != 0, "iso_version() is %s, the headers are %s", iso_version(),
             ISO_VERSION);
    gsl_test(strcmp(words, ISO_VERSION) != 0, "ISO_VERSION is made of its three numbers");
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
    test_place(ctx);
    test_version();
    iso_context_free(ctx);
    return gsl_test_summary();
}

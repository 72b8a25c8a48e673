/* studies.h - what tests of studies share: their context, and the usual scene of a ball. */
#ifndef ISO_TESTS_STUDIES_H
#define ISO_TESTS_STUDIES_H

#include "io/scene_file.h"
#include "laws.h"
#include "orbit/scene.h"

static iso_context *ctx; /* the test's */

/* Ends the test when what it needs is refused. */
static inline void must(iso_status status, const char *what)
{
    laws_stop_if(ctx, status != ISO_OK, what);
}

static inline iso_scene parse(const char *text)
{
    iso_scene scene;
    must(iso_scene_load_text(ctx, "scene", text, strlen(text), &scene), text);
    return scene;
}

/* A free ball with these k and J, at the start that most tests have. */
static inline iso_scene ball_scene(double k, const double J[3])
{
    static const double omega[3] = {0.9, -0.3, -0.225}, normal[3] = {0.36, 0.48, 0.8};
    iso_scene scene = iso_scene_default();
    scene.params = laws_params(k, J);
    must(iso_start_ball(ctx, omega, normal, ISO_SPIN_REMOVE, &scene.start), "a start");
    return scene;
}

/* Three moments from exp(-width) to exp(width), in any order, of which each two differ by this part or more. */
static inline void draw_moments(iso_random *random, double width, double part, double J[3])
{
    for (bool close = true; close;) {
        for (int i = 0; i < 3; i++) J[i] = exp(iso_random_uniform(random, -width, width));
        close = false;
        for (int i = 0; i < 3; i++) close = close || fabs(J[i] / J[(i + 1) % 3] - 1) < part;
    }
}

#endif

/* searches.h - searches for first integrals: scenes of a ball, random moments, values of two searches compared. */
#ifndef ISO_TESTS_SEARCHES_H
#define ISO_TESTS_SEARCHES_H

#include "instrument/integrals/integrals.h"
#include "studies.h"

static const double searched_J[3] = {1.4, 2.1, 3};

static inline iso_scene scene_of(double k, const double J[3])
{
    iso_scene scene = iso_scene_default();
    scene.params = laws_params(k, J);
    scene.start = (iso_start){.model = ISO_BALL, .y = {0.8, 0.3, -0.6, 0.6, 0, 0.8}, .eps = NAN};
    return scene;
}

static inline iso_integral_search_options options(int degree)
{
    iso_integral_search_options o = iso_integral_search_defaults();
    o.degree = degree;
    return o;
}

static inline iso_integral_search search(const iso_scene *scene, const iso_integral_search_options *o)
{
    iso_integral_search r;
    if (iso_integral_search_run(ctx, scene, o, &r) == ISO_OK) return r;
    gsl_test(1, "a search is refused: %s", iso_context_message(ctx));
    exit(gsl_test_summary());
}

static inline iso_integral_search look(double k, const double J[3], int degree)
{
    const iso_scene scene = scene_of(k, J);
    const iso_integral_search_options o = options(degree);
    return search(&scene, &o);
}

/* The largest difference of two values. */
static inline double apart(const iso_integral_search *a, const iso_integral_search *b)
{
    double most = 0;
    for (int d = 1; d <= a->degrees; d++)
        for (size_t i = 0; i < a->at[d].values; i++)
            most = fmax(most, fabs(a->at[d].value[i].value - b->at[d].value[i].value));
    return most;
}

static inline void set_rotor(iso_scene *scene, const double K[3])
{
    iso_effects_set(ctx, &scene->effects, "rotor", "momentum", 3, K);
}

#endif

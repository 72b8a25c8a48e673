/* section --area: det D of returns is 1 where the area dL dl is kept, and is not where energy is lost; the bound that
 * is printed covers the error. */
#include "instrument/section/section_impl.h"
#include "laws.h"

static iso_context *ctx;

static iso_scene scene_of(double k, const double J[3], iso_random *r)
{
    iso_scene scene = iso_scene_default();
    double w[3], n[3];
    scene.params = laws_params(k, J);
    iso_random_direction(r, w);
    iso_random_direction(r, n);
    if (iso_start_ball(ctx, w, n, ISO_SPIN_REMOVE, &scene.start) != ISO_OK) exit(1);
    return scene;
}

static iso_section_areas find(const iso_scene *scene, size_t crossings, double tolerance, const char *what)
{
    iso_section_areas a;
    iso_section_options o = iso_section_defaults();
    o.crossings = crossings;
    o.tolerance = tolerance;
    if (iso_section_areas_find(ctx, scene, &o, NULL, NULL, &a) != ISO_OK)
        gsl_test(1, "%s: %s", what, iso_context_message(ctx));
    return a;
}

/* Of 200 random motions, at four tolerances: the bound holds for all. */
static void covers(void)
{
    iso_random *r = iso_random_create(3);
    laws_worst worst = {0};
    const int cases = tests_length(50, 200);
    for (int i = 0; i < cases; i++) {
        const double J[3] = {iso_random_uniform(r, 0.3, 2), iso_random_uniform(r, 0.3, 2),
                             iso_random_uniform(r, 0.3, 2)};
        const double k = (i % 2 ? 1 : -1) * pow(10, iso_random_uniform(r, -0.6, 0.7));
        const iso_scene scene = scene_of(k, J, r);
        iso_section_areas a = find(&scene, 30, pow(10, -6 - 2 * (i % 4)), "a free ball");
        for (size_t j = 0; j < a.count; j++)
            if (a.orbit[j].turns > 0)
                laws_note(&worst, a.orbit[j].worst, a.orbit[j].bound, &scene.params,
                          iso_model_kind_name((int)a.orbit[j].model));
        iso_section_areas_free(&a);
    }
    laws_report(&worst, "det D of a free motion is 1 within its bound");
    iso_random_free(r);
}

static iso_status write_torque(iso_scene *scene, const char *M1)
{
    ISO_TRY(iso_effects_write(ctx, &scene->effects, "torque", "M1", M1));
    ISO_TRY(iso_effects_write(ctx, &scene->effects, "torque", "M2", "0"));
    return iso_effects_write(ctx, &scene->effects, "torque", "M3", "0");
}

/* effect: as text, one of which has expressions. */
static void is(const char *effect, const char *key, const char *text, const double value[], int values,
               const char *verdict)
{
    iso_random *r = iso_random_create(5);
    for (int i = 0; i < 6; i++) {
        iso_scene scene = scene_of(i % 2 ? 0.7 : -1.6, (const double[]){1, 2, 3.5}, r);
        const iso_status status = strcmp(effect, "torque") == 0 ? write_torque(&scene, text)
                                  : text ? iso_effects_write(ctx, &scene.effects, effect, key, text)
                                         : iso_effects_set(ctx, &scene.effects, effect, key, values, value);
        if (status != ISO_OK) gsl_test(1, "%s: %s", effect, iso_context_message(ctx));
        iso_section_areas a = find(&scene, 20, 1e-12, effect);
        gsl_test(a.count == 0, "%s: there are areas", effect);
        for (size_t j = 0; j < a.count; j++)
            gsl_test(strcmp(a.orbit[j].kept, verdict) != 0, "%s by %s, k = %g: %s, |det D - 1| = %.2g, bound %.2g",
                     effect, iso_model_kind_name((int)a.orbit[j].model), scene.params.k, a.orbit[j].kept,
                     a.orbit[j].worst, a.orbit[j].bound);
        iso_section_areas_free(&a);
    }
    iso_random_free(r);
}

static void refused(const char *effect, const char *key, const double value[], int values)
{
    iso_random *r = iso_random_create(5);
    iso_scene scene = scene_of(0.7, (const double[]){1, 2, 3.5}, r);
    iso_section_areas a;
    iso_random_free(r);
    iso_status status = strcmp(effect, "torque") == 0
                            ? write_torque(&scene, key)
                            : iso_effects_set(ctx, &scene.effects, effect, key, values, value);
    if (strcmp(effect, "gravity") == 0)
        status = iso_effects_set(ctx, &scene.effects, effect, "mgb", 1, (double[]){0.3});
    gsl_test(status != ISO_OK || iso_section_areas_find(ctx, &scene, NULL, NULL, NULL, &a) != ISO_BAD_INPUT ||
                 strcmp(iso_context_about(ctx), effect) != 0,
             "%s is refused by name: %s", effect, iso_context_message(ctx));
    iso_section_areas_free(&a);
}

int main(void)
{
    ctx = iso_context_create();
    covers();
    is("level", "c", NULL, (const double[]){0.1}, 1, "kept");
    is("field", "linear", NULL, (const double[]){0.1, -0.1, 0.05}, 3, "kept");
    is("rotor", "momentum", NULL, (const double[]){0.3, 0.1, -0.2}, 3, "kept");
    is("potential", "U", "0.1*n1^2*n3", NULL, 0, "kept");
    is("rolling_resistance", "coefficient", NULL, (const double[]){1e-5}, 1, "not kept");
    is("rolling_resistance", "coefficient", NULL, (const double[]){1e-12}, 1, "undecided"); /* it cannot be kept */
    is("torque", "M1", "-1e-4*omega1", NULL, 0, "not kept");
    refused("gravity", "up", (const double[]){0, 0.6, 0.8}, 3);
    refused("twist", "resistance", (const double[]){0.1}, 1);
    refused("torque", "0.1*n3", NULL, 0); /* it keeps the measure (10), and no energy */
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

/* section --area: det D of returns is 1 where the area dL dl is kept, and is not where energy is lost; the bound that
 * is printed covers the error. */
#include "instrument/section/section_impl.h"
#include "studies.h"

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

/* What acts, and what becomes of the area; NULL: that is refused by the effect's name, which the words begin with. */
static const struct row {
    const char *effects, *verdict;
} rows[] = {
    {"level: {c: 0.1}", "kept"},
    {"field: {linear: [0.1, -0.1, 0.05]}", "kept"},
    {"rotor: {momentum: [0.3, 0.1, -0.2]}", "kept"},
    {"potential: {U: 0.1*n1^2*n3}", "kept"},
    {"rolling_resistance: {coefficient: 1e-5}", "not kept"},
    {"rolling_resistance: {coefficient: 1e-12}", "undecided"}, /* it cannot be kept */
    {"torque: {M: [-1e-4*omega1, 0, 0]}", "not kept"},
    {"gravity: {mgb: 0.3, up: [0, 0.6, 0.8]}", NULL},
    {"twist: {resistance: 0.1}", NULL},
    {"torque: {M: [0.1*n3, 0, 0]}", NULL}, /* it keeps the measure (10), and no energy */
};

static void hold(const struct row *row)
{
    iso_random *r = iso_random_create(5);
    char text[256];
    snprintf(text, sizeof text,
             "reduced: {k: 1, J: [1, 2, 3.5], D: 0.5}\ninitial: {normal: [0, 0.6, 0.8], "
             "angular_velocity: [1, 0, 0]}\ntime: {end: 1}\neffects: {%s}\n",
             row->effects);
    const iso_scene acting = parse(text);
    for (int i = 0; i < (row->verdict ? 6 : 1); i++) {
        iso_scene scene = scene_of(i % 2 ? 0.7 : -1.6, (const double[]){1, 2, 3.5}, r);
        iso_section_areas a = {.count = 0};
        scene.effects = acting.effects;
        if (!row->verdict) {
            gsl_test(iso_section_areas_find(ctx, &scene, NULL, NULL, NULL, &a) != ISO_BAD_INPUT ||
                         strncmp(row->effects, iso_context_about(ctx), strcspn(row->effects, ":")) != 0,
                     "%s is refused by name: %s", row->effects, iso_context_message(ctx));
        } else {
            a = find(&scene, 20, 1e-12, row->effects);
            gsl_test(a.count == 0, "%s: there are areas", row->effects);
        }
        for (size_t j = 0; j < a.count; j++)
            gsl_test(strcmp(a.orbit[j].kept, row->verdict) != 0,
                     "%s by %s, k = %g: %s, |det D - 1| = %.2g, bound %.2g", row->effects,
                     iso_model_kind_name((int)a.orbit[j].model), scene.params.k, a.orbit[j].kept, a.orbit[j].worst,
                     a.orbit[j].bound);
        iso_section_areas_free(&a);
    }
    iso_random_free(r);
}

int main(void)
{
    ctx = iso_context_create();
    covers();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) hold(&rows[i]);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

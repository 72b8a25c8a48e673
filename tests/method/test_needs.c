/* What methods need of a model (lib/method/method.c): a formula of every effect, room, a system; else they refuse
 * it. */
#include "method/methods_impl.h"
#include "orbits.h"

static iso_context *ctx;

/* An effect whose equations are no formula: a method that calls the right-hand side can simulate it; one that needs
 * slopes or series cannot. */
static const iso_effect no_formula = {.name = "drag"};

static void check_formulas(double twist)
{
    const orbit plain = orbit_rotation(ctx, 1, 1);
    const iso_effect *effect = &no_formula;
    iso_problem f = plain.model.problem;
    f.effects.on[ISO_TWIST] = twist > 0, TWIST_RESISTANCE(&f.effects) = twist, f.p.D = 0.5;
    iso_model m = iso_model_assemble(&iso_system_ball, &f, ISO_CLOCK_T, (const bool[ISO_CLOCKS]){false});
    m.without_formula = effect;
    const iso_method *best = iso_method_auto(&m);
    gsl_test(!best || best->implicit || best->own_equations, "%s: auto takes %s", effect->name,
             best ? best->name : "nothing");
    for (int i = 0; best && iso_methods[i]; i++) {
        const iso_method *method = iso_methods[i];
        char why[ISO_WHY_SIZE] = "";
        iso_integrator *it = (iso_integrator *)&ctx; /* must become NULL */
        if (method->system) continue;
        const bool serves = iso_method_serves(method, &m, why);
        gsl_test(serves == (method->implicit || method->own_equations), "%s without a formula: %s %s", effect->name,
                 method->name, why);
        if (serves) continue;
        const iso_status status =
            iso_integrator_create(ctx, method, &m, &(iso_method_options){.tolerance = 1e-9}, &it);
        const char *words = iso_context_message(ctx);
        gsl_test(status != ISO_BAD_ARGUMENT || it || strcmp(iso_context_about(ctx), "method") != 0 ||
                     !strstr(words, method->name) || !strstr(words, effect->name) || !strstr(words, best->name),
                 "refused: %s", words);
    }
}

/* Equations that there was no room for: no method may simulate what is left of them. */
static void check_room(void)
{
    orbit crowded = orbit_rotation(ctx, 1, 1);
    char why[ISO_WHY_SIZE] = "";
    crowded.model.problem.motion.overrun = true;
    for (int i = 0; iso_methods[i]; i++) {
        if (iso_methods[i]->system) continue;
        gsl_test(iso_method_serves(iso_methods[i], &crowded.model, why) || !strstr(why, "more lines"),
                 "no room: %s %s", iso_methods[i]->name, why);
    }
}

/* What a row says it needs is what iso_integrator_create asks for, and auto takes nothing that would be refused. */
static void check_needs(void)
{
    static const double k[] = {-1, 1, 0.5, 0.03, -0.03};
    for (int s = 0; iso_systems[s]; s++)
        for (size_t i = 0; i < sizeof k / sizeof *k; i++) {
            const orbit o = orbit_sample(ctx, iso_systems[s], k[i], orbit_J, 3);
            char why[ISO_WHY_SIZE];
            gsl_test(!iso_method_serves(iso_method_auto(&o.model), &o.model, why), "auto serves: %s, k = %g",
                     iso_systems[s]->name, k[i]);
            for (int j = 0; iso_methods[j]; j++) {
                const iso_method *m = iso_methods[j];
                const bool serves = iso_method_serves(m, &o.model, why);
                const bool wanted = orbit_served(m, iso_systems[s]) && !(m->steps_in_s && fabs(k[i]) < 0.04);
                iso_integrator *it = (iso_integrator *)&ctx; /* must become NULL */
                const iso_status status =
                    iso_integrator_create(ctx, m, &o.model, &(iso_method_options){.tolerance = 1e-9}, &it);
                gsl_test(serves != wanted || (status == ISO_OK) != serves, "%s serves the %s with k = %g: %d",
                         m->name, iso_systems[s]->name, k[i], serves);
                gsl_test(!serves &&
                             (status != ISO_BAD_ARGUMENT || it || strcmp(iso_context_about(ctx), "method") != 0),
                         "%s, refused for the %s: %s", m->name, iso_systems[s]->name, iso_context_message(ctx));
                iso_integrator_free(it);
            }
        }
}

int main(void)
{
    ctx = iso_context_create();
    check_formulas(0);
    check_formulas(1e4);
    check_room();
    check_needs();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

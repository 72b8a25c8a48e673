/* What task/cost/cost.h does not measure, gives up, and stops. */
#include "costs.h"
#include "studies.h"
#include "task/cost/cost_impl.h"

/* --- refusals and ends ------------------------------------------------------------------------------------------ */

static void refuse(const iso_scene *s, const iso_cost_options *o, iso_status status, const char *field)
{
    iso_cost *c;
    const iso_status got = iso_cost_measure(ctx, s, o, &c);
    gsl_test(got != status || c || strcmp(iso_context_about(ctx), field) != 0, "refused about '%s': %s", field,
             iso_context_message(ctx));
}

static void check_refusals(void)
{
    const iso_cost_options all = iso_cost_defaults();
    iso_cost_options o = all;
    iso_scene s = cost_scene(ctx, 0.7, (const double[]){1, 2, 4}, 0);
    refuse(&s, &all, ISO_BAD_ARGUMENT, "end");
    s.end = INFINITY;
    refuse(&s, &all, ISO_BAD_ARGUMENT, "end");
    s.end = 10;
    o.backend = ISO_BACKEND_EXACT;
    refuse(&s, &o, ISO_BAD_ARGUMENT, "k");
    o = all;
    o.tolerance = 0.5;
    refuse(&s, &o, ISO_BAD_ARGUMENT, "tolerance");
    o = all;
    o.backend = ISO_BACKEND_BALL;
    o.method = iso_method_find("strang");
    refuse(&s, &o, ISO_BAD_ARGUMENT, "method");
    s.effects.on[ISO_GRAVITY] = true;
    GRAVITY_MGB(&s.effects) = 1;
    GRAVITY_UP(&s.effects)[2] = 1;
    o.method = NULL;
    o.backend = ISO_BACKEND_POINT;
    refuse(&s, &o, ISO_NOT_MAPPED, "gravity");
    GRAVITY_MGB(&s.effects) = NAN;
    refuse(&s, &all, ISO_BAD_INPUT, "mgb");
}

/* A method that cannot get there in time does not hold up the others. */
static void check_hopeless(void)
{
    const iso_scene s = cost_plane(ctx);
    iso_cost_options o = iso_cost_defaults();
    o.seconds = 0.5;
    o.method = iso_method_find("strang");
    iso_cost *c = cost_of(ctx, &s, &o);
    const iso_cost_cell *last = &c->cell[c->cells - 1];
    gsl_test(last->status != ISO_STOPPED || last->repeats > 0 || !strstr(last->why, "not tried"), "hopeless: %s",
             last->why);
    gsl_test(!cost_is_measured(&c->cell[0]) || !c->complete, "what is loose is measured");
    gsl_test(!(c->seconds < 50), "it ends, after %.2g s for 0.5", c->seconds);
    iso_cost_free(c);
}

static void check_stops(void)
{
    const iso_scene s = cost_plane(ctx);
    iso_cost_options o = iso_cost_defaults();
    iso_cost *c = NULL;
    int left = 0;
    o.quick = true;
    iso_context_set_monitor(ctx, some_times, &left);
    gsl_test(iso_cost_measure(ctx, &s, &o, &c) != ISO_STOPPED || c, "stopped at once, nothing is told");
    left = 2000;
    gsl_test(iso_cost_measure(ctx, &s, &o, &c) != ISO_STOPPED || !c || c->complete || c->cells == 0,
             "stopped later, there is what was measured");
    iso_cost_free(c);
    iso_context_set_monitor(ctx, NULL, NULL);
}

int main(void)
{
    ctx = iso_context_create();
    check_refusals();
    check_stops();
    check_hopeless();
    iso_context_free(ctx);
    return gsl_test_summary();
}

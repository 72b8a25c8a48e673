/* How error grows with the length of an orbit (study/cost/cost.h): by a power, or as neighbours part. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>

#include "base/vec3_impl.h"
#include "costs.h"
#include "study/cost/cost_impl.h"

static iso_context *ctx;

/* --- growth ----------------------------------------------------------------------------------------------------- */

static iso_cost_growth grow(const iso_scene *s, const char *method, double tolerance, int horizons)
{
    iso_cost_growth g;
    const iso_cost_cell cell = {
        .backend = ISO_BACKEND_BALL, .method = iso_method_find(method), .tolerance = tolerance};
    if (iso_cost_grow(ctx, s, &cell, horizons, &g) != ISO_OK) scene_stops("growth", ctx);
    return g;
}

/* The e-fold time of the distance of two orbits that start 1e-13 apart, over [end, 4 end]. */
static double lyapunov_time(const iso_scene *s)
{
    iso_sample a, b;
    iso_orbit *one, *other;
    iso_scene moved = *s;
    iso_orbit_options o = iso_orbit_defaults(&s->start);
    double distance[2], aside[3];
    o.method = iso_method_find("taylor_extended");
    o.tolerance = 1e-15;
    cross(s->start.y + 3, s->start.y, aside); /* another speed would be the same path */
    add_scaled(moved.start.y, 1e-13, aside);
    if (iso_orbit_create(ctx, &s->params, &s->start, &o, &one) != ISO_OK ||
        iso_orbit_create(ctx, &s->params, &moved.start, &o, &other) != ISO_OK)
        scene_stops("an orbit", ctx);
    for (int i = 0; i < 2; i++) {
        const double t = (1 + 3 * i) * s->end;
        if (iso_orbit_at(one, t, &a) != ISO_OK || iso_orbit_at(other, t, &b) != ISO_OK) scene_stops("an orbit", ctx);
        distance[i] = fmax(relative_difference(a.ball, b.ball), relative_difference(a.ball + 3, b.ball + 3));
    }
    iso_orbit_free(one);
    iso_orbit_free(other);
    return 3 * s->end / log(distance[1] / distance[0]);
}

static void check_growth(void)
{
    iso_scene s = cost_plane(ctx);
    iso_cost_growth g = grow(&s, "rk8pd", 1e-9, 7);
    gsl_test(g.count != 7 || g.at[6].end != 64 * s.end || g.chaotic, "seven horizons of a regular orbit");
    gsl_test(!(g.power > 0.8 && g.power < 2.3), "its error grows like t^%.2f", g.power);
    gsl_test(!isnan(g.lyapunov_time), "it has no Lyapunov time");
    for (int i = 1; i < g.count; i++)
        gsl_test(!(g.at[i].error >= g.at[i - 1].error), "t = %g: error %.1e, never less", g.at[i].end, g.at[i].error);
    printf("time grows like t^%.2f\n", g.time_power);
    s = cost_scene(ctx, 0.3, (const double[]){1, 2, 5}, 60);
    g = grow(&s, "rk8pd", 1e-12, 5);
    gsl_test(!g.chaotic, "a chaotic orbit: t^%.2f", g.power);
    gsl_test(!(fabs(log(g.lyapunov_time / lyapunov_time(&s))) < log(1.5)), "Lyapunov time %.3g, of neighbours %.3g",
             g.lyapunov_time, lyapunov_time(&s));
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx) return 1;
    check_growth();
    iso_context_free(ctx);
    return gsl_test_summary();
}

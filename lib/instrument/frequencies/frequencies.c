/* frequencies.c - the frequencies of a motion, see frequencies.h: from the closed solution where there is one, else
 * the estimate of frequencies_estimate.c. */
#include "instrument/frequencies/frequencies.h"
#include "orbit/orbit_impl.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "exact/coordinates_impl.h"
#include "exact/exact_impl.h"
#include "instrument/frequencies/frequencies_impl.h"
#include "instrument/frequencies/momentum.h"
#include "model/model_impl.h"

/* --- the closed solution ---------------------------------------------------------------------------------------- */

/* "least", "middle", "largest" moment, of the caller's axis 0 to 2 */
static const char *rank(const double J[3], int axis)
{
    int smaller = 0, larger = 0;
    for (int i = 0; i < 3; i++) {
        smaller += J[i] < J[axis];
        larger += J[i] > J[axis];
    }
    return smaller == 0 && larger == 0 ? "equal" : smaller == 0 ? "least" : larger == 0 ? "largest" : "middle";
}

static void say_separated(const iso_momentum *m, const double J[3], iso_momentum_part part, iso_frequencies *f)
{
    const int turning = part == ISO_TURNS_ABOUT_1 ? 1 : 0, axis = m->axis[turning == 1 ? 0 : 2];
    iso_angle *turns = &f->angle[turning], *swings = &f->angle[1 - turning];
    snprintf(f->motion, sizeof f->motion,
             "turns about axis %d (%s moment) and swings %s the plane perpendicular to it", axis + 1, rank(J, axis),
             part == ISO_ON_ONE_SIDE ? "on one side of" : "through");
    snprintf(turns->what, sizeof turns->what, "%c turns about axis %d", "uv"[turning], axis + 1);
    snprintf(swings->what, sizeof swings->what, "%c swings %s", "vu"[turning],
             part == ISO_ON_ONE_SIDE ? "towards the axis and back" : "along the axis");
    if (part != ISO_SWINGS_ABOUT_3) return;
    snprintf(f->motion, sizeof f->motion, "swings about axis %d (%s moment), both ways", axis + 1, rank(J, axis));
    for (int i = 0; i < 2; i++)
        snprintf(f->angle[i].what, sizeof f->angle[i].what, "%c swings along axis %d", "uv"[i], m -> axis[i] + 1);
}

static void say_symmetric(const iso_params *p, iso_frequencies *f)
{
    int axis = 0; /* the first, as in lib/exact, where all three are equal */
    while (axis < 2 && !iso_params_symmetric(p, axis)) axis++;
    snprintf(f->motion, sizeof f->motion, "turns about the axis of symmetry %d and swings along it", axis + 1);
    snprintf(f->angle[0].what, sizeof f->angle[0].what, "swings along the axis");
    snprintf(f->angle[1].what, sizeof f->angle[1].what, "turns about axis %d", axis + 1);
}

/* Whether the rotation about an axis is unstable, where the problem separates. */
static bool is_unstable(const iso_problem *f, int axis)
{
    iso_bifurcation list[ISO_MOST_BIFURCATIONS];
    bool unstable = false;
    for (int i = iso_bifurcations(f, list) - 1; i >= 0; i--)
        unstable = unstable || (list[i].axis == axis && list[i].separatrix);
    return unstable;
}

/* M lies along an axis, gamma in the plane perpendicular to it. */
static void say_plane(const iso_problem *problem, const double M[3], iso_frequencies *f)
{
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(M[i]) > fabs(M[axis])) axis = i;
    snprintf(f->motion, sizeof f->motion, "rotation about axis %d (%s moment), in a principal plane%s", axis + 1,
             rank(problem->p.J, axis), is_unstable(problem, axis) ? ": unstable" : "");
    snprintf(f->angle[0].what, sizeof f->angle[0].what, "turns about axis %d", axis + 1);
}

static void say(const iso_orbit *orbit, const iso_sample *start, const iso_exact_torus *torus, iso_frequencies *f)
{
    const iso_problem *problem = &iso_orbit_model(orbit)->problem;
    const double *J = problem->p.J;
    iso_momentum m;
    switch (torus->kind) {
    case ISO_EXACT_SEPARATED:
        if (!iso_momentum_make(&problem->p, problem->energy, &m)) return;
        const double F = m.k == 1 ? 2 * torus->c : -2 * torus->c / m.det_J;
        say_separated(&m, J, iso_momentum_find(&m, iso_energy(&problem->p, problem->eps), F), f);
        break;
    case ISO_EXACT_SYMMETRIC: say_symmetric(&problem->p, f); break;
    case ISO_EXACT_PLANE: say_plane(problem, start->point, f); break;
    case ISO_EXACT_SEPARATRIX:
        snprintf(f->motion, sizeof f->motion,
                 "leaves an unstable rotation and comes back to it, once: the separatrix");
        break;
    case ISO_EXACT_REST: snprintf(f->motion, sizeof f->motion, "rests"); break;
    case ISO_EXACT_KINDS: break;
    }
}

/* How far the constant of the separation is from those of the unstable rotations, computed without cancellation. */
static void find_separatrices(const iso_orbit *orbit, const double point[ISO_STATE], iso_frequencies *f)
{
    const iso_problem *problem = &iso_orbit_model(orbit)->problem;
    iso_bifurcation list[ISO_MOST_BIFURCATIONS];
    iso_conical at;
    double excess[3];
    iso_separation_coordinates(&problem->p, point, &at);
    const double c = iso_separation_constant(problem, &at, excess);
    const int count = iso_bifurcations(problem, list);
    for (int i = 0; i < count; i++) {
        if (!list[i].separatrix || list[i].axis < 0 || f->separatrices == ISO_SEPARATRICES) continue;
        const int axis = list[i].axis;
        iso_separatrix *s = &f->separatrix[f->separatrices++];
        for (int j = 0; j < 3; j++)
            if (at.axis[j] == axis) s->distance = excess[j] / fmax(fabs(c), fabs(list[i].c));
        snprintf(s->what, sizeof s->what, "rotation about axis %d (%s moment)", axis + 1, rank(problem->p.J, axis));
    }
}

/* The torus in the caller's units. */
static void carry(const iso_orbit *orbit, const iso_exact_torus *torus, iso_frequencies *f)
{
    const iso_units *units = iso_orbit_units(orbit);
    const int k = iso_orbit_model(orbit)->problem.p.k < 0 ? -1 : 1;
    const iso_dimension M = iso_system_point.fast_dimension;
    const iso_dimension c = {2 * M.J - k, 2 * M.J_2k, 2 * M.w}; /* M^2 b */
    f->kind = torus->kind;
    f->angles = torus->angles;
    f->c = torus->c * iso_unit(units, c);
    for (int i = 0; i < f->angles; i++) {
        f->angle[i].action = torus->action[i] * iso_unit(units, M);
        for (iso_clock clock = 0; clock < ISO_CLOCKS; clock++)
            f->angle[i].frequency[clock] = torus->frequency[clock][i] / iso_unit(units, iso_clock_dimension(clock));
    }
}

/* The start of the orbit in its own units, and its closed solution. */
static iso_status solve(iso_context *ctx, const iso_orbit *orbit, const iso_sample *start, double point[ISO_STATE],
                        iso_exact **exact)
{
    static const bool all[ISO_CLOCKS] = {true, true, true};
    const double unit = iso_unit(iso_orbit_units(orbit), iso_system_point.fast_dimension);
    copy(start->point, point, ISO_STATE);
    for (int i = 0; i < 3; i++) point[i] /= unit;
    return iso_exact_create(ctx, &iso_orbit_model(orbit)->problem, point, all, exact);
}

static iso_status find_exact(iso_context *ctx, const iso_scene *scene, iso_frequencies *f)
{
    const iso_effects effects = iso_scene_acting(scene);
    const iso_effect *breaking = iso_effects_breaking(&effects), *more = iso_effects_beyond_level(&effects);
    iso_orbit *orbit;
    iso_sample start;
    iso_exact *exact = NULL;
    double point[ISO_STATE];
    iso_frequencies_blank(f);
    iso_status status = iso_frequencies_open(ctx, scene, &effects, &orbit, &start);
    f->estimated = status == ISO_OK && (breaking || more);
    if (f->estimated) {
        snprintf(f->why, sizeof f->why,
                 breaking ? "'%s' breaks the isomorphism"
                          : "the frequencies of the closed solution are for a free motion, not one with '%s'",
                 breaking ? breaking->name : more->name);
    } else if (status == ISO_OK) {
        status = solve(ctx, orbit, &start, point, &exact);
        if (status != ISO_OK) {
            f->unresolved = status == ISO_NUMERICAL;
            f->estimated = f->unresolved || status == ISO_BAD_ARGUMENT;
            snprintf(f->why, sizeof f->why, "%s", iso_context_message(ctx));
        }
    }
    if (exact) {
        const iso_exact_torus torus = iso_exact_describe(exact);
        carry(orbit, &torus, f);
        say(orbit, &start, &torus, f);
        find_separatrices(orbit, point, f);
        iso_frequencies_place(orbit, &start, f);
        iso_frequencies_finish(f);
    }
    iso_exact_free(exact);
    iso_orbit_free(orbit);
    return f->estimated ? ISO_OK : status;
}

iso_status iso_frequencies_find(iso_context *ctx, const iso_scene *scene, const iso_frequencies_options *options,
                                iso_frequencies *f)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_frequencies_options own = iso_frequencies_defaults();
    if (options) own = *options;
    iso_status status = iso_frequencies_check(ctx, &own);
    if (status == ISO_OK) status = find_exact(ctx, scene, f);
    if (status != ISO_OK || !f->estimated) return status;
    const bool unresolved = f->unresolved;
    char why[sizeof f->why];
    memcpy(why, f->why, sizeof why);
    status = iso_frequencies_estimate(ctx, scene, &own, f);
    memcpy(f->why, why, sizeof why);
    f->unresolved = unresolved;
    return status;
}

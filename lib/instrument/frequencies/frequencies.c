/* frequencies.c - the frequencies of a motion, see frequencies.h: from the closed solution where there is one, else
 * the estimate of frequencies_estimate.c; and what both share: the orbit at its start, where the motion lies in its
 * family, and what follows from two frequencies (frequency ratio, resonances). */
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
#include "model/model_impl.h"
#include "study/study_impl.h"

#define PRINT(text, ...) snprintf(text, sizeof(text), __VA_ARGS__)

iso_status iso_frequencies_check(iso_context *ctx, const iso_frequencies_options *o)
{
    if (o->samples > ISO_MOST_SAMPLES)
        return ISO_FAIL_ARGUMENT(ctx, "samples", "an estimate takes %d samples at most", ISO_MOST_SAMPLES);
    if (!(o->turns <= 0) && !(o->end <= 0) && !(o->samples <= 0)) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "", "turns, the end and samples are numbers > 0");
}

iso_status iso_frequencies_open(iso_context *ctx, const iso_scene *scene, const iso_effects *effects,
                                iso_orbit **orbit, iso_sample *sample, iso_frequencies *f)
{
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    const bool twin = !iso_effects_breaking(effects);
    *orbit = NULL;
    *f = (iso_frequencies){
        .kind = ISO_EXACT_KINDS, .h = NAN, .eps = NAN, .H = NAN, .F = NAN, .c = NAN, .ratio = NAN};
    f->estimate.axis = -1;
    for (int i = 0; i < 2; i++) f->angle[i].drift = f->angle[i].action = NAN;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        f->closed[c] = NAN;
        for (int i = 0; i < 2; i++) f->angle[i].frequency[c] = f->angle[i].period[c] = f->angle[i].error[c] = NAN;
    }
    o.effects = effects;
    o.backend = twin ? ISO_BACKEND_POINT : ISO_BACKEND_BALL;
    o.shown = twin ? ISO_SHOW_BOTH : ISO_SHOW_BALL;
    ISO_TRY(iso_refuse_rest(ctx, &scene->start, effects, ISO_NO_FREQUENCIES));
    ISO_TRY(iso_orbit_create(ctx, &scene->params, &scene->start, &o, orbit));
    return iso_orbit_at(*orbit, 0, sample);
}

void iso_frequencies_place(const iso_orbit *orbit, const iso_sample *start, iso_frequencies *f)
{
    double size;
    f->h = iso_orbit_energy(orbit);
    if (iso_orbit_has_twin(orbit)) { /* then the model is the point's, and its level is H */
        const iso_dimension M = iso_system_point.fast_dimension;
        f->eps = iso_orbit_coupling(orbit);
        f->H = iso_orbit_model(orbit)->problem.energy *
               iso_unit(iso_orbit_units(orbit), (iso_dimension){2 * M.J, 2 * M.J_2k, 2 * M.w});
    }
    f->integral = iso_orbit_additional_integral(orbit);
    if (!f->integral) return;
    f->F = iso_orbit_integral(orbit, &iso_system_ball, f->integral, start, &size);
    f->F *= iso_unit(iso_orbit_units(orbit), f->integral->dimension);
}

/* --- frequency ratio and resonances ----------------------------------------------------------------------------- */

/* A fraction q/p near the frequency ratio. Frequencies from the closed solution are known to rounding. */
static iso_resonance resonance_of(const iso_frequencies *f, int p, int q)
{
    iso_resonance r = {.p = p, .q = q, .gap = INFINITY, .met = true};
    for (int c = 0; c < ISO_CLOCKS; c++) {
        const double one = p * f->angle[0].frequency[c], other = q * f->angle[1].frequency[c],
                     gap = fabs(one - other);
        const double errors = p * f->angle[0].error[c] + q * f->angle[1].error[c];
        const bool met = gap <= 1e-14 * one + (f->estimated ? errors : 0);
        r.beat[c] = isnan(gap) ? NAN : met ? INFINITY : 2 * ISO_PI / gap;
        if (isnan(gap)) continue;
        r.gap = fmin(r.gap, gap / one);
        r.met = r.met && met;
    }
    return r;
}

/* The convergents of the frequency ratio's continued fraction. */
static void find_resonances(iso_frequencies *f)
{
    double rest = f->ratio;
    int q = 1, p = 0, q_before = 0, p_before = 1; /* q/p, from 1/0 and 0/1 */
    while (f->resonances < ISO_MAX_RESONANCES && rest < 1e3) {
        const int whole = (int)floor(rest), q_next = whole * q + q_before, p_next = whole * p + p_before;
        if (q_next > 100 || p_next > 100) return;
        q_before = q, p_before = p, q = q_next, p = p_next;
        if (q > 0) f->resonance[f->resonances++] = resonance_of(f, p, q);
        if (f->resonances > 0 && f->resonance[f->resonances - 1].met) return;
        rest = 1 / (rest - whole);
    }
}

void iso_frequencies_finish(iso_frequencies *f)
{
    static const double MOST_UNEXPLAINED = 0.5;
    const iso_estimate *e = &f->estimate;
    for (int i = 0; i < f->angles; i++)
        for (int c = 0; c < ISO_CLOCKS; c++) f->angle[i].period[c] = 2 * ISO_PI / f->angle[i].frequency[c];
    if (f->angles == 2 && (!f->estimated || (e->verdict != ISO_CHAOTIC && !(e->unexplained > MOST_UNEXPLAINED)))) {
        f->ratio = f->angle[0].frequency[ISO_CLOCK_T] / f->angle[1].frequency[ISO_CLOCK_T];
        find_resonances(f);
    }
    /* An orbit is closed if it has one angle, or if a resonance is met exactly, which an estimate cannot decide. */
    const iso_resonance *last = f->resonances > 0 ? &f->resonance[f->resonances - 1] : NULL;
    const double turns = f->angles == 1 ? 1 : last && last->met ? last->q * 1.0 : (double)NAN;
    for (int c = 0; c < ISO_CLOCKS && !f->estimated; c++) f->closed[c] = turns * f->angle[0].period[c];
}

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

static void describe_separated(const iso_problem *problem, double c, iso_frequencies *f)
{
    const double *J = problem->p.J;
    iso_momentum m;
    if (!iso_momentum_make(&problem->p, problem->energy, &m)) return;
    const iso_momentum_part part =
        iso_momentum_find(&m, iso_energy(&problem->p, problem->eps), m.k == 1 ? 2 * c : -2 * c / m.det_J);
    const int turning = part == ISO_TURNS_ABOUT_1 ? 1 : 0, axis = m.axis[turning == 1 ? 0 : 2];
    if (part == ISO_SWINGS_ABOUT_3) {
        PRINT(f->motion, "swings about axis %d (%s moment), both ways", axis + 1, rank(J, axis));
        for (int i = 0; i < 2; i++) PRINT(f->angle[i].what, "%c swings along axis %d", "uv"[i], m.axis[i] + 1);
        return;
    }
    const bool one_side = part == ISO_ON_ONE_SIDE;
    PRINT(f->motion, "turns about axis %d (%s moment) and swings %s the plane perpendicular to it", axis + 1,
          rank(J, axis), one_side ? "on one side of" : "through");
    PRINT(f->angle[turning].what, "%c turns about axis %d", "uv"[turning], axis + 1);
    PRINT(f->angle[1 - turning].what, "%c swings %s", "vu"[turning],
          one_side ? "towards the axis and back" : "along the axis");
}

static void describe_motion(const iso_problem *problem, const iso_sample *start, const iso_exact_torus *torus,
                            iso_frequencies *f)
{
    iso_bifurcation list[ISO_MOST_BIFURCATIONS];
    bool unstable = false;
    int axis = 0;
    switch (torus->kind) {
    case ISO_EXACT_SEPARATED: describe_separated(problem, torus->c, f); break;
    case ISO_EXACT_SYMMETRIC: /* about the first axis, as in lib/exact, where all three moments are equal */
        while (axis < 2 && !iso_params_symmetric(&problem->p, axis)) axis++;
        PRINT(f->motion, "turns about the axis of symmetry %d and swings along it", axis + 1);
        PRINT(f->angle[0].what, "swings along the axis");
        PRINT(f->angle[1].what, "turns about axis %d", axis + 1);
        break;
    case ISO_EXACT_PLANE: /* M lies along an axis, gamma in the plane perpendicular to it */
        for (int i = 1; i < 3; i++)
            if (fabs(start->point[i]) > fabs(start->point[axis])) axis = i;
        for (int i = iso_bifurcations(problem, list) - 1; i >= 0; i--)
            unstable = unstable || (list[i].axis == axis && list[i].separatrix);
        PRINT(f->motion, "rotation about axis %d (%s moment), in a principal plane%s", axis + 1,
              rank(problem->p.J, axis), unstable ? ": unstable" : "");
        PRINT(f->angle[0].what, "turns about axis %d", axis + 1);
        break;
    case ISO_EXACT_SEPARATRIX:
        PRINT(f->motion, "leaves an unstable rotation and comes back to it, once: the separatrix");
        break;
    case ISO_EXACT_REST: PRINT(f->motion, "rests"); break;
    case ISO_EXACT_KINDS: break;
    }
}

/* How far the constant of the separation is from those of the unstable rotations, computed without cancellation. */
static void find_separatrices(const iso_problem *problem, const double point[ISO_STATE], iso_frequencies *f)
{
    iso_bifurcation list[ISO_MOST_BIFURCATIONS];
    iso_conical at;
    double excess[3];
    iso_separation_coordinates(&problem->p, point, &at);
    const double c = iso_separation_constant(problem, &at, excess);
    const int count = iso_bifurcations(problem, list);
    for (int i = 0; i < count; i++) {
        const int axis = list[i].axis;
        if (!list[i].separatrix || axis < 0 || f->separatrices == ISO_SEPARATRICES) continue;
        iso_separatrix *s = &f->separatrix[f->separatrices++];
        for (int j = 0; j < 3; j++)
            if (at.axis[j] == axis) s->distance = excess[j] / fmax(fabs(c), fabs(list[i].c));
        PRINT(s->what, "rotation about axis %d (%s moment)", axis + 1, rank(problem->p.J, axis));
    }
}

/* The closed solution, in the caller's units; if there is none, why. */
static iso_status solve(iso_context *ctx, const iso_orbit *orbit, const iso_sample *start, iso_frequencies *f)
{
    static const bool all[ISO_CLOCKS] = {true, true, true};
    const iso_problem *problem = &iso_orbit_model(orbit)->problem;
    const iso_units *units = iso_orbit_units(orbit);
    const iso_dimension M = iso_system_point.fast_dimension;
    const iso_dimension c = {2 * M.J - (problem->p.k < 0 ? -1 : 1), 2 * M.J_2k, 2 * M.w}; /* M^2 b */
    iso_exact *exact;
    double point[ISO_STATE];
    copy(start->point, point, ISO_STATE);
    for (int i = 0; i < 3; i++) point[i] /= iso_unit(units, M);
    const iso_status status = iso_exact_create(ctx, problem, point, all, &exact);
    if (status != ISO_OK) {
        f->unresolved = status == ISO_NUMERICAL;
        f->estimated = f->unresolved || status == ISO_BAD_ARGUMENT;
        PRINT(f->why, "%s", iso_context_message(ctx));
        return f->estimated ? ISO_OK : status;
    }
    const iso_exact_torus torus = iso_exact_describe(exact);
    iso_exact_free(exact);
    f->kind = torus.kind;
    f->angles = torus.angles;
    f->c = torus.c * iso_unit(units, c);
    for (int i = 0; i < f->angles; i++) {
        f->angle[i].action = torus.action[i] * iso_unit(units, M);
        for (iso_clock clock = 0; clock < ISO_CLOCKS; clock++)
            f->angle[i].frequency[clock] = torus.frequency[clock][i] / iso_unit(units, iso_clock_dimension(clock));
    }
    describe_motion(problem, start, &torus, f);
    find_separatrices(problem, point, f);
    iso_frequencies_place(orbit, start, f);
    iso_frequencies_finish(f);
    return ISO_OK;
}

iso_status iso_frequencies_find(iso_context *ctx, const iso_scene *scene, const iso_frequencies_options *options,
                                iso_frequencies *f)
{
    ISO_DEFAULT_ARITHMETIC;
    const iso_effects effects = iso_scene_acting(scene);
    const iso_effect *breaking = iso_effects_breaking(&effects), *more = iso_effects_beyond_level(&effects);
    iso_orbit *orbit;
    iso_sample start;
    ISO_TRY(iso_frequencies_check(ctx, options));
    iso_status status = iso_frequencies_open(ctx, scene, &effects, &orbit, &start, f);
    f->estimated = status == ISO_OK && (breaking || more);
    if (f->estimated)
        PRINT(f->why,
              breaking ? "'%s' breaks the isomorphism"
                       : "the frequencies of the closed solution are for a free motion, not one with '%s'",
              breaking ? breaking->name : more->name);
    else if (status == ISO_OK)
        status = solve(ctx, orbit, &start, f);
    iso_orbit_free(orbit);
    if (status != ISO_OK || !f->estimated) return status;
    const iso_frequencies before = *f;
    status = iso_frequencies_estimate(ctx, scene, options, f);
    memcpy(f->why, before.why, sizeof f->why);
    f->unresolved = before.unresolved;
    return status;
}

#include "study/frequencies.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "exact/coordinates.h"
#include "map/state.h"
#include "study/frequencies_impl.h"

iso_frequencies_options iso_frequencies_defaults(void)
{
    return (iso_frequencies_options){.turns = NAN, .end = NAN, .samples = NAN};
}

iso_status iso_frequencies_check(iso_context *ctx, const iso_frequencies_options *o)
{
    if (o->samples > ISO_MOST_SAMPLES)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "samples", "an estimate takes %d samples at most",
                                ISO_MOST_SAMPLES);
    if (!(o->turns <= 0) && !(o->end <= 0) && !(o->samples <= 0)) return ISO_OK;
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "", "turns, the end and samples are numbers > 0");
}

void iso_frequencies_blank(iso_frequencies *f)
{
    *f = (iso_frequencies){
        .kind = ISO_EXACT_KINDS, .h = NAN, .eps = NAN, .H = NAN, .F = NAN, .c = NAN, .rotation = NAN};
    for (int c = 0; c < ISO_CLOCKS; c++) f->closed[c] = NAN;
    for (int i = 0; i < 2; i++) {
        iso_angle *a = &f->angle[i];
        a->drift = a->action = NAN;
        for (int c = 0; c < ISO_CLOCKS; c++) a->frequency[c] = a->period[c] = a->error[c] = NAN;
    }
    f->estimate.axis = -1;
}

/* --- rotation number and resonances ----------------------------------------------------------------------------- */

/* A fraction q/p near the rotation number. Frequencies from the closed solution are known to rounding. */
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

/* The convergents of the rotation number's continued fraction. */
static void find_resonances(iso_frequencies *f)
{
    double rest = f->rotation;
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

/* Of one angle, or where a resonance is met; estimates do not tell. */
static void find_closed(iso_frequencies *f)
{
    const iso_resonance *last = f->resonances > 0 ? &f->resonance[f->resonances - 1] : NULL;
    const double turns = f->angles == 1 ? 1 : last && last->met ? last->q * 1.0 : (double)NAN;
    for (int c = 0; c < ISO_CLOCKS && !f->estimated; c++) f->closed[c] = turns * f->angle[0].period[c];
}

void iso_frequencies_finish(iso_frequencies *f)
{
    for (int i = 0; i < f->angles; i++)
        for (int c = 0; c < ISO_CLOCKS; c++) f->angle[i].period[c] = 2 * ISO_PI / f->angle[i].frequency[c];
    const bool steady = !f->estimated || f->estimate.verdict != ISO_CHAOTIC;
    if (f->angles == 2 && steady) {
        f->rotation = f->angle[0].frequency[ISO_CLOCK_T] / f->angle[1].frequency[ISO_CLOCK_T];
        find_resonances(f);
    }
    find_closed(f);
}

/* --- where the motion is in its family -------------------------------------------------------------------------- */

/* The ball's integral beyond the energy and the constraints. */
static const iso_integral *further_integral(const iso_orbit *orbit)
{
    const iso_field *field = &iso_orbit_model(orbit)->field;
    for (const iso_integral *i = iso_system_ball.integrals + 1; i->name; i++)
        if (i->known == ISO_ANY_VALUE && (!i->holds || i->holds(field))) return i;
    return NULL;
}

void iso_frequencies_place(const iso_orbit *orbit, const iso_sample *start, iso_frequencies *f)
{
    double size;
    f->h = iso_orbit_energy(orbit);
    f->eps = iso_orbit_has_twin(orbit) ? iso_orbit_coupling(orbit) : NAN;
    if (iso_orbit_has_twin(orbit)) { /* frequencies are asked of the point's model then */
        const iso_dimension M = iso_system_point.fast_dimension;
        f->H = iso_orbit_model(orbit)->field.energy *
               iso_unit(iso_orbit_units(orbit), (iso_dimension){2 * M.J, 2 * M.J_2k, 2 * M.w});
    }
    f->integral = further_integral(orbit);
    if (!f->integral) return;
    f->F = iso_orbit_integral(orbit, &iso_system_ball, f->integral, start, &size);
    f->F *= iso_unit(iso_orbit_units(orbit), f->integral->dimension);
}

iso_status iso_frequencies_open(iso_context *ctx, const iso_scene *scene, const iso_effects *effects,
                                iso_orbit **orbit, iso_sample *sample)
{
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    const bool twin = !iso_effects_breaking(effects);
    *orbit = NULL;
    o.effects = effects;
    o.backend = twin ? ISO_POINT : ISO_BALL;
    o.show = twin ? ISO_BOTH : ISO_BALL;
    iso_status status = iso_orbit_create(ctx, &scene->params, &scene->start, &o, orbit);
    if (status == ISO_OK) status = iso_orbit_at(*orbit, 0, sample);
    return status;
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

static void say_separated(const iso_momentum *m, const double J[3], iso_momentum_part part, iso_frequencies *f)
{
    const int turning = part == ISO_TURNS_ABOUT_1 ? 1 : 0, axis = m->axis[turning == 1 ? 0 : 2];
    iso_angle *turns = &f->angle[turning], *swings = &f->angle[1 - turning];
    snprintf(f->motion, sizeof f->motion, "turns about axis %d, of the %s moment, and swings %s the plane across it",
             axis + 1, rank(J, axis), part == ISO_ON_ONE_SIDE ? "on one side of" : "through");
    snprintf(turns->what, sizeof turns->what, "%c turns about axis %d", "uv"[turning], axis + 1);
    snprintf(swings->what, sizeof swings->what, "%c swings %s", "vu"[turning],
             part == ISO_ON_ONE_SIDE ? "towards the axis and back" : "along the axis");
    if (part != ISO_SWINGS_ABOUT_3) return;
    snprintf(f->motion, sizeof f->motion, "swings about axis %d, of the %s moment, both ways", axis + 1,
             rank(J, axis));
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

/* Where the problem separates. */
static bool is_unstable(const iso_field *f, int axis)
{
    iso_bifurcation list[ISO_MOST_BIFURCATIONS];
    bool unstable = false;
    for (int i = iso_bifurcations(f, list) - 1; i >= 0; i--)
        unstable = unstable || (list[i].axis == axis && list[i].separatrix);
    return unstable;
}

/* M along an axis, gamma in the plane across it */
static void say_plane(const iso_field *field, const double M[3], iso_frequencies *f)
{
    int axis = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(M[i]) > fabs(M[axis])) axis = i;
    snprintf(f->motion, sizeof f->motion, "rotation about axis %d, of the %s moment, in a principal plane%s",
             axis + 1, rank(field->p.J, axis), is_unstable(field, axis) ? ": unstable" : "");
    snprintf(f->angle[0].what, sizeof f->angle[0].what, "turns about axis %d", axis + 1);
}

static void say(const iso_orbit *orbit, const iso_sample *start, const iso_exact_torus *torus, iso_frequencies *f)
{
    const iso_field *field = &iso_orbit_model(orbit)->field;
    const double *J = field->p.J;
    iso_momentum m;
    switch (torus->kind) {
    case ISO_EXACT_SEPARATED:
        if (!iso_momentum_make(&field->p, field->energy, &m)) return;
        const double F = m.k == 1 ? 2 * torus->c : -2 * torus->c / m.det_J;
        say_separated(&m, J, iso_momentum_find(&m, iso_energy(&field->p, field->eps), F), f);
        break;
    case ISO_EXACT_SYMMETRIC: say_symmetric(&field->p, f); break;
    case ISO_EXACT_PLANE: say_plane(field, start->point, f); break;
    case ISO_EXACT_SEPARATRIX:
        snprintf(f->motion, sizeof f->motion, "leaves an unstable rotation and comes back to it, once");
        break;
    case ISO_EXACT_REST: snprintf(f->motion, sizeof f->motion, "rests"); break;
    case ISO_EXACT_KINDS: break;
    }
}

/* How far the constant of separation is from those of the unstable rotations, without cancellation. */
static void find_separatrices(const iso_orbit *orbit, const double point[ISO_STATE], iso_frequencies *f)
{
    const iso_field *field = &iso_orbit_model(orbit)->field;
    iso_bifurcation list[ISO_MOST_BIFURCATIONS];
    iso_conical at;
    double excess[3];
    iso_separation_coordinates(&field->p, point, &at);
    const double c = iso_separation_constant(field, &at, excess);
    const int count = iso_bifurcations(field, list);
    for (int i = 0; i < count; i++) {
        if (!list[i].separatrix || list[i].axis < 0 || f->separatrices == ISO_SEPARATRICES) continue;
        const int axis = list[i].axis;
        iso_separatrix *s = &f->separatrix[f->separatrices++];
        for (int j = 0; j < 3; j++)
            if (at.axis[j] == axis) s->distance = excess[j] / fmax(fabs(c), fabs(list[i].c));
        snprintf(s->what, sizeof s->what, "the rotation about axis %d, of the %s moment", axis + 1,
                 rank(field->p.J, axis));
    }
}

/* The torus in the caller's units. */
static void carry(const iso_orbit *orbit, const iso_exact_torus *torus, iso_frequencies *f)
{
    const iso_units *units = iso_orbit_units(orbit);
    const int k = iso_orbit_model(orbit)->field.p.k < 0 ? -1 : 1;
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
    return iso_exact_create(ctx, &iso_orbit_model(orbit)->field, point, all, exact);
}

static iso_status find_exact(iso_context *ctx, const iso_scene *scene, iso_frequencies *f)
{
    const iso_effects effects = iso_effects_acting(&scene->effects);
    iso_orbit *orbit;
    iso_sample start;
    iso_exact *exact = NULL;
    double point[ISO_STATE];
    iso_frequencies_blank(f);
    iso_status status = iso_frequencies_open(ctx, scene, &effects, &orbit, &start);
    if (status == ISO_OK && !iso_effects_breaking(&effects)) {
        status = solve(ctx, orbit, &start, point, &exact);
        if (status != ISO_OK) {
            f->unresolved = status == ISO_NUMERICAL;
            f->estimated = f->unresolved || status == ISO_BAD_ARGUMENT;
            snprintf(f->why, sizeof f->why, "%s", iso_context_message(ctx));
        }
    } else if (status == ISO_OK) {
        f->estimated = true;
        snprintf(f->why, sizeof f->why, "'%s' breaks the isomorphism", iso_effects_breaking(&effects)->name);
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
    iso_status status = iso_frequencies_check(ctx, options);
    if (status == ISO_OK) status = find_exact(ctx, scene, f);
    if (status != ISO_OK || !f->estimated) return status;
    const bool unresolved = f->unresolved;
    char why[sizeof f->why];
    memcpy(why, f->why, sizeof why);
    status = iso_frequencies_estimate(ctx, scene, options, f);
    memcpy(f->why, why, sizeof why);
    f->unresolved = unresolved;
    return status;
}

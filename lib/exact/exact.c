/* exact.c - the public functions of the closed solution: they choose the form of the motion (form_impl.h), check what
 * is asked, and follow an orbit on a separatrix into the rotation at its end.
 */
#include "exact/exact_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/math_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "exact/form_impl.h"
#include "model/model_impl.h"

static const iso_form *const forms[] = {&iso_form_rest, &iso_form_revolution, &iso_form_separated, NULL};

/* An end of an orbit on a separatrix. Beyond these clocks the orbit is the unstable rotation, to all digits. */
typedef struct homoclinic_end {
    iso_exact *rotation; /* NULL: not on a separatrix */
    real clock[ISO_CLOCKS];
} homoclinic_end;

struct iso_exact {
    const iso_form *form;
    form_motion motion;
    double frame[9]; /* its rows are the axes in which the form works, in the caller's ... */
    bool turned;     /* ... if they are others                                            */
    iso_params params;
    bool has[ISO_CLOCKS];
    double moment[ISO_CLOCKS]; /* a short time in each clock, see find_moments */
    homoclinic_end past, future;
};

/* Errors: effects, numbers that are not finite or out of range, and a state that is not on the level. */
static iso_status check(iso_context *ctx, const iso_problem *f, const double point[ISO_STATE])
{
    const iso_effect *effect = iso_effects_beyond_rotor(&f->effects);
    if (!effect) effect = iso_effects_ball_only(&f->effects);
    if (effect)
        return ISO_FAIL_ARGUMENT(ctx, effect->name,
                                 "the closed solution is for a free motion or one with a rotor, not with '%s'",
                                 effect->name);
    const double *g = point + 3, square = dot(g, g);
    if (!all_finite(point, ISO_STATE) || !(square > 0))
        return ISO_FAIL_ARGUMENT(ctx, "", "the start is not finite, or gamma is zero");
    if (!(f->eps > 0 && isnormal(f->eps)))
        return ISO_FAIL_ARGUMENT(ctx, "eps", "the closed solution needs a coupling eps > 0");
    const double q = dot_diag(g, f->p.J, g) / square, fall = f->eps * pow(q, -1 / f->p.k), M2 = dot(point, point);
    const bool on_level = f->energy == 0 ? M2 > 0 : fabs(M2 / 2 - fall - f->energy) <= 1e-6 * (M2 / 2 + fall);
    if (isfinite(fall) && on_level) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, iso_level_name(), "this start is not on the level H = %s", ISO_SHORT(f->energy));
}

/* Three equal moments are equal about all axes: the third axis of the form is turned into K. */
static void turn_axes(iso_exact *x, iso_problem *f, double point[ISO_STATE])
{
    const double *K = iso_effects_rotor(&f->effects), size = norm(K);
    const int zeros = (K[0] == 0) + (K[1] == 0) + (K[2] == 0), least = fabs(K[0]) < fabs(K[1]) ? 0 : 1;
    double *const e1 = x->frame, *const e2 = e1 + 3, *const e3 = e2 + 3, own[3] = {0, 0, size}, y[ISO_STATE];
    x->turned = zeros < 2 && iso_params_symmetric(&f->p, 0) && iso_params_symmetric(&f->p, 1);
    if (!x->turned) return;
    for (int i = 0; i < 3; i++) e3[i] = K[i] / size, e1[i] = i == least;
    remove_along(e1, e3), remove_along(e1, e3);
    make_unit(e1);
    cross(e3, e1, e2);
    copy(point, y, ISO_STATE);
    for (int i = 0; i < ISO_STATE; i++) point[i] = dot(x->frame + 3 * (i % 3), y + i / 3 * 3);
    iso_effects_set_rotor(&f->effects, own);
}

/* The form for a start. Where only a start in a principal plane has a form, components that are zero but for rounding
 * are set to zero first. */
static iso_status find_form(iso_context *ctx, const iso_problem *f, double point[ISO_STATE], const iso_form **form)
{
    double snapped[ISO_STATE];
    for (int i = 0; i < ISO_STATE; i++)
        snapped[i] = fabs(point[i]) <= 4 * DBL_EPSILON * largest(point + i / 3 * 3) ? 0 : point[i];
    const double *const tried[] = {point, snapped};
    for (int i = 0; i < 2; i++)
        for (int j = 0; forms[j]; j++)
            if (forms[j]->serves(f, tried[i])) {
                *form = forms[j];
                copy(tried[i], point, ISO_STATE);
                return ISO_OK;
            }
    const iso_effect *rotor = iso_effects_beyond_level(&f->effects);
    if (rotor)
        return ISO_FAIL_ARGUMENT(
            ctx, rotor->name,
            "with '%s' there is a closed solution only where three moments of inertia are equal, where two are equal "
            "and K is along the third axis, or where the motion stays in a principal plane at right angles to K",
            rotor->name);
    if (f->p.k == 1)
        return ISO_FAIL_ARGUMENT(ctx, iso_level_name(), "k = 1 has a closed solution on the level H = 0 alone");
    return ISO_FAIL_ARGUMENT(ctx, "k",
                             "k = %.*g has a closed solution only where two moments of inertia are equal, or in a "
                             "principal plane; k = 1 and k = -1 have one everywhere",
                             fabs(fabs(f->p.k) - 1) < 1e-14 ? 17 : 15, f->p.k); /* 1 + 1e-15 must not read as 1 */
}

/* A time so short that gamma and M turn by a tenth of a radian at most, and the clocks' rates change by a tenth at
 * most. M' is the force and B gamma', with the field B = (b,gamma) of a rotor (model/effects/effect_rotor.c): M turns
 * at the rate B, which grows at the rates (b,gamma') and (b,gamma''). */
static void find_moments(const iso_problem *f, const double point[ISO_STATE], double moment[ISO_CLOCKS])
{
    const iso_params *p = &f->p;
    const double q = dot_diag(point + 3, p->J, point + 3), root_det = p->root_J[0] * p->root_J[1] * p->root_J[2];
    double rate[ISO_STATE], b[3], pushed[3]; /* gamma'' is gamma x M', and what B and M make of it */
    iso_system_point.rhs(f, point, rate);
    cross(point + 3, rate, pushed);
    diag(p->root_J, iso_effects_rotor(&f->effects), b);
    scale(b, root_det / (p->k * p->k) * pow(q, -1 - 1 / (2 * p->k)));
    const double field = fabs(dot(b, point + 3)) + sqrt(fabs(dot(b, rate + 3))) + cbrt(fabs(dot(b, pushed)));
    const double turning = norm(point) + sqrt(norm(rate)) + field;
    const double change = turning * (1 + 1 / fabs(p->k)) * sqrt(max3(p->J) / min3(p->J));
    const double s = 0.1 / change / iso_clock_rate(p, ISO_CLOCK_S, q, NULL);
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) moment[c] = change > 0 ? s * iso_clock_rate(p, c, q, NULL) : 0;
}

/* The other clocks after a short time. The series of a clock have the rounding error of a whole turn, which is large
 * beside a short time. So the rates are integrated directly, by Gauss's rule with five nodes; its own error is 1e-19
 * of the result. */
static void count_moment(const iso_exact *x, iso_clock clock, real time, form_place *p)
{
    static const double node[] = {-0.90617984593866399, -0.53846931010568309, 0, 0.53846931010568309,
                                  0.90617984593866399};
    static const double weight[] = {0.23692688505618909, 0.47862867049936647, 0.56888888888888889,
                                    0.47862867049936647, 0.23692688505618909};
    real mean[ISO_CLOCKS] = {0};
    for (int i = 0; i < 5; i++) {
        form_place at = {.along = NAN};
        x->form->find(x->motion.data, clock, time * (1 + node[i]) / 2, &at);
        const double q = dot_diag(at.point + 3, x->params.J, at.point + 3);
        const double own = iso_clock_rate(&x->params, clock, q, NULL);
        for (iso_clock c = 0; c < ISO_CLOCKS; c++)
            mean[c] += weight[i] / 2 * iso_clock_rate(&x->params, c, q, NULL) / own;
    }
    for (int c = 0; c < ISO_CLOCKS; c++)
        if (x->has[c] && c != (int)clock) p->clock[c] = mean[c] * time;
}

static void find(const iso_exact *x, iso_clock clock, real time, form_place *p)
{
    const bool later = x->future.rotation && time > x->future.clock[clock];
    const bool earlier = x->past.rotation && time < x->past.clock[clock];
    const homoclinic_end *end = later ? &x->future : &x->past;
    if (!later && !earlier) {
        x->form->find(x->motion.data, clock, time, p);
        if (fabsl(time) < x->moment[clock]) count_moment(x, clock, time, p);
        return;
    }
    p->along = NAN;
    find(end->rotation, clock, time - end->clock[clock], p);
    for (int c = 0; c < ISO_CLOCKS; c++) p->clock[c] += end->clock[c];
    p->along = NAN;
}

/* --- on a separatrix -------------------------------------------------------------------------------------------- */

enum { STEPS_A_TURN = 32, MOST_TURNS = 20000 };

/* Goes away from time 0 until gamma has stayed in the plane of the unstable rotation, to rounding, for a whole turn.
 * The rotation begins there. */
static iso_status find_end(iso_context *ctx, const iso_problem *f, const iso_exact *x, int direction,
                           homoclinic_end *end)
{
    const int axis = x->motion.unstable, clock = x->has[ISO_CLOCK_T]   ? ISO_CLOCK_T
                                                 : x->has[ISO_CLOCK_S] ? ISO_CLOCK_S
                                                                       : ISO_CLOCK_TAU;
    form_place p = {.along = NAN};
    real time = 0;
    int near = 0;
    for (int i = 0; i < STEPS_A_TURN * MOST_TURNS && near < STEPS_A_TURN; i++) {
        p.along = NAN;
        x->form->find(x->motion.data, (iso_clock)clock, time, &p);
        const double *g = p.point + 3, q = dot_diag(g, f->p.J, g), speed = norm(p.point);
        near = fabs(g[axis]) < 1e-16 ? near + 1 : 0;
        time += direction * iso_clock_rate(&f->p, (iso_clock)clock, q, NULL) /
                iso_clock_rate(&f->p, ISO_CLOCK_S, q, NULL) * 2 * ISO_PI_LONG / STEPS_A_TURN / speed;
    }
    if (near < STEPS_A_TURN)
        return ISO_FAIL_NUMERICAL(ctx, "the orbit lies on a separatrix that it follows for too long");
    for (int i = 0; i < 3; i++) {
        end->clock[i] = p.clock[i];
        if (i == axis) p.point[3 + i] = 0;
        if (i != axis) p.point[i] = 0;
    }
    return iso_exact_create(ctx, f, p.point, x->has, &end->rotation);
}

/* --- the front -------------------------------------------------------------------------------------------------- */

/* Whether the solution returns the start at time 0, and a finite state on the level a little later. A small k makes the
 * rounding of q that of a power. */
static bool begins(const iso_exact *x, const iso_problem *f, const double point[ISO_STATE])
{
    const double *g = point + 3, length = norm(g), near = fmax(1e-6, 16 * DBL_EPSILON / fabs(f->p.k));
    double size;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        form_place p = {.along = NAN};
        if (!x->has[c]) continue;
        x->form->find(x->motion.data, (iso_clock)c, x->motion.rate[c], &p);
        if (!all_finite(p.point, ISO_STATE)) return false;
        if (!(fabs(iso_system_point.energy(f, p.point, &size) - f->energy) <= near * size)) return false;
        p.along = NAN;
        x->form->find(x->motion.data, (iso_clock)c, 0, &p);
        for (int i = 0; i < 3; i++)
            if (!(fabs(p.point[3 + i] - g[i] / length) < 1e-9)) return false;
    }
    return true;
}

static iso_status create(iso_context *ctx, iso_problem *f, double start[ISO_STATE], const bool clocks[ISO_CLOCKS],
                         iso_exact *x)
{
    ISO_TRY(check(ctx, f, start));
    turn_axes(x, f, start);
    ISO_TRY(find_form(ctx, f, start, &x->form));
    for (int c = 0; c < ISO_CLOCKS; c++) x->has[c] = clocks[c];
    x->motion.unstable = -1;
    const iso_status status = x->form->make(f, start, x->has, &x->motion);
    if (status == ISO_NO_MEMORY) return iso_context_fail(ctx, status, "", "no memory for a closed solution");
    if (status != ISO_OK)
        return iso_context_fail(ctx, status, "",
                                "the closed solution would need too many terms: a body too extreme, or an orbit too "
                                "close to a separatrix");
    if (!begins(x, f, start))
        return ISO_FAIL_NUMERICAL(
            ctx, "the closed solution has too few digits: a body too extreme, or an orbit that comes to rest");
    x->params = f->p;
    find_moments(f, start, x->moment);
    if (x->motion.unstable < 0) return ISO_OK;
    ISO_TRY(find_end(ctx, f, x, -1, &x->past));
    return find_end(ctx, f, x, 1, &x->future);
}

iso_status iso_exact_create(iso_context *ctx, const iso_problem *problem, const double point[ISO_STATE],
                            const bool clocks[ISO_CLOCKS], iso_exact **exact)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_problem own = *problem;
    double start[ISO_STATE];
    iso_exact *x = *exact = calloc(1, sizeof *x);
    if (!x) return iso_context_no_memory(ctx, "a closed solution");
    copy(point, start, ISO_STATE);
    const iso_status status = create(ctx, &own, start, clocks, x);
    if (status != ISO_OK) iso_exact_free(x), *exact = NULL;
    return status;
}

void iso_exact_free(iso_exact *x)
{
    if (!x) return;
    iso_exact_free(x->past.rotation);
    iso_exact_free(x->future.rotation);
    if (x->form) x->form->free(x->motion.data);
    free(x);
}

/* --- states ----------------------------------------------------------------------------------------------------- */

/* The longest step with a guess, in moments in which gamma turns by a tenth of a radian at most: for longer ones a
 * guess saves little, or nothing. */
static const double LONGEST = 4;
static const double POOR = 1e-3; /* a guess that is wrong by more, about in radians, is of no use */

/* The next value after `count` even steps, by their differences. */
static real extrapolate(const real value[], int count)
{
    real sum = 0, weight = 1;
    for (int i = 1; i <= count; i++) { /* binomial coefficients with alternating signs */
        weight *= -(real)(count - i + 1) / i;
        sum -= weight * value[count - i];
    }
    return sum;
}

iso_status iso_exact_walk_to(iso_context *ctx, const iso_exact *x, iso_exact_walk *w, iso_clock clock, double time,
                             double point[ISO_STATE], double clocks[ISO_CLOCKS])
{
    ISO_DEFAULT_ARITHMETIC;
    if (!x->has[clock])
        return ISO_FAIL_ARGUMENT(ctx, "", "this closed solution was made without the clock %s",
                                 iso_clock_name(clock));
    if (!isfinite(time)) return ISO_FAIL_ARGUMENT(ctx, "", "a time is not finite");
    if (w->known > 0 && !(fabs(time - w->time) <= LONGEST * x->moment[clock])) w->known = 0;
    const real even = time / x->motion.rate[clock];
    const real guess = w->known == ISO_EXACT_TRAIL ? even + extrapolate(w->trail, ISO_EXACT_TRAIL) : NAN;
    form_place p = {.along = guess};
    find(x, clock, time, &p);
    if (isnan(p.along) || fabsl(guess - p.along) > POOR)
        w->known = 0; /* the end of a separatrix, or steps that are not even */
    if (w->known == ISO_EXACT_TRAIL) memmove(w->trail, w->trail + 1, (size_t)--w->known * sizeof *w->trail);
    w->trail[w->known++] = p.along - even;
    w->time = time;
    for (int i = 0; i < ISO_STATE; i++) {
        const double *y = p.point + i / 3 * 3, *e = x->frame + i % 3;
        point[i] = x->turned ? y[0] * e[0] + y[1] * e[3] + y[2] * e[6] : p.point[i];
    }
    bool finite = all_finite(p.point, ISO_STATE);
    for (int c = 0; c < ISO_CLOCKS; c++) {
        const double shown = x->has[c] ? (double)p.clock[c] : NAN;
        finite = finite && (!x->has[c] || isfinite(shown));
        if (clocks) clocks[c] = shown;
    }
    return finite ? ISO_OK : ISO_FAIL_NUMERICAL(ctx, "the closed solution is not finite, or has no memory");
}

iso_status iso_exact_at(iso_context *ctx, const iso_exact *x, iso_clock clock, double time, double point[ISO_STATE],
                        double clocks[ISO_CLOCKS])
{
    iso_exact_walk walk = {0};
    return iso_exact_walk_to(ctx, x, &walk, clock, time, point, clocks);
}

iso_exact_torus iso_exact_describe(const iso_exact *x)
{
    iso_exact_torus nothing = {.action = {NAN, NAN}, .c = NAN, .distance = NAN};
    for (int c = 0; c < ISO_CLOCKS; c++) nothing.frequency[c][0] = nothing.frequency[c][1] = NAN;
    iso_exact_torus torus = nothing;
    x->form->describe(x->motion.data, x->has, &torus);
    if (!x->past.rotation) return torus;
    nothing.kind = ISO_EXACT_SEPARATRIX;
    nothing.c = torus.c;
    nothing.distance = 0;
    return nothing;
}

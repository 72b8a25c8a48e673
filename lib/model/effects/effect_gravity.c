/* effect_gravity.c - weight. The vertical e, in axes of the body, turns as the ball turns: it is a state.
 *
 *     MQ = mgb e x n,     e' = e x w,     |e| = 1
 *
 * The weight -m g e acts at the centre, b n above the contact. With the signed radius b this holds on all surfaces,
 * and the potential energy is m g (a+b)(n,e) = mgb/(1-k) (n,e). On a plane (k = 1) it is the height of the centre, m
 * g (E,x), with the vertical E in space and the displacement x, which only `attitude` knows.
 *
 * On a horizontal plane e = n, now and for ever: e' = e x w is n' = k n x w where k = 1. There the weight has no
 * torque, and gravity is idle. It has no states either, since n is the vertical.
 */
#include <float.h>
#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/formula/formula_impl.h"
#include "model/model_impl.h"

/* Where its numbers are. A scene states g of a body, or mgb of a reduced ball. */
enum { MGB, UP, G = UP + 3 };

static double mgb(const iso_problem *f)
{
    return f->effects.number[ISO_GRAVITY][MGB];
}

static bool is_idle(const iso_problem *f)
{
    return f->effects.idle[ISO_GRAVITY];
}

static bool is_state(const iso_problem *f)
{
    return !is_idle(f);
}

const double *iso_vertical(const iso_problem *f, const double y[])
{
    return is_idle(f) ? y + 3 : y + f->at[ISO_GRAVITY];
}

static void motion(iso_formula *F, const iso_problem *f)
{
    if (is_idle(f)) return;
    const iso_vector e = vector_state(F, f->at[ISO_GRAVITY]);
    add_torque(F, constant(F, mgb(f)), cross_of(F, e, formula_n(F)));
    set_rate_v(F, e, constant(F, 1), cross_of(F, e, formula_omega(F)));
}

static void potential(iso_formula *F, const iso_problem *f)
{
    const iso_vector e = vector_state(F, f->at[ISO_GRAVITY]);
    if (!iso_is_plane(f)) {
        const iso_constant less = sub_c(F, constant(F, 1), constant_k(F));
        add_energy(F, div_c(F, constant(F, mgb(f)), less), dot_of(F, formula_n(F), e));
    } else if (f->at[ISO_ATTITUDE] > 0) {
        const iso_vector displacement = vector_state(F, f->at[ISO_ATTITUDE] + 4);
        add_energy(F, constant(F, mgb(f)), dot_of(F, iso_in_space(F, f, e), displacement));
    }
}

/* On a plane the height is a state of `attitude`. */
static iso_work work(const iso_problem *f)
{
    return iso_is_plane(f) && !f->effects.on[ISO_ATTITUDE] ? ISO_WORK_UNKNOWN : ISO_WORK_NONE;
}

static const char *no_frequencies(const iso_problem *f)
{
    return iso_is_plane(f) ? "on a tilted plane the ball rolls away ever faster" : NULL;
}

static void begin(const iso_problem *f, double y[])
{
    copy(iso_effects_up(&f->effects), y + f->at[ISO_GRAVITY], 3);
}

static void size(const iso_problem *f, const double y[], double size[])
{
    (void)y;
    for (int i = 0; i < 3; i++) size[f->at[ISO_GRAVITY] + i] = 1;
}

static double strength(const iso_problem *f, const double y[])
{
    (void)y;
    return fabs(mgb(f));
}

/* near k = 1 the potential is a large constant plus small changes, which lose digits */
static double range(const iso_problem *f, const double y[])
{
    (void)y;
    return iso_is_plane(f) ? fabs(mgb(f)) : fabs(mgb(f) / (1 - f->p.k));
}

static double vertical_length(const iso_problem *f, const double y[], double *value_size)
{
    *value_size = 1;
    return norm(iso_vertical(f, y));
}

static double slope_of_plane(const iso_problem *f, const double y[], double *value_size)
{
    *value_size = 1;
    return dot(iso_vertical(f, y), y + 3);
}

static void show(const iso_problem *f, const double y[], double columns[])
{
    copy(iso_vertical(f, y), columns, 3);
}

static void recall(const iso_problem *f, const double columns[], double y[])
{
    if (!is_idle(f)) copy(columns, y + f->at[ISO_GRAVITY], 3);
}

/* --- its numbers ------------------------------------------------------------------------------------------------ */

const double *iso_effects_up(const iso_effects *e)
{
    return e->number[ISO_GRAVITY] + UP;
}

/* On a plane, with `up` along the normal. */
static bool idle(const iso_params *p, const double n[3], const iso_effects *e)
{
    double e_n[3];
    cross(iso_effects_up(e), n, e_n);
    return p->k == 1 && norm(e_n) <= 4 * DBL_EPSILON;
}

static iso_status check(iso_context *ctx, const iso_params *p, const double n[3], iso_effects *e)
{
    (void)p, (void)n;
    if (e->on[ISO_TORQUE]) return ISO_OK; /* which may read the vertical */
    if (e->number[ISO_GRAVITY][MGB] == 0)
        return ISO_FAIL_INPUT(ctx, "gravity", "gravity of 0 changes nothing: take it out");
    if (e->on[ISO_REACTIONS] || !e->idle[ISO_GRAVITY]) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "gravity",
                          "on a horizontal plane (up along the normal) gravity has no torque and changes nothing: "
                          "take it out, tilt the plane, or ask for 'reactions'");
}

/* g of a body gives mgb, the weight times the signed radius. */
static iso_status complete(iso_context *ctx, const iso_params *p, int model, double number[],
                           bool (*given)(const void *scene, const char *key), const void *scene)
{
    const bool body = p->body.surface != ISO_REDUCED;
    const char *wanted = body ? "g" : "mgb", *other = body ? "mgb" : "g";
    (void)model;
    if (given(scene, other))
        return ISO_FAIL_INPUT(ctx, other, "'%s' does not belong here: %s, give '%s'", other,
                              body ? "the ball's mass and radius are known" : "k and J know no mass", wanted);
    if (!given(scene, wanted)) return ISO_FAIL_INPUT(ctx, "gravity", "missing '%s' in 'gravity'", wanted);
    if (body) number[MGB] = p->body.mass * number[G] * (iso_params_sign_of_radius(p) * p->body.radius);
    if (isfinite(number[MGB])) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, wanted, "the weight m g times the radius b does not fit a double");
}

static const char *const e_names[] = {"e1", "e2", "e3"};

static const iso_effect_number numbers[] = {
    {.name = "g", .at = G, .count = 1, .scene_only = true, .of = ISO_OF_BODY},
    {.name = "mgb", .at = MGB, .count = 1, .dimension = {1, 0, 2}, .of = ISO_OF_REDUCED},
    {.name = "up", .at = UP, .count = 3, .kind = ISO_NUMBER_UNIT, .required = true, .turns_with = "e"},
    {0},
};

static const iso_effect_column columns[] = {
    ISO_COLUMN("e", e_names, 3, "", "upward vertical, in the ball's axes", .checked_as = "e"),
    {0},
};

static const iso_effect_state states[] = {
    {.name = e_names, .count = 3, .kind = ISO_STATE_UNIT, .there = is_state},
    {0},
};

static const iso_integral integrals[] = {
    {.name = "|e|", .known = ISO_ONE, .doc = "unit vertical: 1", .value = vertical_length},
    {.name = "e.n", .doc = "(e,n), the slope of a plane", .holds = iso_is_plane, .value = slope_of_plane},
    {0},
};

const iso_effect iso_effect_gravity = {
    .name = "gravity",
    .doc = "weight: torque mgb e x n, potential m g (a+b)(n,e)",
    .idle = idle,
    .breaks = "its torque depends on the vertical, which turns in the body, so it has no potential in n alone",
    .work = work,
    .no_frequencies = no_frequencies,
    .numbers = numbers,
    .columns = columns,
    .complete = complete,
    .check = check,
    .show = show,
    .recall = recall,
    .motion = motion,
    .potential = potential,
    .states = states,
    .states_doc = "vertical in body axes, e' = e x omega, for the torque of the weight",
    .begin = begin,
    .size = size,
    .strength = strength,
    .range = range,
    .integrals = integrals,
};

/* effect_attitude.c - how the ball stands and where it is. It only observes: the motion stays as it is.
 *
 *     Q' = Q (0,w)/2,     |Q| = 1          R(Q): from body to space axes
 *     x' = R (w x n)                       on a plane: displacement of the centre, in units of b
 *
 * On a sphere no displacement has to be integrated: the contact is at a R n, the centre at (a+b) R n.
 *
 * The quaternion at time 0 fixes the axes of space. If it is not given, axis 3 of space is the upward vertical, or,
 * without gravity, the axes of space are the body's at time 0.
 */
#include <math.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/formula/formula_impl.h"
#include "model/model_impl.h"

/* R v = (q0^2 - |q|^2) v + 2 (q,v) q + 2 q0 q x v */
void iso_turn_to_space(const double Q[4], const double v[3], double in_space[3])
{
    const double *q = Q + 1;
    double q_v[3];
    cross(q, v, q_v);
    for (int i = 0; i < 3; i++)
        in_space[i] = (Q[0] * Q[0] - dot(q, q)) * v[i] + 2 * dot(q, v) * q[i] + 2 * Q[0] * q_v[i];
}

iso_vector iso_in_space(iso_formula *F, const iso_problem *f, iso_vector v)
{
    const iso_scalar q0 = scalar_state(F, f->at[ISO_ATTITUDE]);
    const iso_vector q = vector_state(F, f->at[ISO_ATTITUDE] + 1), b = cross_of(F, q, v);
    const iso_vector turned = add_v(F, scale_v(F, q0, b), cross_of(F, q, b));
    return add_v(F, v, times_v(F, constant(F, 2), turned));
}

/* On a plane: the displacement of the centre in space axes since time 0, in units of b. */
static const double *displacement(const iso_problem *f, const double y[])
{
    return y + f->at[ISO_ATTITUDE] + 4;
}

/* q0' = -(q,w)/2,  q' = (q0 w + q x w)/2 */
static void motion(iso_formula *F, const iso_problem *f)
{
    const int at = f->at[ISO_ATTITUDE];
    const iso_vector omega = formula_omega(F), q = vector_state(F, at + 1);
    const iso_scalar q0 = scalar_state(F, at);
    set_rate(F, q0, constant(F, -0.5), dot_of(F, q, omega));
    set_rate_v(F, q, constant(F, 0.5), add_v(F, scale_v(F, q0, omega), cross_of(F, q, omega)));
    if (!iso_is_plane(f)) return;
    const iso_vector displacement = vector_state(F, at + 4);
    set_rate_v(F, displacement, constant(F, 1), iso_in_space(F, f, cross_of(F, omega, formula_n(F))));
}

static void begin(const iso_problem *f, double y[])
{
    double *Q = y + f->at[ISO_ATTITUDE];
    copy(f->effects.number[ISO_ATTITUDE], Q, 4);
    for (int i = 4; iso_is_plane(f) && i < 7; i++) Q[i] = 0;
}

static void size(const iso_problem *f, const double y[], double size[])
{
    const int at = f->at[ISO_ATTITUDE];
    for (int i = 0; i < 4; i++) size[at + i] = 1;
    for (int i = 4; iso_is_plane(f) && i < 7; i++) size[at + i] = 1 + norm(displacement(f, y));
}

static double unit_quaternion(const iso_problem *f, const double y[], double *value_size)
{
    const double *Q = y + f->at[ISO_ATTITUDE];
    *value_size = 1;
    return sqrt(Q[0] * Q[0] + dot(Q + 1, Q + 1));
}

/* Quaternion, contact in space, contact on the ball, centre. The contact goes round the fixed sphere at a R n; on a
 * plane it goes with the centre, b x. */
static void show(const iso_problem *f, const double y[], double columns[])
{
    const double *n = y + 3, *Q = y + f->at[ISO_ATTITUDE], b = iso_params_sign_of_radius(&f->p);
    const double a = iso_is_plane(f) ? 0 : b * f->p.k / (1 - f->p.k); /* the fixed radius over |b|, never negative */
    double *contact = columns + 4, *trace = columns + 7, *centre = columns + 10, space_n[3];
    copy(Q, columns, 4);
    iso_turn_to_space(Q, n, space_n);
    for (int i = 0; i < 3; i++) {
        contact[i] = iso_is_plane(f) ? displacement(f, y)[i] : a * space_n[i];
        trace[i] = -b * n[i];
        centre[i] = contact[i] + b * space_n[i];
    }
}

static void recall(const iso_problem *f, const double columns[], double y[])
{
    double *Q = y + f->at[ISO_ATTITUDE];
    copy(columns, Q, 4);
    if (iso_is_plane(f)) copy(columns + 4, Q + 4, 3);
}

static const char *const q_names[] = {"q0", "q1", "q2", "q3"}, *const x_names[] = {"x1", "x2", "x3"},
                         *const contact_names[] = {"contact1", "contact2", "contact3"},
                         *const trace_names[] = {"trace1", "trace2", "trace3"},
                         *const centre_names[] = {"centre1", "centre2", "centre3"};

/* The smallest turn that takes the unit vector u to axis 3. It is a turn about u x e3 = (u2, -u1, 0) by the angle A
 * between them: Q = (cos(A/2), sin(A/2) u x e3/|u x e3|), where u3 = cos A, |u x e3| = sin A. From -e3 it is a half
 * turn about axis 1. */
static void turn_to_axis_3(const double u[3], double Q[4])
{
    const double across = hypot(u[0], u[1]), half = 0.5 * atan2(across, u[2]);
    Q[0] = cos(half);
    Q[1] = across > 0 ? sin(half) * (u[1] / across) : sin(half);
    Q[2] = across > 0 ? -sin(half) * (u[0] / across) : 0;
    Q[3] = 0;
    if (across == 0) Q[0] = u[2] > 0; /* exactly 1 or 0 */
}

/* The attitude at time 0, if nobody gave it. */
static void fill(iso_effects *effects)
{
    double *Q = effects->number[ISO_ATTITUDE];
    if (!isnan(Q[0]) || !isnan(Q[1]) || !isnan(Q[2]) || !isnan(Q[3])) return;
    const double axis_3[3] = {0, 0, 1};
    const bool gravity = effects->on[ISO_GRAVITY];
    turn_to_axis_3(gravity ? iso_effects_up(effects) : axis_3, Q);
}

static const double unknown[] = {NAN, NAN, NAN, NAN};

static const iso_effect_number numbers[] = {
    {.name = "quaternion", .count = 4, .kind = ISO_NUMBER_UNIT, .initially = unknown, .turns_with = "q"},
    {0},
};

static const iso_effect_column columns[] = {
    ISO_COLUMN("q", q_names, 4, "", "unit quaternion from the ball's axes to those of space", .checked_as = "q"),
    ISO_COLUMN("contact", contact_names, 3, "length", "contact point, in axes of space", .length = 1,
               .checked_as = "contact", .moves = true),
    ISO_COLUMN("trace", trace_names, 3, "length", "contact point on the ball, in its axes", .length = 1,
               .checked_as = "trace"),
    ISO_COLUMN("centre", centre_names, 3, "length", "centre of the ball, in axes of space", .length = 1,
               .checked_as = "centre", .moves = true),
    {0},
};

static const iso_effect_state states[] = {
    {.name = q_names, .count = 4, .kind = ISO_STATE_UNIT},
    {.name = x_names, .count = 3, .kind = ISO_STATE_INTEGRAL, .there = iso_is_plane},
    {0},
};

static const iso_integral integrals[] = {
    {.name = "|q|", .known = ISO_ONE, .doc = "unit quaternion: 1", .value = unit_quaternion},
    {0},
};

const iso_effect iso_effect_attitude = {
    .name = "attitude",
    .doc = "how the ball stands in space: quaternion, both contact curves, path of the centre",
    .observes = true,
    .ball_only = true,
    .needs_radius = true,
    .numbers = numbers,
    .columns = columns,
    .fill = fill,
    .show = show,
    .recall = recall,
    .motion = motion,
    .states = states,
    .states_doc =
        "how the ball stands, from body to space axes (q), and on a plane the way of the centre (x, in units of b)",
    .begin = begin,
    .size = size,
    .integrals = integrals,
};

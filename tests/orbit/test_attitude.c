/* The ball in space: attitude, contact point and centre belong together, and the ball rolls, neither slips nor
 * twists. */
#include "scenes.h"

static iso_context *ctx;

static laws_worst unit, vertical, frame, upright, kept_axes, turning, normal, centre, place, tangents, bending,
    twisting, veselova;

enum { TIMES = 12 };

/* --- at one moment ---------------------------------------------------------------------------------------------- */

static void normal_in_space(const rolling *ball, const iso_sample *s, double v[3])
{
    (void)ball;
    to_space(s, normal_of(s), v);
}

static void axis_in_space(const rolling *ball, const iso_sample *s, double v[3])
{
    static const double body_fixed[3] = {0.6, 0, 0.8};
    (void)ball;
    to_space(s, body_fixed, v);
}

/* R (w x v) */
static void turned(const iso_sample *s, const double v[3], double in_space[3])
{
    double w_v[3];
    cross(omega_of(s), v, w_v);
    to_space(s, w_v, in_space);
}

/* (R v)' = R (w x v) for what is fixed in the body; (R n)' = (1-k) R (w x n); centre' = R (b w x n): with the trace at
 * -b n, the point of the ball that touches is at rest. */
static void note_velocities(const rolling *ball, const stencil *st)
{
    const iso_sample *s = middle(st);
    const double fixed[3] = {0.6, 0, 0.8};
    const double allowed = 1e-10 * pace_of(s);
    double found[3], expected[3];
    first_derivative(ball, st, axis_in_space, found);
    turned(s, fixed, expected);
    laws_note(&turning, laws_distance(found, expected), allowed, &ball->p, ball->name);
    first_derivative(ball, st, normal_in_space, found);
    turned(s, normal_of(s), expected);
    scale(expected, 1 - ball->p.k);
    laws_note(&normal, laws_distance(found, expected), allowed * (1 + fabs(ball->p.k)), &ball->p, ball->name);
    first_derivative(ball, st, centre_of, found);
    turned(s, normal_of(s), expected);
    scale(expected, ball->b);
    laws_note(&centre, laws_distance(found, expected), allowed, &ball->p, ball->name);
}

/* contact - centre = R trace, trace = -b n, and where the fixed surface is: contact = a R n; on a plane through
 * the first contact, whose normal R n stays what it was. */
static void note_place(const rolling *ball, const iso_sample *s, const iso_sample *start)
{
    double arm[3], trace[3], n[3], n_start[3], surface[3];
    for (int i = 0; i < 3; i++) arm[i] = sample_of(s, "contact")[i] - sample_of(s, "centre")[i];
    to_space(s, sample_of(s, "trace"), trace);
    laws_note(&place, laws_distance(arm, trace), 1e-13, &ball->p, "arm");
    for (int i = 0; i < 3; i++) trace[i] = -ball->b * normal_of(s)[i];
    laws_note(&place, laws_distance(sample_of(s, "trace"), trace), 1e-14, &ball->p, "trace");
    normal_in_space(ball, s, n);
    normal_in_space(ball, start, n_start);
    if (on_plane(ball)) {
        laws_note(&place, laws_distance(n, n_start), 1e-11, &ball->p, "normal of the plane");
        laws_note(&place, fabs(dot(sample_of(s, "contact"), n_start)), 1e-11, &ball->p, "in the plane");
        return;
    }
    for (int i = 0; i < 3; i++) surface[i] = ball->a * n[i];
    laws_note(&place, laws_distance(sample_of(s, "contact"), surface), 1e-13 * fabs(ball->a), &ball->p, "contact");
}

static void note_moment(const rolling *ball, const iso_effects *e, const stencil *st, const iso_sample *start)
{
    const iso_sample *s = middle(st);
    const double *Q = sample_of(s, "q");
    laws_note(&unit, fabs(sqrt(Q[0] * Q[0] + dot(Q + 1, Q + 1)) - 1), 1e-13, &ball->p, ball->name);
    if (e->on[ISO_GRAVITY]) {
        double up[3], up_start[3];
        to_space(s, sample_of(s, "e"), up);
        to_space(start, sample_of(start, "e"), up_start);
        laws_note(&vertical, laws_distance(up, up_start), 1e-11, &ball->p, ball->name);
    }
    note_velocities(ball, st);
    note_place(ball, s, start);
}

/* Veselova's body on a plane: without torques the contact's is along R n alone, which stands still in space. So the
 * part of R J w across it stays, and w has no part along it. */
static void note_veselova(const rolling *ball, const iso_sample *s, const iso_sample *start)
{
    double Jw[3], momentum[3], first[3], n[3], w[3];
    normal_in_space(ball, start, n);
    diag(ball->p.J, omega_of(start), Jw);
    to_space(start, Jw, first);
    diag(ball->p.J, omega_of(s), Jw);
    to_space(s, Jw, momentum);
    to_space(s, omega_of(s), w);
    for (int i = 0; i < 3; i++) momentum[i] -= first[i];
    remove_along(momentum, n);
    laws_note(&veselova, norm(momentum) / norm(first), 1e-11, &ball->p, "momentum");
    laws_note(&veselova, fabs(dot(w, n)), 1e-11, &ball->p, "(w,n)");
}

/* --- the two curves --------------------------------------------------------------------------------------------- */

static void contact_of(const rolling *ball, const iso_sample *s, double v[3])
{
    (void)ball;
    copy(sample_of(s, "contact"), v, 3);
}

static void trace_of(const rolling *ball, const iso_sample *s, double v[3])
{
    (void)ball;
    copy(sample_of(s, "trace"), v, 3);
}

/* (x', x'', nu)/|x'|^3, positive where the curve turns left for one who stands on the side that nu points to. Both
 * curves are seen from the same side: nu is n on the ball, R n in space. */
static double geodesic_curvature(const rolling *ball, const stencil *st, seen *curve, const double nu[3])
{
    double d1[3], d2[3], d1_d2[3];
    first_derivative(ball, st, curve, d1);
    second_derivative(ball, st, curve, d2);
    cross(d1, d2, d1_d2);
    return dot(d1_d2, nu) / pow(norm(d1), 3);
}

/* x' = R X' for contact x and trace X, which so have the same length. x'' = R (w x X' + X''), and the curvatures differ
 * by (w,n)/|x'|: a rubber ball's are equal, and one that twists at the contact shows it there. */
static void note_curvature(const rolling *ball, const stencil *st, laws_worst *worst)
{
    const iso_sample *s = middle(st);
    double n[3], on_surface[3], on_ball[3], turned_trace[3];
    first_derivative(ball, st, contact_of, on_surface);
    first_derivative(ball, st, trace_of, on_ball);
    to_space(s, on_ball, turned_trace);
    const double speed = norm(on_surface);
    laws_note(&tangents, laws_distance(on_surface, turned_trace), 1e-10 * pace_of(s), &ball->p, ball->name);
    if (!(speed > 0.1 * fabs(ball->b))) return; /* the curvature of a point that stands is no number */
    normal_in_space(ball, s, n);
    const double outer = geodesic_curvature(ball, st, contact_of, n);
    const double inner = geodesic_curvature(ball, st, trace_of, normal_of(s));
    const double spin = worst == &twisting ? spin_of(s) / speed : 0;
    laws_note(worst, fabs(outer - inner - spin), 1e-6, &ball->p, ball->name);
}

/* --- all balls -------------------------------------------------------------------------------------------------- */

/* What acts: nothing, the weight, the weight and a field, the weight on a ball that twists. */
enum { LOADS = 4 };

static void check_ball(const rolling *ball, int load, iso_random *random)
{
    iso_effects e = {0};
    iso_start start = scene_start(ball, random);
    double up[3];
    iso_random_direction(random, up);
    add_attitude(random, &e);
    if (load > 0) add_gravity(ball, 0.9, up, &e);
    if (load == 2) add_field(&e);
    if (load == 3) add_twist(0.4, &e), add_scaled(start.y, 0.7, start.y + 3);
    iso_orbit *orbit = scene_orbit(ctx, ball, &start, &e, NULL);
    const iso_sample begin = scene_at(ctx, orbit, 0);
    for (int i = 0; i < 4; i++)
        laws_note(&frame, fabs(sample_of(&begin, "q")[i] - QUATERNION(&e)[i]), 1e-15, &ball->p, ball->name);
    for (int i = -TIMES / 3; i < TIMES; i++) {
        if (load == 3 && i < 0) continue; /* friction backwards is a run-away */
        const stencil st = stencil_around(ctx, orbit, ball, 1.3 * i + 0.2);
        note_moment(ball, &e, &st, &begin);
        if (load == 0 && on_plane(ball)) note_veselova(ball, middle(&st), &begin);
        note_curvature(ball, &st, load == 3 ? &twisting : &bending);
    }
    iso_orbit_free(orbit);
}

/* Without a quaternion, axis 3 of space is the vertical where there is gravity: at the start and later; also where
 * `up` is the axis of the body, or its opposite, or next to it. The turn is the smallest: its axis lies in the plane
 * of axes 1 and 2. Without gravity the axes are the body's. */
static void check_axes(const rolling *ball, iso_random *random)
{
    static const double special[][3] = {{0, 0, 1},        {0, 0, -1}, {1e-9, 0, -1}, {0, -1e-160, -1},
                                        {1e-5, 1e-5, -1}, {0, 1, 0},  {-1, 0, 0},    {0.6, 0, 0.8}};
    enum { SPECIAL = sizeof special / sizeof *special, UPS = SPECIAL + 8 };
    static const double axis_3[3] = {0, 0, 1};
    for (int i = 0; i <= UPS; i++) {
        iso_effects e = iso_effects_default();
        const iso_start start = scene_start(ball, random);
        double up[3], in_space[3];
        iso_random_direction(random, up);
        if (i < SPECIAL) copy(special[i], up, 3), scale(up, 1 / norm(up));
        e.on[ISO_ATTITUDE] = true;
        if (i < UPS) add_gravity(ball, 0.9, up, &e);
        iso_orbit *orbit = scene_orbit(ctx, ball, &start, &e, NULL);
        const iso_sample begin = scene_at(ctx, orbit, 0), later = scene_at(ctx, orbit, 3.7);
        const double *Q = sample_of(&begin, "q");
        iso_orbit_free(orbit);
        if (i == UPS) {
            laws_note(&kept_axes, fabs(Q[0] - 1) + norm(Q + 1), 0, &ball->p, ball->name);
            continue;
        }
        to_space(&begin, up, in_space);
        laws_note(&upright, laws_distance(in_space, axis_3), 1e-15, &ball->p, "at the start");
        laws_note(&upright, Q[0] >= 0 ? fabs(Q[3]) : 1, 0, &ball->p, "the smallest turn");
        to_space(&later, sample_of(&later, "e"), in_space);
        laws_note(&upright, laws_distance(in_space, axis_3) / 1e4, 1e-15, &ball->p, "later");
    }
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *random = iso_random_create(71);
    for (int which = 0; which < ROLLINGS; which++)
        for (int load = 0; load < LOADS; load++) {
            const rolling ball = rolling_ball(ctx, which);
            check_ball(&ball, load, random);
        }
    for (int which = 0; which < ROLLINGS; which++) {
        const rolling ball = rolling_ball(ctx, which);
        check_axes(&ball, random);
    }
    iso_random_free(random);
    laws_report(&frame, "the attitude begins as stated");
    laws_report(&upright, "where there is gravity, axis 3 of space is up");
    laws_report(&kept_axes, "without gravity the axes of space are the body's at the start");
    laws_report(&unit, "unit quaternion");
    laws_report(&vertical, "R e: the vertical stands still in space");
    laws_report(&turning, "(R v)' = R (w x v) for v fixed in the body");
    laws_report(&normal, "(R n)' = (1-k) R (w x n)");
    laws_report(&veselova, "on a plane: Veselova's body");
    laws_report(&centre, "no slip: centre' = R (b w x n)");
    laws_report(&place, "contact, trace and centre belong together");
    laws_report(&tangents, "contact' = R trace'");
    laws_report(&bending, "no twist: contact curve and trace have the same geodesic curvature");
    laws_report(&twisting, "with twist the geodesic curvatures differ by (w,n)/speed");
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

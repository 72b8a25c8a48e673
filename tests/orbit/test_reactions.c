/* The forces of the contact: Newton's equations of the whole ball in space, and where the ball leaves its support. */
#include "scenes.h"

static iso_context *ctx;

static laws_worst newton, euler, parts, twist, plane, textbook;

/* --- Newton's equations ----------------------------------------------------------------------------------------- */

/* R I w: the angular momentum about the centre */
static void momentum(const rolling *ball, const iso_sample *s, double L[3])
{
    double I_w[3];
    diag(ball->I, omega_of(s), I_w);
    to_space(s, I_w, L);
}

/* m centre'' = R N - m g E */
static void note_newton(const rolling *ball, const iso_effects *e, const stencil *st)
{
    const iso_sample *s = middle(st);
    const double square = pace_of(s) * pace_of(s);
    double found[3], force[3], up[3];
    second_derivative(ball, st, centre_of, found);
    scale(found, ball->m);
    to_space(s, sample_of(s, "N"), force);
    to_space(s, sample_of(s, "e"), up);
    if (e->on[ISO_GRAVITY]) add_scaled(force, -GRAVITY_MGB(e) / ball->b, up);
    laws_note(&newton, laws_distance(found, force), 1e-8 * ball->m * fabs(ball->b) * square, &ball->p, ball->name);
}

/* (R I w)' = (contact - centre) x R N + R (lambda n + k n x dU/dn - c_r w) */
static void note_euler(const rolling *ball, const iso_effects *e, const stencil *st)
{
    const iso_sample *s = middle(st);
    double found[3], torque[3], couple[3] = {0}, force[3], arm[3], dU[3], n_dU[3];
    first_derivative(ball, st, momentum, found);
    to_space(s, sample_of(s, "N"), force);
    for (int i = 0; i < 3; i++) arm[i] = sample_of(s, "contact")[i] - sample_of(s, "centre")[i];
    cross(arm, force, torque);
    add_scaled(couple, iso_sample_get(s, "lambda"), normal_of(s));
    field_gradient(s, dU);
    cross(normal_of(s), dU, n_dU);
    if (e->on[ISO_FIELD]) add_scaled(couple, ball->p.k, n_dU);
    if (e->on[ISO_ROLLING_RESISTANCE]) add_scaled(couple, -ROLLING_COEFFICIENT(e), omega_of(s));
    to_space(s, couple, force);
    add_scaled(torque, 1, force);
    laws_note(&euler, laws_distance(found, torque), 1e-9 * max3(ball->p.J) * pace_of(s) * pace_of(s), &ball->p,
              ball->name);
}

/* The support pushes from the contact towards the centre, and a shell the other way, from inside. */
static void note_parts(const rolling *ball, const iso_effects *e, const iso_sample *s)
{
    double push[3], force[3], across[3];
    for (int i = 0; i < 3; i++)
        push[i] = ball->side * (sample_of(s, "centre")[i] - sample_of(s, "contact")[i]) / fabs(ball->b);
    to_space(s, sample_of(s, "N"), force);
    copy(force, across, 3);
    const double pressure = remove_along(across, push), size = norm(force) + 1e-3;
    laws_note(&parts, fabs(iso_sample_get(s, "pressure") - pressure), 1e-13 * size, &ball->p, "pressure");
    laws_note(&parts, fabs(iso_sample_get(s, "friction") - norm(across)), 1e-13 * size, &ball->p, "friction");
    if (pressure > 1e-3 * size)
        laws_note(&parts,
                  fabs(iso_sample_get(s, "mu") - iso_sample_get(s, "friction") / iso_sample_get(s, "pressure")),
                  1e-13 * iso_sample_get(s, "mu"), &ball->p, "mu");
    if (on_plane(ball) && !e->on[ISO_GRAVITY])
        laws_note(&plane, fabs(iso_sample_get(s, "pressure")), 0, &ball->p, ball->name);
    if (e->on[ISO_TWIST])
        laws_note(&twist, fabs(iso_sample_get(s, "lambda") + TWIST_RESISTANCE(e) * spin_of(s)),
                  1e-13 * TWIST_RESISTANCE(e) * pace_of(s), &ball->p, ball->name);
}

/* Bits of `load`: weight, field, rolling resistance, a contact that twists, and one too stiff to do so much. */
enum { WEIGHT = 1, FIELD = 2, RESISTANCE = 4, TWIST = 8, STIFF = 16 };

static void check_load(const rolling *ball, int load, iso_random *random)
{
    iso_effects e = {.on[ISO_REACTIONS] = true};
    iso_start start = scene_start(ball, random);
    double up[3];
    iso_random_direction(random, up);
    add_attitude(random, &e);
    if (load & WEIGHT) add_gravity(ball, 0.9, up, &e);
    if (load & FIELD) add_field(&e);
    if (load & RESISTANCE) e.on[ISO_ROLLING_RESISTANCE] = true, ROLLING_COEFFICIENT(&e) = 0.07;
    if (load & TWIST) add_twist(0.8, &e), add_scaled(start.y, -0.6, start.y + 3);
    if (load & STIFF) add_twist(1e3, &e);
    iso_orbit *orbit = scene_orbit(ctx, ball, &start, &e, NULL);
    for (int i = 0; i < 8; i++) {
        const stencil st = stencil_around(ctx, orbit, ball, 0.9 * i + 0.3);
        note_newton(ball, &e, &st);
        note_euler(ball, &e, &st);
        note_parts(ball, &e, middle(&st));
    }
    iso_orbit_free(orbit);
}

static void check_newton(iso_random *random)
{
    for (int which = 0; which < ROLLINGS; which++)
        for (int load = 0; load <= STIFF; load++) {
            const rolling ball = rolling_ball(ctx, which);
            check_load(&ball, load < STIFF ? load : STIFF | WEIGHT | FIELD | RESISTANCE, random);
        }
    laws_report(&newton, "m centre'' = R N - m g E");
    laws_report(&euler, "(R I w)' = torque of N about the centre + couples");
    laws_report(&parts, "pressure, friction and mu are the parts of N");
    laws_report(&twist, "a contact that twists: lambda = -c (w,n)");
    laws_report(&plane, "on a plane without weight the pressure is exactly 0");
}

/* --- where contact is lost: closed forms ------------------------------------------------------------------------ */

/* A ball with equal moments, kappa = I/(m B^2), rolls in a plane through the vertical, its centre on a circle of
 * radius R, at the angle theta from the top. With c = cos theta, (1 + kappa) v^2/2 + g R c is constant. Contact is
 * lost where the weight alone bends the path, v^2 = g R c, on top of a sphere as well as inside one or around one, so
 *
 *     (3 + kappa) c = (1 + kappa) v0^2/(g R) + 2 c0 .
 */
static double textbook_cosine(double kappa, double speed_square_by_gR, double c0)
{
    return ((1 + kappa) * speed_square_by_gR + 2 * c0) / (3 + kappa);
}

/* Starts at theta0 from the top with the centre's speed v0 and finds cos theta where contact is lost, forwards or
 * (way -1) backwards in time. */
static void note_textbook(iso_surface surface, double A, double B, double kappa, double theta0, double v0, int way)
{
    const double g = 9.81, m = 1.7, I = kappa * m * B * B;
    const iso_body body = {m, B, {I, I, I}, surface, A};
    const rolling ball = rolling_body(ctx, &body);
    const double up[3] = {0, 0, 1}, side = ball.a + ball.b > 0 ? 1 : -1; /* centre at (a+b) n from the middle */
    iso_effects e = {.on[ISO_REACTIONS] = true};
    add_gravity(&ball, g, up, &e);
    const double omega = way * v0 / B;
    const iso_start start = {.model = ISO_BALL, .y = {0, omega, 0, side * sin(theta0), 0, side * cos(theta0)}};
    iso_orbit *orbit = scene_orbit(ctx, &ball, &start, &e, NULL);
    const double gR = g * fabs(ball.a + ball.b);
    bool found;
    iso_sample s;
    laws_stop_if(ctx, iso_orbit_lost_contact(orbit, 0, way * 50, &found, &s) != ISO_OK, "a loss of contact");
    const double cosine = side * dot(normal_of(&s), sample_of(&s, "e"));
    const double expected = textbook_cosine(kappa, v0 * v0 / gR, cos(theta0));
    laws_note(&textbook, found ? fabs(cosine - expected) : NAN, 1e-9, &ball.p, ball.name);
    const iso_sample before = scene_at(ctx, orbit, 0.999 * s.clock[ISO_CLOCK_T]);
    laws_note(&textbook, iso_sample_get(&before, "pressure") > 0 ? 0 : 1, 0.5, &ball.p, "lost, not found again");
    iso_orbit_free(orbit);
}

static void check_textbook(void)
{
    static const double kappas[] = {0.4, 2.0 / 3, 0.1};
    for (int i = 0; i < 6; i++) {
        const double kappa = kappas[i / 2], R = 0.7, gR = 9.81 * R;
        const int way = i % 2 ? -1 : 1;
        note_textbook(ISO_OUTSIDE, 0.5, 0.2, kappa, 1e-5, 0, way); /* 2/(3 + kappa), to 1e-10; a solid ball: 10/17 */
        note_textbook(ISO_OUTSIDE, 0.5, 0.2, kappa, 0.4, 0, way);
        note_textbook(ISO_OUTSIDE, 0.5, 0.2, kappa, 0.2, 0.5 * sqrt(gR), way);
        /* from the bottom, too fast to turn back below the middle's height, too slow for the top: */
        note_textbook(ISO_INSIDE, 0.9, 0.2, kappa, M_PI, sqrt(3.2 * gR), way);
        note_textbook(ISO_SHELL, 0.2, 0.9, kappa, M_PI, sqrt(3.2 * gR), way);
    }
    gsl_test_rel(textbook_cosine(0.4, 0, 1), 10.0 / 17, 1e-15, "a solid ball leaves the top of a sphere at 10/17");
    laws_report(&textbook, "cos theta where contact is lost, closed forms");
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *random = iso_random_create(72);
    check_newton(random);
    check_textbook();
    iso_random_free(random);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

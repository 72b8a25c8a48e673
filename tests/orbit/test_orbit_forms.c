/* Orbits known in closed form, events, and what an orbit refuses or does when it cannot go on. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_mode.h>
#include <gsl/gsl_sf_ellint.h>

#include "orbit/orbit_impl.h"
#include "scenes.h"

static iso_context *ctx;

static iso_orbit_options ball_and_s(const iso_start *start, iso_backend backend, double tolerance)
{
    iso_orbit_options o = iso_orbit_defaults(start);
    o.backend = backend;
    o.tolerance = tolerance;
    o.with_clock[ISO_CLOCK_S] = start->model == ISO_BALL;
    return o;
}

/* --- closed forms ---------------------------------------------------------------------------------------------- */

static laws_worst turn, period;

/* A turn about a principal axis at rate W: n is back after 2 pi/(|k| W), s has grown by an elliptic integral. */
static void check_turn(double k, const double J[3], int axis, double W, iso_backend backend)
{
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const iso_params p = laws_params(k, J);
    const double least = fmin(J[i], J[j]), most = fmax(J[i], J[j]), modulus = sqrt(1 - least / most);
    iso_start start = {.model = ISO_BALL};
    start.y[axis] = W;
    start.y[3 + i] = 0.6;
    start.y[3 + j] = 0.8;
    const iso_orbit_options o = ball_and_s(&start, backend, 1e-14);
    iso_orbit *orbit = scene_by(ctx, &p, &start, &o);
    const double T = 2 * M_PI / fabs(k * W), root = sqrt(2 * iso_orbit_coupling(orbit));
    const iso_sample whole = scene_at(ctx, orbit, T), half = scene_at(ctx, orbit, -T / 2);
    double opposite[3];
    for (int c = 0; c < 3; c++) opposite[c] = -half.ball[3 + c];
    laws_note(&turn, laws_distance(whole.ball + 3, start.y + 3), 1e-12, &p, "n");
    laws_note(&turn, laws_distance(opposite, start.y + 3), 1e-12, &p, "-n");
    laws_note(&turn, laws_distance(whole.ball, start.y) / fabs(W), 1e-12, &p, "w");
    if (fabs(k) == 1) {
        const double s = k == 1 ? 4 * sqrt(most) * gsl_sf_ellint_Ecomp(modulus, GSL_PREC_DOUBLE) / root
                                : 4 * gsl_sf_ellint_Kcomp(modulus, GSL_PREC_DOUBLE) / (root * sqrt(most));
        laws_note(&period, fabs(whole.clock[ISO_CLOCK_S] / s - 1), 1e-12, &p, "whole");
        laws_note(&period, fabs(half.clock[ISO_CLOCK_S] / s + 0.5), 1e-12, &p, "half");
    }
    iso_orbit_free(orbit);
}

static void check_turns(void)
{
    static const double ks[] = {1, -1, 0.5, -0.3, 4},
                        Js[][3] = {{1.4, 2.1, 3.0}, {3.0, 0.7, 1.1}, {2, 2, 3}, {40, 1, 5}};
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++)
        for (size_t j = 0; j < sizeof Js / sizeof *Js; j++)
            for (int axis = 0; axis < 3; axis++)
                for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++)
                    check_turn(ks[i], Js[j], axis, axis == 1 ? -0.3 : 2, b);
    laws_report(&turn, "a turn in a principal plane");
    laws_report(&period, "its period in s");
}

/* k -> 0: n stands still in the body, which is then Suslov's: J w' = J w x w + lambda n, (w,n) = 0. With u = n x J n,
 * (J w,u) = S tanh(r t + const), S^2 = 2 h (u,J u), r = S/(g det J): w goes from -u to u. */
static double suslov(const iso_params *p, const double y[ISO_STATE], double t)
{
    double Jw[3], Jn[3], u[3];
    diag(p->J, y, Jw);
    diag(p->J, y + 3, Jn);
    cross(y + 3, Jn, u);
    const double S = sqrt(dot(y, Jw) * dot_diag(u, p->J, u));
    const double rate = S / (dot_diag(y + 3, p->inv_J, y + 3) * p->det_J);
    return tanh(rate * t + atanh(dot(Jw, u) / S));
}

/* The distance from Suslov's motion falls like k. */
static void check_small_k(void)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    const iso_start start = {.model = ISO_BALL, .y = {0.8, 0.5, -0.6, 0.6, 0, 0.8}};
    for (int side = -1; side <= 1; side += 2)
        for (double k = 1e-3, last = 0; k > 1e-6; k /= 10) {
            const iso_params p = laws_params(side * k, J);
            iso_orbit_options o = iso_orbit_defaults(&start);
            o.backend = ISO_BACKEND_BALL;
            o.tolerance = 1e-14;
            iso_orbit *orbit = scene_by(ctx, &p, &start, &o);
            double most = 0;
            for (int t = -4; t <= 4; t++) {
                iso_sample s = scene_at(ctx, orbit, t);
                copy(start.y + 3, s.ball + 3, 3); /* w against the body's n of the start */
                most = fmax(most, fabs(suslov(&p, s.ball, 0) - suslov(&p, start.y, t)));
            }
            gsl_test(!(most < 20 * k), "k = %g: Suslov's body to %.2g", side * k, most);
            if (last > 0)
                gsl_test(!(fabs(most / last - 0.1) < 0.05), "k = %g: %.3g of ten times k", side * k, most / last);
            last = most;
            iso_orbit_free(orbit);
        }
}

/* --- events ---------------------------------------------------------------------------------------------------- */

static double n3(const iso_sample *s, const void *data)
{
    (void)data;
    return s->ball[5];
}

/* The next events n3 = 0 of both backends are the same, and are where iso_orbit_at finds n3 = 0. */
static void check_events(double k, double w, iso_clock clock, int direction, laws_worst *worst)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    const iso_params p = laws_params(k, J);
    const iso_start start = {.model = ISO_BALL, .y = {0.8 * w, 0.5 * w, -0.6 * w, 0.6, 0, 0.8}};
    iso_orbit *orbit[2];
    double from[2] = {0, 0};
    for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++) {
        iso_orbit_options o = ball_and_s(&start, b, 1e-14);
        o.clock = clock;
        o.with_clock[ISO_CLOCK_T] = true;
        orbit[b] = scene_by(ctx, &p, &start, &o);
    }
    const double end = iso_unit(iso_orbit_units(orbit[0]), iso_clock_dimension(clock)) * 1000;
    for (int i = 0; i < 6; i++) {
        iso_sample s[2];
        for (int b = 0; b < 2; b++) {
            bool found = false;
            const iso_status status = iso_orbit_event(orbit[b], n3, NULL, direction, from[b], end, &found, &s[b]);
            laws_stop_if(ctx, status != ISO_OK || !found, "an event is not found");
            const iso_sample there = scene_at(ctx, orbit[b], s[b].clock[clock]);
            laws_note(worst, fabs(s[b].ball[5]), 1e-13, &p, "n3");
            laws_note(worst, laws_distance(there.ball + 3, s[b].ball + 3), 1e-12, &p, "at");
            from[b] = s[b].clock[clock];
            const double rate = p.k * (s[b].ball[3] * s[b].ball[1] - s[b].ball[4] * s[b].ball[0]); /* n3' */
            laws_note(worst, direction * rate < 0 ? 1 : 0, 0.5, &p, "direction");
        }
        laws_note(worst, fabs(s[0].clock[ISO_CLOCK_T] / s[1].clock[ISO_CLOCK_T] - 1), 1e-11, &p, "time");
        laws_note(worst, laws_distance(s[0].ball, s[1].ball) / laws_norm(s[0].ball), 1e-11, &p, "w");
    }
    for (int b = 0; b < 2; b++) iso_orbit_free(orbit[b]);
}

/* --- refusals -------------------------------------------------------------------------------------------------- */

static void refused(iso_status got, iso_status wanted, const char *word, const char *what)
{
    gsl_test(got != wanted || !strstr(iso_context_message(ctx), word), "%s: %s (%s)", what, iso_status_text(got),
             got == ISO_OK ? "" : iso_context_message(ctx));
}

static iso_status try_create(const iso_params *p, const iso_start *start, const iso_orbit_options *o)
{
    iso_orbit *orbit;
    const iso_status status = iso_orbit_create(ctx, p, start, o, &orbit);
    iso_orbit_free(orbit);
    return status;
}

/* Where M or a clock is no double, or k too extreme for them, that is said; the ball in its own time is had. */
static void check_range(double k, double J, double w, const char *word)
{
    const double long_J[3] = {J, 2.1 * J, 3 * J};
    const iso_params p = laws_params(k, long_J);
    const iso_start start = {.model = ISO_BALL, .y = {0.8 * w, 0.1 * w, -0.6 * w, 0.6, 0, 0.8}};
    iso_orbit_options o = iso_orbit_defaults(&start);
    iso_orbit *orbit = scene_by(ctx, &p, &start, &o);
    iso_sample s = scene_at(ctx, orbit, 3 / (w * fmax(1, fabs(k))));
    scale(s.ball, 1 / w);
    gsl_test_rel(dot_diag(s.ball, p.J, s.ball) / J, 1.741, 1e-11, "k = %g, J = %g, w = %g: the ball alone", k, J, w);
    iso_orbit_free(orbit);
    for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++) {
        o.backend = b;
        o.shown = ISO_SHOW_BOTH;
        refused(try_create(&p, &start, &o), ISO_NUMERICAL, word, "its point");
    }
    o = iso_orbit_defaults(&start);
    o.with_clock[ISO_CLOCK_S] = true;
    refused(try_create(&p, &start, &o), ISO_NUMERICAL, word, "its s");
}

/* Stopped on the way, the orbit still answers up to the last good moment. */
static void check_failure(iso_backend backend)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    const iso_params p = laws_params(-0.3, J);
    const iso_start start = {.model = ISO_BALL, .y = {0.8, 0.5, -0.6, 0.6, 0, 0.8}};
    iso_orbit_options o = ball_and_s(&start, backend, 1e-12);
    iso_orbit *whole = scene_by(ctx, &p, &start, &o);
    o.max_steps = 30;
    iso_orbit *orbit = scene_by(ctx, &p, &start, &o);
    iso_sample s;
    refused(iso_orbit_at(orbit, 1000, &s), ISO_NUMERICAL, "last good t", "more steps than allowed");
    const char *said = strstr(iso_context_message(ctx), "last good t = ");
    const double said_t = said ? strtod(said + strlen("last good t = "), NULL) : NAN;
    const double t = nextafter(iso_orbit_reached(orbit), 0); /* the moment itself, in own time, may round up */
    laws_stop_if(ctx, iso_orbit_at(orbit, t, &s) != ISO_OK, "the last good moment");
    gsl_test(!(t > 1 && t < 1000) || said_t != iso_orbit_reached(orbit), "the last good time is %g", t);
    const iso_sample truth = scene_at(ctx, whole, t), before = scene_at(ctx, orbit, 0.999 * t),
                     truth_before = scene_at(ctx, whole, 0.999 * t);
    gsl_test(!(laws_distance(s.ball, truth.ball) < 1e-13) || !(fabs(s.clock[2] / truth.clock[2] - 1) < 1e-13),
             "the last good moment is on the orbit");
    gsl_test(memcmp(&before, &truth_before, sizeof before) != 0, "after a failure: earlier times are still answered");
    iso_orbit_free(orbit);
    iso_orbit_free(whole);
}

int main(void)
{
    laws_worst events = {0};
    ctx = iso_context_create();
    check_turns();
    check_small_k();
    for (iso_clock c = ISO_CLOCK_T; c < ISO_CLOCKS; c++)
        for (int direction = -1; direction <= 1; direction++) {
            check_events(1, 1, c, direction, &events);
            check_events(-1, 1, c, direction, &events);
            check_events(4, 1e-30, c, direction, &events);
            check_events(0.5, 1e100, c, direction, &events);
        }
    laws_report(&events, "events n3 = 0");
    check_range(-0.05, 1e30, 1, "fit a double");
    check_range(0.02, 1e30, 1, "fit a double");
    check_range(1, 1e100, 1e170, "fit a double");
    check_range(1, 1e-100, 1e-170, "fit a double");
    check_range(1e-6, 1, 1, "k = 1e-06");
    check_range(-1e-6, 1, 1, "k = -1e-06");
    check_range(1e-200, 1, 1, "k = 1e-200");
    check_range(1e200, 1, 1e-200, "k = 1e+200");
    check_failure(ISO_BACKEND_BALL);
    check_failure(ISO_BACKEND_POINT);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

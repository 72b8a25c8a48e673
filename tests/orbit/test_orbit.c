/* One orbit, however it is asked for: by either backend, in any clock, in other units, from either side. */
#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "laws.h"
#include "model/model_impl.h"
#include "orbit/orbit.h"
#include "scenes.h"

static const double J_three[3] = {1.4, 2.1, 3.0};

static iso_context *ctx;

/* --- orbits ---------------------------------------------------------------------------------------------------- */

static iso_start random_start(const iso_params *p, iso_random *random)
{
    iso_problem f = {.p = *p};
    iso_start start = {.model = ISO_BALL};
    laws_sample(&iso_system_ball, &f, random, start.y);
    return start;
}

/* Largest of the relative differences of w and M and the differences of n and gamma. */
static double state_difference(const iso_sample *a, const iso_sample *b)
{
    const double d[4] = {
        laws_distance(a->ball, b->ball) / laws_norm(b->ball), laws_distance(a->ball + 3, b->ball + 3),
        laws_distance(a->point, b->point) / laws_norm(b->point), laws_distance(a->point + 3, b->point + 3)};
    return laws_max(4, d);
}

/* Of the clocks, relative. */
static double clock_difference(const iso_sample *a, const iso_sample *b)
{
    double d[ISO_CLOCKS];
    for (int c = 0; c < ISO_CLOCKS; c++) d[c] = a->clock[c] / b->clock[c] - 1;
    return laws_max(ISO_CLOCKS, d);
}

/* --- the same orbit by both backends and in every clock -------------------------------------------------------- */

enum { TIMES = 4 };
static const double times[TIMES] = {0.7, 4, 9, -6};

static laws_worst backends, clocks, origin;

/* At tolerance 1e-14: for the exponents 1/k, for the number of turns, and for the chaos of a long body, whose orbits
 * part by a factor 1e4 in the times above. */
static double allowed(const iso_params *p)
{
    return 1e-12 * (1 + 1 / fabs(p->k) + fabs(p->k) / 5) * pow(laws_spread(p), 1.25);
}

/* The time t in which a clock would have come to its value at its present rate: its relative error times this is an
 * error in t, large where s was spent near the least or the largest q. */
static double lost_time(const iso_params *p, iso_clock clock, const iso_sample *s)
{
    const double q = dot_diag(s->point + 3, p->J, s->point + 3);
    return fabs(s->clock[clock]) / iso_clock_rate(p, clock, q, NULL);
}

static void note_clock(const iso_params *p, iso_clock asked, const iso_sample *s, const iso_sample *truth)
{
    const double q = dot_diag(truth->point + 3, p->J, truth->point + 3), lost = lost_time(p, asked, truth);
    const char *name = iso_clock_name(asked);
    laws_note(&clocks, state_difference(s, truth), allowed(p) * (1 + lost * laws_norm(truth->ball)), p, name);
    for (iso_clock c = ISO_CLOCK_T; c < ISO_CLOCKS; c++) {
        const double lost_here = lost * iso_clock_rate(p, c, q, NULL) / fabs(truth->clock[c]);
        laws_note(&clocks, fabs(s->clock[c] / truth->clock[c] - 1), allowed(p) * (1 + lost_here), p, name);
    }
}

static void check_clocks(const iso_params *p, const iso_start *start, iso_backend backend, const iso_sample *truth)
{
    for (iso_clock c = ISO_CLOCK_TAU; c <= ISO_CLOCK_S; c++) {
        iso_orbit *orbit = scene_whole(ctx, p, start, backend, c);
        for (int i = 0; i < TIMES; i++) {
            const iso_sample s = scene_at(ctx, orbit, truth[i].clock[c]);
            note_clock(p, c, &s, &truth[i]);
        }
        iso_orbit_free(orbit);
    }
}

static void check_orbit(const iso_params *p, const iso_start *start)
{
    iso_orbit *ball = scene_whole(ctx, p, start, ISO_BACKEND_BALL, ISO_CLOCK_T),
              *point = scene_whole(ctx, p, start, ISO_BACKEND_POINT, ISO_CLOCK_T);
    const double ulps = 8 * DBL_EPSILON * (1 + 1 / fabs(p->k));
    iso_sample truth[TIMES], begin[2] = {scene_at(ctx, ball, 0), scene_at(ctx, point, 0)};
    for (int b = 0; b < 2; b++) {
        const double none[ISO_CLOCKS] = {0};
        laws_note(&origin, laws_distance(begin[b].ball, start->y), ulps * laws_norm(start->y), p, "w");
        laws_note(&origin, laws_distance(begin[b].ball + 3, start->y + 3), ulps, p, "n");
        laws_note(&origin, memcmp(begin[b].clock, none, sizeof none) == 0 ? 0 : 1, 0.5, p, "clocks");
    }
    for (int i = 0; i < TIMES; i++) {
        truth[i] = scene_at(ctx, ball, times[i]);
        const iso_sample other = scene_at(ctx, point, times[i]);
        laws_note(&backends, state_difference(&other, &truth[i]), allowed(p), p, "state");
        laws_note(&backends, clock_difference(&other, &truth[i]), allowed(p), p, "clocks");
    }
    iso_orbit_free(ball);
    iso_orbit_free(point);
    for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++) check_clocks(p, start, b, truth);
}

static void check_backends(void)
{
    static const double ks[] = {1, -1, 0.5, 0.75, -0.4, 1.5, -2, 0.25, 4, 0.05, 50, -0.3, -0.05};
    static const double Js[][3] = {{1.4, 2.1, 3.0}, {3.0, 1.4, 2.1}, {2, 3, 2}, {2, 2, 2}, {1, 30, 1000}};
    iso_random *random = iso_random_create(5);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++)
        for (size_t j = 0; j < sizeof Js / sizeof *Js; j++) {
            const iso_params p = laws_params(ks[i], Js[j]);
            const iso_start start = random_start(&p, random);
            check_orbit(&p, &start);
        }
    iso_random_free(random);
    laws_report(&backends, "backends ball and point agree");
    laws_report(&clocks, "asked in tau and s: the same orbit");
    laws_report(&origin, "time 0 is the start");
}

/* --- from the point's side ------------------------------------------------------------------------------------- */

static laws_worst from_point;

/* The start of the same orbit as seen by the point; its coupling stated, or left to the level H = 0. */
static void check_point_start(const iso_params *p, const iso_start *ball)
{
    iso_orbit *orbit = scene_whole(ctx, p, ball, ISO_BACKEND_BALL, ISO_CLOCK_T);
    const iso_sample begin = scene_at(ctx, orbit, 0), truth = scene_at(ctx, orbit, 4);
    const double eps[2] = {iso_orbit_coupling(orbit), NAN};
    iso_orbit_free(orbit);
    for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++)
        for (int i = 0; i < 2; i++) {
            iso_start start;
            laws_stop_if(ctx,
                         iso_start_point(ctx, begin.point, begin.point + 3, isnan(eps[i]) ? NULL : &eps[i], false,
                                         &start) != ISO_OK,
                         "a point's start");
            orbit = scene_whole(ctx, p, &start, b, ISO_CLOCK_S);
            const iso_sample s = scene_at(ctx, orbit, truth.clock[ISO_CLOCK_S]);
            laws_note(&from_point, state_difference(&s, &truth), 10 * allowed(p), p, "state");
            laws_note(&from_point, clock_difference(&s, &truth), 10 * allowed(p), p, "clocks");
            laws_note(&from_point, fabs(iso_orbit_coupling(orbit) / eps[0] - 1), 1e-13 * (1 + 1 / fabs(p->k)), p,
                      "eps");
            iso_orbit_free(orbit);
        }
}

static void check_point_starts(void)
{
    static const double ks[] = {1, -1, 0.5, -0.3, 4, 50};
    iso_random *random = iso_random_create(7);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) {
        const iso_params p = laws_params(ks[i], J_three);
        const iso_start start = random_start(&p, random);
        check_point_start(&p, &start);
    }
    iso_random_free(random);
    laws_report(&from_point, "a start of the point is that of its ball");
}

static iso_status try_create(const iso_params *p, const iso_start *start, const iso_orbit_options *o)
{
    iso_orbit *orbit;
    const iso_status status = iso_orbit_create(ctx, p, start, o, &orbit);
    iso_orbit_free(orbit);
    return status;
}

static void refused(iso_status got, iso_status wanted, const char *word, const char *what)
{
    gsl_test(got != wanted || !strstr(iso_context_message(ctx), word), "%s: %s (%s)", what, iso_status_text(got),
             got == ISO_OK ? "" : iso_context_message(ctx));
}

static void check_rest(void)
{
    const iso_params p = laws_params(0.5, J_three);
    const iso_start start = {.model = ISO_BALL, .y = {0, 0, 0, 0.6, 0, 0.8}};
    iso_orbit_options o = iso_orbit_defaults(&start);
    iso_orbit *orbit;
    o.with_clock[ISO_CLOCK_S] = o.with_clock[ISO_CLOCK_TAU] = true;
    laws_stop_if(ctx, iso_orbit_create(ctx, &p, &start, &o, &orbit) != ISO_OK, "a ball at rest");
    const iso_sample s = scene_at(ctx, orbit, 100);
    const double q = 1 / dot_diag(start.y + 3, p.inv_J, start.y + 3);
    gsl_test(laws_norm(s.ball) != 0 || laws_distance(s.ball + 3, start.y + 3) > 1e-15, "at rest nothing moves");
    gsl_test_rel(s.clock[ISO_CLOCK_S], 100 * iso_clock_rate(&p, ISO_CLOCK_S, q, NULL), 1e-13,
                 "at rest s runs evenly");
    iso_orbit_free(orbit);
    o.shown = ISO_SHOW_BOTH;
    refused(try_create(&p, &start, &o), ISO_NOT_MAPPED, "at rest", "at rest: as both");
    o.shown = ISO_SHOW_BALL, o.backend = ISO_BACKEND_POINT;
    refused(try_create(&p, &start, &o), ISO_NOT_MAPPED, "at rest", "at rest: backend point");
}

/* --- units ----------------------------------------------------------------------------------------------------- */

static laws_worst inertias;

/* J -> c J leaves (w, n, t); tau ~ J^(1 - 1/(2k)), s ~ J^(-2 + 1/(2k)), M ~ J^(2 - 1/(2k)), eps ~ J^4. */
static void check_inertias(const iso_params *p, const iso_start *start, iso_backend backend)
{
    static const double cs[] = {1e-30, 1e-11, 0.37, 5.1, 1e11, 1e30};
    const double half = 1 / (2 * p->k);
    iso_orbit *orbit = scene_whole(ctx, p, start, backend, ISO_CLOCK_T);
    const iso_sample truth = scene_at(ctx, orbit, 4);
    const double eps = iso_orbit_coupling(orbit), h = iso_orbit_energy(orbit);
    iso_orbit_free(orbit);
    for (size_t i = 0; i < sizeof cs / sizeof *cs; i++) {
        const double c = cs[i], J[3] = {c * p->J[0], c * p->J[1], c * p->J[2]};
        const double clock[ISO_CLOCKS] = {1, pow(c, 1 - half), pow(c, -2 + half)};
        const iso_params heavy = laws_params(p->k, J);
        orbit = scene_whole(ctx, &heavy, start, backend, ISO_CLOCK_T);
        iso_sample s = scene_at(ctx, orbit, 4);
        for (int j = 0; j < ISO_CLOCKS; j++) s.clock[j] /= clock[j];
        scale(s.point, 1 / pow(c, 2 - half));
        laws_note(&inertias, fmax(state_difference(&s, &truth), clock_difference(&s, &truth)), 1e-11, p,
                  iso_backend_name((int)backend));
        laws_note(&inertias, fabs(iso_orbit_coupling(orbit) / pow(c, 4) / eps - 1), 1e-13, p, "eps");
        laws_note(&inertias, fabs(iso_orbit_energy(orbit) / c / h - 1), 1e-13, p, "h");
        iso_orbit_free(orbit);
    }
}

static void check_scaling(void)
{
    static const double ks[] = {1, -1, 0.6, -0.3, 4, 0.1};
    iso_random *random = iso_random_create(8);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) {
        const iso_params p = laws_params(ks[i], J_three);
        const iso_start start = random_start(&p, random);
        check_inertias(&p, &start, ISO_BACKEND_BALL);
        check_inertias(&p, &start, ISO_BACKEND_POINT);
    }
    iso_random_free(random);
    laws_report(&inertias, "J from 1e-30 to 1e30: the same ball");
}

int main(void)
{
    gsl_test_verbose(1);
    ctx = iso_context_create();
    check_backends();
    check_point_starts();
    check_rest();
    check_scaling();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

/* A point at any energy H and its ball: off the level H = 0 the ball lives in the potential of the effect `level`,
 * U = -c g^(-1/k), c = H k^2/det J, g = (n, J^-1 n). That this is its law of motion: model/level, effects. */
#include "orbit/orbit_impl.h"
#include "scenes.h"

static const double J_three[3] = {1.4, 2.1, 3.0};

static iso_context *ctx;

static iso_start point_start(const double M[3], const double gamma[3], const double *eps)
{
    iso_start start;
    laws_stop_if(ctx, iso_start_point(ctx, M, gamma, eps, true, &start) != ISO_OK, "a point's start");
    return start;
}

/* --- one orbit -------------------------------------------------------------------------------------------------- */

enum { TIMES = 5 };

typedef struct off_level {
    iso_params p;
    double eps, H, c;
    iso_start start;
    iso_sample truth[TIMES]; /* by backend point, in its own clock */
    double w, M;             /* largest |omega| and |M| of these   */
} off_level;

/* A point in a potential of about one energy, with `part` of it as kinetic energy: 1 is the level H = 0. */
static off_level make(double k, double eps, double part, iso_random *random)
{
    off_level o = {.p = laws_params(k, J_three)};
    double gamma[3], M[3];
    iso_random_direction(random, gamma);
    iso_random_direction(random, M);
    remove_along(M, gamma);
    o.eps = eps * pow(dot_diag(gamma, o.p.J, gamma), 1 / k);
    scale(M, sqrt(2 * part) / norm(M));
    o.start = point_start(M, gamma, &o.eps);
    const double *y = o.start.y; /* (24), by hand */
    o.H = dot(y, y) / 2 - o.eps * pow(dot_diag(y + 3, o.p.J, y + 3), -1 / k);
    o.c = o.H * k * k / o.p.det_J;
    iso_orbit *orbit = scene_whole(ctx, &o.p, &o.start, ISO_BACKEND_POINT, ISO_CLOCK_S);
    for (int i = 0; i < TIMES; i++) {
        o.truth[i] = scene_at(ctx, orbit, 0.9 * i - 0.6); /* before and after the start */
        o.w = fmax(o.w, laws_norm(o.truth[i].ball));
        o.M = fmax(o.M, laws_norm(o.truth[i].point));
    }
    iso_orbit_free(orbit);
    return o;
}

/* --- what holds ------------------------------------------------------------------------------------------------- */

static laws_worst levels, backends;

static double allowed(const iso_params *p)
{
    return 1e-13 * (4 + 4 / fabs(p->k) + fabs(p->k));
}

/* The level that was added has c = H k^2/det J; a ball that starts where this one does, on this level, has the eps. */
static void check_added(const off_level *o)
{
    iso_orbit *orbit = scene_whole(ctx, &o->p, &o->start, ISO_BACKEND_AUTO, ISO_CLOCK_S);
    const iso_effects effects = iso_orbit_effects(orbit);
    const iso_sample begin = scene_at(ctx, orbit, 0);
    const double terms = fabs(o->H) + dot(o->start.y, o->start.y), size = terms * fabs(o->c / o->H);
    laws_note(&levels, effects.on[ISO_LEVEL] ? fabs(LEVEL_C(&effects) - o->c) : 1, 1e-14 * size, &o->p, "c");
    laws_note(&levels, iso_orbit_has_twin(orbit) ? 0 : 1, 0.5, &o->p, "twin");
    iso_orbit_free(orbit);
    iso_start ball = {.model = ISO_BALL};
    copy(begin.ball, ball.y, ISO_STATE);
    iso_orbit_options options = scene_all(&ball, ISO_BACKEND_AUTO, ISO_CLOCK_S);
    options.effects = &effects;
    orbit = scene_by(ctx, &o->p, &ball, &options);
    const double unit = pow(dot_diag(begin.point + 3, o->p.J, begin.point + 3), 1 / o->p.k);
    laws_note(&levels, fabs(iso_orbit_coupling(orbit) - o->eps), 1e-13 * terms * unit, &o->p, "eps");
    iso_orbit_free(orbit);
}

/* Both backends, in every clock. */
static void check_backends(const off_level *o)
{
    for (iso_backend b = ISO_BACKEND_BALL; b <= ISO_BACKEND_POINT; b++)
        for (iso_clock c = ISO_CLOCK_T; c < ISO_CLOCKS; c++) {
            iso_orbit *orbit = scene_whole(ctx, &o->p, &o->start, b, c);
            for (int i = 0; i < TIMES; i++) {
                const iso_sample *truth = &o->truth[i], s = scene_at(ctx, orbit, truth->clock[c]);
                const double bound = allowed(&o->p);
                laws_note(&backends, laws_distance(s.ball, truth->ball) / o->w, bound, &o->p, "omega");
                laws_note(&backends, laws_distance(s.ball + 3, truth->ball + 3), bound, &o->p, "n");
                laws_note(&backends, laws_distance(s.point, truth->point) / o->M, bound, &o->p, "M");
                laws_note(&backends, laws_distance(s.point + 3, truth->point + 3), bound, &o->p, "gamma");
                for (int j = 0; j < ISO_CLOCKS; j++)
                    laws_note(&backends, fabs(s.clock[j] / truth->clock[j] - 1), bound, &o->p, "clocks");
            }
            iso_orbit_free(orbit);
        }
}

static void check_all(void)
{
    static const double ks[] = {1, -1, 0.5, 0.75, -0.4, 4, 0.2}, eps[] = {1, 1, -1, 0}, part[] = {0.2, 3, 0.5, 1};
    iso_random *random = iso_random_create(23);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++)
        for (int j = 0; j < 4; j++) {
            const off_level o = make(ks[i], eps[j], part[j], random);
            check_added(&o);
            check_backends(&o);
        }
    iso_random_free(random);
    laws_report(&levels, "off the level H = 0: c = H k^2/det J");
    laws_report(&backends, "both backends, every clock");
}

/* --- a level that the caller states ----------------------------------------------------------------------------- */

static iso_status try_level(const off_level *o, const iso_start *start, double c, double *eps)
{
    iso_orbit *orbit;
    iso_orbit_options options = iso_orbit_defaults(start);
    const iso_effects effects = {.on[ISO_LEVEL] = true, .number[ISO_LEVEL] = {c}};
    options.effects = &effects;
    const iso_status status = iso_orbit_create(ctx, &o->p, start, &options, &orbit);
    *eps = status == ISO_OK ? iso_orbit_coupling(orbit) : NAN;
    iso_orbit_free(orbit);
    return status;
}

static void check_stated(void)
{
    iso_random *random = iso_random_create(24);
    const off_level o = make(-0.4, 1, 0.3, random);
    iso_random_free(random);
    double eps;
    gsl_test(try_level(&o, &o.start, o.c, &eps) != ISO_OK, "the point's own level");
    gsl_test_rel(eps, o.eps, 1e-14, "its coupling");
    gsl_test(try_level(&o, &o.start, o.c * (1 + 1e-6), &eps) != ISO_BAD_INPUT ||
                 strcmp(iso_context_about(ctx), "c") != 0,
             "another level: %s", iso_context_message(ctx));
    iso_start open = o.start;
    open.eps = NAN;
    gsl_test(try_level(&o, &open, o.c, &eps) != ISO_OK, "a level and no coupling");
    gsl_test_rel(eps, o.eps, 1e-13, "the coupling follows from the level");
}

int main(void)
{
    ctx = iso_context_create();
    check_all();
    check_stated();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

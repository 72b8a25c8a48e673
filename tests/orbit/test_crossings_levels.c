/* Crossings on levels H = E: reference/levels.csv by both models; and, over random motions, that the return map keeps
 * dL dl, that Sturm's bounds hold, that the reversors S1, S2, S3 turn orbits back in the same time, and that rows keep
 * their energy. */
#include "base/math_impl.h"
#include "crossed.h"
#include "map/section_impl.h"
#include "map/state.h"
#include "reference.h"

static iso_context *ctx;

/* A start on the level H = energy of the coupling eps = 1, as a point, or as a ball with the effect `level`. */
typedef struct motion {
    iso_params p;
    double energy;
    iso_start start;
    iso_effects effects;
} motion;

static motion motion_at(const iso_params *p, double energy, const double point[ISO_STATE], iso_model_kind model)
{
    motion m = {.p = *p, .energy = energy, .start = {.model = model, .eps = 1}, .effects = iso_effects_default()};
    const double c = iso_energy(p, energy);
    copy(point, m.start.y, ISO_STATE);
    if (model == ISO_POINT) return m;
    iso_point_to_ball(p, point, m.start.y);
    iso_effects_set(ctx, &m.effects, "level", "c", 1, &c);
    return m;
}

static bool follow(const motion *m, iso_crossings_options o, size_t count, iso_crossing at[], iso_sample sample[])
{
    return crossed(ctx, &(iso_batch_orbit){&m->p, &m->start, &m->effects}, &o, count, at, sample);
}

/* --- the reference ---------------------------------------------------------------------------------------------- */

enum { NUMBERS = 22, MOST = 20 };

/* Numbers of a row behind its name. */
enum { K, J1, EPS = 4, M_0, G_0 = 8, LEVEL = 11, AXIS, CROSSING, S, T, M_1, G_1 = 19 };

/* Bounds: 1e-11 times what the orbit makes of an error of its start. */
static void reference_row(const char *name, const double v[NUMBERS], iso_backend backend, iso_model_kind model,
                          laws_worst *chart, laws_worst *clocks)
{
    const iso_params p = laws_params(v[K], v + J1);
    double point[ISO_STATE], there[ISO_STATE], l, x;
    copy(v + M_0, point, 3);
    copy(v + G_0, point + 3, 3);
    scale(point + 3, 1 / norm(point + 3));
    remove_along(point, point + 3);
    const motion m = motion_at(&p, v[LEVEL], point, model);
    iso_crossings_options o = iso_crossings_defaults();
    iso_crossing at[MOST];
    o.backend = backend;
    o.axis = (int)v[AXIS] - 1;
    o.deviations = true;
    const size_t count = (size_t)v[CROSSING];
    gsl_test_int(iso_section_axis(iso_free_point(&p, 1)), o.axis, "%s: its global axis", name);
    if (!follow(&m, o, count, at, NULL)) return;
    const iso_crossing *last = &at[count - 1];
    const double growth = exp(fmax(0, fmax(last->growth[0], last->growth[1])));
    copy(v + M_1, there, 3);
    copy(v + G_1, there + 3, 3);
    iso_section_chart(o.axis, there, &l, &x);
    laws_note(chart, fabs(remainder(last->l - l, 2 * ISO_PI)), 1e-11 * growth, &p, name);
    laws_note(chart, fabs(last->x - x), 1e-11 * growth, &p, name);
    laws_note(clocks, fabs(last->clock[ISO_CLOCK_T] / v[T] - 1), 1e-11 * growth, &p, name);
    laws_note(clocks, fabs(last->clock[ISO_CLOCK_S] / v[S] - 1), 1e-11 * growth, &p, name);
}

static void check_reference(iso_backend backend, iso_model_kind model)
{
    FILE *file = fopen(ISO_TEST_DATA "/levels.csv", "r");
    laws_worst chart = {0}, clocks = {0};
    char line[2048], name[64];
    while (file && fgets(line, sizeof line, file)) {
        double v[NUMBERS];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(line, ","), line);
        if (strncmp(line, "lev", 3) == 0 && reference_numbers(line, NUMBERS, v))
            reference_row(name, v, backend, model, &chart, &clocks);
    }
    if (file) fclose(file);
    snprintf(name, sizeof name, "%s of a %s: l and x of levels.csv", iso_backend_name((int)backend),
             iso_model_kind_name((int)model));
    laws_report(&chart, name);
    snprintf(name, sizeof name, "%s of a %s: t and s of levels.csv", iso_backend_name((int)backend),
             iso_model_kind_name((int)model));
    laws_report(&clocks, name);
}

/* --- laws ------------------------------------------------------------------------------------------------------- */

/* Motion i: for E < 0 a part of the sphere may be closed. E is between the ends of V, or above by up to 4. */
static iso_point_motion random_motion(iso_random *r, int i, iso_params *p)
{
    static const double ks[] = {0.5, -0.5, 1, -1, 0.3, -0.3, 2, -2, 0.2};
    const double J[3] = {iso_random_uniform(r, 1, 3), iso_random_uniform(r, 1, 3), iso_random_uniform(r, 1, 3)};
    *p = laws_params(ks[i % 9], J);
    const double one = -pow(min3(J), -1 / p->k), other = -pow(max3(J), -1 / p->k);
    const double bottom = fmin(one, other), top = fmax(one, other);
    return (iso_point_motion){p, 1,
                              i % 2 ? bottom + iso_random_uniform(r, 0.2, 1) * (top - bottom)
                                    : top + iso_random_uniform(r, 0, 4) * (top - bottom)};
}

/* det f' = G(l)/G(l'), M^2/2 + V = E at the crossing, and times within Sturm's bounds. */
static void hold(iso_point_motion m, int axis, double l, const iso_crossing *c, const iso_sample *sample,
                 const char *what, laws_worst worst[3])
{
    double W[2], size;
    const iso_problem problem = {.p = *m.p, .eps = m.eps, .energy = m.energy};
    const double det = c->slope[0][0] * c->slope[1][1] - c->slope[0][1] * c->slope[1][0];
    const double terms = fabs(c->slope[0][0] * c->slope[1][1]) + fabs(c->slope[0][1] * c->slope[1][0]);
    const double expected = iso_section_momentum(m, axis, l) / iso_section_momentum(m, axis, c->l);
    iso_section_bounds(m, axis, W);
    laws_note(&worst[0], fabs(det - expected), 1e-9 * (terms + expected), m.p, what);
    laws_note(&worst[0], fabs(c->determinant - det / expected), 1e-9 * (1 + terms / expected), m.p, what);
    const double H = iso_system_point.energy(&problem, sample->point, &size);
    laws_note(&worst[1], fabs(H - m.energy), 1e-12 * size, m.p, what);
    const double turn = 2 * ISO_PI / c->clock[ISO_CLOCK_S];
    laws_note(&worst[2], turn >= W[0] * (1 - 1e-9) && turn <= W[1] * (1 + 1e-9) ? 0 : 1, 0.5, m.p, what);
}

/* The orbit from the mirror image of a crossing goes back to the image of the start. S1: (l, -x), S2: (-l, x),
 * S3: (pi - l, x). The error of the way back is that of the way there times what f makes of it. */
static void turn_back(iso_point_motion m, int axis, const double z[2], const iso_crossing *there, iso_backend backend,
                      const char *what, laws_worst *worst)
{
    double grown = 1;
    for (int i = 0; i < 4; i++) grown = fmax(grown, fabs(there->slope[i / 2][i % 2]));
    for (int s = 0; s < 3; s++) {
        const double l = s == 0   ? there->l
                         : s == 1 ? -there->l
                                  : ISO_PI - there->l,
                     x = s == 0 ? -there->x : there->x;
        const double l0 = s == 0 ? z[0] : s == 1 ? -z[0] : ISO_PI - z[0], x0 = s == 0 ? -z[1] : z[1];
        double point[ISO_STATE];
        iso_crossing home;
        iso_crossings_options o = iso_crossings_defaults();
        o.backend = backend;
        o.axis = axis;
        iso_section_point(m, axis, l, x, point);
        const motion back = motion_at(m.p, m.energy, point, ISO_POINT);
        if (!follow(&back, o, 1, &home, NULL)) return;
        const double off = fmax(fabs(remainder(home.l - l0, 2 * ISO_PI)), fabs(home.x - x0));
        laws_note(worst, off, 1e-10 * grown * grown, m.p, what);
        const double time = home.clock[ISO_CLOCK_S] / there->clock[ISO_CLOCK_S] - 1;
        laws_note(worst, fabs(time), 1e-10 * grown * grown, m.p, what);
    }
}

static void check_laws(void)
{
    iso_random *r = iso_random_create(7);
    laws_worst worst[3] = {{0}}, back = {0}, models = {0};
    for (int i = 0; i < tests_length(72, 720); i++) {
        iso_params p;
        char what[96];
        double point[ISO_STATE], l, x;
        iso_crossing at[2];
        const iso_point_motion m = random_motion(r, i, &p);
        const int axis = iso_section_axis(m);
        do {
            l = iso_random_uniform(r, -ISO_PI, ISO_PI);
            x = iso_random_uniform(r, -0.9, 0.9);
        } while (!(iso_section_momentum(m, axis, l) > 0.2 * iso_section_momentum(m, axis, 0)) ||
                 !iso_section_is_open(m, axis, l));
        iso_section_point(m, axis, l, x, point);
        for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++) {
            snprintf(what, sizeof what, "case %d by %s, E = %.4g", i, iso_backend_name((int)backend), m.energy);
            iso_crossings_options o = iso_crossings_defaults();
            iso_sample sample;
            o.backend = backend;
            o.deviations = true;
            o.shown = ISO_SHOW_BOTH;
            const motion orbit = motion_at(&p, m.energy, point, i % 3 ? ISO_POINT : ISO_BALL);
            if (!follow(&orbit, o, 1, &at[backend], &sample)) continue;
            hold(m, axis, l, &at[backend], &sample, what, worst);
            turn_back(m, axis, (double[2]){l, x}, &at[backend], backend, what, &back);
        }
        double grown = 1;
        for (int j = 0; j < 4; j++) grown = fmax(grown, fabs(at[0].slope[j / 2][j % 2]));
        laws_note(&models, fmax(fabs(remainder(at[0].l - at[1].l, 2 * ISO_PI)), fabs(at[0].x - at[1].x)),
                  1e-10 * grown, &p, "ball and point");
    }
    laws_report(&worst[0], "the return map keeps dL dl on every level");
    laws_report(&worst[1], "crossings have the energy of the start");
    laws_report(&worst[2], "returns within Sturm's bounds on every level");
    laws_report(&back, "reversors S1, S2, S3 on every level");
    laws_report(&models, "ball and point on every level");
    iso_random_free(r);
}

int main(void)
{
    ctx = iso_context_create();
    for (iso_backend backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_AUTO; backend++)
        for (int model = 0; model < 2; model++) check_reference(backend, (iso_model_kind)model);
    check_laws();
    iso_context_free(ctx);
    return gsl_test_summary();
}

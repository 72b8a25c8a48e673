/* test_two_point.c - from sample to sample by the equations of motion (method/two_point.h): the clock's gain against
 * an integrated one, the estimate of its error, the defect of samples that lie on no orbit, and where it declines. */
#include "method/two_point_impl.h"
#include "orbits.h"

static iso_context *ctx;

static iso_two_point *create(const iso_model *model)
{
    iso_two_point *b;
    if (iso_two_point_create(ctx, model, 1e-14, &b) == ISO_OK) return b;
    gsl_test(1, "a way between samples: %s", iso_context_message(ctx));
    exit(gsl_test_summary());
}

/* A model in its own clock with the others carried, `h` of which are about `part` of a turn. */
static void follow(const orbit *o, double h, double y[2][ISO_MAX_STATE])
{
    const iso_method *method = iso_method_find("rk8pd");
    memcpy(y[0], o->y0, sizeof o->y0);
    orbit_solve(o, method, &(iso_method_options){.tolerance = 1e-14, .max_steps = 10000}, h, y[1]);
}

static laws_worst gains, estimates, defects, offsets, reversals;
static int declined;

/* One interval: right numbers, where they are given at all. */
static void check_interval(const orbit *o, double h)
{
    const iso_model *m = &o->model;
    const iso_params *p = &m->problem.p;
    iso_two_point *b = create(m);
    iso_gap gap, back, off;
    double y[2][ISO_MAX_STATE], moved[ISO_STATE];
    follow(o, h, y);
    iso_two_point_add(b, y[0]);
    iso_two_point_add(b, y[1]);
    if (!iso_two_point_measure(b, h, 0, &gap)) {
        declined++;
        iso_two_point_free(b);
        return;
    }
    const double rounding = laws_rounding(p);
    for (int i = 0; i < m->clocks; i++) {
        const iso_clock clock = m->clock_of[i];
        const double gained = y[1][m->moving + i], error = fabs(gap.gained[clock] - gained);
        laws_note(&gains, error / fabs(gained), 40 * rounding, p, iso_clock_name(clock));
        laws_note(&estimates, error, gap.error[clock] + 40 * rounding * fabs(gained), p, iso_clock_name(clock));
    }
    laws_note(&defects, gap.defect, 1e-12 + 40 * rounding, p, m->system->name);
    /* backwards: the same, with the other sign */
    iso_two_point_add(b, y[1]);
    iso_two_point_add(b, y[0]);
    laws_note(&reversals,
              iso_two_point_measure(b, -h, 0, &back) ? fabs(back.gained[m->clock_of[0]] + gap.gained[m->clock_of[0]])
                                                     : NAN,
              40 * rounding * fabs(gap.gained[m->clock_of[0]]), p, "back");
    /* a sample beside the orbit has the defect by which it is beside it, to first order in the way */
    copy(y[1], moved, ISO_STATE);
    scale(moved, 1 + 1e-6);
    iso_two_point_add(b, y[0]);
    iso_two_point_add(b, moved);
    if (iso_two_point_measure(b, h, 1e-4, &off))
        laws_note(&offsets, fabs(off.defect - 1e-6), 1e-6 * (0.2 + 2 * h / o->unit), p, "beside");
    iso_two_point_free(b);
}

/* Both systems, all k and J of the laws, and (point) off H = 0; 1/1000 to 1/60 of a turn, where none is declined. */
static void test_dense(void)
{
    for (int k = 0; k < LAWS_K; k++)
        for (int j = 0; j < LAWS_J; j++)
            for (int s = 0; s < 2; s++) {
                if (fabs(laws_k[k]) < 0.2 && laws_J[j][0] * laws_J[j][2] >= 1000) continue; /* powers of 1e30 */
                orbit o = orbit_sample(ctx, iso_systems[s], laws_k[k], laws_J[j], (unsigned long)(31 * k + j));
                const double reach = laws_reach(&o.model.problem.p);
                if (o.model.system == &iso_system_point && j % 3 == 0) { /* off its level */
                    double unused;
                    scale(o.y0, 1.1);
                    o.model.problem.energy = iso_system_point.energy(&o.model.problem, o.y0, &unused);
                }
                orbit_clocks(&o, o.model.system->clock, true, s == 0, false);
                if (o.model.system == &iso_system_ball) orbit_clocks(&o, ISO_CLOCK_T, false, true, true);
                const double part = j % 2 ? 0.01 : 0.1;
                check_interval(&o, part * reach * o.unit);
            }
    laws_report(&gains, "the clocks' gains");
    laws_report(&estimates, "the estimates of their errors");
    laws_report(&defects, "defects of orbits");
    laws_report(&reversals, "the way back");
    laws_report(&offsets, "defects of samples beside the orbit");
    gsl_test(declined > 0, "nothing is declined where samples are close: %d", declined);
}

/* Ten samples in a turn: right where it answers. A whole turn: it declines. */
static void test_wide(void)
{
    int answered = 0;
    for (int k = 0; k < ORBIT_K; k++)
        for (unsigned long seed = 0; seed < 20; seed++) {
            orbit o = orbit_sample(ctx, &iso_system_ball, orbit_k[k], orbit_J, seed);
            orbit_clocks(&o, ISO_CLOCK_T, false, true, true);
            declined = 0;
            check_interval(&o, 0.6 * o.unit);
            answered += !declined;
            declined = 0;
            check_interval(&o, 6 * o.unit);
            gsl_test(!declined, "k = %g, orbit %lu: a whole turn is declined", orbit_k[k], seed);
        }
    laws_report(&gains, "with ten samples in a turn");
    laws_report(&estimates, "their estimates");
    gsl_test(answered < 60, "most of 80 intervals of a tenth of a turn are answered: %d", answered);
}

/* Samples of other equations: the defect of an interval h is about the difference of their right-hand sides. */
static void test_other_equations(void)
{
    orbit o = orbit_sample(ctx, &iso_system_ball, 0.5, orbit_J, 5), other = o;
    iso_gap gap;
    double y[2][ISO_MAX_STATE], f[ISO_MAX_STATE], g[ISO_MAX_STATE], d[3];
    const double h = 1e-3 * o.unit;
    follow(&o, h, y);
    other.model.problem.p = laws_params(0.51, orbit_J);
    orbit_clocks(&other, ISO_CLOCK_T, false, false, true);
    iso_two_point *b = create(&other.model);
    o.model.rhs(&o.model, o.y0, f);
    other.model.rhs(&other.model, o.y0, g);
    for (int i = 0; i < 3; i++) d[i] = h * (f[3 + i] - g[3 + i]);
    iso_two_point_add(b, y[0]);
    iso_two_point_add(b, y[1]);
    gsl_test(!iso_two_point_measure(b, h, 1e-3, &gap), "an interval of another ball is measured");
    gsl_test_rel(norm(gap.motion + 3), norm(d), 0.05, "and has the defect of its equations");
    gsl_test(gap.defect < 1e-8, "which is no rounding: %.2g", gap.defect);
    iso_two_point_free(b);
}

int main(void)
{
    ctx = iso_context_create();
    test_dense();
    test_wide();
    test_other_equations();
    iso_context_free(ctx);
    return gsl_test_summary();
}

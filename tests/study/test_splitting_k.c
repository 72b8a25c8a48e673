/* The splitting of the separatrix, lib/instrument/separatrix/separatrix.h: known values, symmetries, errors, zeros,
 * refusals. */
#include "instrument/separatrix/separatrix.h"
#include "studies.h"
#include "study/level.h"

static const double J_thin[3] = {1.4, 2.1, 3}, J_wide[3] = {1, 2, 5};

static iso_separatrix_splitting at(double k, const double J[3], iso_separatrix_digits digits)
{
    iso_separatrix_splitting s;
    if (iso_separatrix_at(ctx, k, J, 0, digits, &s) != ISO_OK)
        gsl_test(1, "splitting at k = %g: %s", k, iso_context_message(ctx));
    return s;
}

/* k, and x* and m found by two other programs, with difference quotients in doubles; J = (1.4, 2.1, 3). */
static const double table[][3] = {
    {0.5, -0.5793681, 0.006147}, {0.75, -0.6363709, 0.0001087}, {1, -0.6614378, 0}, {-0.5, 0.8508579, 0.001561}};

static void test_table(void)
{
    for (int i = 0; i < 4; i++) {
        const iso_separatrix_splitting s = at(table[i][0], J_thin, ISO_SEPARATRIX_DOUBLE);
        const double dx = fabs(s.x - table[i][1]), dm = fabs(s.m - table[i][2]);
        gsl_test(!(dx <= 5e-8 && dm <= fmax(5e-4 * table[i][2], 1e-8)), "k = %g: x and m differ by %.1e, %.1e",
                 table[i][0], dx, dm);
        gsl_test(s.from_zero != (table[i][2] != 0), "k = %g: told from 0 or not", table[i][0]);
    }
}

static void check_against_quad(double k, const double J[3], const iso_separatrix_splitting *s)
{
    iso_separatrix_splitting q;
    if (iso_separatrix_at(ctx, NAN, J_thin, 0, ISO_SEPARATRIX_QUAD, &q) == ISO_BAD_ARGUMENT)
        return; /* there are none */
    q = at(k, J, ISO_SEPARATRIX_QUAD);
    const double dm = fabs((s->m - q.m) + (s->m_tail - q.m_tail)), dx = fabs((s->x - q.x) + (s->x_tail - q.x_tail));
    gsl_test(!(dm < s->error && dx < s->x_error), "k = %g: the errors cover the distance from 128 bits: %.2g, %.2g",
             k, dm / s->error, dx / s->x_error);
    gsl_test(!(q.error < 1e-26 && q.digits == 32), "k = %g: 128 bits have the error %.1e", k, q.error);
}

/* 128 bits, where there are any: the errors of 64 bits cover the distance. */
static void test_fine(void)
{
    static const double cases[][4] = {
        {-1, 1.4, 2.1, 3}, {-0.4, 0.33, 0.9, 2.2}, {-1, 3, 1.1, 2}, {2, 1, 2, 5}, {0.2, 1, 2, 3}};
    const int count = tests_length(0, 2);
    for (int i = 0; i < count; i++) {
        const iso_separatrix_splitting s = at(cases[i][0], &cases[i][1], ISO_SEPARATRIX_DOUBLE);
        check_against_quad(cases[i][0], &cases[i][1], &s);
    }
}

/* Units and names of axes change nothing. */
static void test_symmetries(void)
{
    double worst = 0;
    for (int i = 0; i < tests_length(1, 2); i++) {
        const double k = i == 0 ? -0.6 : 0.6;
        const iso_separatrix_splitting s = at(k, J_wide, ISO_SEPARATRIX_DOUBLE);
        const double scaled[3] = {1e-8, 2e-8, 5e-8}, cyclic[3] = {5, 1, 2}, mirror[3] = {5, 2, 1};
        const iso_separatrix_splitting t = at(k, scaled, ISO_SEPARATRIX_DOUBLE),
                                       c = at(k, cyclic, ISO_SEPARATRIX_DOUBLE),
                                       m = at(-k, mirror, ISO_SEPARATRIX_DOUBLE),
                                       n = at(-k, J_wide, ISO_SEPARATRIX_DOUBLE);
        worst = fmax(worst, fmax(fabs(s.x - t.x), fabs(s.m - t.m)) / 1e-15);
        worst = fmax(worst, fmax(fabs(s.x - c.x), fabs(s.m - c.m)) / 1e-15);
        worst =
            fmax(worst, fmax(fabs(fabs(m.section_x) - fabs(n.section_x)), fabs(m.section_m - n.section_m)) / 1e-15);
        gsl_test(c.axis != 0 || c.middle != 2 || s.axis != 2 || s.middle != 1, "k = %g: axes", k);
    }
    gsl_test(!(worst < 1), "other units and other names of axes: %.2g of 1e-15", worst);
}

/* --- scans ------------------------------------------------------------------------------------------------------ */

static iso_separatrix_table *scan(const double k[], size_t count, const double J[3], int threads)
{
    iso_separatrix_table *s;
    iso_separatrix_options o = iso_separatrix_defaults();
    o.k = k, o.count = count, o.digits = ISO_SEPARATRIX_DOUBLE, o.threads = threads;
    memcpy(o.J, J, sizeof o.J);
    if (iso_separatrix_run(ctx, &o, &s) != ISO_OK) gsl_test(1, "a scan: %s", iso_context_message(ctx));
    return s;
}

/* m is smooth in k and changes its sign at +-1, where it is passed; a zero elsewhere is found. */
static void test_zeros(void)
{
    static const double k[] = {-1.5, -1.7, -0.9, -1.1}, none[] = {0.9, 1.1, 1.5};
    iso_separatrix_table *s = scan(k, 4, J_wide, 2), *n = scan(none, (size_t)tests_length(2, 3), J_wide, 1);
    gsl_test(!(s->row[2].m * s->row[3].m < 0 && n->row[0].m * n->row[1].m < 0), "m changes its sign at k = -1 and 1");
    gsl_test(s->zeros != 1 || n->zeros != 0, "J = (1, 2, 5): a zero of m between k = -1.7 and -1.5, none at +-1");
    if (s->zeros == 1) {
        const iso_separatrix_splitting *z = s->zero;
        gsl_test(!(fabs(z->k + 1.602408110834) < 1e-9 && fabs(z->m) < 1e-15), "it is at k = %.13g", z->k);
        gsl_test(!(fabs(z->next_m) > 1e-13), "the manifolds cross at the next point, with %.2e", z->next_m);
    }
    iso_separatrix_free(s);
    iso_separatrix_free(n);
}

/* +-1 between the same neighbours hides no zero and makes none. */
static void test_zeros_beside_one(void)
{
    static const struct {
        double k[2], zero; /* NaN: none */
    } cases[] = {{{-0.9, -2}, -1.602408110834},
                 {{-0.5, -1.603}, -1.602408110834},
                 {{0.5, 3}, 2.2693235571},
                 {{-0.5, -1.602}, NAN},
                 {{0.5, 1.0001}, NAN}};
    for (int i = tests_length(5, 0); i < 5; i++) {
        iso_separatrix_table *s = scan(cases[i].k, 2, J_wide, 1);
        const bool some = !isnan(cases[i].zero);
        gsl_test(s->zeros != some || s->lost > 0 || !(s->zeros == 0 || fabs(s->zero->k - cases[i].zero) < 1e-8),
                 "between k = %g and %g: %zu zeros, %zu lost", cases[i].k[0], cases[i].k[1], s->zeros, s->lost);
        iso_separatrix_free(s);
    }
}

/* --- refusals --------------------------------------------------------------------------------------------------- */

static void check_refused(double k, const double J[3], const char *words)
{
    iso_separatrix_splitting s;
    const iso_status status = iso_separatrix_at(ctx, k, J, 0, ISO_SEPARATRIX_AUTO, &s);
    gsl_test(status != ISO_BAD_INPUT || s.status != status || !strstr(iso_context_message(ctx), words),
             "k = %g, J = %g %g %g: %s", k, J[0], J[1], J[2], iso_context_message(ctx));
}

/* Nearly equal moments: answers at once, in words, or x and m with errors that cover the distance from 128 bits. */
static void test_near_moments(void)
{
    static const double refused[][4] = {{0.5, 1.4, 1.4000001, 3},
                                        {1, 1.4, 1.40000000000001, 3},
                                        {-0.05, 1.4, 1.4000001, 3},
                                        {0.05, 1.4, 2.9999999, 3},
                                        {0.5, 1.4, 2.9999999, 3},
                                        {-50, 1.4, 1.401, 3},
                                        {50, 1, 1.1, 5}};
    static const double held[][4] = {
        {-0.05, 1.4, 1.401, 3}, {0.05, 1.4, 1.4000001, 3}, {0.5, 1.4, 1.401, 3}, {-0.05, 1.4, 2.9999999, 3}};
    for (int i = 0; i < 7; i++) check_refused(refused[i][0], &refused[i][1], "too near 1: m is about");
    for (int i = 0; i < tests_length(2, 3); i++) {
        const iso_separatrix_splitting s = at(held[i][0], &held[i][1], ISO_SEPARATRIX_DOUBLE);
        gsl_test(!(s.error < 1e-16 && s.x_error < 1e-16), "J = %g %g %g, k = %g: errors %.1e, %.1e", held[i][1],
                 held[i][2], held[i][3], held[i][0], s.error, s.x_error);
        if (tests_length(0, i < 2)) check_against_quad(held[i][0], &held[i][1], &s);
    }
}

static void test_refusals(void)
{
    const double half = 0.5;
    iso_separatrix_table *s;
    iso_separatrix_splitting one;
    iso_separatrix_options o = iso_separatrix_defaults();
    check_refused(0.5, (double[3]){1, 1, 1}, "equal");
    check_refused(-1, (double[3]){2, 1.9999999999999998, 5}, "J1 and J2 are equal"); /* within rounding */
    check_refused(0, J_thin, "k = 0");
    check_refused(1e6, J_thin, "only for 0.05 <= |k| <= 50");
    check_refused(0.001, J_thin, "only for 0.05 <= |k| <= 50");
    check_refused(1, (double[3]){1, -2, 3}, "");
    iso_scene scene = iso_scene_default();
    gsl_test(iso_separatrix_run(ctx, &o, &s) != ISO_BAD_ARGUMENT || s, "no k");
    iso_params_reduced(ctx, half, J_thin, &scene.params);
    double level;
    o.k = &half, o.count = 1, o.level = &level;
    memcpy(o.J, J_thin, sizeof o.J);
    scene.start = (iso_start){.model = ISO_POINT, .y = {0.8, -0.6, 0, 0.6, 0.8, 0}, .eps = 0.3};
    if (iso_level_of_scene(ctx, &scene, "", &level) != ISO_OK || iso_separatrix_run(ctx, &o, &s) != ISO_OK)
        gsl_test(1, "a point off H = 0: %s", iso_context_message(ctx));
    gsl_test(s && !(s->row->level > 0 && s->row->m > 0 && s->row->m < table[0][2] / 2),
             "it is on its level, %g: m = %g", s ? s->row->level : 0, s ? s->row->m : 0);
    iso_separatrix_free(s);
    iso_context_set_monitor(ctx, never, NULL);
    gsl_test(iso_separatrix_at(ctx, 0.5, J_thin, 0, ISO_SEPARATRIX_AUTO, &one) != ISO_STOPPED, "stopped on request");
    iso_context_set_monitor(ctx, NULL, NULL);
}

static void test_curve(void)
{
    iso_record *curve;
    if (iso_separatrix_curve(ctx, 0.5, J_thin, 0, 2, &curve) != ISO_OK) gsl_test(1, "%s", iso_context_message(ctx));
    double nearest = 1, x = 0;
    for (size_t i = 0; i < iso_record_rows(curve); i++) {
        const double *row = iso_record_const_row(curve, i), away = fabs(row[0] - 1.5707963267948966);
        if (away < nearest) nearest = away, x = row[1];
    }
    gsl_test(!(nearest < 0.04 && fabs(x - table[0][1]) < 0.01), "the curve passes the crossing: %.2g, %.2g", nearest,
             x - table[0][1]);
    iso_record_free(curve);
}

int main(void)
{
    ctx = iso_context_create();
    test_table();
    test_fine();
    test_symmetries();
    test_zeros();
    test_zeros_beside_one();
    test_near_moments();
    test_refusals();
    test_curve();
    iso_context_free(ctx);
    return gsl_test_summary();
}

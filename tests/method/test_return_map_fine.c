/* The return map in numbers of 64 and of 113 bits, lib/method/taylor/return_map_impl.h: against the lanes of doubles,
 * and by its laws: determinant, reversor, two halves. */
#include "base/math_impl.h"
#include "crossed.h"
#include "map/section_impl.h"
#include "method/methods_impl.h"
#include "method/taylor/lanes_impl.h"
#include "method/taylor/return_map_impl.h"
#include "orbit/crossings_impl.h"
#include "reference.h"

#ifdef ISO_TAYLOR_HAS_QUAD
static const iso_return_build *const codes[] = {&iso_return_extended, &iso_return_quad};
#else
static const iso_return_build *const codes[] = {&iso_return_extended};
#endif
enum { CODES = sizeof codes / sizeof *codes };

static const double ks[] = {-2, -1, -0.5, 0.4, 1, 2};
static const double Js[][3] = {{1.4, 2.1, 3}, {5, 1, 2}};
enum { KS = sizeof ks / sizeof *ks, JS = sizeof Js / sizeof *Js };

static iso_context *ctx;
static iso_problem problem;
static iso_model model;
static int axis;
static double zeros;

static void prepare(double k, const double J[3])
{
    problem = (iso_problem){.p = laws_params(k, J), .eps = 1};
    const bool none[ISO_CLOCKS] = {false};
    axis = iso_section_axis(iso_free_point(&problem.p, 1));
    model = iso_model_assemble(&iso_system_point, &problem, ISO_CLOCK_T, none);
    zeros = iso_crossings_zeros(iso_free_point(&problem.p, 1), axis, k == -1 ? ISO_CLOCK_S : ISO_CLOCK_T);
}

static iso_return go(const iso_return_build *code, bool half, const iso_fine from[2])
{
    iso_return r = {.from = {from[0], from[1]}, .start = half ? ISO_FROM_BELOW : ISO_FROM_CHART};
    if (!code->go(&model, axis, zeros, code == codes[0] ? 1e-15 : 1e-17, &r)) gsl_test(1, "no return");
    return r;
}

static iso_return go_from(const iso_return_build *code, bool half, double l, double x)
{
    return go(code, half, (const iso_fine[2]){{l, 0}, {x, 0}});
}

/* a - b */
static double apart(iso_fine a, iso_fine b)
{
    return (a.head - b.head) + (a.tail - b.tail);
}

static double size_of(const iso_return *r)
{
    double most = 1;
    for (int i = 0; i < 4; i++) most = fmax(most, fabs(r->slope[i / 2][i % 2].head));
    return most;
}

static double distance(const iso_return *a, const iso_return *b)
{
    double most = 0;
    for (int i = 0; i < 2; i++) most = fmax(most, fabs(apart(a->to[i], b->to[i])));
    for (int i = 0; i < 4; i++) most = fmax(most, fabs(apart(a->slope[i / 2][i % 2], b->slope[i / 2][i % 2])));
    return most / size_of(a);
}

/* --- against others --------------------------------------------------------------------------------------------- */

static void image(double l, double x, iso_crossing *c)
{
    iso_start start = {.model = ISO_POINT, .eps = 1};
    iso_section_point(iso_free_point(&problem.p, 1), axis, l, x, start.y);
    const iso_batch_orbit orbit = {&problem.p, &start, NULL};
    iso_crossings_options o = iso_crossings_defaults();
    o.deviations = true;
    crossed(ctx, &orbit, &o, 1, c, NULL);
}

/* Bound: the tolerance 1e-12 of the lanes, carried on by the derivative. */
static void check_against_doubles(double l, double x, double *worst)
{
    iso_crossing c;
    image(l, x, &c);
    const iso_return r = go_from(codes[0], false, l, x);
    double most = fmax(fabs(remainder(c.l - r.to[0].head, 2 * ISO_PI)), fabs(c.x - r.to[1].head));
    for (int i = 0; i < 4; i++) most = fmax(most, fabs(c.slope[i / 2][i % 2] - r.slope[i / 2][i % 2].head));
    *worst = fmax(*worst, most / size_of(&r) / 1e-9);
}

/* --- laws ------------------------------------------------------------------------------------------------------- */

typedef struct worst {
    double determinant, reversor, halves, codes, doubles;
} worst;

/* The determinant, to what doubles hold; S1 (l, x) -> (l, -x) is a reversor: f S1 f S1 = 1; two halves
 * are a return. */
static void check_laws(const iso_return_build *code, double l, double x, worst *w)
{
    const iso_return f = go_from(code, false, l, x);
    const double unit = code->error * size_of(&f);
    const double det = f.slope[0][0].head * f.slope[1][1].head - f.slope[0][1].head * f.slope[1][0].head,
                 G = iso_section_momentum(iso_free_point(&problem.p, 1), axis, l),
                 G_there = iso_section_momentum(iso_free_point(&problem.p, 1), axis, f.to[0].head);
    w->determinant = fmax(w->determinant, fabs(det - G / G_there) / (size_of(&f) * size_of(&f)) / 1e-15);
    const iso_return back = go(code, false, (const iso_fine[2]){f.to[0], {-f.to[1].head, -f.to[1].tail}});
    w->reversor = fmax(w->reversor, fabs(apart(back.to[0], (iso_fine){l, 0})) / (unit * size_of(&back)));
    w->reversor = fmax(w->reversor, fabs(apart(back.to[1], (iso_fine){-x, 0})) / (unit * size_of(&back)));
    const iso_return one = go_from(code, true, l, x), two = go(code, true, one.to);
    for (int i = 0; i < 2; i++) w->halves = fmax(w->halves, fabs(apart(two.to[i], f.to[i])) / unit);
}

static void test_laws(void)
{
    static const double at[][2] = {{0.7, 0.3}, {-2.4, -0.55}, {1.3, 0.05}};
    worst w = {0};
    for (int k = 0; k < KS; k++)
        for (int J = 0; J < JS; J++) {
            prepare(ks[k], Js[J]);
            const int points = tests_length(1, 3);
            for (int i = 0; i < points; i++) {
                const double l = at[(k + J + i) % 3][0], x = at[(k + J + i) % 3][1];
                for (int c = 0; c < CODES; c++) check_laws(codes[c], l, x, &w);
                check_against_doubles(l, x, &w.doubles);
                const iso_return one = go_from(codes[0], false, l, x), other = go_from(codes[CODES - 1], false, l, x);
                w.codes = fmax(w.codes, distance(&one, &other) / 1e-17); /* 0 where there is one alone */
            }
        }
    gsl_test(!(w.determinant < 10), "the determinant is G(l)/G(l'): %.2g of 1e-14", w.determinant / 10);
    gsl_test(!(w.reversor < 1000), "f S1 f S1 = 1: %.2g rounding errors", w.reversor);
    gsl_test(!(w.halves < 1000), "two halves are a return: %.2g rounding errors", w.halves);
    gsl_test(!(w.codes < 1), "64 bits differ from 113 bits by %.2g of 1e-17", w.codes);
    gsl_test(!(w.doubles < 1), "doubles differ by %.2g of 1e-9", w.doubles);
}

/* --- other levels ----------------------------------------------------------------------------------------------- */

enum { NUMBERS = 22 };

/* Numbers of a row of levels.csv behind its name. */
enum { K, J1, LEVEL = 11, AXIS, CROSSING, S, T, M_1, G_1 = 19 };

/* f^4 of crossing 1 is crossing 5, all with eps = 1 as in the file. The bound: a hundred roundings of the start,
 * doubles, that grow like the derivative. */
static void check_reference(const double first[NUMBERS], const double fifth[NUMBERS], double *most)
{
    const bool clocks[ISO_CLOCKS] = {true, true, true};
    double z[2], wanted[2], s = 0, t = 0, growth = 1;
    problem = (iso_problem){.p = laws_params(first[K], first + J1), .eps = 1, .energy = first[LEVEL]};
    axis = (int)first[AXIS] - 1;
    model = iso_model_assemble(&iso_system_point, &problem, ISO_CLOCK_T, clocks);
    zeros = iso_crossings_zeros((iso_point_motion){&problem.p, 1, first[LEVEL]}, axis, iso_lane_clock(&model));
    iso_section_chart(axis, first + M_1, &z[0], &z[1]);
    iso_section_chart(axis, fifth + M_1, &wanted[0], &wanted[1]);
    for (int c = 0; c < CODES; c++) {
        iso_return r = {.to = {{z[0], 0}, {z[1], 0}}};
        s = t = 0, growth = 1;
        for (int n = 0; n < 4; n++) {
            r = go(codes[c], false, r.to);
            growth *= size_of(&r);
            s += r.clock[ISO_CLOCK_S].head, t += r.clock[ISO_CLOCK_T].head;
        }
        const double bound = 1e-14 * growth;
        *most = fmax(*most, fabs(remainder(r.to[0].head - wanted[0], 2 * ISO_PI)) / bound);
        *most = fmax(*most, fabs(r.to[1].head - wanted[1]) / bound);
        *most = fmax(*most, fabs(s / (fifth[S] - first[S]) - 1) / bound);
        *most = fmax(*most, fabs(t / (fifth[T] - first[T]) - 1) / bound);
    }
}

/* Crossings by another program, in 128 bits, on levels from -9 to 18. */
static void test_levels(void)
{
    FILE *file = fopen(ISO_TEST_DATA "/levels.csv", "r");
    char line[2048];
    double v[NUMBERS], first[NUMBERS], most = 0;
    int rows = 0;
    if (!file) gsl_test(1, "levels.csv");
    while (file && fgets(line, sizeof line, file)) {
        if (strncmp(line, "lev", 3) != 0 || !reference_numbers(line, NUMBERS, v)) continue;
        if (v[CROSSING] == 1) memcpy(first, v, sizeof first);
        if (v[CROSSING] == 5) check_reference(first, v, &most), rows++;
    }
    if (file) fclose(file);
    gsl_test(rows < 5, "%d orbits of levels.csv", rows);
    gsl_test(!(most < 1), "their crossings 5 by four returns: %.2g of the bound", most);
}

int main(void)
{
    ctx = iso_context_create();
    test_levels();
    test_laws();
    iso_context_free(ctx);
    return gsl_test_summary();
}

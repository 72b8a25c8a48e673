/* Periodic orbits (lib/instrument/periodic/periodic.h): orbits against their laws, the search along lines against
 * Newton's method from a grid, k = 1 and -1. Rotations: test_periodic_levels.c. */
#define _GNU_SOURCE /* functions of _Float128 */
#include "map/section.h"
#include "method/methods_impl.h"
#include "periodics.h"

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* That both models come back after its clocks: test_periodic_levels.c. */
static void check_orbit(const iso_periodic_orbit *o)
{
    gsl_test(!(o->closure <= 1e-14), "closure %g", o->closure);
    gsl_test(!(fabs(o->determinant) <= 1e-12), "determinant 1 %+g", o->determinant);
    gsl_test(!(o->error >= 0 && o->error <= 1e-9 * (1 + fabs(o->trace))), "trace %g +- %g", o->trace, o->error);
    gsl_test(o->copies < 1 || o->copies > 16 || 16 % o->copies != 0, "%d copies", o->copies);
    gsl_test((o->multipliers.stability == ISO_STABLE) != (o->multipliers.krein != 0), "Krein's sign");
}

/* The derivative over the whole orbit, by the mirror image of its first half, against both halves followed. */
static void check_mirror(const iso_scene *scene, const iso_periodic_orbit *o)
{
    iso_periodic_map map;
    iso_periodic_shot shot;
    iso_periodic_fine whole;
    iso_wide slope[2][2];
    iso_periodic_map_prepare(ctx, &scene->params, 0, 1, &map);
    const iso_return_build *code = iso_return_build_of(false);
    gsl_test(!iso_periodic_shoot(&map, code, o->line, o->u, o->period, &shot), "the first half");
    gsl_test(!iso_periodic_far(&map, code, shot.z, 2 * o->period, NULL, &whole), "both halves");
    iso_wide_multiply((const iso_wide(*)[2])shot.back, (const iso_wide(*)[2])shot.half.slope, slope);
    double size = 1, apart = 0;
    for (int i = 0; i < 4; i++) {
        size = fmax(size, fabs((double)whole.slope[i / 2][i % 2]));
        apart = fmax(apart, fabs((double)(slope[i / 2][i % 2] - whole.slope[i / 2][i % 2])));
    }
    gsl_test(!(apart < 1e-13 * size * size), "line %s, period %d: mirrored derivative off by %g of %g",
             iso_symmetry_line_name(o->line), o->period, apart, size);
}

static void check_orbits(void)
{
    static const double J[2][3] = {{1.4, 2.1, 3}, {1, 2, 5}}, k[] = {0.5, -0.6, 0.75, 2};
    for (int i = 0; i < 4; i++) {
        const iso_scene scene = ball_scene(k[i], J[i == 0]);
        iso_periodic *f = orbits_to(&scene, tests_length(3, 5) - (i == 0));
        gsl_test(i < 3 && f->count == 0, "k = %g: there are orbits", k[i]);
        gsl_test(f->lost > 0 || f->unresolved > 0, "k = %g: none is lost", k[i]);
        for (size_t j = 0; j < f->count; j++) {
            check_orbit(&f->orbit[j]);
            if (fabs(f->orbit[j].trace) < 1e4) check_mirror(&scene, &f->orbit[j]);
        }
        iso_periodic_free(f);
    }
}

/* Each orbit of one list that the other should have: symmetric, and found only once. */
static bool has(const iso_periodic *f, const iso_periodic_orbit *o)
{
    for (size_t i = 0; i < f->count; i++) {
        const iso_periodic_orbit *p = &f->orbit[i];
        if (p->period == o->period && fabs(p->trace - o->trace) < 1e-7 * (1 + fabs(o->trace)) &&
            fabs(p->clock[0] / o->clock[0] - 1) < 1e-9)
            return true;
    }
    return false;
}

/* How many orbits of a list are not in the other one; the easy ones are those that Newton's method from a grid can
 * find: very unstable orbits attract few points of the grid, and with a trace near 2 there are many next to each
 * other. */
static int missing(const iso_periodic *of, const iso_periodic *in, bool easy, const char *where, double k,
                   const double J[3])
{
    int count = 0;
    for (size_t j = 0; j < of->count; j++) {
        const iso_periodic_orbit *o = &of->orbit[j];
        if ((easy && !(fabs(o->trace) < 30 && fabs(o->trace - 2) > 0.05)) || o->symmetry == 0 || has(in, o)) continue;
        count++;
        printf("k = %.17g, J = %.17g %.17g %.17g: %s not period %d, l = %g, x = %g, trace %g, symmetry %d\n", k, J[0],
               J[1], J[2], where, o->period, o->l, o->x, o->trace, o->symmetry);
    }
    return count;
}

/* The list of the search from a grid alone. */
static iso_periodic *grid_of(const iso_scene *scene, int period, long grid)
{
    iso_periodic_options o = iso_periodic_defaults();
    o.period = period;
    o.all = true;
    o.no_lines = true;
    o.grid = grid;
    return orbits_of(scene, &o);
}

/* The search from a grid, without lines, against the search along lines: every symmetric orbit that the grid finds,
 * however unstable, lies on a line, and the easy ones of the lines are found from the grid, or a finer one. */
static void check_both_searches(void)
{
    iso_random *random = iso_random_create(4);
    size_t seen = 0;
    int lost[2] = {0, 0};
    for (int i = 0; i < tests_length(3, 4); i++) {
        const double k = (i % 2 ? 1 : -1) * exp(iso_random_uniform(random, log(0.35), log(tests_length(1, 2))));
        const double J[3] = {iso_random_uniform(random, 1, 1.3), iso_random_uniform(random, 1.5, 2),
                             iso_random_uniform(random, 2.2, 3)};
        const int period = tests_length(3, 4);
        const iso_scene scene = ball_scene(k, J);
        iso_periodic *lines = orbits_to(&scene, period), *grid = grid_of(&scene, period, 1000);
        lost[0] += missing(grid, lines, false, "lines have", k, J);
        if (missing(lines, grid, true, "a grid of 1000 points has", k, J) > 0) {
            iso_periodic_free(grid);
            grid = grid_of(&scene, period, 30000);
            lost[1] += missing(lines, grid, true, "a grid of 30000 points has", k, J);
        }
        seen += lines->count;
        iso_periodic_free(lines);
        iso_periodic_free(grid);
    }
    iso_random_free(random);
    gsl_test_int(lost[0], 0, "lines have the orbits from the grid that are symmetric");
    gsl_test_int(lost[1], 0, "the grid finds those of the %zu orbits of the lines that are easy to find", seen);
}

/* k = 1, -1: orbits lie on resonant tori. (For k = -1 and J3 > J1 + J2 there is an isolated one as well.) */
static void check_tori(void)
{
    iso_random *random = iso_random_create(1);
    size_t tori = 0;
    for (int i = 0; i < tests_length(6, 8); i++) {
        const double k = i % 2 ? 1 : -1,
                     J[3] = {iso_random_uniform(random, 1, 1.5), iso_random_uniform(random, 1.6, 2),
                             iso_random_uniform(random, 2.2, 2.6)};
        const iso_scene scene = ball_scene(k, J);
        iso_periodic *f = orbits_of(&scene, NULL);
        for (size_t j = 0; j < f->count; j++) {
            const iso_periodic_orbit *p = &f->orbit[j];
            gsl_test(!p->torus || p->multipliers.stability != ISO_DEGENERATE, "period %d is on a torus", p->period);
            gsl_test_abs(p->trace, 2, 1e-12, "k = %g, J = %.17g %.17g %.17g: its trace", k, J[0], J[1], J[2]);
        }
        tori += f->count;
        iso_periodic_free(f);
    }
    gsl_test(tori == 0, "k = +-1: there are orbits");
    iso_random_free(random);
}

static void refuse(const iso_scene *scene, const iso_periodic_options *o, iso_status wanted, const char *about)
{
    iso_periodic *found = NULL;
    gsl_test_int((int)iso_periodic_run(ctx, scene, o, &found), (int)wanted, "refused: %s", about);
    gsl_test(strcmp(iso_context_about(ctx), about) != 0, "about %s, not %s", iso_context_about(ctx), about);
    gsl_test(found != NULL, "nothing is given");
}

#ifdef ISO_TAYLOR_HAS_QUAD
/* The orbits of one random ball, in 64 and in 128 bits. Adds to *seen, *beaten (errors that do not cover the distance)
 * and *open (closures above their bounds). */
static void compare_digits(iso_random *random, int period, size_t *seen, size_t *beaten, size_t *open)
{
    const double k =
        (iso_random_uniform(random, 0, 1) < 0.5 ? 1 : -1) * exp(iso_random_uniform(random, log(0.35), log(2.5)));
    const double J[3] = {iso_random_uniform(random, 1, 1.5), iso_random_uniform(random, 1.6, 2.5),
                         iso_random_uniform(random, 2.6, 4)};
    const iso_scene scene = ball_scene(k, J);
    iso_periodic_options o = iso_periodic_defaults();
    o.period = period;
    iso_periodic *rough = orbits_of(&scene, &o);
    o.polish = true;
    iso_periodic *fine = orbits_of(&scene, &o);
    gsl_test(fine->count != rough->count, "k = %.17g: 64 and 128 bits have the same orbits", k);
    for (size_t i = 0; i < rough->count; i++) {
        const iso_periodic_orbit *a = &rough->orbit[i], *b = NULL;
        for (const iso_periodic_orbit *p = fine->orbit; p < fine->orbit + fine->count; p++)
            if (p->period == a->period && p->line == a->line && fabs(p->u - a->u) < 1e-9) b = p;
        gsl_test(!b, "k = %.17g, period %d, l = %g: found in 128 bits", k, a->period, a->l);
        if (!b) continue;
        const double apart = fabs((a->trace - b->trace) + (a->trace_tail - b->trace_tail));
        if (!(apart <= a->error))
            printf("k = %.17g, J = %.17g %.17g %.17g: trace %.17g of period %d: %g from 128 bits, error %g\n", k,
                   J[0], J[1], J[2], a->trace, a->period, apart, a->error),
                ++*beaten;
        if (!(a->closure <= 1e-14) || !(b->closure <= 1e-28) ||
            !(fabs(b->determinant) <= 1e-24 * (1 + fabs(b->trace))))
            printf("k = %.17g, J = %.17g %.17g %.17g: period %d, trace %g, closures %g and %g, determinant 1 %+g\n",
                   k, J[0], J[1], J[2], a->period, a->trace, a->closure, b->closure, b->determinant),
                ++*open;
        ++*seen;
    }
    iso_periodic_free(rough);
    iso_periodic_free(fine);
}

/* The trace's error covers its distance from 128 bits, and orbits close to 1e-28 there. */
static void check_polish(void)
{
    const size_t wanted = (size_t)tests_length(6, 15);
    size_t seen = 0, beaten = 0, open = 0;
    iso_random *random = iso_random_create(128);
    for (int i = 0; i < 1000 && seen < wanted; i++) compare_digits(random, 2, &seen, &beaten, &open);
    iso_random_free(random);
    gsl_test(seen < wanted, "%zu orbits", seen);
    gsl_test(beaten > 0, "%zu of %zu errors of traces do not cover the distance from 128 bits", beaten, seen);
    gsl_test(open > 0, "%zu of %zu orbits do not close to 1e-14, and to 1e-28 with 128 bits", open, seen);
}
#else
/* There are no numbers of 128 bits here. */
static void check_polish(void)
{
    iso_periodic_options o = iso_periodic_defaults();
    const iso_scene scene = ball_scene(0.45, (const double[3]){1.2, 2, 3.1});
    o.polish = true;
    refuse(&scene, &o, ISO_BAD_ARGUMENT, "polish");
}
#endif

/* What others refuse as well: foreign/test_refusals.c. */
static void check_refusals(void)
{
    const iso_scene scene = ball_scene(0.5, (const double[]){1.4, 2.1, 3});
    iso_periodic_options o = iso_periodic_defaults();
    o.period = 0;
    refuse(&scene, &o, ISO_BAD_ARGUMENT, "period");
    o.period = ISO_PERIODIC_MOST + 1;
    refuse(&scene, &o, ISO_BAD_ARGUMENT, "period");
    o = iso_periodic_defaults();
    o.grid = 0;
    refuse(&scene, &o, ISO_BAD_ARGUMENT, "grid");
}

int main(void)
{
    ctx = iso_context_create();
    check_orbits();
    check_both_searches();
    check_tori();
    check_polish();
    check_refusals();
    iso_context_free(ctx);
    return gsl_test_summary();
}

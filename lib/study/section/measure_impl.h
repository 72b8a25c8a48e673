/* measure_impl.h - the parts of measure.h: clouds, sums over them, and the test. */
#ifndef ISO_STUDY_MEASURE_IMPL_H
#define ISO_STUDY_MEASURE_IMPL_H

#include "map/quarter_impl.h"
#include "study/section/measure.h"

/* --- states of a ball, distributed by g^power dn dtheta (measure_draw.c) --------------------------------------- */

/* n by its sphero-conical coordinates in J1 <= J2 <= J3 (the axes sorted):
 *     lam = J1 cos^2 phi + J2 sin^2 phi,   mu = J2 cos^2 psi + J3 sin^2 psi,   g = lam mu/det J
 *     n1 = sin phi (sin^2 psi + m1 cos^2 psi)^(1/2),   n2 = cos phi sin psi,
 *     n3 = cos psi (cos^2 phi + m3 sin^2 phi)^(1/2),
 *     m1 = (J2 - J1)/(J3 - J1),   m3 = (J3 - J2)/(J3 - J1)
 * phi and psi each go through a whole turn; every n is met twice.
 *     g^power dn ~ (m1 cos^2 phi + m3 sin^2 psi) a(phi) b(psi) dphi dpsi
 * This is a sum of two products. So two tables give the integral over psi, up to any angle, for every phi. */
typedef struct measure_draw {
    double power, J[3], root[3], m1, m3; /* J, and its roots: sorted                                                */
    int axis[3];                         /* the axis of J[i]                                                        */
    double second[2];                    /* the density of phi: a (second[0] cos^2 phi + second[1])                 */
    double phi[ISO_QUARTER_STEPS + 1];   /* the integral of that                                                    */
    double psi[2][ISO_QUARTER_STEPS + 1]; /* the integrals of m3 sin^2 psi b, and of b                          */
} measure_draw;

void iso_measure_draw_prepare(measure_draw *d, const iso_params *p, double power);

/* n and v/|v| of point i of a cloud with this shift. */
void iso_measure_draw_state(const measure_draw *d, const uint64_t shift[3], uint64_t i, double n[3], double v[3]);

/* The mean of f(g, n^2) by the measure: count functions at once. */
void iso_measure_draw_means(const measure_draw *d, int count, void (*f)(double g, const double n2[3], double value[]),
                            double mean[]);

/* --- sums over clouds, and the test (measure_common.c) ---------------------------------------------------------- */

typedef struct measure_sums {
    int functions;
    double value[ISO_MEASURE_CLOUDS][ISO_MEASURE_LINES]; /* of each cloud: sums of the functions, row after row */
    double product[ISO_MEASURE_LINES];                   /* over all clouds: sums of them times `sharp`         */
    double first[ISO_MEASURE_FUNCTIONS], first_product[ISO_MEASURE_FUNCTIONS]; /* the same at the start */
    double sharp, sharp_square;                                                /* over all clouds       */
} measure_sums;

/* Adds one point of a cloud: its functions at the start, then in each row. sharp: d ln(density)/d(exponent) at the
 * start. */
void iso_measure_sums_start(measure_sums *sums, double sharp, const double value[]);
void iso_measure_sums_add(measure_sums *sums, int cloud, int row, double sharp, const double value[]);

/* Fills lines, p, kept and resolution. name, expected: of each function. */
void iso_measure_judge(const measure_sums *sums, const iso_measure_options *o, const char *const name[],
                       const double expected[], const double time[ISO_MEASURE_ROWS], iso_measure *m);

/* --- what flow and returns share (measure_common.c) ------------------------------------------------------------ */

typedef struct measure_scene {
    const iso_params *params;
    iso_effects effects;    /* that act, in the caller's units; with the level of a point's start */
    bool free, pulled;      /* free: no effect acts. pulled: there is a potential                 */
    iso_orbit *orbit;       /* of the scene, by the ball                                          */
    double energy, kinetic; /* in the caller's units; h, and that of the start's motion           */
} measure_scene;

/* Takes the options and looks at the scene. What is opened is closed by iso_orbit_free(s->orbit), also on errors. */
iso_status iso_measure_open(iso_context *ctx, const iso_scene *scene, const iso_measure_options *given,
                            iso_measure_options *options, measure_scene *s);

/* Potential energy at n. */
double iso_measure_potential(const measure_scene *s, const double n[3]);

/* Shifts of cloud number `cloud`, in units of 2^-64. */
void iso_measure_shift(const iso_measure_options *o, int cloud, int count, uint64_t shift[]);

/* Draws and carries all clouds, a block of orbits at a time, and reports the progress. */
enum { MEASURE_BLOCK = 4096 };
iso_status iso_measure_carry(const iso_measure_options *o,
                             iso_status (*block)(void *data, int cloud, uint64_t first, size_t count), void *data);

#endif

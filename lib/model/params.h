/* params.h - the numbers of a ball on a sphere: k and J (theory: BM 2007, section 1).
 *
 * A ball of radius B rolls without slip and twist on a fixed sphere of radius A. Everything the motion knows of it
 * is the geometry number k and the three moments of inertia J_i = I_i + m B^2 about the contact point, in the
 * ball's principal axes:
 *
 *     surface   what rolls                                  signed radii (a, b)   k = a/(a+b)   range
 *     plane     a ball on a plane                           a = infinity          1             1
 *     outside   a ball on the outside of a fixed sphere     ( A,  B)              A/(A+B)       (0, 1)
 *     inside    a ball inside a fixed sphere, B < A         ( A, -B)              A/(A-B)       (1, inf)
 *     shell     a hollow sphere around a fixed ball, B > A  ( A, -B)             -A/(B-A)       (-inf, 0)
 */
#ifndef ISO_MODEL_PARAMS_H
#define ISO_MODEL_PARAMS_H

#include "base/context.h"

typedef enum iso_surface { ISO_REDUCED, ISO_PLANE, ISO_OUTSIDE, ISO_INSIDE, ISO_SHELL } iso_surface;

/* "reduced", "plane", "outside", "inside", "shell"; NULL past the end. */
const char *iso_surface_name(int surface);

/* A ball one can hold, in any consistent units of mass and length. */
typedef struct iso_body {
    double mass;           /* m > 0                                                        */
    double radius;         /* B > 0, of the moving sphere; may be known (not 0) of a reduced one */
    double inertia[3];     /* central principal moments I_i > 0, triangle inequalities     */
    iso_surface surface;   /* not ISO_REDUCED                                              */
    double surface_radius; /* A > 0, of the fixed sphere; not read for a plane             */
} iso_body;

typedef struct iso_params {
    double k;         /* geometry number, not 0                                            */
    double J[3];      /* moments about the contact point, > 0, mass length^2               */
    double inv_J[3];  /* 1/J_i                                                             */
    double root_J[3]; /* sqrt(J_i)                                                         */
    double det_J;     /* J_1 J_2 J_3                                                       */
    double D;         /* m b^2, what the ball's mass adds to J; 0: not known (reduced)     */
    iso_body body;    /* where k and J come from; surface == ISO_REDUCED: given themselves */
} iso_params;

/* From k and J directly. They need not belong to a solid body.
 * Errors: ISO_BAD_INPUT about "k" or "J". */
iso_status iso_params_reduced(iso_context *ctx, double k, const double J[3], iso_params *params);

/* Says what part D = m b^2 of J is the mass's, which only some effects ask for.
 * Errors: ISO_BAD_INPUT about "D": not in (0, min J). */
iso_status iso_params_set_D(iso_context *ctx, double D, iso_params *params);

/* From a physical ball; J = I + m B^2.
 * Errors: ISO_BAD_INPUT about "mass", "radius", "inertia" or "surface_radius" (not positive, not finite, a triangle
 * inequality I_i <= I_j + I_l broken by more than rounding, radii that give no k). */
iso_status iso_params_physical(iso_context *ctx, const iso_body *body, iso_params *params);

/* Coupling of the point and energy of the ball: eps = h det J / k^2 (24), and back. */
double iso_coupling(const iso_params *params, double h);
double iso_energy(const iso_params *params, double eps);

/* A number x with which a quantity is measured: x = J^(J + J_2k/(2k)) w^(w), J a moment of inertia, w a rate.
 * With it every quantity of either model can be carried from one system of units to another. */
typedef struct iso_dimension {
    int J, J_2k, w;
} iso_dimension;

/* The ball's own units: powers of two near its moments of inertia and its spin, in which everything is of order
 * one. Going there and back rounds nothing but the quantities whose dimension has J_2k != 0. */
typedef struct iso_units {
    double J, w;    /* the two units, in the caller's units */
    iso_params own; /* the same ball, J in the unit J       */
} iso_units;

#endif

/* laws.h - shared by the tests of laws: sample balls and states, numerical derivatives, and the worst error found.
 *
 * A law is a function that looks at one case (system, parameters, state) and notes errors with the bound each may
 * have. laws_hold() runs it over every system x k x J x random state and reports one line of gsl_test.h: the worst
 * error in units of its bound, and where. Bounds are rounding errors times what the formula does to them.
 *
 * The headers that nearly every test needs come with it. What a header of tests includes is not included again.
 */
#ifndef ISO_TESTS_LAWS_H
#define ISO_TESTS_LAWS_H

#include <float.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "length.h"
#include "model/model_impl.h"

/* Geometry numbers of all four surfaces, both signs, 1/20 to 50. */
enum { LAWS_K = 11 };
extern const double laws_k[LAWS_K];

/* Moments of inertia: all different in every kind of order, equal pairs, all equal, nearly equal, ratio 1000. */
enum { LAWS_J = 11 };
extern const double laws_J[LAWS_J][3];

enum { LAWS_STATES = 6 }; /* random states for each system, k and J */

/* Ends the test if `failed`, with the words of the context. */
void laws_stop_if(const iso_context *ctx, bool failed, const char *what);

/* Parameters that are known to be valid; ends the test when they are refused. */
iso_params laws_params(double k, const double J[3]);

/* A random valid state of order one of the ball or the point, which is on the level H = 0 and turns by about a radian
 * in a unit of time; sets f->eps and f->energy to match (f->p given). */
void laws_sample(const iso_system *system, iso_problem *f, iso_random *r, double y[ISO_STATE]);

typedef struct laws_case {
    const iso_system *system;
    iso_problem problem; /* f, with eps and energy of y */
    double y[ISO_STATE];
    iso_random *random;
} laws_case;

/* The worst of many errors. */
typedef struct laws_worst {
    double ratio; /* error/allowed, the largest */
    double error; /* that error                 */
    long cases;
    bool nan;
    char where[192];
} laws_worst;

/* Notes an error that may be `allowed`; p and what (may be NULL) say where. NaN is never allowed. */
void laws_note(laws_worst *worst, double error, double allowed, const iso_params *p, const char *what);

/* Passes when at least one error was noted and every error was within its bound. */
void laws_report(const laws_worst *worst, const char *law);

typedef void laws_law(const laws_case *c, laws_worst *worst);

/* Runs the law for every k, J and state of one system (NULL: of both). Reports one line for each system. */
void laws_hold(const char *name, const iso_system *system, laws_law *law);

/* For a law that must NOT hold: passes when at least one case reaches its bound. */
void laws_fail(const char *name, const iso_system *system, laws_law *law);

/* A function of a state, R^n -> R^count. */
typedef void laws_function(const void *data, const double y[], double value[]);

enum { LAWS_MAX = 64 }; /* largest count and n */

/* Derivative of f along y + x direction at x = 0, 8-point central differences of step h. */
void laws_slope(laws_function *f, const void *data, int count, int n, const double y[], const double direction[],
                double h, double slope[]);

/* The same along the flow of the case's system, per unit of its own clock. */
void laws_slope_flow(laws_function *f, const void *data, int count, const laws_case *c, double h, double slope[]);

/* The step h for laws_slope(). h times `direction` is 1/128 of the distance over which the equations change much.
 * This distance is laws_reach() for the unit vector, and the speed for the fast vector. The 8-point formula then
 * has an error of 1e-16 from the step, and of laws_rounding()/h from rounding. */
double laws_step(const laws_case *c, const double direction[ISO_STATE]);

/* A distance of the unit vector over which q^e, |e| <= 1 + 1/|k|, changes by at most its own size: the complex
 * zeros of q are at a distance of sqrt(q/max J) or more. */
double laws_reach(const iso_params *p);

/* Rounding error of one evaluation of the equations, relative to its terms: a power q^e multiplies that of q by e. */
double laws_rounding(const iso_params *p);

/* The formulas of sphero-conical coordinates divide by A(lam) and A(mu). laws_regular: they work here, that is,
 * the three moments are well apart, max J/min J < 10, and the unit vector is 0.2 or more away from the coordinate
 * planes. laws_conditioning: their rounding error, relative to their terms; the factors are 1/x_i^2 <= 25 and max
 * J/min J. */
bool laws_regular(const laws_case *c);
double laws_conditioning(const iso_params *p);

/* The integral of that name; ends the test when there is none. */
const iso_integral *laws_integral(const iso_system *system, const char *name);

/* Largest |a_i|, |a|, |a - b| and max J/min J; free of overflow and underflow. */
double laws_max(int n, const double a[]);
double laws_norm(const double a[3]);
double laws_distance(const double a[3], const double b[3]);
double laws_spread(const iso_params *p);

/* Monitors: one that stops at once; one that goes on as often as *data says, an int. */
bool never(void *unused);
bool some_times(void *data);

#endif

/* laws.h - what the law tests share: which balls and states to run over, differences, and the book of the worst.
 *
 * A law is a function that looks at one case (system, parameters, state) and notes errors with the bound each may
 * have. laws_hold() runs it over every system x k x J x random state and reports one line of gsl_test.h: the worst
 * error in units of its bound, and where. Bounds are rounding errors times what the formula does to them.
 */
#ifndef ISO_TESTS_LAWS_H
#define ISO_TESTS_LAWS_H

#include <stdbool.h>

#include "model/system.h"

/* Geometry numbers of all four surfaces, both signs, 1/20 to 50. */
enum { LAWS_K = 11 };
extern const double laws_k[LAWS_K];

/* Moments of inertia: all different in every kind of order, equal pairs, all equal, nearly equal, ratio 1000. */
enum { LAWS_J = 11 };
extern const double laws_J[LAWS_J][3];

enum { LAWS_STATES = 6 }; /* random states for each system, k and J */

/* Parameters that are known to be valid; ends the test when they are refused. */
iso_params laws_params(double k, const double J[3]);

typedef struct laws_case {
    const iso_system *system;
    iso_field field; /* f, with eps and energy of y */
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

/* Passes when something was noted and all of it was within its bound. */
void laws_report(const laws_worst *worst, const char *law);

typedef void laws_law(const laws_case *c, laws_worst *worst);

/* One case for every k, J and state of one system (NULL: of each in turn); one line for each system. */
void laws_hold(const char *name, const iso_system *system, laws_law *law);

/* For what must NOT hold: passes when some case was at least at its bound. */
void laws_fail(const char *name, const iso_system *system, laws_law *law);

/* A function of a state, R^n -> R^count. */
typedef void laws_function(const void *data, const double y[], double value[]);

enum { LAWS_MAX = 64 }; /* largest count and n */

/* Derivative of f along y + x direction at x = 0, 8-point central differences of step h. */
void laws_slope(laws_function *f, const void *data, int count, int n, const double y[], const double direction[],
                double h, double slope[]);

/* The same along the flow of the case's system, per unit of its own clock. */
void laws_slope_flow(laws_function *f, const void *data, int count, const laws_case *c, double h, double slope[]);

/* A step of which `direction` moves the state by 1/128 of the way on which the equations change much: that way is
 * laws_reach() for the unit vector, the speed for the fast one. The 8-point formula then leaves an error of 1e-16
 * from the step and one of laws_rounding()/h from rounding. */
double laws_step(const laws_case *c, const double direction[ISO_STATE]);

/* How far the unit vector moves until q^e, |e| <= 1 + 1/|k|, has changed by its own size at most: q has its complex
 * zeros at a distance sqrt(q/max J) or more. */
double laws_reach(const iso_params *p);

/* Rounding error of one evaluation of the equations, relative to its terms: a power q^e multiplies that of q by e. */
double laws_rounding(const iso_params *p);

/* What the formulas of sphero-conical coordinates need, which divide by A(lam) and A(mu): three moments well apart,
 * max J/min J < 10, and a unit vector 0.2 or more away from the coordinate planes; and the rounding error they then
 * have, relative to their terms: times 1/x_i^2 <= 25 and max J/min J. */
bool laws_regular(const laws_case *c);
double laws_conditioning(const iso_params *p);

/* The integral of that name; ends the test when there is none. */
const iso_integral *laws_integral(const iso_system *system, const char *name);

/* Largest |a_i|, |a|, |a - b| and max J/min J; free of overflow and underflow. */
double laws_max(int n, const double a[]);
double laws_norm(const double a[3]);
double laws_distance(const double a[3], const double b[3]);
double laws_spread(const iso_params *p);

#endif

/* model_impl.h - what the rest of the library asks of parameters, clocks, effects and models. */
#ifndef ISO_MODEL_MODEL_IMPL_H
#define ISO_MODEL_MODEL_IMPL_H

#include "model/effects/effects_impl.h"
#include "model/model.h"

/* --- parameters and units --------------------------------------------------------------------------------------- */

/* The sign of the ball's radius b: -1 inside a sphere and of a shell, else 1. */
int iso_params_sign_of_radius(const iso_params *params);

/* of the ball's energy h = (w,Jw)/2 and of the point's coupling eps = h det J/k^2 */
extern const iso_dimension iso_dimension_h, iso_dimension_eps;

/* Own units for motions of angular speed about `speed` (1/time; 0 allowed). */
void iso_units_choose(const iso_params *params, double speed, iso_units *units);

/* Whether q^(1/k) fits a double, over its value at another q, for all q from the least moment to the largest. */
bool iso_params_powers_fit(const iso_params *p);

/* ISO_BAD_INPUT about "k" where they do not. */
iso_status iso_params_check_powers(iso_context *ctx, const iso_params *p);

/* --- clocks, and the point in the time of the ball -------------------------------------------------------------- */

iso_dimension iso_clock_dimension(iso_clock clock);

/* Rate d clock / dt > 0 where q = (gamma, J gamma) = 1/(n, J^-1 n), and its exponent e in rate ~ q^e:
 *     t: 1,   tau: N = q^(1 - 1/(2k)),   s: G N = (k^2/det J) q^(1 + 1/(2k)). */
double iso_clock_rate(const iso_params *p, iso_clock clock, double q, double *exponent);

/* The point on H = 0 again, y = (J^(1/2) omega, gamma) in the ball's time, free of powers of q: for extreme k
 * (point_in_t.c). Not in the registry. */
extern const iso_system iso_system_point_in_t;

/* Its states and those of the point, (M, gamma) with M = NN p (18). The two may be one array. */
void iso_point_to_point_in_t(const iso_params *p, const double point[ISO_STATE], double y[ISO_STATE]);
void iso_point_in_t_to_point(const iso_params *p, const double y[ISO_STATE], double point[ISO_STATE]);

/* Its ball (18): integrals of a point may be those of its ball. The two may be one array. */
void iso_point_in_t_to_ball(const iso_params *p, const double y[ISO_STATE], double ball[ISO_STATE]);

/* Whether powers q^(1/k) may range over more than ten decades along an orbit: series of (24) then overflow, and its
 * steps shrink. */
bool iso_params_steep(const iso_params *p);

/* --- models ----------------------------------------------------------------------------------------------------- */

/* Why the model cannot be simulated: more effects than there is room for; NULL: it can. */
const char *iso_model_too_large(const iso_model *m);

/* Restores the constraints of system and effects, and the energy where it is conserved; returns the relative size of
 * the correction. */
double iso_model_project(const iso_model *m, double y[]);

/* The size of each component for error control: of the vector of R^3 it belongs to; of the clock, and of its
 * progress in one unit of the independent variable. Errors of a step are measured in units of tolerance * size. */
void iso_model_size(const iso_model *m, const double y[], double size[]);

/* Whether its equations stand in series/recurrences_impl.h, of which slopes and series are made. */
bool iso_system_has_recurrences(const iso_system *system);

/* The Jacobian in the system's own clock, moving x moving, row-major: that of the formulas,
 * m->without_formula must be NULL. */
void iso_model_slopes(const iso_model *m, const double y[], double jac[]);

/* Assembles. Of problem->effects the point takes what has an image, the ball everything; problem->at is filled in.
 * with_clock[c] asks for clock c as a state; the independent clock is never one. */
iso_model iso_model_assemble(const iso_system *system, const iso_problem *problem, iso_clock clock,
                             const bool with_clock[ISO_CLOCKS]);

/* The same in place, where m->problem is there already. A problem has 13 kB: copies of it take a tenth of the time of a
 * short orbit. */
void iso_model_complete(iso_model *m, const iso_system *system, iso_clock clock, const bool with_clock[ISO_CLOCKS]);

/* The state at the start: the system's six numbers as they are, effects at their beginnings, clocks at 0. */
void iso_model_begin(const iso_model *m, const double start[ISO_STATE], double y[]);

/* The name of state i, and why it is there: "" for the system's own. */
const char *iso_model_state_name(const iso_model *m, int i, const char **reason);

/* One own unit of a quantity of dimension d, in the caller's units: caller's number = own number * iso_unit().
 * Infinite or zero when it does not fit a double. */
double iso_unit(const iso_units *units, iso_dimension d);

extern const iso_system iso_system_ball;
extern const iso_system iso_system_point;

/* Whether two moments of inertia are equal (to 4 units in the last place), making axis `axis` (0-2) one of symmetry.
 */
bool iso_params_symmetric(const iso_params *p, int axis);

/* --- what a scene writes, inside steps (written_inside.c) --------------------------------------------------------- */

/* The expressions of the effects that act; NULL: there are none, and nothing has to be looked at. False: no memory. */
typedef struct iso_inside iso_inside;
bool iso_inside_create(const iso_problem *f, iso_inside **inside);
void iso_inside_free(iso_inside *inside);

/* Whether they are polynomials of low degree in n, omega, e and the functions that they call. */
bool iso_inside_flat(iso_inside *inside, const iso_problem *f);

/* A part of a step: y lies in its middle; n (of a point: gamma), omega and e go at most so far away from there. time:
 * how long the whole step is. In own units. */
typedef struct iso_stretch {
    const double *y;
    double n, omega, e, time;
} iso_stretch;

/* The largest variation of the expressions there (iso_expression_variation): at most 1, they have no narrow feature in
 * it; 0, what they change is less than `least` of the state. */
double iso_inside_variation(iso_inside *inside, const iso_model *m, const iso_stretch *stretch, double least);

/* The longest step from y, in the model's clock, forwards or backwards (direction 1 or -1), in which the variation is
 * at most 1: for methods that look at a few places of a step alone. */
double iso_inside_longest(iso_inside *inside, const iso_model *m, int direction, const double y[], double least);

/* Whether a step of length h from y, in the model's clock, is so short that it leads nowhere: less than 1e-8 of the
 * time in which the state changes by about a radian. Towards a corner or a pole of what a scene writes, steps shrink
 * without an end. */
bool iso_inside_is_lost(const iso_model *m, const double y[], double h);

/* --- where a motion ends: what an integrator asks (rest.c) ------------------------------------------------------ */

/* A ball that only loses motion comes to rest, and rests from then on. Three things follow, which no step of a method
 * can find by itself:
 * - At rest nothing changes but clocks, and these go on evenly: any time is one step away.
 * - Backwards in time resistance drives the ball. It turns faster without end, and no number of steps is enough.
 * - While a ball loses its motion, what a method has lost of a constraint stays. In the end that loss is all there
 *   is. */

/* Whether the model rests in state y, and stays there from then on. */
bool iso_model_at_rest(const iso_model *m, const double y[]);

/* y becomes the state a time dt after y, for a model at rest. One evaluation of m->rhs. */
void iso_model_rest(const iso_model *m, double dt, double y[]);

/* Whether the model, which goes from y0 forwards (direction 1) or backwards (-1) in time, has come to a y from which it
 * turns ever faster. Returns a sentence about it; NULL: it does not. */
const char *iso_model_speeds_up(const iso_model *m, int direction, const double y0[], const double y[]);

/* iso_model_speeds_up can only answer above this speed; infinite: never. */
double iso_model_fast(const iso_model *m, int direction, const double y0[]);

/* A motion has ended in y: the text says whether an effect that the scene writes is the reason, and continues the
 * message; "": it is not. */
enum { ISO_BLAME_SIZE = 640 };
void iso_model_blame(const iso_model *m, const double y[], char text[ISO_BLAME_SIZE]);

/* Whether the scene claims of a torque what its form does not show: such a claim is tested at each step. */
bool iso_model_has_claim(const iso_model *m);

/* Returns what is wrong if the claim is false at y, else NULL; `text` then says where. */
const char *iso_model_false_claim(const iso_model *m, const double y[], char text[ISO_BLAME_SIZE]);

/* Whether a state y, found by a method that does not restore constraints, has lost one so far that y is no answer any
 * more. `tolerance` is that of the steps. Returns a sentence about it; NULL: nothing is lost. */
const char *iso_model_lost(const iso_model *m, const double y[], double tolerance);

#endif

/* formula.h - the equations of an effect, stated once.
 *
 * A function of the effect's row writes its equations down, by the calls of formula_impl.h, once for an orbit. What is
 * written down is then evaluated as often as it is needed, by one evaluator (series/evaluate_impl.h): as numbers for y',
 * in first order for the Jacobian, and as power series for Taylor methods, in any kind of number and for many orbits side
 * by side.
 */
#ifndef ISO_MODEL_FORMULA_H
#define ISO_MODEL_FORMULA_H

#include <stdbool.h>
#include <stdint.h>

#include "../base/api.h"
#include "params.h"

ISO_C_BEGIN

struct iso_problem;

/* What the calls hand on: a number that does not change along an orbit, a number, and a vector of R^3 that do.
 * A constant vector is three constants, a constant matrix nine, by rows. */
typedef struct iso_constant {
    int at;
} iso_constant;
typedef struct iso_scalar {
    int at;
} iso_scalar;
typedef struct iso_vector {
    int at;
} iso_vector;

typedef enum iso_operation {
    /* constants, from others */
    ISO_C_VALUE, ISO_C_K, ISO_C_J, ISO_C_D, ISO_C_ADD, ISO_C_SUB, ISO_C_MUL, ISO_C_DIV, ISO_C_ROOT,
    /* scalars */
    ISO_S_ADD, ISO_S_SUB, ISO_S_MUL, ISO_S_DIV, ISO_S_TIMES, ISO_S_PLUS, ISO_S_POWER, ISO_S_DOT, ISO_S_DOT_C,
    /* vectors */
    ISO_V_ADD, ISO_V_SUB, ISO_V_TIMES, ISO_V_SCALE, ISO_V_SCALE_C, ISO_V_CROSS, ISO_V_BY, ISO_V_MATRIX, ISO_V_PLUS,
    /* results */
    ISO_R_TORQUE, ISO_R_VECTOR_RATE, ISO_R_SCALAR_RATE, ISO_R_ENERGY, ISO_R_POTENTIAL, ISO_R_GRADIENT
} iso_operation;

typedef struct iso_formula_line {
    uint8_t operation, to, a, b;
} iso_formula_line;

enum {
    ISO_FORMULA_CONSTANTS = 48,
    ISO_FORMULA_SCALARS = 20, /* the first ones are given: see below */
    ISO_FORMULA_VECTORS = 36,
    ISO_FORMULA_LINES = 64,
    ISO_FORMULA_STATES = 6
};

/* What is given: g = (n, J^-1 n) of the ball, q = (gamma, J gamma) of the point, and the spin (omega,n) of a contact that
 * twists; omega, n (gamma), J^-1 n, and, to late lines, omega'. */
enum { ISO_GIVEN_BASE, ISO_GIVEN_SPIN, ISO_GIVEN_SCALARS };
enum { ISO_GIVEN_OMEGA, ISO_GIVEN_N, ISO_GIVEN_U, ISO_GIVEN_OMEGA_DOT, ISO_GIVEN_VECTORS };

typedef enum iso_formula_kind {
    ISO_FORMULA_NONE,
    ISO_FORMULA_MOTION,
    ISO_FORMULA_ENERGY,
    ISO_FORMULA_IMAGE
} iso_formula_kind;

typedef struct iso_formula {
    iso_formula_kind kind;
    bool series;  /* derived states are formulas here, not states                    */
    bool overrun; /* there was no room for all of it: it must not be used            */
    bool late;    /* some lines need omega', which follows from the torque           */
    bool torques; /* there is a torque                                               */
    int constants, scalars, vectors, lines, states;
    uint64_t late_line;                               /* a bit each                  */
    uint64_t late_scalar;
    uint64_t late_vector;
    iso_formula_line constant[ISO_FORMULA_CONSTANTS]; /* how each is computed        */
    double value[ISO_FORMULA_CONSTANTS];              /* in doubles                  */
    iso_formula_line line[ISO_FORMULA_LINES];
    struct {
        bool is_vector;
        uint8_t node, at, kind; /* where in y; see iso_effect_state */
    } state[ISO_FORMULA_STATES];
} iso_formula;

/* --- recording ------------------------------------------------------------------------------------------------------ */

/* An empty formula. */
void iso_formula_begin(iso_formula *F, iso_formula_kind kind, bool series);

/* After the last line: the constants in doubles. */
void iso_formula_finish(iso_formula *F, const iso_params *p);

/* One line more; gives the place of its result. */
int iso_formula_value(iso_formula *F, double x);
int iso_formula_constant(iso_formula *F, iso_operation operation, int a, int b);
int iso_formula_scalar(iso_formula *F, iso_operation operation, int a, int b);
int iso_formula_vector(iso_formula *F, iso_operation operation, int a, int b);
void iso_formula_result(iso_formula *F, iso_operation operation, int to, int a, int b);
int iso_formula_state(iso_formula *F, bool is_vector, int at);

/* Whether two formulas differ in numbers alone. */
bool iso_formula_alike(const iso_formula *F, const iso_formula *G);

/* --- evaluating as numbers ------------------------------------------------------------------------------------------ */

/* Of the ball at y: adds the torque to T and sets the rates in dy. Late: only what needs omega', dy[0..2]. */
void iso_formula_rates(const iso_formula *F, const iso_params *p, const double y[], double T[3], double dy[]);
void iso_formula_late_rates(const iso_formula *F, const iso_params *p, const double y[], double dy[]);

/* Of the ball: its potential energy U. */
double iso_formula_energy(const iso_formula *F, const iso_params *p, const double y[]);

/* Of the point: V, and dV/dgamma if not NULL. */
double iso_formula_image(const iso_formula *F, const iso_params *p, const double y[], double gradient[3]);

ISO_C_END

#endif

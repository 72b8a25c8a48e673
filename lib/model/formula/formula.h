/* formula.h - the equations of an effect, stated once.
 *
 * A formula is a list of lines. Each line is one operation: it takes one or two results of earlier lines and makes
 * one new result, a number or a vector of R^3. The last lines say what the results are for: a torque, the rate of a
 * state, an energy, a force on the point. A function of the effect's row writes the formula once for an orbit, with
 * the calls of formula_impl.h.
 *
 * One evaluator (series/evaluate_impl.h) then computes the lines from the first to the last. It computes
 *
 *     their values               for y' and for energies
 *     their first derivatives    for the Jacobian
 *     their power series         for Taylor methods, in any kind of number, for many orbits side by side
 *
 * Some lines need omega'. They are called late: omega' follows from the torque, so these lines are computed in a
 * second pass, after the torque and omega'. No torque and no energy may be late.
 */
#ifndef ISO_MODEL_FORMULA_FORMULA_H
#define ISO_MODEL_FORMULA_FORMULA_H

#include <stdbool.h>
#include <stdint.h>

#include "model/params.h"

struct iso_problem;

/* The results, by their places in the formula. A constant is the same all along an orbit; a scalar (a number) and a
 * vector of R^3 change. A constant vector is three constants one after the other, a constant matrix is nine, by rows.
 */
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
    /* constants: a number, k, J_(a+1) or D of the ball, or a result of two other constants */
    ISO_C_VALUE,
    ISO_C_K,
    ISO_C_J,
    ISO_C_D,
    ISO_C_ADD,
    ISO_C_SUB,
    ISO_C_MUL,
    ISO_C_DIV,
    ISO_C_ROOT,
    ISO_C_POWER,
    ISO_C_EXP,
    ISO_C_LOG,
    ISO_C_SIN,
    ISO_C_COS,
    /* scalars; TIMES: constant times scalar, PLUS: constant plus scalar, DOT_C: constant vector and vector; SIN and
     * COS stand one after the other, and each needs the other one */
    ISO_S_ADD,
    ISO_S_SUB,
    ISO_S_MUL,
    ISO_S_DIV,
    ISO_S_TIMES,
    ISO_S_PLUS,
    ISO_S_POWER,
    ISO_S_EXP,
    ISO_S_LOG,
    ISO_S_SIN,
    ISO_S_COS,
    ISO_S_DOT,
    ISO_S_DOT_C,
    /* vectors; see formula_impl.h for each */
    ISO_V_ADD,
    ISO_V_SUB,
    ISO_V_TIMES,
    ISO_V_SCALE,
    ISO_V_SCALE_C,
    ISO_V_CROSS,
    ISO_V_BY,
    ISO_V_MATRIX,
    ISO_V_PLUS,
    /* results */
    ISO_R_TORQUE,
    ISO_R_VECTOR_RATE,
    ISO_R_SCALAR_RATE,
    ISO_R_ENERGY,
    ISO_R_POTENTIAL,
    ISO_R_GRADIENT,
    ISO_R_MAGNETIC
} iso_operation;

/* a and b: the places of what goes in; to: the place of the result */
typedef struct iso_formula_line {
    uint8_t operation, to, a, b;
} iso_formula_line;

enum {
    ISO_FORMULA_CONSTANTS = 240,
    ISO_FORMULA_SCALARS = 128, /* with those that are given, see below */
    ISO_FORMULA_VECTORS = 64,
    ISO_FORMULA_LINES = 240,
    ISO_FORMULA_STATES = 6
};

/* The first scalars and vectors are given:
 *
 *     BASE         g = (n, J^-1 n) of the ball, q = (gamma, J gamma) of the point
 *     SPIN         (omega,n), where the contact twists
 *     OMEGA        omega of the ball
 *     N            n of the ball, gamma of the point
 *     U            J^-1 n of the ball
 *     OMEGA_DOT    omega' of the ball, for late lines alone
 */
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
    bool series;       /* for Taylor methods: states of kind ISO_STATE_DERIVED are formulas here, not states */
    bool overrun;      /* there was no room for all lines: the formula is empty      */
    const char *wrong; /* what else is wrong: then it is empty as well; NULL: nothing */
    bool late;         /* some lines are late                                        */
    bool torques;      /* there is a torque                                          */
    bool magnetic;     /* there is a magnetic field on the point                     */
    int constants, scalars, vectors, lines, states; /* how many there are            */
    bool late_line[ISO_FORMULA_LINES], late_scalar[ISO_FORMULA_SCALARS], late_vector[ISO_FORMULA_VECTORS];
    iso_formula_line constant[ISO_FORMULA_CONSTANTS]; /* how each is computed        */
    double value[ISO_FORMULA_CONSTANTS];              /* each in doubles             */
    iso_formula_line line[ISO_FORMULA_LINES];
    struct {
        bool is_vector;
        uint8_t node; /* its place among the scalars, or vectors */
        uint8_t at;   /* it is y[at], or y[at] to y[at + 2]      */
        uint8_t kind; /* the kind of iso_effect_state            */
    } state[ISO_FORMULA_STATES];
} iso_formula;

#endif

/* formula.h - the equations of an effect, stated once.
 *
 * A function of the effect's row writes its equations down as a formula, with the calls below:
 *
 *     static void motion(iso_formula *F, const iso_field *f)            MQ = mgb e x n,  e' = e x omega
 *     {
 *         const iso_vector e = vector_state(F, f->at[ISO_GRAVITY]), n = formula_n(F), omega = formula_omega(F);
 *         add_torque(F, constant(F, numbers(f)->mgb), cross_of(F, e, n));
 *         set_rate(F, e, cross_of(F, e, omega));
 *     }
 *
 * That is done once for an orbit. What is written down is then evaluated as often as it is needed, by one evaluator
 * (series/evaluate_impl.h): as numbers for y', in first order for the Jacobian, and as power series for Taylor methods,
 * in any kind of number and for many orbits side by side.
 *
 * A formula may depend on which effects are on and on whether k = 1, but not on other numbers: orbits that share the
 * lanes of a vector share their formulas. Constants are computed in the numbers of each method, so that 128 bits stay
 * 128 bits: write div_c(F, constant(F, 1), constant_k(F)), not constant(F, 1 / k).
 */
#ifndef ISO_MODEL_FORMULA_H
#define ISO_MODEL_FORMULA_H

#include <stdbool.h>
#include <stdint.h>

#include "params.h"

struct iso_field;

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

typedef struct iso_formula {
    enum { ISO_FORMULA_NONE, ISO_FORMULA_MOTION, ISO_FORMULA_ENERGY, ISO_FORMULA_IMAGE } kind;
    bool series;  /* derived states are formulas here, not states                    */
    bool overrun; /* there was no room for all of it: it must not be used            */
    bool late;    /* some lines need omega', which follows from the torque           */
    bool torques; /* there is a torque                                               */
    int constants, scalars, vectors, lines, states;
    uint64_t late_line;                               /* a bit each                  */
    uint32_t late_scalar;
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
void iso_formula_begin(iso_formula *F, int kind, bool series);

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

/* --- constants ------------------------------------------------------------------------------------------------------ */

static inline iso_constant constant(iso_formula *F, double x)
{
    return (iso_constant){iso_formula_value(F, x)};
}

static inline iso_constant constant_k(iso_formula *F)
{
    return (iso_constant){iso_formula_constant(F, ISO_C_K, 0, 0)};
}

static inline iso_constant constant_D(iso_formula *F)
{
    return (iso_constant){iso_formula_constant(F, ISO_C_D, 0, 0)};
}

/* count numbers, one after the other: a vector, a matrix */
static inline iso_constant constants(iso_formula *F, int count, const double x[])
{
    iso_constant first = constant(F, x[0]);
    for (int i = 1; i < count; i++) constant(F, x[i]);
    return first;
}

/* (J1, J2, J3), and their square roots */
static inline iso_constant constant_J(iso_formula *F)
{
    const iso_constant first = {iso_formula_constant(F, ISO_C_J, 0, 0)};
    for (int i = 1; i < 3; i++) iso_formula_constant(F, ISO_C_J, i, 0);
    return first;
}

static inline iso_constant constant_root_J(iso_formula *F)
{
    const iso_constant J = constant_J(F), first = {iso_formula_constant(F, ISO_C_ROOT, J.at, 0)};
    for (int i = 1; i < 3; i++) iso_formula_constant(F, ISO_C_ROOT, J.at + i, 0);
    return first;
}

static inline iso_constant add_c(iso_formula *F, iso_constant a, iso_constant b)
{
    return (iso_constant){iso_formula_constant(F, ISO_C_ADD, a.at, b.at)};
}

static inline iso_constant sub_c(iso_formula *F, iso_constant a, iso_constant b)
{
    return (iso_constant){iso_formula_constant(F, ISO_C_SUB, a.at, b.at)};
}

static inline iso_constant mul_c(iso_formula *F, iso_constant a, iso_constant b)
{
    return (iso_constant){iso_formula_constant(F, ISO_C_MUL, a.at, b.at)};
}

static inline iso_constant div_c(iso_formula *F, iso_constant a, iso_constant b)
{
    return (iso_constant){iso_formula_constant(F, ISO_C_DIV, a.at, b.at)};
}

/* --- what is given -------------------------------------------------------------------------------------------------- */

static inline iso_vector formula_omega(iso_formula *F)
{
    (void)F;
    return (iso_vector){ISO_GIVEN_OMEGA};
}

static inline iso_vector formula_n(iso_formula *F)
{
    (void)F;
    return (iso_vector){ISO_GIVEN_N};
}

/* the point's gamma stands in the place of n */
static inline iso_vector formula_gamma(iso_formula *F)
{
    (void)F;
    return (iso_vector){ISO_GIVEN_N};
}

/* J^-1 n */
static inline iso_vector formula_u(iso_formula *F)
{
    (void)F;
    return (iso_vector){ISO_GIVEN_U};
}

static inline iso_vector formula_omega_dot(iso_formula *F)
{
    (void)F;
    return (iso_vector){ISO_GIVEN_OMEGA_DOT};
}

/* g = (n, J^-1 n) */
static inline iso_scalar formula_g(iso_formula *F)
{
    (void)F;
    return (iso_scalar){ISO_GIVEN_BASE};
}

/* q = (gamma, J gamma) */
static inline iso_scalar formula_q(iso_formula *F)
{
    (void)F;
    return (iso_scalar){ISO_GIVEN_BASE};
}

/* (omega,n), of a contact that twists */
static inline iso_scalar formula_spin(iso_formula *F)
{
    (void)F;
    return (iso_scalar){ISO_GIVEN_SPIN};
}

/* States of effects: y[at], and (y[at], y[at+1], y[at+2]). */
static inline iso_scalar scalar_state(iso_formula *F, int at)
{
    return (iso_scalar){iso_formula_state(F, false, at)};
}

static inline iso_vector vector_state(iso_formula *F, int at)
{
    return (iso_vector){iso_formula_state(F, true, at)};
}

/* --- scalars -------------------------------------------------------------------------------------------------------- */

static inline iso_scalar add(iso_formula *F, iso_scalar a, iso_scalar b)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_ADD, a.at, b.at)};
}

static inline iso_scalar sub(iso_formula *F, iso_scalar a, iso_scalar b)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_SUB, a.at, b.at)};
}

static inline iso_scalar mul(iso_formula *F, iso_scalar a, iso_scalar b)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_MUL, a.at, b.at)};
}

static inline iso_scalar quotient_of(iso_formula *F, iso_scalar a, iso_scalar b)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_DIV, a.at, b.at)};
}

/* c a, and c + a */
static inline iso_scalar times_c(iso_formula *F, iso_constant c, iso_scalar a)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_TIMES, c.at, a.at)};
}

static inline iso_scalar plus_c(iso_formula *F, iso_constant c, iso_scalar a)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_PLUS, c.at, a.at)};
}

/* a^p, a > 0 */
static inline iso_scalar power_of(iso_formula *F, iso_scalar a, iso_constant p)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_POWER, a.at, p.at)};
}

static inline iso_scalar dot_of(iso_formula *F, iso_vector a, iso_vector b)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_DOT, a.at, b.at)};
}

/* with a constant vector */
static inline iso_scalar dot_c(iso_formula *F, iso_constant c, iso_vector a)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_DOT_C, c.at, a.at)};
}

/* --- vectors -------------------------------------------------------------------------------------------------------- */

static inline iso_vector add_v(iso_formula *F, iso_vector a, iso_vector b)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_ADD, a.at, b.at)};
}

static inline iso_vector sub_v(iso_formula *F, iso_vector a, iso_vector b)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_SUB, a.at, b.at)};
}

/* c a for a constant c, and s a for a scalar */
static inline iso_vector times_v(iso_formula *F, iso_constant c, iso_vector a)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_TIMES, c.at, a.at)};
}

static inline iso_vector scale_v(iso_formula *F, iso_scalar s, iso_vector a)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_SCALE, s.at, a.at)};
}

/* s c for a constant vector c */
static inline iso_vector scale_c(iso_formula *F, iso_scalar s, iso_constant c)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_SCALE_C, c.at, s.at)};
}

/* a + c for a constant vector c */
static inline iso_vector plus_v(iso_formula *F, iso_constant c, iso_vector a)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_PLUS, c.at, a.at)};
}

static inline iso_vector cross_of(iso_formula *F, iso_vector a, iso_vector b)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_CROSS, a.at, b.at)};
}

/* (c1 a1, c2 a2, c3 a3) for a constant vector c, and M a for a constant matrix */
static inline iso_vector by_c(iso_formula *F, iso_constant c, iso_vector a)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_BY, c.at, a.at)};
}

static inline iso_vector matrix_c(iso_formula *F, iso_constant M, iso_vector a)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_MATRIX, M.at, a.at)};
}

/* --- results -------------------------------------------------------------------------------------------------------- */

/* MQ += c a */
static inline void add_torque(iso_formula *F, iso_constant c, iso_vector a)
{
    iso_formula_result(F, ISO_R_TORQUE, 0, c.at, a.at);
}

/* state' = c a; each state has one rate */
static inline void set_rate_v(iso_formula *F, iso_vector state, iso_constant c, iso_vector a)
{
    iso_formula_result(F, ISO_R_VECTOR_RATE, state.at, c.at, a.at);
}

static inline void set_rate(iso_formula *F, iso_scalar state, iso_constant c, iso_scalar a)
{
    iso_formula_result(F, ISO_R_SCALAR_RATE, state.at, c.at, a.at);
}

/* U += c a, of the ball; V += c a and dV/dgamma += c a, of the point */
static inline void add_energy(iso_formula *F, iso_constant c, iso_scalar a)
{
    iso_formula_result(F, ISO_R_ENERGY, 0, c.at, a.at);
}

static inline void add_potential(iso_formula *F, iso_constant c, iso_scalar a)
{
    iso_formula_result(F, ISO_R_POTENTIAL, 0, c.at, a.at);
}

static inline void add_gradient(iso_formula *F, iso_constant c, iso_vector a)
{
    iso_formula_result(F, ISO_R_GRADIENT, 0, c.at, a.at);
}

#endif

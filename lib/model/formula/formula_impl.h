/* formula_impl.h - the calls by which an effect writes its equations down.
 *
 * A function of the effect's row writes its equations down as a formula, with the calls below:
 *
 *     static void motion(iso_formula *F, const iso_problem *f)            MQ = mgb e x n,  e' = e x omega
 *     {
 *         const iso_vector e = vector_state(F, f->at[ISO_GRAVITY]);
 *         add_torque(F, constant(F, mgb(f)), cross_of(F, e, formula_n(F)));
 *         set_rate_v(F, e, constant(F, 1), cross_of(F, e, formula_omega(F)));
 *     }
 *
 * formula.h says what becomes of it. The rules:
 *
 *     Each state of the effect has one rate: set_rate for a scalar state, set_rate_v for a vector state.
 *     A state has one shape. Who reads another effect's state reads it in the shape in which it has its rate.
 *     The lines of a formula may depend on which effects are on and on whether k = 1, and on no other number: orbits
 *     that are computed side by side share their lines.
 *     Compute with constants by the calls: div_c(F, constant(F, 1), constant_k(F)), not constant(F, 1 / k).
 *     Each method then computes them in its own numbers, and 128 bits stay 128 bits.
 */
#ifndef ISO_MODEL_FORMULA_FORMULA_IMPL_H
#define ISO_MODEL_FORMULA_FORMULA_IMPL_H

#include "model/formula/formula_lines_impl.h"

/* --- constants -------------------------------------------------------------------------------------------------- */

/* The call `name`: writes one line, of which `result` is made from a and b. */
#define ISO_LINE(result, name, operation, A, B)                                                                      \
    static inline iso_##result name(iso_formula *F, iso_##A a, iso_##B b)                                            \
    {                                                                                                                \
        return (iso_##result){iso_formula_##result(F, operation, a.at, b.at)};                                       \
    }

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

ISO_LINE(constant, add_c, ISO_C_ADD, constant, constant)
ISO_LINE(constant, sub_c, ISO_C_SUB, constant, constant)
ISO_LINE(constant, mul_c, ISO_C_MUL, constant, constant)
ISO_LINE(constant, div_c, ISO_C_DIV, constant, constant)

/* sqrt a, a^b for a > 0, exp a, log a, sin a, cos a: one of ISO_C_ROOT to ISO_C_COS */
static inline iso_constant function_c(iso_formula *F, iso_operation operation, iso_constant a, iso_constant b)
{
    return (iso_constant){iso_formula_constant(F, operation, a.at, b.at)};
}

/* det J, J from constant_J */
static inline iso_constant det_of(iso_formula *F, iso_constant J)
{
    return mul_c(F, mul_c(F, J, (iso_constant){J.at + 1}), (iso_constant){J.at + 2});
}

/* --- what is given ---------------------------------------------------------------------------------------------- */

#define ISO_GIVEN(result, name, place)                                                                               \
    static inline iso_##result name(iso_formula *F)                                                                  \
    {                                                                                                                \
        (void)F;                                                                                                     \
        return (iso_##result){place};                                                                                \
    }

ISO_GIVEN(vector, formula_omega, ISO_GIVEN_OMEGA)
ISO_GIVEN(vector, formula_n, ISO_GIVEN_N)
ISO_GIVEN(vector, formula_gamma, ISO_GIVEN_N) /* of the point; it has the place of n */
ISO_GIVEN(vector, formula_u, ISO_GIVEN_U)     /* J^-1 n */
ISO_GIVEN(vector, formula_omega_dot, ISO_GIVEN_OMEGA_DOT)
ISO_GIVEN(scalar, formula_g, ISO_GIVEN_BASE)    /* (n, J^-1 n) of the ball */
ISO_GIVEN(scalar, formula_q, ISO_GIVEN_BASE)    /* (gamma, J gamma) of the point */
ISO_GIVEN(scalar, formula_spin, ISO_GIVEN_SPIN) /* (omega,n), where the contact twists */

/* States of effects: y[at], and (y[at], y[at+1], y[at+2]). */
static inline iso_scalar scalar_state(iso_formula *F, int at)
{
    return (iso_scalar){iso_formula_state(F, false, at)};
}

static inline iso_vector vector_state(iso_formula *F, int at)
{
    return (iso_vector){iso_formula_state(F, true, at)};
}

/* --- scalars ---------------------------------------------------------------------------------------------------- */

ISO_LINE(scalar, add, ISO_S_ADD, scalar, scalar)
ISO_LINE(scalar, sub, ISO_S_SUB, scalar, scalar)
ISO_LINE(scalar, mul, ISO_S_MUL, scalar, scalar)
ISO_LINE(scalar, quotient_of, ISO_S_DIV, scalar, scalar)
ISO_LINE(scalar, times_c, ISO_S_TIMES, constant, scalar)
ISO_LINE(scalar, plus_c, ISO_S_PLUS, constant, scalar)
ISO_LINE(scalar, power_of, ISO_S_POWER, scalar, constant) /* a > 0 */
ISO_LINE(scalar, dot_of, ISO_S_DOT, vector, vector)
ISO_LINE(scalar, dot_c, ISO_S_DOT_C, constant, vector) /* with a constant vector */

static inline iso_scalar exp_of(iso_formula *F, iso_scalar a)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_EXP, a.at, 0)};
}

static inline iso_scalar log_of(iso_formula *F, iso_scalar a)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_LOG, a.at, 0)};
}

/* sin a, and cos a, which comes with it */
static inline iso_scalar sin_of(iso_formula *F, iso_scalar a, iso_scalar *cosine)
{
    const int sine = iso_formula_sine(F, a.at);
    cosine->at = F->overrun ? sine : sine + 1;
    return (iso_scalar){sine};
}

/* --- vectors ---------------------------------------------------------------------------------------------------- */

ISO_LINE(vector, add_v, ISO_V_ADD, vector, vector)
ISO_LINE(vector, sub_v, ISO_V_SUB, vector, vector)
ISO_LINE(vector, times_v, ISO_V_TIMES, constant, vector)
ISO_LINE(vector, scale_v, ISO_V_SCALE, scalar, vector)
ISO_LINE(vector, plus_v, ISO_V_PLUS, constant, vector) /* a constant vector and b */
ISO_LINE(vector, cross_of, ISO_V_CROSS, vector, vector)
ISO_LINE(vector, by_c, ISO_V_BY, constant, vector)         /* (a1 b1, a2 b2, a3 b3) for a constant vector a */
ISO_LINE(vector, matrix_c, ISO_V_MATRIX, constant, vector) /* a b for a constant matrix a */

/* s c for a constant vector c */
static inline iso_vector scale_c(iso_formula *F, iso_scalar s, iso_constant c)
{
    return (iso_vector){iso_formula_vector(F, ISO_V_SCALE_C, c.at, s.at)};
}

/* --- results ---------------------------------------------------------------------------------------------------- */

/* The call `name`: adds c a to what stands beside it. */
#define ISO_RESULT(name, operation, A)                                                                               \
    static inline void name(iso_formula *F, iso_constant c, iso_##A a)                                               \
    {                                                                                                                \
        iso_formula_result(F, operation, 0, c.at, a.at);                                                             \
    }

ISO_RESULT(add_torque, ISO_R_TORQUE, vector)       /* MQ */
ISO_RESULT(add_energy, ISO_R_ENERGY, scalar)       /* U of the ball */
ISO_RESULT(add_potential, ISO_R_POTENTIAL, scalar) /* V of the point */
ISO_RESULT(add_gradient, ISO_R_GRADIENT, vector)   /* dV/dgamma */

/* B, a magnetic field normal to the sphere of the point, M' += B gamma'. Its force -B M is orthogonal to
 * gamma', and does no work. On a sphere every force that does no work is of this kind. */
ISO_RESULT(add_magnetic, ISO_R_MAGNETIC, scalar)

/* state' = c a. Every state must be given a rate, and once only. */
static inline void set_rate_v(iso_formula *F, iso_vector state, iso_constant c, iso_vector a)
{
    iso_formula_result(F, ISO_R_VECTOR_RATE, state.at, c.at, a.at);
}

static inline void set_rate(iso_formula *F, iso_scalar state, iso_constant c, iso_scalar a)
{
    iso_formula_result(F, ISO_R_SCALAR_RATE, state.at, c.at, a.at);
}

#endif

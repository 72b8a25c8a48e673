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
#ifndef ISO_MODEL_FORMULA_IMPL_H
#define ISO_MODEL_FORMULA_IMPL_H

#include "model/formula/formula_lines_impl.h"

/* --- constants -------------------------------------------------------------------------------------------------- */

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

/* a^b for a > 0, exp a, log a, sin a, cos a: one of ISO_C_POWER to ISO_C_COS */
static inline iso_constant function_c(iso_formula *F, iso_operation operation, iso_constant a, iso_constant b)
{
    return (iso_constant){iso_formula_constant(F, operation, a.at, b.at)};
}

/* --- what is given ---------------------------------------------------------------------------------------------- */

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

/* gamma of the point; it has the place of n */
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

/* (omega,n), where the contact twists */
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

/* --- scalars ---------------------------------------------------------------------------------------------------- */

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

static inline iso_scalar dot_of(iso_formula *F, iso_vector a, iso_vector b)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_DOT, a.at, b.at)};
}

/* with a constant vector */
static inline iso_scalar dot_c(iso_formula *F, iso_constant c, iso_vector a)
{
    return (iso_scalar){iso_formula_scalar(F, ISO_S_DOT_C, c.at, a.at)};
}

/* --- vectors ---------------------------------------------------------------------------------------------------- */

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

/* --- results ---------------------------------------------------------------------------------------------------- */

/* MQ += c a */
static inline void add_torque(iso_formula *F, iso_constant c, iso_vector a)
{
    iso_formula_result(F, ISO_R_TORQUE, 0, c.at, a.at);
}

/* state' = c a. Every state must be given a rate, and once only. */
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

/* B += c a: a magnetic field normal to the sphere of the point, M' += B gamma'. Its force -B M is orthogonal to
 * gamma', and does no work. On a sphere every force that does no work is of this kind. */
static inline void add_magnetic(iso_formula *F, iso_constant c, iso_scalar a)
{
    iso_formula_result(F, ISO_R_MAGNETIC, 0, c.at, a.at);
}

#endif

/* formula_lines_impl.h - the lines of a formula (formula.h): how they are written, and computed as numbers. */
#ifndef ISO_MODEL_FORMULA_FORMULA_LINES_IMPL_H
#define ISO_MODEL_FORMULA_FORMULA_LINES_IMPL_H

#include "model/formula/formula.h"

/* --- recording -------------------------------------------------------------------------------------------------- */

/* An empty formula. */
void iso_formula_begin(iso_formula *F, iso_formula_kind kind, bool series);

/* After the last line: computes the constants in doubles. Empties a formula that is overrun or wrong. */
void iso_formula_finish(iso_formula *F, const iso_params *p);

/* Each of these writes one line and returns the place of its result. formula_impl.h has a call for each operation. */
int iso_formula_value(iso_formula *F, double x);
int iso_formula_constant(iso_formula *F, iso_operation operation, int a, int b);
int iso_formula_scalar(iso_formula *F, iso_operation operation, int a, int b);
int iso_formula_sine(iso_formula *F, int a); /* of the sine; the cosine is next */
int iso_formula_vector(iso_formula *F, iso_operation operation, int a, int b);
void iso_formula_result(iso_formula *F, iso_operation operation, int to, int a, int b);
int iso_formula_state(iso_formula *F, bool is_vector, int at);

/* Takes out the lines that no result needs; iso_formula_finish does it. */
void iso_formula_shorten(iso_formula *F);

/* Whether two formulas have the same lines: then they differ in the values of their constants alone. */
bool iso_formula_alike(const iso_formula *F, const iso_formula *G);

/* --- evaluating as numbers -------------------------------------------------------------------------------------- */

/* Of the ball at y: adds the torque to T, and sets the rates of the states in dy. The late rates are set by the
 * second call, which reads omega' from dy[0..2]. */
void iso_formula_rates(const iso_formula *F, const iso_params *p, const double y[], double T[3], double dy[]);
void iso_formula_late_rates(const iso_formula *F, const iso_params *p, const double y[], double dy[]);

/* Of the ball: its potential energy U. */
double iso_formula_energy(const iso_formula *F, const iso_params *p, const double y[]);

/* Of the point: V, dV/dgamma and the magnetic field B, at gamma = y[3..5]. */
typedef struct iso_image {
    double potential, gradient[3], magnetic;
} iso_image;
iso_image iso_formula_image(const iso_formula *F, const iso_params *p, const double y[]);

#endif

/* model_impl.h - what integrators ask a model. */
#ifndef ISO_MODEL_MODEL_IMPL_H
#define ISO_MODEL_MODEL_IMPL_H

#include "model/model.h"

/* Why the model cannot be simulated: more effects than there is room for; NULL: it can. */
const char *iso_model_too_large(const iso_model *m);

/* The first of its effects whose equations are no formula: only methods that need nothing but y' can take it. NULL:
 * none. */
const iso_effect *iso_model_without_formula(const iso_model *m);

/* Restores the constraints of system and effects, and the energy where it is conserved; gives the relative size of
 * the correction. */
double iso_model_project(const iso_model *m, double y[]);

/* The size of each component for error control: of the vector of R^3 it belongs to; of the clock, and of its
 * progress in one unit of the independent variable. Errors of a step are measured in units of tolerance * size. */
void iso_model_size(const iso_model *m, const double y[], double size[]);

/* Whether its equations stand in series/recurrences_impl.h, of which slopes and series are made. */
bool iso_system_has_recurrences(const iso_system *system);

/* The Jacobian in the system's own clock, moving x moving, row-major: that of the formulas,
 * iso_model_without_formula() must be NULL. */
void iso_model_slopes(const iso_model *m, const double y[], double jac[]);

#endif

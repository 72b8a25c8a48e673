/* written_impl.h - expressions as lines of formulas: what the rows of the effects that a scene writes have in common.
 */
#ifndef ISO_MODEL_EXPRESSION_WRITTEN_IMPL_H
#define ISO_MODEL_EXPRESSION_WRITTEN_IMPL_H

#include "model/effects/effects_impl.h"
#include "model/expression/expression_impl.h"
#include "model/expression/quantity_impl.h"

/* Where the numbers of such an effect are: its parameters, then these. J and W: one own unit of J and of angular
 * velocity, in the caller's units. They carry J, omega and the result of an expression from own units to the caller's
 * and back. In the caller's units both are 1. */
enum { ISO_WRITTEN_J = ISO_PARAMETERS, ISO_WRITTEN_W, ISO_WRITTEN_STRENGTH, ISO_WRITTEN_WORK };

extern const double iso_written_one;

/* The rows of these numbers; how large its energy or torque is, the effect itself finds. */
#define ISO_WRITTEN_NUMBER(title, place, ...)                                                                        \
    {                                                                                                                \
        .name = (title), .at = (place), .count = 1, .dimension = {__VA_ARGS__}, .hidden = true,                      \
        .initially = &iso_written_one                                                                                \
    }
#define ISO_WRITTEN_UNITS                                                                                            \
    ISO_WRITTEN_NUMBER("(J)", ISO_WRITTEN_J, -1, 0, 0), ISO_WRITTEN_NUMBER("(w)", ISO_WRITTEN_W, 0, 0, -1)
#define ISO_WRITTEN_NUMBERS ISO_WRITTEN_UNITS, ISO_WRITTEN_NUMBER("(strength)", ISO_WRITTEN_STRENGTH, 1, 0, 2)

/* What the expressions of an effect read where the ball's state is y, in the caller's units. */
iso_expression_state iso_written_state(const iso_problem *f, iso_effect_id id, const double y[]);

/* Reads expression `which` of an effect. False: the text is no expression, see e->wrong. */
bool iso_written_read(const iso_effects *effects, iso_effect_id id, int which, iso_expression *e);

/* Whether its constants are finite, in the caller's units, the vertical e is there if it reads e, and an effect that
 * acts has no corner by its form. False: see e->wrong. */
bool iso_written_decided(const iso_params *p, const iso_effects *effects, iso_effect_id id, iso_expression *e);

/* Reads it and asks the first two. Errors: ISO_BAD_INPUT about the name of the expression. */
iso_status iso_written_check(iso_context *ctx, const iso_params *p, const iso_effects *effects, iso_effect_id id,
                             int which, iso_expression *e);

/* What the torque does to the energy, as far as the form of its power shows it. Its constants must be finite. */
iso_work iso_written_work(const iso_problem *f);

/* Whether the torque of the three expressions gives energy (1) or takes it (-1) in the state; 0: neither, but for
 * rounding. */
int iso_written_works(const iso_expression e[3], const iso_expression_state *s);

/* Refuses a start (omega, n; e where its state is) at which the torque or the potential of an effect is not finite.
 * Returns ISO_BAD_INPUT about the key of the expression, which it names with the reason. */
iso_status iso_written_refuse_start(iso_context *ctx, const iso_problem *f, iso_effect_id id, const double ball[]);

/* One expression that is being written down. n: as what the formula has it. */
typedef struct iso_writer {
    iso_formula *F;
    iso_expression e;
    const double *number; /* of the effect */
    iso_vector n, omega, vertical;
    int most;       /* polynomials in n up to this degree are written with vectors */
    iso_constant J; /* J1, J2, J3 in the caller's units ... */
    bool has_J;     /* ... if they are there            */
    iso_quantity value[ISO_EXPRESSION_NODES];
    bool has_value[ISO_EXPRESSION_NODES];
    /* of a polynomial in n, c + (l,n) + (n,Cn)/2: l, C n and (n, dU/dn) = (l,n) + (n,Cn) */
    struct {
        bool has_l, has_C;
        iso_constant l;
        iso_vector C_n;
        iso_quantity along;
    } form[ISO_EXPRESSION_NODES];
} iso_writer;

/* Reads expression `which` of an effect and begins. Its numbers are in own units, the expression is one of the caller's
 * units. False: the text is no expression. */
bool iso_writer_begin(iso_writer *w, iso_formula *F, const iso_problem *f, iso_effect_id id, int which, iso_vector n);

/* The value of the expression, in the caller's units, as a scalar of the formula. */
iso_scalar iso_writer_value(iso_writer *w);

/* Of an expression in n alone: U, dU/dn and (n, dU/dn). */
void iso_writer_slope(iso_writer *w, iso_scalar *U, iso_vector *dU, iso_scalar *along);

/* One unit of energy or torque in own units, over one in the caller's. */
iso_constant iso_writer_over_energy(iso_writer *w);

/* For the two files that write: the value of a node; whether it is written with vectors; the exponent of a power, where
 * the text itself says which whole number it is, from 1 to 64, else 0. */
iso_quantity iso_writer_value_of(iso_writer *w, int node);
bool iso_writer_is_form(const iso_writer *w, int node);
int iso_writer_exponent(const iso_expression *e, const iso_expression_node *power);

#endif

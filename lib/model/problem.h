/* problem.h - what distinguishes one orbit's equations from another's: the ball, the energy, and the effects.
 *
 * Each effect keeps its numbers in an array of its own. The row of the effect (effect.h) says what they are.
 * An effect that is not `on` is not simulated, and its numbers are not read.
 */
#ifndef ISO_MODEL_PROBLEM_H
#define ISO_MODEL_PROBLEM_H

#include <stdbool.h>

#include "model/effects/effect_list.h"
#include "model/formula/formula.h"
#include "model/params.h"

enum { ISO_EFFECT_NUMBERS = 12 }; /* the most numbers of one effect */

enum {
    ISO_WRITTEN = 3,           /* effects that are written in the scene               */
    ISO_EXPRESSIONS = 3,       /* the most expressions of one of them                 */
    ISO_EXPRESSION_SIZE = 512, /* of one, with its end mark                           */
    ISO_PARAMETERS = 8,        /* the most parameters of one effect: its first numbers */
    ISO_PARAMETER_SIZE = 16
};

/* The text of an effect that is written in the scene; iso_effect.written says which effect has which. */
typedef struct iso_written {
    char expression[ISO_EXPRESSIONS][ISO_EXPRESSION_SIZE];
    char parameter[ISO_PARAMETERS][ISO_PARAMETER_SIZE]; /* names; "": there are no more */
} iso_written;

typedef struct iso_effects {
    bool on[ISO_EFFECTS];
    bool idle[ISO_EFFECTS]; /* no torque from this start on: it only observes; iso_effects_settle finds it */
    double number[ISO_EFFECTS][ISO_EFFECT_NUMBERS];
    iso_written written[ISO_WRITTEN];
} iso_effects;

typedef struct iso_problem {
    iso_params p;
    double eps;    /* coupling of the point's potential, (24); 0 for the ball      */
    double energy; /* the energy of the orbit: h of the ball, H of the point       */
    iso_effects effects;
    int at[ISO_EFFECTS];        /* where in the state those of an effect begin; 0: it has none  */
    iso_formula motion;         /* the equations of the effects on the ball ...                 */
    iso_formula energy_formula; /* ... and their potential; of the point, their image    */
} iso_problem;

#endif

/* serves.c - whether a method can simulate a model: each check compares one need of the method's row with what the
 * model has, and says what is missing. A method is never run on a model that it would simulate wrongly. */
#include <stdio.h>

#include "method/methods_impl.h"
#include "model/model_impl.h"

/* --- one check for each need --------------------------------------------------------------------------------- */

static bool has_system(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    if (!method->system || method->system == model->system) return true;
    snprintf(why, ISO_WHY_SIZE, "is for the %s%s%s", method->system->name, method->system_why ? ": " : "",
             method->system_why ? method->system_why : "");
    return false;
}

/* Jacobians and series are made of the effects' formulas. */
static bool has_formulas(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    const char *needs = method->implicit ? "solves with slopes" : "expands the equations in series";
    if (!method->implicit && !method->own_equations) return true;
    const iso_effect *lacking = model->without_formula;
    if (!iso_system_has_recurrences(model->system))
        snprintf(why, ISO_WHY_SIZE, "%s, and there are no recurrences of the %s to make them from", needs,
                 model->system->name);
    else if (lacking)
        snprintf(why, ISO_WHY_SIZE, "%s, and the equations of '%s' are no formula to make them from", needs,
                 lacking->name);
    return iso_system_has_recurrences(model->system) && !lacking;
}

static bool has_room(const iso_model *model, char why[ISO_WHY_SIZE])
{
    const char *too_large = iso_model_too_large(model);
    if (too_large) snprintf(why, ISO_WHY_SIZE, "cannot be used: %s", too_large);
    return !too_large;
}

/* Steps of one length in s suit no potential that spans many decades. For k = -1 it is a quadratic form, and spans
 * none. */
static bool has_even_steps(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    const iso_params *p = &model->problem.p;
    if (!method->steps_in_s || !iso_params_steep(p) || p->k == -1) return true;
    snprintf(
        why, ISO_WHY_SIZE,
        "has steps that are fixed in s, and for this k one radian of the way may take 1e10 times as long as another");
    return false;
}

/* --- all of them --------------------------------------------------------------------------------------------- */

bool iso_method_serves(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    return has_system(method, model, why) && has_room(model, why) && has_formulas(method, model, why) &&
           has_even_steps(method, model, why);
}

/* serves.c - whether a method can simulate a model: each check compares one need of the method's row with what the
 * model has, and says what is missing. A method is never run on a model that it would simulate wrongly. */
#include <stdio.h>

#include "method/method.h"

/* --- one check for each need --------------------------------------------------------------------------------- */

static bool has_system(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    if (!method->system || method->system == model->system) return true;
    snprintf(why, ISO_WHY_SIZE, "is for the %s%s%s", method->system->name, method->system_why ? ": " : "",
             method->system_why ? method->system_why : "");
    return false;
}

/* The effect without the slope of its torque (of its image on a point), or of the rates of its states; NULL: none. */
static const iso_effect *without_slope(const iso_model *model)
{
    const bool ball = model->system == &iso_system_ball;
    for (int i = 0; i < model->forces; i++)
        if (ball ? !model->force[i]->torque_slope : !model->force[i]->image_slope) return model->force[i];
    for (int i = 0; i < model->followers; i++)
        if (!model->follower[i]->rates_slope) return model->follower[i];
    return NULL;
}

static bool has_jacobian(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    const iso_effect *lacking = method->implicit ? without_slope(model) : NULL;
    if (!lacking) return true;
    snprintf(why, ISO_WHY_SIZE, "solves with the Jacobian, and '%s' has no slopes to make one", lacking->name);
    return false;
}

/* Steps of one length in s suit no potential that spans many decades. For k = -1 it is a quadratic form, and spans
 * none. */
static bool has_even_steps(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    const iso_params *p = &model->field.p;
    if (!method->steps_in_s || !iso_params_steep(p) || p->k == -1) return true;
    snprintf(
        why, ISO_WHY_SIZE,
        "has steps that are fixed in s, and for this k one radian of the way may take 1e10 times as long as another");
    return false;
}

/* --- all of them --------------------------------------------------------------------------------------------- */

bool iso_method_serves(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    return has_system(method, model, why) && has_jacobian(method, model, why) && has_even_steps(method, model, why);
}

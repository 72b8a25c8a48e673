/* method.c - the registry of methods: all of them, one by its name, one that suits a model; and what a method can
 * simulate. */
#include "method/method.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/names_impl.h"
#include "method/methods_impl.h"
#include "model/model_impl.h"

const iso_method *const iso_methods[] = {
#define ISO_METHOD_ENTRY(name) &iso_method_##name,
    ISO_METHOD_LIST(ISO_METHOD_ENTRY)
#undef ISO_METHOD_ENTRY
        NULL,
};

/* The number of characters of `name` behind the pattern; -1: the name does not begin with the pattern. */
static int left_over(const char *pattern, const char *name)
{
    for (; *pattern; pattern++, name++) {
        const int c = *pattern == '-' ? '_' : tolower((unsigned char)*pattern);
        if (c != *name) return -1;
    }
    return (int)strlen(name);
}

/* The pattern without the family's name in front of it, if that is there. */
static const char *without_family(const char *pattern, const char *family)
{
    const size_t length = strlen(family);
    for (size_t i = 0; i < length; i++)
        if (tolower((unsigned char)pattern[i]) != family[i]) return pattern;
    return pattern[length] == '-' || pattern[length] == '_' ? pattern + length + 1 : pattern;
}

const iso_method *iso_method_find(const char *name)
{
    const iso_method *candidate = NULL;
    int candidates = 0;
    for (int i = 0; iso_methods[i]; i++) {
        const char *pattern = without_family(name, iso_methods[i]->family);
        const int rest = *pattern ? left_over(pattern, iso_methods[i]->name) : -1;
        if (rest == 0) return iso_methods[i];
        if (rest > 0) candidate = iso_methods[i], candidates++;
    }
    return candidates == 1 ? candidate : NULL;
}

const char *iso_method_word(int i)
{
    if (i == 0) return "auto";
    return iso_methods[i - 1] ? iso_methods[i - 1]->name : NULL;
}

iso_status iso_method_check(iso_context *ctx, const char *name)
{
    char suggested[ISO_SUGGEST_SIZE];
    if (strcmp(name, "auto") == 0 || iso_method_find(name)) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "method", "there is no method '%s'" ISO_WITHOUT_SUNDIALS "; %s", name,
                             iso_suggest_word(suggested, name, iso_method_word));
}

const iso_method *iso_method_auto(const iso_model *model)
{
    const iso_method *best = NULL;
    iso_suits most = ISO_NEVER;
    char why[ISO_WHY_SIZE];
    for (int i = 0; iso_methods[i]; i++) {
        const iso_method *method = iso_methods[i];
        const iso_suits suits = method->suits ? method->suits(model) : ISO_NEVER;
        if (suits > most && iso_method_serves(method, model, why)) best = method, most = suits;
    }
    return best;
}

static int digits_of(const iso_method *method)
{
    return method->digits > 0 ? method->digits : ISO_DOUBLE_DIGITS;
}

const iso_method *iso_method_with_more_digits(int digits)
{
    const iso_method *next = NULL;
    for (int i = 0; iso_methods[i]; i++) {
        const int here = digits_of(iso_methods[i]);
        if (here > digits && (!next || here < digits_of(next))) next = iso_methods[i];
    }
    return next;
}

/* The one with the least place above this one. */
static const iso_method *next_witness(int above)
{
    const iso_method *next = NULL;
    for (int i = 0; iso_methods[i]; i++) {
        const int here = iso_methods[i]->witness;
        if (here > above && (!next || here < next->witness)) next = iso_methods[i];
    }
    return next;
}

const iso_method *iso_method_witness(int place)
{
    const iso_method *found = NULL;
    for (int i = 0; i < place && (i == 0 || found); i++) found = next_witness(found ? found->witness : 0);
    return found;
}

const iso_method *iso_method_of_other_kind(const iso_model *model)
{
    return iso_effects_written(&model->problem.effects) && iso_method_auto(model)->own_equations
               ? iso_method_witness(1)
               : NULL;
}

/* --- whether a method can simulate a model ---------------------------------------------------------------------- */

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

static bool splits_well(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    if (!method->splits || !model->problem.energy_formula.magnetic) return true;
    snprintf(why, ISO_WHY_SIZE, "splits into flows of M^2/2 and of a potential, and '%s' is a magnetic field",
             iso_effects_magnetic(&model->problem)->name);
    return false;
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
           splits_well(method, model, why) && has_even_steps(method, model, why);
}

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

const iso_method *iso_method_find(const char *name)
{
    char plain[64] = ""; /* in lower case, with '_' for '-'; a longer name is none */
    const iso_method *candidate = NULL;
    int candidates = 0;
    for (size_t i = 0; name[i] && i < sizeof plain - 1; i++)
        plain[i] = name[i] == '-' ? '_' : (char)tolower((unsigned char)name[i]);
    for (int i = 0; iso_methods[i]; i++) {
        const char *family = iso_methods[i]->family, *own = iso_methods[i]->name, *pattern = plain;
        const size_t length = strlen(family);
        if (strncmp(pattern, family, length) == 0 && pattern[length] == '_') pattern += length + 1;
        if (strcmp(pattern, own) == 0) return iso_methods[i];
        if (*pattern && strncmp(pattern, own, strlen(pattern)) == 0) candidate = iso_methods[i], candidates++;
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

const iso_method *iso_method_with_more_digits(int digits)
{
    const iso_method *next = NULL;
    for (int i = 0; iso_methods[i]; i++) {
        const int here = iso_methods[i]->digits; /* 0, that of doubles, is never more */
        if (here > digits && (!next || here < next->digits)) next = iso_methods[i];
    }
    return next;
}

const iso_method *iso_method_witness(int place)
{
    for (int i = 0; iso_methods[i]; i++) {
        const int own = iso_methods[i]->witness;
        int before = 0;
        for (int j = 0; iso_methods[j]; j++) before += iso_methods[j]->witness > 0 && iso_methods[j]->witness < own;
        if (own > 0 && before + 1 == place) return iso_methods[i];
    }
    return NULL;
}

const iso_method *iso_method_of_other_kind(const iso_model *model)
{
    return iso_effects_written(&model->problem.effects) && iso_method_auto(model)->own_equations
               ? iso_method_witness(1)
               : NULL;
}

bool iso_method_serves(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE])
{
    const iso_problem *f = &model->problem;
    const bool from_formulas = method->implicit || method->own_equations; /* Jacobians and series are made of these */
    const char *needs = method->implicit ? "solves with slopes" : "expands the equations in series";
    const char *too_large = iso_model_too_large(model);
    if (method->system && method->system != model->system)
        snprintf(why, ISO_WHY_SIZE, "is for the %s%s%s", method->system->name, method->system_why ? ": " : "",
                 method->system_why ? method->system_why : "");
    else if (too_large)
        snprintf(why, ISO_WHY_SIZE, "cannot be used: %s", too_large);
    else if (from_formulas && !iso_system_has_recurrences(model->system))
        snprintf(why, ISO_WHY_SIZE, "%s, and there are no recurrences of the %s to make them from", needs,
                 model->system->name);
    else if (from_formulas && model->without_formula)
        snprintf(why, ISO_WHY_SIZE, "%s, and the equations of '%s' are no formula to make them from", needs,
                 model->without_formula->name);
    else if (method->splits && f->energy_formula.magnetic)
        snprintf(why, ISO_WHY_SIZE, "splits into flows of M^2/2 and of a potential, and '%s' is a magnetic field",
                 iso_effects_magnetic(f)->name);
    else if (method->steps_in_s && iso_params_steep(&f->p) && f->p.k != -1)
        /* the potential spans many decades; for k = -1 it is a quadratic form, and spans none */
        snprintf(why, ISO_WHY_SIZE,
                 "has steps that are fixed in s, and for this k one radian of the way may take 1e10 times as long as "
                 "another");
    else
        return true;
    return false;
}

/* method.c - the registry of methods: all of them, one by its name, one that suits a model. */
#include "method/method.h"

#include <ctype.h>
#include <string.h>

#include "base/nearest_impl.h"
#include "method/methods_impl.h"

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

const iso_method *iso_method_at(int i)
{
    return i >= 0 && i < (int)(sizeof iso_methods / sizeof *iso_methods) ? iso_methods[i] : NULL;
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
    return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "method", "there is no method '%s'; %s", name,
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

const iso_method *iso_method_witness(int place)
{
    for (int i = 0; iso_methods[i]; i++)
        if (place > 0 && iso_methods[i]->witness == place) return iso_methods[i];
    return NULL;
}

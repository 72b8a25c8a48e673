#include "method/method.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "method/methods_impl.h"

const iso_method *const iso_methods[] = {
#define ISO_METHOD_ENTRY(name) &iso_method_##name,
    ISO_METHOD_LIST(ISO_METHOD_ENTRY)
#undef ISO_METHOD_ENTRY
        NULL,
};

/* How much of `name` the pattern covers: -1 if they differ, else the number of characters of name left over. */
static int left_over(const char *pattern, const char *name)
{
    for (; *pattern; pattern++, name++) {
        const int c = *pattern == '-' ? '_' : tolower((unsigned char)*pattern);
        if (c != *name) return -1;
    }
    return (int)strlen(name);
}

/* The pattern without a family in front. */
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

/* Taylor series need the least time for every error to within 1.2 times, of the library methods rk8pd: milliseconds for
 * k = -1, 1, 0.5, J = (1.4, 2.1, 3.0), n = (0.36, 0.48, 0.8), omega = (0.9, -0.3, -0.225), t = 1000 (`isoroll cost`):
 *
 *     error      point/taylor         ball/taylor         the best other
 *     1e-6       0.54  1.07  0.52     0.85  0.90  0.63    0.81  1.36  1.01   (blanes_moan6, blanes_moan4, rk8pd)
 *     1e-10      0.69  1.58  0.77     1.56  1.66  1.02    2.82  5.2   2.7    (blanes_moan6, rk8pd, rk8pd)
 *     1e-12      0.78  1.85  0.93     1.88  2.14  1.24    4.2   8.4   4.5    (sofroniou_spaletta10, rk8pd, rk8pd)
 *
 * At 1e-4 and looser splittings are up to 1.5 times cheaper, but do not keep to their tolerance. Of the methods for stiff
 * models bsimp is the most exact for its time up to VERY_STIFF, from where on bdf needs fewer right-hand sides. */
enum { VERY_STIFF = 1000 };

const iso_method *iso_method_auto(const iso_model *model)
{
    const double stiffness = iso_effects_stiffness(&model->field);
    if (stiffness > VERY_STIFF) return &iso_method_bdf;
    if (stiffness > ISO_STIFF) return &iso_method_bsimp;
    const bool suits_series = model->system != &iso_system_point || !iso_params_steep(&model->field.p);
    return suits_series ? &iso_method_taylor : &iso_method_rk8pd;
}

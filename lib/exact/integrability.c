/* integrability.c - integrable, no meromorphic integral, or open; see integrability_impl.h. */
#include "exact/integrability_impl.h"

#include <float.h>
#include <math.h>

#include "base/names_impl.h"
#include "model/model_impl.h"

ISO_NAMES(iso_integrability_name, iso_integrability_kind, "integrable", "no meromorphic integral", "open")

/* Of the point: rows with a condition are second integrals, the energy has none. */
static bool has_second(const iso_problem *f)
{
    enum { MOST = 32 };
    const iso_integral *row[MOST];
    const int count = iso_integrals_holding(&iso_system_point, f, row, MOST);
    bool found = false;
    for (int i = 0; i < count; i++) found = found || (row[i]->holds && !row[i]->claimed);
    return found && !iso_effects_breaking(&f->effects);
}

iso_integrability iso_integrability_of(const iso_params *p, const iso_effects *effects, bool off_level)
{
    const iso_problem f = {.p = *p, .effects = iso_effects_acting(effects)};
    if (has_second(&f)) return (iso_integrability){ISO_SECOND_INTEGRAL, "a second integral is known"};
    if (iso_effects_beyond_level(&f.effects))
        return (iso_integrability){ISO_INTEGRABILITY_OPEN, "the theorem is about the free ball: here an effect acts"};
    if (off_level || iso_effects_have_level(&f.effects))
        return (iso_integrability){ISO_INTEGRABILITY_OPEN,
                                   "the theorem is about the level H = 0; `isoroll splitting` measures other levels"};
    const double near = 2 * floor(0.5 / p->k) + 1; /* the odd integer that 1/k is, up to rounding; odd = 0: none */
    const double odd = fabs(1 / p->k - near) <= 4 * DBL_EPSILON * fabs(near) ? fabs(near) : 0;
    if (odd == 1)
        return (iso_integrability){ISO_INTEGRABILITY_OPEN,
                                   "k is so near to 1 or -1 that the difference may be rounding"};
    if (odd > ISO_ODD_DONE)
        return (iso_integrability){ISO_INTEGRABILITY_OPEN,
                                   "1/k is an odd integer above 21 or below -21, which the theorem does not "
                                   "cover; see `isoroll prove`"};
    if (odd > 0)
        return (iso_integrability){ISO_NO_INTEGRAL, "three different moments, 1/k an odd integer, not 1 or -1: a "
                                                    "theorem of ours, by the third variation, not reviewed"};
    return (iso_integrability){ISO_NO_INTEGRAL,
                               "three different moments, 1/k no odd integer: a theorem of ours, by the "
                               "first variation, not reviewed"};
}

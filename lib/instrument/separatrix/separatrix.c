/* separatrix.c - the splitting at one k on one level: x* and m, with errors. */
#define _GNU_SOURCE /* functions of _Float128 */
#include "instrument/separatrix/separatrix.h"

#include <math.h>
#include <stdio.h>

#include "base/arithmetic_impl.h"
#include "base/names_impl.h"
#include "instrument/separatrix/separatrix_impl.h"

ISO_NAMES(iso_separatrix_digits_name, int, "double", "quad", "auto")

/* --- one computation -------------------------------------------------------------------------------------------- */

/* From the section n_g = 0 on which the manifold was computed to n_a = 0, on which O has l = 0. At the crossing
 * gamma lies on the middle axis, so it is on both: x_a^2 + x_g^2 = 1. A change of x leaves |M|, so x_a dx_a = -x_g
 * dx_g; along the flow a shift of gamma_a = dl_g becomes one of gamma_g, by gamma_a'/gamma_g' = -M_g/M_a, dl_a =
 * -dl_g |x_a/x_g|:
 *
 *     m_a = (x_g/x_a)^2 m_g
 *
 * What rounding does (floor): each half return makes an error of some units in the last place, which is carried on by
 * the derivative. Across the manifold it dies out like lambda^-i, i half returns later; such errors add up to sqrt(sum
 * lambda^(-2 i)) of one.
 */
static void fill(const iso_manifold *m, const iso_manifold_crossing *c, const iso_manifold_crossing *again,
                 int digits, iso_separatrix_splitting *s)
{
    const double lambda = (double)m->lambda, sum = sqrt(1 / (1 - 1 / (lambda * lambda))),
                 floor = 10 * m->code->error * (1 + fabs((double)c->slope)) * (1 + sum + log(lambda)),
                 apart[2] = {fabs((double)(c->z[1] - again->z[1])), fabs((double)(c->slope - again->slope))};
    double of[2];
    for (int i = 0; i < 2; i++) of[i] = 3 * fmax(apart[i], fmax(c->scatter[i], again->scatter[i])) + floor;
    const double of_x = of[0], of_m = of[1];
    const iso_wide x = c->z[1], root = WIDE_ROOT((1 - x) * (1 + x)), ratio = x / root;
    const bool same = s->axis == m->axis;
    const iso_fine fine_x = iso_fine_of(same    ? x
                                        : x < 0 ? root
                                                : -root),
                   fine_slope = iso_fine_of(same ? c->slope : c->slope * ratio * ratio);
    const double r = fabs((double)ratio);
    s->section_x = (double)x, s->section_m = (double)c->slope;
    s->lambda = (double)(m->lambda * m->lambda);
    s->x = fine_x.head, s->x_tail = fine_x.tail;
    s->m = fine_slope.head, s->m_tail = fine_slope.tail;
    s->error = same ? of_m : r * r * of_m + 2 * r * (1 + r * r) / (double)root * fabs(s->section_m) * of_x;
    s->x_error = same ? of_x : r * of_x + m->code->error;
    s->digits = digits;
    s->from_zero = fabs(s->m) > 100 * s->error;
}

/* The crossing, and the same by another polynomial, of so many terms, on 3/4 of the domain. digits: of the numbers. */
static iso_status compute(iso_manifold *m, int terms, int digits, iso_manifold_crossing *c,
                          iso_separatrix_splitting *s)
{
    ISO_TRY(iso_manifold_refine(m, c));
    iso_manifold other = *m;
    iso_manifold_crossing again = *c;
    iso_manifold_resize(&other, m->size * 3 / 4, terms);
    ISO_TRY(iso_manifold_solve(&other));
    again.theta *= m->size / other.size;
    while (again.theta > 1) again.theta /= m->lambda, again.halves++;
    ISO_TRY(iso_manifold_refine(&other, &again));
    fill(m, c, &again, digits, s);
    return ISO_OK;
}

/* --- one k ------------------------------------------------------------------------------------------------------ */

static void begin(double k, double level, iso_separatrix_splitting *s)
{
    *s = (iso_separatrix_splitting){.k = k, .level = level};
    s->lambda = s->x = s->m = s->section_x = s->section_m = s->error = s->x_error = s->next_l = s->next_x =
        s->next_m = NAN;
}

/* With 128 bits, where they are asked for or needed. If they fail where only needed, what 64 bits found stays. */
static iso_status find_finer(iso_manifold *m, iso_manifold_crossing *c, iso_separatrix_digits digits,
                             iso_separatrix_splitting *s)
{
    const bool unclear = !(fabs(s->m) >= 1000 * s->error);
    const iso_manifold kept = *m;
    const iso_manifold_crossing found = *c;
    if (digits == ISO_SEPARATRIX_DOUBLE || (digits == ISO_SEPARATRIX_AUTO && !(unclear && iso_return_build_of(true))))
        return ISO_OK;
    iso_status status = iso_manifold_use(m, iso_return_build_of(true));
    m->terms = 21;
    if (status == ISO_OK) status = iso_manifold_solve(m);
    if (status == ISO_OK) status = compute(m, 18, 32, c, s);
    if (status != ISO_NUMERICAL || digits == ISO_SEPARATRIX_QUAD) return status;
    snprintf(s->text, sizeof s->text, "128 bits failed: %s", iso_context_message(m->ctx));
    *m = kept;
    *c = found;
    return ISO_OK;
}

static iso_status find(iso_context *ctx, const double J[3], iso_separatrix_digits digits, bool next,
                       iso_separatrix_splitting *s)
{
    iso_manifold m;
    iso_manifold_crossing c, n;
    if (digits == ISO_SEPARATRIX_QUAD && !iso_return_build_of(true))
        return ISO_FAIL_ARGUMENT(ctx, "digits", "splitting: this build has no numbers of 128 bits");
    ISO_TRY(iso_manifold_find(ctx, s->k, J, s->level, &m));
    s->section = m.axis;
    s->middle = m.corner == 0 ? (m.axis + 2) % 3 : (m.axis + 1) % 3;
    s->axis = (s->middle + 1) % 3;
    ISO_TRY(iso_manifold_first(&m, &c));
    ISO_TRY(compute(&m, 10, 19, &c, s));
    ISO_TRY(find_finer(&m, &c, digits, s));
    const iso_status status = next ? iso_manifold_next(&m, &c, &n) : ISO_NUMERICAL;
    if (status != ISO_OK) return status == ISO_NUMERICAL ? ISO_OK : status;
    s->next_l = (double)iso_wide_turned(n.z[0] + m.corner);
    s->next_x = (double)n.z[1];
    s->next_m = (double)n.slope;
    return ISO_OK;
}

iso_status iso_separatrix_next_at(iso_context *ctx, double k, const double J[3], double level,
                                  iso_separatrix_digits digits, bool next, iso_separatrix_splitting *s)
{
    ISO_DEFAULT_ARITHMETIC;
    begin(k, level, s);
    const iso_status status = find(ctx, J, digits, next, s);
    if (status == ISO_OK) return ISO_OK;
    begin(k, level, s);
    s->status = status;
    snprintf(s->text, sizeof s->text, "%s", iso_context_message(ctx));
    return status;
}

iso_status iso_separatrix_at(iso_context *ctx, double k, const double J[3], double level,
                             iso_separatrix_digits digits, iso_separatrix_splitting *s)
{
    return iso_separatrix_next_at(ctx, k, J, level, digits, false, s);
}

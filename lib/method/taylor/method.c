/* method.c - Taylor series of the equations themselves: the method, on the code for this processor.
 *
 * Each step expands the solution about its left end to a high order by the recurrences of model/series, and
 * goes as far as the last terms allow: few long steps, about as many as half turns of the ball. A free point is
 * expanded in the form that needs fewest products (lib/doc/theory.md, section 6): in s for k = -1, where it is
 * polynomial, in the ball's own time for other k, where the powers of q cancel. Other clocks are integrals of a power
 * of q over the step. What stands between the steps is the series itself. Constraints, energy and, for k = 1 and -1,
 * the second integral are restored from defects computed exactly, so that their rounding has no bias.
 *
 * There is one source for all kinds of numbers, and variant.c compiles it for each. It has numbers, products and
 * recurrences (model/series), integrals of clocks (quadrature), what a model is expanded as (form), steps (step),
 * what is restored (restore); and around them one orbit (single), or many side by side (crew, for batches).
 */
#include "method/methods_impl.h"
#include "method/taylor/code_impl.h"
#include "model/model_impl.h"

iso_status iso_taylor_create(iso_integrator *it)
{
    it->method = &iso_taylor_plain;
#ifdef ISO_TAYLOR_X86
    if (iso_taylor_has_avx2()) it->method = &iso_taylor_avx2;
#endif
    return it->method->create(it);
}

/* Series need the least time for every error, to within 1.2 times; of the other methods rk8pd does. Milliseconds for
 * k = -1, 1, 0.5, J = (1.4, 2.1, 3.0), n = (0.36, 0.48, 0.8), omega = (0.9, -0.3, -0.225), t = 1000 (`isoroll cost`):
 *
 *     error      point/taylor         ball/taylor         the best other
 *     1e-6       0.54  1.07  0.52     0.85  0.90  0.63    0.81  1.36  1.01   (blanes_moan6, blanes_moan4, rk8pd)
 *     1e-10      0.69  1.58  0.77     1.56  1.66  1.02    2.82  5.2   2.7    (blanes_moan6, rk8pd, rk8pd)
 *     1e-12      0.78  1.85  0.93     1.88  2.14  1.24    4.2   8.4   4.5    (sofroniou_spaletta10, rk8pd, rk8pd)
 *
 * At 1e-4 and looser, splittings are up to 1.5 times cheaper, but do not keep to their tolerance. Series do not suit
 * stiff models, nor powers of q in (24) that span many decades. */
iso_suits iso_taylor_suits(const iso_model *m)
{
    const bool steep = m->system == &iso_system_point && iso_params_steep(&m->problem.p);
    return steep || iso_effects_stiffness(&m->problem) > ISO_STIFF ? ISO_IF_NEED_BE : ISO_BEST;
}

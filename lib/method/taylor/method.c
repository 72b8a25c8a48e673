/* method.c - Taylor series of the equations themselves: the method, on the code for this processor.
 *
 * Each step expands the solution about its left end to a high order by the recurrences of model/series, and
 * goes as far as the last terms allow: few long steps, about as many as half turns of the ball. A free point is
 * expanded in the form that needs fewest products (section 5b of the theory): in s for k = -1, where it is
 * polynomial, in the ball's own time for other k, where the powers of q cancel. Other clocks are integrals of a power
 * of q over the step. What stands between the steps is the series itself. Constraints, energy and, for k = 1 and -1,
 * the second integral are restored from defects computed exactly, so that their rounding has no bias.
 *
 * The source is one: numbers, products and recurrences (model/series), integrals of clocks (quadrature), what a model is
 * expanded as (form), steps (step), what is restored (restore); around them one orbit (single), or many side by side
 * (crew, for batches). variant.c compiles it for each kind of number.
 */
#include <stdlib.h>

#include "method/methods_impl.h"
#include "method/taylor/code_impl.h"

static const iso_taylor_code *code_of(const iso_integrator *it)
{
    return *(const iso_taylor_code *const *)it->data;
}

static iso_status create_with(iso_integrator *it, const iso_taylor_code *code)
{
    const iso_status status = code->create(it);
    if (status == ISO_OK) *(const iso_taylor_code **)it->data = code;
    return status;
}

static iso_status create(iso_integrator *it)
{
    #ifdef ISO_TAYLOR_X86
    if (iso_taylor_has_avx2()) return create_with(it, &iso_taylor_avx2);
#endif
    return create_with(it, &iso_taylor_plain);
}

static iso_status create_extended(iso_integrator *it)
{
    return create_with(it, &iso_taylor_extended);
}

#ifdef ISO_TAYLOR_HAS_QUAD
static iso_status create_quad(iso_integrator *it)
{
    return create_with(it, &iso_taylor_quad);
}
#endif

static iso_status start(iso_integrator *it)
{
    return code_of(it)->start(it);
}

static iso_status step(iso_integrator *it, double y[], double *h)
{
    return code_of(it)->step(it, y, h);
}

static iso_status within(iso_integrator *it, double dt, double y[])
{
    return code_of(it)->within(it, dt, y);
}

static void release(iso_integrator *it)
{
    free(it->data);
}

#define TAYLOR                                                                                                       \
    .family = "isoroll", .own_equations = true, .projects = true, .fixed = true, .start = start, .step = step,       \
    .within = within, .free = release

const iso_method iso_method_taylor = {.name = "taylor",
                                      .doc = "Taylor series by recurrences, order 6-28 from the tolerance",
                                      .create = create,
                                      TAYLOR};
const iso_method iso_method_taylor_extended = {.name = "taylor_extended",
                                               .doc = "the same in long double, a reference for the others",
                                               .create = create_extended,
                                               TAYLOR};
#ifdef ISO_TAYLOR_HAS_QUAD
const iso_method iso_method_taylor_quad = {.name = "taylor_quad",
                                           .doc = "the same in numbers of 128 bits, slow",
                                           .reference = true,
                                           .create = create_quad,
                                           TAYLOR};
#endif

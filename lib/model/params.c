/* params.c - the numbers of a ball: checks them, and computes k, J and the ball's own units from them (params.h). */
#include "model/model_impl.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"

const iso_dimension iso_dimension_h = {1, 0, 2}, iso_dimension_eps = {4, 0, 2};

ISO_NAMES(iso_surface_name, int, "reduced", "plane", "outside", "inside", "shell")

static bool is_positive(double x)
{
    return isnormal(x) && x > 0;
}

/* The derived numbers; J already checked. */
static void fill(double k, const double J[3], iso_params *p)
{
    p->k = k;
    for (int i = 0; i < 3; i++) {
        p->J[i] = J[i];
        p->inv_J[i] = 1 / J[i];
        p->root_J[i] = sqrt(J[i]);
    }
    p->det_J = J[0] * J[1] * J[2];
}

iso_status iso_params_reduced(iso_context *ctx, double k, const double J[3], iso_params *p)
{
    ISO_DEFAULT_ARITHMETIC;
    if (!isfinite(k) || !isnormal(k))
        return ISO_FAIL_INPUT(ctx, "k",
                              "k = %s: the geometry number must be finite and not 0 (at k = 0 the normal does not "
                              "move and the isomorphism does not exist)",
                              ISO_SHORT(k));
    for (int i = 0; i < 3; i++)
        if (!is_positive(J[i]))
            return ISO_FAIL_INPUT(ctx, "J", "J%d = %s: moments of inertia must be positive and finite", i + 1,
                                  ISO_SHORT(J[i]));
    memset(p, 0, sizeof *p);
    p->body.surface = ISO_REDUCED;
    fill(k, J, p);
    return ISO_OK;
}

iso_status iso_params_set_D(iso_context *ctx, double D, iso_params *p)
{
    ISO_DEFAULT_ARITHMETIC;
    if (!(is_positive(D) && D < min3(p->J)))
        return ISO_FAIL_INPUT(
            ctx, "D", "D = %s: m b^2 must be positive and less than each J (J - D are the moments about the centre)",
            ISO_SHORT(D));
    p->D = D;
    return ISO_OK;
}

static iso_status check_radii(iso_context *ctx, const iso_body *b)
{
    const double A = b->surface_radius, B = b->radius;
    if (b->surface == ISO_PLANE) return ISO_OK;
    if (!is_positive(A))
        return ISO_FAIL_INPUT(ctx, "surface_radius",
                              "surface radius %s: must be positive and finite (a plane is 'kind: plane')",
                              ISO_SHORT(A));
    if (b->surface == ISO_INSIDE && !(B < A))
        return ISO_FAIL_INPUT(ctx, "surface_radius",
                              "a ball of radius %s does not roll inside a sphere of radius %s: give a larger "
                              "surface radius, or 'kind: shell' for a hollow ball around a smaller sphere",
                              ISO_SHORT(B), ISO_SHORT(A));
    if (b->surface == ISO_SHELL && !(B > A))
        return ISO_FAIL_INPUT(ctx, "surface_radius",
                              "a shell of radius %s does not go around a sphere of radius %s: give a smaller "
                              "surface radius, or 'kind: inside' for a ball in a larger sphere",
                              ISO_SHORT(B), ISO_SHORT(A));
    return ISO_OK;
}

iso_status iso_params_physical(iso_context *ctx, const iso_body *b, iso_params *p)
{
    ISO_DEFAULT_ARITHMETIC;
    const double *I = b->inertia;
    if (!is_positive(b->mass))
        return ISO_FAIL_INPUT(ctx, "mass", "mass %s: must be positive and finite", ISO_SHORT(b->mass));
    if (!is_positive(b->radius))
        return ISO_FAIL_INPUT(ctx, "radius", "radius %s: must be positive and finite", ISO_SHORT(b->radius));
    for (int i = 0; i < 3; i++)
        if (!is_positive(I[i]))
            return ISO_FAIL_INPUT(ctx, "inertia", "inertia %d is %s: principal moments must be positive and finite",
                                  i + 1, ISO_SHORT(I[i]));
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        /* the sum of two numbers typed in decimal may miss the third by their rounding: a flat body is allowed */
        if (I[i] > (I[j] + I[l]) * (1 + 8 * DBL_EPSILON))
            return ISO_FAIL_INPUT(ctx, "inertia",
                                  "no solid body has these moments: I%d = %s exceeds I%d + I%d = %s (triangle "
                                  "inequality); for k and J without a body use 'reduced:'",
                                  i + 1, ISO_SHORT(I[i]), j + 1, l + 1, ISO_SHORT(I[j] + I[l]));
    }
    ISO_TRY(check_radii(ctx, b));
    double J[3];
    const double A = b->surface_radius, B = b->radius, D = b->mass * B * B;
    for (int i = 0; i < 3; i++) J[i] = I[i] + D;
    /* a/(a+b) from the true radii: nothing cancels but the radii themselves */
    const double k = b->surface == ISO_PLANE ? 1 : A / (b->surface == ISO_OUTSIDE ? A + B : A - B);
    if (!isnormal(k))
        return ISO_FAIL_INPUT(ctx, "surface_radius", "radii %s and %s give no geometry number k", ISO_SHORT(A),
                              ISO_SHORT(B));
    if (!is_positive(max3(J))) return ISO_FAIL_INPUT(ctx, "mass", "m B^2 does not fit a double: use other units");
    memset(p, 0, sizeof *p);
    p->body = *b;
    p->D = D;
    fill(k, J, p);
    return ISO_OK;
}

double iso_coupling(const iso_params *p, double h)
{
    return h * p->det_J / (p->k * p->k);
}

double iso_energy(const iso_params *p, double eps)
{
    return eps / p->det_J * (p->k * p->k);
}

int iso_params_sign_of_radius(const iso_params *p)
{
    return p->k > 1 || p->k < 0 ? -1 : 1;
}

void iso_units_choose(const iso_params *p, double speed, iso_units *u)
{
    const double mean_log2 = (log2(p->J[0]) + log2(p->J[1]) + log2(p->J[2])) / 3;
    double J[3];
    u->J = ldexp(1, (int)lrint(fmin(mean_log2, DBL_MAX_EXP - 1)));
    u->w = speed > 0 ? ldexp(1, (int)fmax(-1021, fmin(ilogb(speed), 1021))) : 1; /* so that 1/w is a normal double */
    for (int i = 0; i < 3; i++) J[i] = p->J[i] / u->J;
    u->own = *p;
    u->own.D = p->D / u->J;
    fill(p->k, J, &u->own);
}

/* unit_J^(J_2k/(2k)) alone may leave the range of doubles where the whole product does not: its exponent of two is
 * split into a whole part, added to the others, and a fraction. */
double iso_unit(const iso_units *u, iso_dimension d)
{
    const double exponent = d.J_2k == 0 ? 0 : d.J_2k / (2 * u->own.k), log2_J = ilogb(u->J);
    const double power = exponent * log2_J, lost = fma(exponent, log2_J, -power);
    const double whole = fmax(-1e6, fmin(1e6, floor(power))); /* far out of range, and still an int */
    const double fraction = whole == floor(power) ? exp2((power - whole) + lost) : 1;
    return ldexp(fraction, (int)whole + d.J * ilogb(u->J) + d.w * ilogb(u->w));
}

bool iso_params_powers_fit(const iso_params *p)
{
    return log(max3(p->J) / min3(p->J)) / fabs(p->k) < 650;
}

iso_status iso_params_check_powers(iso_context *ctx, const iso_params *p)
{
    if (iso_params_powers_fit(p)) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "k",
                          "k = %s is too near 0 for these moments: (max J/min J)^(1/|k|) does not fit a double",
                          ISO_SHORT(p->k));
}

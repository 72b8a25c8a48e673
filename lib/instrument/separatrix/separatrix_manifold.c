/* separatrix_manifold.c - the unstable manifold of the middle axis' rotation near its fixed point, as a polynomial.
 *
 * With P(y) = sum c_i T*_i(y) the equation g(W(theta/lambda)) = W(theta) is solved at nodes y_j by Newton's method:
 *
 *     dP(y_j) - lambda^-3 A_j dP(y_j/lambda^2) = [g(W(theta_j/lambda)) - W(theta_j)]/(theta_j y_j)
 *
 * A_j: the derivative of g. As |A_j| ~ lambda, the left side is about the unit matrix. v is fixed, or else theta
 * could be stretched. */
#define _GNU_SOURCE /* functions of _Float128 */
#include <math.h>
#include <string.h>

#include "base/context_impl.h"
#include "base/math_impl.h"
#include "base/number_impl.h"
#include "instrument/separatrix/separatrix_impl.h"
#include "map/section.h"
#include "map/section_impl.h"
#include "method/taylor/lanes_impl.h"
#include "orbit/crossings_impl.h"
#include "study/study_impl.h"

/* --- the map ---------------------------------------------------------------------------------------------------- */

/* g at z, and the derivative. u of the image is in (-pi, pi]. */
static iso_status map_half(const iso_manifold *m, const iso_wide z[2], iso_wide image[2], iso_wide A[2][2])
{
    iso_return r = {.from = {iso_fine_of(iso_wide_turned(m->corner + z[0])), iso_fine_of(z[1])},
                    .start = ISO_FROM_BELOW};
    if (!iso_context_goes_on(m->ctx)) return iso_context_stopped(m->ctx);
    bool good = WIDE_ABS(z[1]) < 1 && m->code->go(&m->model, m->axis, m->zeros, m->tolerance, &r);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) A[i][j] = iso_wide_of(r.slope[i][j]);
    image[0] = iso_wide_turned(iso_wide_of(r.to[0]) - m->corner);
    image[1] = iso_wide_of(r.to[1]);
    good = good && image[0] - image[0] == 0 && image[1] - image[1] == 0;
    return good ? ISO_OK : iso_manifold_lost(m, "a return could not be computed");
}

/* lambda and v from the derivative at the fixed point, whose determinant is 1. Terms of the series are kept to a
 * hundredth of a rounding error. lambda must be 1.01 or more, that of a whole return 1.02: with smaller ones the
 * crossing is very many half returns away. m is estimated at exp(-2 pi^2/ln lambda^2), which is 2e-429 at this bound:
 * 1e-427 or less. No bound of m is computed then, so none is stated. */
iso_status iso_manifold_use(iso_manifold *m, const iso_return_build *code)
{
    const iso_wide origin[2] = {0, 0};
    iso_wide image[2], A[2][2];
    m->code = code;
    m->tolerance = code == &iso_return_extended ? 1e-15 : 1e-17;
    ISO_TRY(map_half(m, origin, image, A));
    const iso_wide trace = A[0][0] + A[1][1];
    const double apart = (double)trace - 2; /* (lambda - 1)^2/lambda */
    if (!(apart > 1e-4)) {
        const double exponent = 2 * sqrt(fmax(apart, 1e-15)); /* ln lambda^2 */
        return ISO_FAIL_INPUT(m->ctx, "J",
                              "splitting at k = %s: the middle axis has the multiplier 1 + %.1e, too near 1: m is "
                              "about exp(-2 pi^2/ln of it) = 1e-%.0f or less, which 128 bits do not tell from 0",
                              ISO_SHORT(m->problem.p.k), expm1(exponent), 2 * ISO_PI * ISO_PI / exponent / log(10));
    }
    m->lambda = (trace + WIDE_ROOT((trace - 2) * (trace + 2))) / 2;
    m->v[0] = A[0][1];
    m->v[1] = m->lambda - A[0][0];
    const iso_wide length = WIDE_ROOT(m->v[0] * m->v[0] + m->v[1] * m->v[1]) * (m->v[0] < 0 ? -1 : 1);
    for (int i = 0; i < 2; i++) m->v[i] /= length;
    return ISO_OK;
}

/* --- preparing -------------------------------------------------------------------------------------------------- */

static iso_status open_manifold(iso_context *ctx, double k, const double J[3], double level, iso_manifold *m)
{
    memset(m, 0, sizeof *m);
    m->ctx = ctx;
    m->level = level;
    int exponent;
    const double top = fmax(J[0], fmax(J[1], J[2]));
    frexp(isfinite(top) && top > 0 ? top : 1, &exponent);
    const double scaled[3] = {ldexp(J[0], 1 - exponent), ldexp(J[1], 1 - exponent), ldexp(J[2], 1 - exponent)};
    ISO_TRY(iso_params_reduced(ctx, k, scaled, &m->problem.p));
    ISO_TRY(iso_refuse_equal_moments(ctx, J, ISO_NO_SPLITTING));
    const iso_params *p = &m->problem.p;
    if (!(fabs(k) >= 0.05 && fabs(k) <= 50))
        return ISO_FAIL_INPUT(ctx, "k", "k = %s: " ISO_SPLITTING_IS " only for 0.05 <= |k| <= 50", ISO_SHORT(k));
    if (!isfinite(level)) return ISO_FAIL_INPUT(ctx, "level", "%s is no level", ISO_SHORT(level));
    m->problem.eps = 1;
    m->problem.energy = iso_level_energy(p, level);
    const iso_point_motion motion = {p, 1, m->problem.energy};
    m->axis = iso_section_axis(motion);
    const double lowest = iso_level_of(p, -pow(p->J[m->axis], -1 / k)); /* here the middle axis' circle closes */
    if (!(level > lowest))
        return ISO_FAIL_INPUT(ctx, "level",
                              "splitting at k = %s, level %s: the middle axis has no rotation, but an oscillation "
                              "between two places of rest: it has no separatrix. Give a level above %.12g",
                              ISO_SHORT(k), ISO_SHORT(level), lowest);
    const int b = (m->axis + 1) % 3, c = (m->axis + 2) % 3;
    const bool at_zero = k > 0 ? p->J[c] > p->J[b] : p->J[c] < p->J[b]; /* c is the middle axis */
    m->corner = at_zero ? 0 : WIDE_PI / 2;
    const bool none[ISO_CLOCKS] = {false};
    m->model = iso_model_assemble(&iso_system_point, &m->problem, ISO_CLOCK_T, none);
    m->zeros = iso_crossings_zeros(motion, m->axis, iso_lane_clock(&m->model));
    return iso_manifold_use(m, &iso_return_extended);
}

/* --- the polynomial --------------------------------------------------------------------------------------------- */

/* T*_i(y) and its derivative */
static void polynomials(iso_wide y, int count, iso_wide T[], iso_wide dT[])
{
    const iso_wide x = 2 * y - 1;
    T[0] = 1, dT[0] = 0;
    if (count > 1) T[1] = x, dT[1] = 2;
    for (int i = 2; i < count; i++) {
        T[i] = 2 * x * T[i - 1] - T[i - 2];
        dT[i] = 4 * T[i - 1] + 2 * x * dT[i - 1] - dT[i - 2];
    }
}

static void polynomial_at(const iso_manifold *m, iso_wide theta, iso_manifold_point *p)
{
    iso_wide T[ISO_MANIFOLD_TERMS], dT[ISO_MANIFOLD_TERMS];
    const iso_wide y = theta * theta;
    polynomials(y, m->terms, T, dT);
    p->theta = theta;
    for (int d = 0; d < 2; d++) {
        iso_wide P = 0, dP = 0;
        for (int i = m->terms - 1; i >= 0; i--) P += m->c[d][i] * T[i], dP += m->c[d][i] * dT[i];
        p->z[d] = theta * (m->v[d] * m->size + y * P);
        p->t[d] = m->v[d] * m->size + 3 * y * P + 2 * y * y * dP;
    }
}

void iso_manifold_resize(iso_manifold *m, iso_wide size, int terms)
{
    memset(m->c, 0, sizeof m->c);
    m->size = size;
    m->terms = terms;
}

enum { UNKNOWNS = 2 * ISO_MANIFOLD_TERMS };
typedef struct linear {
    int n;
    iso_wide a[UNKNOWNS][UNKNOWNS], b[UNKNOWNS];
} linear;

/* Gauss, with the largest pivot of a column. */
static void eliminate(linear *L)
{
    for (int i = 0; i < L->n; i++) {
        int pivot = i;
        for (int j = i + 1; j < L->n; j++)
            if (WIDE_ABS(L->a[j][i]) > WIDE_ABS(L->a[pivot][i])) pivot = j;
        for (int c = i; c < L->n; c++) {
            const iso_wide kept = L->a[i][c];
            L->a[i][c] = L->a[pivot][c], L->a[pivot][c] = kept;
        }
        const iso_wide kept = L->b[i];
        L->b[i] = L->b[pivot], L->b[pivot] = kept;
        for (int j = i + 1; j < L->n; j++) {
            const iso_wide factor = L->a[j][i] / L->a[i][i];
            for (int c = i; c < L->n; c++) L->a[j][c] -= factor * L->a[i][c];
            L->b[j] -= factor * L->b[i];
        }
    }
    for (int i = L->n - 1; i >= 0; i--) {
        for (int c = i + 1; c < L->n; c++) L->b[i] -= L->a[i][c] * L->b[c];
        L->b[i] /= L->a[i][i];
    }
}

/* Node j: Chebyshev's, over y from FIRST to 1. Nodes next to 0 would magnify rounding errors by 1/(theta y). */
static iso_wide node(int j, int count)
{
    const double first = 0.02;
    return (iso_wide)(first + (1 - first) * (1 + cos((j + 0.5) * ISO_PI / count)) / 2);
}

/* The two rows of node j. */
static iso_status set_rows(const iso_manifold *m, int j, linear *L)
{
    const int n = m->terms;
    const iso_wide y = node(j, n), theta = WIDE_ROOT(y), inner = y / (m->lambda * m->lambda),
                   factor = 1 / (m->lambda * m->lambda * m->lambda);
    iso_wide T[ISO_MANIFOLD_TERMS], Ti[ISO_MANIFOLD_TERMS], unused[ISO_MANIFOLD_TERMS], image[2], A[2][2];
    iso_manifold_point from, to;
    polynomials(y, n, T, unused);
    polynomials(inner, n, Ti, unused);
    polynomial_at(m, theta / m->lambda, &from);
    polynomial_at(m, theta, &to);
    const iso_status status = map_half(m, from.z, image, A);
    for (int d = 0; d < 2 && status == ISO_OK; d++) {
        const int row = 2 * j + d;
        L->b[row] = (image[d] - to.z[d]) / (theta * y);
        for (int e = 0; e < 2; e++)
            for (int i = 0; i < n; i++) L->a[row][e * n + i] = (d == e ? T[i] : 0) - factor * A[d][e] * Ti[i];
    }
    return status;
}

/* Newton's method, until the largest change of a coefficient is small by the domain. m->rate: how fast the coefficients
 * fall, from the first ones: the last may be rounding errors, which do not fall. */
iso_status iso_manifold_solve(iso_manifold *m)
{
    linear L = {.n = 2 * m->terms};
    double change = 1, of[ISO_MANIFOLD_TERMS];
    const double near = sqrt(m->code->error) / 100;
    for (int steps = 0; steps < 12; steps++) {
        iso_wide most = 0;
        for (int j = 0; j < m->terms; j++) ISO_TRY(set_rows(m, j, &L));
        eliminate(&L);
        for (int i = 0; i < L.n; i++) {
            const iso_wide size = WIDE_ABS(L.b[i]);
            m->c[i / m->terms][i % m->terms] += L.b[i];
            if (!(size <= most)) most = size;
        }
        change = (double)(most / m->size);
        if (change < near || !(change < 1e3)) break;
    }
    int last = 1;
    for (int i = 0; i < m->terms; i++) of[i] = hypot((double)m->c[0][i], (double)m->c[1][i]);
    while (last + 1 < m->terms && of[last + 1] < of[last] / 3 && of[last + 1] > 1e-13 * (double)m->size) last++;
    m->rate = pow(of[last] / of[0], 1.0 / last);
    return change < near ? ISO_OK : iso_manifold_lost(m, "the series of the manifold was not found");
}

/* --- farther out ------------------------------------------------------------------------------------------------ */

iso_status iso_manifold_go_on(const iso_manifold *m, iso_manifold_point *p)
{
    iso_wide image[2], A[2][2];
    ISO_TRY(map_half(m, p->z, image, A));
    const iso_wide t[2] = {A[0][0] * p->t[0] + A[0][1] * p->t[1], A[1][0] * p->t[0] + A[1][1] * p->t[1]};
    for (int i = 0; i < 2; i++) p->z[i] = image[i], p->t[i] = t[i];
    return ISO_OK;
}

iso_status iso_manifold_at(const iso_manifold *m, iso_wide theta, int halves, iso_manifold_point *p)
{
    polynomial_at(m, theta, p);
    for (int i = 0; i < halves; i++) ISO_TRY(iso_manifold_go_on(m, p));
    return ISO_OK;
}

/* Coefficients fall like rate^i with rate ~ size^2. So the domain is made so large that the last one, of 12, is at
 * the rounding errors of 64 bits; of 21, of 106 bits. */
iso_status iso_manifold_find(iso_context *ctx, double k, const double J[3], double level, iso_manifold *m)
{
    const double wanted = 0.01;
    iso_wide size = (iso_wide)0.1;
    ISO_TRY(open_manifold(ctx, k, J, level, m));
    for (int i = 0; i < 8; i++) {
        iso_manifold_resize(m, size, ISO_MANIFOLD_TERMS_64);
        const iso_status status = iso_manifold_solve(m);
        if (status == ISO_STOPPED || status == ISO_NO_MEMORY) return status;
        const double change = status == ISO_OK ? sqrt(wanted / fmax(m->rate, wanted / 100)) : 0.3;
        if (status == ISO_OK && change > 0.85 && change < 1.3) return ISO_OK;
        size *= (iso_wide)fmax(change, 0.1);
    }
    return iso_manifold_lost(m, "no domain was found on which the series of the manifold converges");
}

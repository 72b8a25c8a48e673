/* arb_manifold.c - O, and its unstable manifold near it (arb_manifold_impl.h).
 *
 * P is half a return followed by the antipode, P(O) = O, det DP(O) = 1. In the frame (xi, eta) the derivative on the
 * square |xi|, |eta| <= size lies in [[a, b], [c, d]]. If there is alpha <= 1 with
 *
 *     a - |b| alpha > 1,     |c| + |d| alpha < alpha (a - |b| alpha),
 *
 * then P maps each curve eta(xi) of slope at most alpha through O to such a curve, which is longer by a factor
 * a - |b| alpha, until it leaves the square. The unstable manifold begins in O as such a curve, since the eigenvector
 * of the eigenvalue > 1 lies in the cone |eta| <= alpha |xi|. So it is such a curve over all |xi| <= size.
 */
#include "instrument/prove/arb_manifold_impl.h"

/* --- matrices --------------------------------------------------------------------------------------------------- */

void prove_apply(const arb_struct M[4], const arb_struct v[2], const arb_struct *offset, slong bits, arb_struct x[2])
{
    ISO_BALL_ROW(y, 2);
    for (int i = 0; i < 2; i++) arb_dot(y + i, offset ? offset + i : NULL, 0, M + 2 * i, 1, v, 1, 2, bits);
    _arb_vec_set(x, y, 2);
}

void prove_multiply(const arb_struct M[4], const arb_struct N[4], slong bits, arb_struct X[4])
{
    ISO_BALL_ROW(Y, 4);
    for (int i = 0; i < 4; i++) arb_dot(Y + i, NULL, 0, M + i / 2 * 2, 1, N + i % 2, 2, 2, bits);
    _arb_vec_set(X, Y, 4);
}

/* --- O ---------------------------------------------------------------------------------------------------------- */

/* D on a set about O, by its parts: each part carries O to O, so the next set is D times the last one. */
static iso_status enclose(prove_flow *f, arb_struct z[2], arb_struct D[4])
{
    prove_half half;
    ISO_BALLS_OF(half);
    arb_one(D), arb_zero(D + 1), arb_zero(D + 2), arb_one(D + 3);
    for (int i = 0; i < f->parts; i++) {
        prove_certificate_text(f->certificate, "half cone");
        ISO_TRY(prove_half_return(f, (prove_part){i, f->parts}, z, z + 1, PROVE_PAIR, &half));
        prove_apply(half.D, z, NULL, f->bits, z);
        prove_multiply(half.D, D, f->bits, D);
        for (int j = 0; j < 2; j++) prove_widen(f, PROVE_EIGHTH, z + j);
    }
    return ISO_OK;
}

iso_status prove_local_begin(prove_flow *f, prove_local *o)
{
    FILE *certificate = f->certificate;
    ISO_BALLS(trace, root);
    ISO_BALL_ROW(z, 2);
    ISO_BALL_ROW(D, 4);
    f->certificate = NULL; /* the cone condition says all that is needed of O */
    const iso_status status = enclose(f, z, D);
    f->certificate = certificate;
    if (status != ISO_OK) return status;
    arb_add(trace, D, D + 3, f->bits); /* lambda + 1/lambda = trace, as the determinant is 1 */
    arb_mul(root, trace, trace, f->bits);
    arb_sub_ui(root, root, 4, f->bits);
    if (!(arb_is_positive(root) && arb_is_positive(trace)))
        return ISO_FAIL_NUMERICAL(f->ctx, "the rotation is not hyperbolic in these digits");
    arb_sqrt(root, root, f->bits);
    arb_add(o->lambda, trace, root, f->bits);
    arb_mul_2exp_si(o->lambda, o->lambda, -1);
    arb_div(o->s, D + 2, D + 1, f->bits); /* eigenvectors (1, +-s), s^2 = (dx'/dl)/(dl'/dx); any s near it will do */
    arb_get_mid_arb(o->s, o->s);
    arb_sqrt(o->s, o->s, f->bits);
    arb_get_mid_arb(o->s, o->s);
    if (arb_is_negative(D + 1)) arb_neg(o->s, o->s);
    return ISO_OK;
}

iso_status prove_local_foresee(const prove_flow *f, const prove_local *o)
{
    enum { TIMES = 8 }; /* of the search, a set and its centre; measured: 13 */
    ISO_BALLS(size, growth);
    arb_log(size, o->size, f->bits), arb_log(growth, o->lambda, f->bits);
    const double halves = -arf_get_d(arb_midref(size), ARF_RND_NEAR) / arf_get_d(arb_midref(growth), ARF_RND_NEAR);
    if (TIMES * halves < (double)(f->work->most - f->work->begun)) return ISO_OK;
    return ISO_FAIL_NUMERICAL(f->ctx, "it takes about %.2g half returns, more than the %ld of --half-returns",
                              TIMES * halves, f->work->most);
}

/* --- the cone condition ----------------------------------------------------------------------------------------- */

/* [[a, b], [c, d]] = A^-1 D A, A = [[1, 1], [s, -s]]. */
static void into_frame(const prove_flow *f, const arb_struct D[4], const arb_t s, arb_struct E[4])
{
    ISO_BALLS(part);
    ISO_BALL_ROW(sum, 2);
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 2; i++) {
            arb_mul(sum + i, D + 2 * i + 1, s, f->bits);
            if (j == 1) arb_neg(sum + i, sum + i);
            arb_add(sum + i, sum + i, D + 2 * i, f->bits);
        }
        arb_div(part, sum + 1, s, f->bits);
        arb_add(E + j, sum, part, f->bits);
        arb_sub(E + 2 + j, sum, part, f->bits);
        arb_mul_2exp_si(E + j, E + j, -1);
        arb_mul_2exp_si(E + 2 + j, E + 2 + j, -1);
    }
}

/* alpha = 2 |c|/(a - |d|), then both conditions. */
static bool find_slope(const prove_flow *f, arb_struct E[4], arb_t alpha)
{
    ISO_BALLS(left, right, part);
    for (int i = 1; i < 4; i++) arb_abs(E + i, E + i);
    arb_sub(part, E, E + 3, f->bits);
    arb_div(alpha, E + 2, part, f->bits);
    arb_mul_2exp_si(alpha, alpha, 1);
    arb_get_ubound_arf(arb_midref(alpha), alpha, MAG_BITS);
    mag_zero(arb_radref(alpha));
    arb_mul(right, E + 1, alpha, f->bits);
    arb_sub(right, E, right, f->bits);
    arb_sub_ui(part, right, 1, f->bits);
    arb_mul(right, right, alpha, f->bits);
    arb_mul(left, E + 3, alpha, f->bits);
    arb_add(left, left, E + 2, f->bits);
    arb_sub(right, right, left, f->bits);
    arb_sub_ui(left, alpha, 1, f->bits);
    return arb_is_positive(part) && arb_is_positive(right) && arb_is_negative(left);
}

iso_status prove_local_bound(prove_flow *f, prove_local *o)
{
    ISO_BALLS(most);
    ISO_BALL_ROW(z, 2);
    ISO_BALL_ROW(D, 4);
    ISO_BALL_ROW(E, 4);
    arb_mul_2exp_si(most, o->size, 1); /* all points with |xi|, |eta| <= size: |l| <= 2 size, |x| <= 2 |s| size */
    arb_add_error(z, most);
    arb_mul(most, most, o->s, f->bits);
    arb_add_error(z + 1, most);
    for (int i = 0; i < 2; i++) prove_widen(f, PROVE_EIGHTH, z + i);
    prove_certificate_line(f->certificate, "frame-o", 1, o->s);
    prove_certificate_line(f->certificate, "size", 1, o->size);
    ISO_TRY(enclose(f, z, D));
    into_frame(f, D, o->s, E);
    if (!find_slope(f, E, o->slope))
        return ISO_FAIL_NUMERICAL(f->ctx, "the cone condition does not hold in these digits");
    prove_certificate_line(f->certificate, "cone", 1, o->slope);
    return ISO_OK;
}

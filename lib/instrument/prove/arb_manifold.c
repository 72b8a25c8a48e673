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
    arb_ptr y = _arb_vec_init(2);
    for (int i = 0; i < 2; i++) arb_dot(y + i, offset ? offset + i : NULL, 0, M + 2 * i, 1, v, 1, 2, bits);
    _arb_vec_set(x, y, 2);
    _arb_vec_clear(y, 2);
}

void prove_multiply(const arb_struct M[4], const arb_struct N[4], slong bits, arb_struct X[4])
{
    arb_ptr Y = _arb_vec_init(4);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) arb_dot(Y + 2 * i + j, NULL, 0, M + 2 * i, 1, N + j, 2, 2, bits);
    _arb_vec_set(X, Y, 4);
    _arb_vec_clear(Y, 4);
}

/* --- O ---------------------------------------------------------------------------------------------------------- */

/* lambda + 1/lambda = trace, as the determinant is 1. */
static bool find_multiplier(const prove_flow *f, const arb_struct D[4], prove_local *o)
{
    arb_t root;
    arb_init(root);
    arb_add(o->trace, D, D + 3, f->bits);
    arb_mul(root, o->trace, o->trace, f->bits);
    arb_sub_ui(root, root, 4, f->bits);
    const bool hyperbolic = arb_is_positive(root) && arb_is_positive(o->trace);
    if (hyperbolic) {
        arb_sqrt(root, root, f->bits);
        arb_add(o->lambda, o->trace, root, f->bits);
        arb_mul_2exp_si(o->lambda, o->lambda, -1);
    }
    arb_clear(root);
    return hyperbolic;
}

/* D on a set about O, by its parts: each part carries O to O, so the next set is D times the last one. */
static iso_status enclose(prove_flow *f, arb_struct z[2], arb_struct D[4])
{
    prove_half half;
    iso_status status = ISO_OK;
    iso_balls_init(&half, sizeof half);
    arb_one(D), arb_zero(D + 1), arb_zero(D + 2), arb_one(D + 3);
    for (int i = 0; i < f->parts && status == ISO_OK; i++) {
        prove_certificate_text(f->certificate, "half cone");
        status = prove_half_return(f, (prove_part){i, f->parts}, z, z + 1, PROVE_PAIR, &half);
        prove_apply(half.D, z, NULL, f->bits, z);
        prove_multiply(half.D, D, f->bits, D);
        for (int j = 0; j < 2; j++) prove_widen(f, PROVE_EIGHTH, z + j);
    }
    iso_balls_clear(&half, sizeof half);
    return status;
}

iso_status prove_local_begin(prove_flow *f, prove_local *o)
{
    prove_certificate *certificate = f->certificate;
    arb_ptr z = _arb_vec_init(2), D = _arb_vec_init(4);
    f->certificate = NULL; /* the cone condition says all that is needed of O */
    iso_status status = enclose(f, z, D);
    f->certificate = certificate;
    if (status == ISO_OK && !find_multiplier(f, D, o))
        status = ISO_FAIL_NUMERICAL(f->ctx, "the rotation is not hyperbolic in these digits");
    if (status == ISO_OK) { /* eigenvectors (1, +-s), s^2 = (dx'/dl)/(dl'/dx); any s near it will do */
        arb_div(o->s, D + 2, D + 1, f->bits);
        arb_get_mid_arb(o->s, o->s);
        arb_sqrt(o->s, o->s, f->bits);
        arb_get_mid_arb(o->s, o->s);
        if (arb_is_negative(D + 1)) arb_neg(o->s, o->s);
    }
    _arb_vec_clear(z, 2), _arb_vec_clear(D, 4);
    return status;
}

iso_status prove_local_foresee(const prove_flow *f, const prove_local *o)
{
    enum { TIMES = 8 }; /* of the search, a set and its centre; measured: 13 */
    arb_ptr size = _arb_vec_init(2), growth = size + 1;
    arb_log(size, o->size, f->bits), arb_log(growth, o->lambda, f->bits);
    const double halves = -arf_get_d(arb_midref(size), ARF_RND_NEAR) / arf_get_d(arb_midref(growth), ARF_RND_NEAR);
    _arb_vec_clear(size, 2);
    if (TIMES * halves < (double)(f->work->most - f->work->begun)) return ISO_OK;
    return ISO_FAIL_NUMERICAL(f->ctx, "it takes about %.2g half returns, more than the %ld of --half-returns",
                              TIMES * halves, f->work->most);
}

/* --- the cone condition ----------------------------------------------------------------------------------------- */

/* [[a, b], [c, d]] = A^-1 D A, A = [[1, 1], [s, -s]]. */
static void into_frame(const prove_flow *f, const arb_struct D[4], const arb_t s, arb_struct E[4])
{
    arb_t sum[2], part;
    arb_init(sum[0]), arb_init(sum[1]), arb_init(part);
    for (int j = 0; j < 2; j++) {
        for (int i = 0; i < 2; i++) {
            arb_mul(sum[i], D + 2 * i + 1, s, f->bits);
            if (j == 1) arb_neg(sum[i], sum[i]);
            arb_add(sum[i], sum[i], D + 2 * i, f->bits);
        }
        arb_div(part, sum[1], s, f->bits);
        arb_add(E + j, sum[0], part, f->bits);
        arb_sub(E + 2 + j, sum[0], part, f->bits);
        arb_mul_2exp_si(E + j, E + j, -1);
        arb_mul_2exp_si(E + 2 + j, E + 2 + j, -1);
    }
    arb_clear(sum[0]), arb_clear(sum[1]), arb_clear(part);
}

/* alpha = 2 |c|/(a - |d|), then both conditions. */
static bool find_slope(const prove_flow *f, arb_struct E[4], arb_t alpha)
{
    arb_ptr left = _arb_vec_init(3), right = left + 1, part = left + 2;
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
    const bool holds = arb_is_positive(part) && arb_is_positive(right) && arb_is_negative(left);
    _arb_vec_clear(left, 3);
    return holds;
}

iso_status prove_local_bound(prove_flow *f, prove_local *o)
{
    arb_ptr z = _arb_vec_init(2), D = _arb_vec_init(4), E = _arb_vec_init(4);
    arb_t most;
    arb_init(most);
    arb_mul_2exp_si(most, o->size, 1); /* all points with |xi|, |eta| <= size: |l| <= 2 size, |x| <= 2 |s| size */
    arb_add_error(z, most);
    arb_mul(most, most, o->s, f->bits);
    arb_add_error(z + 1, most);
    arb_clear(most);
    for (int i = 0; i < 2; i++) prove_widen(f, PROVE_EIGHTH, z + i);
    prove_certificate_line(f->certificate, "frame-o", 1, o->s);
    prove_certificate_line(f->certificate, "size", 1, o->size);
    iso_status status = enclose(f, z, D);
    if (status == ISO_OK) into_frame(f, D, o->s, E);
    if (status == ISO_OK && !find_slope(f, E, o->slope))
        status = ISO_FAIL_NUMERICAL(f->ctx, "the cone condition does not hold in these digits");
    if (status == ISO_OK) prove_certificate_line(f->certificate, "cone", 1, o->slope);
    _arb_vec_clear(z, 2), _arb_vec_clear(D, 4), _arb_vec_clear(E, 4);
    return status;
}

/* arb_follow.c - a piece of the unstable manifold, enclosed from near O to the line l = pi/2 (arb_manifold_impl.h).
 *
 * After each half return, or part of one, the piece lies in the set centre + dk C + A (xi, eta), (xi, eta) in `hull`,
 * where centre, C (`drift`) and A are exact; dk = k - k_0, and k_0 is a number of the interval of k. The left and the
 * right end lie in `left` and `right` of this frame, and for each k the piece is a curve with the tangent (1, sigma),
 * on which xi grows from left to right. With D the derivative on the whole set, E that by k, and P(centre) enclosed
 * by itself for k_0 (P: the half return, or its part), the mean value theorem gives, as the set is convex and holds
 * its centre,
 *
 *     P(centre + dk C + A v) in P(centre) + dk (D C + E) + (D A) v.
 *
 * The next centre is near P(centre), the next C near D C + E, the next A near D A. So v becomes B v + e, where
 * B = A_next^-1 D A is near 1, and e = A_next^-1 (P(centre) - centre_next + dk (D C + E - C_next)) near 0. sigma
 * becomes (B21 + B22 sigma)/(B11 + B12 sigma). If there is one k only, dk = 0, and there is no C.
 */
#include <math.h>

#include "instrument/prove/arb_manifold_impl.h"

typedef struct piece {
    arb_struct centre[2], drift[2], A[4], hull[2], left[2], right[2];
    arb_t sigma, dk, scale; /* the tangent is (1, sigma); k - k_0; the slope of the manifold in O */
} piece;

static void invert(const arb_struct M[4], slong bits, arb_struct X[4])
{
    ISO_BALLS(determinant);
    arb_mul(determinant, M + 1, M + 2, bits);
    arb_neg(determinant, determinant);
    arb_addmul(determinant, M, M + 3, bits);
    for (int i = 0; i < 4; i++) arb_div(X + i, i == 0 ? M + 3 : i == 3 ? M : M + i, determinant, bits);
    arb_neg(X + 1, X + 1), arb_neg(X + 2, X + 2);
}

static bool has_drift(const prove_flow *f)
{
    return f->parts > 1;
}

/* x = centre + dk C + A v */
static void place(const prove_flow *f, const piece *p, const arb_struct v[2], arb_struct x[2])
{
    prove_apply(p->A, v, p->centre, f->bits, x);
    for (int i = 0; i < 2; i++) arb_addmul(x + i, p->drift + i, p->dk, f->bits);
}

/* The tangent that M makes of (1, sigma): (M21 + M22 sigma)/(M11 + M12 sigma), monotone in sigma. *below: the
 * denominator. */
static void carry_tangent(const arb_struct M[4], const arb_t sigma, slong bits, arb_t below, arb_t x)
{
    ISO_BALLS(end, top);
    ISO_BALL_ROW(both, 2);
    for (int i = 0; i < 2; i++) {
        (i == 0 ? arb_get_lbound_arf : arb_get_ubound_arf)(arb_midref(end), sigma, bits);
        arb_mul(below, M + 1, end, bits);
        arb_add(below, below, M, bits);
        arb_mul(top, M + 3, end, bits);
        arb_add(top, top, M + 2, bits);
        arb_div(both + i, top, below, bits);
    }
    arb_mul(below, M + 1, sigma, bits);
    arb_add(below, below, M, bits);
    arb_union(x, both, both + 1, bits);
}

/* To the certificate. */
static void write_piece(const prove_flow *f, const piece *p)
{
    prove_certificate_line(f->certificate, "centre", 2, p->centre);
    if (has_drift(f)) prove_certificate_line(f->certificate, "drift", 2, p->drift);
    prove_certificate_line(f->certificate, "frame", 4, p->A);
    prove_certificate_line(f->certificate, "hull", 2, p->hull);
    prove_certificate_line(f->certificate, "left", 2, p->left);
    prove_certificate_line(f->certificate, "right", 2, p->right);
    prove_certificate_line(f->certificate, "sigma", 1, p->sigma);
}

/* A thousandth each time. */
static void widen_all(const prove_flow *f, piece *p)
{
    enum { PART = 10 };
    const arb_ptr sets[] = {p->hull, p->left, p->right};
    for (int i = 0; i < 6; i++) prove_widen(f, PART, sets[i / 2] + i % 2);
    prove_widen(f, PART, p->sigma);
}

/* --- the beginning ---------------------------------------------------------------------------------------------- */

/* The piece start (1 +- width) + dk drift of the local manifold: |eta| <= slope |xi|, |sigma| <= slope. */
static bool begin_piece(const prove_flow *f, const prove_local *o, const prove_start *start, const arb_t width,
                        piece *p)
{
    ISO_BALLS(length, most, part);
    arb_mul(length, start->xi, width, f->bits);
    arb_get_ubound_arf(arb_midref(length), length, MAG_BITS);
    mag_zero(arb_radref(length));
    arb_set(p->centre, start->xi);
    arb_mul(p->centre + 1, start->xi, o->s, ARF_PREC_EXACT);
    arb_one(p->A), arb_one(p->A + 1);
    arb_set(p->A + 2, o->s), arb_neg(p->A + 3, o->s);
    if (has_drift(f)) {
        arb_set_round(p->drift, start->drift, MAG_BITS);
        arb_get_mid_arb(p->drift, p->drift);
        arb_mul(p->drift + 1, p->drift, o->s, ARF_PREC_EXACT);
    }
    arb_mul(part, p->drift, p->dk, f->bits);
    arb_get_abs_ubound_arf(arb_midref(most), part, f->bits);
    arb_add(most, most, length, f->bits);
    const bool positive = arb_lt(most, start->xi);
    arb_add(most, most, start->xi, f->bits);
    const bool inside = positive && arb_le(most, o->size);
    arb_mul(most, most, o->slope, f->bits);
    arb_zero(p->hull), arb_zero(p->hull + 1), arb_zero(p->sigma);
    arb_add_error(p->hull, length), arb_add_error(p->hull + 1, most), arb_add_error(p->sigma, o->slope);
    arb_neg(p->left, length), arb_set(p->right, length);
    arb_set(p->left + 1, p->hull + 1), arb_set(p->right + 1, p->hull + 1);
    widen_all(f, p);
    return inside;
}

/* --- half a return ---------------------------------------------------------------------------------------------- */

/* D on the whole set, then P(centre). Both must be the same crossing: that of the centre in the window of the set. */
static iso_status enclose(prove_flow *f, prove_flow *thin, prove_part part, const piece *p, prove_half *all,
                          prove_half *one)
{
    ISO_BALL_ROW(box, 2);
    place(f, p, p->hull, box);
    for (int i = 0; i < 2; i++) prove_widen(f, PROVE_EIGHTH, box + i);
    prove_certificate_text(f->certificate, "half set");
    ISO_TRY(prove_half_return(f, part, box, box + 1, has_drift(f) ? PROVE_STATE : PROVE_PAIR, all));
    prove_certificate_text(f->certificate, "half centre");
    ISO_TRY(prove_half_return(thin, part, p->centre, p->centre + 1, PROVE_POINT, one));
    if (arb_contains(all->window, one->time)) return ISO_OK;
    return ISO_FAIL_NUMERICAL(f->ctx, "the centre of a set was followed to another crossing");
}

/* Where both columns of A are nearly parallel, the second is made orthogonal to the first; the determinant stays.
 * Angles are those of (l, x/scale): near O the manifolds have the slopes +-scale, which may be small. */
static void spread_frame(arb_struct A[4], const arb_t scale, slong bits)
{
    ISO_BALLS(determinant, size, other);
    for (int i = 2; i < 4; i++) arb_div(A + i, A + i, scale, bits);
    arb_mul(determinant, A, A + 3, bits);
    arb_submul(determinant, A + 1, A + 2, bits);
    arb_mul(size, A, A, bits), arb_addmul(size, A + 2, A + 2, bits);
    arb_mul(other, A + 1, A + 1, bits), arb_addmul(other, A + 3, A + 3, bits);
    arb_mul(other, other, size, bits);
    arb_mul_2exp_si(other, other, -4);
    arb_div(size, determinant, size, bits);
    arb_mul(determinant, determinant, determinant, bits);
    if (arb_lt(determinant, other)) {
        arb_mul(A + 1, A + 2, size, bits), arb_neg(A + 1, A + 1);
        arb_mul(A + 3, A, size, bits);
    }
    for (int i = 2; i < 4; i++) arb_mul(A + i, A + i, scale, bits);
    for (int i = 0; i < 4; i++) arb_get_mid_arb(A + i, A + i);
}

/* The next centre, C and A; e = what P(centre) + dk (D C + E) is beyond them. False: xi does not grow along the piece,
 * or the centre is not in the set. */
static bool carry(const prove_flow *f, const prove_half *all, const prove_half *one, piece *p)
{
    const slong bits = f->bits;
    ISO_BALLS(below);
    ISO_BALL_ROW(B, 4);
    ISO_BALL_ROW(T, 4);
    ISO_BALL_ROW(E, 2);
    ISO_BALL_ROW(e, 2);
    prove_multiply(all->D, p->A, bits, T);
    for (int i = 0; i < 4; i++) arb_get_mid_arb(p->A + i, T + i);
    spread_frame(p->A, p->scale, bits);
    if (has_drift(f)) prove_apply(all->D, p->drift, all->D + 4, bits, E);
    for (int i = 0; i < 2; i++) {
        arb_get_mid_arb(p->centre + i, one->z + i);
        arb_get_mid_arb(p->drift + i, E + i);
        arb_sub(e + i, one->z + i, p->centre + i, bits);
        arb_sub(E + i, E + i, p->drift + i, bits);
        arb_addmul(e + i, E + i, p->dk, bits);
    }
    invert(p->A, bits, B);
    prove_apply(B, e, NULL, bits, e);
    prove_multiply(B, T, bits, B);
    prove_apply(B, p->hull, e, bits, p->hull);
    prove_apply(B, p->left, e, bits, p->left);
    prove_apply(B, p->right, e, bits, p->right);
    carry_tangent(B, p->sigma, bits, below, p->sigma);
    widen_all(f, p);
    return arb_is_positive(below) && arb_contains_zero(p->hull) && arb_contains_zero(p->hull + 1);
}

/* --- the end ---------------------------------------------------------------------------------------------------- */

/* log2 of the part of the radius by the distance of an end from the line. */
static double noise_of(const arb_t end, const arb_t line, slong bits)
{
    ISO_BALLS(apart);
    mag_t size;
    mag_init(size);
    arb_sub(apart, line, end, bits);
    arf_get_mag(size, arb_midref(apart));
    mag_div(size, arb_radref(apart), size);
    const double noise = mag_get_d_log2_approx(size);
    mag_clear(size);
    return noise;
}

/* Below l = pi/2 at the left end, above at the right end, and l grows on the way: one crossing, with the slope
 * m = (A21 + A22 sigma)/(A11 + A12 sigma). */
static bool cross(const prove_flow *f, const piece *p, prove_crossing *crossing)
{
    enum { LEAST = 2, MOST = 60 }; /* of longer */
    const slong bits = f->bits;
    ISO_BALLS(line, rate);
    ISO_BALL_ROW(left, 2);
    ISO_BALL_ROW(right, 2);
    ISO_BALL_ROW(all, 2);
    arb_const_pi(line, bits);
    arb_mul_2exp_si(line, line, -1);
    place(f, p, p->left, left), place(f, p, p->right, right), place(f, p, p->hull, all);
    const double noise = fmax(noise_of(left, line, bits), noise_of(right, line, bits));
    crossing->longer = (slong)fmin(fmax(LEAST, ceil(noise) + 1), MOST);
    arb_set(crossing->x, all + 1);
    carry_tangent(p->A, p->sigma, bits, rate, crossing->m);
    prove_widen(f, PROVE_EIGHTH, crossing->m), prove_widen(f, PROVE_EIGHTH, crossing->x);
    return arb_lt(left, line) && arb_gt(right, line) && arb_is_positive(rate);
}

iso_status prove_follow(prove_flow *f, prove_flow *one, const prove_local *o, const prove_start *start,
                        const arb_t width, prove_crossing *crossing, bool *reached)
{
    piece p;
    prove_half all, centre;
    ISO_BALLS_OF(p);
    ISO_BALLS_OF(all);
    ISO_BALLS_OF(centre);
    if (has_drift(f)) arb_sub(p.dk, f->k, one->k, f->bits);
    arb_set(p.scale, o->s);
    crossing->longer = 0;
    *reached = begin_piece(f, o, start, width, &p);
    write_piece(f, &p);
    for (long i = 0; i < start->halves * f->parts && *reached; i++) {
        ISO_TRY(enclose(f, one, (prove_part){(int)(i % f->parts), f->parts}, &p, &all, &centre));
        *reached = carry(f, &all, &centre, &p);
        write_piece(f, &p);
    }
    *reached = *reached && cross(f, &p, crossing);
    return ISO_OK;
}

/* arb_follow.c - a piece of the unstable manifold, enclosed from near O to the line l = pi/2 (arb_manifold_impl.h).
 *
 * After each half return the piece lies in the set centre + A (xi, eta), (xi, eta) in `hull`, where centre and A are
 * exact. The left and the right end lie in `left` and `right` of this frame, and the piece is a curve with the tangent
 * (1, sigma), on which xi grows from left to right. With D the derivative on the whole set, and P(centre) enclosed by
 * itself (P: half a return, then the antipode), the mean value theorem gives, as the set is convex and holds its centre,
 *
 *     P(centre + A v) in P(centre) + (D A) v.
 *
 * The next centre is near P(centre), the next A near D A, and so v becomes B v + e with B = A_next^-1 D A near 1,
 * e = A_next^-1 (P(centre) - centre_next) near 0, and sigma becomes (B21 + B22 sigma)/(B11 + B12 sigma).
 */
#include "study/prove/arb_manifold_impl.h"

typedef struct piece {
    arb_struct centre[2], A[4], hull[2], left[2], right[2];
    arb_t sigma;
} piece;

static void piece_init(piece *p)
{
    for (int i = 0; i < 2; i++)
        arb_init(p->centre + i), arb_init(p->hull + i), arb_init(p->left + i), arb_init(p->right + i);
    for (int i = 0; i < 4; i++) arb_init(p->A + i);
    arb_init(p->sigma);
}

static void piece_clear(piece *p)
{
    for (int i = 0; i < 2; i++)
        arb_clear(p->centre + i), arb_clear(p->hull + i), arb_clear(p->left + i), arb_clear(p->right + i);
    for (int i = 0; i < 4; i++) arb_clear(p->A + i);
    arb_clear(p->sigma);
}

/* x = M v + offset; NULL: 0 */
static void apply(const arb_struct M[4], const arb_struct v[2], const arb_struct offset[2], slong bits,
                  arb_struct x[2])
{
    arb_ptr y = _arb_vec_init(2);
    for (int i = 0; i < 2; i++) arb_dot(y + i, offset ? offset + i : NULL, 0, M + 2 * i, 1, v, 1, 2, bits);
    _arb_vec_set(x, y, 2);
    _arb_vec_clear(y, 2);
}

/* X = M N; X may be M or N. */
static void multiply(const arb_struct M[4], const arb_struct N[4], slong bits, arb_struct X[4])
{
    arb_ptr Y = _arb_vec_init(4);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) arb_dot(Y + 2 * i + j, NULL, 0, M + 2 * i, 1, N + j, 2, 2, bits);
    _arb_vec_set(X, Y, 4);
    _arb_vec_clear(Y, 4);
}

static void invert(const arb_struct M[4], slong bits, arb_struct X[4])
{
    arb_t determinant;
    arb_init(determinant);
    arb_mul(determinant, M + 1, M + 2, bits);
    arb_neg(determinant, determinant);
    arb_addmul(determinant, M, M + 3, bits);
    for (int i = 0; i < 4; i++) arb_div(X + i, i == 0 ? M + 3 : i == 3 ? M : M + i, determinant, bits);
    arb_neg(X + 1, X + 1), arb_neg(X + 2, X + 2);
    arb_clear(determinant);
}

static void write_piece(const prove_flow *f, const piece *p)
{
    prove_certificate_line(f->certificate, "centre", 2, p->centre);
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
    for (int i = 0; i < 2; i++) prove_widen(f, PART, p->hull + i);
    for (int i = 0; i < 2; i++) prove_widen(f, PART, p->left + i);
    for (int i = 0; i < 2; i++) prove_widen(f, PART, p->right + i);
    prove_widen(f, PART, p->sigma);
}

/* --- the beginning ---------------------------------------------------------------------------------------------- */

/* The piece start (1 +- width) of the local manifold: |eta| <= slope (xi + width), |sigma| <= slope. */
static bool begin_piece(const prove_flow *f, const prove_local *o, const prove_start *start, const arb_t width,
                        piece *p)
{
    arb_t length, most;
    arb_init(length), arb_init(most);
    arb_mul(length, start->xi, width, f->bits);
    arb_get_ubound_arf(arb_midref(length), length, MAG_BITS);
    mag_zero(arb_radref(length));
    arb_set(p->centre, start->xi);
    arb_mul(p->centre + 1, start->xi, o->s, ARF_PREC_EXACT);
    arb_one(p->A), arb_one(p->A + 1);
    arb_set(p->A + 2, o->s), arb_neg(p->A + 3, o->s);
    arb_add(most, start->xi, length, f->bits);
    const bool inside = arb_le(most, o->size);
    arb_mul(most, most, o->slope, f->bits);
    arb_zero(p->hull), arb_zero(p->hull + 1), arb_zero(p->sigma);
    arb_add_error(p->hull, length), arb_add_error(p->hull + 1, most), arb_add_error(p->sigma, o->slope);
    arb_neg(p->left, length), arb_set(p->right, length);
    arb_set(p->left + 1, p->hull + 1), arb_set(p->right + 1, p->hull + 1);
    widen_all(f, p);
    arb_clear(length), arb_clear(most);
    return inside;
}

/* --- half a return ---------------------------------------------------------------------------------------------- */

/* Both must be the same crossing: that of the centre in the window of the whole set. */
static iso_status check_times(const prove_flow *f, const prove_half *all, const prove_half *one)
{
    if (arb_contains(all->window, one->time)) return ISO_OK;
    return iso_context_fail(f->ctx, ISO_NUMERICAL, "", "the centre of a set was followed to another crossing");
}

/* D on the whole set, then P(centre). */
static iso_status enclose(prove_flow *f, const piece *p, prove_half *all, prove_half *one)
{
    arb_ptr box = _arb_vec_init(2);
    apply(p->A, p->hull, p->centre, f->bits, box);
    for (int i = 0; i < 2; i++) prove_widen(f, PROVE_EIGHTH, box + i);
    prove_certificate_words(f->certificate, "half set");
    iso_status status = prove_half_return(f, box, box + 1, true, all);
    prove_certificate_words(f->certificate, "half centre");
    if (status == ISO_OK) status = prove_half_return(f, p->centre, p->centre + 1, false, one);
    if (status == ISO_OK) status = check_times(f, all, one);
    _arb_vec_clear(box, 2);
    return status;
}

/* False: xi does not grow along the piece, or the centre is not in the set. */
static bool carry(const prove_flow *f, const prove_half *all, const prove_half *one, piece *p)
{
    const slong bits = f->bits;
    arb_ptr B = _arb_vec_init(4), T = _arb_vec_init(4), e = _arb_vec_init(2);
    arb_t below;
    arb_init(below);
    multiply(all->D, p->A, bits, T);
    for (int i = 0; i < 4; i++) arb_get_mid_arb(p->A + i, T + i);
    for (int i = 0; i < 2; i++) {
        arb_get_mid_arb(p->centre + i, one->z + i);
        arb_sub(e + i, one->z + i, p->centre + i, bits);
    }
    invert(p->A, bits, B);
    apply(B, e, NULL, bits, e);
    multiply(B, T, bits, B);
    apply(B, p->hull, e, bits, p->hull);
    apply(B, p->left, e, bits, p->left);
    apply(B, p->right, e, bits, p->right);
    arb_mul(below, B + 1, p->sigma, bits);
    arb_add(below, below, B, bits);
    arb_mul(p->sigma, B + 3, p->sigma, bits);
    arb_add(p->sigma, p->sigma, B + 2, bits);
    arb_div(p->sigma, p->sigma, below, bits);
    widen_all(f, p);
    const bool grows = arb_is_positive(below) && arb_contains_zero(p->hull) && arb_contains_zero(p->hull + 1);
    _arb_vec_clear(B, 4), _arb_vec_clear(T, 4), _arb_vec_clear(e, 2);
    arb_clear(below);
    return grows;
}

/* --- the end ---------------------------------------------------------------------------------------------------- */

/* Below l = pi/2 at the left end, above at the right end, and l grows on the way: one crossing, with the slope
 * m = (A21 + A22 sigma)/(A11 + A12 sigma). */
static bool cross(const prove_flow *f, const piece *p, prove_crossing *crossing)
{
    const slong bits = f->bits;
    arb_ptr end = _arb_vec_init(2);
    arb_t line, rate;
    arb_init(line), arb_init(rate);
    arb_const_pi(line, bits);
    arb_mul_2exp_si(line, line, -1);
    apply(p->A, p->left, p->centre, bits, end);
    bool reached = arb_lt(end, line);
    apply(p->A, p->right, p->centre, bits, end);
    reached = reached && arb_gt(end, line);
    apply(p->A, p->hull, p->centre, bits, end);
    arb_set(crossing->x, end + 1);
    arb_mul(rate, p->A + 1, p->sigma, bits);
    arb_add(rate, rate, p->A, bits);
    arb_mul(crossing->m, p->A + 3, p->sigma, bits);
    arb_add(crossing->m, crossing->m, p->A + 2, bits);
    arb_div(crossing->m, crossing->m, rate, bits);
    reached = reached && arb_is_positive(rate);
    prove_widen(f, PROVE_EIGHTH, crossing->m), prove_widen(f, PROVE_EIGHTH, crossing->x);
    _arb_vec_clear(end, 2);
    arb_clear(line), arb_clear(rate);
    return reached;
}

iso_status prove_follow(prove_flow *f, const prove_local *o, const prove_start *start, const arb_t width,
                        prove_crossing *crossing, bool *reached)
{
    piece p;
    prove_half all, one;
    piece_init(&p);
    prove_half_init(&all), prove_half_init(&one);
    *reached = begin_piece(f, o, start, width, &p);
    iso_status status = ISO_OK;
    write_piece(f, &p);
    for (long i = 0; i < start->halves && *reached && status == ISO_OK; i++) {
        status = enclose(f, &p, &all, &one);
        if (status == ISO_OK) *reached = carry(f, &all, &one, &p);
        write_piece(f, &p);
    }
    if (status == ISO_OK && *reached) *reached = cross(f, &p, crossing);
    piece_clear(&p);
    prove_half_clear(&all), prove_half_clear(&one);
    return status;
}

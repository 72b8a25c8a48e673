/* arb_set.c - a set of states, carried by Taylor steps (arb_certify_impl.h).
 *
 * A box of balls that is carried again and again grows by more than the motion: each time it is put into a box again,
 * whose sides are wrong (wrapping). So the set is kept in a frame (Lohner's method), x = centre + S A v, |v_i| <= r_i.
 * With D the derivative of the flow on all of the set, the mean value theorem gives, as the set is convex,
 *
 *     flow(x) in flow(centre) + D S A v.
 *
 * M = S^-1 D S A is split as Q (Q^-1 M), Q about orthogonal, its first columns those of M along which the set is
 * longest. The next A is Q, the next centre the midpoint of flow(centre), with the error e, and
 *
 *     r_i <- sum_j |Q^-1 M|_ij r_j + sum_j |Q^-1|_ij e_j/S_jj.
 *
 * Q is exact, whatever rounding made of it, and Q^-1 is a ball: nothing depends on Q being orthogonal.
 * The clocks do not act on the state: their errors add up.
 */
#include <float.h>
#include <math.h>
#include <stddef.h>

#include "instrument/certify/arb_certify_impl.h"

/* Of the series over the set: D is wanted to a few digits, and its error grows the set by as little in each step. */
enum { WIDE_BITS = 64, WIDE_ORDER = 16 };

/* --- memory ------------------------------------------------------------------------------------------------------ */

/* The power of 2 near the largest of three numbers. */
static slong shift_of(arb_srcptr x)
{
    const slong none = -1000000;
    slong shift = none;
    for (int i = 0; i < 3; i++) {
        const slong bits = arf_is_zero(arb_midref(x + i)) ? none : arf_abs_bound_lt_2exp_si(arb_midref(x + i));
        if (bits > shift) shift = bits;
    }
    return shift == none ? 0 : shift;
}

/* r_i <- the radius of y_i, in the units S; the radius of y_i becomes 0. */
static void take_radii(const certify_set *s, arb_ptr y, mag_ptr r)
{
    for (int i = 0; i < CERTIFY_STATE; i++) {
        mag_mul_2exp_si(r + i, arb_radref(y + i), -s->shift[i]);
        mag_zero(arb_radref(y + i));
    }
}

void certify_set_init(certify_set *s, const certify_ball *b, iso_model_kind model, iso_clock clock, arb_srcptr start,
                      int direction, iso_monitor monitor)
{
    const int order = (int)(0.35 * (double)b->bits) + 6;
    certify_equations(b, model, clock, &s->thin_tape);
    certify_equations(b, model, clock, &s->wide_tape);
    iso_tape_differentiate(&s->wide_tape, CERTIFY_STATE);
    iso_series_init(&s->thin, &s->thin_tape, b->bits, order);
    iso_series_init(&s->wide, &s->wide_tape, WIDE_BITS, WIDE_ORDER);
    s->thin.monitor = s->wide.monitor = monitor;
    s->centre = _arb_vec_init(CERTIFY_ALL);
    arb_mat_init(s->A, CERTIFY_STATE, CERTIFY_STATE);
    arb_mat_one(s->A);
    for (int i = 0; i < CERTIFY_STATE; i++) mag_init(s->r + i);
    iso_balls_init(s, offsetof(certify_set, thin));
    s->direction = direction;
    _arb_vec_set(s->centre, start, CERTIFY_STATE);
    for (int i = 0; i < CERTIFY_STATE; i++) s->shift[i] = shift_of(start + (i < 3 ? 0 : 3));
    take_radii(s, s->centre, s->r);
}

void certify_set_clear(certify_set *s)
{
    iso_series_clear(&s->thin), iso_series_clear(&s->wide);
    iso_tape_clear(&s->thin_tape), iso_tape_clear(&s->wide_tape);
    _arb_vec_clear(s->centre, CERTIFY_ALL);
    arb_mat_clear(s->A);
    for (int i = 0; i < CERTIFY_STATE; i++) mag_clear(s->r + i);
    iso_balls_clear(s, offsetof(certify_set, thin));
}

/* --- a step ------------------------------------------------------------------------------------------------------ */

/* x += the sum of |row i of M| r */
static void add_row(const arb_mat_t M, int i, mag_srcptr r, mag_t x)
{
    mag_t size;
    mag_init(size);
    for (int j = 0; j < CERTIFY_STATE; j++) {
        arb_get_mag(size, arb_mat_entry(M, i, j));
        mag_addmul(x, size, r + j);
    }
    mag_clear(size);
}

/* The set as a box, with the derivative 1. False: stopped. */
static bool expand_wide(certify_set *s)
{
    arb_ptr x = _arb_vec_init(s->wide_tape.states);
    mag_t size;
    mag_init(size);
    for (int i = 0; i < CERTIFY_STATE; i++) {
        mag_zero(size);
        add_row(s->A, i, s->r, size);
        mag_mul_2exp_si(size, size, s->shift[i]);
        arb_set_round(x + i, s->centre + i, WIDE_BITS);
        arb_add_error_mag(x + i, size);
        arb_one(x + CERTIFY_ALL + CERTIFY_STATE * i + i);
    }
    const bool expanded = iso_series_expand(&s->wide, x);
    mag_clear(size);
    _arb_vec_clear(x, s->wide_tape.states);
    return expanded;
}

/* log2 of a step for which what is left out is about a rounding error. No enclosure needs it to be so. */
static double guess_step(const certify_set *s)
{
    const int order = s->thin.order;
    const double bits = (double)s->thin.bits;
    double steepest = -INFINITY;
    for (int n = order - 1; n <= order; n++) {
        for (int i = 0; i < CERTIFY_STATE; i++)
            steepest = fmax(steepest, (iso_series_size(&s->thin, i, n) - (double)s->shift[i] + bits) / n);
        for (int i = CERTIFY_STATE; i < CERTIFY_ALL; i++) {
            const double rate = iso_series_size(&s->thin, i, 1);
            steepest = fmax(steepest, (iso_series_size(&s->thin, i, n) - rate + bits) / (n - 1));
        }
    }
    return -steepest;
}

certify_step certify_set_expand(certify_set *s, double most)
{
    enum { TRIES = 30 };
    if (!iso_series_expand(&s->thin, s->centre) || !expand_wide(s)) return CERTIFY_STOPPED;
    const double guess = guess_step(s);
    double h = fmin(exp2(guess), most);
    bool bounded = false;
    if (isfinite(guess) && h < DBL_MIN) return CERTIFY_TOO_SHORT;
    if (!(h > 0 && isfinite(h))) return CERTIFY_TOO_WIDE;
    for (int i = 0; i < TRIES && !bounded; i++, h *= 0.7) {
        if (!iso_monitor_goes_on(&s->thin.monitor)) return CERTIFY_STOPPED;
        arb_set_d(s->h, h);
        bounded = iso_series_bound(&s->thin, s->h) && iso_series_bound(&s->wide, s->h);
    }
    return bounded ? CERTIFY_STEP : CERTIFY_TOO_WIDE;
}

double certify_set_done(const certify_set *s)
{
    const double part = (double)s->thin.known / (s->thin.order + 1);
    return part * part;
}

/* M = S^-1 D S A at t, and in the rows behind, D S A of the clocks. */
static void carry(certify_set *s, const arb_t t, arb_mat_t M)
{
    ISO_BALL_ROW(d, CERTIFY_ALL * CERTIFY_STATE);
    arb_mat_t D;
    arb_mat_init(D, CERTIFY_ALL, CERTIFY_STATE);
    iso_series_at(&s->wide, t, CERTIFY_ALL, CERTIFY_ALL * CERTIFY_STATE, d);
    for (int i = 0; i < CERTIFY_ALL; i++)
        for (int j = 0; j < CERTIFY_STATE; j++)
            arb_mul_2exp_si(arb_mat_entry(D, i, j), d + CERTIFY_STATE * i + j,
                            s->shift[j] - (i < CERTIFY_STATE ? s->shift[i] : 0));
    arb_mat_mul(M, D, s->A, WIDE_BITS);
    arb_mat_clear(D);
}

bool certify_set_at(certify_set *s, const arb_t time, arb_ptr y)
{
    ISO_BALLS(t, size);
    arb_mat_t M;
    mag_t error;
    arb_sub(t, time, s->time, s->thin.bits + WIDE_BITS);
    arb_abs(size, t);
    if (!arb_le(size, s->h)) return false;
    mag_init(error);
    arb_mat_init(M, CERTIFY_ALL, CERTIFY_STATE);
    carry(s, t, M);
    iso_series_at(&s->thin, t, 0, CERTIFY_ALL, y);
    for (int i = 0; i < CERTIFY_ALL; i++) {
        mag_zero(error);
        add_row(M, i, s->r, error);
        if (i < CERTIFY_STATE) mag_mul_2exp_si(error, error, s->shift[i]);
        arb_add_error_mag(y + i, error);
        if (i >= CERTIFY_STATE) arb_add(y + i, y + i, s->clock[i - CERTIFY_STATE], s->thin.bits);
    }
    arb_mat_clear(M);
    mag_clear(error);
    return true;
}

/* --- the frame --------------------------------------------------------------------------------------------------- */

static double norm_of(double v[CERTIFY_STATE])
{
    double sum = 0;
    for (int i = 0; i < CERTIFY_STATE; i++) sum += v[i] * v[i];
    return sqrt(sum);
}

/* Makes column `done` of Q from v: orthogonal to the columns before. False: nothing is left of it. */
static bool add_column(double Q[CERTIFY_STATE][CERTIFY_STATE], int done, double v[CERTIFY_STATE])
{
    for (int again = 0; again < 2; again++) {
        const double length = norm_of(v);
        if (!(length > 1e-200 && isfinite(length))) return false;
        for (int i = 0; i < CERTIFY_STATE; i++) v[i] /= length;
        for (int j = 0; j < done; j++) {
            double along = 0;
            for (int i = 0; i < CERTIFY_STATE; i++) along += Q[i][j] * v[i];
            for (int i = 0; i < CERTIFY_STATE; i++) v[i] -= along * Q[i][j];
        }
    }
    const double length = norm_of(v);
    if (!(length > 0.5)) return false;
    for (int i = 0; i < CERTIFY_STATE; i++) Q[i][done] = v[i] / length;
    return true;
}

/* A <- Q. M: columns of the middle. If rounding leaves too little of a column, A <- 1, which is as valid. */
static void turn_frame(certify_set *s, const arb_mat_t middle)
{
    double M[CERTIFY_STATE][CERTIFY_STATE], Q[CERTIFY_STATE][CERTIFY_STATE], length[CERTIFY_STATE];
    bool used[CERTIFY_STATE] = {false}, good = true;
    for (int j = 0; j < CERTIFY_STATE; j++) {
        for (int i = 0; i < CERTIFY_STATE; i++)
            M[j][i] = arf_get_d(arb_midref(arb_mat_entry(middle, i, j)), ARF_RND_NEAR);
        /* log2 of the length of the set along it */
        length[j] = mag_is_zero(s->r + j) ? -INFINITY : mag_get_d_log2_approx(s->r + j) + log2(norm_of(M[j]));
    }
    for (int done = 0; done < CERTIFY_STATE && good; done++) {
        int longest = -1;
        for (int j = 0; j < CERTIFY_STATE; j++)
            if (!used[j] && (longest < 0 || length[j] > length[longest])) longest = j;
        used[longest] = true;
        good = add_column(Q, done, M[longest]);
    }
    arb_mat_one(s->A);
    for (int i = 0; i < CERTIFY_STATE && good; i++)
        for (int j = 0; j < CERTIFY_STATE; j++) arb_set_d(arb_mat_entry(s->A, i, j), Q[i][j]);
}

/* A <- about M, r <- what is left, and the error e of the centre. */
static void change_frame(certify_set *s, const arb_mat_t M, mag_srcptr e)
{
    arb_mat_t inverse, B;
    mag_t next[CERTIFY_STATE];
    arb_mat_init(inverse, CERTIFY_STATE, CERTIFY_STATE);
    arb_mat_init(B, CERTIFY_STATE, CERTIFY_STATE);
    turn_frame(s, M);
    if (!arb_mat_inv(inverse, s->A, WIDE_BITS)) arb_mat_one(s->A), arb_mat_one(inverse);
    arb_mat_mul(B, inverse, M, WIDE_BITS);
    for (int i = 0; i < CERTIFY_STATE; i++) {
        mag_init(next[i]);
        add_row(B, i, s->r, next[i]);
        add_row(inverse, i, e, next[i]);
    }
    for (int i = 0; i < CERTIFY_STATE; i++) mag_swap(s->r + i, next[i]), mag_clear(next[i]);
    arb_mat_clear(inverse), arb_mat_clear(B);
}

void certify_set_move(certify_set *s)
{
    mag_ptr e = _mag_vec_init(CERTIFY_STATE);
    ISO_BALLS(t);
    arb_mat_t M, square;
    arb_mat_init(M, CERTIFY_ALL, CERTIFY_STATE);
    arb_mul_si(t, s->h, s->direction, ARF_PREC_EXACT);
    carry(s, t, M);
    iso_series_at(&s->thin, t, 0, CERTIFY_ALL, s->centre);
    for (int i = 0; i < CERTIFY_CLOCKS; i++) {
        mag_zero(e);
        add_row(M, CERTIFY_STATE + i, s->r, e);
        arb_add_error_mag(s->centre + CERTIFY_STATE + i, e);
        arb_add(s->clock[i], s->clock[i], s->centre + CERTIFY_STATE + i, s->thin.bits);
        arb_zero(s->centre + CERTIFY_STATE + i);
    }
    take_radii(s, s->centre, e);
    arb_mat_window_init(square, M, 0, 0, CERTIFY_STATE, CERTIFY_STATE);
    change_frame(s, square, e);
    arb_mat_window_clear(square);
    arb_add(s->time, s->time, t, ARF_PREC_EXACT);
    arb_mat_clear(M);
    _mag_vec_clear(e, CERTIFY_STATE);
}

double certify_set_lost(const certify_set *s)
{
    double largest = -INFINITY;
    for (int i = 0; i < CERTIFY_STATE; i++)
        if (!mag_is_zero(s->r + i)) largest = fmax(largest, mag_get_d_log2_approx(s->r + i));
    return fmax(0, (largest + (double)s->thin.bits) * 0.3010299956639812);
}

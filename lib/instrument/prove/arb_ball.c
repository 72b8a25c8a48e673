/* arb_ball.c - one proof, from the numbers of the ball to the enclosure of m (arb_manifold_impl.h).
 *
 * How near to O the manifold begins, how long the piece is that is followed, and how many bits numbers have follow from
 * the digits of m that are wanted. With size r, the slope at the start is known to about r, and adds r^3 to the error
 * of m. If the enclosure is not as narrow as it was to be, all is done again with more digits.
 */
#include <math.h>
#include <stddef.h>

#include "base/math_impl.h"
#include "instrument/prove/arb_manifold_impl.h"

enum { PARTS = 8 }; /* of half a return, for an interval of k */

/* --- one attempt ------------------------------------------------------------------------------------------------ */

typedef struct attempt {
    prove_flow flow, thin; /* thin: of one k, in the middle */
    prove_local local;
    prove_start start;
    prove_crossing crossing;
    arb_t width; /* of the piece, by its start */
} attempt;

static void attempt_init(attempt *a, iso_context *ctx, const prove_ball *ball, int digits, iso_proof_work *work)
{
    prove_flow *f = &a->flow;
    prove_flow_init(f, ctx, (slong)(3.33 * digits) + 40, work);
    arb_t high;
    arb_init(high);
    arb_set_fmpq(f->k, ball->k[0], f->bits);
    arb_set_fmpq(high, ball->k[1], f->bits);
    arb_union(f->k, f->k, high, f->bits);
    arb_inv(f->inverse_k, f->k, f->bits);
    for (int i = 0; i < 3; i++) arb_set_fmpq(f->J[i], ball->J[i], f->bits);
    arb_add(f->trace, f->J[0], f->J[1], f->bits);
    arb_add(f->trace, f->trace, f->J[2], f->bits);
    prove_flow_like(&a->thin, f, f->bits);
    if (!fmpq_equal(ball->k[0], ball->k[1])) {
        f->parts = PARTS;
        arb_get_mid_arb(a->thin.k, f->k);
        arb_inv(a->thin.inverse_k, a->thin.k, f->bits);
    }
    iso_balls_init(&a->local, sizeof a->local), iso_balls_init(&a->start, offsetof(prove_start, halves));
    iso_balls_init(&a->crossing, offsetof(prove_crossing, longer)), arb_init(a->width);
    arb_clear(high);
}

static void attempt_clear(attempt *a)
{
    prove_flow_clear(&a->flow), prove_flow_clear(&a->thin);
    iso_balls_clear(&a->local, sizeof a->local), iso_balls_clear(&a->start, offsetof(prove_start, halves));
    iso_balls_clear(&a->crossing, offsetof(prove_crossing, longer)), arb_clear(a->width);
}

/* x = 10^power, exact, about. */
static void set_power(arb_t x, double power)
{
    arb_set_si(x, (slong)floor(power * 3.3219280948873623));
    arf_set_si_2exp_si(arb_midref(x), 1, arf_get_si(arb_midref(x), ARF_RND_NEAR));
}

/* The piece is at least as long as what is left of the change of the start with k, in all half returns, beside its
 * drift: of second order. *reached: m is enclosed. If not, but the piece came to the line, it was too short for its
 * noise: a longer one is tried. */
static iso_status follow(attempt *a, bool *reached)
{
    enum { TRIES = 3 };
    const size_t length = a->flow.certificate ? a->flow.certificate->length : 0;
    iso_status status = ISO_OK;
    arb_t part;
    arb_init(part);
    arb_get_rad_arb(part, a->flow.k);
    arb_mul_si(part, part, 4 * a->start.halves, MAG_BITS);
    arb_div(part, part, a->flow.k, MAG_BITS);
    arb_mul(part, part, part, MAG_BITS);
    arb_get_mid_arb(part, part);
    if (arb_gt(part, a->width)) arb_set(a->width, part);
    arb_clear(part);
    *reached = false;
    a->crossing.longer = 0;
    for (int i = 0; i < TRIES && !*reached && (i == 0 || a->crossing.longer > 0) && status == ISO_OK; i++) {
        arb_mul_2exp_si(a->width, a->width, a->crossing.longer);
        arb_get_mid_arb(a->width, a->width);
        prove_certificate_cut(a->flow.certificate, length);
        status = prove_follow(&a->flow, &a->thin, &a->local, &a->start, a->width, &a->crossing, reached);
    }
    return status;
}

/* --- as many as it takes ---------------------------------------------------------------------------------------- */

static void store(const attempt *a, prove_found *found)
{
    arb_set(found->x, a->crossing.x), arb_set(found->m, a->crossing.m);
    arb_mul(found->multiplier, a->local.lambda, a->local.lambda, a->flow.bits);
    arb_set(found->middle, a->thin.k);
    found->parts = a->flow.parts;
    found->halves = a->start.halves;
    found->steps = a->flow.steps + a->thin.steps;
    found->bits = a->flow.bits;
}

/* The digits that the radius of m lacks; 0: none. */
static int missing(const arb_t m, int digits)
{
    mag_t radius;
    mag_init_set(radius, arb_radref(m));
    const double log2_radius = mag_is_zero(radius) ? -INFINITY : mag_get_d_log2_approx(radius);
    mag_clear(radius);
    return (int)fmin(200, fmax(0, ceil(log2_radius * 0.3010299956639812 + digits)));
}

iso_status prove_ball_at(iso_context *ctx, const prove_ball *ball, int digits, iso_proof_work *work,
                         prove_certificate *certificate, prove_found *found)
{
    enum { TRIES = 5, FEWER = 1, SPARE = 11, MORE = 6 };
    const bool thin = fmpq_equal(ball->k[0], ball->k[1]);
    const int tries = thin ? TRIES : FEWER; /* an interval is halved (prove.c) */
    int spare = SPARE;
    iso_status status = ISO_NUMERICAL;
    for (int i = 0; i < tries && status != ISO_OK && status != ISO_STOPPED; i++) {
        attempt a;
        bool reached = false;
        attempt_init(&a, ctx, ball, digits + spare, work);
        a.flow.certificate = a.thin.certificate = certificate;
        prove_certificate_cut(certificate, 0);
        set_power(a.local.size, -(digits + spare - 1) / 3.0);
        set_power(a.width, -(digits + spare - 4));
        status = prove_local_begin(&a.flow, &a.local);
        if (status == ISO_OK) status = prove_local_foresee(&a.flow, &a.local);
        if (status == ISO_OK) status = prove_local_bound(&a.flow, &a.local);
        if (status == ISO_OK) status = prove_search(&a.thin, &a.local, a.flow.parts > 1, &a.start);
        if (status == ISO_OK) status = follow(&a, &reached);
        const int lacks = reached ? missing(a.crossing.m, digits) : MORE;
        if (status == ISO_OK && (reached && (lacks == 0 || !thin)))
            store(&a, found);
        else if (status == ISO_OK)
            status = ISO_FAIL_NUMERICAL(ctx, "m could not be enclosed to %d digits", digits);
        spare += lacks + MORE / 2;
        attempt_clear(&a);
    }
    return status;
}

iso_status prove_ball_expect(iso_context *ctx, const prove_ball *ball, iso_proof_work *work, double *decades)
{
    enum { DIGITS = 60 };
    attempt a;
    attempt_init(&a, ctx, ball, DIGITS, work);
    const iso_status status = prove_local_begin(&a.thin, &a.local);
    if (status == ISO_OK) { /* |m| is about exp(-pi^2/ln lambda), lambda of a half return */
        arb_log(a.width, a.local.lambda, a.thin.bits);
        *decades = ISO_PI * ISO_PI / (arf_get_d(arb_midref(a.width), ARF_RND_NEAR) * log(10));
    }
    attempt_clear(&a);
    return status;
}

/* arb_proof.c - one proof, from the numbers of the ball to the enclosure of m, as text and numbers that need no Arb
 * (prove_impl.h, arb_manifold_impl.h).
 *
 * How near to O the manifold begins, how long the piece is that is followed, and how many bits numbers have follow from
 * the digits of m that are wanted. With size r, the slope at the start is known to about r, and adds r^3 to the error
 * of m. If the enclosure is not as narrow as it was to be, all is done again with more digits.
 */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "instrument/prove/arb_manifold_impl.h"

bool iso_proof_is_possible(void)
{
    return true;
}

/* --- one attempt ------------------------------------------------------------------------------------------------ */

typedef struct attempt {
    prove_flow flow, thin; /* thin: of one k, in the middle */
    prove_local local;
    prove_start start;
    prove_crossing crossing;
    arb_t width; /* of the piece, by its start */
    int axes[3]; /* the one that is no part of the name, the middle one, that of the section */
} attempt;

static void set_rational(arb_t x, const iso_rational *r, slong bits)
{
    arb_set_si(x, r->top);
    arb_div_si(x, x, r->below, bits);
}

/* The section belongs to the largest moment, for k < 0 to the smallest. */
static void attempt_init(attempt *a, iso_context *ctx, const iso_proof_ball *ball, int digits, iso_proof_work *work)
{
    enum { PARTS = 8 }; /* of half a return, for an interval of k */
    prove_flow *f = &a->flow;
    prove_flow_init(f, ctx, (slong)(3.33 * digits) + 40, work);
    ISO_BALLS(high);
    set_rational(f->k, &ball->k[0], f->bits);
    set_rational(high, &ball->k[1], f->bits);
    arb_union(f->k, f->k, high, f->bits);
    arb_inv(f->inverse_k, f->k, f->bits);
    double order[3];
    for (int i = 0; i < 3; i++) order[i] = iso_rational_double(&ball->J[i]) * (ball->k[0].top < 0 ? -1 : 1);
    sort_by(order, a->axes);
    for (int i = 0; i < 3; i++) set_rational(f->J[i], &ball->J[a->axes[i]], f->bits);
    arb_add(f->trace, f->J[0], f->J[1], f->bits);
    arb_add(f->trace, f->trace, f->J[2], f->bits);
    prove_flow_like(&a->thin, f, f->bits);
    if (!iso_proof_is_thin(ball)) {
        f->parts = PARTS;
        arb_get_mid_arb(a->thin.k, f->k);
        arb_inv(a->thin.inverse_k, a->thin.k, f->bits);
    }
    iso_balls_init(&a->local, sizeof a->local), iso_balls_init(&a->start, offsetof(prove_start, halves));
    iso_balls_init(&a->crossing, offsetof(prove_crossing, longer)), arb_init(a->width);
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
    arf_set_si_2exp_si(arb_midref(x), 1, (slong)floor(power * 3.3219280948873623));
}

/* The piece is at least as long as what is left of the change of the start with k, in all half returns, beside its
 * drift: of second order. *reached: m is enclosed. If not, but the piece came to the line, it was too short for its
 * noise: a longer one is tried. */
static iso_status enclose(attempt *a, bool *reached)
{
    enum { TRIES = 3 };
    prove_flow *f = &a->flow;
    ISO_BALLS(part);
    ISO_TRY(prove_local_begin(f, &a->local));
    ISO_TRY(prove_local_foresee(f, &a->local));
    ISO_TRY(prove_local_bound(f, &a->local));
    ISO_TRY(prove_search(&a->thin, &a->local, f->parts > 1, &a->start));
    const long begun = f->certificate ? ftell(f->certificate) : 0;
    arb_get_rad_arb(part, f->k);
    arb_mul_si(part, part, 4 * a->start.halves, MAG_BITS);
    arb_div(part, part, f->k, MAG_BITS);
    arb_mul(part, part, part, MAG_BITS);
    arb_get_mid_arb(part, part);
    if (arb_gt(part, a->width)) arb_set(a->width, part);
    *reached = false;
    a->crossing.longer = 0;
    for (int i = 0; i < TRIES && !*reached && (i == 0 || a->crossing.longer > 0); i++) {
        arb_mul_2exp_si(a->width, a->width, a->crossing.longer);
        arb_get_mid_arb(a->width, a->width);
        if (f->certificate) fseek(f->certificate, begun, SEEK_SET);
        ISO_TRY(prove_follow(f, &a->thin, &a->local, &a->start, a->width, &a->crossing, reached));
    }
    return ISO_OK;
}

/* --- what it found ---------------------------------------------------------------------------------------------- */

/* "[1.23 +/- 4e-5]" becomes "1.23 +/- 4e-5". */
static void write_enclosure(const arb_t x, int digits, iso_enclosure *e)
{
    arf_t end;
    arf_init(end);
    arb_get_lbound_arf(end, x, 64);
    e->low = arf_get_d(end, ARF_RND_FLOOR);
    arb_get_ubound_arf(end, x, 64);
    e->high = arf_get_d(end, ARF_RND_CEIL);
    arf_clear(end);
    char *text = arb_get_str(x, digits + 10, 0);
    const size_t length = strlen(text);
    const bool bracketed = text[0] == '[' && length > 2;
    const char *begin = bracketed ? text + 1 : text;
    snprintf(e->text, sizeof e->text, "%s%.*s", strncmp(begin, "+/-", 3) == 0 ? "0 " : "",
             (int)(bracketed ? length - 2 : length), begin);
    flint_free(text);
}

/* On the section n_a = 0 m_a = (x_g/x_a)^2 m_g, x_a^2 = 1 - x_g^2, by that of n_g = 0 (separatrix.c). */
static void fill(const attempt *a, int digits, iso_proof *p)
{
    const slong bits = a->flow.bits;
    const arb_srcptr section_x = a->crossing.x, section_m = a->crossing.m;
    ISO_BALLS(x, m, multiplier);
    arb_set(x, section_x), arb_set(m, section_m);
    p->middle = a->axes[1], p->section = a->axes[2];
    p->axis = (p->middle + 1) % 3;
    if (p->axis != p->section) {
        arb_mul(x, section_x, section_x, bits);
        arb_mul(m, section_m, x, bits);
        arb_sub_ui(x, x, 1, bits);
        arb_neg(x, x);
        arb_div(m, m, x, bits);
        arb_sqrt(x, x, bits);
        if (!arb_is_negative(section_x)) arb_neg(x, x);
    }
    arb_mul(multiplier, a->local.lambda, a->local.lambda, bits);
    write_enclosure(m, digits, &p->m), write_enclosure(x, digits, &p->x);
    write_enclosure(section_m, digits, &p->section_m), write_enclosure(multiplier, digits, &p->multiplier);
    p->sign = arb_is_positive(section_m) - arb_is_negative(section_m);
    p->digits = digits;
    p->halves = a->start.halves, p->steps = a->flow.steps + a->thin.steps;
    if (p->sign != 0)
        snprintf(p->statement, sizeof p->statement,
                 "proved: m is not 0, so the manifolds cross, and there is no further real-analytic integral");
    else
        snprintf(p->statement, sizeof p->statement, "undecided at %d digits: 0 is in the enclosure of m", digits);
}

/* The claim, then what was written while it was proved. */
static iso_status write_certificate(const attempt *a, const iso_proof *p, const char *body, size_t length,
                                    char **text)
{
    size_t size;
    FILE *to = open_memstream(text, &size);
    if (!to) return iso_context_no_memory(a->flow.ctx, "a certificate");
    char number[5][ISO_RATIONAL_SIZE];
    for (int i = 0; i < 2; i++) iso_rational_print(number[i], &p->ball.k[i]);
    for (int i = 0; i < 3; i++) iso_rational_print(number[2 + i], &p->ball.J[a->axes[i]]);
    prove_certificate_text(to, "isoroll certificate 1");
    prove_certificate_text(to, "k %s %s", number[0], number[1]);
    if (a->flow.parts > 1) {
        prove_certificate_line(to, "middle", 1, a->thin.k);
        prove_certificate_text(to, "parts %d", a->flow.parts);
    }
    prove_certificate_text(to, "moments %s %s %s", number[2], number[3], number[4]);
    prove_certificate_text(to, "section %d", p->section + 1);
    prove_certificate_text(to, "digits %d", p->digits);
    prove_certificate_line(to, "m", 1, a->crossing.m);
    prove_certificate_line(to, "x", 1, a->crossing.x);
    prove_certificate_text(to, "sign %s", p->sign > 0 ? "positive" : p->sign < 0 ? "negative" : "undecided");
    fwrite(body, 1, length, to);
    prove_certificate_text(to, "end");
    if (fclose(to) == 0) return ISO_OK;
    free(*text), *text = NULL;
    return iso_context_no_memory(a->flow.ctx, "a certificate");
}

/* --- as many as it takes ---------------------------------------------------------------------------------------- */

/* The digits that the radius of m lacks; 0: none. */
static int missing(const arb_t m, int digits)
{
    mag_t radius;
    mag_init_set(radius, arb_radref(m));
    const double log2_radius = mag_is_zero(radius) ? -INFINITY : mag_get_d_log2_approx(radius);
    mag_clear(radius);
    return (int)fmin(200, fmax(0, ceil(log2_radius * 0.3010299956639812 + digits)));
}

iso_status iso_proof_find(iso_context *ctx, const iso_proof_ball *ball, int digits, iso_proof_work *work,
                          iso_proof *proof, char **text)
{
    enum { TRIES = 5, FEWER = 1, SPARE = 11, MORE = 6 };
    const bool thin = iso_proof_is_thin(ball);
    const int tries = thin ? TRIES : FEWER; /* an interval is halved (prove.c) */
    int spare = SPARE;
    iso_status status = ISO_NUMERICAL;
    memset(proof, 0, sizeof *proof);
    proof->ball = *ball;
    for (int i = 0; i < tries && status == ISO_NUMERICAL; i++) {
        attempt a;
        bool reached = false;
        char *body = NULL;
        size_t length = 0;
        FILE *to = text ? open_memstream(&body, &length) : NULL;
        if (text && !to) return iso_context_no_memory(ctx, "a certificate");
        attempt_init(&a, ctx, ball, digits + spare, work);
        a.flow.certificate = a.thin.certificate = to;
        set_power(a.local.size, -(digits + spare - 1) / 3.0);
        set_power(a.width, -(digits + spare - 4));
        status = enclose(&a, &reached);
        const int lacks = reached ? missing(a.crossing.m, digits) : MORE;
        if (to && fclose(to) != 0) status = iso_context_no_memory(ctx, "a certificate");
        if (status == ISO_OK && !(reached && (lacks == 0 || !thin)))
            status = ISO_FAIL_NUMERICAL(ctx, "m could not be enclosed to %d digits", digits);
        if (status == ISO_OK) fill(&a, digits, proof);
        if (status == ISO_OK && text) status = write_certificate(&a, proof, body, length, text);
        spare += lacks + MORE / 2;
        free(body);
        attempt_clear(&a);
    }
    flint_cleanup();
    return status;
}

iso_status iso_proof_expect(iso_context *ctx, const iso_proof_ball *ball, iso_proof_work *work, double *decades)
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
    flint_cleanup();
    return status;
}

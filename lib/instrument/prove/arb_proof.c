/* arb_proof.c - one proof as text and numbers that need no Arb (prove_impl.h). */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "instrument/prove/arb_manifold_impl.h"
#include "instrument/prove/prove_impl.h"

bool iso_proof_is_possible(void)
{
    return true;
}

/* --- the ball --------------------------------------------------------------------------------------------------- */

/* In the order of the section: for k < 0 it belongs to the smallest moment. */
static void set_ball(const iso_proof_ball *ball, prove_ball *b)
{
    int axes[3] = {0, 1, 2}; /* of the smallest, the middle and the largest moment */
    fmpq_t J[3];
    for (int i = 0; i < 2; i++) fmpq_init(b->k[i]), fmpq_set_si(b->k[i], ball->k[i].top, (ulong)ball->k[i].below);
    for (int i = 0; i < 3; i++) fmpq_init(b->J[i]), fmpq_init(J[i]);
    for (int i = 0; i < 3; i++) fmpq_set_si(J[i], ball->J[i].top, (ulong)ball->J[i].below);
    for (int i = 0; i < 3; i++)
        for (int j = i + 1; j < 3; j++)
            if (fmpq_cmp(J[axes[i]], J[axes[j]]) > 0) {
                const int kept = axes[i];
                axes[i] = axes[j], axes[j] = kept;
            }
    const bool smallest = ball->k[0].top < 0;
    b->middle = axes[1];
    b->section = axes[smallest ? 0 : 2];
    fmpq_set(b->J[0], J[axes[smallest ? 2 : 0]]);
    fmpq_set(b->J[1], J[b->middle]);
    fmpq_set(b->J[2], J[b->section]);
    for (int i = 0; i < 3; i++) fmpq_clear(J[i]);
}

static void clear_ball(prove_ball *b)
{
    for (int i = 0; i < 2; i++) fmpq_clear(b->k[i]);
    for (int i = 0; i < 3; i++) fmpq_clear(b->J[i]);
}

/* --- enclosures ------------------------------------------------------------------------------------------------- */

/* "[1.23 +/- 4e-5]" becomes "1.23 +/- 4e-5". */
static void enclose(const arb_t x, int digits, iso_enclosure *e)
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
static void fill(const prove_ball *b, const prove_found *found, int digits, iso_proof *p)
{
    arb_ptr x = _arb_vec_init(2), m = x + 1;
    arb_set(x, found->x), arb_set(m, found->m);
    p->middle = b->middle, p->section = b->section;
    p->axis = (b->middle + 1) % 3;
    if (p->axis != p->section) {
        arb_mul(x, found->x, found->x, found->bits);
        arb_mul(m, found->m, x, found->bits);
        arb_sub_ui(x, x, 1, found->bits);
        arb_neg(x, x);
        arb_div(m, m, x, found->bits);
        arb_sqrt(x, x, found->bits);
        if (!arb_is_negative(found->x)) arb_neg(x, x);
    }
    enclose(m, digits, &p->m), enclose(x, digits, &p->x), enclose(found->m, digits, &p->section_m);
    enclose(found->multiplier, digits, &p->multiplier);
    p->sign = arb_is_positive(found->m) - arb_is_negative(found->m);
    p->digits = digits;
    p->halves = found->halves, p->steps = found->steps;
    if (p->sign != 0)
        snprintf(p->statement, sizeof p->statement,
                 "proved: m is not 0, so the manifolds cross, and there is no further real-analytic integral");
    else
        snprintf(p->statement, sizeof p->statement, "undecided at %d digits: 0 is in the enclosure of m", digits);
    _arb_vec_clear(x, 2);
}

/* --- the certificate -------------------------------------------------------------------------------------------- */

/* The claim, then what was written while it was proved. */
static char *write_certificate(const iso_proof *p, const prove_ball *b, const prove_found *found,
                               prove_certificate *body)
{
    prove_certificate all = {.text = NULL};
    char text[5][ISO_RATIONAL_SIZE];
    const int a = 3 - b->middle - b->section, order[3] = {a, b->middle, b->section};
    for (int i = 0; i < 2; i++) iso_rational_print(text[i], &p->ball.k[i]);
    for (int i = 0; i < 3; i++) iso_rational_print(text[2 + i], &p->ball.J[order[i]]);
    prove_certificate_text(&all, "isoroll certificate 1");
    prove_certificate_text(&all, "k %s %s", text[0], text[1]);
    if (found->parts > 1) {
        prove_certificate_line(&all, "middle", 1, found->middle);
        prove_certificate_text(&all, "parts %d", found->parts);
    }
    prove_certificate_text(&all, "moments %s %s %s", text[2], text[3], text[4]);
    prove_certificate_text(&all, "section %d", b->section + 1);
    prove_certificate_text(&all, "digits %d", p->digits);
    prove_certificate_line(&all, "m", 1, found->m);
    prove_certificate_line(&all, "x", 1, found->x);
    prove_certificate_text(&all, "sign %s", p->sign > 0 ? "positive" : p->sign < 0 ? "negative" : "undecided");
    prove_certificate_append(&all, body);
    prove_certificate_text(&all, "end");
    if (all.lost) free(all.text), all.text = NULL;
    return all.text;
}

iso_status iso_proof_find(iso_context *ctx, const iso_proof_ball *ball, int digits, iso_proof_work *work,
                          iso_proof *proof, char **text)
{
    prove_ball b;
    prove_found found;
    prove_certificate body = {.text = NULL};
    memset(proof, 0, sizeof *proof);
    proof->ball = *ball;
    set_ball(ball, &b);
    iso_balls_init(&found, offsetof(prove_found, parts));
    iso_status status = prove_ball_at(ctx, &b, digits, work, text ? &body : NULL, &found);
    if (status == ISO_OK) fill(&b, &found, digits, proof);
    if (status == ISO_OK && text) *text = write_certificate(proof, &b, &found, &body);
    if (status == ISO_OK && text && !*text) status = iso_context_no_memory(ctx, "a certificate");
    free(body.text);
    iso_balls_clear(&found, offsetof(prove_found, parts));
    clear_ball(&b);
    flint_cleanup();
    return status;
}

iso_status iso_proof_expect(iso_context *ctx, const iso_proof_ball *ball, iso_proof_work *work, double *decades)
{
    prove_ball b;
    set_ball(ball, &b);
    const iso_status status = prove_ball_expect(ctx, &b, work, decades);
    clear_ball(&b);
    flint_cleanup();
    return status;
}

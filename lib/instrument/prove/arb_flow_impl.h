/* arb_flow_impl.h - the free ball in arc length, enclosed: Taylor series with bounds for what is left out, half
 * returns.
 *
 * The orbit is the curve gamma(s) on the sphere, s its arc length. u = gamma', b = gamma x u, and
 *
 *     gamma' = u,   u' = -gamma + kappa b,   b' = -kappa u,   kappa = -(J gamma, b)/(k q),   q = (gamma, J gamma).
 *
 * There are no clocks, and for every k the right side is rational. The moments are carried as they are seen from the
 * frame (gamma, u, b), and one row of the frame, that of the section's axis c:
 *
 *     q = (gamma, J gamma), r = (J gamma, u), p = (J gamma, b), f = (u, J u), d = (u, J b);  g = gamma_c, w = u_c,
 *     z = b_c.     With e = (b, J b) = tr J - q - f:
 *     q' = 2 r,   r' = f - q + kappa p,   p' = d - kappa r,   f' = 2 (kappa d - r),   d' = kappa (e - f) - p,
 *     g' = w,     w' = kappa z - g,       z' = -kappa w,      k q kappa = -p.
 *
 * A neighbouring orbit at the distance y (to first order, along b; v = y'):
 *
 *     y' = v,   v' = rho v - H y,   k q rho = r,   H = 1 + (1 - 2 k) kappa^2 + (e - q)/(k q).
 *
 * For the orbit of k + dk, v' = rho v - H y - (kappa/k) dk.
 *
 * The set (q, ..., z) does not distinguish (gamma, u) from its images under half turns about c: l is known modulo pi.
 */
#ifndef ISO_INSTRUMENT_PROVE_ARB_FLOW_IMPL_H
#define ISO_INSTRUMENT_PROVE_ARB_FLOW_IMPL_H

#include <stdbool.h>

#include "base/arb_impl.h"
#include "base/context_impl.h"
#include "instrument/prove/prove_impl.h"
#include "method/enclosure/arb_tape_impl.h"

/* --- the certificate of a proof, a stream in memory (lib/doc/prove.md, arb_certificate.c) ------------------------- */

/* A line of text, as printf makes it. c NULL: nothing is done, here and below. */
void prove_certificate_text(FILE *c, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/* A line: a word, then balls, exactly. */
void prove_certificate_line(FILE *c, const char *word, int count, arb_srcptr x);

/* --- the orbit --------------------------------------------------------------------------------------------------- */

/* The numbers of a state, its two neighbours of the same k, and its neighbour of another k. */
enum { PROVE_Q, PROVE_R, PROVE_P, PROVE_F, PROVE_D, PROVE_G, PROVE_W, PROVE_Z, PROVE_POINT };
enum { PROVE_Y1 = PROVE_POINT, PROVE_V1, PROVE_Y2, PROVE_V2, PROVE_PAIR };
enum { PROVE_Y3 = PROVE_PAIR, PROVE_V3, PROVE_STATE };

/* A ball, its moments in the order of the section: J[2] belongs to the axis c of the section, J[1] is the middle one.
 * k may be an interval. Then half a return is followed in parts, after each of which there is a new set. */
typedef struct prove_flow {
    arb_t k, inverse_k, J[3], trace;
    iso_context *ctx;
    slong bits;
    int parts;            /* of half a return; the derivative is enclosed in each      */
    int numbers;          /* of the states in the tape: PROVE_POINT, PROVE_PAIR, PROVE_STATE; 0: no tape yet */
    iso_tape tape;        /* the equations                                                                   */
    iso_series series;    /* from the last state on                                                          */
    FILE *certificate;    /* NULL: none                                                 */
    long steps;           /* taken so far                                               */
    iso_proof_work *work; /* shared by all flows of a proof                               */
} prove_flow;

/* The ball is set behind prove_flow_init, before the first step. */
void prove_flow_init(prove_flow *f, iso_context *ctx, slong bits, iso_proof_work *work);
void prove_flow_clear(prove_flow *f);

/* The same ball in numbers of other length; no certificate. */
void prove_flow_like(prove_flow *f, const prove_flow *like, slong bits);

/* f->series of the orbit that begins in y. */
void prove_flow_expand(prove_flow *f, arb_srcptr y, int numbers);

/* A step for which what is left out is about a rounding error. No proof needs it to be so. */
double prove_flow_guess_step(const prove_flow *f);

/* Makes a ball larger by 2^-part of its radius, and by some rounding errors: so a checker that rounds in another way
 * finds its own ball inside. */
void prove_widen(const prove_flow *f, slong part, arb_t x);
enum { PROVE_EIGHTH = 3 };

/* The angle psi of a state: (gamma_c, u_c) = X (sin psi, cos psi), X > 0. It grows by pi in half a return. The great
 * circle through gamma along u begins, at psi = 0, at a point (l, x) of gamma_c = 0: so (l, x, psi) is a chart of all
 * states. The antipode is (l, x, psi - pi). */
typedef struct prove_part {
    int number, parts; /* from psi = number pi/parts to the next one; {0, 1}: half a return */
} prove_part;

/* From (l, x) at one angle to (l, x) at the next one; its derivative; the time of the crossing; the window, in which
 * each orbit of the set has one crossing and no more. */
typedef struct prove_half {
    arb_struct z[2]; /* l modulo pi, x                                                            */
    arb_struct D[6]; /* its derivatives by l, x and k: dl/dl, dl/dx, dx/dl, dx/dx; dl/dk, dx/dk    */
    arb_t time, window;
} prove_half;

/* numbers: PROVE_POINT: no derivative; PROVE_PAIR: none by k. Errors: ISO_NUMERICAL: the set is too large;
 * it is one more than f->work allows; ISO_STOPPED. */
iso_status prove_half_return(prove_flow *f, prove_part part, const arb_t l, const arb_t x, int numbers,
                             prove_half *half);

#endif

/* arb_certify_impl.h - what certified orbits are made of: exact numbers, equations, sets that move, decimal text.
 *
 *     arb_exact.c      the numbers of a scene as fractions, and in balls; the start
 *     arb_equations.c  (9) and (24) as tapes; the map (18) in balls
 *     arb_set.c        a set of states, carried by steps
 *     arb_orbit.c      the rows of a scene
 *     arb_text.c       balls as decimal numbers
 *     arb_convert.c    rows of one model as rows of the other
 */
#ifndef ISO_INSTRUMENT_CERTIFY_ARB_CERTIFY_IMPL_H
#define ISO_INSTRUMENT_CERTIFY_ARB_CERTIFY_IMPL_H

#include <stdio.h>

#include "instrument/certify/certify_impl.h"
#include "method/enclosure/arb_tape_impl.h"

/* --- arb_exact.c ------------------------------------------------------------------------------------------------- */

/* What the scene writes. vector: omega or M, unit: n or gamma, as written. */
typedef struct certify_exact {
    fmpq_t k, J[3], K[3], c, eps, vector[3], unit[3];
    iso_model_kind model;
    bool rotor, level, has_eps; /* level: c is written, or eps of a point, whose c then follows */
} certify_exact;

void certify_exact_init(certify_exact *e);
void certify_exact_clear(certify_exact *e);

/* Errors: ISO_BAD_INPUT about a key. */
iso_status certify_exact_read(iso_context *ctx, const iso_scene *scene, const iso_literals *literals,
                              certify_exact *e);

/* Reads a decimal number or a fraction. False: it is none, or its exponent is above 5000. */
bool certify_rational_read(const char *text, fmpq_t x);

/* The same in balls, which come first: iso_balls_init(&ball, offsetof(certify_ball, bits)). */
typedef struct certify_ball {
    arb_struct J[3], root_J[3], inverse_J[3], K[3]; /* K: of the rotor                    */
    arb_t k, det, kappa, half;                      /* det J; k^2/det J; 1/(2k)           */
    arb_t c, h, eps;                                /* of the level; energy of the ball; coupling of the point */
    slong bits;
    bool rotor, level;
} certify_ball;

void certify_ball_set(certify_ball *b, const certify_exact *e); /* k and J alone */

/* Sets b, its energies among it, and returns the start of `model` in y, vector first, then the unit vector: n is made
 * a unit vector, and omega loses its part along it. */
void certify_start(const certify_exact *e, iso_model_kind model, certify_ball *b, arb_ptr y);

/* --- arb_equations.c --------------------------------------------------------------------------------------------- */

enum { CERTIFY_STATE = 6, CERTIFY_CLOCKS = 2, CERTIFY_ALL = CERTIFY_STATE + CERTIFY_CLOCKS };

/* The equations of a model, in one of the clocks t and s. States: vector, unit vector, then the two other clocks in the
 * order t, tau, s. */
void certify_equations(const certify_ball *b, iso_model_kind model, iso_clock clock, iso_tape *f);

/* The sum of weight_i u_i^2. */
void certify_weigh(const certify_ball *b, const arb_struct weight[3], arb_srcptr u, arb_t sum);

/* The state of the other model (18). `from` and `to` may be the same. */
void certify_map(const certify_ball *b, iso_model_kind from, arb_srcptr y, arb_ptr to);

/* --- arb_set.c --------------------------------------------------------------------------------------------------- */

/* The states centre + S A v, |v_i| <= r_i, at the time `time`: centre, S (powers of 2) and A are exact, and A is about
 * orthogonal. The other clocks are balls. */
typedef struct certify_set {
    arb_t clock[CERTIFY_CLOCKS], time, h;
    iso_series thin, wide; /* of the centre; of all of the set, with the first variation */
    iso_tape thin_tape, wide_tape;
    arb_ptr centre;
    arb_mat_t A;
    mag_struct r[CERTIFY_STATE];
    slong shift[CERTIFY_STATE]; /* S_ii = 2^shift */
    int direction;              /* 1, -1 */
} certify_set;

/* The monitor is asked many times in a step. After it has stopped the work, nothing of the set is valid. */
void certify_set_init(certify_set *s, const certify_ball *b, iso_model_kind model, iso_clock clock, arb_srcptr start,
                      int direction, iso_monitor monitor);
void certify_set_clear(certify_set *s);

typedef enum certify_step {
    CERTIFY_STEP,
    CERTIFY_TOO_WIDE,  /* the set is too large               */
    CERTIFY_TOO_SHORT, /* the step does not fit a double     */
    CERTIFY_STOPPED    /* by the monitor                     */
} certify_step;

/* Finds a step h <= most, or so, from here: all solutions of the set are there. */
certify_step certify_set_expand(certify_set *s, double most);

/* The part of the work of the step that is done. */
double certify_set_done(const certify_set *s);

/* The set at a time within this step: state, then clocks. False: the time is beyond it. */
bool certify_set_at(certify_set *s, const arb_t time, arb_ptr y);

/* Goes to the end of the step. */
void certify_set_move(certify_set *s);

/* The digits that have been lost: log10 of the largest r, and of the bits. */
double certify_set_lost(const certify_set *s);

/* --- arb_orbit.c ------------------------------------------------------------------------------------------------- */

/* Closes a stream in memory, passes its text to the sink and frees it. */
iso_status certify_pass(iso_context *ctx, const iso_certify_sink *sink, FILE *to, char **text);

/* The line of the names of the columns: three clocks, then the states of these models. */
void certify_print_columns(FILE *to, iso_models as);

/* A row of a state of `model` at the clocks t, tau, s. Whether all its numbers have so many digits, counted from the
 * largest number of each vector. */
bool certify_write_row(const certify_ball *b, arb_srcptr clock, iso_model_kind model, arb_srcptr y, iso_models as,
                       int digits, FILE *to);

/* --- arb_text.c -------------------------------------------------------------------------------------------------- */

/* A bound e of a group of numbers: 10^e <= the largest of |midpoint|; 0 if they are all 0. */
slong certify_magnitude(arb_srcptr x, int count);

/* Whether all radii are at most 10^place/2. */
bool certify_holds(arb_srcptr x, int count, slong place);

/* Midpoint and radius, `between` them: the midpoint as a multiple of 10^place, the radius rounded up. */
void certify_print(FILE *to, const arb_t x, slong place, char between);

#endif

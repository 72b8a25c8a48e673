/* slopes.c - the Jacobian of the equations of motion, from their own recurrences.
 *
 * On the line y + x e_j the right-hand side is the series f(y) + x df/dy_j + ... in x. So set coefficient 0 of the
 * states to y and coefficient 1 to e_j: coefficient 1 of f is then column j of the Jacobian. The terms put
 * coefficient n of f, in the place of coefficient n + 1 of the states, divided by n + 1. Here all of these divisors
 * are set to 1, so that place 2 holds the column itself. LANES columns are computed side by side.
 */
#include "model/series/double_impl.h"

#define LANES 4

enum { KEPT = 4 }; /* two more than the highest order, 1, and 0 */

#include "model/model_impl.h"
#include "model/series/recurrences_impl.h"

bool iso_system_has_recurrences(const iso_system *s)
{
    return s == &iso_system_ball || s == &iso_system_point || s == &iso_system_point_in_t;
}

static void call_system(series *S, const iso_model *m)
{
    const iso_problem *f = &m->problem;
    S->formula = NULL;
    if (m->system == &iso_system_ball) {
        set_ball_recurrences(S, iso_effects_twist(&f->effects), f->motion.lines > 0 ? &f->motion : NULL, NULL);
    } else if (m->system == &iso_system_point_in_t) {
        set_recurrences(S, 1, (recurrences){{point_p}});
    } else {
        S->formula = f->energy_formula.lines > 0 ? &f->energy_formula : NULL;
        set_recurrences(S, 1,
                        (recurrences){{point_24, S->formula ? point_24_effects : NULL,
                                       S->formula && S->formula->magnetic ? point_24_magnetic : NULL}});
    }
}

/* The terms of the system and its effects, and the numbers in them. */
static void begin(series *S, const iso_model *m)
{
    const iso_params *p = &m->problem.p;
    const bool is_t = m->system == &iso_system_point_in_t;
    call_system(S, m);
    for (int i = 0; i < KEPT; i++) S->count[i] = S->inverse[i] = broadcast(1); /* in place of n and 1/n: see above */
    for (int lane = 0; lane < LANES; lane++) set_ball(S, lane, p, S->formula);
    S->alpha = broadcast(is_t ? 1 / sqrt(p->det_J) : -1 - 1 / p->k);
    S->coupling = broadcast(2 * m->problem.eps / p->k);
}

/* Where coefficient n of state y[i] stands; NULL: no equation of motion has to do with it. */
static real *coefficients(series *S, const iso_formula *F, int i, int n)
{
    if (i < 3) return &AT(S->w[n], i);
    if (i < ISO_STATE) return &AT(S->n[n], i - 3);
    for (int s = 0; s < F->states; s++) {
        const int at = F->state[s].at, node = F->state[s].node * KEPT + n;
        if (F->state[s].is_vector && i >= at && i < at + 3) return &AT(S->vector[node], i - at);
        if (!F->state[s].is_vector && i == at) return &S->scalar[node];
    }
    return NULL;
}

/* y as coefficients 0, and the directions first, first + 1, ... as coefficients 1, one in each lane. */
static void set_states(series *S, const iso_model *m, const double y[], int first)
{
    for (int i = 0; i < m->moving; i++) {
        real *at = coefficients(S, &m->problem.motion, i, 1);
        if (!at) continue;
        *coefficients(S, &m->problem.motion, i, 0) = broadcast(y[i]);
        for (int lane = 0; lane < LANES; lane++) LANE(*at, lane) = i == first + lane;
    }
}

/* The terms in their order give coefficient n + 1 of all states. */
static void call_terms(series *S, int n)
{
    for (int i = 0; i < S->terms; i++) S->term[i](S, 0, n);
}

void iso_model_rhs_of_recurrences(const iso_model *m, const double y[], double dy[])
{
    series S;
    begin(&S, m);
    set_states(&S, m, y, m->moving); /* no direction */
    call_terms(&S, 0);
    for (int i = 0; i < m->moving; i++) {
        const real *rate = coefficients(&S, &m->problem.motion, i, 1);
        dy[i] = rate ? LANE(*rate, 0) : 0;
    }
}

void iso_model_slopes(const iso_model *m, const double y[], double jac[])
{
    series S;
    begin(&S, m);
    for (int first = 0; first < m->moving; first += LANES) {
        set_states(&S, m, y, first);
        call_terms(&S, 0);
        set_states(&S, m, y, first); /* call_terms has written the rates there */
        call_terms(&S, 1);
        for (int i = 0; i < m->moving; i++) {
            const real *slope = coefficients(&S, &m->problem.motion, i, 2);
            for (int lane = 0; lane < LANES && first + lane < m->moving; lane++)
                jac[m->moving * i + first + lane] = slope ? LANE(*slope, lane) : 0;
        }
    }
}

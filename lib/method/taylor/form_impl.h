/* form_impl.h - prepares a series: its terms, its numbers, and its first coefficients from a state. */
#include "model/model_impl.h"

enum { MOST = FINEST_ORDER, KEPT = MOST + 3 }; /* the highest order, that of the least tolerance */
#include "method/taylor/quadrature_impl.h"
#include "method/taylor/written_impl.h"

enum { SLOTS = 3 }; /* room for channels 0 to 2, also if there are fewer */

/* A state, in the own variable of a form: of a point n = gamma, w = gamma'. */
typedef struct state {
    real n[3], w[3], clock[ISO_CLOCKS];
    real own[ISO_MOST_EFFECT_STATES]; /* of effects, as in y: own[i] is y[ISO_STATE + i] */
} state;

/* A unit vector: its first number in `own`, how many it has, and whether it acts on the motion. */
typedef struct unit_state {
    int at, size;
    bool acts;
} unit_state;

/* One orbit in each lane. All have the same shape: the same system, effects and clocks, and all have k = -1 or none
 * has. `own` is the variable of the series. If the model has another clock, that clock is a series in `own`. */
typedef struct form {
    iso_model shape;
    const iso_model *model[LANES]; /* each orbit's own, with its numbers            */
    iso_inside *inside;            /* expressions that the scene writes, or NULL    */
    bool flat;                     /* these are of low degree: in all lanes, as their formulas are alike */
    bool idle[LANES];              /* nobody asks for the lane's orbit              */
    iso_formula motion;            /* the equations of the ball's effects           */
    iso_clock own;
    bool is_point, is_point_in_t, in_t, in_field, is_neumann, twists, has_derived, unprojected;
    bool loaded;                                              /* a ball with torques, or free to twist         */
    enum second_integral_of { NONE, SHELL, PLANE } second_of; /* the second integral that steps keep */
    double tolerance;                /* of the last terms, in units of the state                             */
    double at_poles;                 /* the same of 1/g of a ball, see for_poles                             */
    real second;                     /* the second integral at the start                                     */
    real c[ISO_FORMULA_CONSTANTS];   /* of the energy of the effects                                         */
    real range;                      /* how large their potential can be, at least; see iso_effects_largest  */
    real twice_energy, keeps_energy; /* of a loaded ball at the start; 1 where it is conserved, else 0       */
    real speed_square;               /* of a loaded ball: of the start, plus what the potential can give       */
    int units;                       /* unit vectors among the states of effects */
    unit_state unit[ISO_MOST_EFFECT_STATES];
    quadrature rule;
    int clocks; /* those that are not the own */
    iso_clock clock_of[ISO_CLOCKS];
    real rate[ISO_CLOCKS], power[ISO_CLOCKS]; /* clock' = rate base^power, base = q of a point, g of a ball */
    union {
        state now;            /* at the end of the last step */
        state channel[SLOTS]; /* channel 0 is `now`, the others are deviations (deviations_impl.h), divided */
    };
    real scale[SLOTS];      /* by exp(scale)                             */
    real clock[ISO_CLOCKS]; /* at its beginning */
    series S;               /* last: its coefficients need not be cleared */
} form;

/* --- the terms that a model needs ------------------------------------------------------------------------------- */

static void expand_as_ball(form *T)
{
    const iso_problem *f = &T->shape.problem;
    if (!iso_effects_none(&f->effects)) iso_effects_record_motion(f, true, &T->motion);
    for (int e = 0; e < ISO_EFFECTS; e++)
        T->has_derived = T->has_derived || (f->at[e] > 0 && iso_effect_list[e]->states->kind == ISO_STATE_DERIVED);
    set_ball_recurrences(&T->S, T->twists, T->motion.lines > 0 ? &T->motion : NULL,
                         T->twists ? poles_of_twisting : poles_of_rigid);
}

/* A free point on H = 0 is expanded in the ball's time, where the powers of q cancel. At k = -1 its equations are
 * polynomials in s. */
static void expand_as_point(form *T)
{
    series *S = &T->S;
    const iso_problem *f = &T->shape.problem;
    S->formula = T->in_field ? &T->shape.problem.energy_formula : NULL;
    T->is_neumann = f->p.k == -1 && !T->in_field;
    T->in_t = !T->in_field && f->energy == 0 && T->shape.clock == ISO_CLOCK_T && f->p.k != -1;
    recurrence *const motion = T->in_t ? point_t : T->is_neumann ? neumann : point_s;
    set_recurrences(S, motion == point_s ? 1 : 2,
                    (recurrences){{motion, T->in_field ? point_effects : NULL,
                                   T->in_field && S->formula->magnetic ? magnetic : NULL}});
    if (!T->in_field) S->written = written_of(motion);
}

static void find_units(form *T)
{
    const iso_problem *f = &T->shape.problem;
    for (int e = 0; T->motion.states > 0 && e < ISO_EFFECTS; e++) {
        if (f->at[e] == 0) continue; /* it has no states */
        int at = f->at[e] - ISO_STATE;
        for (const iso_effect_state *i = iso_effect_list[e]->states; i->name; i++) {
            if (i->there && !i->there(f)) continue;
            if (i->kind == ISO_STATE_UNIT)
                T->unit[T->units++] = (unit_state){at, i->count, !iso_effect_list[e]->observes};
            at += i->count;
        }
    }
}

/* The order that takes the least work for a tolerance: 6 to 28 in doubles. Measured: an order that is 4 higher or
 * lower takes 10 % more. Coefficients of Neumann's problem are cheap: its order is 4 higher, but less near 1e-13.
 * Series that are written out take the least time, down to 1e-11, with orders 1 or 2 lower: even ones, as coefficients
 * come in pairs. */
static int order_for(const form *T)
{
    const double digits = -log10(T->tolerance), more = T->is_neumann ? fmin(4, fmax(0, 0.8 * (13 - digits))) : 0;
    int order = (int)lrint(4 + 1.6 * digits + more);
    if (T->S.written && digits <= 11) order -= 2 - order % 2;
    return order < 6 ? 6 : order > MOST ? MOST : order;
}

static void set_shape(form *T, const iso_model *m, iso_inside *inside, double tolerance)
{
    series *S = &T->S;
    memset(T, 0, offsetof(form, S) + offsetof(series, K));
    T->shape = *m;
    T->inside = inside;
    T->flat = inside && iso_inside_flat(inside, &m->problem);
    T->tolerance = tolerance * FINER;
    T->is_point_in_t = m->system == &iso_system_point_in_t;
    T->at_poles = pow(T->tolerance, 0.75);
    T->is_point = m->system == &iso_system_point;
    T->in_field = T->is_point && m->problem.energy_formula.lines > 0;
    T->twists = !T->is_point && !T->is_point_in_t && iso_effects_twist(&m->problem.effects);
    T->loaded = !T->is_point && !T->is_point_in_t && (m->problem.motion.torques || T->twists);
    if (T->is_point ? !T->in_field : !T->is_point_in_t && !T->loaded)
        T->second_of = m->problem.p.k == -1 ? SHELL : m->problem.p.k == 1 ? PLANE : NONE;
    set_counts(S);
    if (T->is_point_in_t)
        set_recurrences(S, 1, (recurrences){{point_p}});
    else
        T->is_point ? expand_as_point(T) : expand_as_ball(T);
    find_units(T);
    S->order = order_for(T);
    T->own = T->is_point && !T->in_t ? ISO_CLOCK_S : ISO_CLOCK_T;
    for (int i = -1; i < m->clocks; i++) {
        const iso_clock clock = i < 0 ? m->clock : m->clock_of[i];
        if (clock != T->own) T->clock_of[T->clocks++] = clock;
    }
    if (T->clocks > 0) make_rule(&T->rule);
}

/* --- the numbers of one orbit ----------------------------------------------------------------------------------- */

static void set_numbers(form *T, int lane, const iso_model *m)
{
    const iso_problem *f = &m->problem;
    series *S = &T->S;
    const bool as_ball = S->formula && !T->is_point;
    iso_formula motion; /* the same lines as the shape's, with the numbers of this orbit */
    if (as_ball) iso_effects_record_motion(f, true, &motion);
    set_ball(S, lane, &f->p, as_ball ? &motion : S->formula ? &f->energy_formula : NULL);
    const NUMBER k = f->p.k, eps = f->eps, J[3] = {f->p.J[0], f->p.J[1], f->p.J[2]};
    const NUMBER factor = J[0] * J[1] * J[2] / (k * k);
    LANE(S->energy, lane) = f->energy;
    /* in t, with eps = h det J/k^2: B = 2 h k/det J */
    LANE(S->alpha, lane) = T->in_t ? 1 + 1 / (2 * k) : -1 - 1 / k;
    LANE(S->coupling, lane) = T->in_t ? 2 * eps / (k * factor * factor) : 2 * eps / k;
    if (T->is_point_in_t)
        LANE(S->alpha, lane) = 1 / ROOT(J[0] * J[1] * J[2]), LANE(S->coupling, lane) = 2 * eps / factor;
    for (int i = 0; i < 3; i++)
        if (T->is_neumann) LANE(AT(S->neumann_c, i), lane) = 2 * eps / k * J[i] + 2 * f->energy;
    for (int i = 0; i < T->clocks; i++) { /* clock' = rate base^power: q = base for a point, 1/base for a ball */
        const iso_clock clock = T->clock_of[i];
        double e, e_own;
        iso_clock_rate(&f->p, clock, 1, &e);
        iso_clock_rate(&f->p, T->own, 1, &e_own);
        LANE(T->rate[clock], lane) = (clock == ISO_CLOCK_S ? 1 / factor : 1) * (T->own == ISO_CLOCK_S ? factor : 1);
        LANE(T->power[clock], lane) = T->is_point || T->is_point_in_t ? e - e_own : e_own - e;
    }
    if (f->energy_formula.lines > 0) set_constants(&f->energy_formula, &f->p, lane, T->c);
}

/* --- from a state ------------------------------------------------------------------------ */

static void cross_product(const real a[], const real b[], real c[])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static real q_of(const series *S, const real gamma[])
{
    real q = zero;
    for (int i = 0; i < 3; i++) q += gamma[i] * AT(S->J, i) * gamma[i];
    return q;
}

/* d(own variable)/ds of a point at gamma */
static real pace(const form *T, const real gamma[])
{
    if (!T->in_t) return broadcast(1);
    return T->S.factor * raised(q_of(&T->S, gamma), -1 - 1 / (2 * T->S.k));
}

/* T->now from y, in one lane. A point's M becomes gamma' = gamma x M in s. */
static inline void load(form *T, int lane, const double y[])
{
    const iso_model *m = &T->shape;
    state *s = &T->now;
    (void)lane;
    for (int i = 0; i < 3; i++) {
        LANE(s->w[i], lane) = y[i];
        LANE(s->n[i], lane) = y[3 + i];
    }
    for (int i = ISO_STATE; i < m->moving; i++) LANE(s->own[i - ISO_STATE], lane) = y[i];
    if (T->is_point) {
        const real speed = pace(T, s->n);
        real turned[3];
        cross_product(s->n, s->w, turned);
        for (int i = 0; i < 3; i++) LANE(s->w[i], lane) = LANE(turned[i], lane) / LANE(speed, lane);
    }
    for (int i = 0; i < m->clocks; i++) LANE(s->clock[m->clock_of[i]], lane) = y[m->moving + i];
}

static vector packed(const real a[3])
{
    vector v = nought;
    for (int i = 0; i < 3; i++) AT(v, i) = a[i];
    return v;
}

/* Coefficients 0 of all channels. The point's gamma' becomes coefficient 1 of gamma. */
static inline void begin(form *T)
{
    series *S = &T->S;
    for (int c = 0; c < CHANNELS; c++) {
        const state *s = &T->channel[c];
        S->n[place(c, 0)] = packed(s->n);
        *(T->is_point ? &S->n[place(c, 1)] : &S->w[place(c, 0)]) = packed(s->w);
        for (int i = 0; i < T->motion.states; i++) {
            const int at = T->motion.state[i].at - ISO_STATE, first = T->motion.state[i].node * ROOM + place(c, 0);
            if (T->motion.state[i].is_vector)
                S->vector[first] = packed(s->own + at);
            else
                S->scalar[first] = s->own[at];
        }
    }
    memcpy(T->clock, T->now.clock, sizeof T->clock);
}

static inline real inner3(const real a[], const real b[])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* a += factor b */
static inline void add_times(real a[], real factor, const real b[])
{
    for (int i = 0; i < 3; i++) a[i] += factor * b[i];
}

static inline double length3(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

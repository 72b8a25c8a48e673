/* restore_impl.h - brings a state back to its constraints and integrals after a step.
 *
 * A defect is the difference between an integral and its value. It is computed as if exactly, then rounded once. If
 * it were rounded on the way, each step would turn the state the same way, and the phase would drift like t^2.
 */
#include "method/taylor/step_impl.h"
#include "model/model_impl.h"

/* (a,b) - target, rounded once (algorithm Dot2 of Ogita, Rump and Oishi). */
static inline real defect_of(const real a[], const real b[], int count, real target)
{
    real sum = -target, lost = zero;
    for (int i = 0; i < count; i++) {
        const real p = a[i] * b[i], p_lost = lost_in(a[i], b[i], p);
        const real next = sum + p, part = next - sum;
        lost += ((sum - (next - part)) + (p - part)) + p_lost;
        sum = next;
    }
    return sum + lost;
}

/* Scales a so that |a|^2 is the target, in the lanes that are `wanted`. Returns the relative correction. */
static inline real restore_length(real a[], int count, real target, mask wanted)
{
    real worst = zero;
    for (int pass = 0; pass < 3 && any(wanted); pass++) {
        const real part = choose(wanted, defect_of(a, a, count, target) / (2 * target), zero);
        for (int i = 0; i < count; i++) a[i] -= part * a[i];
        worst += magnitude(part);
        wanted = both(wanted, magnitude(part) >= broadcast((NUMBER)1e-9));
    }
    return worst;
}

/* The potential of the effects at n (gamma), with base g (q). Also the sum of the sizes of its terms and, for a
 * point, its gradient. */
static real potential_at(const form *T, const real n[3], real base, const state *s, real *size, vector *gradient)
{
    const iso_formula *F = &T->shape.problem.energy_formula;
    real scalar[ISO_FORMULA_SCALARS], potential = zero, magnetic = zero;
    vector vectors[ISO_FORMULA_VECTORS];
    const nodes t = {.kept = 1,
                     .c = T->c,
                     .scalar = scalar,
                     .vector = vectors,
                     .gradient = gradient,
                     .potential = &potential,
                     .magnetic = &magnetic,
                     .size = size};
    *size = zero;
    *gradient = nought;
    scalar[ISO_GIVEN_BASE] = base;
    vectors[ISO_GIVEN_N] = packed(n);
    vectors[ISO_GIVEN_OMEGA] = packed(s->w);
    vectors[ISO_GIVEN_U] = by(T->S.inv_J, vectors[ISO_GIVEN_N]);
    for (int i = 0; i < F->states; i++) {
        const real *own = s->own + F->state[i].at - ISO_STATE;
        if (F->state[i].is_vector)
            vectors[F->state[i].node] = packed(own);
        else
            scalar[F->state[i].node] = *own;
    }
    evaluate(F, &t, false, 0, 0);
    return potential;
}

/* |gamma'|^2 on the level: 2 (E - V) in s, B k q^2 in t. *terms: the sum of the sizes of its terms. */
static real square_of_speed(const form *T, const state *s, real *terms)
{
    const real *gamma = s->n;
    const series *S = &T->S;
    const real q = q_of(S, gamma);
    *terms = zero;
    if (T->in_t) return S->coupling * S->k * q * q;
    const real fall = raised(q, -1 / S->k), own = S->coupling * S->k * fall;
    *terms = magnitude(2 * S->energy) + magnitude(own);
    if (!T->in_field) return 2 * S->energy + own;
    real size;
    vector gradient;
    const real V = potential_at(T, gamma, q, s, &size, &gradient);
    *terms += 2 * size;
    return 2 * S->energy + own - 2 * V;
}

/* The second integral F of a free orbit as sum_i a_i b_i = F divisor, and how the sum changes as w moves along
 * `across`, which touches no other integral. Left alone F goes at random by a rounding error a step, the frequencies
 * with it, and the phase like t^(3/2).
 *     k = -1   point, in s: (M,JM)/det J + 2 eps (gamma,J^-1 gamma), M = gamma' x gamma
 *              ball:        [ (K,K) + 2 h det J (u,u) ]/g,  K = Jw,  u = J^-1 n,  g = (n,u)
 *     k = 1    point, in s: (gamma',J^-1 gamma') + 2 H (gamma,J^-1 gamma);  in t, H = 0: (gamma',J^-1 gamma')/q^3
 *              ball:        (K x n, K x n) */
typedef struct second_integral {
    int count;
    real a[6], b[6], divisor, across[3], slope;
} second_integral;

static void second_of_point(const form *T, const state *s, second_integral *F)
{
    const series *S = &T->S;
    real M[3];
    F->count = 6;
    F->divisor = broadcast(1);
    cross_product(s->w, s->n, M);
    cross_product(s->n, s->w, F->across);
    for (int i = 0; i < 3; i++) {
        const real J = AT(S->J, i), inv_J = AT(S->inv_J, i);
        F->a[i] = T->second_of == SHELL ? M[i] : s->w[i];
        F->b[i] = T->second_of == SHELL ? J * S->over_det * M[i] : inv_J * s->w[i];
        F->a[3 + i] = s->n[i];
        F->b[3 + i] = (T->second_of == SHELL ? -S->coupling : 2 * S->energy) * inv_J * s->n[i]; /* here -2 eps */
        F->slope += 2 * F->b[i] * (T->second_of == SHELL ? s->w[i] : F->across[i]);
    }
    if (!T->in_t) return;
    const real q = q_of(S, s->n);
    F->count = 3;
    F->divisor = q * q * q;
}

/* a x b, each component to about one rounding (Kahan's difference of products), even where a and b are nearly
 * parallel. */
static inline void cross_product_exactly(const real a[], const real b[], real c[])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        const real back = a[l] * b[j], lost = -lost_in(a[l], b[j], back);
        c[i] = fused(a[j], b[l], -back) + lost;
    }
}

static void second_of_ball(const form *T, const state *s, second_integral *F)
{
    const series *S = &T->S;
    real K[3], change[3];
    for (int i = 0; i < 3; i++) K[i] = AT(S->J, i) * s->w[i];
    cross_product(s->n, K, F->across);
    for (int i = 0; i < 3; i++) change[i] = AT(S->J, i) * F->across[i];
    F->count = 3;
    F->divisor = broadcast(1);
    if (T->second_of == PLANE) {
        cross_product_exactly(K, s->n, F->a);
        cross_product(change, s->n, F->b);
        F->slope = 2 * inner3(F->a, F->b);
        memcpy(F->b, F->a, sizeof F->b);
        return;
    }
    F->count = 6;
    F->divisor = zero;
    for (int i = 0; i < 3; i++) {
        const real u = AT(S->inv_J, i) * s->n[i];
        F->a[i] = F->b[i] = K[i];
        F->a[3 + i] = 2 * S->energy / S->over_det * u;
        F->b[3 + i] = u;
        F->slope += 2 * K[i] * change[i];
        F->divisor += u * s->n[i];
    }
}

static second_integral second_of(const form *T, const state *s)
{
    second_integral F = {0};
    T->is_point ? second_of_point(T, s, &F) : second_of_ball(T, s, &F);
    return F;
}

/* Puts F back to its value at the start. A defect above a thousandth is left alone: this is another orbit. Where w
 * changes F by less than a tenth of F, a step puts back only a part of the defect, and many steps the whole.
 * Otherwise small rounding errors of F would become large errors of w. */
static void restore_second(const form *T, state *s)
{
    const second_integral F = second_of(T, s);
    const real target = T->second * F.divisor, size = magnitude(target), weak = (NUMBER)0.1 * size;
    const real defect = defect_of(F.a, F.b, F.count, target);
    const real part = defect * F.slope / (F.slope * F.slope + weak * weak);
    const mask near = both(size > zero, magnitude(defect) <= (NUMBER)1e-3 * size);
    const real angle = choose(near, part, zero);
    for (int i = 0; i < 3; i++) s->w[i] -= angle * F.across[i];
}

static real restore_point(const form *T, state *s)
{
    real worst = restore_length(s->n, 3, broadcast(1), everywhere());
    add_times(s->w, -defect_of(s->n, s->w, 3, zero), s->n);
    if (T->is_point_in_t) return worst + restore_length(s->w, 3, T->S.coupling, T->S.coupling > zero);
    real terms;
    const real square = square_of_speed(T, s, &terms), now = inner3(s->w, s->w);
    const mask fast = both(now > square / 2, now > (NUMBER)0.1 * terms); /* else rounding errors would grow */
    worst += restore_length(s->w, 3, square, both(square > zero, fast));
    if (T->second_of) restore_second(T, s);
    return worst;
}

/* Twice the energy of a loaded ball, as sum_i a_i b_i. `sum` is its rounded value, `kinetic` the part of the motion.
 * `range`: how large twice the potential is here, or can become. */
typedef struct energy_sum {
    int count;
    real a[5], b[5], sum, kinetic, range;
} energy_sum;

static void add(energy_sum *E, real a, real b)
{
    E->a[E->count] = a;
    E->b[E->count++] = b;
    E->sum += a * b;
}

/* (w,Jw) - D (w,n)^2 + 2 U */
static void energy_of(const form *T, const state *s, energy_sum *E)
{
    const series *S = &T->S;
    real spin = zero, g = zero, size;
    vector gradient;
    *E = (energy_sum){0};
    for (int i = 0; i < 3; i++) {
        add(E, s->w[i], AT(S->J, i) * s->w[i]);
        spin += s->w[i] * s->n[i];
        g += s->n[i] * AT(S->inv_J, i) * s->n[i];
    }
    if (T->twists) add(E, -S->D * spin, spin);
    E->kinetic = E->sum;
    add(E, 2 * potential_at(T, s->n, g, s, &size, &gradient), broadcast(1));
    E->range = larger(2 * T->range, magnitude(E->sum - E->kinetic));
}

/* Puts a loaded ball back to its energy. Not where it hardly moves: there a small error of the energy would become a
 * large error of w. The model's projection does the same. */
static real restore_energy(const form *T, state *s)
{
    energy_sum E;
    mask wanted = T->keeps_energy > zero;
    if (!any(wanted)) return zero;
    energy_of(T, s, &E);
    const real defect = defect_of(E.a, E.b, E.count, T->twice_energy), moving = E.kinetic - defect;
    wanted = both(both(wanted, moving > zero), both(E.kinetic > moving / 2, E.kinetic > (NUMBER)0.1 * E.range));
    const real part = choose(wanted, defect / (2 * E.kinetic), zero);
    for (int i = 0; i < 3; i++) s->w[i] -= part * s->w[i];
    return magnitude(part);
}

/* The constraints and the energy of a ball. Without twist (w,n) = 0 is restored along J^-1 n, as in ball.c. */
static real restore_ball(const form *T, state *s)
{
    const series *S = &T->S;
    real worst = restore_length(s->n, 3, broadcast(1), everywhere()), K[3];
    real g = zero;
    for (int i = 0; i < 3; i++) g += s->n[i] * AT(S->inv_J, i) * s->n[i];
    const real spin = T->twists ? zero : defect_of(s->w, s->n, 3, zero) / g;
    for (int i = 0; i < 3; i++) s->w[i] -= spin * AT(S->inv_J, i) * s->n[i];
    if (T->loaded) return worst + restore_energy(T, s);
    for (int i = 0; i < 3; i++) K[i] = AT(S->J, i) * s->w[i];
    const real twice = 2 * S->energy;
    const real part = choose(twice > zero, defect_of(s->w, K, 3, twice) / (2 * twice), zero);
    for (int i = 0; i < 3; i++) s->w[i] -= part * s->w[i];
    if (T->second_of) restore_second(T, s);
    return worst + magnitude(part);
}

/* Brings a state back to its constraints and integrals. Returns the relative size of the corrections. Unit vectors
 * come first: the energy depends on the vertical. */
static real restore(const form *T, state *s)
{
    real worst = zero;
    if (T->unprojected && !T->is_point) return zero; /* off them a point's equations are unstable */
    for (int i = 0; i < T->units; i++)
        worst += restore_length(s->own + T->unit[i].at, T->unit[i].size, broadcast(1), everywhere());
    return worst + (T->is_point || T->is_point_in_t ? restore_point(T, s) : restore_ball(T, s));
}

/* Notes the second integral, or the energy of a loaded ball, at the start. The constraints are restored first, so
 * that they and the integral fit together. */
static void set_integrals(form *T, int lane, const iso_model *m)
{
    double y[ISO_MAX_STATE];
    state start = T->now;
    const enum second_integral_of wanted = T->second_of;
    (void)lane;
    T->second_of = NONE;
    LANE(T->keeps_energy, lane) = 0;
    restore(T, &start);
    T->second_of = wanted;
    if (wanted) {
        const second_integral F = second_of(T, &start);
        const real second = defect_of(F.a, F.b, F.count, zero) / F.divisor;
        LANE(T->second, lane) = LANE(second, lane);
    }
    if (T->loaded) {
        energy_sum E;
        energy_of(T, &start, &E);
        const real twice = defect_of(E.a, E.b, E.count, zero);
        LANE(T->twice_energy, lane) = LANE(twice, lane);
        LANE(T->keeps_energy, lane) = iso_effects_keep_energy(&m->problem);
        for (int i = 0; i < m->dim; i++)
            y[i] = i < 3 ? (double)LANE(start.w[i], lane) : i < 6 ? (double)LANE(start.n[i - 3], lane) : 0;
        LANE(T->range, lane) = iso_effects_largest(&m->problem, y);
        double square = 0, most = 0;
        for (int i = 0; i < 3; i++) square += y[i] * y[i], most = fmax(most, m->problem.p.J[i]);
        LANE(T->speed_square, lane) = square + 2 * (double)LANE(T->range, lane) / most;
    }
}

/* A new orbit in a lane, at y. The model must live as long as the orbit is followed. */
static void start_orbit(form *T, int lane, const iso_model *m, const double y[])
{
    T->model[lane] = m;
    set_numbers(T, lane, m);
    load(T, lane, y);
    if (T->second_of || T->loaded) set_integrals(T, lane, m);
}

/* The state at x of the series (gained: see state_at), with its constraints restored. Returns the relative size of the
 * corrections. States of effects that no equation moves stay as they are. */
static real find_state(const form *T, real x, const real gained[], state *s)
{
    if (s != &T->now) copy_state(T, s, &T->now);
    state_at(T, x, gained, s);
    return restore(T, s);
}

/* The step of choose_step, halved while its state is far from its constraints and integrals and a half of it is much
 * nearer; the state is then in *after, the correction in *moved. Off its constraints a point's equations are
 * unstable: a step that is right for its smooth orbit may be so long that rounding errors at its left end grow to 1e5
 * times. */
static real choose_near(const form *T, real direction, real gained[], state *after, real *moved)
{
    const real far = broadcast((NUMBER)ISO_FAR_CORRECTION(T->tolerance / FINER));
    real length = choose_step(T, direction, gained);
    *moved = find_state(T, length, gained, after);
    mask halved = *moved > far;
    for (int i = 0; i < 8 && any(halved); i++) {
        const real before = *moved, whole = length;
        length = choose(halved, length / 2, length);
        integrate_clocks(T, length, gained);
        *moved = find_state(T, length, gained, after);
        const mask worse = both(halved, *moved > before / 4);
        halved = both(both(halved, *moved > far), other(worse));
        if (!any(worse)) continue;
        length = choose(worse, whole, length); /* such corrections are roundings of the state itself */
        integrate_clocks(T, length, gained);
        *moved = find_state(T, length, gained, after);
    }
    return length;
}

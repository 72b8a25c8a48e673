/* written_work.c - what a torque that the scene writes does to the energy: by the form of its power, and, where the
 * form does not show what the scene claims, at one state.
 *
 * The power M1 omega1 + M2 omega2 + M3 omega3 is multiplied out into a sum of terms: a number times whole powers of
 * atoms. An atom is a name, the size of a constant, or a part of the text that stays whole: a function, a power, a sum
 * that something is divided by. Terms with the same atoms are added. What is left shows what the torque does:
 *
 *     nothing                                             no work
 *     terms that are at most 0, whatever the state        energy is lost
 *     something else                                      nobody knows
 *
 * Where the contact cannot twist, omega1 n1 = -omega2 n2 - omega3 n3 is put in as well. Numbers are added and
 * multiplied exactly, or not at all: a sum that is 0 by rounding shows nothing.
 */
#include "model/expression/written_impl.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/math_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"

enum { MOST_TERMS = 256, MOST_FACTORS = 16, MOST_WAITING = 48, LARGEST_POWER = 64 };

/* A part of the text to a whole power. */
typedef struct part {
    int16_t node, power;
} part;

typedef struct product {
    double number;
    int factors;
    part factor[MOST_FACTORS]; /* atoms, in the order of their nodes */
} product;

typedef struct power_sum {
    iso_expression e;
    double constant[ISO_EXPRESSION_NODES]; /* what constant nodes are worth */
    int terms;
    product term[MOST_TERMS];
    bool gave_up; /* no room, or numbers that would be rounded */
} power_sum;

/* --- products of atoms ------------------------------------------------------------------------------------------ */

static void multiply(power_sum *P, product *t, double number)
{
    const double value = t->number * number;
    P->gave_up = P->gave_up || fma(t->number, number, -value) != 0 || !isfinite(value);
    t->number = value;
}

/* t *= atom^power */
static void put(power_sum *P, product *t, int node, int power)
{
    int i = 0;
    while (i < t->factors && t->factor[i].node < node) i++;
    if (i < t->factors && t->factor[i].node == node) {
        t->factor[i].power = (int16_t)(t->factor[i].power + power);
        if (t->factor[i].power != 0) return;
        t->factors--;
        memmove(&t->factor[i], &t->factor[i + 1], (size_t)(t->factors - i) * sizeof *t->factor);
        return;
    }
    P->gave_up = P->gave_up || t->factors == MOST_FACTORS;
    if (P->gave_up) return;
    memmove(&t->factor[i + 1], &t->factor[i], (size_t)(t->factors - i) * sizeof *t->factor);
    t->factor[i] = (part){(int16_t)node, (int16_t)power};
    t->factors++;
}

/* t *= constant^power. A number of few digits is multiplied; the size of another one is an atom, the same for all
 * constants of this size. */
static void put_constant(power_sum *P, product *t, int node, int power)
{
    const double value = P->constant[node], size = fabs(value);
    const bool is_short = size <= 0x1p20 && size * 0x1p10 == floor(size * 0x1p10);
    P->gave_up = P->gave_up || !isfinite(value) || (value == 0 && power < 0);
    if (P->gave_up) return;
    if (value < 0 && power % 2 != 0) t->number = -t->number;
    if (size == 0 || (is_short && power > 0)) {
        for (int i = 0; i < power; i++) multiply(P, t, size);
    } else if (size != 1) {
        int same = 0;
        while (P->e.node[same].degree != ISO_CONSTANT || fabs(P->constant[same]) != size) same++;
        put(P, t, same, power);
    }
}

/* Adds a product to the terms. */
static void add_term(power_sum *P, const product *t)
{
    double lost = 0;
    int i = 0;
    const size_t length = (size_t)t->factors * sizeof *t->factor;
    if (t->number == 0) return;
    while (i < P->terms && (P->term[i].factors != t->factors || memcmp(P->term[i].factor, t->factor, length) != 0))
        i++;
    if (i == P->terms && i == MOST_TERMS) P->gave_up = true;
    if (P->gave_up) return;
    if (i == P->terms)
        P->term[P->terms++] = *t;
    else
        P->term[i].number = iso_two_sum(P->term[i].number, t->number, &lost);
    P->gave_up = lost != 0;
}

/* --- multiplying out -------------------------------------------------------------------------------------------- */

/* A product that is being multiplied out: parts that wait are not atoms yet. */
typedef struct unfinished {
    product t;
    int waiting;
    part wait[MOST_WAITING];
} unfinished;

static void let_wait(power_sum *P, unfinished *u, int node, int power)
{
    int i = 0;
    while (i < u->waiting && u->wait[i].node != node) i++;
    const int sum = i < u->waiting ? u->wait[i].power + power : power;
    P->gave_up = P->gave_up || i == MOST_WAITING || abs(sum) > LARGEST_POWER;
    if (P->gave_up) return;
    u->wait[i] = (part){(int16_t)node, (int16_t)sum};
    if (i == u->waiting) u->waiting++;
}

static bool is_sum(const power_sum *P, int node)
{
    return P->e.node[node].term == ISO_TERM_ADD || P->e.node[node].term == ISO_TERM_SUB;
}

/* The next part to look at: sums last, when it is known to which power they stand. */
static part take_waiting(const power_sum *P, unfinished *u)
{
    int i = u->waiting - 1;
    while (i > 0 && is_sum(P, u->wait[i].node)) i--;
    const part p = u->wait[i];
    u->wait[i] = u->wait[--u->waiting];
    return p;
}

/* The whole number that a power in the text has as its exponent; 0: it has none. */
static int whole_exponent(const power_sum *P, const iso_expression_node *node)
{
    const double value = P->constant[node->b];
    const bool whole =
        P->e.node[node->b].degree == ISO_CONSTANT && fabs(value) <= LARGEST_POWER && value == floor(value);
    return whole ? (int)value : 0;
}

/* Multiplies out all that waits, and adds the terms. */
static void multiply_out(power_sum *P, unfinished *u)
{
    while (u->waiting > 0 && !P->gave_up) {
        const part p = take_waiting(P, u);
        const iso_expression_node *node = &P->e.node[p.node];
        const int exponent = node->term == ISO_TERM_POWER ? whole_exponent(P, node) : 0;
        if (p.power == 0) continue;
        if (is_sum(P, p.node) && p.power == 1) {
            unfinished first = *u;
            let_wait(P, &first, node->a, 1);
            multiply_out(P, &first);
            let_wait(P, u, node->b, 1);
            if (node->term == ISO_TERM_SUB) u->t.number = -u->t.number;
        } else if (node->term == ISO_TERM_MUL && node->a == node->b) {
            let_wait(P, u, node->a, 2 * p.power); /* a square, which has a sign */
        } else if (node->term == ISO_TERM_MUL || node->term == ISO_TERM_DIV) {
            let_wait(P, u, node->a, p.power);
            let_wait(P, u, node->b, node->term == ISO_TERM_DIV ? -p.power : p.power);
        } else if (node->term == ISO_TERM_NEGATIVE) {
            if (p.power % 2 != 0) u->t.number = -u->t.number;
            let_wait(P, u, node->a, p.power);
        } else if (exponent != 0) {
            let_wait(P, u, node->a, exponent * p.power);
        } else if (node->degree == ISO_CONSTANT) {
            put_constant(P, &u->t, p.node, p.power);
        } else {
            put(P, &u->t, p.node, p.power);
        }
    }
    if (!P->gave_up) add_term(P, &u->t);
}

/* The node of a name such as omega1; -1: the text has none. */
static int node_of(const iso_expression *e, iso_term term, int which)
{
    for (int i = 0; i < e->nodes; i++)
        if (e->node[i].term == term && e->node[i].a == which) return i;
    return -1;
}

static int power_in(const product *t, int node)
{
    for (int i = 0; i < t->factors; i++)
        if (t->factor[i].node == node) return t->factor[i].power;
    return 0;
}

/* Puts omega1 n1 = -omega2 n2 - omega3 n3 into all terms. A term may come back with fewer factors omega1 n1, behind
 * those that are there. */
static void put_no_twist(power_sum *P)
{
    int n[3], omega[3];
    for (int i = 0; i < 3; i++) {
        n[i] = node_of(&P->e, ISO_TERM_N, i);
        omega[i] = node_of(&P->e, ISO_TERM_OMEGA, i);
        if (n[i] < 0 || omega[i] < 0) return;
    }
    for (int i = 0; i < P->terms && !P->gave_up; i++) {
        if (power_in(&P->term[i], n[0]) < 1 || power_in(&P->term[i], omega[0]) < 1) continue;
        product t = P->term[i];
        P->term[i].number = 0;
        t.number = -t.number;
        put(P, &t, n[0], -1);
        put(P, &t, omega[0], -1);
        for (int j = 1; j < 3; j++) {
            product next = t;
            put(P, &next, n[j], 1);
            put(P, &next, omega[j], 1);
            add_term(P, &next);
        }
    }
}

/* --- signs ------------------------------------------------------------------------------------------------------ */

/* Whether an exponent is an odd whole number: other powers are at least 0, or no numbers. */
static bool is_odd(const power_sum *P, int node)
{
    return P->e.node[node].degree == ISO_CONSTANT && fabs(fmod(P->constant[node], 2)) == 1;
}

/* Whether a node is at least 0 wherever it is a number, as its form shows. */
static bool not_negative(const power_sum *P, int at)
{
    const iso_expression_node *node = &P->e.node[at];
    if (node->degree == ISO_CONSTANT) return P->constant[at] >= 0;
    switch (node->term) {
    case ISO_TERM_SQRT:
    case ISO_TERM_EXP: return true;
    case ISO_TERM_ADD: return not_negative(P, node->a) && not_negative(P, node->b);
    case ISO_TERM_MUL: return node->a == node->b || (not_negative(P, node->a) && not_negative(P, node->b));
    case ISO_TERM_DIV: return not_negative(P, node->a) && not_negative(P, node->b);
    case ISO_TERM_POWER: return !is_odd(P, node->b) || not_negative(P, node->a);
    default: return false;
    }
}

static iso_work work_of(const power_sum *P)
{
    iso_work work = ISO_WORK_NONE;
    for (int i = 0; i < P->terms; i++) {
        const product *t = &P->term[i];
        if (t->number == 0) continue;
        bool taken = t->number < 0;
        for (int j = 0; j < t->factors; j++)
            taken = taken && (t->factor[j].power % 2 == 0 || P->e.node[t->factor[j].node].degree == ISO_CONSTANT ||
                              not_negative(P, t->factor[j].node));
        if (!taken) return ISO_WORK_UNKNOWN;
        work = ISO_WORK_LOST;
    }
    return work;
}

/* --- a torque --------------------------------------------------------------------------------------------------- */

/* Reads the power as one text: parts that are equal in two components are then one node. */
static bool read_power(const iso_problem *f, power_sum *P)
{
    enum { COMPONENTS = 3 };
    char text[COMPONENTS * (ISO_EXPRESSION_SIZE + 16)] = "";
    const iso_written *written = &f->effects.written[iso_effect_list[ISO_TORQUE]->written];
    const iso_expression_names names = {true, true, written->parameter};
    const double still[ISO_MAX_STATE] = {0};
    for (int i = 0, at = 0; i < COMPONENTS; i++)
        at += snprintf(text + at, sizeof text - (size_t)at, "%s(%s)*omega%d", i > 0 ? "+" : "",
                       written->expression[i], i + 1);
    if (!iso_expression_read(text, &names, &P->e)) return false;
    const iso_expression_state s = iso_written_state(f, ISO_TORQUE, still);
    iso_expression_values(&P->e, &s, P->constant);
    return true;
}

iso_work iso_written_work(const iso_problem *f)
{
    power_sum P;
    unfinished all = {.t = {.number = 1}, .waiting = 1};
    P.terms = 0;
    P.gave_up = false;
    if (!read_power(f, &P)) return ISO_WORK_UNKNOWN;
    all.wait[0] = (part){(int16_t)P.e.root, 1};
    multiply_out(&P, &all);
    const iso_work as_written = P.gave_up ? ISO_WORK_UNKNOWN : work_of(&P);
    if (P.gave_up || as_written != ISO_WORK_UNKNOWN || iso_effects_twist(&f->effects)) return as_written;
    put_no_twist(&P);
    return P.gave_up ? ISO_WORK_UNKNOWN : work_of(&P);
}

/* --- what a scene claims ---------------------------------------------------------------------------------------- */

int iso_written_works(const iso_expression e[3], const iso_expression_state *s)
{
    const double apart = 1e-12, rounding = 100 * DBL_EPSILON;
    double M[3], power = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        double change;
        M[i] = iso_expression_value(&e[i], s, &change);
        power += M[i] * s->omega[i];
        size += fabs(M[i]) * norm(s->omega) + change * fabs(s->omega[i]);
    }
    if (!(fabs(power) > fmax(apart * norm(M) * norm(s->omega), rounding * size))) return 0;
    return power > 0 ? 1 : -1;
}

/* Of a torque that is on: what is claimed of it. */
static iso_work claimed(const iso_problem *f)
{
    return iso_effect_acts(&f->effects, ISO_TORQUE) ? iso_effect_list[ISO_TORQUE]->work(f) : ISO_WORK_UNKNOWN;
}

bool iso_model_has_claim(const iso_model *m)
{
    const iso_work said = m->system == &iso_system_ball ? claimed(&m->problem) : ISO_WORK_UNKNOWN;
    if (said == ISO_WORK_UNKNOWN) return false;
    const iso_work shown = iso_written_work(&m->problem);
    return shown == ISO_WORK_UNKNOWN || (said == ISO_WORK_NONE && shown == ISO_WORK_LOST);
}

/* Whether what is claimed fails at y. text: where that is, in words. */
static bool fails_at(const iso_model *m, const double y[], iso_work said, char text[ISO_BLAME_SIZE])
{
    const iso_problem *f = &m->problem;
    iso_expression e[3];
    double restored[ISO_MAX_STATE];
    for (int i = 0; i < 3; i++)
        if (!iso_written_read(&f->effects, ISO_TORQUE, i, &e[i])) return false;
    copy(y, restored, m->dim); /* what is claimed may need (omega,n) = 0 */
    iso_model_project(m, restored);
    const iso_expression_state s = iso_written_state(f, ISO_TORQUE, restored);
    const int works = iso_written_works(e, &s);
    if (works == 0 || (said == ISO_WORK_LOST && works < 0)) return false;
    snprintf(text, ISO_BLAME_SIZE, "; there 'torque' %s energy, with omega = (%s, %s, %s) and n = (%s, %s, %s)",
             works > 0 ? "gives" : "takes", ISO_ROUNDED(s.omega[0], 4), ISO_ROUNDED(s.omega[1], 4),
             ISO_ROUNDED(s.omega[2], 4), ISO_ROUNDED(s.n[0], 4), ISO_ROUNDED(s.n[1], 4), ISO_ROUNDED(s.n[2], 4));
    return true;
}

const char *iso_model_false_claim(const iso_model *m, const double y[], char text[ISO_BLAME_SIZE])
{
    const iso_work said = m->system == &iso_system_ball ? claimed(&m->problem) : ISO_WORK_UNKNOWN;
    if (said == ISO_WORK_UNKNOWN || !fails_at(m, y, said, text)) return NULL;
    return said == ISO_WORK_NONE ? "'torque' does work, but the scene says 'work: none'"
                                 : "'torque' gives energy, but the scene says 'work: lost'";
}

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
 * Where the contact cannot twist, omega1 n1 = -omega2 n2 - omega3 n3 is used as well. Numbers are added and
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

enum { MOST_TERMS = 256, LARGEST_POWER = 64 };

/* A number times whole powers of parts of the text, by their nodes, and behind these, from SIZES on, of the sizes of
 * constants. Multiplied out, the parts are atoms. */
enum { SIZES = ISO_EXPRESSION_NODES };
typedef struct product {
    double number;
    int8_t power[2 * ISO_EXPRESSION_NODES];
} product;

typedef struct power_sum {
    iso_expression e;
    double constant[ISO_EXPRESSION_NODES]; /* what constant nodes are worth */
    int terms;
    product term[MOST_TERMS];
    bool gave_up; /* no room, or numbers that would be rounded */
} power_sum;

/* --- multiplying out -------------------------------------------------------------------------------------------- */

/* t *= part^power */
static void multiply(power_sum *P, product *t, int part, int power)
{
    const int sum = t->power[part] + power;
    P->gave_up = P->gave_up || abs(sum) > LARGEST_POWER;
    if (!P->gave_up) t->power[part] = (int8_t)sum;
}

/* A constant of few digits becomes a factor of the number. The size of another one is an atom, the same for all
 * constants of this size: that of the first of them. */
static void multiply_constant(power_sum *P, product *t, int node)
{
    const double value = P->constant[node], size = fabs(value);
    const bool is_short = size <= 0x1p20 && size * 0x1p10 == floor(size * 0x1p10);
    const int power = t->power[node];
    P->gave_up = P->gave_up || !isfinite(value) || (value == 0 && power < 0);
    if (P->gave_up) return;
    t->power[node] = 0;
    if (value < 0 && power % 2 != 0) t->number = -t->number;
    if (size == 0 || (is_short && power > 0)) {
        for (int i = 0; i < power; i++) {
            const double times = t->number * size;
            P->gave_up = P->gave_up || fma(t->number, size, -times) != 0 || !isfinite(times);
            t->number = times;
        }
    } else if (size != 1) {
        int same = 0;
        while (P->e.node[same].degree != ISO_CONSTANT || fabs(P->constant[same]) != size) same++;
        multiply(P, t, SIZES + same, power);
    }
}

static void add_term(power_sum *P, const product *t)
{
    double lost = 0;
    int i = 0;
    if (t->number == 0) return;
    while (i < P->terms && memcmp(P->term[i].power, t->power, sizeof t->power) != 0) i++;
    P->gave_up = P->gave_up || i == MOST_TERMS;
    if (P->gave_up) return;
    if (i == P->terms)
        P->term[P->terms++] = *t;
    else
        P->term[i].number = iso_two_sum(P->term[i].number, t->number, &lost);
    P->gave_up = lost != 0;
}

/* The whole number that a power in the text has as its exponent; 0: it has none. */
static int whole_exponent(const power_sum *P, const iso_expression_node *node)
{
    const double value = P->constant[node->b];
    const bool whole =
        P->e.node[node->b].degree == ISO_CONSTANT && fabs(value) <= LARGEST_POWER && value == floor(value);
    return whole ? (int)value : 0;
}

/* Multiplies the product out, and adds the terms: from the whole to its parts, which stand before it, so that the power
 * of a part is known when it is reached. Sums come last. */
static void multiply_out(power_sum *P, product *t)
{
    int sum = -1; /* the largest one that stands there once */
    for (int i = P->e.root; i >= 0 && !P->gave_up; i--) {
        const iso_expression_node *node = &P->e.node[i];
        const int power = t->power[i], exponent = node->term == ISO_TERM_POWER ? whole_exponent(P, node) : 0;
        const bool is_product = node->term == ISO_TERM_MUL || node->term == ISO_TERM_DIV;
        if (power == 1 && (node->term == ISO_TERM_ADD || node->term == ISO_TERM_SUB)) {
            if (sum < 0) sum = i;
        } else if (power != 0 && (is_product || exponent != 0 || node->term == ISO_TERM_NEGATIVE)) {
            t->power[i] = 0;
            multiply(P, t, node->a, exponent != 0 ? exponent * power : power);
            if (is_product) multiply(P, t, node->b, node->term == ISO_TERM_DIV ? -power : power);
            if (node->term == ISO_TERM_NEGATIVE && power % 2 != 0) t->number = -t->number;
        } else if (power != 0 && node->degree == ISO_CONSTANT) {
            multiply_constant(P, t, i);
        }
    }
    if (sum < 0 && !P->gave_up) add_term(P, t);
    if (sum < 0 || P->gave_up) return;
    t->power[sum] = 0;
    product first = *t;
    multiply(P, &first, P->e.node[sum].a, 1);
    multiply_out(P, &first);
    multiply(P, t, P->e.node[sum].b, 1);
    if (P->e.node[sum].term == ISO_TERM_SUB) t->number = -t->number;
    multiply_out(P, t);
}

/* The node of a name such as omega1; -1: the text has none. */
static int node_of(const iso_expression *e, iso_term term, int which)
{
    for (int i = 0; i < e->nodes; i++)
        if (e->node[i].term == term && e->node[i].a == which) return i;
    return -1;
}

/* Replaces omega1 n1 by -omega2 n2 - omega3 n3 in all terms. A term may come back with fewer factors omega1 n1, also
 * as one that was looked at. */
static void forbid_twist(power_sum *P)
{
    int n[3], omega[3];
    for (int i = 0; i < 3; i++) {
        n[i] = node_of(&P->e, ISO_TERM_N, i);
        omega[i] = node_of(&P->e, ISO_TERM_OMEGA, i);
        if (n[i] < 0 || omega[i] < 0) return;
    }
    for (int i = 0; i < P->terms && !P->gave_up; i++) {
        product t = P->term[i];
        if (t.number == 0 || t.power[n[0]] < 1 || t.power[omega[0]] < 1) continue;
        P->term[i].number = 0;
        t.number = -t.number;
        t.power[n[0]]--;
        t.power[omega[0]]--;
        for (int j = 1; j < 3; j++) {
            product next = t;
            multiply(P, &next, n[j], 1);
            multiply(P, &next, omega[j], 1);
            if (!P->gave_up) add_term(P, &next);
        }
        i = -1;
    }
}

/* --- signs ------------------------------------------------------------------------------------------------------ */

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
    case ISO_TERM_POWER: /* but for odd whole exponents it is at least 0, or no number */
        return P->e.node[node->b].degree != ISO_CONSTANT || fabs(fmod(P->constant[node->b], 2)) != 1 ||
               not_negative(P, node->a);
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
        for (int j = 0; j < P->e.nodes; j++) taken = taken && (t->power[j] % 2 == 0 || not_negative(P, j));
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
    const iso_expression_names names = {true, written->parameter};
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
    product all = {.number = 1};
    P.terms = 0;
    P.gave_up = false;
    if (!read_power(f, &P)) return ISO_WORK_UNKNOWN;
    all.power[P.e.root] = 1;
    multiply_out(&P, &all);
    const iso_work as_written = P.gave_up ? ISO_WORK_UNKNOWN : work_of(&P);
    if (P.gave_up || as_written != ISO_WORK_UNKNOWN || iso_effects_twist(&f->effects)) return as_written;
    forbid_twist(&P);
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

/* Of a torque that acts on a ball: what is claimed of it. */
static iso_work claimed(const iso_model *m)
{
    const bool acts = m->system == &iso_system_ball && iso_effect_acts(&m->problem.effects, ISO_TORQUE);
    return acts ? iso_effect_torque.work(&m->problem) : ISO_WORK_UNKNOWN;
}

bool iso_model_has_claim(const iso_model *m)
{
    const iso_work said = claimed(m);
    if (said == ISO_WORK_UNKNOWN) return false;
    const iso_work shown = iso_written_work(&m->problem);
    return shown == ISO_WORK_UNKNOWN || (said == ISO_WORK_NONE && shown == ISO_WORK_LOST);
}

/* Whether what is claimed fails at y. text: where that is. */
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
    const iso_work said = claimed(m);
    if (said == ISO_WORK_UNKNOWN || !fails_at(m, y, said, text)) return NULL;
    return said == ISO_WORK_NONE ? "'torque' does work, but the scene says 'work: none'"
                                 : "'torque' gives energy, but the scene says 'work: lost'";
}

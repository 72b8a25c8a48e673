/* arb_tape.c - writes down differential equations as a tape of nodes, and differentiates them (arb_tape_impl.h). */
#include <stdlib.h>

#include "method/enclosure/arb_tape_impl.h"

void iso_tape_init(iso_tape *f)
{
    *f = (iso_tape){.node = NULL};
}

void iso_tape_clear(iso_tape *f)
{
    for (int i = 0; i < f->nodes; i++) arb_clear(f->node[i].number);
    flint_free(f->node);
    flint_free(f->state);
}

/* Arb ends the program where there is no memory; so does this. `number` may be that of a node: it is copied first. */
int iso_tape_add(iso_tape *f, iso_tape_kind kind, int a, int b, const arb_struct *number)
{
    iso_tape_node n = {.kind = kind, .a = a, .b = b, .rate = -1};
    n.factor = kind == ISO_TAPE_QUOTIENT || kind == ISO_TAPE_POWER;
    arb_init(n.number);
    if (number) arb_set(n.number, number);
    if (f->nodes == f->room) {
        f->room = 2 * f->room + 64;
        f->node = flint_realloc(f->node, (size_t)f->room * sizeof *f->node);
        f->state = flint_realloc(f->state, (size_t)f->room * sizeof *f->state);
    }
    if (kind == ISO_TAPE_PRODUCT || kind == ISO_TAPE_POWER) f->node[a].factor = true;
    if (kind == ISO_TAPE_PRODUCT || kind == ISO_TAPE_QUOTIENT) f->node[b].factor = true;
    if (kind == ISO_TAPE_STATE) f->state[f->states++] = f->nodes;
    f->node[f->nodes] = n;
    return f->nodes++;
}

void iso_tape_rate(iso_tape *f, int state, int rate)
{
    f->node[state].rate = rate;
}

void iso_tape_cross(iso_tape *f, const int a[3], const int b[3], int c[3])
{
    int product[3][3], x[3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) product[i][j] = i == j ? -1 : iso_tape_product(f, a[i], b[j]);
    for (int i = 0, j = 1, k = 2; i < 3; i++, j = (j + 1) % 3, k = (k + 1) % 3)
        x[i] = iso_tape_less(f, product[j][k], product[k][j]);
    for (int i = 0; i < 3; i++) c[i] = x[i];
}

int iso_tape_dot(iso_tape *f, const int a[3], const int b[3])
{
    const int first = iso_tape_product(f, a[0], b[0]), second = iso_tape_product(f, a[1], b[1]);
    return iso_tape_sum(f, iso_tape_sum(f, first, second), iso_tape_product(f, a[2], b[2]));
}

void iso_tape_diagonal(iso_tape *f, const arb_struct factor[3], const int a[3], int c[3])
{
    for (int i = 0; i < 3; i++) c[i] = iso_tape_scaled(f, factor + i, a[i]);
}

/* --- the first variation ----------------------------------------------------------------------------------------- */

/* Nodes that may be missing: -1 is 0. */
static int sum_of(iso_tape *f, int a, int b)
{
    return a < 0 ? b : b < 0 ? a : iso_tape_sum(f, a, b);
}

static int less_of(iso_tape *f, int a, int b)
{
    if (a >= 0) return b < 0 ? a : iso_tape_less(f, a, b);
    if (b < 0) return -1;
    arb_t minus;
    arb_init(minus);
    arb_set_si(minus, -1);
    const int i = iso_tape_scaled(f, minus, b);
    arb_clear(minus);
    return i;
}

static int product_of(iso_tape *f, int a, int b)
{
    return a < 0 || b < 0 ? -1 : iso_tape_product(f, a, b);
}

/* d: the derivatives of all nodes before this one. slope: of a power. */
static int derivative_of(iso_tape *f, int i, const int d[], int slope)
{
    const iso_tape_node n = f->node[i]; /* f->node may move; the number stays where its digits are */
    const int da = n.a < 0 ? -1 : d[n.a], db = n.b < 0 ? -1 : d[n.b];
    switch (n.kind) {
    case ISO_TAPE_SUM: return sum_of(f, da, db);
    case ISO_TAPE_LESS: return less_of(f, da, db);
    case ISO_TAPE_PRODUCT: return sum_of(f, product_of(f, da, n.b), product_of(f, n.a, db));
    case ISO_TAPE_POWER: return product_of(f, slope, da);
    case ISO_TAPE_QUOTIENT: {
        const int top = less_of(f, da, product_of(f, i, db));
        return top < 0 ? -1 : iso_tape_quotient(f, top, n.b);
    }
    case ISO_TAPE_SCALED: return da < 0 ? -1 : iso_tape_scaled(f, n.number, da);
    default: return -1;
    }
}

void iso_tape_differentiate(iso_tape *f, int count)
{
    const int nodes = f->nodes, states = f->states;
    int *d = flint_malloc((size_t)(nodes * count) * sizeof *d);
    arb_t zero;
    arb_init(zero);
    for (int i = 0; i < nodes * count; i++) d[i] = -1;
    for (int i = 0; i < states; i++)
        for (int j = 0; j < count; j++) d[nodes * j + f->state[i]] = iso_tape_state(f);
    for (int i = 0; i < nodes; i++) {
        if (f->node[i].kind == ISO_TAPE_STATE) continue;
        int slope = -1; /* number v/a, where v = a^number */
        if (f->node[i].kind == ISO_TAPE_POWER) {
            const int ratio = iso_tape_quotient(f, i, f->node[i].a);
            slope = iso_tape_scaled(f, f->node[i].number, ratio);
        }
        for (int j = 0; j < count; j++) d[nodes * j + i] = derivative_of(f, i, d + nodes * j, slope);
    }
    for (int i = 0; i < states; i++)
        for (int j = 0; j < count; j++) {
            const int rate = d[nodes * j + f->node[f->state[i]].rate];
            iso_tape_rate(f, d[nodes * j + f->state[i]], rate < 0 ? iso_tape_constant(f, zero) : rate);
        }
    flint_free(d);
    arb_clear(zero);
}

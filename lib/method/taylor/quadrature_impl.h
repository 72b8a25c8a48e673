/* quadrature_impl.h - integrals of a power of a series, by the rule of Gauss and Legendre with NODES nodes.
 *
 * A clock's rate is a power of q or g. The series of q or g is there already, so its values at the nodes, side by
 * side, give the integral of the rate over a step. A series of the clock itself would need two more products a
 * coefficient. The rule has order 2 NODES. Its values f_i also give the last Legendre coefficients,
 *     c_n = (2 n + 1) sum_i w_i P_n(x_i) f_i,   n = NODES - 1, NODES - 2
 * (one may be 0 by symmetry). Coefficients fall geometrically, so its error, relative to f, is about c_n^2.
 */
#include "model/series/number_impl.h"

/* On [0,1]. */
typedef struct quadrature {
    real node[NODES];
    real weight[NODES], last[2][NODES]; /* w_i, and (2 n + 1) w_i P_n(x_i) */
} quadrature;

/* P_n(x), and P_(n-1)(x) */
static NUMBER legendre(int n, NUMBER x, NUMBER *before)
{
    NUMBER p = 1, last = 0;
    for (int i = 0; i < n; i++) {
        const NUMBER next = ((2 * i + 1) * x * p - i * last) / (i + 1);
        last = p;
        p = next;
    }
    *before = last;
    return p;
}

/* Nodes are zeros of P_n by Newton's method, P_n' = n (x P_n - P_(n-1))/(x^2 - 1); weights 1/((1 - x^2) P_n'^2) on
 * [0,1]. */
static void make_rule(quadrature *rule)
{
    for (int i = 0; i < NODES; i++) {
        NUMBER x = (NUMBER)-cos(3.14159265358979 * (i + 0.75) / (NODES + 0.5)), before, slope = 1;
        for (int pass = 0; pass < 7; pass++) {
            const NUMBER p = legendre(NODES, x, &before);
            slope = NODES * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        legendre(NODES, x, &before);
        slope = NODES * before / (1 - x * x);
        const NUMBER weight = 1 / ((1 - x * x) * slope * slope);
        rule->node[i] = broadcast((1 + x) / 2);
        rule->weight[i] = broadcast(weight);
        rule->last[0][i] = broadcast((2 * NODES - 1) * weight * before);
        legendre(NODES - 1, x, &before);
        rule->last[1][i] = broadcast((2 * NODES - 3) * weight * before);
    }
}

/* The values of a series b at the nodes of [0,x]. */
static inline void values_at_nodes(const quadrature *rule, const real b[], int order, real x, real value[NODES])
{
    real at[NODES];
    for (int i = 0; i < NODES; i++) {
        at[i] = x * rule->node[i];
        value[i] = b[order];
    }
    for (int n = order - 1; n >= 0; n--)
        for (int i = 0; i < NODES; i++) value[i] = value[i] * at[i] + b[n];
}

/* The integral of b^p from 0 to x, from the values of b at the nodes. Raises *doubt to its estimated relative error,
 * if that is larger. */
static inline real integral_of_power(const quadrature *rule, const real value[NODES], real p, real x, real *doubt)
{
    real sum = zero, c[2] = {zero, zero};
    for (int i = 0; i < NODES; i++) {
        const real f = raised(value[i], p);
        sum += rule->weight[i] * f;
        c[0] += rule->last[0][i] * f;
        c[1] += rule->last[1][i] * f;
    }
    const real least = larger(*doubt, larger(c[0] * c[0], c[1] * c[1]) / (sum * sum));
    *doubt = choose(sum == sum, least, sum);
    return x * sum;
}

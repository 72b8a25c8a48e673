/* plain_impl.h - whether a series shows all that the functions of a formula do in a step. Included behind form_impl.h.
 *
 * A function f(a) hides nothing where a changes little: what f does in the step shows in its coefficients. The argument
 * of exp or sin changes by at most 8; that of a logarithm, a divisor or the base of a power by at most 95 %, and this
 * times the exponent (of a divisor 1) is at most 4, so a power grows by at most about e^4. a changes by at most sum
 * |a_n| R^n, n from 1 to 12, in the circle of radius R around the left end, which reaches over the right end. Sums
 * and products of a low degree hide nothing by themselves.
 */

/* The terms of a that count, the circle in units of the step, and how far exp and sin go, and logarithms and powers. */
enum { SHOWN = 12 };
static const double CIRCLE = 1.1, FUNCTIONS_GO = 8, BASES_GO = 0.95, POWERS_GO = 4;

/* sum_(n>0) |a_n| R^n */
static real sum_of_sizes(const real a[], int order, real R)
{
    real sum = zero;
    for (int n = order - 1 < SHOWN ? order - 1 : SHOWN; n > 0; n--) sum = R * (magnitude(a[n]) + sum);
    return sum;
}

/* Where no function of the formula hides anything in a step of length h, h > 0. */
static mask is_plain(const form *T, real h)
{
    const series *S = &T->S;
    const real R = (NUMBER)CIRCLE * h;
    mask plain = everywhere();
    if (!S->formula) return plain; /* of what the scene writes, the point has no image */
    if (!T->flat) return other(plain);
    for (int i = 0; i < S->formula->lines; i++) {
        const iso_formula_line *l = &S->formula->line[i];
        const bool division = l->operation == ISO_S_DIV;
        const int node = division ? l->b : l->a;
        if (S->formula->late_line[i] || node == ISO_GIVEN_BASE) continue; /* powers of the base: at_poles */
        const real *a = S->scalar + node * ROOM, start = magnitude(a[0]);
        switch (l->operation) {
        case ISO_S_EXP:
        case ISO_S_SIN: plain = both(plain, sum_of_sizes(a, S->order, R) <= broadcast((NUMBER)FUNCTIONS_GO)); break;
        case ISO_S_LOG:
        case ISO_S_DIV:
        case ISO_S_POWER: {
            const real sum = sum_of_sizes(a, S->order, R),
                       p = l->operation == ISO_S_POWER ? S->c[l->b] : broadcast(1);
            plain =
                both(plain, both(sum <= (NUMBER)BASES_GO * start, magnitude(p) * sum <= (NUMBER)POWERS_GO * start));
            break;
        }
        default: break;
        }
    }
    return plain;
}

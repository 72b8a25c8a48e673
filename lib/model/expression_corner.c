/* expression_corner.c - finds corners that are hidden in roots, such as sqrt(n1^2) = |n1|.
 *
 * Where the number under a root goes to 0 as x^m, with m even, and comes back, its power p is |x|^(m p). If m p is an
 * odd integer, the series of one side goes on smoothly into the other one, with the wrong sign: no method of series
 * can notice that. Other m p are smooth (even integers), or stop the series by themselves.
 *
 * Such places are surfaces among the states, which curves meet; a root like sqrt(n1^2 + n2^2), which is 0 at single
 * points, is met by none. So the numbers under roots are followed along some closed curves, half of them through the n
 * of the start. A corner in a small part of the sphere can be missed.
 */
#include "model/expression_impl.h"

#include <math.h>
#include <stdio.h>

#include "base/number_impl.h"
#include "base/pi_impl.h"
#include "base/random_impl.h"
#include "base/vec3_impl.h"

enum { CURVES = 16, POINTS = 64 };

/* An ellipse of states: a cos u + b sin u, in n and e circles. */
typedef struct curve {
    iso_expression_state a, b;
} curve;

static iso_expression_state state_at(const curve *c, double u)
{
    iso_expression_state s = c->a;
    const double x = cos(u), y = sin(u);
    for (int i = 0; i < 3; i++) {
        s.n[i] = x * c->a.n[i] + y * c->b.n[i];
        s.omega[i] = x * c->a.omega[i] + y * c->b.omega[i];
        s.e[i] = x * c->a.e[i] + y * c->b.e[i];
    }
    return s;
}

/* Two unit vectors across each other; the first one is given or random. */
static void random_circle(iso_random *r, const double given[3], double a[3], double b[3])
{
    iso_random_direction(r, a);
    if (given) copy(given, a, 3);
    iso_random_direction(r, b);
    remove_along(b, a);
    make_unit(b);
}

static curve random_curve(iso_random *r, const iso_expression_state *s, const double n[3])
{
    curve c = {*s, *s};
    random_circle(r, n, c.a.n, c.b.n);
    random_circle(r, NULL, c.a.e, c.b.e);
    random_circle(r, NULL, c.a.omega, c.b.omega);
    const double speed = norm(s->omega) * pow(10, iso_random_uniform(r, -1, 1));
    scale(c.a.omega, speed);
    scale(c.b.omega, speed * iso_random_uniform(r, 0.1, 1));
    return c;
}

/* The number under the root, at u. */
static double under(const iso_expression *e, int node, const curve *c, double u)
{
    double x[ISO_EXPRESSION_NODES];
    const iso_expression_state s = state_at(c, u);
    iso_expression_values(e, &s, x);
    return x[node];
}

/* Its least value near u, by golden sections; *u becomes its place. */
static double least_near(const iso_expression *e, int node, const curve *c, double *u)
{
    const double golden = 0.6180339887498949, step = 2 * ISO_PI / POINTS;
    double low = *u - step, high = *u + step;
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = under(e, node, c, left), at_right = under(e, node, c, right);
    for (int i = 0; i < 40; i++) {
        const bool lower = at_left < at_right;
        if (lower)
            high = right, right = left, at_right = at_left, left = high - golden * (high - low);
        else
            low = left, left = right, at_left = at_right, right = low + golden * (high - low);
        *(lower ? &at_left : &at_right) = under(e, node, c, lower ? left : right);
    }
    *u = at_left < at_right ? left : right;
    return fmin(at_left, at_right);
}

/* m of x^m, of a number that is 0 at u. */
static double order_at(const iso_expression *e, int node, const curve *c, double u)
{
    const double d = 0.01;
    const double near = under(e, node, c, u - d) + under(e, node, c, u + d);
    const double far = under(e, node, c, u - 2 * d) + under(e, node, c, u + 2 * d);
    return log2(far / near);
}

/* Whether the least of three values in a row can be 0 between them: by the parabola through them. */
static bool may_touch(double before, double here, double after)
{
    const double bend = before - 2 * here + after, rise = after - before;
    if (!(before >= here && after >= here && here >= 0)) return false;
    return bend > 0 && here - rise * rise / (8 * bend) < 0.2 * fmax(before, after);
}

/* Whether the root of the number, to the power p, has a corner on the curve, and where. */
static bool has_corner(const iso_expression *e, int node, double p, const curve *c, double *where)
{
    double x[POINTS], most = 0;
    for (int i = 0; i < POINTS; i++) {
        x[i] = under(e, node, c, 2 * ISO_PI * i / POINTS);
        if (isfinite(x[i])) most = fmax(most, fabs(x[i]));
    }
    for (int i = 0; i < POINTS; i++) {
        if (!may_touch(x[(i + POINTS - 1) % POINTS], x[i], x[(i + 1) % POINTS])) continue;
        *where = 2 * ISO_PI * i / POINTS;
        if (!(fabs(least_near(e, node, c, where)) <= 1e-14 * most)) continue;
        const double order = order_at(e, node, c, *where) * p;
        if (fabs(order - (2 * floor(order / 2) + 1)) < 0.1) return true;
    }
    return false;
}

/* The power that a node takes of its node a; 0: it is no root. */
static double root_of(const iso_expression *e, const iso_expression_node *node, const double x[])
{
    if (node->degree == ISO_CONSTANT) return 0;
    if (node->term == ISO_TERM_SQRT) return 0.5;
    if (node->term != ISO_TERM_POWER || e->node[node->b].degree != ISO_CONSTANT) return 0;
    return x[node->b] == floor(x[node->b]) ? 0 : x[node->b];
}

static void say_where(iso_expression *e, const iso_expression_node *node, const iso_expression_state *s)
{
    char with[96] = "";
    e->at = node->at;
    if (e->reads[ISO_TERM_OMEGA])
        snprintf(with, sizeof with, " and omega = (%s, %s, %s)", ISO_ROUNDED(s->omega[0], 3),
                 ISO_ROUNDED(s->omega[1], 3), ISO_ROUNDED(s->omega[2], 3));
    snprintf(e->wrong, sizeof e->wrong,
             "this has a corner, for example at n = (%s, %s, %s)%s: the number under the root goes to 0 there and "
             "comes back. A corner has no series: write x for sqrt(x^2) if x keeps its sign, or sqrt(x^2 + a^2) with "
             "a small a",
             ISO_ROUNDED(s->n[0], 3), ISO_ROUNDED(s->n[1], 3), ISO_ROUNDED(s->n[2], 3), with);
}

bool iso_expression_corner(iso_expression *e, const iso_expression_state *s)
{
    double x[ISO_EXPRESSION_NODES], where = 0;
    bool found = false;
    iso_expression_values(e, s, x);
    for (int i = 0; i < e->nodes && !found; i++) {
        const iso_expression_node *node = &e->node[i];
        const double p = root_of(e, node, x);
        if (p == 0 || e->node[node->a].degree == ISO_CONSTANT) continue;
        iso_random *r = iso_random_create(1);
        for (int j = 0; r && j < CURVES && !found; j++) {
            const curve c = random_curve(r, s, j % 2 == 0 ? s->n : NULL);
            found = has_corner(e, node->a, p, &c, &where);
            const iso_expression_state there = state_at(&c, where);
            if (found) say_where(e, node, &there);
        }
        iso_random_free(r);
    }
    return found;
}

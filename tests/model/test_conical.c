/* Sphero-conical coordinates (12)-(13): roots, squares, distances from the b_i, rates; near coordinate planes too. */
#include "laws.h"
#include "model/conical_impl.h"

/* Indices of b from the least to the largest */
static void order_of(const double b[3], int order[3])
{
    for (int i = 0; i < 3; i++) {
        int rank = 0;
        for (int j = 0; j < 3; j++) rank += b[j] < b[i] || (b[j] == b[i] && j < i);
        order[rank] = i;
    }
}

static bool distinct(const double b[3])
{
    return b[0] != b[1] && b[1] != b[2] && b[2] != b[0];
}

/* (13) as products of distances, to full relative accuracy however small x_i is:
 * (z1 - b_i)(z2 - b_i) = x_i^2 prod (b_i - b_j);  and the sum of the roots, z1 + z2 = sum b_i (1 - x_i^2). */
static void note_coordinates(const iso_params *p, const double x[3], const iso_conical *at, laws_worst *worst,
                             const char *what)
{
    const double *b = p->J, largest = max3(b), range = largest - min3(b);
    double sum = 0;
    int o[3];
    order_of(b, o);
    for (int i = 0; i < 3; i++) {
        const double squares = x[i] * x[i] * (b[i] - b[(i + 1) % 3]) * (b[i] - b[(i + 2) % 3]);
        laws_note(worst, fabs(at->above[0][i] * at->above[1][i] - squares), 16 * DBL_EPSILON * fabs(squares), p,
                  what);
        sum += b[i] * (x[(i + 1) % 3] * x[(i + 1) % 3] + x[(i + 2) % 3] * x[(i + 2) % 3]);
        for (int r = 0; r < 2; r++)
            laws_note(worst, fabs(at->z[r] - b[i] - at->above[r][i]), 4 * DBL_EPSILON * largest, p, "z - b");
    }
    laws_note(worst, fabs(at->z[0] + at->z[1] - sum), 8 * DBL_EPSILON * largest, p, "sum of the roots");
    laws_note(worst, fabs(at->above[0][o[1]] + at->above[1][o[1]] - (sum - 2 * b[o[1]])), 16 * DBL_EPSILON * largest,
              p, "sum of the distances");
    const double ends[] = {at->above[0][o[0]],  -at->above[0][o[1]], at->above[1][o[1]],
                           -at->above[1][o[2]], -at->above[0][o[2]], at->above[1][o[0]]};
    for (int i = 0; i < 6; i++) laws_note(worst, fmax(-ends[i], 0), 4 * DBL_EPSILON * range + DBL_MIN, p, "order");
}

static void from_vector(const laws_case *c, laws_worst *worst)
{
    iso_conical at;
    iso_conical_from_vector(c->problem.p.J, c->y + 3, NULL, &at);
    note_coordinates(&c->problem.p, c->y + 3, &at, worst, "squares");
    laws_note(worst, fabs(at.rate[0]) + fabs(at.rate[1]), DBL_TRUE_MIN, &c->problem.p, "no velocity");
}

/* Vector and velocity come back from the angles and the speeds. */
static void to_vector(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    double x[3], velocity[3];
    iso_conical at;
    iso_conical_from_vector(p->J, c->y + 3, c->y, &at);
    iso_conical_to_vector(p->J, &at, x, velocity);
    for (int i = 0; i < 3; i++) {
        laws_note(worst, fabs(x[i] - c->y[3 + i]), 8 * DBL_EPSILON * fabs(x[i]), p, "vector");
        laws_note(worst, fabs(velocity[i] - c->y[i]), 8 * DBL_EPSILON * norm(c->y), p, "velocity");
    }
}

/* g = lam mu/det J */
static void product_is_g(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    iso_conical at;
    iso_conical_from_vector(p->J, c->y + 3, NULL, &at);
    const double g = dot_diag(c->y + 3, p->inv_J, c->y + 3);
    laws_note(worst, fabs(at.z[0] * at.z[1] / p->det_J - g), 8 * DBL_EPSILON * laws_spread(p) * g, p, "");
}

/* The order in which the axes are given does not matter. */
static void any_order(const laws_case *c, laws_worst *worst)
{
    const double *b = c->problem.p.J, *x = c->y + 3, *v = c->y;
    iso_conical at, turned;
    iso_conical_from_vector(b, x, v, &at);
    if (!distinct(b)) return;
    for (int shift = 1; shift < 3; shift++) {
        double b2[3], x2[3], v2[3];
        for (int i = 0; i < 3; i++) {
            const int from = (i + shift) % 3;
            b2[i] = b[from], x2[i] = x[from], v2[i] = v[from];
        }
        iso_conical_from_vector(b2, x2, v2, &turned);
        for (int r = 0; r < 2; r++) {
            laws_note(worst, fabs(turned.z[r] - at.z[r]), DBL_TRUE_MIN, &c->problem.p, "z");
            laws_note(worst, fabs(turned.rate[r] - at.rate[r]), DBL_TRUE_MIN, &c->problem.p, "rate");
            for (int i = 0; i < 3; i++)
                laws_note(worst, fabs(turned.above[r][i] - at.above[r][(i + shift) % 3]), DBL_TRUE_MIN, &c->problem.p,
                          "above");
        }
    }
}

/* Within 1e-12 and 1e-120 of every coordinate plane, and of two at once, the distances keep all their digits. */
static void near_planes(const laws_case *c, laws_worst *worst)
{
    static const double small[] = {1e-5, 1e-12, 1e-120, 0};
    if (!distinct(c->problem.p.J)) return;
    for (int i = 0; i < 4; i++)
        for (int plane = 1; plane < 7; plane++) { /* bits: which components are small */
            double x[3];
            iso_conical at;
            copy(c->y + 3, x, 3);
            for (int j = 0; j < 3; j++)
                if (plane & 1 << j) x[j] *= small[i];
            make_unit(x);
            iso_conical_from_vector(c->problem.p.J, x, c->y, &at);
            note_coordinates(&c->problem.p, x, &at, worst, "small squares");
            laws_note(worst, isfinite(at.rate[0]) && isfinite(at.rate[1]) ? 0 : 1, 0.5, &c->problem.p,
                      "rates finite");
        }
}

/* For b = (1, 2, 6) the vector (1, 0, 2) is an umbilic, and at (1 + d, e, 2) the cosines follow without cancellation
 * from (cos^2 phi - 4 cos^2 psi) |x|^2 = -8 d - 4 d^2 - 3 e^2 and cos phi cos psi |x| = e. */
static void next_to_umbilic(double d, double e, laws_worst *worst)
{
    const double x[3] = {1 + d, e, 2};
    const iso_params p = laws_params(-1, (const double[]){1, 2, 6});
    const long double sum = -8.0L * d - 4.0L * d * d - 3.0L * e * e, N = 5 + 2.0L * d + (long double)d * d + e * e;
    const long double square = (fabsl(sum) + sqrtl(sum * sum + 16 * N * e * e)) / 2 / N;
    const double larger = (double)sqrtl(square), smaller = (double)(2 * e / sqrtl(N * square));
    const double phi = sum > 0 ? larger : smaller, psi = (sum > 0 ? smaller : larger) / 2;
    iso_conical at;
    iso_conical_from_vector(p.J, x, NULL, &at);
    laws_note(worst, fabs(at.cosine[0] - phi), 8 * DBL_EPSILON * phi, &p, "cos phi");
    laws_note(worst, fabs(at.cosine[1] - psi), 8 * DBL_EPSILON * psi, &p, "cos psi");
    laws_note(worst, fabs(at.gap - phi * phi - 4 * psi * psi), 32 * DBL_EPSILON * at.gap, &p, "gap");
}

static void check_umbilics(void)
{
    laws_worst worst = {0};
    for (double e = 1; e > 1e-300; e *= 1e-3) {
        next_to_umbilic(0, e, &worst);
        for (int bit = 2; bit <= 52; bit++) {
            next_to_umbilic(ldexp(1, -bit), e, &worst);
            next_to_umbilic(-ldexp(1, -bit), e, &worst);
        }
    }
    laws_report(&worst, "every digit next to an umbilic");
}

/* Equal moments: numbers, not NaN; the coordinate between two equal b is their value, and the angles are longitude
 * and latitude about axis 3 (b1 = b2) or 1. */
static void equal_moments(const laws_case *c, laws_worst *worst)
{
    const double *b = c->problem.p.J;
    if (distinct(b)) return;
    iso_conical at;
    int o[3];
    order_of(b, o);
    iso_conical_from_vector(b, c->y + 3, c->y, &at);
    note_coordinates(&c->problem.p, c->y + 3, &at, worst, "squares");
    const double longitude[2] = {at.sine[0] * at.cosine[1], at.sine[1] * fabs(at.cosine[0])};
    const bool last = b[o[0]] == b[o[1]];
    laws_note(worst, fabs(c->y[3 + at.axis[0]] - (last ? longitude[0] : at.sine[0])), 8 * DBL_EPSILON, &c->problem.p,
              "x1");
    laws_note(worst, fabs(c->y[3 + at.axis[2]] - (last ? at.sine[1] : longitude[1])), 8 * DBL_EPSILON, &c->problem.p,
              "x3");
    for (int r = 0; r < 2; r++) {
        laws_note(worst, isfinite(at.rate[r]) ? 0 : 1, 0.5, &c->problem.p, "rate");
        if (b[o[r]] == b[o[r + 1]]) {
            laws_note(worst, fabs(at.z[r] - b[o[r]]), 2 * DBL_EPSILON * b[o[r]], &c->problem.p,
                      "between equal moments");
            laws_note(worst, fabs(at.rate[r]), 8 * DBL_EPSILON * norm(c->y) * max3(b), &c->problem.p, "stays");
        }
    }
}

/* Rates against differences along the great circle's tangent: the unit length is kept to first order, as it must be,
 * since |x| != 1 moves the roots. */
static void on_circle(const void *data, const double angle[], double z[])
{
    const laws_case *c = data;
    double x[3], v[3];
    iso_conical at;
    copy(c->y, v, 3);
    make_unit(v);
    for (int i = 0; i < 3; i++) x[i] = cos(angle[0]) * c->y[3 + i] + sin(angle[0]) * v[i];
    iso_conical_from_vector(c->problem.p.J, x, NULL, &at);
    copy(at.z, z, 2);
}

/* ... for states where the two are 0.2 of their range apart: where they meet they are not smooth. */
static void rates(const laws_case *c, laws_worst *worst)
{
    const double zero = 0, one = 1, *b = c->problem.p.J, range = max3(b) - min3(b);
    if (!distinct(b)) return;
    iso_conical at;
    double v[3], slope[2];
    copy(c->y, v, 3);
    make_unit(v);
    iso_conical_from_vector(b, c->y + 3, v, &at);
    if (at.z[1] - at.z[0] < 0.2 * range) return;
    const double h = 0.1 / 128;
    laws_slope(on_circle, c, 2, 1, &zero, &one, h, slope);
    for (int r = 0; r < 2; r++)
        laws_note(worst, fabs(slope[r] - at.rate[r]), 8 * DBL_EPSILON * max3(b) / h, &c->problem.p, "");
}

int main(void)
{
    laws_hold("coordinates of n (12)", &iso_system_ball, from_vector);
    laws_hold("and back", &iso_system_ball, to_vector);
    laws_hold("lam mu/det J = g", &iso_system_ball, product_is_g);
    laws_hold("axes in any order", &iso_system_ball, any_order);
    laws_hold("near coordinate planes", &iso_system_ball, near_planes);
    check_umbilics();
    laws_hold("equal moments", &iso_system_ball, equal_moments);
    laws_hold("rates", &iso_system_ball, rates);
    exit(gsl_test_summary());
}

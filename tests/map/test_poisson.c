/* The algebra of e(3): bracket (20), Casimirs, Jacobi identity, the Hamiltonian (21) and its flow in tau. */
#include "laws.h"
#include "poisson.h"

enum { N = ISO_STATE };

/* Any six numbers: the bracket lives on all of e(3), not only where (M,gamma) = 0, |gamma| = 1. */
static void anywhere(const laws_case *c, double y[N])
{
    for (int i = 0; i < N; i++) y[i] = iso_random_normal(c->random);
}

static double levi_civita(int i, int j, int l)
{
    return (i - j) * (j - l) * (l - i) / 2.0;
}

/* (20), entry by entry */
static void brackets(const laws_case *c, laws_worst *worst)
{
    double y[N], B[N * N];
    anywhere(c, y);
    poisson_matrix(y, B);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double MM = 0, Mgamma = 0;
            for (int l = 0; l < 3; l++) {
                MM -= levi_civita(i, j, l) * y[l];
                Mgamma -= levi_civita(i, j, l) * y[3 + l];
            }
            laws_note(worst, fabs(B[N * i + j] - MM), DBL_MIN, &c->problem.p, "{M,M}");
            laws_note(worst, fabs(B[N * i + 3 + j] - Mgamma), DBL_MIN, &c->problem.p, "{M,gamma}");
            laws_note(worst, fabs(B[N * (3 + i) + j] - Mgamma), DBL_MIN, &c->problem.p, "{gamma,M}");
            laws_note(worst, fabs(B[N * (3 + i) + 3 + j]), DBL_MIN, &c->problem.p, "{gamma,gamma}");
        }
}

/* B d(M,gamma) = 0 and B d(gamma,gamma) = 0 */
static void casimirs(const laws_case *c, laws_worst *worst)
{
    double y[N], B[N * N];
    anywhere(c, y);
    poisson_matrix(y, B);
    const double gradient[2][N] = {{y[3], y[4], y[5], y[0], y[1], y[2]}, {0, 0, 0, y[3], y[4], y[5]}};
    for (int casimir = 0; casimir < 2; casimir++)
        for (int i = 0; i < N; i++) {
            double sum = 0, terms = 0;
            for (int j = 0; j < N; j++) {
                sum += B[N * i + j] * gradient[casimir][j];
                terms += fabs(B[N * i + j] * gradient[casimir][j]);
            }
            laws_note(worst, fabs(sum), 2 * DBL_EPSILON * terms + DBL_MIN, &c->problem.p,
                      casimir ? "gamma^2" : "(M,gamma)");
        }
}

/* sum_m B_im dB_jl/dy_m + cyclic = 0 */
static void jacobi(const laws_case *c, laws_worst *worst)
{
    double y[N], B[N * N], dB[N][N * N];
    anywhere(c, y);
    poisson_matrix(y, B);
    for (int m = 0; m < N; m++) { /* dB_jl/dy_m: B is linear */
        double unit[N] = {0};
        unit[m] = 1;
        poisson_matrix(unit, dB[m]);
    }
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            for (int l = 0; l < N; l++) {
                double sum = 0;
                for (int m = 0; m < N; m++)
                    sum += B[N * i + m] * dB[m][N * j + l] + B[N * j + m] * dB[m][N * l + i] +
                           B[N * l + m] * dB[m][N * i + j];
                laws_note(worst, fabs(sum), 4 * DBL_EPSILON * laws_max(N, y), &c->problem.p, "");
            }
}

static void hamiltonian(const void *data, const double y[], double H[])
{
    H[0] = poisson_hamiltonian(data, y, NULL);
}

static void gradient_of_h(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    double gradient[N], slope;
    const double H = poisson_hamiltonian(p, c->y, gradient);
    for (int j = 0; j < N; j++) {
        double direction[N] = {0};
        direction[j] = 1;
        const double h = laws_step(c, direction);
        laws_slope(hamiltonian, p, 1, N, c->y, direction, h, &slope);
        laws_note(worst, fabs(slope - gradient[j]), laws_rounding(p) * H / h, p, j < 3 ? "dH/dM" : "dH/dgamma");
    }
}

/* dM/dtau = M x dH/dM + gamma x dH/dgamma,  dgamma/dtau = gamma x dH/dM, from (20) */
static void equations(const laws_case *c, laws_worst *worst)
{
    const iso_params *p = &c->problem.p;
    const double *M = c->y, *gamma = c->y + 3;
    double dH[N], dy[N], M_dM[3], gamma_dgamma[3], gamma_dM[3];
    poisson_hamiltonian(p, c->y, dH);
    poisson_hamiltonian_rhs(p, c->y, dy);
    cross(M, dH, M_dM);
    cross(gamma, dH + 3, gamma_dgamma);
    cross(gamma, dH, gamma_dM);
    const double fast = norm(M) * norm(dH) + norm(dH + 3), slow = norm(dH);
    for (int i = 0; i < 3; i++) {
        laws_note(worst, fabs(dy[i] - M_dM[i] - gamma_dgamma[i]), 4 * DBL_EPSILON * fast, p, "M");
        laws_note(worst, fabs(dy[3 + i] - gamma_dM[i]), 4 * DBL_EPSILON * slow, p, "gamma");
    }
    laws_note(worst, fabs(dot(dH, dy) + dot(dH + 3, dy + 3)),
              8 * DBL_EPSILON * (norm(dH) * fast + norm(dH + 3) * slow), p, "dH/dtau");
}

/* --- a product G(gamma) F(M), (22)-(23) ------------------------------------------------------------------------- */

/* F = (M, S M)/2 + (M,M)^2/4 + (v, M), G = exp (a, gamma): its values, and slopes in M and in gamma. */
typedef struct product_of {
    double S[3], v[3], a[3];
} product_of;

static double factor_F(const product_of *of, const double y[N], double slope[N])
{
    for (int i = 0; i < 3; i++) slope[i] = of->S[i] * y[i] + dot(y, y) * y[i] + of->v[i], slope[3 + i] = 0;
    return dot_diag(y, of->S, y) / 2 + dot(y, y) * dot(y, y) / 4 + dot(of->v, y);
}

static double factor_G(const product_of *of, const double y[N], double slope[N])
{
    const double G = exp(dot(of->a, y + 3));
    for (int i = 0; i < 3; i++) slope[i] = 0, slope[3 + i] = G * of->a[i];
    return G;
}

static void flow(const double B[N * N], const double dH[N], double dy[N])
{
    for (int i = 0; i < N; i++) {
        dy[i] = 0;
        for (int j = 0; j < N; j++) dy[i] += B[N * i + j] * dH[j];
    }
}

/* The flow of G F is G times that of F - h/G, h = G F, anywhere on e(3): d(F - h/G) = dF + (h/G^2) dG. */
static void product(const laws_case *c, laws_worst *worst)
{
    double y[N], B[N * N], dF[N], dG[N], dH[N], of_product[N], of_point[N];
    product_of of;
    anywhere(c, y);
    poisson_matrix(y, B);
    for (int i = 0; i < 3; i++) {
        of.S[i] = iso_random_normal(c->random);
        of.v[i] = iso_random_normal(c->random);
        of.a[i] = iso_random_normal(c->random);
    }
    const double F = factor_F(&of, y, dF), G = factor_G(&of, y, dG), h = G * F;
    for (int i = 0; i < N; i++) dH[i] = G * dF[i] + F * dG[i];
    flow(B, dH, of_product);
    for (int i = 0; i < N; i++) dH[i] = dF[i] + h / (G * G) * dG[i];
    flow(B, dH, of_point);
    const double size = laws_max(N, y) * (laws_max(N, dF) + fabs(F) * laws_max(3, of.a));
    for (int i = 0; i < N; i++)
        laws_note(worst, fabs(of_product[i] / G - of_point[i]), 64 * DBL_EPSILON * size, &c->problem.p, "");
}

int main(void)
{
    laws_hold("brackets (20)", &iso_system_point, brackets);
    laws_hold("Casimirs", &iso_system_point, casimirs);
    laws_hold("Jacobi identity", &iso_system_point, jacobi);
    laws_hold("gradient of H (21)", &iso_system_point, gradient_of_h);
    laws_hold("equations in tau", &iso_system_point, equations);
    laws_hold("a product G F, on its level, is F - h/G in another time", &iso_system_point, product);
    exit(gsl_test_summary());
}

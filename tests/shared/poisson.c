/* poisson.c - the bracket (20) and the Hamiltonian (21) of the ball in the time tau (poisson.h). */
#include "poisson.h"

#include <math.h>

#include "base/vec3_impl.h"

/* B = -[ hat(M) hat(gamma); hat(gamma) 0 ] with hat(a)_ij = eps_ijk a_k */
void poisson_matrix(const double y[ISO_STATE], double B[ISO_STATE * ISO_STATE])
{
    for (int i = 0; i < ISO_STATE * ISO_STATE; i++) B[i] = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3; /* eps_ijl = 1 */
        B[6 * i + j] = -y[l];
        B[6 * j + i] = y[l];
        B[6 * i + 3 + j] = B[6 * (3 + i) + j] = -y[3 + l];
        B[6 * j + 3 + i] = B[6 * (3 + j) + i] = y[3 + l];
    }
}

double poisson_hamiltonian(const iso_params *p, const double y[ISO_STATE], double gradient[ISO_STATE])
{
    const double *M = y, *gamma = y + 3;
    const double q = dot_diag(gamma, p->J, gamma), G = p->k * p->k / p->det_J * pow(q, 1 / p->k);
    const double H = G * dot(M, M) / 2;
    if (gradient)
        for (int i = 0; i < 3; i++) {
            gradient[i] = G * M[i];
            gradient[3 + i] = H / (p->k * q) * 2 * p->J[i] * gamma[i];
        }
    return H;
}

void poisson_hamiltonian_rhs(const iso_params *p, const double y[ISO_STATE], double dy[ISO_STATE])
{
    double B[ISO_STATE * ISO_STATE], dH[ISO_STATE];
    poisson_matrix(y, B);
    poisson_hamiltonian(p, y, dH);
    for (int i = 0; i < ISO_STATE; i++) {
        dy[i] = 0;
        for (int j = 0; j < ISO_STATE; j++) dy[i] += B[ISO_STATE * i + j] * dH[j];
    }
}

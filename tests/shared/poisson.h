/* poisson.h - the ball as a Hamiltonian system on e(3), in the time tau (20)-(21).
 *
 *     {M_i,M_j} = -eps_ijk M_k,   {M_i,gamma_j} = -eps_ijk gamma_k,   {gamma_i,gamma_j} = 0                 (20)
 *     H = (1/2) (k^2/det J) q^(1/k) M^2,    q = (gamma, J gamma)                                            (21)
 *     dM/dtau = M x dH/dM + gamma x dH/dgamma,     dgamma/dtau = gamma x dH/dM
 */
#ifndef ISO_TESTS_POISSON_H
#define ISO_TESTS_POISSON_H

#include "model/system.h"

/* The matrix B of the bracket at y = (M, gamma): {f,g} = (df, B dg); row-major. */
void poisson_matrix(const double y[ISO_STATE], double B[ISO_STATE * ISO_STATE]);

/* H of (21), equal to the ball's energy, and its gradient (may be NULL). */
double poisson_hamiltonian(const iso_params *p, const double y[ISO_STATE], double gradient[ISO_STATE]);

/* dy/dtau = B dH. */
void poisson_hamiltonian_rhs(const iso_params *p, const double y[ISO_STATE], double dy[ISO_STATE]);

#endif

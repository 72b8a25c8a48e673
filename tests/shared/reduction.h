/* reduction.h - the ball in sphero-conical coordinates: Chaplygin's reducing multiplier (14)-(17).
 *
 * lam < mu are the coordinates of n in J (model/conical_impl.h), A(z) = (J1 - z)(J2 - z)(J3 - z). Formulas in the rates
 * and momenta of lam and mu divide by A(lam) and A(mu): they hold off the coordinate planes and for three different
 * moments of inertia.
 */
#ifndef ISO_TESTS_REDUCTION_H
#define ISO_TESTS_REDUCTION_H

#include "model/conical_impl.h"
#include "model/system.h"

/* (lam, mu) and their rates along the ball's motion; and the ball (omega, n) that has them, for every state. */
void reduction_coordinates(const iso_params *p, const double ball[ISO_STATE], iso_conical *c);
void reduction_ball(const iso_params *p, const iso_conical *c, double ball[ISO_STATE]);

/* Energy T = a lam'^2 + b mu'^2 (14):
 * a = -mu (mu - lam)/(8 k^2 A(lam)),  b = lam (mu - lam)/(8 k^2 A(mu)). */
double reduction_energy(const iso_params *p, const iso_conical *c);

/* S = (2k-1)/(8 k^3) (lam - mu) (lam'/A(lam) + mu'/A(mu)) (15), the nonholonomic force: mu' S and -lam' S. */
double reduction_force(const iso_params *p, const iso_conical *c);

/* N = (lam mu/det J)^(-1 + 1/(2k)) (16), d tau = N dt. */
double reduction_multiplier(const iso_params *p, const iso_conical *c);

/* Momenta p = N dT/dlam', N dT/dmu', canonical in tau (17). */
void reduction_momenta(const iso_params *p, const iso_conical *c, double momenta[2]);

/* Those of the angles, p dlam/dphi and p dmu/dpsi, finite for every state: with (14) as
 * T = (mu speed1^2 + lam speed2^2)/(2 k^2) they are N mu length1 speed1/k^2 and N lam length2 speed2/k^2. */
void reduction_angle_momenta(const iso_params *p, const iso_conical *c, double momenta[2]);

/* The energy as the Hamiltonian of (17): p_lam^2/(4 a N^2) + p_mu^2/(4 b N^2). */
double reduction_hamiltonian(const iso_params *p, const iso_conical *c, const double momenta[2]);

#endif

/* conical_impl.h - sphero-conical coordinates of a vector on the unit sphere (12)-(13), by angles that lose nothing.
 *
 * For b1 <= b2 <= b3 the roots z1 <= z2 of  sum x_i^2/(b_i - z) = 0  lie in b1 <= z1 <= b2 <= z2 <= b3, and
 *     x_i^2 = (b_i - z1)(b_i - z2) / prod_{j != i} (b_i - b_j).
 * With x = n, b = J they are (lam, mu) of section 3; with x = gamma, b = J the (u, v) of section 5 (Neumann); with
 * x = gamma, b = 1/J they are (1/mu, 1/lam). The axes may be given in any order.
 *
 * As numbers they lose x where a root meets one of the b: x_i is the root of a product of distances, and has a sign.
 * Angles keep it:
 *
 *     z1 - b1 = (b2 - b1) sin^2 phi,   z2 - b2 = (b3 - b2) cos^2 psi,   x1 = sin phi sqrt((z2 - b1)/(b3 - b1)),
 *     b2 - z1 = (b2 - b1) cos^2 phi,   b3 - z2 = (b3 - b2) sin^2 psi,   x2 = cos phi cos psi,
 *                                                                       x3 = sin psi sqrt((b3 - z1)/(b3 - b1)).
 *
 * Their sines and cosines are exact to some units in the last place. Their signs, also those of zeros, are those of
 * x. (phi, psi) and (pi - phi, pi - psi) are the same x, and the one with cos psi >= 0 is given. As x crosses
 * x2 = 0 where z2 = b2 (psi = +-pi/2), the one turns into the other.
 *
 * Where something is free it is chosen. At an umbilic, z1 = b2 = z2, phi grows along the plane x2 = 0 and psi across
 * it. For b1 = b2 the angles are the longitude phi and the latitude psi about axis 3, for b2 = b3 psi and phi about
 * axis 1, with longitude 0 or pi at the poles; three equal b are taken as b1 = b2.
 */
#ifndef ISO_MODEL_CONICAL_IMPL_H
#define ISO_MODEL_CONICAL_IMPL_H

typedef struct iso_conical {
    double sine[2], cosine[2]; /* of phi and psi                                                     */
    /* Components of dx/dt in the directions, orthogonal, in which phi and psi grow. */
    double speed[2];

    /* What follows from them; not read on the way back. */
    double length[2];   /* |dx/dphi|, |dx/dpsi|: phi' = speed/length, 0 at an umbilic                 */
    double z[2];        /* the coordinates, ascending                                                */
    double gap;         /* z2 - z1 without cancellation                                              */
    double rate[2];     /* their time derivatives                                                    */
    double above[2][3]; /* z[r] - b[i] without cancellation, in the caller's order                   */
    double b[3];        /* b1 <= b2 <= b3 ...                                                        */
    int axis[3];        /* ... and where the caller has them                                         */
} iso_conical;

/* Coordinates of the unit vector x, and their rates if x moves at `velocity`, orthogonal to it (NULL: 0). Of x all of
 * the direction and nothing of the length is used. The rates are 0/0, and given as 0, where z1 = z2. */
void iso_conical_from_vector(const double b[3], const double x[3], const double velocity[3], iso_conical *c);

/* The way back, to some units in the last place of each component of x, and of the size of the velocity. */
void iso_conical_to_vector(const double b[3], const iso_conical *c, double x[3], double velocity[3]);

#endif

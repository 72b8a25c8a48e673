/* conical.h - sphero-conical coordinates of a vector on the unit sphere (12)-(13).
 *
 * For b1 <= b2 <= b3 the roots z1 <= z2 of  sum x_i^2/(b_i - z) = 0  lie in b1 <= z1 <= b2 <= z2 <= b3, and
 *     x_i^2 = (b_i - z1)(b_i - z2) / prod_{j != i} (b_i - b_j).
 * With x = n, b = J they are (lam, mu) of section 3; with x = gamma, b = J the (u, v) of section 5 (Neumann); with
 * x = gamma, b = 1/J they are (1/mu, 1/lam). The axes may be given in any order.
 */
#ifndef ISO_MODEL_CONICAL_H
#define ISO_MODEL_CONICAL_H

typedef struct iso_conical {
    double z[2];    /* the coordinates, ascending                                  */
    double rate[2]; /* their time derivatives                                      */
    double above[2][3]; /* z[r] - b[i] without cancellation, in the caller's order */
} iso_conical;

/* Coordinates of the unit vector x, and their rates if x moves at `velocity` (NULL: rates 0).
 * The rates are 0/0, and given as 0, where z1 = z2 (there b2 = z1 = z2 and x2 = 0). */
void iso_conical_from_vector(const double b[3], const double x[3], const double velocity[3], iso_conical *c);

/* The squares x_i^2 (13); the signs are not in the coordinates. Needs three different b. */
void iso_conical_to_squares(const double b[3], const double z[2], double squares[3]);

#endif

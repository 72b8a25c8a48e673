/* two_point_impl.h - how far the clocks and the state go between two samples of an orbit, from the equations of
 * motion at both samples.
 *
 *     iso_two_point *b;
 *     iso_two_point_create(ctx, &model, 1e-14, &b);
 *     iso_two_point_add(b, y0);
 *     iso_two_point_add(b, y1);
 *     if (iso_two_point_measure(b, h, 0, &gap)) s += gap.gained[ISO_CLOCK_S];
 *     iso_two_point_free(b);
 *
 * The equations give every derivative of the state, and of the clocks' rates, at both samples. With the Taylor
 * coefficients f_j at the left one and g_j at the right one
 *
 *     int_0^h f dt = sum_(j=0)^p c_j h^(j+1) (f_j + (-1)^j g_j)
 *     c_j = (p+1)! (2p+1-j)! j! / ((2p+2)! (j+1)! (p-j)!)
 *
 * is exact for polynomials of degree 2p+1: two-point Taylor, Hermite's or Obreshkov's quadrature. If f is the rate of
 * a clock, the integral is the time that the clock goes on. If f is y' and both samples lie on one orbit, the
 * integral is y1 - y0. If it is not, the difference is the defect.
 */
#ifndef ISO_METHOD_TWO_POINT_IMPL_H
#define ISO_METHOD_TWO_POINT_IMPL_H

#include "model/model.h"

typedef struct iso_two_point iso_two_point;

typedef struct iso_gap {
    double gained[ISO_CLOCKS]; /* by the clocks that the model carries, 0 for others                       */
    double error[ISO_CLOCKS];  /* of these, estimated: what the last derivative contributes                */
    double defect;             /* the largest of (y1 - y0 - int y' dt), relative to each vector's length   */
    double motion[ISO_STATE];  /* y1 - y0 - int y' dt itself, likewise                                     */
} iso_gap;

/* For samples of that model, whose states are those of its system alone. tolerance: relative error that a clock's
 * gain may have. Errors: ISO_NO_MEMORY. */
iso_status iso_two_point_create(iso_context *ctx, const iso_model *model, double tolerance,
                                iso_two_point **quadrature);
void iso_two_point_free(iso_two_point *quadrature);

/* The next sample, six numbers; the one before becomes the left one. */
void iso_two_point_add(iso_two_point *quadrature, const double y[ISO_STATE]);

/* From the left sample to the right one, h of the model's clock later, as exactly as the tolerance wants or the noise
 * of the samples allows (what defects they have as a rule, 0 or more). False: they are too far apart for that, or the
 * series diverge. */
bool iso_two_point_measure(iso_two_point *quadrature, double h, double noise, iso_gap *gap);

#endif

/* spectrum.h - the lines of a quasi-periodic signal: frequency analysis (J. Laskar, Physica D 67, 1993, 257).
 *
 *     x(t) = sum_l a_l exp(i nu_l t),   found one after the other, the largest first: nu maximises
 *     |phi(nu)|,   phi(nu) = (1/2T) int_-T^T x(t) exp(-i nu t) chi_p(t) dt,
 *     chi_p(t) = 2^p (p!)^2/(2p)! (1 + cos(pi t/T))^p,   p = 3,
 *
 * First the largest bin of a discrete Fourier transform is taken, then Newton's method refines it. Then the
 * amplitudes of all lines found so far are fitted anew (they are not orthogonal) and taken out of x. Two lines at a
 * distance d disturb each other like (1/dT)^(2p+1). So the frequencies are exact nearly to rounding if each pair of
 * lines beats a few dozen times in the signal; a Fourier transform alone gives them to 1/T.
 */
#ifndef ISO_STUDY_SPECTRUM_H
#define ISO_STUDY_SPECTRUM_H

#include <stddef.h>

#include "base/context.h"

enum { ISO_MAX_LINES = 24 };

/* a exp(i (frequency (t - t0) + phase)), a = amplitude > 0, t0 the time of the first sample */
typedef struct iso_spectral_line {
    double frequency; /* radians per unit of time, of either sign, |frequency| <= pi/step */
    double amplitude, phase;
} iso_spectral_line;

#endif

/* state.h - the isomorphism, point by point (18)-(19), and what fixes it: energy h and coupling eps (24).
 *
 *     NN = (sqrt(det J)/k) q^(-1/(2k)),     q = (gamma, J gamma) = 1/(n, J^-1 n)
 *     M = NN J^(1/2) w,                     gamma = J^(-1/2) n / |J^(-1/2) n|                                (18)
 *     w = J^(-1/2) M / NN,                  n = J^(1/2) gamma / |J^(1/2) gamma|
 *
 * For k < 0 (a shell) NN < 0: M points against w. States are (w, n) and (M, gamma), six numbers, in the units of J.
 */
#ifndef ISO_MAP_STATE_H
#define ISO_MAP_STATE_H

#include "model/system.h"

/* Each way, all of n's (gamma's) direction and nothing of its length is used; ball and point may be one array. */
void iso_ball_to_point(const iso_params *p, const double ball[ISO_STATE], double point[ISO_STATE]);
void iso_point_to_ball(const iso_params *p, const double point[ISO_STATE], double ball[ISO_STATE]);

/* To the states of iso_system_point_in_t, (p, gamma) with p = M/NN = J^(1/2) w. The way back: model/model_impl.h. */
void iso_ball_to_point_in_t(const iso_params *p, const double ball[ISO_STATE], double y[ISO_STATE]);

/* The ball's energy h = (w,Jw)/2. */
double iso_ball_energy(const iso_params *p, const double ball[ISO_STATE]);

#endif

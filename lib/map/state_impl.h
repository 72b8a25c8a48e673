/* state_impl.h - the map to the states of iso_system_point_t. The way back: model/model_impl.h. */
#ifndef ISO_MAP_STATE_IMPL_H
#define ISO_MAP_STATE_IMPL_H

#include "map/state.h"

/* The states of iso_system_point_t, (p, gamma) with p = M/NN = J^(1/2) w, likewise. */
void iso_ball_to_point_t(const iso_params *p, const double ball[ISO_STATE], double y[ISO_STATE]);

#endif

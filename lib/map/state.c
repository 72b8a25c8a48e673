/* state.c - the map (18) and the energies of the two models. */
#include "map/state.h"

#include "base/vec3_impl.h"
#include "model/model_impl.h"

void iso_ball_to_point_in_t(const iso_params *p, const double ball[ISO_STATE], double y[ISO_STATE])
{
    for (int i = 0; i < 3; i++) {
        y[i] = p->root_J[i] * ball[i];
        y[3 + i] = ball[3 + i] / p->root_J[i];
    }
    make_unit(y + 3);
}

void iso_ball_to_point(const iso_params *p, const double ball[ISO_STATE], double point[ISO_STATE])
{
    iso_ball_to_point_in_t(p, ball, point);
    iso_point_in_t_to_point(p, point, point);
}

void iso_point_to_ball(const iso_params *p, const double point[ISO_STATE], double ball[ISO_STATE])
{
    iso_point_to_point_in_t(p, point, ball);
    iso_point_in_t_to_ball(p, ball, ball);
}

double iso_ball_energy(const iso_params *p, const double ball[ISO_STATE])
{
    return dot_diag(ball, p->J, ball) / 2;
}

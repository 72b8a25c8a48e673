/* contact_impl.h - the ball under torques MQ = T, with its two kinds of contact.
 *
 *     rigid      J w' = J w x w + T + lambda n,  (w,n) = 0                                                 (9)
 *     twisting   K' = K x w + T,  K = J w - D (w,n) n        (T has the twist resistance in it)
 *
 * Both set dy[0..5] = (w', n'), n' = k n x w. The Jacobian is in slopes.c.
 */
#ifndef ISO_MODEL_EFFECTS_CONTACT_IMPL_H
#define ISO_MODEL_EFFECTS_CONTACT_IMPL_H

#include "base/vec3_impl.h"
#include "model/problem.h"

void iso_contact_rigid(const iso_problem *f, const double y[], const double T[3], double dy[]);
void iso_contact_twisting(const iso_problem *f, const double y[], const double T[3], double dy[]);

/* lambda of the torque lambda n of the rigid contact. */
double iso_contact_lambda(const iso_problem *f, const double y[], const double T[3]);

/* K of a twisting contact, the momentum about it. */
static inline void contact_momentum(const iso_params *p, const double y[], double K[3])
{
    diag(p->J, y, K);
    add_scaled(K, -p->D * dot(y, y + 3), y + 3);
}

#endif

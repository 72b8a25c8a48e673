/* contact_impl.h - the ball under torques MQ = T, with its two kinds of contact.
 *
 *     rigid      J w' = J w x w + T + lambda n,  (w,n) = 0                                                 (9)
 *     twisting   K' = K x w + T,  K = J w - D (w,n) n        (T has the twist resistance in it)
 *
 * Both give dy[0..5] = (w', n'), n' = k n x w. `twist`: lambda of the contact's torque lambda n, (9)'s or that of the
 * effect that resists twisting. The Jacobian is in slopes.c.
 */
#ifndef ISO_MODEL_CONTACT_IMPL_H
#define ISO_MODEL_CONTACT_IMPL_H

#include "base/vec3_impl.h"
#include "model/problem.h"

typedef struct iso_contact {
    void (*solve)(const iso_problem *f, const double y[], const double T[3], double dy[]);
    double (*twist)(const iso_problem *f, const double y[], const double T[3]);
} iso_contact;

extern const iso_contact iso_contact_rigid, iso_contact_twisting;

/* The contact that a problem's effects make. */
const iso_contact *iso_contact_of(const iso_problem *f);

/* K of a twisting contact, the momentum about it. */
static inline void contact_momentum(const iso_params *p, const double y[], double K[3])
{
    diag(p->J, y, K);
    add_scaled(K, -p->D * dot(y, y + 3), y + 3);
}

#endif

/* reactions.h - what the support does to the ball.
 *
 *     a_c = b [ w' x n + w x n' + w x (w x n) ]          acceleration of the centre, in body axes
 *     N = m a_c - F,   F = -m g e under gravity           contact force
 *
 * The twist torque lambda n acts as well: lambda of (9), or -c (w,n) of a contact that twists. With D = m b^2 all of
 * this needs mass and radius only as b: forces are given times |b|, as energies.
 */
#ifndef ISO_MODEL_REACTIONS_H
#define ISO_MODEL_REACTIONS_H

#include "../base/api.h"
#include "problem.h"

ISO_C_BEGIN

typedef struct iso_reactions {
    double force[3]; /* |b| N in body axes [energy]                                                        */
    /* |b| times the part of N by which the support pushes the ball [energy]; < 0: it would have to pull, contact is
     * lost. */
    double pressure;
    double friction; /* |b| times the size of the tangential part [energy]                                 */
    double needed;   /* friction coefficient needed, friction/|pressure| (infinite where it is 0)        */
    double twist;    /* lambda [energy]                                                                     */
} iso_reactions;

/* At a state y of the ball's model in this problem; problem->p.D > 0. */
iso_reactions iso_reactions_at(const iso_problem *problem, const double y[]);

ISO_C_END

#endif

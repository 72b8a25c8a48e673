/* rest_impl.h - where a motion ends: what an integrator asks the model about it.
 *
 * A ball that only loses motion comes to rest, and rests from then on. Three things follow, which no step of a method
 * can find by itself:
 * - At rest nothing changes but clocks, and these go on evenly: any time is one step away.
 * - Backwards in time resistance drives the ball. It turns faster without end, and no number of steps is enough.
 * - While a ball loses its motion, what a method has lost of a constraint stays. In the end that loss is all there
 *   is.
 */
#ifndef ISO_MODEL_REST_IMPL_H
#define ISO_MODEL_REST_IMPL_H

#include "model/model.h"

/* Whether the model rests in state y, and stays there from then on. */
bool iso_model_at_rest(const iso_model *m, const double y[]);

/* y becomes the state a time dt after y, for a model at rest. One evaluation of m->rhs. */
void iso_model_rest(const iso_model *m, double dt, double y[]);

/* Whether the model, going backwards in time from y0, has come to a y from which it goes on ever faster. Returns what
 * happens, in words; NULL: it does not. */
const char *iso_model_speeds_up(const iso_model *m, const double y0[], const double y[]);

/* Whether a state y, found by a method that does not restore constraints, has lost one so far that y is no answer any
 * more. `tolerance` is that of the steps. Returns what is lost, in words; NULL: nothing. */
const char *iso_model_lost(const iso_model *m, const double y[], double tolerance);

#endif

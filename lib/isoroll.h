/* isoroll.h - everything: the floors of the library, bottom-up. A header includes only floors below its own.
 *
 * A host program's rounding mode, floating-point traps, flush-to-zero mode and locale change no result by a bit: what
 * answers an iso_status computes by C's default rules (so does what it calls back), and gives the host's back. Single
 * formulas, which answer numbers (most of model and map), are computed by the host's rules.
 */
#ifndef ISOROLL_H
#define ISOROLL_H

/* C++ programs include this header, not single floors: it says that all of it is C. What the floors include of the
 * C library comes first, outside of that. */
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* base: no physics */
#include "base/status.h"
#include "base/context.h"
#include "base/number.h"
#include "base/random.h"
#include "base/record.h"

/* model: what moves */
#include "model/params.h"
#include "model/effect_list.h"
#include "model/formula.h"
#include "model/problem.h"
#include "model/system.h"
#include "model/effect.h"
#include "model/model.h"
#include "model/reactions.h"
#include "model/conical.h"

/* map: the isomorphism between ball and point */
#include "map/state.h"
#include "map/poisson.h"
#include "map/reduction.h"

/* method: integrators behind one table */
#include "method/method.h"
#include "method/two_point.h"

/* exact: separated coordinates; any time at the same cost, for k = 1 and k = -1 */
#include "exact/coordinates.h"
#include "exact/exact.h"

/* orbit: where the ball, or the point, is at any time */
#include "orbit/scene.h"
#include "orbit/orbit.h"
#include "orbit/batch.h"
#include "orbit/description.h"
#include "orbit/convert.h"

/* study: what people do with orbits */
#include "study/analogue.h"
#include "study/check.h"
#include "study/compare.h"
#include "study/error.h"
#include "study/momentum.h"
#include "study/run.h"
#include "study/spectrum.h"
#include "study/frequencies.h"
#include "study/cost.h"

/* io: scene and trajectory files, text files, plots */
#include "io/scene_file.h"
#include "io/output.h"
#include "io/trajectory.h"
#include "io/plot.h"

#ifdef __cplusplus
}
#endif

#endif

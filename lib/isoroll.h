/* isoroll.h - everything: the floors of the library, bottom-up. A header includes only floors below its own. */
#ifndef ISOROLL_H
#define ISOROLL_H

/* base: no physics */
#include "base/status.h"
#include "base/context.h"
#include "base/number.h"
#include "base/random.h"
#include "base/record.h"

/* model: what moves */
#include "model/params.h"
#include "model/system.h"
#include "model/model.h"

/* orbit: where the ball, or the point, is at any time */
#include "orbit/scene.h"

#endif

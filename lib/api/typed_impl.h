/* typed_impl.h - the typed functions that the command and the tests call most. */
#ifndef ISO_API_TYPED_IMPL_H
#define ISO_API_TYPED_IMPL_H

/* base: no physics */
#include "base/context.h"
#include "base/field.h"
#include "base/record.h"
#include "base/status.h"
#include "base/version.h"

/* model: what moves */
#include "model/effects/effect.h"
#include "model/params.h"

/* orbit: where the ball, or the point, is at any time */
#include "orbit/batch.h"
#include "orbit/description.h"
#include "orbit/orbit.h"
#include "orbit/scene.h"

/* io: scene and trajectory files */
#include "io/scene_file.h"
#include "io/table.h"

/* task: all rows of a scene; the other model's rows */
#include "task/convert/convert.h"
#include "task/run.h"

#endif

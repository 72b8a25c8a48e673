/* isoroll.h - what most programs need: a context, parameters, effects, scenes, orbits, batches, runs, conversions,
 * scene files and trajectory files. Other headers are included by name, such as <isoroll/task/cost/cost.h>.
 *
 * Rules for all functions of the library. A header names only the exceptions.
 *
 * Arguments stand in this order: the context, the object that is asked or changed, the inputs, the outputs.
 * Functions of an object that keeps its context (orbits, conversions, error finders) take no context.
 *
 * Results. A function that can fail returns an iso_status, and the context then has the words
 *   (iso_context_message). After an error the outputs are not defined, but an output that is a new object is NULL.
 *
 * Ownership. What *_create, *_open, *_read or another function gives as a new object belongs to the caller,
 *   who releases it by the *_free or *_close of its type. Both accept NULL.
 * - Strings and pointers that a function returns belong to the library or to the object asked. They are valid until
 *   that object changes or is released.
 * - Inputs are read, not kept: they may go after the call. Headers name the exceptions, such as
 *   the header of a conversion. An object must not outlive its context.
 *
 * NULL is allowed only where a header says so, and for option structs, where it means the defaults. Strings that a call
 *   takes (names, texts, paths, keys) end with a zero byte and are not NULL: the library does not test it.
 *
 * Option structs come from their *_defaults function; then members are set. Its member `size` is the size of the
 *   struct in the headers that the program was compiled with, so the struct can grow. 0 means: as in
 *   version 0.2. The library refuses a size that is larger than its own.
 *
 * Units are the caller's own, any that fit together (SI, for example). Angles are in radians. Axes are those of the
 *   body. Vectors have three numbers, states six: omega, n of the ball; M, gamma of the point.
 *
 * Threads. A context, and objects made with it, are for one thread at a time. Different contexts share nothing.
 *
 * Errors never end the program, and the library prints nothing. See base/context.h for GSL's error handler.
 *
 * The host's rounding mode, floating-point traps, flush-to-zero mode and locale change no result by a bit: a function
 *   that returns an iso_status computes by C's default rules (so does what it calls back), and restores the host's.
 *   Single formulas, which return numbers (most of model and map), are computed by the host's rules.
 */
#ifndef ISOROLL_H
#define ISOROLL_H

/* base: no physics */
#include "base/api.h"
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

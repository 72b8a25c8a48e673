/* scene_file.h - reads scenes: one problem, written in YAML.
 *
 *     ball:    {mass: 6.8, radius: 0.1092, inertia: [0.0270, 0.0274, 0.0283]}
 *     surface: {kind: shell, radius: 0.0546}            # plane (no radius) | outside | inside | shell
 *     initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}   # , project: true
 *     time:    {end: 100, step: 0.1}                    # no step: a hundredth of |end|
 *     solver:  {backend: auto, method: auto, tolerance: 1.0e-12}                     # may be absent
 *     output:  {as: ball, columns: [t, omega1, n1]}                                  # may be absent
 *
 * In place of ball and surface: `reduced: {k: -1, J: [1.4, 2.1, 3.0]}`, or from the point's side
 * `point: {k: -1, J: [1.4, 2.1, 3.0], eps: 6.5}` with `initial: {gamma: [...], M: [...]}`; without eps it is the
 * coupling that puts the start on the level H = 0.
 *
 * Reading is strict: what is unknown, written twice, of another type, not finite or not physical is refused, and so
 * are YAML's anchors, aliases, tags and second documents. Every message about a scene's text reads
 * "name:line:column: ..." (from 1, columns in characters) and says what to write instead.
 */
#ifndef ISO_IO_SCENE_FILE_H
#define ISO_IO_SCENE_FILE_H

#include <stddef.h>

#include "base/rational_impl.h"
#include "orbit/scene.h"

/* Reads the scene in the file `path`, "-" being standard input (called <stdin> in messages).
 * *scene is set only when the answer is ISO_OK. Errors: ISO_BAD_INPUT, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
iso_status iso_scene_load(iso_context *ctx, const char *path, iso_scene *scene);

/* The same, and the numbers as they are written, as doubles are rounded: under the names of iso_draft_numbers, without
 * lists of nine. They are to be cleared, also after an error. */
iso_status iso_scene_read_literals(iso_context *ctx, const char *path, iso_scene *scene, iso_literals *literals);

/* The same as iso_scene_load from `length` bytes of text, which messages call `name`. Errors: ISO_BAD_INPUT,
 * ISO_NO_MEMORY. */
iso_status iso_scene_load_text(iso_context *ctx, const char *name, const char *text, size_t length, iso_scene *scene);

/* Changes a scene by a mapping of backend, method, tolerance, end, step, as and columns, such as "tolerance: 1e-9".
 * "as" sets the columns as well, unless they are there, too. After an error the scene is as it was. Errors:
 * ISO_BAD_INPUT, ISO_NO_MEMORY. */
iso_status iso_scene_change(iso_context *ctx, const char *text, iso_scene *scene);

#endif

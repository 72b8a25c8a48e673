/* sweep_file.h - reads sweeps: a scene, the numbers that vary, and what is measured at each point, written in YAML.
 *
 *     scene: scene.yaml                                  # a file beside this one, or the scene itself
 *     vary:
 *       k: {from: -3, to: 3, count: 61}                  # equal steps; logarithmic: true - equal ratios
 *       J2: [1.5, 2, {from: 2.5, to: 4, count: 4}]       # a list of values and ranges
 *       J3/J1: {from: 2, to: 8}                          # no count: drawn by `samples`
 *       start: {spread: 100, seed: 1}                    # starts spread evenly over the section by its area
 *     samples: {count: 50, kind: random, seed: 7}        # or kind: even
 *     measure:
 *       chaos: {starts: 0}
 *       splitting: {}
 *     until: {turns: 1000}                               # or time
 *
 * The points are all combinations of the values (a grid). The first number of `vary` changes slowest. All numbers
 * that are drawn take their values from the same samples; together they count as one key, which changes fastest. For
 * each point the numbers are put into the scene in the order of the file.
 *
 * What can vary:
 * - each number that the scene's text states, by its key: k, mass, tolerance, end, eps, surface.radius, gravity.mgb;
 * - vectors, as a list of vectors: J, inertia, normal, angular_velocity, gamma, M, gravity.up;
 * - J1, J2, J3, and ratios such as J2/J1, which changes J2; J: {triangle: N}: all J = (a, b, c)/N with whole numbers
 *   a + b + c = N from 1 on; with ordered: true only a < b < c;
 * - the start on the section: l and x together, or start as a list of [l, x], or spread. It has the energy h that the
 *   scene's start has with the k and J of the point. The section is the global one.
 *
 * Reading is as strict as that of scenes (scene_file.h).
 */
#ifndef ISO_IO_SWEEP_FILE_H
#define ISO_IO_SWEEP_FILE_H

#include <stddef.h>

#include "../base/api.h"
#include "family.h"

ISO_C_BEGIN

typedef struct iso_sweep_file iso_sweep_file;

/* Reads the sweep in the file `path` ("-" is standard input). topics: what can be measured (iso_sweep_quantities of
 * sweep/sweep.h), ended by NULL. Errors: ISO_BAD_INPUT with line and column, ISO_FILE_TROUBLE, ISO_NO_MEMORY. */
ISO_API iso_status iso_sweep_read(iso_context *ctx, const char *path, const iso_sweep_quantity *const topics[],
                                  iso_sweep_file **file);

/* The same from text, which messages call `name`. A scene's file is sought in the folder of `name`. */
ISO_API iso_status iso_sweep_parse(iso_context *ctx, const char *name, const char *text, size_t length,
                                   const iso_sweep_quantity *const topics[], iso_sweep_file **file);
ISO_API void iso_sweep_file_free(iso_sweep_file *file);

/* What the file says. It is valid until the file is freed. */
ISO_API const iso_sweep_plan *iso_sweep_file_plan(const iso_sweep_file *file);

/* What varies, in words, such as "k: 61 values from -3 to 3"; false past the last. */
enum { ISO_SWEEP_WORDS = 176 };
ISO_API bool iso_sweep_axis_words(const iso_sweep_file *file, int i, char words[ISO_SWEEP_WORDS]);

/* How many points have k = 0, where there is no ball: they will fail. Of values that are drawn none is counted. */
ISO_API size_t iso_sweep_zeros_of_k(const iso_sweep_file *file);

/* The scene of point i as text: that of the scene's file with the numbers of the point in it. It reads back as the
 * same scene, to the bit. *text is the caller's to free. Errors: ISO_NO_MEMORY, and those of the point. */
ISO_API iso_status iso_sweep_scene_text(iso_context *ctx, const iso_sweep_file *file, size_t i, char **text);

/* Whether a text is a sweep, with mistakes in it or not: YAML that has a key `vary` or `measure` at its top. */
ISO_API bool iso_sweep_is_one(const char *text, size_t length);

ISO_C_END

#endif

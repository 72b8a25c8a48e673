/* foreign.h - the library for other languages: objects behind pointers, numbers in plain arrays, no structs.
 *
 * A language that can call C functions by their names (Python's ctypes, Julia's ccall, ...) needs no layout of a
 * struct here, and no compiler. apps/python uses nothing else, besides base/context.h, base/record.h and single
 * functions that take plain arguments as well.
 *
 *     iso_foreign_scene_read(ctx, "scene.yaml", &scene);
 *     iso_foreign_run(ctx, scene, NULL, 0, NULL, &record, notes, sizeof notes);     all rows of the scene
 *     iso_foreign_orbit_create(ctx, scene, &orbit);
 *     iso_foreign_orbit_at(orbit, times, 3, table, notes, sizeof notes);            the rows at three times
 *
 * Tables are arrays of doubles, a row after the other; a row has a number for each column of the scene
 * (iso_foreign_scene_columns). What is large or has lines is a record (base/record.h): its rows are such a table,
 * from iso_record_row(record, 0) on.
 *
 * Notes. What a user should know although the call went well, such as a lost contact, goes to notes[], `room` bytes
 * (0: nothing is written): lines with a newline between, ended by 0, cut where there is no more room.
 *
 * Words: models are "ball", "point"; models to show "ball", "point", "both", "auto". A word that is NULL is "auto".
 */
#ifndef ISO_FOREIGN_FOREIGN_H
#define ISO_FOREIGN_FOREIGN_H

#include <stddef.h>
#include <stdint.h>

#include "../base/api.h"
#include "../base/record.h"
#include "../orbit/orbit.h"
#include "../orbit/scene.h"

ISO_C_BEGIN

/* The number of this interface. It grows when a function here changes its arguments, so that a caller without headers
 * can refuse a library that it does not know. */
enum { ISO_FOREIGN_ABI = 1 };
ISO_API int iso_foreign_abi(void);

/* --- stopping --------------------------------------------------------------------------------------------------- */

/* A monitor (iso_context_set_monitor) that asks `go_on` at most once in `seconds`: for languages in which a call back
 * is slow. Free it after the context, or after iso_context_set_monitor(ctx, NULL, NULL). */
typedef struct iso_foreign_monitor iso_foreign_monitor;
ISO_API iso_status iso_foreign_monitor_create(iso_context *ctx, double seconds, bool (*go_on)(void *data), void *data,
                                              iso_foreign_monitor **monitor);
ISO_API void iso_foreign_monitor_free(iso_foreign_monitor *monitor);

/* --- scenes ----------------------------------------------------------------------------------------------------- */

/* A scene, and what messages call it. It belongs to no context. */
typedef struct iso_foreign_scene iso_foreign_scene;

/* From a file; from text, which messages call `name`. Errors: those of iso_scene_read, iso_scene_parse. */
ISO_API iso_status iso_foreign_scene_read(iso_context *ctx, const char *path, iso_foreign_scene **scene);
ISO_API iso_status iso_foreign_scene_parse(iso_context *ctx, const char *name, const char *text, size_t length,
                                           iso_foreign_scene **scene);
ISO_API iso_status iso_foreign_scene_copy(iso_context *ctx, const iso_foreign_scene *from, iso_foreign_scene **scene);
ISO_API void iso_foreign_scene_free(iso_foreign_scene *scene);

/* Changes one key: "backend", "method", "tolerance", "end", "step", "as", or "columns" (names with commas between,
 * one at least). "as" also sets the columns, as in a scene file without columns: set "as" first, then "columns".
 * A run checks "end" and "step" together.
 * Errors: ISO_BAD_ARGUMENT about the key. The scene is then as it was. */
ISO_API iso_status iso_foreign_scene_set(iso_context *ctx, iso_foreign_scene *scene, const char *key,
                                         const char *value);

/* Gives the scene another k, J (three) or start (six: omega, n; or M, gamma); NULL: as it was. The rules and errors
 * are those of iso_foreign_batch. After an error the scene is as it was. */
ISO_API iso_status iso_foreign_scene_replace(iso_context *ctx, iso_foreign_scene *scene, const double *k,
                                             const double J[3], const double start[6]);

/* Reads the numbers of a key and returns how many there are; 0: no such key. "k" 1; "J" 3; "D" 1 (0: not known);
 * "start" 6 (omega, n; or M, gamma); "eps" 1 (NaN: the scene is a ball's, or a point's on the level H = 0);
 * "end" 1; "step" 1 (0: a hundredth of |end|); "tolerance" 1. */
ISO_API int iso_foreign_scene_numbers(const iso_foreign_scene *scene, const char *key, double values[6]);

/* The word of a key: "model" (of the start), "backend", "method", "as", "name"; NULL: there is no such key. */
ISO_API const char *iso_foreign_scene_word(const iso_foreign_scene *scene, const char *key);

/* How many columns the scene asks for, and their numbers (iso_column_name); columns[] has room for ISO_MAX_COLUMNS. */
ISO_API int iso_foreign_scene_columns(const iso_foreign_scene *scene, int columns[]);

/* --- runs and orbits -------------------------------------------------------------------------------------------- */

/* Runs the scene (study/run.h). The record is what the file of `isoroll run` holds.
 * times: `count` of them; t for a ball's scene, s for a point's. NULL with count 0: the scene's own times.
 * errors: NULL, or room for five numbers, the largest errors of (omega, n), (M, gamma), t, tau and s in the rows
 *   (study/error.h); NaN: not shown, or not known. To find them takes many times as long as the rows.
 * Notes: contact is lost, the support pulls, the error is not known.
 * Errors: those of iso_run; ISO_BAD_ARGUMENT about "times": NULL with another count, or count 0 at a place that is
 * not NULL. After a failure or a stop on the way *record has the rows that were found before. It is NULL only if
 * there is none. */
ISO_API iso_status iso_foreign_run(iso_context *ctx, const iso_foreign_scene *scene, const double times[],
                                   size_t count, double errors[5], iso_record **record, char notes[], size_t room);

/* One orbit, which can be asked for any time. It has a context of its own: different orbits can be used by different
 * threads at the same time. `ctx` takes only the words of a failure here. The scene is copied. */
typedef struct iso_foreign_orbit iso_foreign_orbit;
ISO_API iso_status iso_foreign_orbit_create(iso_context *ctx, const iso_foreign_scene *scene,
                                            iso_foreign_orbit **orbit);
ISO_API void iso_foreign_orbit_free(iso_foreign_orbit *orbit);

/* Its context, for messages and for a monitor; and what it is, for single functions of orbit/orbit.h. */
ISO_API iso_context *iso_foreign_orbit_context(const iso_foreign_orbit *orbit);
ISO_API const iso_orbit *iso_foreign_orbit_inside(const iso_foreign_orbit *orbit);

/* The rows at these times, in any order: t for a ball's scene, s for a point's. The numbers are those of a run by the
 * same backend; if the scene leaves it to auto, it is the one that suits the scene's own times (iso_orbit_backend).
 * Errors: those of iso_orbit_at; ISO_BAD_ARGUMENT about "times" (not finite, or NULL); ISO_NUMERICAL about
 * "reactions" when contact is lost before one of the times: then there is no row. After an error nothing is known of
 * the table. */
ISO_API iso_status iso_foreign_orbit_at(iso_foreign_orbit *orbit, const double times[], size_t count, double table[],
                                        char notes[], size_t room);

/* --- many orbits ------------------------------------------------------------------------------------------------ */

/* Runs `count` orbits at the same times, on all processors (orbit/batch.h). table[] has room for count x rows x
 * columns: row j of orbit i is number i rows + j.
 * scene[]: `scenes` of them, 1 for all orbits or `count`. They agree in columns, backend, tolerance and the model of
 *   the start. The method is `taylor`, in lanes: scenes with another one are refused.
 * k, J, start: NULL, or what replaces the scene's: count numbers; 3 count; 6 count (omega, n; or M, gamma). With k or
 *   J the ball is a reduced one (its body is forgotten, D stays), and effects keep their numbers. A scene of a point
 *   that states eps keeps it: with another k, J or start the point then has another energy
 *   H = M^2/2 - eps (gamma, J gamma)^(-1/k), which is not 0 if it was. Without eps in the scene each orbit has
 *   the eps with which its H = 0.
 * times: `rows` of them, away from 0 in one direction: t for a ball's scene, s for a point's.
 * Units, in any consistent system: k, n and gamma have none; J mass length^2; omega 1/time; t time;
 *   s (unit of J)^(1/(2k) - 2) time; M 1/(unit of s); eps (unit of J)^4/time^2.
 * threads: 0: one for each processor. vectors: NULL: the widest.
 * status[] (may be NULL) has an iso_status for each orbit. Rows that an orbit has not reached are NaN.
 * Gives ISO_OK, or the status of the first orbit that failed; its number (from 0) and reason are in the message.
 * ISO_STOPPED by the monitor and ISO_NO_MEMORY are also the status of every orbit that was not followed therefore.
 * A k, J or start that makes no sense is the failure of that orbit alone.
 * Errors of a call that makes no sense, which leaves table[] and status[] as they were: ISO_BAD_ARGUMENT as
 * iso_batch_run; about "scenes": they do not agree, or a ball could lose contact (reactions without two_sided: only
 * a run watches this). */
ISO_API iso_status iso_foreign_batch(iso_context *ctx, const iso_foreign_scene *const scene[], size_t scenes,
                                     size_t count, const double k[], const double J[], const double start[],
                                     const double times[], size_t rows, int threads, const char *vectors,
                                     double table[], int32_t status[]);

/* --- studies ---------------------------------------------------------------------------------------------------- */

/* The Poincare section of a scene (study/section/section.h).
 * at: l, x of further starts, at_count pairs. axis: 0 to 2, or -1: the global one.
 * event: NULL, or a column; crossings are then where it passes `value` upwards. models: those that are integrated.
 * shown: whose states are in the rows; NULL or "auto": no states. tolerance: 1e-15 to 0.1, or 0: the scene's.
 * *record is what the file of `isoroll section` holds. *point (may be NULL): if both models are integrated, the
 *   crossings as the point finds them, with the columns orbit, crossing, t, tau, s, l, x; else NULL.
 * Notes: the section is not global; how many orbits failed, and why; how many orbits of the two models part.
 * Errors: those of iso_section_run; ISO_BAD_ARGUMENT about "models", "as", "event", "tolerance", or about
 * "crossings" or "starts" above 2^53. The records then have the rows that were found before, or are NULL. */
ISO_API iso_status iso_foreign_section(iso_context *ctx, const iso_foreign_scene *scene, size_t crossings,
                                       size_t starts, uint64_t seed, const double at[], size_t at_count, int axis,
                                       const char *event, double value, const char *models, const char *shown,
                                       double tolerance, int threads, iso_record **record, iso_record **point,
                                       char notes[], size_t room);

/* Which orbits are chaotic (study/chaos/chaos.h); arguments and tolerance as for sections.
 * *record has a row for each orbit; row 0 is the scene's own. Columns:
 *     orbit l x verdict disagree      l, x: where it starts; NaN: the scene's own. verdict: a number of iso_verdict
 *     ball_status ball_verdict ball_turns ball_exponent_turns ball_megno ball_gali2 ball_per_turn
 *     ball_per_turn_error ball_exponent_t ball_exponent_tau ball_exponent_s    ball_error_t ball_error_tau
 *     ball_error_s ball_digits        for each model that was integrated: ball_, point_
 *   Lines: model, k, J, section (axis and what a turn is); of the orbits spread over the section asked, count (those
 *   that were followed), chaotic, regular, undecided, failed, share, low and high; integral if a further one is known;
 *   failure of the first orbit that failed.
 * trace[0], trace[1] (trace may be NULL): the indicators of the scene's own orbit by the turns, of ball and point;
 *   NULL: not integrated. Errors: those of iso_chaos_run; ISO_BAD_ARGUMENT about "models", "tolerance", or
 *   about "starts" above 2^53. */
ISO_API iso_status iso_foreign_chaos(iso_context *ctx, const iso_foreign_scene *scene, long turns,
                                     long exponent_turns, size_t starts, uint64_t seed, const double at[],
                                     size_t at_count, int axis, const char *models, double tolerance, int threads,
                                     iso_record **record, iso_record *trace[2]);

/* --- records and files ------------------------------------------------------------------------------------------ */

/* Adds `count` rows to a record. Errors: ISO_NO_MEMORY. */
ISO_API iso_status iso_foreign_record_append(iso_context *ctx, iso_record *record, size_t count, const double rows[]);

/* Reads a trajectory (io/trajectory.h): CSV, or HDF5 if the name ends in .h5. Notes: columns that are passed over.
 * columns: NULL, or the names from left to right. Errors: those of iso_trajectory_read. */
ISO_API iso_status iso_foreign_read(iso_context *ctx, const char *path, const char *columns, iso_record **record,
                                    char notes[], size_t room);

/* Writes a record, with 1 to 17 digits, or 0: C's hexadecimal %a. kind: "trajectory" or "section". Errors: those of
 * iso_trajectory_open and iso_trajectory_write_row; ISO_BAD_ARGUMENT about "digits", "kind". */
ISO_API iso_status iso_foreign_write(iso_context *ctx, const char *path, const iso_record *record, int digits,
                                     const char *kind);

/* Converts a record to the model `to`, "ball" or "point" (orbit/convert.h). k, J and h or eps are in its lines.
 * shift_J: see iso_conversion_options. row_tolerance: see iso_record_set_row_tolerance.
 * *out has a row for each row of `in`, and the lines of `isoroll convert`.
 * Notes: the rows do not solve the equations that their lines state.
 * Errors: as iso_convert, ISO_BAD_ARGUMENT about "to", "row_tolerance". */
ISO_API iso_status iso_foreign_convert(iso_context *ctx, const iso_record *in, const char *to, double tolerance,
                                       double row_tolerance, bool shift_J, iso_record **out, char notes[],
                                       size_t room);

ISO_C_END

#endif

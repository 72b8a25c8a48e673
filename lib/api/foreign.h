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
enum { ISO_FOREIGN_ABI = 3 };
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

/* From a file; from text, which messages call `name`. Errors: those of iso_scene_load, iso_scene_load_text. */
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
 * are those of iso_scene_replaced. After an error the scene is as it was. */
ISO_API iso_status iso_foreign_scene_replace(iso_context *ctx, iso_foreign_scene *scene, const double *k,
                                             const double J[3], const double start[6]);

/* Reads the numbers of a key and returns how many there are; 0: no such key. "k" 1; "J" 3; "D" 1 (0: not known);
 * "start" 6 (omega, n; or M, gamma); "eps" 1 (NaN: the scene is a ball's, or a point's on the level H = 0);
 * "end" 1; "step" 1 (0: a hundredth of |end|); "tolerance" 1. */
ISO_API int iso_foreign_scene_numbers(const iso_foreign_scene *scene, const char *key, double values[6]);

/* The word of a key: "model" (of the start), "backend", "method", "as", "name"; NULL: there is no such key. */
ISO_API const char *iso_foreign_scene_word(const iso_foreign_scene *scene, const char *key);

/* The i-th key that the text of a scene can have, and its section, such as "reduced" and "k"; those of "effects" are
 * the names of the effects. False: there are no more. */
ISO_API bool iso_foreign_scene_key(int i, const char **section, const char **key);

/* The scene as YAML that reads back as the same scene to the bit: as much of it as there is room for, with an end mark;
 * *length is that of all of it. Errors: ISO_NO_MEMORY. */
ISO_API iso_status iso_foreign_scene_text(iso_context *ctx, const iso_foreign_scene *scene, char text[], size_t room,
                                          size_t *length);

/* The text of a scene or of a sweep, YAML of `bytes` bytes, as JSON: as much of it as there is room for, with an end
 * mark; *length is that of all of it. Errors: ISO_BAD_INPUT about its YAML, with line and column in `name`. */
ISO_API iso_status iso_foreign_yaml_json(iso_context *ctx, const char *name, const char *text, size_t bytes,
                                         char json[], size_t room, size_t *length);

/* How many columns the scene asks for, and their numbers (iso_column_name); columns[] has room for
 * ISO_MAX_COLUMNS. */
ISO_API int iso_foreign_scene_columns(const iso_foreign_scene *scene, int columns[]);

/* --- runs and orbits -------------------------------------------------------------------------------------------- */

/* Runs the scene (task/run.h). The record is what the file of `isoroll run` holds.
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

/* Runs `count` orbits at the same times, on all processors: iso_batch_table (orbit/batch.h). status[] (may be NULL)
 * has an iso_status for each orbit; rows that an orbit has not reached are NaN. */
ISO_API iso_status iso_foreign_batch(iso_context *ctx, const iso_foreign_scene *const scene[], size_t scenes,
                                     size_t count, const double k[], const double J[], const double start[],
                                     const double times[], size_t rows, int threads, const char *vectors,
                                     double table[], int32_t status[]);

/* --- studies ---------------------------------------------------------------------------------------------------- */

/* Runs a study by its name, "section", "chaos", ... (study/study.h).
 * scene, record: what is studied. Most studies need a scene; check needs a trajectory, and takes k, J and effects from
 *   a scene; analogue needs a scene or the problem in its options. NULL: not given.
 * options: lines NAME=VALUE with a newline between, or NULL. Names and values are those of the command, such as
 *   "starts=12\nat=0.5,0.2;1,-0.3\nmodel=both"; a flag is "NAME=true".
 * progress: is told the part of the work that is done, in [0, 1], also by other threads; NULL: nobody is.
 * table[]: room for six, of which those not made are NULL. The lines of table[0] are the scene's, and the result by
 *   the names of the command's --json, but what the rows have. The caller frees each (iso_record_free).
 *   section: what its file holds; if both models are integrated, the crossings as the point finds them, in the
 *     columns orbit, crossing, t, tau, s, l, x; with area: a row for each orbit and model.
 *   chaos: a row for each orbit, row 0 the scene's own, in the columns of the file of `isoroll chaos`; the indicators
 *     of the scene's own orbit by the turns, of the ball and of the point.
 *   periodic: what its file holds, also with follow and chart. splitting, cost: what their files hold.
 *   compare: differences of ball and point; orbits of ball, point and closed solution; differences of ball and point
 *     from the closed solution.
 *   check: a row for each residual. explain, analogue: the line "text" is what the command prints; no rows.
 * Errors: those of the study; ISO_BAD_ARGUMENT about "study", "scene", "record" or about an option. The tables then
 * have the rows that were found before, or are NULL. */
ISO_API iso_status iso_foreign_study(iso_context *ctx, const iso_foreign_scene *scene, const iso_record *record,
                                     const char *name, const char *options, void (*progress)(void *data, double part),
                                     void *data, iso_record *table[6], char notes[], size_t room);

/* The name of the i-th study; NULL past the end. In one line, what it does; what it is of: bit 0: it needs a scene;
 * bit 1: it needs a record; bit 2: it takes a scene as well. NULL, 0: there is no such study. */
ISO_API const char *iso_foreign_study_name(int i);
ISO_API const char *iso_foreign_study_doc(const char *name);
ISO_API int iso_foreign_study_of(const char *name);

/* The i-th option of a study: its name, type ("flag", "whole", "number", "numbers", "word" or "text"), argument as in
 * --help ("" for a flag), what is expected in words, and what it does in one line. false: past the end. */
ISO_API bool iso_foreign_option(const char *study, int i, const char *text[5]);

/* A word that the argument of this option can be; NULL past the last, or where it is no word of a list. */
ISO_API const char *iso_foreign_option_word(const char *study, int i, int word);

/* The kind of the i-th table that studies and sweeps make; NULL past the end. And its columns: the name of the i-th,
 * its unit ("": none), and what it is in one line. false: past the end. Of sweeps all columns that one can have, but
 * those of what varies; of compare both t and s. */
ISO_API const char *iso_foreign_table_kind(int i);
ISO_API bool iso_foreign_column(const char *kind, int i, char name[64], const char *text[2]);

/* What there is, in the words of `isoroll list`: as much of it as there is room for, with an end mark; *length is that
 * of all of it. topic: "methods", ...; NULL: all. Errors: ISO_BAD_ARGUMENT about "topic", ISO_NO_MEMORY. */
ISO_API iso_status iso_foreign_list(iso_context *ctx, const char *topic, char text[], size_t room, size_t *length);

/* --- sweeps ----------------------------------------------------------------------------------------------------- */

/* Measures all points of a sweep (sweep/sweep.h).
 * path: of its file; with text, what messages call it, and in whose folder a scene's file is sought.
 * text: the sweep in YAML, `length` bytes; NULL: the file is read.
 * threads: 0: as many as there are processors.
 * record: what the file of `isoroll sweep` holds, a row for each point in order. Points that fail have a status and a
 *   reason. After a failure or a stop on the way it has the points of finished chunks, and is NULL if there is none.
 * Errors: those of iso_sweep_read, iso_sweep_create and iso_sweep_run. */
ISO_API iso_status iso_foreign_sweep(iso_context *ctx, const char *path, const char *text, size_t length, int threads,
                                     void (*progress)(void *data, double part), void *data, iso_record **record);

/* What `isoroll explain` says of a sweep, in the line "text" of the record; for this a few points are computed. *record
 * is NULL if there is no sweep: a scene, or no file that can be read more than once.
 * Errors: those of iso_sweep_read and iso_sweep_create; ISO_STOPPED. */
ISO_API iso_status iso_foreign_sweep_explain(iso_context *ctx, const char *path, const char *text, size_t length,
                                             iso_record **record);

/* --- records and files ------------------------------------------------------------------------------------------ */

/* Reads a table of any kind (io/table.h), or a trajectory of another program: CSV, or HDF5 if the
 * name ends in .h5. columns: NULL, or those of a trajectory from left to right. Notes: columns that are passed over.
 * Errors: those of iso_table_read. */
ISO_API iso_status iso_foreign_read(iso_context *ctx, const char *path, const char *columns, iso_record **record,
                                    char notes[], size_t room);

/* Writes a record, with 1 to 17 digits, or 0: C's hexadecimal %a. kind: "trajectory", "section", "chaos", ...; the
 * numbers of the first two must be finite. Errors: those of iso_table_write;
 * ISO_BAD_ARGUMENT about "digits". */
ISO_API iso_status iso_foreign_write(iso_context *ctx, const char *path, const iso_record *record, int digits,
                                     const char *kind);

/* Converts a record to the model `to`, "ball" or "point" (task/convert/convert.h). k, J and h or eps are in its lines.
 * shift_J: see iso_conversion_options. row_tolerance: see iso_record_set_row_tolerance.
 * *out has a row for each row of `in`, and the lines of `isoroll convert`.
 * Notes: the rows do not solve the equations that their lines state.
 * Errors: as iso_convert, ISO_BAD_ARGUMENT about "to", "row_tolerance". */
ISO_API iso_status iso_foreign_convert(iso_context *ctx, const iso_record *in, const char *to, double tolerance,
                                       double row_tolerance, bool shift_J, iso_record **out, char notes[],
                                       size_t room);

ISO_C_END

#endif

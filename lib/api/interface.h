/* interface.h - scenes, solutions, batches, studies, sweeps: opaque objects, text, plain arrays and records.
 *
 * A program, or a language that can call C functions by their names (Python's ctypes, Julia's ccall, ...), needs no
 * layout of a struct here but that of iso_sink (base/sink.h). apps/python uses nothing else, besides contexts and
 * records.
 *
 *     iso_record *table[ISO_TABLES];
 *     iso_scene_read(ctx, "scene.yaml", &scene);
 *     iso_study_ask(ctx, "run", scene, NULL, "tol=1e-10", NULL, table);         all rows of the scene
 *     iso_study_ask(ctx, "chaos", scene, NULL, "turns=500", &sink, table);
 *     iso_solution_create(ctx, scene, &solution);
 *     iso_solution_at(solution, times, 3, rows, NULL, 0);                       the rows at three times
 *
 * Rows are arrays of doubles, one after the other; a row has a number for each column of the scene
 * (iso_scene_columns). What is large or has lines is a record (base/record.h): its rows are such an array,
 * from iso_record_row(record, 0) on.
 *
 * Notes. What a user should know although the call went well, such as a lost contact, goes to notes[], `room` bytes
 * (0: nothing is written): lines with a newline between, ended by 0, cut where there is no more room.
 *
 * Words: models are "ball", "point"; models to show "ball", "point", "both", "auto". A word that is NULL is "auto".
 */
#ifndef ISO_API_INTERFACE_H
#define ISO_API_INTERFACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "../base/api.h"
#include "../base/record.h"
#include "../base/sink.h"

ISO_C_BEGIN

/* The number of this interface. It grows when a function here changes its arguments, so that a caller without headers
 * can refuse a library that it does not know. */
enum { ISO_INTERFACE = 4 };
ISO_API int iso_interface(void);

/* --- stopping --------------------------------------------------------------------------------------------------- */

/* A monitor (iso_context_set_monitor) that asks `go_on` at most once in `seconds`: for languages in which a call back
 * is slow. Free it after the context, or after iso_context_set_monitor(ctx, NULL, NULL). */
typedef struct iso_slow_monitor iso_slow_monitor;
ISO_API iso_status iso_slow_monitor_create(iso_context *ctx, double seconds, bool (*go_on)(void *data), void *data,
                                           iso_slow_monitor **monitor);
ISO_API void iso_slow_monitor_free(iso_slow_monitor *monitor);

/* --- scenes ----------------------------------------------------------------------------------------------------- */

/* A scene, and what messages call it. It belongs to no context. */
typedef struct iso_scene iso_scene;

/* From a file; from text, which messages call `name`. Errors: those of iso_scene_load, iso_scene_load_text. */
ISO_API iso_status iso_scene_read(iso_context *ctx, const char *path, iso_scene **scene);
ISO_API iso_status iso_scene_parse(iso_context *ctx, const char *name, const char *text, size_t length,
                                   iso_scene **scene);
ISO_API iso_status iso_scene_copy(iso_context *ctx, const iso_scene *from, iso_scene **scene);
ISO_API void iso_scene_free(iso_scene *scene);

/* Changes one key: "backend", "method", "tolerance", "end", "step", "as", or "columns" (names with commas between,
 * one at least). "as" also sets the columns, as in a scene file without columns: set "as" first, then "columns".
 * A run checks "end" and "step" together.
 * Errors: ISO_BAD_ARGUMENT about the key. The scene is then as it was. */
ISO_API iso_status iso_scene_set(iso_context *ctx, iso_scene *scene, const char *key, const char *value);

/* Gives the scene another k, J (three) or start (six: omega, n; or M, gamma); NULL: as it was. The rules and errors
 * are those of iso_scene_replaced. After an error the scene is as it was. */
ISO_API iso_status iso_scene_replace(iso_context *ctx, iso_scene *scene, const double *k, const double J[3],
                                     const double start[6]);

/* Reads the numbers of a key and returns how many there are; 0: no such key. "k" 1; "J" 3; "D" 1 (0: not known);
 * "start" 6 (omega, n; or M, gamma); "eps" 1 (NaN: the scene is a ball's, or a point's on the level H = 0);
 * "end" 1; "step" 1 (0: a hundredth of |end|); "tolerance" 1. */
ISO_API int iso_scene_numbers(const iso_scene *scene, const char *key, double values[6]);

/* The word of a key: "model" (of the start), "backend", "method", "as", "name"; NULL: there is no such key. */
ISO_API const char *iso_scene_word(const iso_scene *scene, const char *key);

/* The i-th key that the text of a scene can have, and its section, such as "reduced" and "k"; those of "effects" are
 * the names of the effects. False: there are no more. */
ISO_API bool iso_scene_key(int i, const char **section, const char **key);

/* The scene as YAML that reads back as the same scene to the bit: as much of it as there is room for, with an end mark;
 * *length is that of all of it. Errors: ISO_NO_MEMORY. */
ISO_API iso_status iso_scene_text(iso_context *ctx, const iso_scene *scene, char text[], size_t room, size_t *length);

/* The text of a scene or of a sweep, YAML of `bytes` bytes, as JSON: as much of it as there is room for, with an end
 * mark; *length is that of all of it. Errors: ISO_BAD_INPUT about its YAML, with line and column in `name`. */
ISO_API iso_status iso_yaml_json(iso_context *ctx, const char *name, const char *text, size_t bytes, char json[],
                                 size_t room, size_t *length);

/* How many columns the scene asks for, and their numbers; columns[] has room for 64. */
ISO_API int iso_scene_columns(const iso_scene *scene, int columns[]);

/* The i-th column that a trajectory can have: its name, its unit ("": none), and what it is. False: past the end. */
ISO_API bool iso_column(int i, const char *text[3]);

/* --- formulas, for programs with an integrator of their own ----------------------------------------------------- */

/* The map (18) and its inverse: omega, n of the ball; M, gamma of the point. */
ISO_API void iso_scene_to_point(const iso_scene *scene, const double ball[6], double point[6]);
ISO_API void iso_scene_to_ball(const iso_scene *scene, const double point[6], double ball[6]);

/* The rates dtau/dt and ds/dt of the other clocks at n; the energy of the free ball. */
ISO_API void iso_scene_clock_rates(const iso_scene *scene, const double n[3], double rates[2]);
ISO_API double iso_scene_energy(const iso_scene *scene, const double ball[6]);

/* --- solutions ------------------------------------------------------------------------------------------ */

/* The solution of a scene, which can be asked for any time. It has a context of its own: different orbits can be used
 * by different threads at the same time. `ctx` takes only the words of a failure here. The scene is copied. */
typedef struct iso_solution iso_solution;
ISO_API iso_status iso_solution_create(iso_context *ctx, const iso_scene *scene, iso_solution **solution);
ISO_API void iso_solution_free(iso_solution *solution);

/* Its context, for messages and for a monitor. */
ISO_API iso_context *iso_solution_context(const iso_solution *solution);

/* The word of a key: "backend" that finds it, "method" ("": the closed solution), "models" ("both", or "ball"); NULL:
 * there is no such key. A number: "h", the energy of the ball; "eps", the coupling of the point; NaN: no such key. */
ISO_API const char *iso_solution_word(const iso_solution *solution, const char *key);
ISO_API double iso_solution_number(const iso_solution *solution, const char *key);

/* The rows at these times, in any order: t for a ball's scene, s for a point's. The numbers are those of a run by the
 * same backend; if the scene leaves it to auto, it is the one that suits the scene's own times (iso_orbit_backend).
 * Errors: those of iso_orbit_at; ISO_BAD_ARGUMENT about "times" (not finite, or NULL); ISO_NUMERICAL about
 * "reactions" when contact is lost before one of the times: then there is no row. After an error nothing is known of
 * the table. */
ISO_API iso_status iso_solution_at(iso_solution *solution, const double times[], size_t count, double table[],
                                   char notes[], size_t room);

/* --- many orbits ------------------------------------------------------------------------------------------------ */

/* Runs `count` orbits at the same times, on all processors: iso_batch_table (orbit/batch.h). status[] (may be NULL)
 * has an iso_status for each orbit; rows that an orbit has not reached are NaN. */
ISO_API iso_status iso_batch(iso_context *ctx, const iso_scene *const scene[], size_t scenes, size_t count,
                             const double k[], const double J[], const double start[], const double times[],
                             size_t rows, int threads, const char *vectors, double table[], int32_t status[]);

/* --- studies ---------------------------------------------------------------------------------------------------- */

/* Asks a study by its name: "run", "section", "chaos", ...
 * scene, record: what is studied. Most studies need a scene; run also takes a record of one column, its times; check
 *   and convert need a trajectory, and take k, J and effects from a scene; analogue needs a scene or the problem in its
 *   options. NULL: not given.
 * options: lines NAME=VALUE with a newline between, or NULL. Names and values are those of the command, such as
 *   "starts=12\nat=0.5,0.2;1,-0.3\nmodel=both"; a flag is "NAME=true".
 * sink: takes notes and progress, and of run, section and convert the rows as they are found, if its `row` is not
 *   NULL: they are then in no table. NULL: no calls.
 * table[]: those not made are NULL. The lines of table[0] are the scene's, the command line that makes it again, and
 *   the result by the names of the command's --json, but what the rows have. The caller frees each (iso_record_free).
 *   run: the trajectory; with verbose=true its lines errors.ball, .point, .t, .tau, .s are the largest errors.
 *   convert: what its file holds, with a row for each row of the record; a bad one is an error. Notes: the rows do not
 *     solve the equations that their lines state.
 *   section: what its file holds; if both models are integrated, the crossings as the point finds them, in the
 *     columns orbit, crossing, t, tau, s, l, x; with area: a row for each orbit and model.
 *   chaos: a row for each orbit, row 0 the scene's own, in the columns of the file of `isoroll chaos`; the indicators
 *     of the scene's own orbit by the turns, of the ball and of the point.
 *   periodic: what its file holds, also with follow and chart. splitting, cost: what their files hold.
 *   compare: differences of ball and point; orbits of ball, point and closed solution; differences of ball and point
 *     from the closed solution.
 *   check: a row for each residual. explain, analogue: no rows.
 * Errors: those of the study; ISO_BAD_ARGUMENT about "study", "scene", "record" or about an option. The tables then
 * have the rows that were found before, or are NULL. */
enum { ISO_TABLES = 6 };
ISO_API iso_status iso_study_ask(iso_context *ctx, const char *study, const iso_scene *scene,
                                 const iso_record *record, const char *options, const iso_sink *sink,
                                 iso_record *table[ISO_TABLES]);

/* What the command prints of a study: as much of it as there is room for, with an end mark; *length is that of all of
 * it. table: its first. width: columns of the page; 0: lines are not folded. */
ISO_API iso_status iso_study_text(iso_context *ctx, const iso_record *table, int width, char text[], size_t room,
                                  size_t *length);

/* The name of the i-th study; NULL past the end. In one line, what it does; what it is of: bit 0: it needs a scene;
 * bit 1: it needs a record; bit 2: it takes a scene as well. NULL, 0: there is no such study. */
ISO_API const char *iso_study_name(int i);
ISO_API const char *iso_study_doc(const char *name);
ISO_API int iso_study_of(const char *name);

/* The i-th option of a study: its name, type ("flag", "whole", "number", "numbers", "word" or "text"), argument as in
 * --help ("" for a flag), what is expected in words, and what it does in one line. false: past the end. */
ISO_API bool iso_study_option(const char *study, int i, const char *text[5]);

/* A word that the argument of this option can be; NULL past the last, or where it is no word of a list. */
ISO_API const char *iso_study_option_word(const char *study, int i, int word);

/* The kind of the i-th table that studies and sweeps make; NULL past the end. And its columns: the name of the i-th,
 * its unit ("": none), and what it is in one line. false: past the end. Of sweeps all columns that one can have, but
 * those of what varies; of compare both t and s. */
ISO_API const char *iso_kind_name(int i);
ISO_API bool iso_kind_column(const char *kind, int i, char name[64], const char *text[2]);

/* What there is, in the words of `isoroll list`: as much of it as there is room for, with an end mark; *length is that
 * of all of it. topic: "methods", ...; NULL: all. Errors: ISO_BAD_ARGUMENT about "topic", ISO_NO_MEMORY. */
ISO_API iso_status iso_list(iso_context *ctx, const char *topic, char text[], size_t room, size_t *length);

/* --- pictures --------------------------------------------------------------------------------------------------- */

/* The tables of a picture of these tables (NULL after the last), by their kinds, as templates and apps/python draw
 * them. options: "KEY=VALUE" lines, or NULL. *layout: the name of the template. made[]: NULL after the last; the kind
 * of each is its name in the template; the caller frees them. Errors: ISO_BAD_ARGUMENT, ISO_BAD_INPUT,
 * ISO_NO_MEMORY. */
enum { ISO_PICTURE_MOST = 16 };
ISO_API iso_status iso_picture_of(iso_context *ctx, const iso_record *const table[], const char *options,
                                  const char **layout, iso_record *made[ISO_PICTURE_MOST]);

/* --- sweeps ----------------------------------------------------------------------------------------------------- */

/* Measures all points of a sweep (lib/doc/formats.md).
 * path: of its file; with text, what messages call it, and in whose folder a scene's file is sought.
 * text: the sweep in YAML, `length` bytes; NULL: the file is read.
 * options: NULL, or lines NAME=VALUE: threads=N, output=FILE (.csv or .h5: rows go there as they come, not to memory),
 *   resume=true (go on with what there is of this file), shard=i/n (part i of n alone). As the command has them.
 * record: what the file of `isoroll sweep` holds, a row for each point in order. Points that fail have a status and a
 *   reason. After a failure or a stop on the way it has the points of finished chunks, and is NULL if there is none.
 *   With an output it is then NULL, and the message names the file in which they are.
 * Errors: those of iso_sweep_read, iso_sweep_create, iso_sweep_run; ISO_FILE_TROUBLE about the output;
 * ISO_BAD_ARGUMENT about an option. */
ISO_API iso_status iso_sweep_ask(iso_context *ctx, const char *path, const char *text, size_t length, const char *options,
                                 void (*progress)(void *data, double part), void *data, iso_record **record);

/* What `isoroll explain` says of a sweep, as the text of the record (iso_study_text); for this a few points are
 * computed. *record is NULL if there is no sweep: a scene, or no file that can be read more than once.
 * Errors: those of iso_sweep_read and iso_sweep_create; ISO_STOPPED. */
ISO_API iso_status iso_sweep_text(iso_context *ctx, const char *path, const char *text, size_t length,
                                  iso_record **record);

/* --- records and files ------------------------------------------------------------------------------------------ */

/* Reads a table of any kind (io/table.h), or a trajectory of another program: CSV, or HDF5 if the
 * name ends in .h5. columns: NULL, or those of a trajectory from left to right. Notes: columns that are passed over.
 * Errors: those of iso_table_read. */
ISO_API iso_status iso_record_read(iso_context *ctx, const char *path, const char *columns, iso_record **record,
                                   char notes[], size_t room);

/* Writes a record, with 1 to 17 digits, or 0: C's hexadecimal %a. kind: "trajectory", "section", "chaos", ...; the
 * numbers of the first two must be finite. Errors: those of iso_table_write;
 * ISO_BAD_ARGUMENT about "digits". */
ISO_API iso_status iso_record_write(iso_context *ctx, const char *path, const iso_record *record, int digits,
                                    const char *kind);

ISO_C_END

#endif

/* view.h - the page of `isoroll view`: a head, and tables. Scripts (view/) find a table by its kind, and its columns by
 * their names; so what a new panel shows needs no C if a table has it. lib/doc/formats.md, 9, has the kinds.
 *
 *     view_scene.c       a scene: `run`, and `compare` for how far both models are apart
 *     view_trajectory.c  a trajectory file; rows_impl.h adds the columns that it lacks
 *     view_section.c     a section file: its crossings, and the first part of each of its orbits
 *     view_orbit.c       what is found out about orbits: integrals, a neighbour, and `chaos`
 *     view_write.c       the head and the tables as JSON, and the page: these and the files of view/
 */
#ifndef ISOROLL_VIEW_H
#define ISOROLL_VIEW_H

#include "command.h"

/* Bounds that keep a page below 3 MB. In base64 a number takes 10.7 bytes. */
enum {
    VIEW_MOST_ROWS = 5000,       /* of the orbit that is played; of more, each second, third, ... is kept     */
    VIEW_MOST_CROSSINGS = 20000, /* of a section                                                             */
    VIEW_MOST_ORBITS = 10000     /* of a section; so each has two crossings or more                           */
};
#define VIEW_MOST_NUMBERS 130000.0 /* of all orbits of a section */

/* The largest turn of the ball, of n or of gamma between two rows, in radians. Cubic curves through such rows are
 * right to 1e-6 of the radius. */
#define VIEW_TURN 0.1

/* How far beside an orbit its neighbour begins, in radians. */
#define VIEW_BESIDE 1e-6

enum { VIEW_NOTES = 8, VIEW_TEXT = 512 };

typedef struct view_page {
    const char *title; /* the name of the file */
    const char *kind;  /* "scene", "trajectory" or "section" */
    iso_params params;
    iso_effects effects;
    double eps, h;         /* NAN: not known                                                              */
    iso_clock clock;       /* the clock that runs evenly at first                                         */
    char alone[VIEW_TEXT]; /* why the ball has no point; "": it has one                                   */
    char note[VIEW_NOTES][VIEW_TEXT];
    int notes;
    bool live;     /* the library is in the page                                             */
    bool attitude; /* the scene or the file states one; every page has one to draw the ball */
    bool no_orbit; /* rows of a trajectory do not follow the equations: a note says so      */
    iso_record **table;
    size_t tables;
} view_page;

void view_page_free(view_page *page);

/* Adds a note that the page shows. */
void view_note(view_page *page, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds a table of this kind; orbit >= 0: about the section's orbit of this number. The page frees it, also after an
 * error. */
iso_status view_add(iso_context *ctx, view_page *page, const char *kind, double orbit, iso_record *table);

/* A line of a table. */
iso_status view_count(iso_context *ctx, iso_record *table, const char *key, size_t count);

/* --- kinds of input --------------------------------------------------------------------------------------------- */

/* Errors: those of iso_run; ISO_BAD_INPUT names a missing column, line or row of a file; those of the library. */
iso_status view_of_scene(iso_context *ctx, const iso_scene *scene, view_page *page);
iso_status view_of_trajectory(iso_context *ctx, const file_options *from, view_page *page);
iso_status view_of_section(iso_context *ctx, const file_options *from, view_page *page);

/* Parameters, effects, h and eps of the page by the lines of a table and the options (NULL: none); h and eps are NAN
 * without such a line. Says in page->alone if an effect breaks the isomorphism. Errors: ISO_BAD_INPUT about a line. */
iso_status view_read_lines(iso_context *ctx, const file_options *from, iso_record *r, view_page *page);

/* Whether an effect breaks the isomorphism. Reads page->effects. */
bool view_is_broken(view_page *page);

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* The columns of an orbit in the page: of the ball, of the point if there is one, clocks, q, and on a plane the
 * contact; of effects those that the rows have (rows NULL: that are on). Returns how many. */
size_t view_columns(const view_page *page, const iso_record *rows, const char *names[ISO_TRAJECTORY_COLUMNS]);

/* The scene whose ball starts as a row does: with the page's parameters and effects and the attitude, by steps of the
 * ball. view_ask_for adds columns to it, with blanks between. Errors: those of iso_record_start. */
iso_status view_start(iso_context *ctx, const view_page *page, const iso_record *r, size_t row, iso_scene *scene);
void view_ask_for(iso_scene *scene, const char *columns);

/* Runs it into a new record at `count` times; NULL: its own times. page NULL: its notes are not wanted. */
iso_status view_run(iso_context *ctx, const iso_scene *scene, const double times[], size_t count, view_page *page,
                    iso_record **rows);

/* The three numbers of a vector in a row; `name` is its first column. NULL: there is no such column. */
const double *view_vector(const iso_record *r, size_t row, const char *name);

/* The largest turn, in radians, of the ball, of n or of gamma from one row to the next, of rows with t and omega. The
 * ball turns by |omega| dt, n by at most |k| times that. */
double view_largest_turn(const iso_record *r, double k);

/* Tables about the orbit of these rows, which begins as `scene`: "neighbour" has the place of an orbit that begins
 * VIEW_BESIDE beside it (gamma; n if there is no point) and its distance. Errors: ISO_STOPPED, ISO_NO_MEMORY. */
iso_status view_neighbour(iso_context *ctx, view_page *page, const iso_scene *scene, double orbit,
                          const iso_record *rows);

/* The table "orbits": verdict, exponent and shade of the orbits of a section, by their first crossings, whose rows are
 * first[], with the energy of `scene`; the section's picture has the shades. section NULL: of the scene's own orbit,
 * without a shade. Adds a note if there are none. Errors: likewise. */
iso_status view_verdicts(iso_context *ctx, view_page *page, const iso_scene *scene, const iso_record *section,
                         size_t count, const size_t first[]);

/* Adds the rows of a scene or of a trajectory, and what is found out about them: "drifts" of the integrals of each
 * model, the neighbour, and the verdict. */
iso_status view_add_orbit(iso_context *ctx, view_page *page, iso_record *rows);

/* --- output ----------------------------------------------------------------------------------------------------- */

/* Whether this build has what a page needs. Errors: ISO_BAD_ARGUMENT: it was built without three.js. */
iso_status view_check_build(iso_context *ctx, bool live);

/* Errors: ISO_FILE_TROUBLE, ISO_CLOSED_PIPE, ISO_NO_MEMORY. */
iso_status view_write(iso_context *ctx, const char *path, const view_page *page);

#endif

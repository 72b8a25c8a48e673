/* view.h - the page of `isoroll view`: what it is made of, and who makes its parts.
 *
 *     view_scene.c       a scene: both models, each integrated by itself
 *     view_trajectory.c  a trajectory file
 *     view_complete.c    columns that the file lacks, computed from row to row
 *     view_section.c     a section file: its crossings, and the first part of each of its orbits
 *     view_numbers.c     integrals along the rows
 *     view_neighbour.c   whether an orbit is chaotic, and a second one that begins beside it
 *     view_data.c        the data as JSON, columns of numbers as base64
 *     view_write.c       the page: the data and the files of view/
 */
#ifndef ISOROLL_VIEW_H
#define ISOROLL_VIEW_H

#include <jansson.h>

#include "parameters.h"
#include "study/chaos/indicators.h"

/* Bounds that keep a page below 3 MB. In base64 a number takes 10.7 bytes. */
enum {
    VIEW_MOST_ROWS = 5000,       /* of the orbit that is played; of more, each second, third, ... is kept     */
    VIEW_MOST_CROSSINGS = 20000, /* of a section                                                             */
    VIEW_MOST_ORBITS = 10000     /* of a section; so each has two crossings or more                           */
};
#define VIEW_MOST_NUMBERS 140000.0 /* of all orbits of a section */

/* The largest turn of the ball, of n or of gamma between two rows, in radians. Cubic curves through such rows are
 * right to 1e-6 of the radius. */
#define VIEW_TURN 0.1

/* How far beside an orbit its neighbour begins, in radians. */
#define VIEW_BESIDE 1e-6

enum { VIEW_NOTES = 8, VIEW_WORDS = 512 };

/* What the study of chaos says of an orbit. */
typedef struct view_fate {
    bool known; /* false: it refuses the orbit */
    iso_verdict verdict;
    double exponent; /* the largest, per unit of t */
} view_fate;

typedef struct view_section {
    int axis;
    iso_record *crossings; /* columns orbit, l, x: those that are drawn         */
    size_t total, orbits;  /* crossings and orbits of the file                  */
    iso_record **orbit;    /* the orbits that can be run; rows as in view_page  */
    iso_record **beside;   /* their neighbours; NULL: none                      */
    view_fate *fate;       /* of each of them                                   */
    size_t *number;        /* the number that each of them has in the file      */
    size_t count;          /* of orbits that can be run                         */
} view_section;

typedef struct view_page {
    const char *title; /* the name of the file */
    const char *kind;  /* "scene", "trajectory" or "section" */
    iso_params params;
    iso_effects effects;
    double eps, h;          /* NAN: not known                                              */
    iso_clock clock;        /* the clock that runs evenly at first                         */
    char alone[VIEW_WORDS]; /* why the ball has no point; "": it has one                   */
    char note[VIEW_NOTES][VIEW_WORDS];
    int notes;
    iso_record *rows;    /* by columns of iso_column_name, in the order of their times  */
    double *times;       /* of a scene: those of the rows                               */
    size_t count;        /* of times                                                    */
    size_t total, every; /* rows of the file or scene; each `every`-th of them is here  */
    size_t between;      /* rows put between two of the scene's                         */
    iso_record *drifts;  /* a column for each integral, rows as above; NULL: none       */
    iso_record *apart;   /* apart_n, apart_gamma: how far the two runs differ; NULL: one run */
    iso_record *beside;  /* the neighbour (view_neighbour); NULL: none                       */
    view_fate fate;
    iso_drift integral[2 * ISO_MAX_INTEGRALS];
    int integrals;
    view_section *section; /* NULL: none */
    bool live;             /* the library is in the page                                             */
    bool attitude;         /* the scene or the file states one; every page has one to draw the ball    */
    bool no_orbit;         /* rows of a trajectory do not follow the equations: a note says so */
} view_page;

void view_page_free(view_page *page);

/* Whether an effect breaks the isomorphism; if so, page->alone gets the words. Reads page->effects. */
bool view_is_broken(view_page *page);

/* page->effects from the lines of a trajectory; which of them are idle, from its first row. */
iso_status view_read_effects(iso_context *ctx, const iso_record *r, view_page *page);

/* Parameters, effects, h and eps of the page by the lines of a file and the options; h and eps are NAN without such a
 * line. Errors: ISO_BAD_INPUT about a line. */
iso_status view_read_lines(iso_context *ctx, const file_options *from, iso_record *r, view_page *page);

/* Adds a line that the page shows. */
void view_note(view_page *page, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* --- parts ------------------------------------------------------------------------------------------------------ */

/* The orbit of a scene. The ball's columns are those of the ball's run, M and gamma those of the point's own; where
 * there is no such run they are those of the ball, carried across. Errors: those of iso_run. */
iso_status view_of_scene(iso_context *ctx, const iso_scene *scene, view_page *page);

/* A trajectory file. Errors: ISO_BAD_INPUT names the missing column or the row; those of the library. */
iso_status view_of_trajectory(iso_context *ctx, const file_options *from, view_page *page);

/* A section file, CSV or HDF5. Errors: likewise. */
iso_status view_of_section(iso_context *ctx, const file_options *from, view_page *page);

/* `rows` have a clock and the states of one model. *complete also has the columns that they lack: the other model
 * (not if page->alone says why there is none), the clocks, q, contact and centre. Of `page` it reads params, effects
 * and alone. *worst: the row that the orbit through the row before it misses most. */
typedef struct view_miss {
    size_t row; /* from 0                                                                         */
    double by;  /* iso_row_gap.miss; 0: none is missed                                            */
} view_miss;
iso_status view_complete(iso_context *ctx, const view_page *page, iso_record *rows, iso_record **complete,
                         view_miss *worst);

/* An orbit for rows of a file, by the ball's equations in `clock`, with its attitude; if there is a point, also with
 * the point and all clocks. Reads page->params and page->alone. Switches the attitude on in `effects`. Errors: those
 * of iso_orbit_create. */
iso_status view_orbit(iso_context *ctx, const view_page *page, const iso_start *start, iso_effects *effects,
                      iso_clock clock, iso_orbit **orbit);

/* The integrals that hold for page->rows, and their drifts. */
iso_status view_numbers(iso_context *ctx, view_page *page);

/* The neighbour of the orbit from `start`, which begins VIEW_BESIDE from it, at the times t of `rows` since the first:
 * near1..3, where it is in the picture of the point (n, if there is no point), and near, its distance. *beside NULL: it
 * cannot be computed. Errors: ISO_STOPPED, ISO_NO_MEMORY. */
iso_status view_neighbour(iso_context *ctx, const view_page *page, const iso_start *start, const iso_effects *effects,
                          const iso_record *rows, iso_record **beside);

/* page->section->fate: verdicts on the orbits that begin on the section at (l, x), with the energy of `start`. Adds a
 * note if there are none, such as for a section that is not global. Errors: likewise. */
iso_status view_judge_section(iso_context *ctx, view_page *page, const iso_start *start, const iso_effects *effects,
                              const double (*at)[2]);

/* page->fate and page->beside, by the first row. Errors: likewise. */
iso_status view_neighbour_of_rows(iso_context *ctx, view_page *page);

/* --- records ---------------------------------------------------------------------------------------------------- */

/* Whether a column of iso_column_name is there only if there is a point: tau, s, M and gamma. */
bool view_is_of_point(int column);

/* The three numbers of a vector in a row; `name` is its first column. NULL: there is no such column. */
const double *view_vector(const iso_record *r, size_t row, const char *name);

/* |a - b|. */
double view_distance(const double a[3], const double b[3]);

/* The largest turn, in radians, of the ball, of n or of gamma from one row to the next, of rows with t and omega. The
 * ball turns by |omega| dt, n by at most |k| times that. */
double view_largest_turn(const iso_record *r, double k);

/* Adds a note where rows of the page turn so far that cubic curves between them are seen to be wrong: their error is
 * turn^4/384. From one radian on they are a guess. */
void view_note_turn(view_page *page);

/* --- output ----------------------------------------------------------------------------------------------------- */

#define VIEW_BASE64 "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/" /* its digits */

/* The data of a page: numbers one by one, columns as base64 of little-endian doubles. The caller releases it. If
 * memory is short, parts are missing; json_whole() then says so. */
json_t *view_data(const view_page *page);

/* Whether this build has what a page needs. Errors: ISO_BAD_ARGUMENT: it was built without three.js. */
iso_status view_check_build(iso_context *ctx, bool live);

/* Errors: ISO_FILE_TROUBLE, ISO_CLOSED_PIPE, ISO_NO_MEMORY. */
iso_status view_write(iso_context *ctx, const char *path, const view_page *page);

#endif

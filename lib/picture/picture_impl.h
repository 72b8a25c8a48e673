/* picture_impl.h - what the pictures of this folder share. */
#ifndef ISO_PICTURE_PICTURE_IMPL_H
#define ISO_PICTURE_PICTURE_IMPL_H

#include "orbit/orbit.h"
#include "picture/picture.h"
#include "study/study_impl.h"

/* What is asked for. */
typedef struct iso_picture_request {
    const iso_record *const *table; /* NULL behind the last; table[0] is drawn */
    const char *options;            /* lines NAME=VALUE, or NULL               */
} iso_picture_request;

/* A kind of table. */
typedef struct iso_picture_maker {
    const char *kind, *shows; /* shows: the title of a table that has none */
    const char *columns[5];   /* that the picture needs; NULL ends them    */
    bool axis;                /* and the line "axis"                       */
    const char *options;      /* those that it takes, with blanks around: " window points " */
    bool alone;               /* it needs lines alone, no rows             */
    iso_status (*make)(iso_context *ctx, const iso_picture_request *request, iso_picture *picture);
} iso_picture_maker;

extern const iso_picture_maker iso_picture_branch, iso_picture_chaos, iso_picture_chart, iso_picture_columns,
    iso_picture_compare, iso_picture_cost, iso_picture_frequencies, iso_picture_indicators, iso_picture_periodic,
    iso_picture_section, iso_picture_splitting, iso_picture_sweep, iso_picture_sweep_part, iso_picture_trajectory;

/* The first of the further tables of this kind; NULL: there is none. */
const iso_record *iso_picture_given(const iso_picture_request *request, const char *kind);

/* The value of an option, in `value`; false: it is not given. */
enum { ISO_PICTURE_OPTION = 128 };
bool iso_picture_option(const iso_picture_request *request, const char *name, char value[static ISO_PICTURE_OPTION]);

/* Adds an empty table `name`, to be filled by iso_record_add. columns: their names with a blank between; a column of
 * words has a ' behind its name. */
iso_status iso_picture_add(iso_context *ctx, iso_picture *picture, const char *name, const char *columns,
                           iso_record **table);

/* The place of a table that is not drawn. It is freed with the picture, or when the picture is made. */
iso_record **iso_picture_aside(iso_picture *picture);

/* Lines of the first table: a text; numbers, whose keys have a blank between; a title: that of table[0], else what is
 * seen, a gap, and the ball. */
iso_status iso_picture_line(iso_context *ctx, iso_picture *picture, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
iso_status iso_picture_set(iso_context *ctx, iso_picture *picture, const char *keys, const double numbers[]);
#define ISO_PICTURE_TITLE "%s        %s"
iso_status iso_picture_title(iso_context *ctx, const iso_picture_request *request, iso_picture *picture,
                             const char *seen, const iso_params *p);

/* A number of a table by its column, or by the name of its column (NaN: there is none); whether a word is this one; the
 * axis of the line "axis", 0 to 2 (-1: there is none); the least and the largest number of a column. */
static inline double iso_picture_at(const iso_record *table, size_t row, int column)
{
    return iso_record_const_row(table, row)[column];
}
double iso_picture_number(const iso_record *table, size_t row, const char *column);
bool iso_picture_is(const iso_record *table, size_t row, const char *column, const char *word);
int iso_picture_axis(const iso_record *table);
void iso_picture_range(const iso_record *table, int column, double range[2]);

/* A symbol for the name of a column: "γ" for "gamma", "n₁" for "n1"; the name itself if there is none. The index of an
 * axis, 0 to 5, of which the last three are again the first. */
const char *iso_picture_symbol(const char *name);
extern const char *const iso_picture_index[6];

/* --- paths and curves ------------------------------------------------------------------------------------------- */

/* How many rows of a path are drawn: all, or so many, with the first and the last; the i-th of these rows. */
enum { ISO_PICTURE_ROWS = 5000 };
size_t iso_picture_drawn(const iso_record *r);
const double *iso_picture_row(const iso_record *r, size_t i);

/* The first of `count` columns that stand side by side and are finite in all rows. Errors: ISO_BAD_INPUT (they are not
 * there), ISO_NUMERICAL. */
iso_status iso_picture_find(iso_context *ctx, const iso_record *r, int count, const char *const names[], int *first);

/* Adds a table `name`, the path of three columns of unit vectors on the sphere (see sphere.c), and a line
 * NAME_length: its length in radians, 0: its rows are too far apart to be joined, and NAME_rows, how many there are.
 * Adds its ends to a table "ends". iso_picture_axes adds the sphere's axes to a table "axes"; their numbers keep
 * away from every step-th row. iso_picture_sphere does all this for three columns by their names. */
iso_status iso_picture_path(iso_context *ctx, iso_picture *picture, const char *name, const iso_record *r,
                            int column);
iso_status iso_picture_axes(iso_context *ctx, iso_picture *picture, const char *name, const iso_record *r, int column,
                            size_t step);
iso_status iso_picture_sphere(iso_context *ctx, iso_picture *picture, const char *name, const iso_record *r,
                              const char *const columns[3]);

/* Unit vectors of the models, and what their paths on a sphere are. */
extern const char *const iso_picture_n[3], *const iso_picture_gamma[3];
#define ISO_PICTURE_OF_BALL "the ball: n, the normal where it touches"
#define ISO_PICTURE_OF_POINT "the point: γ, its place"

/* A vector as it is seen: right, up, and towards the eye (> 0: it is near). */
void iso_picture_see(const double v[3], double seen[3]);

/* Whether each drawn row is so near to the next one, in radians about 0, that a line may join them. */
bool iso_picture_joined(const iso_record *r, int column);

/* Adds the tables "path" and "marks", and what they show (see space.c). up: the vertical, a unit vector in axes of
 * space, NULL: not known; plane: the support is one, else a sphere about 0. Errors: ISO_BAD_INPUT (no columns of a
 * place), ISO_BAD_ARGUMENT (up), ISO_NUMERICAL. */
iso_status iso_picture_space(iso_context *ctx, const iso_record *r, const double *up, bool plane,
                             iso_picture *picture);

/* The rows at which contact is lost: `pressure` falls to 0, or becomes negative (the support would have to pull).
 * Returns how many. */
enum { ISO_PICTURE_LOSSES = 20 };
int iso_picture_losses(const iso_record *r, size_t lost[ISO_PICTURE_LOSSES]);

/* Adds a curve of a chart to the tables "curves" and "values" (see curves.c): a column over another one. */
typedef enum iso_picture_thinning {
    ISO_PICTURE_EVENLY,
    ISO_PICTURE_EXTREMES,
    ISO_PICTURE_LARGEST
} iso_picture_thinning;
typedef struct iso_picture_curve {
    const char *chart, *name; /* name: NULL: the symbol of the column */
    const iso_record *rows;
    int over, column;
    bool right; /* its axis is on the right */
    iso_picture_thinning thinning;
    double top; /* it is cut off there; INFINITY: nowhere */
} iso_picture_curve;
iso_status iso_picture_add_curve(iso_context *ctx, iso_picture *picture, const iso_picture_curve *curve);

/* Adds the curves of all columns of a record over its first one. names: theirs; NULL: their symbols. */
iso_status iso_picture_add_chart(iso_context *ctx, iso_picture *picture, const char *chart, const iso_record *rows,
                                 const char *const names[], iso_picture_thinning thinning);

/* Adds the empty tables "curves" and "values". */
iso_status iso_picture_add_curves(iso_context *ctx, iso_picture *picture);

/* The curve of a splitting with slope m and multiplier lambda (iso_separatrix_curve), with as many half returns beyond
 * the crossing as are needed to see the lobes (section.c). */
iso_status iso_picture_separatrix(iso_context *ctx, double k, const double J[3], double level, double m,
                                  double lambda, iso_record **curve);

/* --- the first turns of an orbit (stretch.c) -------------------------------------------------------------------- */

enum { ISO_STRETCH_STATES = 65 };

/* n goes this often around its sphere, by the length of its path. States of different turns stand apart. */
#define ISO_STRETCH_TURNS 1.5

/* Two tables with the columns t, s, n1..3 and gamma1..3, from the start to t = end or for ISO_STRETCH_TURNS turns if
 * these end before. curve: neighbours are about two degrees apart on both spheres. states: ISO_STRETCH_STATES at equal
 * steps of t. t and n are of the backend `ball`; s and gamma, at the same t, of the backend `point`.
 * With the curve behind them the states are what iso_picture_make draws as "compare"; add a line "result" that says
 * how the models agree.
 * Errors: those of iso_orbit_create and iso_orbit_at. The caller frees both, also after an error. */
iso_status iso_picture_stretch(iso_context *ctx, const iso_scene *scene, double end, iso_record **states,
                               iso_record **curve);

#endif

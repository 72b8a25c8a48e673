/* periodic_impl.h - what the files of periodic orbits share.
 *
 *     hill.c                 the rotations, by Hill's equation
 *     periodic.c             the call: what is refused, the order of the work, the list
 *     periodic_map.c         the map g (half a return and T) and f = g g: many points in lanes, one in more digits;
 *                            the six symmetry lines, and shots from one of them to itself
 *     periodic_search.c      symmetric orbits along the symmetry lines; other orbits from a grid
 *     periodic_orbit.c       an orbit from a place near it: digits, trace, error, closure; the list: what is new,
 *                            symmetry, copies
 *     periodic_study.c       what is typed, and the tables
 *
 * All of them compute in own units with eps = 1, on the level H = energy of the point.
 */
#ifndef ISO_INSTRUMENT_PERIODIC_PERIODIC_IMPL_H
#define ISO_INSTRUMENT_PERIODIC_PERIODIC_IMPL_H

#include "instrument/periodic/periodic.h"
#include "map/section.h"
#include "method/wide_impl.h"
#include "model/model.h"
#include "orbit/crossings.h"
#include "study/study_impl.h"

/* --- the map ---------------------------------------------------------------------------------------------------- */

typedef struct iso_periodic_map {
    iso_context *ctx;
    iso_params p;  /* own */
    double energy; /* the level H of the point, for eps = 1 */
    int axis, threads;
    iso_model model;     /* the point on this level, eps = 1, with all clocks */
    iso_effects effects; /* the level again, as starts need it                */
    double zeros;        /* see iso_lane_job */
    double finer;        /* of one point: the tolerance is this part of the usual one */
} iso_periodic_map;

static inline iso_point_motion iso_periodic_motion(const iso_periodic_map *map)
{
    return (iso_point_motion){&map->p, 1, map->energy};
}

void iso_periodic_map_prepare(iso_context *ctx, const iso_params *own, double energy, int threads,
                              iso_periodic_map *map);

/* The same of the section of another axis. */
void iso_periodic_map_turn(int axis, iso_periodic_map *map);

/* A point of the section, and d(l, x) there / d(l, x) at the start. */
typedef struct iso_periodic_point {
    double l, x, slope[2][2];
} iso_periodic_point;

/* to[halves i + n - 1] = g^n of start i, n = 1 to halves. Of whole returns: to[halves i + n - 1] = f^n instead. A
 * start that fails has NaN. Errors: ISO_NO_MEMORY, ISO_STOPPED. */
iso_status iso_periodic_walk(const iso_periodic_map *map, size_t count, const double (*from)[2], int halves,
                             bool whole, double tolerance, iso_periodic_point *to);

/* A piece of an orbit in more digits: its end, the derivative, and the clocks that pass. */
typedef struct iso_periodic_fine {
    iso_wide to[2], slope[2][2], clock[ISO_CLOCKS];
    iso_wide determinant; /* of slope: the product of those of the returns, which do not cancel */
} iso_periodic_fine;

/* g^halves of a point. path[n - 1] = g^n of it, n = 1 to halves; NULL: not asked. False: it failed. */
bool iso_periodic_far(const iso_periodic_map *map, const iso_return_build *code, const iso_wide from[2], int halves,
                      double (*path)[2], iso_periodic_fine *found);

/* The law of the derivative's determinant, from l to another l: G(l)/G(l'). */
iso_wide iso_periodic_determinant(const iso_periodic_map *map, iso_wide l, iso_wide to);

/* --- lines ------------------------------------------------------------------------------------------------------ */

/* The symmetry lines: the fixed states of S1, S2, S3, T S1, T S2, T S3. The first three are lines of the section:
 * x = 0, l = 0, l = pi/2. The others lie half way between two crossings: gamma = -e_a; gamma_b = 0; gamma_c = 0
 * (iso_return_start). Each has a coordinate u from 0 to pi/2; on x = 0 it is l, on l = 0 and pi/2 it is asin x. At
 * both ends are rotations. */
enum { LINE_X, LINE_0, LINE_QUARTER, LINE_POLE, LINE_PLANE_B, LINE_PLANE_C, LINES };

static inline bool iso_symmetry_line_is_half_way(int line)
{
    return line >= LINE_POLE;
}

/* The reversor S1, S2 or S3 (0, 1, 2) of the line. */
static inline int iso_symmetry_line_reversor(int line)
{
    return line % 3;
}

/* The axis of the rotation at u = 0, or at u = pi/2. */
int iso_symmetry_line_axis_at(int axis, int line, bool end);

/* The part u[0] < u < u[1] of a line on which the point can move on this level; false: none. Where it ends between 0
 * and pi/2 the point rests: it oscillates in a principal plane. */
bool iso_symmetry_line_range(const iso_periodic_map *map, int line, double u[2]);

/* The reversor S1, S2, S3 (0, 1, 2). */
void iso_periodic_reverse(int reversor, const double z[2], double to[2]);

/* z[i]: where the orbits of the line at u[i] cross the section first, or stand on it; by_u: the slopes. */
iso_status iso_periodic_place(const iso_periodic_map *map, int line, size_t count, const double u[], double (*z)[2],
                              double (*by_u)[2]);

/* F_n(u), a number that changes its sign where the orbit is on the line again after n half returns. before and at are
 * g^(n-1) z and g^n z. *slope: of F_n by u. *there: the orbit is its own mirror image, as each orbit of the line is.
 * F_n of lines half way has other zeros as well. */
double iso_periodic_miss(int line, const iso_periodic_point *before, const iso_periodic_point *at,
                         const double by_u[2], double *slope, bool *there);

/* A shot: from u of a line half an orbit of `period` returns, to the same line. With E = diag(1, -1) the reflection
 * of (u, c), and D the derivative to coordinates along and across the line there, the derivative of the whole orbit
 * is E D^-1 E D. Its trace is 2 + 4 D_01 D_10/det D = 4 D_00 D_11/det D - 2. */
typedef struct iso_periodic_shot {
    iso_wide u, z[2]; /* the start, and its first point on the section */
    /* On the line at the end, the crossing behind it is S of the crossing before it (on the section they are one).
     * miss: how far that is from true, and its derivative by u. */
    iso_wide miss[2], miss_by_u[2];
    iso_wide off;     /* F: the coordinate of the middle of both crossings that S turns over: 0 on the line */
    iso_wide D[2][2]; /* row 0: slopes of the middle's other coordinate; row 1: of F */
    iso_wide trace;   /* of the whole orbit, if miss is 0 */
    double terms;     /* the trace is a sum of terms of this size: so large are its rounding errors */
    iso_wide clock[ISO_CLOCKS];
    iso_periodic_fine half; /* g^period of z */
    iso_wide back[2][2];    /* the derivative of g^period there, along the mirror image, which leads back to z */
    double path[ISO_PERIODIC_MOST][2]; /* g z ... g^period z */
} iso_periodic_shot;
bool iso_periodic_shoot(const iso_periodic_map *map, const iso_return_build *code, int line, iso_wide u, int period,
                        iso_periodic_shot *shot);

/* --- orbits ----------------------------------------------------------------------------------------------------- */

typedef struct iso_periodic_work {
    iso_context *ctx;
    const iso_scene *scene;
    iso_periodic_options options;
    iso_periodic_map map;
    iso_motion_level on;           /* of the scene */
    double unit_clock[ISO_CLOCKS]; /* the scene's clocks of one own clock at eps = 1 */
    iso_periodic *out;
} iso_periodic_work;

/* A place that may lie on an orbit. */
typedef struct iso_periodic_candidate {
    int line; /* of a symmetric orbit; -1: none    */
    int period;
    double u;    /* of the line                    */
    double l, x; /* its point of the section       */
} iso_periodic_candidate;

/* How far apart two points are. All copies of a point, and those by the reversors, count as one: each is the same point
 * of [0, pi/2] x [0, 1]. */
static inline double iso_periodic_apart(const double a[2], const double b[2])
{
    return fmax(fabs(fabs(remainder(a[0], ISO_PI)) - fabs(remainder(b[0], ISO_PI))), fabs(fabs(a[1]) - fabs(b[1])));
}

/* f's l modulo a turn into (-pi, pi]. */
double iso_periodic_angle(double l);

/* Solves candidates on all threads, and adds their orbits to the list, unless they are there already or have a
 * smaller period. Errors: ISO_NO_MEMORY; ISO_STOPPED. */
iso_status iso_periodic_add(iso_periodic_work *w, const iso_periodic_candidate c[], size_t count);

/* Appends an item to a list; `list` is where its pointer is kept. The room doubles where count is a power of 2. */
iso_status iso_periodic_append(iso_context *ctx, void *list, size_t *count, const void *item, size_t size);

iso_status iso_periodic_rotations(iso_periodic_work *w);
iso_status iso_periodic_search(iso_periodic_work *w);
iso_status iso_periodic_from_grid(iso_periodic_work *w);

/* The multipliers of a matrix of determinant 1. sense: of its lower left number. */
iso_multipliers iso_multipliers_of(double trace, double error, double sense);

/* --- Hill's equation of the rotations (hill.c) ------------------------------------------------------------------ */

/* The half-turn trace of Hill's equation about `axis` (0 to 2) on the level H = energy of the point with eps = 1, by
 * numbers of 64 bits of mantissa, and in *error (NULL: not asked) how far it may be off. NaN for |k| < 1e-4, a moment
 * <= 0, or where there is no such rotation. It is below -2 about the axis of the middle moment, for all k and J and
 * on every level on which this rotation exists. */
double iso_hill_trace(double k, const double J[3], double energy, int axis, double *error);

/* Whether the whole circle gamma_axis = 0 can be reached on this level, energy + q^(-1/k) > 0. If not, there is no
 * rotation, but an oscillation between two places of rest. */
bool iso_hill_has_rotation(double k, const double J[3], double energy, int axis);

#endif

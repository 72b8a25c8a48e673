/* periodic_impl.h - what the files of periodic orbits share.
 *
 *     hill.c                 Hill's equation of the rotations
 *     periodic.c             the call: what is refused, the order of the work, the list
 *     periodic_map.c         the map g (half a return and T) and f = g g: many points in lanes, one point in more digits
 *     periodic_rotations.c   the rotations
 *     periodic_search.c      symmetric orbits along the symmetry lines
 *     periodic_grid.c        other orbits from a grid
 *     periodic_orbit.c       an orbit from a point of it: digits, trace, symmetry, copies
 *
 * All of them compute in own units with eps = 1.
 */
#ifndef ISO_STUDY_PERIODIC_IMPL_H
#define ISO_STUDY_PERIODIC_IMPL_H

#include "map/section.h"
#include "model/model.h"
#include "orbit/crossings.h"
#include "study/periodic.h"
#include "study/wide_impl.h"

/* --- the map ---------------------------------------------------------------------------------------------------- */

typedef struct iso_periodic_map {
    iso_context *ctx;
    iso_params p; /* own */
    int axis, threads;
    iso_model model; /* the point on H = 0, eps = 1, with all clocks */
    double zeros;    /* see iso_lane_job */
    double finer;    /* of one point: the tolerance is this part of the usual one */
} iso_periodic_map;

void iso_periodic_map_prepare(iso_context *ctx, const iso_params *own, int threads, iso_periodic_map *map);

/* A point of the section, and d(l, x) there / d(l, x) at the start. */
typedef struct iso_periodic_point {
    double l, x, slope[2][2];
} iso_periodic_point;

/* to[halves i + n - 1] = g^n of start i, n = 1 to halves. Of whole returns: to[halves i + n - 1] = f^n instead. A
 * start that fails has NaN. Errors: ISO_NO_MEMORY, ISO_STOPPED. */
iso_status iso_periodic_walk(const iso_periodic_map *map, size_t count, const double (*from)[2], int halves,
                             bool whole, double tolerance, iso_periodic_point *to);

/* g^halves of a point in more digits, its derivative, and the clocks that pass. False: it failed. */
typedef struct iso_periodic_fine {
    iso_wide to[2], slope[2][2], clock[ISO_CLOCKS];
    iso_wide determinant; /* of slope: the product of those of the returns, which do not cancel */
} iso_periodic_fine;
bool iso_periodic_far(const iso_periodic_map *map, const iso_return_code *code, const iso_wide from[2], int halves,
                      iso_periodic_fine *found);

/* The law of the derivative's determinant, from l to another l: G(l)/G(l'). */
iso_wide iso_periodic_determinant(const iso_periodic_map *map, iso_wide l, iso_wide to);

/* The code of numbers of 64 bits, or of 128 (NULL: there is none). */
const iso_return_code *iso_periodic_code(bool polish);

/* --- orbits ----------------------------------------------------------------------------------------------------- */

/* The symmetry lines: x = 0, l = 0, l = pi/2; each from parameter 0 to pi/2. On x = 0 it is l, else asin x. */
enum { LINE_X, LINE_0, LINE_QUARTER, LINES };

typedef struct iso_periodic_work {
    iso_context *ctx;
    const iso_scene *scene;
    iso_periodic_options options;
    iso_periodic_map map;
    double h; /* of the scene's orbit, own units                            */
    iso_units units;
    double unit_clock[ISO_CLOCKS]; /* the scene's clocks of one own clock at eps = 1 */
    iso_periodic *out;
    size_t room;
    struct iso_periodic_folded *folded; /* points of the orbits that are found, for duplicates */
    size_t folded_count, folded_room;
} iso_periodic_work;

/* A point that may lie on an orbit. */
typedef struct iso_periodic_candidate {
    int line; /* of a symmetric orbit; -1: none    */
    int period;
    double l, x;
} iso_periodic_candidate;

/* f's l modulo a turn into (-pi, pi]. */
double iso_periodic_angle(double l);

/* How far a point is from the line, as a number that changes its sign there. slope: of this number by (l, x). */
double iso_periodic_off(int line, const iso_periodic_point *at);

/* Finishes a candidate and adds it to the list, unless it is there already or has a smaller period. *added may be
 * NULL. Errors: ISO_NO_MEMORY. */
iso_status iso_periodic_add(iso_periodic_work *w, const iso_periodic_candidate *c, bool *added);
void iso_periodic_point_on(int line, double parameter, double z[2]);

iso_status iso_periodic_rotations(iso_periodic_work *w);
iso_status iso_periodic_search(iso_periodic_work *w);
iso_status iso_periodic_from_grid(iso_periodic_work *w);

/* The multipliers of a matrix of determinant 1. sense: of its lower left number. */
iso_multipliers iso_multipliers_of(double trace, double error, double sense);

#endif

/* scene.h - one problem to be solved, as a scene file states it: a ball, its start, times, how to solve.
 *
 * Fill it by hand or with iso_scene_load (io/scene_file.h). All numbers are in the user's units.
 */
#ifndef ISO_ORBIT_SCENE_H
#define ISO_ORBIT_SCENE_H

#include <stdbool.h>
#include <stddef.h>

#include "model/effects/effect.h"

/* Ball and point have the same values in the three enumerations, so that a cast leads from one to another. */

/* The two models. */
typedef enum iso_model_kind { ISO_BALL, ISO_POINT } iso_model_kind;

/* What finds an orbit: steps of the ball or of the point, or the closed solution of the point. */
typedef enum iso_backend {
    ISO_BACKEND_BALL,
    ISO_BACKEND_POINT,
    ISO_BACKEND_AUTO, /* chosen by start, effects and method; for a scene also by its rows */
    ISO_BACKEND_EXACT
} iso_backend;

/* Whose states are given or written. */
typedef enum iso_models {
    ISO_SHOW_BALL,
    ISO_SHOW_POINT,
    ISO_SHOW_BOTH,
    ISO_SHOW_START /* the model of the start; of a scene only */
} iso_models;

/* "ball", "point"; "ball", "point", "auto", "exact"; "ball", "point", "both", "auto". NULL past the end. */
const char *iso_model_kind_name(int kind);
const char *iso_backend_name(int backend);
const char *iso_models_name(int shown);

/* Where an orbit starts (its clock at 0), in one of the models. */
typedef struct iso_start {
    iso_model_kind model; /* of y                                                                        */
    double y[ISO_STATE];  /* omega [1/time], n; or M, gamma                                               */
    /* Coupling of the point's potential (24); NAN: the one with which H = 0, where the point has a free ball; not
     * read for a ball. */
    double eps;
} iso_start;

/* What to do with the spin about the normal, (omega, n): a rubber ball has none. */
typedef enum iso_spin {
    ISO_SPIN_REFUSE, /* above 1e-9 |omega|; removed below it          */
    ISO_SPIN_REMOVE, /* whatever it is                                */
    ISO_SPIN_KEEP    /* the ball is free to twist: the effect `twist` */
} iso_spin;

/* Makes a valid start of a ball. The normal is made a unit vector if its length is within 1e-6 of 1.
 * Errors: ISO_BAD_INPUT about "normal" or "angular_velocity", saying what to write instead. */
iso_status iso_start_ball(iso_context *ctx, const double omega[3], const double normal[3], iso_spin spin,
                          iso_start *start);

/* Makes a valid start of a point: |gamma| within 1e-6 of 1, (M, gamma) at most 1e-9 |M| (or `project`).
 * eps NULL: start->eps is NAN.
 * Errors: ISO_BAD_INPUT about "gamma", "M" or "eps". */
iso_status iso_start_point(iso_context *ctx, const double M[3], const double gamma[3], const double *eps,
                           bool project, iso_start *start);

enum { ISO_MAX_COLUMNS = 64, ISO_NAME_SIZE = 32, ISO_MAX_PLACES = 48 };

/* Where a scene file has the value of a key: line and column from 1. */
typedef struct iso_place {
    char key[ISO_NAME_SIZE];
    int line, column;
} iso_place;

typedef struct iso_scene {
    iso_params params;
    iso_start start;
    iso_effects effects;        /* what acts on the ball beyond (9), or is asked of it                     */
    double end;                 /* last time, in t for a ball's start, in s for a point's; < 0: backwards  */
    double step;                /* between output rows, > 0; 0: a hundredth of |end|                       */
    iso_backend backend;        /* what finds the orbit                                                   */
    char method[ISO_NAME_SIZE]; /* a name of iso_methods, or "auto"                                        */
    double tolerance;           /* largest relative error of one step, in ISO_TOLERANCE_RANGE                     */
    iso_models as;              /* whose states are written                                               */
    size_t columns;             /* names of the columns wanted; 0: those of `as`                           */
    char column[ISO_MAX_COLUMNS][ISO_NAME_SIZE];
    const char *name; /* what messages call it; NULL: nothing. Not copied with the scene            */
    int places;       /* of what was read from a file, 0 for a scene filled by hand                              */
    iso_place place[ISO_MAX_PLACES];
} iso_scene;

/* A scene without a ball: backend and method "auto", tolerance 1e-12, as ISO_SHOW_START (the model of the start). */
iso_scene iso_scene_default(void);

/* The ball and the start of a scene with another k, J (three) or start (six: omega, n; or M, gamma); NULL: the
 * scene's. With k or J the ball is a reduced one: its body is forgotten, D stays; effects keep their numbers. A scene
 * of a point that states eps keeps it: the point then has another energy H = M^2/2 - eps (gamma, J gamma)^(-1/k),
 * which is not 0 if it was. Without eps in the scene it is the one with which H = 0.
 * Errors: those of iso_params_reduced, iso_start_ball, iso_start_point. */
iso_status iso_scene_replaced(iso_context *ctx, const iso_scene *scene, const double *k, const double J[3],
                              const double start[6], iso_params *params, iso_start *replaced);

/* More rows than this in a scene file are a mistake in `step`. */
#define ISO_MOST_ROWS 1e8

/* Output times: row i of a scene's time grid, i = 0 ... iso_scene_rows() - 1; the last row is exactly `end`. */
size_t iso_scene_rows(const iso_scene *scene);
double iso_scene_time(const iso_scene *scene, size_t row);

/* Indices of the columns the scene asks for (iso_column_name), and how many: columns[] has room for
 * ISO_MAX_COLUMNS. */
int iso_scene_column_list(const iso_scene *scene, int columns[]);

/* Every column a trajectory can have, in file order: the clocks, the states of the ball and of the point, then
 * those of the effects, in the order of the registry (iso_effect_column_name):
 *     t tau s   omega1..3 n1..3   M1..3 gamma1..3
 *     e1..3                        gravity: vertical, in body axes
 *     q0..3                        attitude: quaternion from body to space axes
 *     contact1..3                  attitude: contact point in space: a R n from the fixed sphere's centre, or,
 *                                  on a plane, its way from the first contact
 *     trace1..3                    attitude: contact point on the ball, -b n in body axes
 *     centre1..3                   attitude: centre of the ball in space, likewise
 *     N1..3                        reactions: contact force, in body axes
 *     pressure friction mu lambda  reactions: the part of N that pushes the ball off the support, the size of the
 *                                  rest, the friction coefficient needed, the twist torque
 * Lengths and forces of a reduced scene are those of a ball with |b| = 1. */
enum {
    ISO_COLUMN_BALL = ISO_CLOCKS,
    ISO_COLUMN_POINT = ISO_COLUMN_BALL + ISO_STATE,
    ISO_COLUMN_EFFECTS = ISO_COLUMN_POINT + ISO_STATE,
    ISO_TRAJECTORY_COLUMNS = ISO_COLUMN_EFFECTS + ISO_EFFECT_COLUMNS /* room for them all */
};

/* How many there are, and their names; NULL past the last. */
int iso_columns_count(void);
const char *iso_column_name(int column);

/* What a column is, in one line, and its unit ("": a number without one); NULL past the last. */
const char *iso_column_doc(int column, const char **unit);

#endif

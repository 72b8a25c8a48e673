/* analogue.h - finds a ball for a problem of a point on a sphere: section 5 of the paper read backwards.
 *
 *     V = -eps (gamma, J gamma)^(-1/k)      or, k = -1,      V = (1/2) sum c_i gamma_i^2      at M^2/2 + V = E
 *
 * The ball with k and J has h = eps k^2/det J. Off E = 0 it rolls in the potential of the effect `level`,
 * c = E k^2/det J. A ball without this potential is called free. It is taken where there is one:
 *
 *     E = 0         the ball of the same k, J and eps
 *     k = -1        since |gamma| = 1, adding a constant to V only shifts J:
 *                   V - E = -(1/2)(gamma, (2 E - c) gamma) with c = -2 eps J.
 *                   The ball with J = 2 E - c is free. It exists where all three of 2 E - c are positive
 *     V constant    the point turns uniformly: any equal moments, eps = (E - V) J^(1/k)
 *
 * For k = -1 there is also a ball in the potential of a level with J = d - c for every d that makes J positive.
 * d = max c + 2 (max c - min c) gives max J/min J = 3/2, and such a J always has a body.
 *
 * A body: J -> s J, eps -> s^(1/k) eps leaves V and its clock s as they are. The central moments I = s J - D with
 * D = m B^2 must be positive and obey the triangle inequalities. With J sorted, they do for 0 < D/s <= J1 + J2 - J3:
 * a body exists exactly if J1 + J2 > J3. D/s is put in the middle.
 */
#ifndef ISO_TASK_ANALOGUE_H
#define ISO_TASK_ANALOGUE_H

#include "orbit/orbit.h"

typedef struct iso_analogue_problem {
    bool neumann; /* V = (1/2) sum c_i gamma_i^2: k, J and eps are not read                     */
    double c[3];
    double k, J[3], eps; /* V = -eps (gamma, J gamma)^(-1/k): c is not read                            */
    double energy;       /* E = M^2/2 + V                                                              */
    /* For k = -1: a ball in the potential `level` although there is a free one. Such a ball always has a body. */
    bool level;
} iso_analogue_problem;

/* How J was found. */
typedef enum iso_analogue_choice {
    ISO_ANALOGUE_STATED,   /* as the problem states it                            */
    ISO_ANALOGUE_FREE,     /* k = -1: the shift that makes the level 0            */
    ISO_ANALOGUE_SHIFTED,  /* k = -1: J = d - c                                   */
    ISO_ANALOGUE_CONSTANT, /* equal moments                                       */
} iso_analogue_choice;

/* A ball whose twin is the point: its gamma and M, in its clock s. */
typedef struct iso_analogue_ball {
    iso_params params;
    double eps;   /* coupling of its twin                                     */
    double h;     /* energy, without that of the level's potential            */
    double level; /* c of the effect `level`; 0: free                         */
} iso_analogue_ball;

typedef struct iso_analogue {
    iso_analogue_problem problem;
    double lowest, highest; /* of V on the sphere ... */
    int bottom;             /* ... the axis of the least V */
    iso_analogue_choice choice;
    double shift; /* V of the problem less that of the ball's twin, a constant                         */
    iso_analogue_ball reduced;
    char not_free[192]; /* why there is no free ball; "" when the ball is free                     */
    double room;        /* J1 + J2 - J3, J of `reduced` sorted: D/s is in (0, room]                 */
    double scale;       /* s, J of the body over that of `reduced`                                 */
    bool has_body;
    iso_analogue_ball body; /* with body.params.body                                                    */
    char no_body[512];      /* why there is none; "" when there is one                                 */
} iso_analogue;

/* The ball of a problem; its body is to have this mass and radius. NAN: the function chooses a round number.
 * Errors: ISO_BAD_INPUT about "k", "J", "eps", "c" or "energy" (no numbers, k = 0, J not positive); ISO_NOT_MAPPED
 * about "energy": no motion has it, or in a constant potential only rest; ISO_NUMERICAL: what leaves the doubles. */
iso_status iso_analogue_find(iso_context *ctx, const iso_analogue_problem *problem, double mass, double radius,
                             iso_analogue *analogue);

/* A start for a problem that has none: off the axes where the energy allows it. Gives a time s of about ten turns. */
double iso_analogue_start(const iso_analogue *analogue, double point[ISO_STATE]);

/* A scene of that ball, begun where its twin is at point[]; its end is where the point is at s_end (integrated).
 * Errors: as iso_orbit_create and iso_orbit_at. */
iso_status iso_analogue_scene(iso_context *ctx, const iso_analogue_ball *ball, const double point[ISO_STATE],
                              double s_end, iso_scene *scene);

/* The least number that is 1, 2 or 5 times a power of ten and not less than x > 0. Any other x comes back as it
 * is. */
double iso_analogue_round_up(double x);

#endif

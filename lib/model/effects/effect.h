/* effect.h - the table of effects: what can act on the ball beyond (9), or be computed beside its motion.
 *
 * A row holds everything that the library knows of an effect. Nothing else names it. To add an effect, write one
 * file, effect_<name>.c, and one line in effect_list.h. What a row leaves out the effect does not have; code that
 * needs it refuses the effect by name. The defaults are safe: an effect that does not say so keeps no energy, no
 * integral and no isomorphism.
 *
 *     effect              torque MQ on the ball                 states          isomorphism
 *     gravity             mgb e x n                             e (3)           lost, but on a horizontal plane
 *     field               k n x (C n + l)                       none            kept, V + U/G
 *     level               2 c g^(-1/k - 1) n x J^-1 n           none            kept, H = c det J/k^2
 *     twist               -c (omega,n) n, contact not rigid     lambda, stiff   lost
 *     rolling_resistance  -c_r omega                            none            lost
 *     rotor               K x omega                             none            kept, a magnetic field
 *     potential           k n x dU/dn, U as the scene writes it none            kept, V + U/G
 *     torque              as the scene writes it                none            lost
 *     integrals           none                                  none            kept
 *     attitude            none                                  Q (4), x (3)    kept
 *     reactions           none                                  none            kept
 *     clock               none                                  none            kept
 *
 * States y are those of the whole model (model.h): omega, n, then the states of the effects, those of effect e from
 * y[f->at[e]] on. Functions of a row work in the ball's own units, in which everything is of order one.
 */
#ifndef ISO_MODEL_EFFECTS_EFFECT_H
#define ISO_MODEL_EFFECTS_EFFECT_H

#include "model/system.h"

/* A number, vector or matrix of an effect: a key of the scene, and a line "# effect.name" of a trajectory file. */
typedef struct iso_effect_number {
    const char *name;
    int at, count;           /* numbers at ... at + count - 1 of iso_effects.number; 9 make a matrix, by rows      */
    iso_dimension dimension; /* in which units they are measured                                                    */
    enum {
        ISO_NUMBER_ANY,          /* finite                                                                          */
        ISO_NUMBER_POSITIVE,     /* a resistance > 0                                                                */
        ISO_NUMBER_NOT_NEGATIVE, /* a resistance >= 0                                                               */
        ISO_NUMBER_NOT_ZERO,     /* 0 would change nothing                                                          */
        ISO_NUMBER_UNIT,         /* a unit vector, to 1e-6                                                          */
        ISO_NUMBER_FLAG,         /* 0 or 1; true or false in a scene                                                */
        ISO_NUMBER_WORD          /* which of `word`, from 0; the word itself in scenes and files                    */
    } kind;
    bool required;   /* a scene must have the key                                                           */
    bool scene_only; /* not a line of trajectory files: the row's `complete` uses it, or only a run does    */
    /* Whose scenes state it. Those of ISO_OF_BODY and ISO_OF_REDUCED stand for each other, and one must be there:
     * `complete` computes the second from the first, which is scene_only. */
    enum { ISO_OF_ANY_BALL, ISO_OF_BODY, ISO_OF_REDUCED } of;
    bool hidden;             /* the row finds it by itself: in no scene, no file and no list                        */
    const double *initially; /* count numbers, where a scene has no such key; NULL: zeros                           */
    /* The group of columns with these numbers at later times: a row of a file starts with them (`begin`); NULL: they
     * are fixed. */
    const char *turns_with;
    const char *(*word)(int i); /* of ISO_NUMBER_WORD; NULL past the last */
} iso_effect_number;

/* Columns that an effect adds to a trajectory: one group is one number or vector, one dataset of HDF5 files. */
typedef struct iso_effect_column {
    const char *name;          /* of the group                                                                      */
    const char *const *column; /* the names of its columns                                                          */
    int count;
    const char *unit, *doc;  /* one line; unit "": numbers without one                                            */
    iso_dimension dimension; /* of its numbers ...                                                                */
    int length;              /* ... times the ball's radius to this power                                         */
    const char *checked_as;  /* `check` reports "<this> flow"; NULL: it is not compared                           */
    const char *sized_by;    /* the group whose size errors are measured by as well; NULL: its own size alone     */
    bool ratio;              /* a ratio x, as large as it likes: errors are those of the angle atan x             */
    bool moves;              /* on a plane it goes on from where the ball was                                     */
} iso_effect_column;

/* States that an effect adds: one group is one number or vector. */
typedef struct iso_effect_state {
    const char *const *name;
    int count;
    enum {
        ISO_STATE_ANY,      /* of order one in own units                                                            */
        ISO_STATE_UNIT,     /* a unit vector: its length is restored after each step                                */
        ISO_STATE_INTEGRAL, /* no other rate depends on it                                                          */
        ISO_STATE_DERIVED   /* `begin` gives it at any time, from omega and n                                       */
    } kind;
    /* Whether the effect has them here; NULL: always. */
    bool (*there)(const iso_problem *f);
} iso_effect_state;

/* What the effect does to the ball's energy. */
typedef enum iso_work {
    ISO_WORK_UNKNOWN, /* nobody may take the energy for conserved */
    ISO_WORK_NONE,    /* it is conserved, with the effect's potential */
    ISO_WORK_LOST     /* it only decreases */
} iso_work;

/* The additional integrals of the two systems (ball.c, point.c). */
typedef enum iso_additional { ISO_F_PLANE, ISO_F_SHELL, ISO_F_AXIS1, ISO_F_AXIS2, ISO_F_AXIS3 } iso_additional;

typedef struct iso_effect {
    const char *name, *doc;
    const char *point_name; /* what a scene of a point calls it; NULL: the same                            */

    /* --- what it means --- */
    bool observes; /* it changes nothing in the motion: it only adds states or columns                   */
    /* True if it never has a torque after a start with the normal n: then it only observes. NULL: never true. */
    bool (*idle)(const iso_params *p, const double n[3], const iso_effects *effects);
    bool ball_only;     /* an observer whose states or columns only backend ball has                          */
    const char *breaks; /* why no isomorphism survives it; NULL: it has an image, or it observes              */
    bool needs_D;       /* it needs D = m b^2                                                                 */
    bool needs_radius;  /* its columns are lengths or forces                                                  */
    bool twists;        /* the contact is not rigid: (omega,n) is free                                        */
    iso_work (*work)(const iso_problem *f); /* NULL: unknown; for an observer: none            */
    /* What a run says that ends because it turns the ball ever faster; NULL: it does not do that. */
    const char *drives;
    /* Whether an additional integral holds with it. NULL: none does; an observer keeps all. */
    bool (*keeps)(const iso_problem *f, iso_additional integral);
    /* Whether from each motion it makes another one, backwards in time: n(-t) with the signs of its components changed
     * by `sign`. NULL: it does not, or nobody knows. */
    bool (*reversible)(const iso_problem *f, const double sign[3]);
    const char *(*no_frequencies)(const iso_problem *f); /* why n(t) is not quasi-periodic; NULL: it may be */

    /* --- what a scene writes of it: iso_effects.written --- */
    /* The names of its expressions, ended by NULL; NULL: none. Then its first ISO_PARAMETERS numbers are parameters,
     * which the scene names; those of `numbers` stand behind them. */
    const char *const *expressions;
    /* The key of a scene that lists them all; NULL: each is a key, and only the first one must be there. */
    const char *expressions_key;
    int written; /* where its text is in iso_effects.written */

    /* --- its numbers and columns --- */
    const iso_effect_number *numbers; /* ended by a row without a name; NULL: none                                  */
    const iso_effect_column *columns; /* likewise                                                                   */
    /* Computes numbers from others that a scene states. model: 0 of a ball's scene, 1 of a point's. given(name) tells
     * whether the scene has the key. Errors: ISO_BAD_INPUT about the key, or the effect's name. */
    iso_status (*complete)(iso_context *ctx, const iso_params *p, int model, double number[],
                           bool (*given)(const void *scene, const char *key), const void *scene);
    /* Computes numbers that were not given (`initially` is NaN) from those of other effects. These stand before this
     * one in the list and are already checked. */
    void (*fill)(iso_effects *effects);
    /* What else must hold. n: the normal at the start. Errors: ISO_BAD_INPUT about a number's or the effect's name.
     */
    iso_status (*check)(iso_context *ctx, const iso_params *p, const double n[3], iso_effects *effects);
    /* Why a scene leaves one of its columns empty; NULL, or answering NULL: it does not. */
    const char *(*empty)(const iso_params *p, const iso_effects *effects, const char *column);
    /* Its columns, one after the other, in own units; and back: the states from the columns. An effect with states
     * and columns must have both. */
    void (*show)(const iso_problem *f, const double y[], double columns[]);
    void (*recall)(const iso_problem *f, const double columns[], double y[]);

    /* --- its equations, see formula.h --- */
    void (*motion)(iso_formula *F, const iso_problem *f);    /* torque on the ball, rates of its states        */
    void (*potential)(iso_formula *F, const iso_problem *f); /* U                                              */
    void (*image)(iso_formula *F, const iso_problem *f);     /* on the point: V with dV/dgamma, a magnetic field B */
    /* The torque of an effect that formulas cannot state: adds MQ to T. Then only methods that need nothing but y'
     * take the effect; others refuse it by name. Rates of its states stay in `motion`. */
    void (*torque)(const iso_problem *f, const double y[], double T[3]);

    /* --- its states --- */
    const iso_effect_state *states; /* ended by a row without a name; NULL: none                    */
    const char *states_doc;         /* why they are there                                           */
    /* Sets its states at the start. */
    void (*begin)(const iso_problem *f, double y[]);
    /* How large its states are, for error control. */
    void (*size)(const iso_problem *f, const double y[], double size[]);
    /* Restores constraints that are no unit vectors; returns the relative correction. */
    double (*restore)(const iso_problem *f, double y[]);

    /* --- sizes --- */
    /* How large U is made, for the speed it can give. */
    double (*strength)(const iso_problem *f, const double y[]);
    double (*range)(const iso_problem *f, const double y[]); /* how large U can be, if more than that              */
    /* How many times faster than the ball turns it makes motion die away. */
    double (*stiffness)(const iso_problem *f);
    /* The time until motion is less than ISO_REST; NULL: it does not end motion. */
    double (*time_to_rest)(const iso_problem *f);

    const iso_integral *integrals; /* that come with it, ended by a row without a name; NULL: none                  */
    const iso_integral *image_integrals; /* likewise, of the point                                                  */
} iso_effect;

/* --- numbers ---------------------------------------------------------------------------------------------------- */

/* The i-th number of an effect: those of its row, but hidden ones, then the parameters that the scene names. False:
 * past the last. n->name is good as long as effects are. */
bool iso_effect_number_at(const iso_effects *effects, iso_effect_id effect, int i, iso_effect_number *n);

/* No effects; every number as it is where a scene does not state it. */
iso_effects iso_effects_default(void);

/* Switches an effect on and sets one of its numbers (name NULL: none): "gravity", "up", 3 numbers.
 * Errors: ISO_BAD_ARGUMENT about the name: no such effect, no such number, not so many numbers. */
iso_status iso_effects_set(iso_context *ctx, iso_effects *effects, const char *effect, const char *name, int count,
                           const double values[]);

/* Switches an effect on that is written in the scene, and sets one of its expressions: "potential", "U", "c*n1^2".
 * Parameters are numbers: iso_effects_set gives a new name a place. What is wrong with an expression is found when
 * an orbit is made. Errors: ISO_BAD_ARGUMENT about the name: no such effect, no such expression; the text is longer
 * than ISO_EXPRESSION_SIZE - 1. */
iso_status iso_effects_write(iso_context *ctx, iso_effects *effects, const char *effect, const char *name,
                             const char *text);

/* Room for the columns of all effects, and for all integrals. */
enum { ISO_EFFECT_COLUMNS = 28, ISO_MAX_INTEGRALS = 24 };

#endif

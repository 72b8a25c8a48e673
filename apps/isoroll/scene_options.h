/* scene_options.h - the options that change something in a scene, and the orbit that a scene asks for. */
#ifndef ISOROLL_SCENE_OPTIONS_H
#define ISOROLL_SCENE_OPTIONS_H

#include <math.h>

#include "command.h"

/* A scene's file and what options put in the place of its lines. */
typedef struct scene_options {
    const char *file;
    const char *method;          /* NULL: as the scene says */
    iso_backend backend;         /* -1: as the scene says   */
    iso_models as;               /* likewise                */
    double tolerance, end, step; /* NAN: as the scene says  */
} scene_options;

#define SCENE_OPTIONS_UNSET                                                                                          \
    {                                                                                                                \
        .file = "-", .backend = (iso_backend)-1, .as = (iso_models)-1, .tolerance = NAN, .end = NAN, .step = NAN     \
    }

/* Rows of these; `scene` is the place of a scene_options in the struct `type`. */
#define ROW_BACKEND(type, scene)                                                                                     \
    ROW_OF_WORDS("backend", "B", "ball, point, exact or auto", "what computes the orbit: ball, point, exact, auto",  \
                 set_backend, type, scene.backend, backend_word)
#define ROW_METHOD(type, scene)                                                                                      \
    ROW_OF_WORDS("method", "NAME", "a method of 'isoroll list methods', or auto", "the integrator, or auto",         \
                 set_method, type, scene.method, iso_method_word)
#define ROW_TOLERANCE(type, scene)                                                                                   \
    ROW("tol", "X", "a number in " ISO_TOLERANCE_RANGE,                                                              \
        "largest relative error of one step, in " ISO_TOLERANCE_RANGE, set_tolerance, type, scene.tolerance)
#define ROW_AS(type, scene)                                                                                          \
    ROW_OF_WORDS("as", "WHAT", "ball, point or both", "which model is written: ball, point, both", set_as, type,     \
                 scene.as, as_word)
#define ROW_T_END(type, scene)                                                                                       \
    ROW("t-end", "T", "a number", "last time, in place of the scene's", set_number, type, scene.end)
#define ROW_STEP(type, scene)                                                                                        \
    ROW("step", "DT", "a positive number", "time between rows, in place of the scene's", set_positive, type,         \
        scene.step)

/* Reads the scene and puts the options into it. */
iso_status scene_with_options(iso_context *ctx, const scene_options *o, iso_scene *scene);

/* As finish(), after a failure with the scene: says where in its file the cause stands, unless an option put it
 * there. */
int finish_scene(iso_context *ctx, const scene_options *o, const iso_scene *scene, iso_status status);

/* An axis as typed: 1, 2 or 3 becomes 0 to 2; auto or NULL ISO_AXIS_AUTO. Errors: ISO_BAD_INPUT. */
iso_status read_axis(iso_context *ctx, const char *text, int *axis);

/* Refuses `-o -` beside --json: both write to standard output. output NULL: not given. name: of the command. */
iso_status check_json_alone(iso_context *ctx, const char *name, const char *output, bool json);

/* Prints the effects that act, with their numbers and, if wanted, what they are. Prints nothing where none acts. */
void print_effects(const iso_effects *effects, bool docs);

/* For iso_context_set_monitor: false once the user has asked to stop. */
bool not_interrupted(void *unused);

#endif

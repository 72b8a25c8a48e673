/* scene_options.h - the options that change something in a scene, and the orbit that a scene asks for. */
#ifndef ISOROLL_SCENE_OPTIONS_H
#define ISOROLL_SCENE_OPTIONS_H

#include <math.h>

#include "command.h"
#include "method/methods_impl.h"

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
#define ROW_TOLERANCE(type, scene) ISO_OPTION_TOLERANCE(ISO_TOLERANCE_OF_STEPS, type, scene.tolerance)
#define ROW_AS(type, scene)                                                                                          \
    ISO_OPTION_MODELS("as", "WHAT", "which model is written: ball, point, both", type, scene.as)
#define ROW_T_END(type, scene)                                                                                       \
    ROW("t-end", "T", "a number", "last time, in place of the scene's", iso_set_number, type, scene.end)
#define ROW_STEP(type, scene)                                                                                        \
    ROW("step", "DT", "a positive number", "time between rows, in place of the scene's", iso_set_positive, type,     \
        scene.step)
#define ROWS_OF_SCENE(type, scene)                                                                                   \
    ROW_BACKEND(type, scene), ROW_METHOD(type, scene), ROW_TOLERANCE(type, scene), ROW_AS(type, scene),              \
        ROW_T_END(type, scene), ROW_STEP(type, scene)

/* Reads the scene and puts the options into it. */
iso_status scene_with_options(iso_context *ctx, const scene_options *o, iso_scene *scene);

/* As finish(), after a failure with the scene: says where in its file the cause stands, unless an option put it
 * there. */
int finish_scene(iso_context *ctx, const scene_options *o, const iso_scene *scene, iso_status status);

/* Refuses `-o -` beside --json: both write to standard output. output NULL: not given. name: of the command. */
iso_status check_json_alone(iso_context *ctx, const char *name, const char *output, bool json);

/* The times that `run --times FILE` reads, in the order of the file, as rows of one column; "-" is standard input. The
 * caller frees the record, after an error, too. Errors: ISO_BAD_INPUT with the place, ISO_FILE_TROUBLE,
 * ISO_NO_MEMORY. */
iso_status times_read(iso_context *ctx, const char *path, iso_record **times);

/* Prints the effects that act, with their numbers and, if wanted, what they are. Prints nothing where none acts. */
void print_effects(const iso_effects *effects, bool docs);

#endif

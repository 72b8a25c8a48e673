/* foreign_impl.h - what the files of this folder share: the scene behind its pointer, notes, and kept rows. */
#ifndef ISO_FOREIGN_FOREIGN_IMPL_H
#define ISO_FOREIGN_FOREIGN_IMPL_H

#include "foreign/foreign.h"

struct iso_foreign_scene {
    iso_scene scene;
    char *name;
};

/* The caller's notes; room 0: none. */
typedef struct notes {
    char *text;
    size_t room, used;
} notes;

/* Ends the text at its beginning. */
notes iso_notes_begin(char text[], size_t room);

/* One more line. */
void iso_notes_add(notes *n, const char *words);

/* Puts the place in the scene before a failure (iso_scene_blame). */
iso_status iso_foreign_blame(iso_context *ctx, const iso_foreign_scene *scene, iso_status status);

/* The number of a word in a list of names that NULL ends, NULL being "auto".
 * Errors: ISO_BAD_ARGUMENT about `key`. */
iso_status iso_foreign_word(iso_context *ctx, const char *key, const char *(*name)(int), const char *word,
                            int *number);

/* The number of a word for models to show. */
iso_status iso_foreign_shown(iso_context *ctx, const char *key, const char *word, iso_models *shown);

/* The tolerance of a study, whose options have NAN for the scene's: callers write 0, since a number that went wrong
 * is a NaN. Errors: ISO_BAD_ARGUMENT about "tolerance". */
iso_status iso_foreign_tolerance(iso_context *ctx, double asked, double *tolerance);

/* Refuses what is no count, such as a negative number made a size_t: more than 2^53, which tables could not number.
 * Errors: ISO_BAD_ARGUMENT about `key`. */
iso_status iso_foreign_count(iso_context *ctx, const char *key, size_t count);

/* The params and the start of a scene with another k, J or start (omega, n; or M, gamma). NULL: the scene's own. The
 * eps of a point's scene stays. Errors: those of iso_params_reduced, iso_start_ball, iso_start_point. */
iso_status iso_foreign_replace_params(iso_context *ctx, const iso_scene *scene, const double *k, const double J[3],
                                      iso_params *params);
iso_status iso_foreign_replace_start(iso_context *ctx, const iso_scene *scene, const double start[6],
                                     iso_start *replaced);

#endif

/* interface_impl.h - what the files of this folder share: notes and texts. */
#ifndef ISO_API_INTERFACE_IMPL_H
#define ISO_API_INTERFACE_IMPL_H

#include "api/interface.h"
#include "base/fold_impl.h"
#include "orbit/orbit.h"
#include "orbit/scene.h"

/* The caller's notes; room 0: none. */
typedef struct notes {
    char *text;
    size_t room, used;
} notes;

/* Ends the text at its beginning. */
notes iso_notes_begin(char text[], size_t room);

/* One more line. */
void iso_notes_add(notes *n, const char *words);

/* Copies what was printed into `to`, up to `room` bytes with the end, and closes it; *length: bytes of the whole.
 * Errors: ISO_NO_MEMORY, also where `to` is NULL. */
iso_status iso_text_give(iso_context *ctx, FILE *to, iso_memory *memory, char text[], size_t room, size_t *length);

/* Puts the place in the scene before a failure (iso_scene_blame). */
iso_status iso_blame_scene(iso_context *ctx, const iso_scene *scene, iso_status status);

#endif

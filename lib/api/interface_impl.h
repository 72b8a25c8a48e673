/* foreign_impl.h - what the files of this folder share: the scene behind its pointer, notes, and kept rows. */
#ifndef ISO_API_INTERFACE_IMPL_H
#define ISO_API_INTERFACE_IMPL_H

#include "api/interface.h"
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

/* Puts the place in the scene before a failure (iso_scene_blame). */
iso_status iso_blame_scene(iso_context *ctx, const iso_scene *scene, iso_status status);

#endif

/* scene_literals_impl.h - reads a scene, and keeps its numbers as they are written: doubles are rounded. */
#ifndef ISO_IO_SCENE_LITERALS_IMPL_H
#define ISO_IO_SCENE_LITERALS_IMPL_H

#include "base/literal_impl.h"
#include "io/scene_file.h"

/* As iso_scene_load. The literals have the names of iso_draft_numbers; lists of nine are left out. They are to be
 * cleared, also after an error. */
iso_status iso_scene_read_literals(iso_context *ctx, const char *path, iso_scene *scene, iso_literals *literals);

#endif

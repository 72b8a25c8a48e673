/* scene_draft_impl.h - a scene between its text and its physics: reading keys (scene_keys.c), checking
 * (scene_file.c). */
#ifndef ISO_IO_SCENE_DRAFT_IMPL_H
#define ISO_IO_SCENE_DRAFT_IMPL_H

#include "io/yaml_impl.h"
#include "orbit/scene.h"

/* What the file says, before physics has looked at it. */
typedef struct iso_draft {
    iso_yaml yaml;
    const yaml_node_t *root;
    int surface, backend, as; /* enumerators */
    iso_body body;
    double k, J[3], eps;
    double D; /* NAN: not written */
    double normal[3], angular_velocity[3], gamma[3], M[3];
    bool project;
    iso_scene scene;
} iso_draft;

/* A key of `initial` and the model whose start it states (ISO_SHOW_BOTH: either). */
bool iso_draft_initial_key(int i, const char **name, iso_shown *model);

/* Reads every key under d->root into the draft: types, ranges, unknown, duplicate and missing keys.
 * What must hold between sections is left to the caller. Errors: ISO_BAD_INPUT. */
iso_status iso_draft_read_keys(iso_draft *d);

#endif

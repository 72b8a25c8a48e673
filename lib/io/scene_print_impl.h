/* scene_print_impl.h - a scene as text, the inverse of iso_scene_parse. */
#ifndef ISO_IO_SCENE_PRINT_IMPL_H
#define ISO_IO_SCENE_PRINT_IMPL_H

#include <stdio.h>

#include "orbit/scene.h"

/* Prints the scene as its file would state it; what is as usual is left out. iso_scene_parse reads the text as the same
 * scene to the bit, but for the places in the file. Gravity of a body is printed as the g that the scene was read with.
 */
void iso_scene_print(const iso_scene *scene, FILE *to);

#endif

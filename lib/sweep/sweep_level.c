/* sweep_level.c - a sweep over levels of the energy: `vary: {level: ...}`, the number of study/level.h. */
#include <stdio.h>
#include <string.h>

#include "io/text_impl.h"
#include "sweep/sweep_draft_impl.h"

/* The level sets the length of a point's M, or the number c of a ball's effect `level`. */
bool iso_sweep_find_level(iso_sweep_axis *a)
{
    if (strcmp(a->name, iso_level_name()) != 0) return false;
    a->target = ISO_TO_LEVEL;
    a->width = 1;
    return true;
}

/* A point's eps, or a ball's c, must stand in the scene: so its text can state the level. */
iso_status iso_sweep_check_level(iso_sweep_file *f, const yaml_node_t *key, iso_sweep_axis *a)
{
    iso_draft_number list[ISO_SWEEP_NAMES];
    const bool point = f->base.start.model == ISO_POINT;
    char needed[ISO_NAME_SIZE];
    if (a->target != ISO_TO_LEVEL) return ISO_OK;
    f->level = a;
    snprintf(needed, sizeof needed, point ? "eps" : "%s.c", iso_level_name());
    const int count = iso_draft_numbers(&f->draft, ISO_SWEEP_NAMES, list);
    for (int i = 0; i < count; i++)
        if (strcmp(list[i].name, needed) == 0) a->node = list[i].value;
    if (!a->node)
        return iso_yaml_fail(&f->yaml, key->start_mark, "'level' needs %s in the scene",
                             point ? "'eps'" : "'effects: {level: {c: 1}}', whose c it sets,");
    for (const iso_sweep_axis *b = f->axis; b < f->axis + f->axes; b++)
        if (strcmp(b->name, needed) == 0 && !point)
            return iso_yaml_fail(&f->yaml, key->start_mark, "'level' and '%s' set the same number", needed);
    return ISO_OK;
}

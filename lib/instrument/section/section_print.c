/* section_print.c - what section --area tells people (study/study.h). */
#include <string.h>

#include "instrument/section/section_impl.h"

/* Of each model the orbits by their verdicts, and the orbit that is worst. */
void iso_section_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_section_areas *f = result->found;
    (void)scene, (void)options;
    fprintf(to, "det D - 1 of %s: 0 where %s is kept\n",
            f->returns ? "the map from the start to each return" : "the flow over steps of about a turn",
            f->returns ? "the area dL dl" : "the measure (10)");
    for (int model = ISO_BALL; model <= ISO_POINT; model++) {
        const iso_section_area *worst = NULL;
        size_t count = 0, kept = 0, not_kept = 0;
        for (size_t i = 0; i < f->count; i++) {
            const iso_section_area *a = &f->orbit[i];
            if ((int)a->model != model) continue;
            count++;
            kept += strcmp(a->kept, "kept") == 0;
            not_kept += strcmp(a->kept, "not kept") == 0;
            if (a->turns > 0 && (!worst || a->worst * worst->bound > worst->worst * a->bound)) worst = a;
        }
        if (count == 0) continue;
        fprintf(to, "%s: the area is %s", iso_model_kind_name(model),
                not_kept > 0    ? "not kept"
                : kept == count ? "kept"
                                : "undecided");
        fprintf(to, ": %zu of %zu orbits keep it", kept, count);
        if (worst)
            fprintf(to, "; farthest is orbit %zu, by %.2g, of which errors explain %.2g", worst->orbit, worst->worst,
                    worst->bound);
        fputs("\n", to);
    }
}

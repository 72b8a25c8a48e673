/* section_print.c - the text of section (study/study.h). */
#include <string.h>

#include "instrument/section/section_impl.h"

/* Of each model the orbits by their verdicts, and the orbit that is farthest from keeping it. */
static void print_areas(FILE *to, const iso_section_areas *f)
{
    fprintf(to, "det D - 1 of %s: 0 where %s is kept\n",
            f->returns ? "the map from the start to each return" : "the flow over steps of about a turn",
            f->returns ? "the area dL dl" : "the measure (10)");
    for (int model = ISO_BALL; model <= ISO_POINT; model++) {
        const iso_section_area *farthest = NULL;
        size_t count = 0, kept = 0, not_kept = 0;
        for (size_t i = 0; i < f->count; i++) {
            const iso_section_area *a = &f->orbit[i];
            if ((int)a->model != model) continue;
            count++;
            kept += strcmp(a->kept, "kept") == 0;
            not_kept += strcmp(a->kept, "not kept") == 0;
            if (a->turns > 0 && (!farthest || a->worst * farthest->bound > farthest->worst * a->bound)) farthest = a;
        }
        if (count == 0) continue;
        fprintf(to, "%s: the area is %s", iso_model_kind_name(model),
                not_kept > 0    ? "not kept"
                : kept == count ? "kept"
                                : "undecided");
        fprintf(to, ": %zu of %zu orbits keep it", kept, count);
        if (farthest)
            fprintf(to, "; farthest is orbit %zu, by %.2g, of which errors explain %.2g", farthest->orbit,
                    farthest->worst, farthest->bound);
        fputs("\n", to);
    }
}

void iso_section_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_section_result *r = result->found;
    (void)scene;
    if (((const iso_section_request *)options)->area) {
        print_areas(to, result->found);
        return;
    }
    fprintf(to, "%zu orbit%s, %zu crossings written\n", r->orbits, r->orbits == 1 ? "" : "s", r->rows);
    if (r->nature.global) fprintf(to, "%s\n", r->nature.words);
    if (r->models != ISO_SHOW_BOTH) return;
    if (r->crossings[ISO_BALL] == r->crossings[ISO_POINT] && r->unequal == 0)
        fprintf(to, "ball and point, each by itself: %zu crossings both\n", r->crossings[ISO_BALL]);
    else
        fprintf(to, "ball and point, each by itself: %zu and %zu crossings; %zu orbits have different numbers\n",
                r->crossings[ISO_BALL], r->crossings[ISO_POINT], r->unequal);
    if (r->distance > 0)
        fprintf(to, "largest distance of the two%s, where they do not part: %.2g, at orbit %zu, crossing %zu\n",
                r->nature.axis < 0 ? " in t, by the mean time between crossings" : " in (l, x)", r->distance,
                r->distance_orbit, r->distance_crossing);
    if (r->parted > 0)
        fprintf(to,
                "%zu of %zu orbits part (distance above %g): their rounding errors grow, as on chaotic orbits; the "
                "first is orbit %zu, at crossing %zu\n",
                r->parted, r->orbits, ISO_SECTION_PARTED, r->parted_orbit, r->parted_crossing);
}

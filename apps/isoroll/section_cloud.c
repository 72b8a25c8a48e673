/* section_cloud.c - `isoroll section --cloud N`: clouds of states are drawn by the invariant measure (10), carried by
 * the flow and by returns to a section, and then tested against the measure (study/section/measure.h). */
#include "section_cloud.h"

#include <math.h>
#include <stdio.h>

#include "study/section/measure.h"

static iso_measure_options options_of(const iso_section_options *how, double count)
{
    iso_measure_options m = iso_measure_defaults();
    m.count = (size_t)count;
    m.seed = (unsigned long)how->seed + 1;
    m.axis = how->axis;
    m.threads = how->threads;
    if (!isnan(how->tolerance)) m.tolerance = how->tolerance;
    m.progress = progress_told;
    return m;
}

/* One line about a cloud. */
static void print_cloud(const char *what, const iso_measure *m)
{
    const iso_measure_entry *worst = &m->line[m->worst];
    if (m->lost > 0) {
        printf("%-10s not kept: at least %zu of %zu orbits do not return\n", what, m->lost, m->count);
        return;
    }
    printf("%-10s %-9s p = %-8.2g  %s at %.6g is off by %.2g standard errors", what, m->kept ? "kept" : "not kept",
           m->p, worst->name, worst->time, fabs(worst->deviation));
    if (isfinite(m->resolution)) printf("; an exponent wrong by %.2g %% would be detected", 100 * m->resolution);
    printf("\n");
}

/* One test; clock NULL: of the returns. A test that this scene cannot have is left out, with the reason. */
static iso_status test(iso_context *ctx, const iso_scene *scene, iso_measure_options m, const iso_clock *clock,
                       bool *kept)
{
    iso_measure found;
    const char *what = !clock ? "returns" : *clock == ISO_CLOCK_T ? "flow in t" : "flow in s";
    if (clock) m.clock = *clock;
    progress_begin();
    const iso_status status = (clock ? iso_measure_flow : iso_measure_returns)(ctx, scene, &m, &found);
    progress_end();
    if ((status == ISO_NOT_MAPPED && !(clock && *clock == ISO_CLOCK_T)) || (status == ISO_BAD_INPUT && !clock)) {
        printf("%-10s not tried: %s\n", what, iso_context_message(ctx));
        return ISO_OK;
    }
    if (status != ISO_OK) return status;
    *kept = *kept && found.kept;
    print_cloud(what, &found);
    return ISO_OK;
}

int section_cloud(iso_context *ctx, const scene_options *o, const iso_scene *scene, const iso_section_options *how,
                  double count)
{
    const iso_measure_options m = options_of(how, count);
    bool kept = true;
    begin_work(ctx, NULL);
    iso_status status = test(ctx, scene, m, &(iso_clock){ISO_CLOCK_T}, &kept);
    if (status == ISO_OK) status = test(ctx, scene, m, &(iso_clock){ISO_CLOCK_S}, &kept);
    if (status == ISO_OK) status = test(ctx, scene, m, NULL, &kept);
    const int result = finish_scene(ctx, o, scene, status);
    return result == EXIT_DONE && !kept ? EXIT_SOME_FAILED : result;
}

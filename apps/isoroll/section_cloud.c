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
    progress_end();
    if (m->lost > 0) {
        printf("%-10s not kept: at least %zu of %zu orbits do not return\n", what, m->lost, m->count);
        return;
    }
    printf("%-10s %-9s p = %-8.2g  %s at %.6g is off by %.2g standard errors", what, m->kept ? "kept" : "not kept",
           m->p, worst->name, worst->time, fabs(worst->deviation));
    if (isfinite(m->resolution)) printf("; an exponent wrong by %.2g %% would be detected", 100 * m->resolution);
    printf("\n");
}

/* Says why a test is left out that this scene cannot have. */
static iso_status left_out(iso_context *ctx, const char *what)
{
    progress_end();
    printf("%-10s not tried: %s\n", what, iso_context_message(ctx));
    return ISO_OK;
}

static iso_status flow(iso_context *ctx, const iso_scene *scene, iso_measure_options m, iso_clock clock, bool *kept)
{
    iso_measure found;
    m.clock = clock;
    progress_begin();
    const char *what = clock == ISO_CLOCK_T ? "flow in t" : "flow in s";
    const iso_status status = iso_measure_flow(ctx, scene, &m, &found);
    if (status == ISO_NOT_MAPPED && clock == ISO_CLOCK_S) return left_out(ctx, what);
    if (status != ISO_OK) return status;
    *kept = *kept && found.kept;
    print_cloud(what, &found);
    return ISO_OK;
}

static iso_status returns(iso_context *ctx, const iso_scene *scene, const iso_measure_options *m, bool *kept)
{
    iso_measure found;
    progress_begin();
    const iso_status status = iso_measure_returns(ctx, scene, m, &found);
    if (status == ISO_NOT_MAPPED || status == ISO_BAD_INPUT) return left_out(ctx, "returns");
    if (status != ISO_OK) return status;
    *kept = *kept && found.kept;
    print_cloud("returns", &found);
    return ISO_OK;
}

int section_cloud(iso_context *ctx, const scene_options *o, const iso_scene *scene, const iso_section_options *how,
                  double count)
{
    const iso_measure_options m = options_of(how, count);
    bool kept = true;
    begin_work(ctx, NULL);
    iso_status status = flow(ctx, scene, m, ISO_CLOCK_T, &kept);
    if (status == ISO_OK) status = flow(ctx, scene, m, ISO_CLOCK_S, &kept);
    if (status == ISO_OK) status = returns(ctx, scene, &m, &kept);
    const int result = finish_scene(ctx, o, scene, status);
    return result == EXIT_DONE && !kept ? EXIT_SOME_FAILED : result;
}

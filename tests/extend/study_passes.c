/* study_passes.c - the study `passes`: how often orbits of a scene pass n3 = 0 upwards until its end. */
#include <stdlib.h>

#include "orbit/walk_impl.h"
#include "study/fields_impl.h"
#include "study/options_impl.h"

typedef struct request {
    size_t starts;
} request;
typedef struct passes {
    double orbit, count, time, end; /* time: of the last one */
} passes;
static const iso_field fields[] = {ISO_MEMBER(passes, "orbit", orbit, "", "its number; 0 is the scene's own"),
                                   ISO_MEMBER(passes, "count", count, "", "passes"), ISO_FIELD_END};
static size_t wanted(void *user, size_t i)
{
    return ((const passes *)user)[i].time < ((const passes *)user)[i].end ? 16 : 0;
}

static iso_status visit(void *user, size_t i, const iso_walk_stop *stop)
{
    passes *p = (passes *)user + i;
    p->time = stop->crossing[0]->clock[ISO_CLOCK_T];
    p->count += p->time <= p->end;
    return ISO_OK;
}

static iso_status run(iso_context *ctx, const iso_study_subject *of, const void *options, iso_study_result *result)
{
    const size_t count = 1 + ((const request *)options)->starts;
    iso_effects effects = iso_scene_acting(of->scene);
    iso_orbit_options o = iso_orbit_defaults(&of->scene->start);
    iso_starts starts = {.scene = of->scene, .effects = &effects, .axis = 2, .spread = count - 1};
    iso_walk walk = {.ctx = ctx, .count = count, .most = 1000000, .models = 1, .starts = &starts};
    passes *found = walk.user = calloc(count, sizeof *found);
    walk.options[0] = iso_crossings_defaults();
    walk.options[0].axis = starts.axis, walk.wanted = wanted, walk.visit = visit, o.effects = &effects;
    iso_status status = found ? ISO_OK : iso_context_no_memory(ctx, "passes");
    if (found) status = iso_orbit_create(ctx, &of->scene->params, &of->scene->start, &o, &starts.orbit);
    for (size_t i = 0; found && i < count; i++) found[i] = (passes){.orbit = (double)i, .end = of->scene->end};
    if (status == ISO_OK) iso_starts_prepare(&starts), status = iso_walk_go(&walk);
    if (walk.failed > 0) iso_study_note(result, "%zu orbits failed; %s", walk.failed, walk.text);
    if (status == ISO_OK) status = iso_columns_create(ctx, fields, &result->table[0]);
    for (size_t i = 0; status == ISO_OK && i < count; i++)
        status = iso_columns_append(ctx, fields, &found[i], result->table[0]);
    iso_orbit_free(starts.orbit);
    free(found);
    return status;
}
ISO_STUDY_BEGIN(request, (request){.starts = 0})
const iso_option iso_passes_option[] = {
    ISO_OPTION("starts", "M", "a whole number", "more orbits", iso_set_whole_size, request, starts), ISO_OPTION_END};
const iso_study iso_passes_study = {.name = "passes",
                                    .doc = "count how often orbits pass n3 = 0",
                                    .options = iso_passes_option,
                                    .size = sizeof(request),
                                    .begin = begin,
                                    .run = run,
                                    .of = ISO_STUDY_OF_SCENE};

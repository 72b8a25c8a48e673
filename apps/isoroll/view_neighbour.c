/* view_neighbour.c - whether an orbit of the page is chaotic, and a second one that begins beside it (see view.h).
 *
 * The neighbour begins where omega (of a point: M) is turned about n (gamma) by VIEW_BESIDE radians: so (omega,n) = 0
 * stays. Both orbits are computed here, by the same equations. The distance is that of (omega/|omega at the start|, n).
 */
#include <math.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "study/chaos/chaos.h"
#include "view.h"

/* After so many turns an orbit without a verdict stays undecided, and an exponent is good enough for the page. */
enum { TURNS = 1000 };

/* --- the verdict ------------------------------------------------------------------------------------------------ */

/* Only memory and a stop end the page. A study that refuses an orbit, such as one that loses energy, has no verdict. */
static bool is_fatal(iso_status status)
{
    return status == ISO_NO_MEMORY || status == ISO_STOPPED;
}

/* Runs the study of chaos for the orbit from `start`, and for the starts that `o` has on its section. */
static iso_status judge(iso_context *ctx, const view_page *page, const iso_start *start, const iso_effects *effects,
                        iso_chaos_options *o, iso_chaos **chaos)
{
    iso_scene scene = iso_scene_default();
    scene.params = page->params;
    scene.start = *start;
    scene.effects = *effects;
    scene.effects = iso_scene_acting(&scene);
    scene.end = 1;
    o->turns = TURNS;
    o->models = ISO_SHOW_BALL;
    return iso_chaos_run(ctx, &scene, o, chaos);
}

static view_fate fate_of(const iso_chaos_orbit *orbit)
{
    return (view_fate){true, orbit->verdict, orbit->result[ISO_BALL].exponent[ISO_CLOCK_T]};
}

iso_status view_judge_section(iso_context *ctx, view_page *page, const iso_start *start, const iso_effects *effects,
                              const double (*at)[2])
{
    view_section *s = page->section;
    iso_chaos *chaos = NULL;
    iso_chaos_options o = iso_chaos_defaults();
    o.at = at;
    o.at_count = s->count;
    o.axis = s->axis;
    const iso_status status = judge(ctx, page, start, effects, &o, &chaos);
    if (status == ISO_OK)
        for (size_t i = 0; i < s->count && i < chaos->starts; i++) s->fate[i] = fate_of(&chaos->start[i]);
    else if (!is_fatal(status))
        view_note(page, "Which orbits are chaotic is not known: %s.", iso_context_message(ctx));
    iso_chaos_free(chaos);
    return is_fatal(status) ? status : ISO_OK;
}

/* --- the neighbour ---------------------------------------------------------------------------------------------- */

static iso_start beside(const iso_start *start)
{
    iso_start other = *start;
    double turned[3];
    cross(start->y + 3, start->y, turned);
    for (int i = 0; i < 3; i++) other.y[i] += VIEW_BESIDE * turned[i];
    return other;
}

static iso_status open_orbit(iso_context *ctx, const view_page *page, const iso_start *start,
                             const iso_effects *effects, iso_orbit **orbit)
{
    iso_orbit_options o = iso_orbit_defaults(start);
    o.effects = effects;
    o.backend = ISO_BACKEND_BALL;
    o.clock = ISO_CLOCK_T;
    o.shown = *page->alone ? ISO_SHOW_BALL : ISO_SHOW_BOTH;
    return iso_orbit_create(ctx, &page->params, start, &o, orbit);
}

static double distance(const iso_sample *a, const iso_sample *b, double speed)
{
    return hypot(view_distance(a->ball, b->ball) / speed, view_distance(a->ball + 3, b->ball + 3));
}

static iso_status follow(iso_context *ctx, const view_page *page, iso_orbit *orbit, iso_orbit *other,
                         const iso_record *rows, iso_record *to)
{
    const int t = iso_record_find(rows, "t");
    double speed = NAN;
    for (size_t i = 0; i < iso_record_rows(rows); i++) {
        iso_sample here, there;
        const double since = iso_record_const_row(rows, i)[t] - iso_record_const_row(rows, 0)[t];
        ISO_TRY(iso_orbit_at(orbit, since, &here));
        ISO_TRY(iso_orbit_at(other, since, &there));
        if (i == 0) speed = view_distance(here.ball, (double[]){0, 0, 0}); /* its square need not fit a double */
        const double *seen = (*page->alone ? there.ball : there.point) + 3;
        ISO_TRY(iso_record_add(ctx, to, 1, (double[]){seen[0], seen[1], seen[2], distance(&here, &there, speed)}));
    }
    return ISO_OK;
}

static iso_status run_beside(iso_context *ctx, const view_page *page, const iso_start *start,
                             const iso_effects *effects, const iso_record *rows, iso_record *to)
{
    iso_orbit *orbit = NULL, *other = NULL;
    const iso_start second = beside(start);
    iso_status status = open_orbit(ctx, page, start, effects, &orbit);
    if (status == ISO_OK) status = open_orbit(ctx, page, &second, effects, &other);
    if (status == ISO_OK) status = follow(ctx, page, orbit, other, rows, to);
    iso_orbit_free(orbit);
    iso_orbit_free(other);
    return status;
}

iso_status view_neighbour(iso_context *ctx, const view_page *page, const iso_start *start, const iso_effects *effects,
                          const iso_record *rows, iso_record **beside_it)
{
    static const char *const names[] = {"near1", "near2", "near3", "near"};
    *beside_it = NULL;
    if (largest(start->y) == 0) return ISO_OK; /* there is no omega to turn */
    ISO_TRY(iso_record_create(ctx, 4, names, beside_it));
    const iso_status status = run_beside(ctx, page, start, effects, rows, *beside_it);
    if (status == ISO_OK) return ISO_OK;
    iso_record_free(*beside_it);
    *beside_it = NULL;
    return is_fatal(status) ? status : ISO_OK;
}

iso_status view_neighbour_of_rows(iso_context *ctx, view_page *page)
{
    iso_start start;
    iso_effects effects = page->effects;
    iso_chaos *chaos = NULL;
    iso_chaos_options o = iso_chaos_defaults();
    if (page->no_orbit) return ISO_OK;
    iso_status status = iso_record_start(ctx, page->rows, &page->params, ISO_BALL, 0, &start, &effects);
    if (status != ISO_OK) return is_fatal(status) ? status : ISO_OK; /* at rest, ... */
    o.exponent_turns = TURNS;
    status = judge(ctx, page, &start, &effects, &o, &chaos);
    if (status == ISO_OK) page->fate = fate_of(&chaos->own);
    iso_chaos_free(chaos);
    if (is_fatal(status)) return status;
    return view_neighbour(ctx, page, &start, &effects, page->rows, &page->beside);
}

/* section.c - the Poincare section of a scene, see section.h: what kind of section it is, and what is
 * refused. */
#include "instrument/section/section.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/math_impl.h"
#include "instrument/section/section_impl.h"
#include "map/section_impl.h"
#include "model/model_impl.h"
#include "orbit/crossings_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"

/* --- which section is global ------------------------------------------------------------------------------------ */

/* Which orbits cross, on which level, and how long a return takes. */
static void name_global(const iso_orbit *orbit, iso_section_nature *n)
{
    const iso_units *units = iso_orbit_units(orbit);
    const iso_point_motion m = iso_orbit_motion(orbit);
    const double turn = 2 * ISO_PI * iso_unit(units, iso_clock_dimension(ISO_CLOCK_S));
    const double unit_M = iso_unit(units, iso_system_point.fast_dimension);
    char level[40] = "", except[40], longest[32] = "or more", returns[80];
    double W[2];
    iso_section_bounds(m, n->axis, W);
    if (W[0] > 0) snprintf(longest, sizeof longest, "to %.4g", turn / W[0]);
    snprintf(except, sizeof except, "the rotation about axis %d", n->axis + 1);
    if (m.energy != 0) {
        snprintf(level, sizeof level, " on the level H = %.4g", m.energy * unit_M * unit_M);
        snprintf(except, sizeof except, "those in its plane");
    }
    if (iso_params_powers_fit(m.p))
        snprintf(returns, sizeof returns, "a return takes %.4g %s in s", turn / W[1], longest);
    else
        snprintf(returns, sizeof returns, "k is so near 0 that s of a return need not fit a double");
    snprintf(n->words, sizeof n->words, "n_%d = 0 is global%s: every orbit crosses it again and again, except %s; %s",
             n->axis + 1, level, except, returns);
}

iso_section_nature iso_section_of(const iso_orbit *orbit, int axis)
{
    const iso_effects effects = iso_orbit_effects(orbit);
    const iso_effect *effect = iso_effects_beyond_level(&effects);
    const iso_point_motion m = iso_orbit_motion(orbit);
    const int good = iso_section_axis(m);
    iso_section_nature n = {.axis = axis == ISO_AXIS_AUTO ? good : axis};
    n.global = !effect && iso_section_is_global(m, n.axis);
    if (n.global)
        name_global(orbit, &n);
    else if (effect)
        snprintf(n.words, sizeof n.words, "n_%d = 0 is not known to be global: '%s' acts on the ball", n.axis + 1,
                 effect->name);
    else
        snprintf(n.words, sizeof n.words, "n_%d = 0 is not global: orbits can stay away from it; n_%d = 0 is global",
                 n.axis + 1, good + 1);
    return n;
}

bool iso_section_is_of_axis(int column, double value, int *axis)
{
    for (int a = 0; a < 3 && value == 0; a++)
        if (column == ISO_COLUMN_BALL + 3 + a || column == ISO_COLUMN_POINT + 3 + a) return *axis = a, true;
    return false;
}

/* --- what is asked for ------------------------------------------------------------------------------------------ */

/* Checks the options, and chooses effects and models. Observers cost time. They stay only where the column of an effect
 * is used: one of them may need another. */
static iso_status check(iso_section_walk *w)
{
    iso_section_options *o = &w->options;
    const iso_effects *e = &w->effects;
    if (o->crossings == 0) return ISO_FAIL_ARGUMENT(w->ctx, "crossings", "no crossing is asked for");
    if (iso_crossings_check_axis(w->ctx, o->axis) != ISO_OK) return ISO_BAD_ARGUMENT;
    if (isnan(o->tolerance)) o->tolerance = w->scene->tolerance;
    if (iso_section_is_of_axis(o->column, o->value, &o->axis)) o->column = -1;
    w->chart = o->column < 0;
    const bool of_effect = o->column >= ISO_COLUMN_EFFECTS && o->column < iso_columns_count();
    w->effects = of_effect ? iso_scene_effects(w->scene) : iso_scene_acting(w->scene);
    const iso_effect *breaking = iso_effects_breaking(e);
    iso_models models = o->models;
    if (models == ISO_SHOW_START) models = breaking || iso_effects_ball_only(e) ? ISO_SHOW_BALL : ISO_SHOW_BOTH;
    w->result->models = models;
    w->models = models == ISO_SHOW_BOTH ? 2 : 1;
    w->model[0] = models == ISO_SHOW_POINT ? ISO_POINT : ISO_BALL;
    w->model[1] = ISO_POINT;
    if (breaking && (o->shown == ISO_SHOW_POINT || o->shown == ISO_SHOW_BOTH))
        return iso_orbit_no_point(w->ctx, breaking);
    w->result->orbits = 1 + o->starts + o->at_count;
    ISO_TRY(iso_refuse_rest(w->ctx, &w->scene->start, e, ISO_NO_RETURN));
    if (!of_effect || w->scene->effects.on[iso_column_effect(o->column)]) return ISO_OK;
    return ISO_FAIL_INPUT(w->ctx, "columns", "column '%s' needs the effect '%s'", iso_column_name(o->column),
                          iso_effect_list[iso_column_effect(o->column)]->name);
}

/* The scene's own orbit, with all clocks if their numbers fit a double. */
static iso_status open_orbit(iso_section_walk *w)
{
    iso_orbit_options o = iso_orbit_defaults(&w->scene->start);
    const bool mapped = !iso_effects_breaking(&w->effects);
    o.effects = &w->effects;
    o.backend = (iso_backend)w->model[0];
    o.clock = w->model[0] == ISO_POINT ? ISO_CLOCK_S : ISO_CLOCK_T;
    o.shown = w->models == 2 ? ISO_SHOW_BOTH : (iso_models)w->model[0];
    o.tolerance = w->options.tolerance;
    o.memory = 0; /* it only goes on */
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = mapped;
    iso_status status = iso_orbit_create(w->ctx, &w->scene->params, &w->scene->start, &o, &w->orbit);
    w->clocks = status == ISO_OK && iso_orbit_has_twin(w->orbit);
    if (status != ISO_NUMERICAL || !mapped || w->models == 2) return status;
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = false;
    return iso_orbit_create(w->ctx, &w->scene->params, &w->scene->start, &o, &w->orbit);
}

/* --- the whole -------------------------------------------------------------------------------------------------- */

bool iso_section_has_returns(const iso_section_walk *w)
{
    const iso_effects effects = iso_orbit_effects(w->orbit);
    return iso_effects_are_free(&effects) && w->clocks &&
           iso_section_is_global(iso_orbit_motion(w->orbit), w->options.axis);
}

iso_status iso_section_begin(iso_section_walk *w, iso_context *ctx, const iso_scene *scene,
                             const iso_section_options *options)
{
    iso_section_options *o = &w->options;
    w->ctx = ctx;
    w->scene = scene;
    *o = options ? *options : iso_section_defaults();
    *w->result = (iso_section_result){.nature = {.axis = -1}};
    ISO_TRY(check(w));
    ISO_TRY(open_orbit(w));
    if (!w->areas) ISO_TRY(iso_refuse_losses(ctx, w->orbit, ISO_NO_RETURN));
    if (o->axis == ISO_AXIS_AUTO) o->axis = iso_section_axis(iso_orbit_motion(w->orbit));
    if (o->starts + o->at_count > 0 && !w->chart)
        return ISO_FAIL_INPUT(ctx, "starts", "no other starts can be given here: an event has no chart");
    if (o->starts + o->at_count > 0)
        ISO_TRY(iso_refuse_starts(ctx, w->orbit, &w->effects, o->axis, o->at, o->at_count, o->starts > 0));
    /* the states shown; with those of the ball, the columns of its effects */
    const bool both = o->shown == ISO_SHOW_BOTH, ball = both || o->shown == ISO_SHOW_BALL;
    for (int c = ISO_COLUMN_BALL; c < iso_columns_count(); c++) {
        const iso_effect_id effect = iso_column_effect(c);
        if (c < ISO_COLUMN_POINT     ? ball
            : c < ISO_COLUMN_EFFECTS ? both || o->shown == ISO_SHOW_POINT
                                     : ball && effect < ISO_EFFECTS && w->effects.on[effect])
            w->columns[w->count++] = c;
    }
    w->starts = (iso_starts){.scene = scene,
                             .orbit = w->orbit,
                             .effects = &w->effects,
                             .axis = o->axis,
                             .spread = o->starts,
                             .seed = o->seed,
                             .at = o->at};
    iso_starts_prepare(&w->starts);
    for (int m = 0; m < w->models; m++) ISO_TRY(iso_crossings_check(ctx, &iso_section_plan(w, m).options[0]));
    return ISO_OK;
}

iso_status iso_section_run(iso_context *ctx, const iso_scene *scene, const iso_section_options *options,
                           const iso_sink *sink, iso_record *tables[2], iso_section_result *result)
{
    ISO_DEFAULT_ARITHMETIC;
    iso_section_result unused;
    iso_section_walk w = {.sink = sink, .tables = tables, .result = result ? result : &unused};
    iso_section_nature *n = &w.result->nature;
    iso_status status = iso_section_begin(&w, ctx, scene, options);
    if (status == ISO_OK) {
        *n = w.chart ? iso_section_of(w.orbit, w.options.axis)
                     : (iso_section_nature){.axis = -1, .words = "an event is not known to be a global section"};
        if (!n->global && sink->note) sink->note(sink->data, n->words);
        status = iso_section_walk_all(&w);
    }
    iso_orbit_free(w.orbit);
    if (status == ISO_OK && w.result->rows == 0 && w.result->failed > 0)
        return iso_context_fail(ctx, w.result->failure, "", "%s", w.result->words);
    return status;
}

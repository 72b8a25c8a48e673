/* scene.c - what a scene asks for: columns and models by their names, starts, and times. */
#include "orbit/orbit_impl.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/context_impl.h"
#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "map/section_impl.h"
#include "model/model_impl.h"

/* --- columns ---------------------------------------------------------------------------------------------------- */

int iso_columns_count(void)
{
    const int effects = iso_effect_columns();
    return ISO_COLUMN_EFFECTS + (effects < ISO_EFFECT_COLUMNS ? effects : ISO_EFFECT_COLUMNS);
}

const char *iso_column_name(int c)
{
    if (c < 0 || c >= iso_columns_count()) return NULL;
    if (c < ISO_COLUMN_BALL) return iso_clock_name((iso_clock)c);
    if (c < ISO_COLUMN_POINT) return iso_system_ball.state[c - ISO_COLUMN_BALL];
    if (c < ISO_COLUMN_EFFECTS) return iso_system_point.state[c - ISO_COLUMN_POINT];
    return iso_effect_column_name(c - ISO_COLUMN_EFFECTS, NULL, NULL, NULL);
}

const char *iso_column_doc(int c, const char **unit)
{
    static const struct {
        int first;
        const char *unit, *doc;
    } vectors[] = {{ISO_COLUMN_EFFECTS - 3, "", "place of the point on the unit sphere"},
                   {ISO_COLUMN_POINT, "1/time", "momentum of the point, gamma' x gamma, by its clock s"},
                   {ISO_COLUMN_POINT - 3, "", "unit normal at the contact, in the ball's axes"},
                   {ISO_COLUMN_BALL, "1/time", "angular velocity, in the ball's principal axes"},
                   {ISO_CLOCK_S, "time", "the time of the point"},
                   {ISO_CLOCK_TAU, "time", "the time in which the ball is Hamiltonian"},
                   {ISO_CLOCK_T, "time", "the time of the ball"}};
    const iso_effect_column *group = NULL;
    int i = 0;
    *unit = NULL;
    if (c < 0 || c >= iso_columns_count()) return NULL;
    if (c >= ISO_COLUMN_EFFECTS) {
        iso_effect_column_name(c - ISO_COLUMN_EFFECTS, NULL, &group, NULL);
        return *unit = group->unit, group->doc;
    }
    while (c < vectors[i].first) i++;
    return *unit = vectors[i].unit, vectors[i].doc;
}

int iso_column_names(const char *names[ISO_TRAJECTORY_COLUMNS])
{
    const int count = iso_columns_count();
    for (int c = 0; c < count; c++) names[c] = iso_column_name(c);
    return count;
}

int iso_column_find(const char *name)
{
    const int count = iso_columns_count();
    int c = 0;
    while (c < count && strcmp(iso_column_name(c), name) != 0) c++;
    return c < count ? c : -1;
}

iso_effect_id iso_column_effect(int column)
{
    iso_effect_id effect = ISO_EFFECTS;
    if (column >= ISO_COLUMN_EFFECTS) iso_effect_column_name(column - ISO_COLUMN_EFFECTS, &effect, NULL, NULL);
    return effect;
}

/* --- starts ----------------------------------------------------------------------------------------------------- */

ISO_NAMES(iso_model_kind_name, int, "ball", "point")
ISO_NAMES(iso_backend_name, int, "ball", "point", "auto", "exact")
ISO_NAMES(iso_models_name, int, "ball", "point", "both", "auto")

/* What is a unit vector, or orthogonal, to this, stays as it is. Both corrections leave less than it, so that what was
 * read once, printed and read again is the same to the bit. */
#define ROUNDING (8 * DBL_EPSILON)

/* A unit vector and a vector orthogonal to it, from numbers typed by hand. */
static iso_status check_pair(iso_context *ctx, const char *unit_name, const char *vector_name, iso_spin spin,
                             double unit[3], double vector[3])
{
    for (int i = 0; i < 3; i++) {
        if (!isfinite(unit[i])) return ISO_FAIL_INPUT(ctx, unit_name, "%s is not finite", unit_name);
        if (!isfinite(vector[i])) return ISO_FAIL_INPUT(ctx, vector_name, "%s is not finite", vector_name);
    }
    const double length = hypot(hypot(unit[0], unit[1]), unit[2]);
    if (length == 0) return ISO_FAIL_INPUT(ctx, unit_name, "%s is zero, it must be a unit vector", unit_name);
    if (!(fabs(length - 1) <= 1e-6))
        return ISO_FAIL_INPUT(ctx, unit_name,
                              "%s has length %.10g, it must be a unit vector (to 1e-6): write [%.10g, %.10g, %.10g]",
                              unit_name, length, unit[0] / length, unit[1] / length, unit[2] / length);
    if (fabs(dot(unit, unit) - 1) > ROUNDING) make_unit(unit);
    const double most = largest(vector);
    if (most == 0) return ISO_OK;
    if (!isnormal(most))
        return ISO_FAIL_INPUT(ctx, vector_name,
                              "%s = %s is too small for a double to hold its digits: use a longer unit of time",
                              vector_name, ISO_SHORT(most));
    if (spin == ISO_SPIN_KEEP) return ISO_OK;
    const double size = ldexp(1, ilogb(most)); /* a power of two: dividing by it rounds nothing */
    double v[3] = {vector[0] / size, vector[1] / size, vector[2] / size}; /* no overflow in the products */
    if (fabs(dot(v, unit)) <= ROUNDING / 2 * norm(v)) return ISO_OK;
    const double along = remove_along(v, unit);
    if (spin == ISO_SPIN_REFUSE && fabs(along) > 1e-9 * hypot(norm(v), along))
        return ISO_FAIL_INPUT(ctx, vector_name,
                              "%s has a part %.6g along %s, it must be orthogonal to it (to 1e-9): write [%s, "
                              "%s, %s], or 'project: true'",
                              vector_name, along * size, unit_name, ISO_SHORT(v[0] * size), ISO_SHORT(v[1] * size),
                              ISO_SHORT(v[2] * size));
    remove_along(v, unit);
    for (int i = 0; i < 3; i++) vector[i] = v[i] * size;
    return ISO_OK;
}

iso_status iso_start_ball(iso_context *ctx, const double omega[3], const double normal[3], iso_spin spin,
                          iso_start *start)
{
    ISO_DEFAULT_ARITHMETIC;
    *start = (iso_start){.model = ISO_BALL};
    copy(omega, start->y, 3);
    copy(normal, start->y + 3, 3);
    return check_pair(ctx, "normal", "angular_velocity", spin, start->y + 3, start->y);
}

iso_status iso_start_point(iso_context *ctx, const double M[3], const double gamma[3], const double *eps,
                           bool project, iso_start *start)
{
    ISO_DEFAULT_ARITHMETIC;
    *start = (iso_start){.model = ISO_POINT, .eps = eps ? *eps : NAN};
    copy(M, start->y, 3);
    copy(gamma, start->y + 3, 3);
    if (eps && !isfinite(*eps))
        return ISO_FAIL_INPUT(ctx, "eps", "eps = %s: the coupling must be finite", ISO_SHORT(*eps));
    return check_pair(ctx, "gamma", "M", project ? ISO_SPIN_REMOVE : ISO_SPIN_REFUSE, start->y + 3, start->y);
}

iso_status iso_scene_replaced(iso_context *ctx, const iso_scene *s, const double *k, const double J[3],
                              const double y[6], iso_params *params, iso_start *start)
{
    *params = s->params;
    *start = s->start;
    if (k || J) ISO_TRY(iso_params_reduced(ctx, k ? *k : s->params.k, J ? J : s->params.J, params));
    if ((k || J) && s->params.D > 0) ISO_TRY(iso_params_set_D(ctx, s->params.D, params));
    if (!y) return ISO_OK;
    if (s->start.model == ISO_BALL)
        return iso_start_ball(ctx, y, y + 3, s->effects.on[ISO_TWIST] ? ISO_SPIN_KEEP : ISO_SPIN_REFUSE, start);
    return iso_start_point(ctx, y, y + 3, isnan(s->start.eps) ? NULL : &s->start.eps, false, start);
}

/* n = J^(1/2) gamma, as a unit vector (18) */
void iso_start_normal(const iso_params *p, const iso_start *start, double n[3])
{
    copy(start->y + 3, n, 3);
    if (start->model != ISO_POINT) return;
    for (int i = 0; i < 3; i++) n[i] *= sqrt(p->J[i]);
    make_unit(n);
}

void iso_start_settle(const iso_params *p, const iso_start *start, iso_effects *effects)
{
    double n[3];
    iso_start_normal(p, start, n);
    iso_effects_settle(p, n, effects);
}

iso_effects iso_scene_effects(const iso_scene *scene)
{
    iso_effects effects = scene->effects;
    iso_start_settle(&scene->params, &scene->start, &effects);
    return effects;
}

iso_effects iso_scene_acting(const iso_scene *scene)
{
    const iso_effects effects = iso_scene_effects(scene);
    return iso_effects_acting(&effects);
}

iso_scene iso_scene_default(void)
{
    return (iso_scene){.effects = iso_effects_default(),
                       .backend = ISO_BACKEND_AUTO,
                       .method = "auto",
                       .tolerance = 1e-12,
                       .as = ISO_SHOW_START};
}

enum { USUAL_STEPS = 100 };

/* A time grid that misses the end by rounding alone ends there; one that goes anywhere has a step. */
static double steps_to_end(const iso_scene *scene)
{
    if (scene->end == 0) return 0;
    return scene->step > 0 ? fmax(fabs(scene->end) / scene->step, 1) : USUAL_STEPS;
}

iso_status iso_scene_check_times(iso_context *ctx, const iso_scene *scene)
{
    if (!isfinite(scene->end)) return ISO_FAIL_ARGUMENT(ctx, "end", "the last time is not finite");
    if (!(scene->step >= 0 && isfinite(scene->step)))
        return ISO_FAIL_ARGUMENT(ctx, "step", "a step of %s is none", ISO_SHORT(scene->step));
    if (steps_to_end(scene) <= ISO_MOST_ROWS) return ISO_OK;
    return ISO_FAIL_ARGUMENT(ctx, "step", "more than 1e8 rows: take a longer step");
}

size_t iso_scene_rows(const iso_scene *scene)
{
    const double steps = ceil(steps_to_end(scene) * (1 - 1e-12)), most = 1e15;
    return 1 + (size_t)(steps <= most ? steps : isnan(steps) ? 0 : most);
}

double iso_scene_time(const iso_scene *scene, size_t row)
{
    if (row + 1 >= iso_scene_rows(scene)) return scene->end;
    if (row == 0) return 0;
    if (scene->step > 0) return copysign(scene->step * (double)row, scene->end);
    return scene->end * ((double)row / USUAL_STEPS);
}

/* A column that is there without effects, or that the scene's effects fill. *why (may be NULL): the effect is on, but
 * leaves it empty; NULL: it is off. */
static bool is_filled(const iso_scene *scene, int column, const char **why)
{
    const iso_effect_id e = iso_column_effect(column);
    if (e == ISO_EFFECTS) return true;
    const iso_effect *effect = iso_effect_list[e];
    const bool on = scene->effects.on[e], asked = on && effect->empty;
    const char *empty = asked ? effect->empty(&scene->params, &scene->effects, iso_column_name(column)) : NULL;
    if (why) *why = empty;
    return on && !empty;
}

/* The columns of a picture are runs of the list: t, omega, n; s, M, gamma; or all of it; the ball's with those of
 * effects. */
int iso_scene_column_list(const iso_scene *scene, int columns[])
{
    const iso_models as = scene->as == ISO_SHOW_START ? (iso_models)scene->start.model : scene->as;
    const bool clocks = iso_effects_clocks(&scene->effects);
    int count = 0;
    for (size_t i = 0; i < scene->columns; i++)
        if (iso_column_find(scene->column[i]) >= 0) columns[count++] = iso_column_find(scene->column[i]);
    for (int c = 0; scene->columns == 0 && c < iso_columns_count(); c++) {
        const bool point = c == ISO_CLOCK_S || (c >= ISO_COLUMN_POINT && c < ISO_COLUMN_EFFECTS);
        const bool ball = !point && c != ISO_CLOCK_TAU;
        if ((as == ISO_SHOW_BOTH || (as == ISO_SHOW_BALL ? ball : point) || (c < ISO_CLOCKS && clocks)) &&
            is_filled(scene, c, NULL))
            columns[count++] = c;
    }
    return count;
}

iso_status iso_scene_check_columns(iso_context *ctx, const iso_scene *scene)
{
    int columns[ISO_MAX_COLUMNS];
    const int count = iso_scene_column_list(scene, columns);
    for (int i = 0; i < count; i++) {
        const char *name = iso_column_name(columns[i]), *why;
        if (is_filled(scene, columns[i], &why)) continue;
        if (why) return ISO_FAIL_INPUT(ctx, "columns", "column '%s': %s", name, why);
        return ISO_FAIL_INPUT(ctx, "columns", "column '%s' needs the effect '%s'", name,
                              iso_effect_list[iso_column_effect(columns[i])]->name);
    }
    return ISO_OK;
}

static const iso_place *find_place(const iso_scene *scene, const char *key)
{
    /* what need not be written follows from what is */
    static const char *const sources[][2] = {{"k", "surface"}, {"level", "eps"}, {"eps", "initial"}};
    for (int i = 0; i < scene->places; i++)
        if (strcmp(scene->place[i].key, key) == 0) return &scene->place[i];
    for (size_t i = 0; i < sizeof sources / sizeof *sources; i++)
        if (strcmp(sources[i][0], key) == 0) return find_place(scene, sources[i][1]);
    return NULL;
}

bool iso_scene_is_rounded(const iso_scene *scene, const char *key)
{
    char rounded[2 * ISO_NAME_SIZE];
    snprintf(rounded, sizeof rounded, ISO_ROUNDED_KEY "%s", key);
    for (int i = 0; i < scene->places; i++)
        if (strcmp(scene->place[i].key, rounded) == 0) return true;
    return false;
}

void iso_scene_forget_place(iso_scene *scene, const char *key)
{
    int kept = 0;
    for (int i = 0; i < scene->places; i++)
        if (strcmp(scene->place[i].key, key) != 0) scene->place[kept++] = scene->place[i];
    scene->places = kept;
}

iso_status iso_scene_blame(iso_context *ctx, const iso_scene *scene, const char *name, iso_status status)
{
    const iso_place *at = status == ISO_OK ? NULL : find_place(scene, iso_context_about(ctx));
    if (!at) return status;
    return iso_context_placed(ctx,
                              iso_context_fail(ctx, status == ISO_BAD_ARGUMENT ? ISO_BAD_INPUT : status, "",
                                               "%s:%d:%d: %s", name, at->line, at->column, iso_context_message(ctx)));
}

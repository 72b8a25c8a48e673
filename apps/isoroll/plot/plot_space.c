/* plot_space.c - what a path in space is: its support, what is up, where the contact is lost. plot_view.c draws it.
 *
 *     contact = a R n (sphere), centre = contact + b R n, |b| the ball's radius
 *
 * The view from above has the axes (right, away), that from the side (right, up), with away = up x right:
 *
 *       up |    / away
 *          |  /
 *          |/______ right
 */
#include <math.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"

#define ALIKE 1e-6 /* directions and radii that differ by less are the same             */
#define NARROW 6   /* a path that is so many times longer than wide has a wide panel    */
#define FLAT 3     /* the same on a sphere: the eye looks at its side                  */
#define LOST 1e-9  /* a pressure below this part of the largest is 0                    */

static const double *vector_at(const iso_record *r, size_t row, int column)
{
    return iso_record_const_row(r, row) + column;
}

static const double *place_at(const iso_plot_scenery *s, size_t row)
{
    return vector_at(s->rows, row, s->place);
}

/* --- the support ------------------------------------------------------------------------------------------------ */

/* The length of the vector, if it is the same in all rows; else 0. */
static double constant_length(const iso_record *r, int column, int less)
{
    double first = 0;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        double v[3];
        copy(vector_at(r, i, column), v, 3);
        for (int c = 0; c < 3 && less >= 0; c++) v[c] -= vector_at(r, i, less)[c];
        if (i == 0) first = norm(v);
        if (!(fabs(norm(v) - first) <= ALIKE * first)) return 0;
    }
    return first;
}

static void find_radii(iso_plot_scenery *s)
{
    const bool both = s->centre >= 0 && s->contact >= 0;
    s->ball = both ? constant_length(s->rows, s->centre, s->contact) : 0;
    s->support = !s->plane && s->contact >= 0 ? constant_length(s->rows, s->contact, -1) : 0;
}

/* The normal of the plane, on the ball's side; false: the columns do not tell it. */
static bool find_normal(const iso_plot_scenery *s, double normal[3])
{
    if (s->ball == 0) return false;
    for (int i = 0; i < 3; i++)
        normal[i] = (vector_at(s->rows, 0, s->centre)[i] - vector_at(s->rows, 0, s->contact)[i]) / s->ball;
    return true;
}

/* --- directions ------------------------------------------------------------------------------------------------- */

/* The part of v that is orthogonal to up, made a unit vector; false: there is none. */
static bool across(const double v[3], const double up[3], double direction[3])
{
    const double along = dot(v, up), size = norm(v);
    for (int i = 0; i < 3; i++) direction[i] = v[i] - along * up[i];
    const double length = norm(direction);
    if (!(length > ALIKE * size)) return false;
    scale(direction, 1 / length);
    return true;
}

static void measure(iso_plot_scenery *s)
{
    const double *const axis[] = {s->right, s->away, s->up};
    for (int a = 0; a < 3; a++) {
        s->low[a] = s->high[a] = dot(place_at(s, 0), axis[a]);
        for (size_t i = 1; i < iso_record_rows(s->rows); i++) {
            s->low[a] = fmin(s->low[a], dot(place_at(s, i), axis[a]));
            s->high[a] = fmax(s->high[a], dot(place_at(s, i), axis[a]));
        }
    }
}

/* The horizontal direction from the start to the place that is farthest from it. */
static bool find_far(const iso_plot_scenery *s, double direction[3])
{
    double most = 0;
    for (size_t i = 1; i < iso_record_rows(s->rows); i++) {
        double way[3], flat[3];
        for (int c = 0; c < 3; c++) way[c] = place_at(s, i)[c] - place_at(s, 0)[c];
        const double rise = dot(way, s->up);
        for (int c = 0; c < 3; c++) flat[c] = way[c] - rise * s->up[c];
        if (norm(flat) > most) most = norm(flat), copy(flat, direction, 3);
    }
    if (most > 0) scale(direction, 1 / most);
    return most > 0;
}

static void turn_to(iso_plot_scenery *s, const double right[3])
{
    copy(right, s->right, 3);
    cross(s->up, s->right, s->away);
    measure(s);
}

static void name_views(iso_plot_scenery *s, bool axes)
{
    const bool level_plane = s->plane && s->level && s->normal;
    s->from_above = s->vertical   ? "the path of the ball, seen from above"
                    : level_plane ? "the path of the ball, seen along the normal of the plane"
                                  : "the path of the ball, seen along axis 3 of space";
    s->from_side = s->vertical ? "seen from the side"
                   : axes      ? "seen along axis 2 of space"
                               : "seen at a right angle to axis 3";
    s->right_name = axes ? "axis 1" : s->vertical ? "horizontal" : "at a right angle to axis 3";
    s->away_name = axes ? "axis 2" : s->vertical ? "horizontal" : "at a right angle to axis 3";
    if (level_plane && !s->vertical) s->right_name = s->away_name = "in the plane";
    s->up_name = !s->vertical ? "axis 3" : axes ? "height (axis 3)" : "height";
}

/* Whether the path lies nearly in one upright plane: the view from the side then looks at it from the front. */
static bool is_flat(const iso_plot_scenery *s)
{
    return s->high[0] - s->low[0] > FLAT * (s->high[1] - s->low[1]);
}

/* Whether the whole path has the same height. */
static bool is_even(const iso_plot_scenery *s)
{
    return s->high[2] - s->low[2] <= ALIKE * fmax(s->high[0] - s->low[0], s->high[1] - s->low[1]);
}

/* Turns `right` along the path: on a plane if the path is narrow, on a sphere if it is flat. Else nothing changes. */
static void follow_path(iso_plot_scenery *s)
{
    iso_plot_scenery turned = *s;
    double right[3];
    if (!find_far(s, right)) return;
    turn_to(&turned, right);
    if (!(s->plane ? iso_plot_is_narrow(&turned) : is_flat(&turned))) return;
    *s = turned;
    name_views(s, false);
    if (!s->plane) return;
    s->from_above = s->vertical ? "the path of the ball, seen from above; the scale across it is larger"
                    : s->normal ? "the path of the ball, along the normal of the plane; the scale across it is larger"
                                : "the path of the ball, along axis 3 of space; the scale across it is larger";
    s->right_name = "along the path", s->away_name = "across";
}

/* To the right: down the slope of a plane, along a narrow path, else along axis 1 of space, or nearest to it. */
static void choose_directions(iso_plot_scenery *s, const double normal[3], bool known)
{
    static const double axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double right[3];
    if (s->plane && known && across(normal, s->up, right)) {
        turn_to(s, right);
        name_views(s, false);
        s->right_name = "horizontal, down the slope", s->away_name = "across the slope";
        return;
    }
    const bool upright = norm((double[]){s->up[0], s->up[1], s->up[2] - 1}) <= ALIKE;
    if (upright)
        copy(axis[0], right, 3);
    else if (!across(axis[0], s->up, right))
        across(axis[1], s->up, right);
    turn_to(s, right);
    s->level = s->plane && (known || is_even(s));
    name_views(s, upright);
    follow_path(s);
}

bool iso_plot_is_narrow(const iso_plot_scenery *s)
{
    return s->plane && s->level && s->high[0] - s->low[0] > NARROW * (s->high[1] - s->low[1]);
}

/* --- loss of contact -------------------------------------------------------------------------------------------- */

/* A run that ends where contact is lost has pressure 0 in its last row. */
int iso_plot_losses(const iso_record *r, size_t lost[ISO_PLOT_MARKS])
{
    const int column = iso_record_find(r, "pressure");
    double largest = 0;
    int count = 0;
    bool pressed = iso_record_rows(r) == 1; /* a start under a pull is no loss */
    for (size_t i = 0; column >= 0 && i < iso_record_rows(r); i++)
        largest = fmax(largest, fabs(iso_record_const_row(r, i)[column]));
    for (size_t i = 0; column >= 0 && i < iso_record_rows(r); i++) {
        const bool now = iso_record_const_row(r, i)[column] > LOST * largest;
        if (pressed && !now && count < ISO_PLOT_MARKS) lost[count++] = i;
        pressed = now;
    }
    return count;
}

const char *iso_plot_loss_name(const iso_record *r, const size_t lost[], int losses)
{
    if (losses == 0) return NULL;
    return lost[losses - 1] + 1 == iso_record_rows(r) ? "contact lost" : "pressure 0";
}

/* --- all -------------------------------------------------------------------------------------------------------- */

iso_status iso_plot_look_around(iso_context *ctx, const iso_plot_space *space, iso_plot_scenery *s)
{
    static const char *const centre[] = {"centre1", "centre2", "centre3"}, *const contact[] = {"contact1", "contact2",
                                                                                               "contact3"};
    static const double axis_3[3] = {0, 0, 1};
    double normal[3];
    *s = (iso_plot_scenery){.rows = space->rows, .plane = space->plane, .vertical = space->up != NULL};
    iso_status status = iso_plot_find(ctx, s->rows, 3, centre, &s->centre);
    if (status != ISO_NUMERICAL) status = iso_plot_find(ctx, s->rows, 3, contact, &s->contact);
    if (status == ISO_NUMERICAL) return status;
    if (s->centre < 0 && s->contact < 0)
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "centre1",
                                "a picture of space: no columns centre1, centre2, centre3 or contact1, contact2, "
                                "contact3 side by side");
    s->place = s->centre >= 0 ? s->centre : s->contact;
    find_radii(s);
    const bool known = s->normal = s->plane && find_normal(s, normal);
    copy(space->up ? space->up : known ? normal : axis_3, s->up, 3);
    if (!(fabs(norm(s->up) - 1) <= ALIKE))
        return iso_context_fail(ctx, ISO_BAD_ARGUMENT, "up", "a picture of space: up is no unit vector");
    choose_directions(s, normal, known);
    s->losses = iso_plot_losses(s->rows, s->lost);
    return ISO_OK;
}

/* space.c - the path of a ball in space: its support, what is up, where the contact is lost.
 *
 *     contact = a R n (sphere), centre = contact + b R n, |b| the ball's radius
 *
 * Tables: path (of, right, away, up, above, side): `of` is "centre" or "contact"; above and side: 1: near, 0: behind
 * the support, seen from above and from the side; the row where a path goes behind it stands twice. marks (sign, right,
 * away, up): "start", "end", and "lost" where the contact is lost. The view from above has the axes (right,
 * away), that from the side (right, up), with away = up x right:
 *
 *       up |    / away
 *          |  /
 *          |/______ right
 *
 * Lines: paths: the values of `of`; above, side: titles of the views, "" if there is none; right_name, away_name,
 * up_name; right_low, ... up_high: what is to be seen; dots: the rows are too far apart to be joined; ball, support:
 * radii, 0: not known; solid: the support hides what is behind it; strip: the path is so narrow that the scale across
 * it is larger; slope, at: the plane seen from the side is up = at + slope right, if it is seen.
 */
#include <math.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "picture/picture_impl.h"

#define ALIKE 1e-6  /* directions and radii that differ by less are the same             */
#define NARROW 6    /* a path that is so many times longer than wide has a wide panel    */
#define FLAT 3      /* the same on a sphere: the eye looks at its side                   */
#define LOST 1e-9   /* a pressure below this part of the largest is 0                    */
#define OUTLINE 0.1 /* nothing is hidden this near the outline of the support; part of its radius */

enum { RIGHT, AWAY, UP };

typedef struct scenery {
    const iso_record *rows;
    int centre, contact;    /* first columns, -1: not there */
    int place;              /* the path that is drawn: of the centre if it is known, else of the contact */
    bool plane, level;      /* the support is a plane; a plane that is level, or up is not known */
    bool normal, vertical;  /* the plane's normal is known; `up` is the vertical */
    double axis[3][3];      /* right, away, up: of the view from the side; `away` is up in the view from above */
    double ball, support;   /* radii, 0: not known */
    double low[3], high[3]; /* of the path along right, away, up */
    const char *right_name, *away_name, *up_name, *above, *side;
} scenery;

static const double *vector_at(const scenery *s, size_t row, int column)
{
    return iso_record_const_row(s->rows, row) + column;
}

/* --- the support ------------------------------------------------------------------------------------------------ */

/* The length of the vector, less another one, if it is the same in all rows; else 0. */
static double constant_length(const scenery *s, int column, int less)
{
    double first = 0;
    for (size_t i = 0; i < iso_record_rows(s->rows); i++) {
        double v[3];
        copy(vector_at(s, i, column), v, 3);
        if (less >= 0) add_scaled(v, -1, vector_at(s, i, less));
        if (i == 0) first = norm(v);
        if (!(fabs(norm(v) - first) <= ALIKE * first)) return 0;
    }
    return first;
}

/* On a plane the paths of contact and centre are the same from above. */
static bool shows_contact(const scenery *s)
{
    return s->centre < 0 || (s->contact >= 0 && !s->plane);
}

/* Whether the support hides the place: only a sphere on whose outside the ball rolls, or that is inside the ball. */
static bool is_solid(const scenery *s)
{
    if (s->support == 0 || s->ball == 0) return false;
    return norm(vector_at(s, 0, s->centre)) > s->support || s->ball > s->support;
}

/* A run that ends where contact is lost has pressure 0 in its last row. */
int iso_picture_losses(const iso_record *r, size_t lost[ISO_PICTURE_LOSSES])
{
    const int column = iso_record_find(r, "pressure");
    double range[2];
    int count = 0;
    bool pressed = iso_record_rows(r) == 1; /* a start under a pull is no loss */
    if (column < 0) return 0;
    iso_picture_range(r, column, range);
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const bool now = iso_picture_at(r, i, column) > LOST * fmax(fabs(range[0]), fabs(range[1]));
        if (pressed && !now && count < ISO_PICTURE_LOSSES) lost[count++] = i;
        pressed = now;
    }
    return count;
}

/* --- directions ------------------------------------------------------------------------------------------------- */

/* The part of v that is orthogonal to up, made a unit vector; false: there is none. */
static bool across(const double v[3], const double up[3], double direction[3])
{
    copy(v, direction, 3);
    remove_along(direction, up);
    return make_unit(direction) > ALIKE * norm(v);
}

static void turn_to(scenery *s, const double right[3])
{
    copy(right, s->axis[RIGHT], 3);
    cross(s->axis[UP], right, s->axis[AWAY]);
    for (int a = 0; a < 3; a++) {
        s->low[a] = INFINITY, s->high[a] = -INFINITY;
        for (size_t i = 0; i < iso_record_rows(s->rows); i++) {
            const double x = dot(vector_at(s, i, s->place), s->axis[a]);
            s->low[a] = fmin(s->low[a], x), s->high[a] = fmax(s->high[a], x);
        }
    }
}

static void name_views(scenery *s, bool axes)
{
    const bool level_plane = s->plane && s->level && s->normal;
    s->above = s->vertical   ? "the path of the ball, seen from above"
               : level_plane ? "the path of the ball, seen along the normal of the plane"
                             : "the path of the ball, seen along axis 3 of space";
    s->side = s->vertical ? "seen from the side"
              : axes      ? "seen along axis 2 of space"
                          : "seen at a right angle to axis 3";
    s->right_name = axes ? "axis 1" : s->vertical ? "horizontal" : "at a right angle to axis 3";
    s->away_name = axes ? "axis 2" : s->vertical ? "horizontal" : "at a right angle to axis 3";
    if (level_plane && !s->vertical) s->right_name = s->away_name = "in the plane";
    s->up_name = !s->vertical ? "axis 3" : axes ? "height (axis 3)" : "height";
}

/* Whether the path is so long and narrow that it gets a wide panel, with a larger scale across it. */
static bool is_narrow(const scenery *s)
{
    return s->plane && s->level && s->high[0] - s->low[0] > NARROW * (s->high[1] - s->low[1]);
}

/* Turns `right` along the path: on a plane if the path is narrow; on a sphere if it lies nearly in one upright plane,
 * which the view from the side then shows from the front. Else nothing changes. */
static void follow_path(scenery *s)
{
    scenery turned = *s;
    double right[3], most = 0;
    for (size_t i = 1; i < iso_record_rows(s->rows); i++) { /* to the place that is farthest from the start */
        double to[3];
        copy(vector_at(s, i, s->place), to, 3);
        add_scaled(to, -1, vector_at(s, 0, s->place));
        remove_along(to, s->axis[UP]);
        if (norm(to) > most) most = norm(to), copy(to, right, 3);
    }
    if (most == 0) return;
    scale(right, 1 / most);
    turn_to(&turned, right);
    if (s->plane ? !is_narrow(&turned) : !(turned.high[0] - turned.low[0] > FLAT * (turned.high[1] - turned.low[1])))
        return;
    *s = turned;
    name_views(s, false);
    if (!s->plane) return;
    s->above = s->vertical ? "the path of the ball, seen from above; the scale across it is larger"
               : s->normal ? "the path of the ball, along the normal of the plane; the scale across it is larger"
                           : "the path of the ball, along axis 3 of space; the scale across it is larger";
    s->right_name = "along the path", s->away_name = "across";
}

/* To the right: down the slope of a plane, along a narrow path, else along axis 1 of space, or nearest to it. */
static void choose_directions(scenery *s, const double normal[3])
{
    const double *up = s->axis[UP];
    double right[3];
    if (s->normal && across(normal, up, right)) {
        turn_to(s, right);
        name_views(s, false);
        s->right_name = "horizontal, down the slope", s->away_name = "across the slope";
        return;
    }
    const bool upright = norm((double[]){up[0], up[1], up[2] - 1}) <= ALIKE;
    if (upright)
        copy((double[]){1, 0, 0}, right, 3);
    else if (!across((double[]){1, 0, 0}, up, right))
        across((double[]){0, 1, 0}, up, right);
    turn_to(s, right);
    const double rise = s->high[2] - s->low[2], width = fmax(s->high[0] - s->low[0], s->high[1] - s->low[1]);
    s->level = s->plane && (s->normal || rise <= ALIKE * width);
    name_views(s, upright);
    follow_path(s);
}

/* --- tables ----------------------------------------------------------------------------------------------------- */

/* The places of a narrow path are counted from its start. */
static double origin(const scenery *s, int axis)
{
    return is_narrow(s) && axis != UP ? dot(vector_at(s, 0, s->place), s->axis[axis]) : 0;
}

/* Along right, away and up. */
static void project(const scenery *s, const double place[3], double at[3])
{
    for (int a = 0; a < 3; a++) at[a] = dot(place, s->axis[a]) - origin(s, a);
}

static iso_status add_path(iso_context *ctx, const scenery *s, const char *of, int column, iso_record *path)
{
    const bool hides = is_solid(s) && s->ball <= s->support;
    double row[6] = {0, 0, 0, 0, -1, -1};
    ISO_TRY(iso_record_intern(ctx, path, of, &row[0]));
    for (size_t i = 0; i < iso_picture_drawn(s->rows); i++) {
        project(s, iso_picture_row(s->rows, i) + column, &row[1]);
        const double above = !hides || row[3] >= -OUTLINE * s->support,
                     side = !hides || row[2] <= OUTLINE * s->support;
        const bool turns = i > 0 && (above != row[4] || side != row[5]);
        if (turns) ISO_TRY(iso_record_add(ctx, path, 1, row));
        row[4] = above, row[5] = side;
        ISO_TRY(iso_record_add(ctx, path, 1, row));
    }
    return ISO_OK;
}

static iso_status add_mark(iso_context *ctx, const scenery *s, const char *sign, size_t row, iso_record *marks)
{
    double numbers[4];
    ISO_TRY(iso_record_intern(ctx, marks, sign, &numbers[0]));
    project(s, vector_at(s, row, s->place), &numbers[1]);
    return iso_record_add(ctx, marks, 1, numbers);
}

/* What must fit into the views: the path, the ball, the sphere. */
static iso_status set_extents(iso_context *ctx, const scenery *s, iso_picture *picture)
{
    static const char *const keys[] = {"right_low right_high", "away_low away_high", "up_low up_high"};
    const double room = is_narrow(s) ? 0 : s->ball;
    for (int a = 0; a < 3; a++) {
        const double low = s->low[a] - origin(s, a) - room, high = s->high[a] - origin(s, a) + room, r = s->support;
        ISO_TRY(iso_picture_set(ctx, picture, keys[a],
                                (double[]){r > 0 ? fmin(low, -r) : low, r > 0 ? fmax(high, r) : high}));
    }
    return ISO_OK;
}

static iso_status set_scenery(iso_context *ctx, const scenery *s, iso_picture *picture)
{
    const bool dots = !s->plane && !iso_picture_joined(s->rows, s->place);
    ISO_TRY(iso_picture_line(ctx, picture, "paths",
                             s->centre < 0      ? "contact"
                             : shows_contact(s) ? "centre contact"
                                                : "centre"));
    ISO_TRY(iso_picture_line(ctx, picture, "above", "%s", s->above));
    ISO_TRY(iso_picture_line(ctx, picture, "side", "%s", s->plane && s->level ? "" : s->side));
    ISO_TRY(iso_picture_line(ctx, picture, "right_name", "%s", s->right_name));
    ISO_TRY(iso_picture_line(ctx, picture, "away_name", "%s", s->away_name));
    ISO_TRY(iso_picture_line(ctx, picture, "up_name", "%s", s->up_name));
    ISO_TRY(iso_picture_set(ctx, picture, "dots ball support solid strip",
                            (double[]){dots, s->ball, s->support, is_solid(s), is_narrow(s)}));
    if (s->plane && !s->level &&
        s->ball > 0) { /* the plane, seen from the side, is a line through the first contact */
        double contact[3], centre[3];
        project(s, vector_at(s, 0, s->contact), contact);
        project(s, vector_at(s, 0, s->centre), centre);
        const double slope = -(centre[0] - contact[0]) / (centre[2] - contact[2]);
        if (isfinite(slope))
            ISO_TRY(iso_picture_set(ctx, picture, "slope at", (double[]){slope, contact[2] - slope * contact[0]}));
    }
    return set_extents(ctx, s, picture);
}

/* --- all -------------------------------------------------------------------------------------------------------- */

static iso_status look_around(iso_context *ctx, const iso_record *r, const double *up, bool plane, scenery *s)
{
    static const char *const centre[] = {"centre1", "centre2", "centre3"}, *const contact[] = {"contact1", "contact2",
                                                                                               "contact3"};
    double normal[3];
    *s = (scenery){
        .rows = r, .plane = plane, .vertical = up != NULL, .centre = -1, .contact = -1, .axis = {[UP] = {0, 0, 1}}};
    if (iso_record_find(r, centre[0]) >= 0) ISO_TRY(iso_picture_find(ctx, r, 3, centre, &s->centre));
    if (iso_record_find(r, contact[0]) >= 0 || s->centre < 0)
        ISO_TRY(iso_picture_find(ctx, r, 3, contact, &s->contact));
    s->place = s->centre >= 0 ? s->centre : s->contact;
    if (s->centre >= 0 && s->contact >= 0) s->ball = constant_length(s, s->centre, s->contact);
    if (!plane && s->contact >= 0) s->support = constant_length(s, s->contact, -1);
    s->normal = plane && s->ball > 0;
    if (s->normal) { /* on the ball's side */
        copy(vector_at(s, 0, s->centre), normal, 3);
        add_scaled(normal, -1, vector_at(s, 0, s->contact));
        scale(normal, 1 / s->ball);
        copy(normal, s->axis[UP], 3);
    }
    if (up) copy(up, s->axis[UP], 3);
    if (!(fabs(norm(s->axis[UP]) - 1) <= ALIKE))
        return ISO_FAIL_ARGUMENT(ctx, "up", "a picture of space: up is no unit vector");
    choose_directions(s, normal);
    return ISO_OK;
}

iso_status iso_picture_space(iso_context *ctx, const iso_record *r, const double *up, bool plane,
                             iso_picture *picture)
{
    const size_t last = iso_record_rows(r) - 1;
    size_t lost[ISO_PICTURE_LOSSES];
    const int losses = iso_picture_losses(r, lost);
    scenery s;
    iso_record *path, *marks;
    ISO_TRY(look_around(ctx, r, up, plane, &s));
    ISO_TRY(set_scenery(ctx, &s, picture));
    ISO_TRY(iso_picture_add(ctx, picture, "path", "of' right away up above side", &path));
    if (s.centre >= 0) ISO_TRY(add_path(ctx, &s, "centre", s.centre, path));
    if (shows_contact(&s)) ISO_TRY(add_path(ctx, &s, "contact", s.contact, path));
    ISO_TRY(iso_picture_add(ctx, picture, "marks", "sign' right away up", &marks));
    ISO_TRY(add_mark(ctx, &s, "start", 0, marks));
    if (losses == 0 || lost[losses - 1] != last)
        ISO_TRY(add_mark(ctx, &s, "end", last, marks)); /* "lost" says more */
    for (int i = 0; i < losses; i++) ISO_TRY(add_mark(ctx, &s, "lost", lost[i], marks));
    return ISO_OK;
}

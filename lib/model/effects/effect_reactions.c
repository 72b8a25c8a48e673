/* effect_reactions.c - what the support does to the ball. It only observes: the motion, which these forces make,
 * stays as it is.
 *
 *     a_c = b [ w' x n + w x n' + w x (w x n) ]          acceleration of the centre, in body axes
 *     N = m a_c - F,   F = -m g e under gravity           contact force
 *
 * The twist torque lambda n acts as well: lambda of (9), or -c (w,n) of a contact that twists. With D = m b^2 all of
 * this needs mass and radius only as b: columns are forces times |b|, which are energies.
 */
#include <float.h>

#include "base/vec3_impl.h"
#include "model/effects/contact_impl.h"
#include "model/model_impl.h"

/* Where its number is. */
enum { TWO_SIDED = 0 };

/* A pressure that is smaller than this, relative to its terms, is taken as 0. Otherwise a rounding error would end
 * the contact of a ball that rolls down a wall. */
#define ROUNDING (8 * DBL_EPSILON)

/* w x n' + w x (w x n) = (1-k) w x (w x n) = (1-k) [ (w,n) w - w^2 n ]. The parts along n and across are found one by
 * one: on a plane without weight the first is exactly 0. */
static void show(const iso_problem *f, const double y[], double columns[])
{
    const double *w = y, *n = y + 3, D = f->p.D, k = f->p.k, spin = dot(w, n);
    const double side = k > 1 ? -1 : 1; /* inside a sphere the support is on the other side of the centre */
    const double b = iso_params_sign_of_radius(&f->p);
    const bool twists = iso_effects_twist(&f->effects);
    double T[3], dy[ISO_MAX_STATE], across[3];
    iso_effects_torque(f, y, T, dy);
    (twists ? iso_contact_twisting : iso_contact_rigid)(f, y, T, dy);
    cross(dy, n, across);
    add_scaled(across, (1 - k) * spin, w);
    scale(across, D);
    double normal = -D * (1 - k) * dot(w, w), size = fabs(normal);
    if (f->effects.on[ISO_GRAVITY]) {
        const double *e = iso_vertical(f, y), mgb = f->effects.number[ISO_GRAVITY][0];
        add_scaled(across, mgb, e);
        normal += mgb * dot(e, n);
        size += fabs(mgb);
    }
    normal += D * (1 - k) * spin * spin;
    if (fabs(normal) <= ROUNDING * size) normal = 0;
    remove_along(across, n);
    for (int i = 0; i < 3; i++) columns[i] = b * (across[i] + normal * n[i]);
    columns[3] = side * b * normal; /* < 0: the support would have to pull */
    columns[4] = norm(across);
    columns[5] = fmin(columns[4] / fabs(columns[3]), DBL_MAX); /* where contact is lost the pressure may be 0 */
    columns[6] = twists ? iso_effects_twist_torque(f, y) : iso_contact_lambda(f, y, T);
}

/* mu only where something presses the ball to the support. */
static const char *empty(const iso_params *p, const iso_effects *effects, const char *column)
{
    const bool weightless = p->k == 1 && !effects->on[ISO_GRAVITY];
    return weightless && strcmp(column, "mu") == 0 ? "without gravity nothing presses the ball to the plane" : NULL;
}

bool iso_effects_watch_contact(const iso_effects *effects)
{
    return effects->on[ISO_REACTIONS] && effects->number[ISO_REACTIONS][TWO_SIDED] == 0;
}

/* On a plane it keeps its value; without gravity it keeps its sign. */
bool iso_effects_change_pressure(const iso_params *p, const iso_effects *effects)
{
    return effects->on[ISO_GRAVITY] && p->k != 1;
}

static const char *const N_names[] = {"N1", "N2", "N3"}, *const pressure_name[] = {"pressure"},
                         *const friction_name[] = {"friction"}, *const mu_name[] = {"mu"},
                         *const lambda_name[] = {"lambda"};

/* Forces are energies over the radius. lambda is a torque. */
static const iso_effect_column columns[] = {
    ISO_COLUMN("N", N_names, 3, "force", "contact force, in the ball's axes", .dimension = {1, 0, 2}, .length = -1,
               .checked_as = "N", .sized_by = "N"),
    ISO_COLUMN("pressure", pressure_name, 1, "force", "the part of N that pushes the ball off the support",
               .dimension = {1, 0, 2}, .length = -1, .checked_as = "force", .sized_by = "N"),
    ISO_COLUMN("friction", friction_name, 1, "force", "size of the rest of N", .dimension = {1, 0, 2}, .length = -1,
               .checked_as = "force", .sized_by = "N"),
    ISO_COLUMN("mu", mu_name, 1, "", "friction coefficient that is needed, friction/|pressure|", .checked_as = "mu",
               .ratio = true),
    ISO_COLUMN("lambda", lambda_name, 1, "torque", "torque about n that keeps the ball from twisting",
               .dimension = {1, 0, 2}, .checked_as = "lambda", .sized_by = "N"),
    {0},
};

static const iso_effect_number numbers[] = {
    {.name = "two_sided", .at = TWO_SIDED, .count = 1, .kind = ISO_NUMBER_FLAG, .scene_only = true},
    {0},
};

const iso_effect iso_effect_reactions = {
    .name = "reactions",
    .doc = "contact force, twist torque, friction coefficient needed; a run ends where contact is lost",
    .observes = true,
    .ball_only = true,
    .needs_D = true,
    .needs_radius = true,
    .numbers = numbers,
    .columns = columns,
    .empty = empty,
    .show = show,
};

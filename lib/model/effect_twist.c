/* effect_twist.c - the no-twist constraint made real: the contact resists twisting with the torque lambda n = -c (w,n) n.
 *
 *     K = J w - D (w,n) n,     K' = K x w - c (w,n) n + MQ,     D = m b^2
 *
 * The spin (w,n) is free. c -> infinity is the rubber ball, c = 0 the classical Chaplygin ball with the further integral
 * (K,K). The energy is (K,w)/2. The equations are solved for w' in contact.c.
 *
 * A stiff contact (large c) takes spin out in a time of order 1/c, and leaves a part 1/c of it: the torque would be c times
 * a number that is nearly lost in the rounding of w, and the fast direction, n, would turn with the motion. So its torque
 * is a state of its own:
 *
 *     lambda' = -c (w',n),     (w,n) = -lambda/c restored after each step           since (w,n') = 0
 *
 * Then the fast direction is that of one component, for which alone implicit methods have to be implicit (measured: bdf
 * needs as many steps at c = 1e8 as at 1e2).
 */
#include "base/vec3_impl.h"
#include "model/contact_impl.h"
#include "model/effects_impl.h"

static void torque(const iso_field *f, const double y[], double T[3])
{
    add_scaled(T, -f->effects.twist * dot(y, y + 3), y + 3);
}

static void torque_slope(const iso_field *f, const double y[], int dim, double slope[])
{
    const double *w = y, *n = y + 3, c = f->effects.twist, spin = dot(w, n);
    for (int j = 0; j < 3; j++) {
        add_column(slope, dim, j, -c * n[j], n);
        add_column(slope, dim, 3 + j, -c * w[j], n);
        slope[dim * j + 3 + j] -= c * spin;
    }
}

/* (w,n)' = -c (n, A^-1 n) (w,n) + ..., A = J - D n n^T: spin dies away at the rate c g/(1 - D g), g = (n, J^-1 n) */
static double stiffness(const iso_field *f)
{
    const double g = 1 / min3(f->p.J);
    return f->effects.twist * g / (1 - f->p.D * g) / fmax(1, fabs(f->p.k));
}

const iso_effect *iso_effect_row(const iso_field *f, iso_effect_id id)
{
    if (id != ISO_TWIST) return iso_effect_list[id];
    if (f->effects.twist == 0) return &iso_effect_free_twist;
    return stiffness(f) > ISO_STIFF ? &iso_effect_stiff_twist : &iso_effect_twist;
}

/* --- stiff: lambda is a state -------------------------------------------------------------------------------------- */

static int states(const iso_field *f)
{
    (void)f;
    return 1;
}

static void begin(const iso_field *f, double y[])
{
    y[f->at[ISO_TWIST]] = -f->effects.twist * dot(y, y + 3);
}

static void rates(const iso_field *f, const double y[], double dy[])
{
    dy[f->at[ISO_TWIST]] = -f->effects.twist * dot(dy, y + 3);
}

/* The rows of w' are there already. */
static void rates_slope(const iso_field *f, const double y[], const double dy[], int dim, double jac[])
{
    double *row = jac + dim * f->at[ISO_TWIST];
    for (int j = 0; j < dim; j++)
        row[j] = -f->effects.twist * (y[3] * jac[j] + y[4] * jac[dim + j] + y[5] * jac[2 * dim + j]);
    for (int j = 0; j < 3; j++) row[3 + j] -= f->effects.twist * dy[j];
}

/* That of the torques of the motion, (Jw,w), or of rolling resistance, which are more when little motion is left. */
static void size(const iso_field *f, const double y[], double size[])
{
    const double resists = f->effects.on[ISO_ROLLING_RESISTANCE] ? f->effects.resistance : 0;
    const double moves = dot_diag(y, f->p.J, y) + resists * largest(y);
    size[f->at[ISO_TWIST]] = fmax(fabs(y[f->at[ISO_TWIST]]) + moves, ISO_REST);
}

static double restore(const iso_field *f, double y[])
{
    const double length = norm(y + 3), speed = norm(y); /* n is made a unit vector after this */
    const double error = dot(y, y + 3) / length + y[f->at[ISO_TWIST]] / f->effects.twist;
    add_scaled(y, -error / length, y + 3);
    return speed > 0 ? fabs(error) / speed : 0;
}

static void stiff_torque(const iso_field *f, const double y[], double T[3])
{
    add_scaled(T, y[f->at[ISO_TWIST]], y + 3);
}

static void stiff_torque_slope(const iso_field *f, const double y[], int dim, double slope[])
{
    const int at = f->at[ISO_TWIST];
    add_column(slope, dim, at, 1, y + 3);
    for (int j = 0; j < 3; j++) slope[dim * j + 3 + j] += y[at];
}

/* --- integrals of the classical ball, whose momentum about the contact stands still in space ------------------------- */

/* K, and the size of its terms */
static double momentum(const iso_field *f, const double y[], double K[3])
{
    double Jw[3];
    diag(f->p.J, y, Jw);
    contact_momentum(&f->p, y, K);
    return norm(Jw);
}

static double momentum_square(const iso_field *f, const double y[], double *value_size)
{
    double K[3];
    const double size = momentum(f, y, K);
    *value_size = size * size;
    return dot(K, K);
}

static double momentum_normal(const iso_field *f, const double y[], double *value_size)
{
    double K[3];
    *value_size = momentum(f, y, K);
    return dot(K, y + 3);
}

static double momentum_up(const iso_field *f, const double y[], double *value_size)
{
    double K[3];
    *value_size = momentum(f, y, K);
    return dot(K, y + f->at[ISO_GRAVITY]);
}

/* No torque acts, or only the weight's. */
static bool is_classical(const iso_field *f)
{
    const bool *on = f->effects.on;
    return f->effects.twist == 0 && !on[ISO_FIELD] && !on[ISO_LEVEL] && !on[ISO_ROLLING_RESISTANCE];
}

static bool keeps_square(const iso_field *f)
{
    return is_classical(f) && !f->effects.on[ISO_GRAVITY];
}

static bool keeps_normal(const iso_field *f)
{
    return f->p.k == 1 && f->effects.twist == 0 && !f->effects.on[ISO_ROLLING_RESISTANCE];
}

static bool keeps_up(const iso_field *f)
{
    return is_classical(f) && f->effects.on[ISO_GRAVITY];
}

static const iso_effect_number numbers[] = {
    {"resistance", offsetof(iso_effects, twist), 1, {1, 0, 1}},
    {0},
};

static const iso_integral integrals[] = {
    {.name = "K.K",
     .doc = "(K,K), K = J w - D (w,n) n, momentum about the contact; c = 0 and no torque",
     .dimension = {2, 0, 2},
     .holds = keeps_square,
     .value = momentum_square},
    {.name = "K.n",
     .doc = "(K,n), k = 1, c = 0 and no rolling resistance",
     .dimension = {1, 0, 1},
     .holds = keeps_normal,
     .value = momentum_normal},
    {.name = "K.e",
     .doc = "(K,e), c = 0 and no torque but the weight's",
     .dimension = {1, 0, 1},
     .holds = keeps_up,
     .value = momentum_up},
    {0},
};

#define TWIST \
    .name = "twist", \
    .doc = "finite resistance of the contact against twisting: torque -c (omega,n) n; c = 0: classical ball", \
    .breaks = "the ball is free to twist: (omega,n) is not 0", .numbers = numbers, .integrals = integrals, \
    .stiffness = stiffness

const iso_effect iso_effect_twist = {TWIST, .torque = torque, .torque_slope = torque_slope};

const iso_effect iso_effect_free_twist = {TWIST};

static const char *const state_names[] = {"lambda"};

const iso_effect iso_effect_stiff_twist = {
    TWIST,
    .state = state_names,
    .states_doc = "torque of the contact against twisting, which is stiff",
    .states = states,
    .begin = begin,
    .rates = rates,
    .rates_slope = rates_slope,
    .size = size,
    .restore = restore,
    .torque = stiff_torque,
    .torque_slope = stiff_torque_slope,
};

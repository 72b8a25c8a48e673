/* arb_exact.c - the numbers of a scene as fractions, and in balls; the start (arb_certify_impl.h). */
#include <stdlib.h>
#include <string.h>

#include "instrument/certify/arb_certify_impl.h"

/* --- texts ------------------------------------------------------------------------------------------------------- */

/* A decimal number. */
static bool read_decimal(const char *text, size_t length, fmpq_t x)
{
    enum { MOST = 5000 };
    char *digits = malloc(length + 1);
    size_t count = 0, i = 0;
    long power = 0;
    bool point = false;
    if (!digits) return false;
    for (; i < length && text[i] != 'e' && text[i] != 'E'; i++) {
        if (text[i] == '.')
            point = true;
        else if (text[i] != '+')
            digits[count++] = text[i], power -= point;
    }
    digits[count] = '\0';
    if (i < length) power += strtol(text + i + 1, NULL, 10);
    fmpq_one(x);
    const bool good = power <= MOST && power >= -MOST && fmpz_set_str(fmpq_numref(x), digits, 10) == 0;
    free(digits);
    if (!good) return false;
    fmpz_t scale;
    fmpz_init(scale);
    fmpz_ui_pow_ui(scale, 10, (ulong)labs(power));
    if (power < 0)
        fmpq_div_fmpz(x, x, scale);
    else
        fmpq_mul_fmpz(x, x, scale);
    fmpz_clear(scale);
    return true;
}

bool certify_rational_read(const char *text, fmpq_t x)
{
    const char *slash = strchr(text, '/');
    const size_t first = slash ? (size_t)(slash - text) : strlen(text);
    fmpq_t below;
    bool good = read_decimal(text, first, x);
    if (!slash || !good) return good;
    fmpq_init(below);
    good = read_decimal(slash + 1, strlen(slash + 1), below) && !fmpq_is_zero(below);
    if (good) fmpq_div(x, x, below);
    fmpq_clear(below);
    return good;
}

/* `about`: the key that messages name. */
static iso_status take(iso_context *ctx, const iso_literals *all, const char *name, const char *about, int count,
                       fmpq_t x[])
{
    const iso_literal *l = iso_literal_find(all, name);
    for (int i = 0; i < count; i++)
        if (!l || l->count != count || !certify_rational_read(l->text[i], x[i]))
            return ISO_FAIL_INPUT(ctx, about, "--certify takes %s exactly: write decimal numbers", about);
    return ISO_OK;
}

/* --- the scene --------------------------------------------------------------------------------------------------- */

void certify_exact_init(certify_exact *e)
{
    fmpq_init(e->k), fmpq_init(e->c), fmpq_init(e->eps);
    for (int i = 0; i < 3; i++)
        fmpq_init(e->J[i]), fmpq_init(e->K[i]), fmpq_init(e->vector[i]), fmpq_init(e->unit[i]);
}

void certify_exact_clear(certify_exact *e)
{
    fmpq_clear(e->k), fmpq_clear(e->c), fmpq_clear(e->eps);
    for (int i = 0; i < 3; i++)
        fmpq_clear(e->J[i]), fmpq_clear(e->K[i]), fmpq_clear(e->vector[i]), fmpq_clear(e->unit[i]);
}

/* k = A/(A + b), b the signed radius of the ball; J = I + m b^2. */
static iso_status take_body(iso_context *ctx, iso_surface surface, const iso_literals *all, certify_exact *e)
{
    fmpq_t mass, B, A;
    fmpq_init(mass), fmpq_init(B), fmpq_init(A);
    iso_status status = take(ctx, all, "mass", "mass", 1, &mass);
    if (status == ISO_OK) status = take(ctx, all, "ball.radius", "radius", 1, &B);
    if (status == ISO_OK) status = take(ctx, all, "inertia", "inertia", 3, e->J);
    if (status == ISO_OK && surface != ISO_PLANE) status = take(ctx, all, "surface.radius", "surface", 1, &A);
    if (status == ISO_OK) {
        fmpq_mul(mass, mass, B);
        for (int i = 0; i < 3; i++) fmpq_addmul(e->J[i], mass, B);
        if (surface == ISO_PLANE) fmpq_set(A, B);
        if (surface == ISO_OUTSIDE) fmpq_add(B, A, B);
        if (surface == ISO_INSIDE || surface == ISO_SHELL) fmpq_sub(B, A, B);
        fmpq_div(e->k, A, B);
    }
    fmpq_clear(mass), fmpq_clear(B), fmpq_clear(A);
    return status;
}

static iso_status take_rotor(iso_context *ctx, const iso_literals *all, certify_exact *e)
{
    const bool magnetic = iso_literal_find(all, "magnetic.momentum") != NULL;
    return take(ctx, all, magnetic ? "magnetic.momentum" : "rotor.momentum", "momentum", 3, e->K);
}

/* A level is that of a ball with c, or that of a point with eps. */
static iso_status take_level(iso_context *ctx, const iso_literals *all, certify_exact *e)
{
    const bool written = iso_literal_find(all, "level.c") != NULL;
    if (e->model == ISO_POINT && written)
        return ISO_FAIL_INPUT(ctx, "level", "--certify: the level of a point follows from its eps: remove 'c'");
    e->has_eps = e->model == ISO_POINT && iso_literal_find(all, "eps") != NULL;
    e->level = written || e->has_eps;
    if (written) ISO_TRY(take(ctx, all, "level.c", "level", 1, &e->c));
    return e->has_eps ? take(ctx, all, "eps", "eps", 1, &e->eps) : ISO_OK;
}

iso_status certify_exact_read(iso_context *ctx, const iso_scene *scene, const iso_literals *all, certify_exact *e)
{
    const iso_surface surface = scene->params.body.surface;
    const bool ball = scene->start.model == ISO_BALL;
    e->model = scene->start.model;
    e->rotor = scene->effects.on[ISO_ROTOR];
    if (surface == ISO_REDUCED) {
        ISO_TRY(take(ctx, all, "k", "k", 1, &e->k));
        ISO_TRY(take(ctx, all, "J", "J", 3, e->J));
    } else {
        ISO_TRY(take_body(ctx, surface, all, e));
    }
    if (e->rotor) ISO_TRY(take_rotor(ctx, all, e));
    ISO_TRY(take_level(ctx, all, e));
    const char *vector = ball ? "angular_velocity" : "M", *unit = ball ? "normal" : "gamma";
    ISO_TRY(take(ctx, all, vector, vector, 3, e->vector));
    return take(ctx, all, unit, unit, 3, e->unit);
}

/* --- in balls ---------------------------------------------------------------------------------------------------- */

void certify_ball_init(certify_ball *b, slong bits)
{
    b->bits = bits;
    b->rotor = b->level = false;
    arb_init(b->k), arb_init(b->det), arb_init(b->kappa), arb_init(b->half);
    arb_init(b->c), arb_init(b->h), arb_init(b->eps);
    for (int i = 0; i < 3; i++)
        arb_init(b->J + i), arb_init(b->root_J + i), arb_init(b->inverse_J + i), arb_init(b->K + i);
}

void certify_ball_clear(certify_ball *b)
{
    arb_clear(b->k), arb_clear(b->det), arb_clear(b->kappa), arb_clear(b->half);
    arb_clear(b->c), arb_clear(b->h), arb_clear(b->eps);
    for (int i = 0; i < 3; i++)
        arb_clear(b->J + i), arb_clear(b->root_J + i), arb_clear(b->inverse_J + i), arb_clear(b->K + i);
}

void certify_ball_set(certify_ball *b, const certify_exact *e)
{
    arb_set_fmpq(b->k, e->k, b->bits);
    arb_one(b->det);
    for (int i = 0; i < 3; i++) {
        arb_set_fmpq(b->J + i, e->J[i], b->bits);
        arb_sqrt(b->root_J + i, b->J + i, b->bits);
        arb_inv(b->inverse_J + i, b->J + i, b->bits);
        arb_mul(b->det, b->det, b->J + i, b->bits);
    }
    arb_mul(b->kappa, b->k, b->k, b->bits);
    arb_div(b->kappa, b->kappa, b->det, b->bits);
    arb_mul_2exp_si(b->half, b->k, 1);
    arb_inv(b->half, b->half, b->bits);
}

/* The unit vector, and what is left of the other one. */
static void set_start(const certify_exact *e, slong bits, arb_ptr y)
{
    arb_t length, along;
    arb_init(length), arb_init(along);
    for (int i = 0; i < 3; i++) arb_set_fmpq(y + i, e->vector[i], bits), arb_set_fmpq(y + 3 + i, e->unit[i], bits);
    arb_dot(length, NULL, 0, y + 3, 1, y + 3, 1, 3, bits);
    arb_dot(along, NULL, 0, y, 1, y + 3, 1, 3, bits);
    arb_div(along, along, length, bits);
    arb_rsqrt(length, length, bits);
    for (int i = 0; i < 3; i++) {
        arb_submul(y + i, along, y + 3 + i, bits);
        arb_mul(y + 3 + i, y + 3 + i, length, bits);
    }
    arb_clear(length), arb_clear(along);
}

/* h = (w, J w)/2 - c g^(-1/k),  g = (n, J^-1 n) */
static void energy_of_ball(const certify_ball *b, arb_srcptr y, arb_t h)
{
    arb_t g, x;
    arb_init(g), arb_init(x);
    arb_zero(h);
    for (int i = 0; i < 3; i++) {
        arb_mul(x, y + 3 + i, y + 3 + i, b->bits);
        arb_addmul(g, x, b->inverse_J + i, b->bits);
        arb_mul(x, y + i, y + i, b->bits);
        arb_addmul(h, x, b->J + i, b->bits);
    }
    arb_mul_2exp_si(h, h, -1);
    arb_inv(x, b->k, b->bits);
    arb_neg(x, x);
    arb_pow(x, g, x, b->bits);
    if (b->level) arb_submul(h, b->c, x, b->bits);
    arb_clear(g), arb_clear(x);
}

/* eps = q^(1/k) M^2/2 on the level H = 0; with another eps, H = M^2/2 - eps q^(-1/k), and c = kappa H. h = kappa eps. */
static void energies_of_point(const certify_exact *e, certify_ball *b, arb_srcptr y)
{
    arb_t q, kinetic, x;
    arb_init(q), arb_init(kinetic), arb_init(x);
    for (int i = 0; i < 3; i++) {
        arb_mul(x, y + 3 + i, y + 3 + i, b->bits);
        arb_addmul(q, x, b->J + i, b->bits);
        arb_addmul(kinetic, y + i, y + i, b->bits);
    }
    arb_mul_2exp_si(kinetic, kinetic, -1);
    arb_inv(x, b->k, b->bits);
    arb_pow(x, q, x, b->bits);
    arb_mul(b->eps, kinetic, x, b->bits);
    if (e->has_eps) {
        arb_set_fmpq(b->eps, e->eps, b->bits);
        arb_div(x, b->eps, x, b->bits);
        arb_sub(b->c, kinetic, x, b->bits);
        arb_mul(b->c, b->c, b->kappa, b->bits);
    }
    arb_mul(b->h, b->kappa, b->eps, b->bits);
    arb_clear(q), arb_clear(kinetic), arb_clear(x);
}

void certify_start(const certify_exact *e, iso_model_kind model, certify_ball *b, arb_ptr y)
{
    certify_ball_set(b, e);
    b->rotor = e->rotor, b->level = e->level;
    for (int i = 0; i < 3; i++) arb_set_fmpq(b->K + i, e->K[i], b->bits);
    arb_set_fmpq(b->c, e->c, b->bits);
    set_start(e, b->bits, y);
    if (e->model == ISO_POINT) {
        energies_of_point(e, b, y);
    } else {
        energy_of_ball(b, y, b->h);
        arb_div(b->eps, b->h, b->kappa, b->bits);
    }
    if (model != e->model) certify_map(b, e->model, y, y);
}

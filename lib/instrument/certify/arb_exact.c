/* arb_exact.c - the numbers of a scene as fractions, and in balls; the start (arb_certify_impl.h). */
#include <stddef.h>
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
static iso_status read_numbers(iso_context *ctx, const iso_literals *all, const char *name, const char *about,
                               int count, fmpq_t x[])
{
    const iso_literal *l = iso_literal_find(all, name);
    for (int i = 0; i < count; i++)
        if (!l || l->count != count || !certify_rational_read(l->text[i], x[i]))
            return ISO_FAIL_INPUT(ctx, about, "--certify takes %s exactly: write decimal numbers", about);
    return ISO_OK;
}

/* --- the scene --------------------------------------------------------------------------------------------------- */

/* The fractions come first. */
void certify_exact_init(certify_exact *e)
{
    fmpq *x = (fmpq *)e, *end = x + offsetof(certify_exact, model) / sizeof *x;
    for (; x < end; x++) fmpq_init(x);
}

void certify_exact_clear(certify_exact *e)
{
    fmpq *x = (fmpq *)e, *end = x + offsetof(certify_exact, model) / sizeof *x;
    for (; x < end; x++) fmpq_clear(x);
}

/* k = A/(A + b), b the signed radius of the ball; J = I + m b^2. */
static iso_status read_body(iso_context *ctx, iso_surface surface, const iso_literals *all, certify_exact *e)
{
    fmpq_t mass, B, A;
    fmpq_init(mass), fmpq_init(B), fmpq_init(A);
    iso_status status = read_numbers(ctx, all, "mass", "mass", 1, &mass);
    if (status == ISO_OK) status = read_numbers(ctx, all, "ball.radius", "radius", 1, &B);
    if (status == ISO_OK) status = read_numbers(ctx, all, "inertia", "inertia", 3, e->J);
    if (status == ISO_OK && surface != ISO_PLANE) status = read_numbers(ctx, all, "surface.radius", "surface", 1, &A);
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

/* A level is that of a ball with c, or that of a point with eps. */
iso_status certify_exact_read(iso_context *ctx, const iso_scene *scene, const iso_literals *all, certify_exact *e)
{
    const iso_surface surface = scene->params.body.surface;
    const bool ball = scene->start.model == ISO_BALL, c = iso_literal_find(all, "level.c") != NULL;
    const char *vector = ball ? "angular_velocity" : "M", *unit = ball ? "normal" : "gamma";
    const char *K = iso_literal_find(all, "magnetic.momentum") ? "magnetic.momentum" : "rotor.momentum";
    e->model = scene->start.model;
    e->rotor = scene->effects.on[ISO_ROTOR];
    if (surface == ISO_REDUCED) {
        ISO_TRY(read_numbers(ctx, all, "k", "k", 1, &e->k));
        ISO_TRY(read_numbers(ctx, all, "J", "J", 3, e->J));
    } else {
        ISO_TRY(read_body(ctx, surface, all, e));
    }
    if (e->rotor) ISO_TRY(read_numbers(ctx, all, K, "momentum", 3, e->K));
    if (!ball && c)
        return ISO_FAIL_INPUT(ctx, "level", "--certify: the level of a point follows from its eps: remove 'c'");
    e->has_eps = !ball && iso_literal_find(all, "eps");
    e->level = c || e->has_eps;
    if (c) ISO_TRY(read_numbers(ctx, all, "level.c", "level", 1, &e->c));
    if (e->has_eps) ISO_TRY(read_numbers(ctx, all, "eps", "eps", 1, &e->eps));
    ISO_TRY(read_numbers(ctx, all, vector, vector, 3, e->vector));
    return read_numbers(ctx, all, unit, unit, 3, e->unit);
}

/* --- in balls ---------------------------------------------------------------------------------------------------- */

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

/* h = (w, J w)/2 - c g^(-1/k),  g = (n, J^-1 n) */
static void energy_of_ball(const certify_ball *b, arb_srcptr y, arb_t h)
{
    ISO_BALLS(g, x);
    certify_weigh(b, b->inverse_J, y + 3, g);
    certify_weigh(b, b->J, y, h);
    arb_mul_2exp_si(h, h, -1);
    arb_inv(x, b->k, b->bits);
    arb_neg(x, x);
    arb_pow(x, g, x, b->bits);
    if (b->level) arb_submul(h, b->c, x, b->bits);
}

/* eps = q^(1/k) M^2/2 on the level H = 0; with another eps, H = M^2/2 - eps q^(-1/k), and c = kappa H. h = kappa
 * eps. */
static void energies_of_point(const certify_exact *e, certify_ball *b, arb_srcptr y)
{
    ISO_BALLS(q, kinetic, x);
    certify_weigh(b, b->J, y + 3, q);
    for (int i = 0; i < 3; i++) arb_addmul(kinetic, y + i, y + i, b->bits);
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
}

void certify_start(const certify_exact *e, iso_model_kind model, certify_ball *b, arb_ptr y)
{
    const slong bits = b->bits;
    ISO_BALLS(length, along);
    certify_ball_set(b, e);
    b->rotor = e->rotor, b->level = e->level;
    for (int i = 0; i < 3; i++) arb_set_fmpq(b->K + i, e->K[i], bits);
    arb_set_fmpq(b->c, e->c, bits);
    for (int i = 0; i < 3; i++) arb_set_fmpq(y + i, e->vector[i], bits), arb_set_fmpq(y + 3 + i, e->unit[i], bits);
    arb_dot(length, NULL, 0, y + 3, 1, y + 3, 1, 3, bits);
    arb_dot(along, NULL, 0, y, 1, y + 3, 1, 3, bits);
    arb_div(along, along, length, bits);
    arb_rsqrt(length, length, bits);
    for (int i = 0; i < 3; i++) {
        arb_submul(y + i, along, y + 3 + i, bits);
        arb_mul(y + 3 + i, y + 3 + i, length, bits);
    }
    if (e->model == ISO_POINT) {
        energies_of_point(e, b, y);
    } else {
        energy_of_ball(b, y, b->h);
        arb_div(b->eps, b->h, b->kappa, bits);
    }
    if (model != e->model) certify_map(b, e->model, y, y);
}

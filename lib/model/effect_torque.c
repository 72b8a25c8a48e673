/* effect_torque.c - a torque MQ(omega, n, e) on the ball as the scene writes it, in axes of the body.
 *
 * e is the vertical of gravity. The scene may say whether the torque does work. If it does not say, the power
 * (MQ,omega) is computed at random states, some of them at the n of the start: a torque may be large there alone. It is
 * analytic: if it is 0 at all of them, it is taken for 0 everywhere. Nothing follows where the torque itself is 0, which
 * may be below the range of doubles there, or where it is hardly anywhere a number.
 */
#include <math.h>

#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "model/written_impl.h"

enum { COMPONENTS = 3, SAMPLES = 200, AT_START = 20, ENOUGH = 10, MEASURE = -1 };

static const double *numbers_of(const iso_problem *f)
{
    return f->effects.number[ISO_TORQUE];
}

static void motion_of(iso_formula *F, const iso_problem *f, int i)
{
    const double axis[3] = {i == 0, i == 1, i == 2};
    iso_writer w;
    if (!iso_writer_begin(&w, F, f, ISO_TORQUE, i, formula_n(F)) || iso_expression_is_zero(&w.e)) return;
    w.most = ISO_LINEAR;                                                          /* no slopes are asked for */
    if (f->at[ISO_GRAVITY] > 0) w.vertical = vector_state(F, f->at[ISO_GRAVITY]); /* else e = n, on a plane */
    const iso_scalar M = iso_writer_value(&w);
    add_torque(F, iso_writer_over_energy(&w), scale_c(F, M, constants(F, 3, axis)));
}

static void motion(iso_formula *F, const iso_problem *f)
{
    for (int i = 0; i < COMPONENTS; i++) motion_of(F, f, i);
}

static double strength(const iso_problem *f, const double y[])
{
    (void)y;
    return numbers_of(f)[ISO_WRITTEN_STRENGTH];
}

/* --- work ------------------------------------------------------------------------------------------------------- */

/* What `work` is until it is measured, if the scene does not say it. */
static const double to_be_measured = MEASURE;

/* In the order of iso_work. */
static ISO_NAMES(work_name, int, "any", "none", "lost")

    static iso_work work(const iso_problem *f)
{
    const double stated = numbers_of(f)[ISO_WRITTEN_WORK];
    return stated < 0 ? ISO_WORK_UNKNOWN : (iso_work)stated;
}

/* What is found at random states: the most power that the torque gives and takes, over |MQ| |omega|; its largest size
 * at rest. */
typedef struct found {
    double gives, takes, strength;
    int acts, rests;     /* at how many states there is a torque; it is 0 */
    double y[ISO_STATE]; /* where it gives or takes most */
} found;

/* Where it stands in space does not matter: e is any direction, but n on a plane that has no other. n: NULL for a
 * random one. */
static void random_state(iso_random *r, const iso_problem *f, const double n[3], double y[])
{
    const double speed = pow(10, iso_random_uniform(r, -2, 2));
    iso_random_direction(r, y + 3);
    if (n) copy(n, y + 3, 3);
    iso_random_direction(r, y);
    for (int pass = 0; pass < 2 && !iso_effects_twist(&f->effects); pass++) remove_along(y, y + 3);
    scale(y, speed / norm(y));
    if (f->at[ISO_GRAVITY] > 0) iso_random_direction(r, y + f->at[ISO_GRAVITY]);
}

static void measure(const iso_problem *f, const iso_formula *F, const double n[3], found *w)
{
    iso_random *r = iso_random_create(1);
    double y[ISO_MAX_STATE] = {0}, T[3], dy[ISO_MAX_STATE];
    *w = (found){0};
    for (int i = 0; r && i < SAMPLES + AT_START; i++) {
        random_state(r, f, i < SAMPLES ? NULL : n, y);
        copy((const double[]){0, 0, 0}, T, 3);
        iso_formula_rates(F, &f->p, y, T, dy);
        const double size = norm(T) * norm(y), power = size > 0 ? dot(T, y) / size : 0;
        if (!isfinite(size)) continue;
        if (size > 0)
            w->acts++;
        else
            w->rests++;
        if (fabs(power) > fmax(w->gives, w->takes)) copy(y, w->y, ISO_STATE);
        w->gives = fmax(w->gives, power);
        w->takes = fmax(w->takes, -power);
        copy((const double[]){0, 0, 0}, y, 3);
        copy(y, T, 3);
        iso_formula_rates(F, &f->p, y, T, dy);
        if (isfinite(norm(T))) w->strength = fmax(w->strength, norm(T));
    }
    iso_random_free(r);
}

static iso_status check_work(iso_context *ctx, const found *w, double *stated)
{
    const double rounding = 1e-12;
    const bool gives = w->gives > rounding, takes = w->takes > rounding;
    const bool known = w->acts >= ENOUGH && w->rests == 0;
    if (*stated == MEASURE) *stated = gives || takes || !known ? ISO_WORK_UNKNOWN : ISO_WORK_NONE;
    if (*stated == ISO_WORK_UNKNOWN || (!gives && (!takes || *stated == ISO_WORK_LOST))) return ISO_OK;
    return ISO_FAIL_INPUT(ctx, "work",
                          "'work' is %s, but this torque %s energy, for example with omega = (%s, %s, %s) and n = "
                          "(%s, %s, %s)",
                          work_name((int)*stated), gives ? "gives" : "takes", ISO_ROUNDED(w->y[0], 3),
                          ISO_ROUNDED(w->y[1], 3), ISO_ROUNDED(w->y[2], 3), ISO_ROUNDED(w->y[3], 3),
                          ISO_ROUNDED(w->y[4], 3), ISO_ROUNDED(w->y[5], 3));
}

/* --- what must hold --------------------------------------------------------------------------------------------- */

static iso_status check(iso_context *ctx, const iso_params *p, const double n[3], iso_effects *effects)
{
    iso_problem f = {.p = *p, .effects = *effects};
    iso_expression e;
    iso_formula F;
    found w;
    int zeros = 0;
    for (int i = 0; i < COMPONENTS; i++) {
        ISO_TRY(iso_written_check(ctx, p, effects, ISO_TORQUE, i, &e));
        zeros += iso_expression_is_zero(&e);
    }
    if (zeros == COMPONENTS) return ISO_FAIL_INPUT(ctx, "M", "a torque of 0 changes nothing: take the effect out");
    f.at[ISO_GRAVITY] = effects->on[ISO_GRAVITY] && !effects->idle[ISO_GRAVITY] ? ISO_STATE : 0;
    iso_formula_begin(&F, ISO_FORMULA_MOTION, false);
    motion(&F, &f);
    iso_formula_finish(&F, p);
    if (F.overrun) return ISO_OK; /* the model is refused */
    measure(&f, &F, n, &w);
    effects->number[ISO_TORQUE][ISO_WRITTEN_STRENGTH] = w.strength;
    return check_work(ctx, &w, &effects->number[ISO_TORQUE][ISO_WRITTEN_WORK]);
}

static const char *const expressions[] = {"M1", "M2", "M3", NULL};

static const iso_effect_number numbers[] = {
    ISO_WRITTEN_NUMBERS,
    {.name = "work",
     .at = ISO_WRITTEN_WORK,
     .count = 1,
     .kind = ISO_NUMBER_WORD,
     .initially = &to_be_measured,
     .word = work_name},
    {0},
};

const iso_effect iso_effect_torque = {
    .name = "torque",
    .doc = "a torque MQ(omega, n, e) as the scene writes it, in axes of the body",
    .breaks = "a torque that the scene writes has no potential in n",
    .work = work,
    .drives = "'torque' drives the ball, without end: it turns more than 10000 times as fast as at the start",
    .expressions = expressions,
    .expressions_key = "M",
    .written = 1,
    .numbers = numbers,
    .check = check,
    .motion = motion,
    .strength = strength,
};

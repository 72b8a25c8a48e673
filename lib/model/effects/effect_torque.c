/* effect_torque.c - a torque MQ(omega, n, e) on the ball as the scene writes it, in axes of the body.
 *
 * e is the vertical of gravity. The scene may say whether the torque does work. If it does not say, only the form of
 * the power (MQ,omega) tells (written_work.c). What the scene says is refused here if random states show that it is
 * false, some of them at the n of the start: a torque may be large there alone. They cannot show that it is true: where
 * the form does not show it, each step of an orbit tests it.
 */
#include <math.h>

#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/random_impl.h"
#include "base/vec3_impl.h"
#include "model/expression/written_impl.h"
#include "model/model_impl.h"

enum { COMPONENTS = 3, SAMPLES = 200, AT_START = 20, BY_FORM = -1 };

static const double *numbers_of(const iso_problem *f)
{
    return f->effects.number[ISO_TORQUE];
}

static void motion(iso_formula *F, const iso_problem *f)
{
    for (int i = 0; i < COMPONENTS; i++) {
        const double axis[3] = {i == 0, i == 1, i == 2};
        iso_writer w;
        if (!iso_writer_begin(&w, F, f, ISO_TORQUE, i, formula_n(F)) || iso_expression_is_zero(&w.e)) continue;
        w.most = ISO_LINEAR;                                                          /* no slopes are asked for */
        if (f->at[ISO_GRAVITY] > 0) w.vertical = vector_state(F, f->at[ISO_GRAVITY]); /* else e = n, on a plane */
        const iso_scalar M = iso_writer_value(&w);
        add_torque(F, iso_writer_over_energy(&w), scale_c(F, M, constants(F, 3, axis)));
    }
}

static double strength(const iso_problem *f, const double y[])
{
    (void)y;
    return numbers_of(f)[ISO_WRITTEN_STRENGTH];
}

/* --- work ------------------------------------------------------------------------------------------------------- */

/* What `work` is until its form is looked at, if the scene does not say it. */
static const double by_form = BY_FORM;

/* In the order of iso_work. */
static ISO_NAMES(work_name, int, "any", "none", "lost")

    static iso_work work(const iso_problem *f)
{
    const double stated = numbers_of(f)[ISO_WRITTEN_WORK];
    return stated < 0 ? ISO_WORK_UNKNOWN : (iso_work)stated;
}

/* What is found at random states: whether it gives and takes energy; the states where it does. Its largest size at
 * rest. */
typedef struct found {
    bool gives, takes;
    double at_gives[ISO_STATE], at_takes[ISO_STATE], strength;
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

/* claimed: what gives and takes energy is asked for as well. */
static void measure(const iso_problem *f, const iso_expression e[], const double n[3], bool claimed, found *w)
{
    iso_random *r = iso_random_create(1);
    const double J = numbers_of(f)[ISO_WRITTEN_J], W = numbers_of(f)[ISO_WRITTEN_W];
    double y[ISO_MAX_STATE] = {0}, M[COMPONENTS], unused;
    *w = (found){0};
    for (int i = 0; r && i < SAMPLES + AT_START; i++) {
        random_state(r, f, i < SAMPLES ? NULL : n, y);
        iso_expression_state s = iso_written_state(f, ISO_TORQUE, y);
        const int works = claimed ? iso_written_works(e, &s) : 0;
        if (works > 0) w->gives = true, copy(y, w->at_gives, ISO_STATE);
        if (works < 0) w->takes = true, copy(y, w->at_takes, ISO_STATE);
        copy((const double[]){0, 0, 0}, s.omega, 3);
        for (int j = 0; j < COMPONENTS; j++) M[j] = iso_expression_value(&e[j], &s, &unused);
        const double size = norm(M) / (J * W * W);
        if (isfinite(size)) w->strength = fmax(w->strength, size);
    }
    iso_random_free(r);
}

/* --- what must hold --------------------------------------------------------------------------------------------- */

static iso_status check(iso_context *ctx, const iso_params *p, const double n[3], iso_effects *effects)
{
    iso_problem f = {.p = *p, .effects = *effects};
    iso_expression e[COMPONENTS];
    found w;
    int zeros = 0;
    for (int i = 0; i < COMPONENTS; i++) {
        ISO_TRY(iso_written_check(ctx, p, effects, ISO_TORQUE, i, &e[i]));
        zeros += iso_expression_is_zero(&e[i]);
    }
    if (zeros == COMPONENTS) return ISO_FAIL_INPUT(ctx, "M", "a torque of 0 changes nothing: take the effect out");
    f.at[ISO_GRAVITY] = effects->on[ISO_GRAVITY] && !effects->idle[ISO_GRAVITY] ? ISO_STATE : 0;
    double *stated = &effects->number[ISO_TORQUE][ISO_WRITTEN_WORK];
    const iso_work shown = iso_written_work(&f);
    if (*stated == BY_FORM) *stated = shown;
    const bool claimed = (int)*stated != (int)shown && (int)*stated != ISO_WORK_UNKNOWN;
    measure(&f, e, n, claimed, &w);
    effects->number[ISO_TORQUE][ISO_WRITTEN_STRENGTH] = w.strength;
    if (!claimed || (!w.gives && (!w.takes || *stated == ISO_WORK_LOST))) return ISO_OK;
    const double *y = w.gives ? w.at_gives : w.at_takes;
    return ISO_FAIL_INPUT(ctx, "work",
                          "'work' is %s, but this torque %s energy, for example with omega = (%s, %s, %s) and n = "
                          "(%s, %s, %s)",
                          work_name((int)*stated), w.gives ? "gives" : "takes", ISO_ROUNDED(y[0], 3),
                          ISO_ROUNDED(y[1], 3), ISO_ROUNDED(y[2], 3), ISO_ROUNDED(y[3], 3), ISO_ROUNDED(y[4], 3),
                          ISO_ROUNDED(y[5], 3));
}

static const char *const expressions[] = {"M1", "M2", "M3", NULL};

static const iso_effect_number numbers[] = {
    ISO_WRITTEN_NUMBERS,
    {.name = "work",
     .at = ISO_WRITTEN_WORK,
     .count = 1,
     .kind = ISO_NUMBER_WORD,
     .initially = &by_form,
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

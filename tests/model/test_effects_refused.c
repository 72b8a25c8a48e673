/* Numbers and combinations of effects that make no sense are refused, about the number or the effect; numbers that are
 * nearly right are made exact. */
#include "effects.h"

static iso_context *ctx;

/* Effects that are fine with k = 0.5 and with a tilted plane. */
static iso_effects sound;

static void make_sound(void)
{
    static const double number[ISO_EFFECTS][ISO_EFFECT_NUMBERS] = {
        [ISO_GRAVITY] = {0.7, 0, 0.6, 0.8},
        [ISO_FIELD] = {1, 2, 3, 2, 4, 5, 3, 5, 6, 1, 0, 0},
        [ISO_LEVEL] = {-0.3},
        [ISO_TWIST] = {10},
        [ISO_ROLLING_RESISTANCE] = {0.01},
        [ISO_ROTOR] = {0.3, -0.2, 0.5},
        [ISO_POTENTIAL] = {0.3, 0.1},
        [ISO_TORQUE] = {0.1, 0.2},
        [ISO_ATTITUDE] = {0.5, 0.5, 0.5, -0.5},
    };
    sound = effects_text(false);
    for (int e = 0; e < ISO_EFFECTS; e++)
        for (int i = 0; i < ISO_EFFECT_NUMBERS; i++)
            if (number[e][i] != 0) sound.number[e][i] = number[e][i];
}

static const double start[ISO_STATE] = {0.9, -0.3, 0, 0, 0, 1};

/* Tries effects with the one in question on: refused about `field`, or accepted (NULL). */
static void attempt(const char *what, double k, double D, iso_effect_id id, iso_effects e, const char *field)
{
    iso_params p = laws_params(k, laws_J[0]);
    if (D > 0) iso_params_set_D(ctx, D, &p);
    e.on[id] = true;
    const iso_status status = iso_effects_check(ctx, &p, start, &e);
    if (!field) gsl_test(status != ISO_OK, "%s is accepted: %s", what, status ? iso_context_message(ctx) : "");
    if (!field) return;
    gsl_test(status != ISO_BAD_INPUT || strcmp(iso_context_about(ctx), field) != 0,
             "%s is refused about %s: '%s', %s", what, field,
             status == ISO_BAD_INPUT ? iso_context_about(ctx) : "not refused", iso_context_message(ctx));
}

/* One number changed: x[index] of the sound effects, in every way that is wrong. */
static void attempt_number(iso_effect_id id, const char *number, int index, double value, const char *field)
{
    iso_effects e = sound;
    iso_effect_number n;
    for (int i = 0; iso_effect_number_at(&sound, id, i, &n); i++)
        if (strcmp(n.name, number) == 0) iso_effect_values(&e, id, &n)[index] = value;
    char what[64];
    snprintf(what, sizeof what, "%s %s[%d] = %g", iso_effect_list[id]->name, number, index, value);
    attempt(what, 0.5, 0.3, id, e, field);
    if (!field) return;
    e.on[id] = false; /* numbers of effects that are off are not read */
    attempt("what is off", 0.5, 0.3, ISO_CLOCK, e, NULL);
}

static void refused_numbers(void)
{
    for (iso_effect_id id = 0; id < ISO_EFFECTS; id++) {
        attempt(iso_effect_list[id]->name, 0.5, 0.3, id, sound, NULL);
        iso_effect_number n;
        for (int j = 0; iso_effect_number_at(&sound, id, j, &n); j++)
            for (int i = 0; i < n.count; i++) {
                attempt_number(id, n.name, i, NAN, n.name);
                attempt_number(id, n.name, i, INFINITY, n.name);
                attempt_number(id, n.name, i, -INFINITY, n.name);
            }
    }
    attempt_number(ISO_GRAVITY, "mgb", 0, 0, "gravity");
    attempt_number(ISO_GRAVITY, "mgb", 0, -0.7, NULL); /* b < 0: inside, shell */
    attempt_number(ISO_GRAVITY, "up", 2, 0.81, "up");
    attempt_number(ISO_GRAVITY, "up", 2, 0.8 + 2e-6, "up");
    attempt_number(ISO_GRAVITY, "up", 2, 0.8 + 1e-6, NULL);
    attempt_number(ISO_FIELD, "quadratic", 1, 2.1, "quadratic");
    attempt_number(ISO_FIELD, "quadratic", 6, 3 + 1e-10, "quadratic");
    attempt_number(ISO_FIELD, "quadratic", 5, 5 + 1e-15, NULL);
    attempt_number(ISO_LEVEL, "c", 0, 0, "c");
    attempt_number(ISO_LEVEL, "c", 0, 0.3, NULL);
    attempt_number(ISO_TWIST, "resistance", 0, -1e-3, "resistance");
    attempt_number(ISO_TWIST, "resistance", 0, 0, NULL); /* the classical ball */
    attempt_number(ISO_ROLLING_RESISTANCE, "coefficient", 0, 0, "coefficient");
    attempt_number(ISO_ROLLING_RESISTANCE, "coefficient", 0, -1, "coefficient");
    attempt_number(ISO_ROTOR, "momentum", 0, 0, NULL);
    attempt_number(ISO_ATTITUDE, "quaternion", 0, 0.50001, "quaternion");
    attempt_number(ISO_ATTITUDE, "quaternion", 0, -0.5, NULL);
}

static void refused_combinations(void)
{
    iso_effects e = sound, constant = sound;
    for (int i = 0; i < 9; i++) FIELD_QUADRATIC(&constant)[i] = i % 4 == 0 ? 2.5 : 0;
    for (int i = 0; i < 3; i++) FIELD_LINEAR(&constant)[i] = 0;
    attempt("a constant field", 0.5, 0, ISO_FIELD, constant, "field");
    FIELD_LINEAR(&constant)[2] = 1e-9;
    attempt("a field that is linear", 0.5, 0, ISO_FIELD, constant, NULL);
    FIELD_LINEAR(&constant)[2] = 0, FIELD_QUADRATIC(&constant)[4] = 2.4;
    attempt("a field that is diagonal", 0.5, 0, ISO_FIELD, constant, NULL);
    FIELD_QUADRATIC(&constant)[4] = 2.5, FIELD_QUADRATIC(&constant)[1] = FIELD_QUADRATIC(&constant)[3] = 0.1;
    attempt("a field that is off the diagonal", 0.5, 0, ISO_FIELD, constant, NULL);
    attempt("twist without D", 0.5, 0, ISO_TWIST, sound, "twist");
    attempt("reactions without D", 0.5, 0, ISO_REACTIONS, sound, "reactions");
    attempt("gravity on a tilted plane", 1, 0, ISO_GRAVITY, sound, NULL);
    for (int side = -1; side <= 1; side += 2) {
        copy((const double[]){0, 0, side}, GRAVITY_UP(&e), 3);
        e.on[ISO_REACTIONS] = false;
        attempt("gravity on a horizontal plane", 1, 0.3, ISO_GRAVITY, e, "gravity");
        attempt("gravity at the top of a sphere", 0.5, 0.3, ISO_GRAVITY, e, NULL);
        e.on[ISO_REACTIONS] = true;
        attempt("gravity on a horizontal plane with reactions", 1, 0.3, ISO_GRAVITY, e, NULL);
    }
}

/* Vectors that are nearly unit come back as unit vectors, a matrix nearly symmetric as a symmetric one. */
static void made_exact(void)
{
    const iso_params p = laws_params(0.5, laws_J[0]);
    iso_effects e = sound;
    e.on[ISO_GRAVITY] = e.on[ISO_FIELD] = e.on[ISO_ATTITUDE] = true;
    scale(GRAVITY_UP(&e), 1 + 9e-7);
    for (int i = 0; i < 4; i++) QUATERNION(&e)[i] *= 1 - 9e-7;
    FIELD_QUADRATIC(&e)[1] += 1e-13;
    gsl_test(iso_effects_check(ctx, &p, start, &e) != ISO_OK, "nearly right is accepted");
    for (int i = 0; i < 3; i++)
        gsl_test_rel(GRAVITY_UP(&e)[i], GRAVITY_UP(&sound)[i], 4 * DBL_EPSILON, "up made a unit vector");
    for (int i = 0; i < 4; i++)
        gsl_test_rel(QUATERNION(&e)[i], QUATERNION(&sound)[i], 4 * DBL_EPSILON, "quaternion made a unit one");
    gsl_test(FIELD_QUADRATIC(&e)[1] != FIELD_QUADRATIC(&e)[3], "C made symmetric");
}

int main(void)
{
    ctx = iso_context_create();
    make_sound();
    refused_numbers();
    refused_combinations();
    made_exact();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

/* effect_integrals.c - integrals as the scene writes them: expressions in omega, n and e that somebody claims to be
 * constant along an orbit.
 *
 * Nothing acts, and nothing follows from the claim. The rows stand in the tables of integrals, so that whatever reports
 * the drift of an integral reports theirs. On the point an integral is that of the ball at the image of the state.
 */
#include <math.h>

#include "model/expression/written_impl.h"
#include "model/integrals_impl.h"

static const char *const names[] = {"F", "F2", "F3", NULL};

static double value_of(const iso_problem *f, const double ball[], int which, double *size)
{
    iso_expression e;
    if (!iso_written_read(&f->effects, ISO_INTEGRALS, which, &e)) return *size = NAN;
    const iso_expression_state s = iso_written_state(f, ISO_INTEGRALS, ball);
    return iso_expression_value(&e, &s, size);
}

#define WRITTEN(i)                                                                                                   \
    static bool is_written##i(const iso_problem *f)                                                                  \
    {                                                                                                                \
        return iso_written_has(&f->effects, ISO_INTEGRALS, i);                                                       \
    }                                                                                                                \
    ISO_OF_BALL_AND_POINT(F##i, value_of(f, ball, i, size))

WRITTEN(0)
WRITTEN(1)
WRITTEN(2)

/* The value is in the units of the scene. */
#define ROW(i, name_, of)                                                                                            \
    ISO_INTEGRAL(name_, 0, 0, 0, F##i##of, .holds = is_written##i, .claimed = true,                                  \
                 .doc = "claimed by the scene, proved by nobody")
#define ROWS(of)                                                                                                     \
    {                                                                                                                \
        ROW(0, "F", of), ROW(1, "F2", of), ROW(2, "F3", of),                                                         \
        {                                                                                                            \
            0                                                                                                        \
        }                                                                                                            \
    }
static const iso_integral integrals[] = ROWS(), image_integrals[] = ROWS(_of_point);

static iso_status check(iso_context *ctx, const iso_params *p, const double n[3], iso_effects *effects)
{
    (void)n;
    for (int i = 0; i < ISO_EXPRESSIONS; i++) {
        const char *name = names[i];
        iso_expression e;
        if (!iso_written_has(effects, ISO_INTEGRALS, i)) continue;
        ISO_TRY(iso_written_check(ctx, p, effects, ISO_INTEGRALS, i, &e));
        if (e.node[e.root].degree == ISO_CONSTANT)
            return ISO_FAIL_INPUT(ctx, name, "%s is the same number at every state: take it out", name);
        if (e.reads[ISO_TERM_E] && effects->idle[ISO_GRAVITY])
            return ISO_FAIL_INPUT(ctx, name, "%s reads e, which is n here, on a horizontal plane: write n1, n2, n3",
                                  name);
    }
    return ISO_OK;
}

static const iso_effect_number numbers[] = {ISO_WRITTEN_UNITS, {0}};

const iso_effect iso_effect_integrals = {
    .name = "integrals",
    .doc = "integrals F(omega, n, e) as the scene writes them: their drift is watched",
    .observes = true,
    .expressions = names,
    .written = 2,
    .numbers = numbers,
    .check = check,
    .integrals = integrals,
    .image_integrals = image_integrals,
};

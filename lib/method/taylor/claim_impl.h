/* claim_impl.h - whether a step of lanes is an answer: its end is finite, and what the scene claims of a torque
 * holds. */
#include "method/taylor/crossing_impl.h"

/* Where a claim fails within the step, the lane's step ends there, and why[lane] says what is wrong. model: of each
 * lane; NULL: it has none. */
static void find_false_claims(const form *T, const iso_model *const model[LANES], real *length,
                              const char *why[LANES])
{
    const real whole = *length;
    for (int i = 0; i <= ISO_CLAIM_PLACES; i++) {
        state s;
        const real x = whole * ((NUMBER)i / ISO_CLAIM_PLACES);
        find_state(T, x, NULL, &s);
        for (int lane = 0; lane < LANES; lane++) {
            double y[ISO_MAX_STATE];
            char where[ISO_BLAME_SIZE];
            if (!model[lane] || why[lane]) continue;
            store(T, lane, &s, y);
            why[lane] = iso_model_false_claim(model[lane], y, where);
            if (why[lane]) LANE(*length, lane) = LANE(x, lane);
        }
    }
}

/* 0 in a lane whose state is finite, else NaN. */
static inline real zero_if_finite(const form *T, const state *s)
{
    real sum = zero;
    for (int i = 0; i < 3; i++) sum += s->n[i] + s->w[i];
    for (int i = 0; i < T->shape.moving - ISO_STATE; i++) sum += s->own[i];
    for (int i = 0; i < T->shape.clocks; i++) sum += s->clock[T->shape.clock_of[i]];
    return sum - sum;
}

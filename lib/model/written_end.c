/* written_end.c - why a motion may have ended: what the effects that the scene writes are where it did. */
#include <math.h>
#include <stdio.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "model/written_impl.h"

/* The reason is an expression that is nearer than NEAR to where it is not defined, or a torque that changes omega more
 * than STRONG times as fast as the ball turns. */
#define NEAR 1e-3
#define STRONG 1e6

/* The expression that is nearest to where it is not defined. */
static bool blame_expression(const iso_problem *f, iso_effect_id id, const double ball[], char text[])
{
    const iso_effect *effect = iso_effect_list[id];
    const iso_expression_state s = iso_written_state(f, id, ball);
    iso_expression e;
    double least = NEAR;
    for (int i = 0; effect->expressions[i]; i++) {
        if (!iso_written_has(&f->effects, id, i) || !iso_written_read(&f->effects, id, i, &e)) continue;
        const double margin = iso_expression_margin(&e, &s);
        if (!(margin < least)) continue;
        least = margin;
        snprintf(text, ISO_BLAME_SIZE, "; there %s of '%s' has, in column %d of the text, %s", effect->expressions[i],
                 effect->name, e.at + 1, e.wrong);
    }
    return least < NEAR;
}

static void blame_strength(const iso_problem *f, iso_effect_id id, const double ball[], char text[])
{
    iso_problem alone = *f;
    iso_formula F;
    double T[3] = {0}, dy[ISO_MAX_STATE];
    for (int e = 0; e < ISO_EFFECTS; e++) alone.effects.on[e] = e == (int)id;
    iso_effects_record_motion(&alone, false, &F);
    iso_formula_rates(&F, &f->p, ball, T, dy);
    const double times = norm(T) / (max3(f->p.J) * dot(ball, ball));
    if (times > STRONG)
        snprintf(text, ISO_BLAME_SIZE, "; there '%s' changes omega %s times as fast as the ball turns",
                 iso_effect_list[id]->name, ISO_ROUNDED(times, 2));
}

void iso_model_blame(const iso_model *m, const double y[], char text[ISO_BLAME_SIZE])
{
    const iso_problem *f = &m->problem;
    double ball[ISO_MAX_STATE];
    copy(y, ball, m->dim);
    if (m->system == &iso_system_point) iso_point_to_point_t(&f->p, y, ball), iso_point_t_to_ball(&f->p, ball, ball);
    text[0] = '\0';
    for (iso_effect_id e = 0; e < ISO_EFFECTS && !text[0]; e++)
        if (iso_effect_acts(&f->effects, e) && iso_effect_list[e]->expressions)
            if (!blame_expression(f, e, ball, text)) blame_strength(f, e, ball, text);
}

/* written_end.c - why a motion may have ended, or cannot begin: what the effects that the scene writes are there. */
#include <math.h>
#include <stdio.h>

#include "base/number_impl.h"
#include "base/vec3_impl.h"
#include "model/expression/written_impl.h"
#include "model/model_impl.h"

/* The reason is an expression that is nearer than NEAR to where it is not defined, or a torque that changes omega more
 * than STRONG times as fast as the ball turns. */
#define NEAR 1e-3
#define STRONG 1e6

/* The expression that is nearest to where it is not defined: which one, and in *nearest why. -1: none is near. */
static int find_nearest(const iso_problem *f, iso_effect_id id, const double ball[], iso_expression *nearest)
{
    const iso_expression_state s = iso_written_state(f, id, ball);
    iso_expression e;
    double least = NEAR;
    int which = -1;
    for (int i = 0; iso_effect_list[id]->expressions[i]; i++) {
        if (!iso_written_has(&f->effects, id, i) || !iso_written_read(&f->effects, id, i, &e)) continue;
        const double margin = iso_expression_margin(&e, &s);
        if (!(margin < least)) continue;
        least = margin;
        *nearest = e;
        which = i;
    }
    return which;
}

/* Whether the effect, alone, is the reason. */
static void blame(const iso_problem *f, iso_effect_id id, const double ball[], char text[])
{
    iso_expression e;
    iso_formula F;
    double T[3] = {0}, dy[ISO_MAX_STATE];
    const iso_effect *effect = iso_effect_list[id];
    const int which = find_nearest(f, id, ball, &e);
    if (which >= 0) {
        snprintf(text, ISO_BLAME_SIZE, "; there %s of '%s' has, in column %d of the text, %s",
                 effect->expressions[which], effect->name, e.at + 1, e.wrong);
        return;
    }
    iso_problem alone = *f;
    for (int i = 0; i < ISO_EFFECTS; i++) alone.effects.on[i] = i == (int)id;
    iso_effects_record_motion(&alone, false, &F);
    iso_formula_rates(&F, &f->p, ball, T, dy);
    const double times = norm(T) / (max3(f->p.J) * dot(ball, ball));
    if (times > STRONG)
        snprintf(text, ISO_BLAME_SIZE, "; there '%s' changes omega %s times as fast as the ball turns", effect->name,
                 ISO_ROUNDED(times, 2));
}

void iso_model_blame(const iso_model *m, const double y[], char text[ISO_BLAME_SIZE])
{
    const iso_problem *f = &m->problem;
    double ball[ISO_MAX_STATE];
    copy(y, ball, m->dim);
    if (m->system == &iso_system_point)
        iso_point_to_point_in_t(&f->p, y, ball), iso_point_in_t_to_ball(&f->p, ball, ball);
    text[0] = '\0';
    if (iso_model_false_claim(m, y, text)) return;
    for (iso_effect_id e = 0; e < ISO_EFFECTS && !text[0]; e++)
        if (iso_effect_acts(&f->effects, e) && iso_effect_list[e]->expressions) blame(f, e, ball, text);
}

iso_status iso_written_refuse_start(iso_context *ctx, const iso_problem *f, iso_effect_id id, const double ball[])
{
    const iso_effect *effect = iso_effect_list[id];
    const iso_expression_state s = iso_written_state(f, id, ball);
    iso_expression e;
    double size;
    char why[ISO_BLAME_SIZE] = "", omega[ISO_BLAME_SIZE] = "", torque[ISO_BLAME_SIZE];
    const int nearest = find_nearest(f, id, ball, &e);
    const char *name = effect->expressions[nearest < 0 ? 0 : nearest];
    snprintf(torque, sizeof torque, "the torque of '%s'", effect->name);
    const bool slope = nearest >= 0 && effect->potential && isfinite(iso_expression_value(&e, &s, &size));
    if (nearest >= 0) snprintf(why, sizeof why, ": in column %d of the text, %s", e.at + 1, e.wrong);
    if (!effect->potential)
        snprintf(omega, sizeof omega, "omega = (%s, %s, %s) and ", ISO_SHORT(s.omega[0]), ISO_SHORT(s.omega[1]),
                 ISO_SHORT(s.omega[2]));
    return ISO_FAIL_INPUT(ctx, effect->expressions_key ? effect->expressions_key : name,
                          "%s%s is not a finite number where the ball starts, at %sn = (%s, %s, %s)%s",
                          slope ? "the slope of " : "", nearest < 0 ? torque : name, omega, ISO_SHORT(s.n[0]),
                          ISO_SHORT(s.n[1]), ISO_SHORT(s.n[2]), why);
}

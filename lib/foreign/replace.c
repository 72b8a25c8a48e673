/* replace.c - a scene with another k, J or start: what each orbit of a batch (batch.c) is by itself. */
#include <math.h>

#include "base/arithmetic_impl.h"
#include "foreign/foreign_impl.h"

iso_status iso_foreign_replace_params(iso_context *ctx, const iso_scene *s, const double *k, const double J[3],
                                      iso_params *params)
{
    *params = s->params;
    if (!k && !J) return ISO_OK;
    const iso_status status = iso_params_reduced(ctx, k ? *k : s->params.k, J ? J : s->params.J, params);
    return status == ISO_OK && s->params.D > 0 ? iso_params_set_D(ctx, s->params.D, params) : status;
}

iso_status iso_foreign_replace_start(iso_context *ctx, const iso_scene *s, const double y[6], iso_start *start)
{
    *start = s->start;
    if (!y) return ISO_OK;
    if (s->start.model == ISO_BALL)
        return iso_start_ball(ctx, y, y + 3, s->effects.on[ISO_TWIST] ? ISO_SPIN_KEEP : ISO_SPIN_REFUSE, start);
    return iso_start_point(ctx, y, y + 3, isnan(s->start.eps) ? NULL : &s->start.eps, false, start);
}

iso_status iso_foreign_scene_replace(iso_context *ctx, iso_foreign_scene *scene, const double *k, const double J[3],
                                     const double start[6])
{
    ISO_DEFAULT_ARITHMETIC;
    iso_params params;
    iso_start y;
    iso_status status = iso_foreign_replace_params(ctx, &scene->scene, k, J, &params);
    if (status == ISO_OK) status = iso_foreign_replace_start(ctx, &scene->scene, start, &y);
    if (status != ISO_OK) return status;
    scene->scene.params = params;
    scene->scene.start = y;
    return ISO_OK;
}

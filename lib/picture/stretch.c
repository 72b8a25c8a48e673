/* stretch.c - the first turns of an orbit (see picture_impl.h). */
#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "orbit/orbit_impl.h"
#include "picture/picture_impl.h"

#define NEAR 0.03 /* radians between neighbours on a curve, about          */
#define FAR 0.06  /* farther ones are not taken: the step is divided by 4  */
#define FIRST 0x1p-40
enum { T, S, N, GAMMA = N + 3, COLUMNS = GAMMA + 3, MOST = 4000 /* of a curve */ };

typedef struct pair {
    iso_context *ctx;
    iso_orbit *ball, *point;
} pair;

static iso_status open_one(iso_context *ctx, const iso_scene *scene, iso_backend backend, iso_orbit **orbit)
{
    const iso_effects effects = iso_scene_acting(scene);
    iso_orbit_options o = iso_orbit_defaults(&scene->start);
    o.effects = &effects;
    o.backend = backend;
    o.tolerance = scene->tolerance;
    o.clock = ISO_CLOCK_T;
    o.shown = ISO_SHOW_BOTH;
    o.with_clock[ISO_CLOCK_S] = true;
    return iso_orbit_create(ctx, &scene->params, &scene->start, &o, orbit);
}

static iso_status find(const pair *p, double t, double row[COLUMNS])
{
    iso_sample ball, point;
    ISO_TRY(iso_orbit_at(p->ball, t, &ball));
    ISO_TRY(iso_orbit_at(p->point, t, &point));
    row[T] = t, row[S] = point.clock[ISO_CLOCK_S];
    for (int i = 0; i < 3; i++) row[N + i] = ball.ball[3 + i], row[GAMMA + i] = point.point[3 + i];
    return ISO_OK;
}

/* Steps of t that follow the speed on both spheres. *end becomes the time where the turns end. */
static iso_status follow(const pair *p, double *end, iso_record *curve)
{
    const double whole = *end, length = 2 * ISO_PI * ISO_STRETCH_TURNS;
    double last[COLUMNS], next[COLUMNS], step = FIRST * whole, moved = 0;
    ISO_TRY(find(p, 0, last));
    ISO_TRY(iso_record_add(p->ctx, curve, 1, last));
    while (fabs(last[T]) < fabs(whole) && moved < length && iso_record_rows(curve) < MOST) {
        const double t = fabs(last[T] + step) < fabs(whole) ? last[T] + step : whole;
        ISO_TRY(find(p, t, next));
        const double turned = angle_between(last + N, next + N);
        const double most = fmax(turned, angle_between(last + GAMMA, next + GAMMA));
        step *= fmin(fmax(NEAR / most, 0.25), 4);
        if (most > FAR) continue;
        moved += turned;
        ISO_TRY(iso_record_add(p->ctx, curve, 1, next));
        for (int i = 0; i < COLUMNS; i++) last[i] = next[i];
    }
    *end = last[T];
    return ISO_OK;
}

iso_status iso_picture_stretch(iso_context *ctx, const iso_scene *scene, double end, iso_record **states,
                               iso_record **curve)
{
    static const char *const names[] = {"t", "s", "n1", "n2", "n3", "gamma1", "gamma2", "gamma3"};
    const iso_effects acting = iso_scene_acting(scene);
    pair p = {ctx, NULL, NULL};
    *curve = *states = NULL;
    ISO_TRY(iso_record_create(ctx, COLUMNS, names, curve));
    ISO_TRY(iso_record_create(ctx, COLUMNS, names, states));
    iso_record_set_kind(*curve, "curve");
    iso_record_set_kind(*states, "compare"); /* which reads these lines: */
    ISO_TRY(iso_record_set_numbers(ctx, *states, "k", 1, &scene->params.k));
    ISO_TRY(iso_record_set_numbers(ctx, *states, "J", 3, scene->params.J));
    ISO_TRY(iso_record_set_numbers(ctx, *states, "compared", 1, &end));
    ISO_TRY(iso_record_set(ctx, *states, "field", iso_effects_have_image(&acting) ? "1" : "0"));
    iso_status status = open_one(ctx, scene, ISO_BACKEND_BALL, &p.ball);
    if (status == ISO_OK) status = open_one(ctx, scene, ISO_BACKEND_POINT, &p.point);
    if (status == ISO_OK) status = follow(&p, &end, *curve);
    for (int i = 0; status == ISO_OK && i < ISO_STRETCH_STATES; i++) {
        double row[COLUMNS];
        status = find(&p, end * i / (ISO_STRETCH_STATES - 1), row);
        if (status == ISO_OK) status = iso_record_add(ctx, *states, 1, row);
    }
    iso_orbit_free(p.ball);
    iso_orbit_free(p.point);
    return status;
}

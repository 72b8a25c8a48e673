/* backend.c - which backend `auto` takes for a scene: the cheapest for its rows and its tolerance.
 *
 * Measured for a free ball by tests/bench/backends.c (lib/doc/performance.md), in microseconds on one machine, for a
 * radian by which n turns and for a row:
 *
 *                  radian    row
 *     ball         2         0.2
 *     point        0.85      0.5     k = -1;   1.7 and 0.4 for other k from 1/8 to 2;   as the ball beyond
 *     exact        0         2.5     and 200 to 800 at the start
 *
 * At tolerance 1e-12 the point's error at t = 1000 is as a rule a fourth of the ball's or less. At 1e-15, where both
 * are as exact as they can be, it is twice the ball's. The closed solution is more exact than both.
 */
#include <math.h>
#include <string.h>

#include "orbit/orbit_impl.h"
#include "task/run.h"
#include "task/task_impl.h"

#define FINEST_OF_POINT 1e-12 /* a tolerance: below it the ball is more exact */
#define LEAST_K 0.5           /* |k|: below it errors of the point are as large as the ball's, some larger */
#define MOST_K 2              /* |k|: beyond it steps of the point cost as much as the ball's */

enum { FAR = 2000 /* radians */, RADIANS_PER_FAR_ROW = 5 /* at least */, MOST_ROWS_PER_RADIAN = 2 };

typedef struct choice {
    iso_backend backend; /* ISO_BACKEND_AUTO: what iso_orbit_create takes for it */
    const char *why;
} choice;

/* may_exact: the closed solution may be taken. n turns at rate |k omega|, gamma at |M|. */
static choice choose(const iso_scene *scene, const iso_effects *effects, const iso_run_extent *extent, bool may_exact)
{
    const double *y = scene->start.y, rate = hypot(hypot(y[0], y[1]), y[2]); /* y^2 may overflow */
    const double rows = (double)extent->rows, k = fabs(scene->params.k),
                 radians = fabs(extent->farthest) * rate * (scene->start.model == ISO_BALL ? k : 1);
    if (scene->backend != ISO_BACKEND_AUTO) return (choice){scene->backend, "asked for by name"};
    if (strcmp(scene->method, "auto") != 0)
        return (choice){ISO_BACKEND_AUTO, "a method is given: the model that it is for, or that of the start"};
    if (!iso_effects_none(effects))
        return (choice){ISO_BACKEND_AUTO, "effects act: the ball where they need it, else the model of the start"};
    if (may_exact && radians >= FAR && rows * RADIANS_PER_FAR_ROW <= radians)
        return (choice){ISO_BACKEND_EXACT, "the rows are few and far: the closed solution needs no steps"};
    if (scene->start.model != ISO_BALL) return (choice){ISO_BACKEND_AUTO, "the model of the start"};
    if (scene->tolerance < FINEST_OF_POINT)
        return (choice){ISO_BACKEND_AUTO, "the model of the start: at tolerances below 1e-12 it is the most exact"};
    if (!(k >= LEAST_K && k <= MOST_K))
        return (choice){ISO_BACKEND_AUTO, "the model of the start: the point is not cheaper for this k"};
    if (rows > MOST_ROWS_PER_RADIAN * radians)
        return (choice){ISO_BACKEND_AUTO, "the model of the start: it is the cheapest for many rows in a turn"};
    return (choice){ISO_BACKEND_POINT, "the cheapest for at most 12 rows in a turn, and as exact"};
}

iso_status iso_backend_open(iso_context *ctx, const iso_scene *scene, const iso_orbit_options *how,
                            const iso_run_extent *extent, iso_orbit **orbit)
{
    iso_orbit_options o = *how;
    if (o.backend != ISO_BACKEND_AUTO) return iso_orbit_create(ctx, &scene->params, &scene->start, &o, orbit);
    const iso_backend first = choose(scene, o.effects, extent, true).backend;
    const iso_backend in_turn[] = {first, choose(scene, o.effects, extent, false).backend, ISO_BACKEND_AUTO};
    iso_status status = ISO_NUMERICAL;
    for (int i = first == ISO_BACKEND_EXACT ? 0 : 1; i < 3; i++) {
        o.backend = in_turn[i];
        status = iso_orbit_create(ctx, &scene->params, &scene->start, &o, orbit);
        if (status == ISO_OK && o.backend == ISO_BACKEND_EXACT) { /* it may refuse a far time */
            iso_sample sample;
            status = iso_orbit_at(*orbit, extent->farthest, &sample);
            if (status != ISO_OK) iso_orbit_free(*orbit), *orbit = NULL;
        }
        if (status == ISO_OK || status == ISO_NO_MEMORY || o.backend == ISO_BACKEND_AUTO) break;
    }
    return status;
}

const char *iso_scene_why_backend(const iso_scene *scene, const iso_orbit *orbit)
{
    const iso_backend taken = iso_orbit_backend(orbit);
    const iso_effects effects = iso_orbit_effects(orbit);
    const iso_run_extent grid = {.rows = iso_scene_rows(scene), .farthest = scene->end};
    choice c = choose(scene, &effects, &grid, true);
    if (c.backend == ISO_BACKEND_EXACT && taken != c.backend) c = choose(scene, &effects, &grid, false); /* refused */
    if (c.backend == ISO_BACKEND_POINT && taken != c.backend)
        return "the model of the start: this orbit has no point that can be integrated";
    return c.why;
}

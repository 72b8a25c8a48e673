/* test_backend.c - what `auto` takes for a scene: as exact as the ball, and never with what it cannot follow. */
#include "reference.h"
#include "task/run.h"

static iso_context *ctx;

static iso_scene scene_of(const reference *r, double end, double rows)
{
    iso_scene scene = iso_scene_default();
    scene.params = r->p;
    scene.start = r->start;
    scene.end = end;
    scene.step = end / rows;
    return scene;
}

/* The backend that is taken, and the largest error of (omega, n) at the end if `truth` is given. */
static iso_backend taken(const iso_scene *scene, const double truth[ISO_STATE], double *error)
{
    int columns[ISO_MAX_COLUMNS];
    const int count = iso_scene_column_list(scene, columns);
    iso_orbit *orbit;
    iso_sample s;
    double apart[ISO_STATE];
    if (iso_scene_orbit(ctx, scene, columns, count, &orbit) != ISO_OK ||
        iso_orbit_at(orbit, scene->end, &s) != ISO_OK) {
        gsl_test(1, "an orbit: %s", iso_context_message(ctx));
        return ISO_BACKEND_AUTO;
    }
    for (int i = 0; truth && i < ISO_STATE; i++) apart[i] = s.ball[i] - truth[i];
    if (truth) *error = laws_max(ISO_STATE, apart);
    const iso_backend backend = iso_orbit_backend(orbit);
    gsl_test(strlen(iso_scene_why_backend(scene, orbit)) < 10, "it says why");
    iso_orbit_free(orbit);
    return backend;
}

/* No reference row is worse than by the ball, beyond the rounding of the numbers themselves. */
static void check_references(void)
{
    reference rows[REFERENCE_ROWS];
    const int count = reference_read(ctx, rows);
    laws_worst worst = {0};
    int points = 0;
    for (int i = 0; i < count; i++) {
        double error[2];
        iso_scene scene = scene_of(&rows[i], rows[i].t, 1);
        points += taken(&scene, rows[i].ball, &error[0]) == ISO_BACKEND_POINT;
        scene.backend = ISO_BACKEND_BALL;
        taken(&scene, rows[i].ball, &error[1]);
        laws_note(&worst, error[0], fmax(error[1], 1e-15), &rows[i].p, "auto against the ball");
    }
    laws_report(&worst, "reference rows by auto");
    gsl_test(points < count / 2, "%d of %d rows by the point", points, count);
}

static void check_taken(const iso_scene *scene, iso_backend expected, const char *what)
{
    const iso_backend backend = taken(scene, NULL, NULL);
    gsl_test(backend != expected, "%s: backend %s, expected %s", what, iso_backend_name((int)backend),
             iso_backend_name((int)expected));
}

static void check_choice(const reference *shell, const reference *half)
{
    iso_scene scene = scene_of(shell, 100, 10);
    check_taken(&scene, ISO_BACKEND_POINT, "few rows");
    scene.tolerance = 1e-14;
    check_taken(&scene, ISO_BACKEND_BALL, "a fine tolerance");
    scene = scene_of(shell, 100, 10);
    strcpy(scene.method, "rk8pd");
    check_taken(&scene, ISO_BACKEND_BALL, "a method");
    scene = scene_of(shell, 100, 10);
    scene.backend = ISO_BACKEND_BALL;
    check_taken(&scene, ISO_BACKEND_BALL, "a name");
    scene = scene_of(shell, 100, 10);
    scene.effects.on[ISO_ROLLING_RESISTANCE] = true;
    scene.effects.number[ISO_ROLLING_RESISTANCE][0] = 0.01;
    check_taken(&scene, ISO_BACKEND_BALL, "an effect");
    scene = scene_of(shell, 100, 10000);
    check_taken(&scene, ISO_BACKEND_BALL, "many rows");
    scene = scene_of(shell, 1e5, 10);
    check_taken(&scene, ISO_BACKEND_EXACT, "few and far rows");
    scene.end = -1e5;
    check_taken(&scene, ISO_BACKEND_EXACT, "backwards");
    scene = scene_of(half, 1e4, 10);
    check_taken(&scene, ISO_BACKEND_POINT, "few and far rows without a closed solution");
    scene = scene_of(shell, 100, 10);
    memset(scene.start.y, 0, 3 * sizeof(double));
    check_taken(&scene, ISO_BACKEND_BALL, "a ball at rest, which has no point");
}

int main(void)
{
    reference rows[REFERENCE_ROWS], *shell = NULL, *half = NULL;
    ctx = iso_context_create();
    check_references();
    const int count = reference_read(ctx, rows);
    for (int i = 0; i < count; i++) {
        if (!shell && rows[i].p.k == -1) shell = &rows[i];
        if (!half && rows[i].p.k == 0.5) half = &rows[i];
    }
    check_choice(shell, half);
    iso_context_free(ctx);
    return gsl_test_summary();
}

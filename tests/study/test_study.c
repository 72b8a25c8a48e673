/* Both backends side by side (iso_compare). */
#include "studies.h"
#include "task/compare.h"

static iso_scene scene_of(double k, const double J[3], double end, double step)
{
    iso_scene scene = iso_scene_default();
    scene.params = laws_params(k, J);
    scene.start = (iso_start){.model = ISO_BALL, .y = {0.8, 0.5, -0.6, 0.6, 0, 0.8}};
    scene.end = end;
    scene.step = step;
    return scene;
}

/* Exactly the integrals that hold: h, omega.n, |n|, H, M.gamma, |gamma|, and those of k and J for both models. */
static void check_listed(const iso_comparison *c, const char *extra)
{
    for (int b = 0; b < c->runs; b++) {
        int of_extra = 0;
        for (int i = 0; i < c->run[b].drifts; i++) {
            const char *name = c->run[b].drift[i].integral->name;
            of_extra += name[0] == 'F' && extra && strcmp(name, extra) == 0;
            gsl_test(name[0] == 'F' && !(extra && strcmp(name, extra) == 0), "%s is listed", name);
        }
        gsl_test_int(of_extra, extra ? 2 : 0, "integrals %s listed", extra ? extra : "of no case");
        gsl_test_int(c->run[b].drifts, 6 + of_extra, "integrals listed");
    }
}

static void check_scene(const iso_scene *scene, const char *extra)
{
    iso_comparison *c;
    laws_worst differences = {0}, drifts = {0};
    char title[64];
    must(iso_compare(ctx, scene, NULL, NULL, &c), "a comparison");
    const size_t rows = iso_scene_rows(scene);
    for (int b = 0; b < c->runs; b++) {
        gsl_test_int((int)iso_record_rows(c->run[b].trajectory), (int)rows, "rows of a backend");
        gsl_test(!c->run[b].method || c->run[b].statistics.rhs < 1 || !(c->run[b].seconds > 0),
                 "what a backend took");
        for (int i = 0; i < c->run[b].drifts; i++)
            laws_note(&drifts, c->run[b].drift[i].worst, 1e-11, &scene->params, c->run[b].drift[i].integral->name);
    }
    gsl_test_int((int)iso_record_rows(c->difference), (int)rows, "rows compared");
    gsl_test(c->worst[0] != scene->end, "the last time compared");
    for (size_t i = 1; i < ISO_DIFFERENCES; i++) {
        double largest = 0;
        for (size_t row = 0; row < rows; row++) largest = fmax(largest, iso_record_const_row(c->difference, row)[i]);
        gsl_test(largest != c->worst[i], "the worst of %s", iso_record_name(c->difference, i));
        laws_note(&differences, c->worst[i], 1e-9, &scene->params, iso_record_name(c->difference, i));
        gsl_test(scene->end != 0 && !(c->worst[i] > 0), "%s differs", iso_record_name(c->difference, i));
    }
    const bool separates = scene->params.k == 1 || scene->params.k == -1;
    gsl_test(separates && c->runs != ISO_BACKENDS, "backend exact: %s", c->no_exact);
    gsl_test((c->runs == ISO_BACKENDS) == (*c->no_exact != '\0'), "there is a closed solution, or a reason");
    for (int b = 0; c->runs == ISO_BACKENDS && b < ISO_INTEGRATED; b++)
        for (size_t i = 1; i < ISO_DIFFERENCES; i++)
            laws_note(&differences, c->worst_from_exact[b][i], 1e-9, &scene->params, "from exact");
    check_listed(c, extra);
    snprintf(title, sizeof title, "compare to t = %g: backends differ", scene->end);
    laws_report(&differences, title);
    laws_report(&drifts, "compare: integrals drift");
    iso_comparison_free(c);
}

/* A method that restores nothing, at a tolerance that shows. */
static void check_drift(void)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    iso_scene scene = scene_of(1, J, 20, 1);
    iso_comparison *c;
    snprintf(scene.method, sizeof scene.method, "msadams");
    scene.tolerance = 1e-6;
    must(iso_compare(ctx, &scene, NULL, NULL, &c), "a comparison by msadams");
    for (int b = 0; b < c->runs; b++)
        for (int i = 0; i < c->run[b].drifts; i++) {
            const iso_drift *d = &c->run[b].drift[i];
            const bool shows = d->system == iso_systems[b] && (d->integral->name[0] == 'F' || i == 0 || i == 4);
            gsl_test(!(d->worst < 1e-2) || (shows && !(d->worst > 1e-9)), "msadams: %s of the %s drifts by %.2g",
                     d->integral->name, d->system->name, d->worst);
        }
    iso_comparison_free(c);
}

static bool stop_at(void *data, double part)
{
    return part < *(double *)data - 1e-9;
}

/* Interrupted while any of the backends looks for a row: there is no row that only some of them have. */
static void check_interruptions(void)
{
    const iso_scene scene = scene_of(-1, (const double[]){1.4, 2.1, 3.0}, 100, 5);
    bool whole = false;
    for (int asked = 0; asked < 100000 && !whole; asked += 1 + asked / 50) {
        iso_comparison *c;
        int left = asked;
        iso_context_set_monitor(ctx, some_times, &left);
        const iso_status status = iso_compare(ctx, &scene, NULL, NULL, &c);
        iso_context_set_monitor(ctx, NULL, NULL);
        whole = status == ISO_OK;
        gsl_test(!whole && status != ISO_STOPPED, "interrupted: %s", iso_context_message(ctx));
        for (int b = 0; c && b < c->runs; b++)
            gsl_test_int((int)iso_record_rows(c->run[b].trajectory), (int)iso_record_rows(c->difference),
                         "rows of a backend when interrupted after %d steps", asked);
        iso_comparison_free(c);
    }
    gsl_test(!whole, "a comparison of few steps");
}

static void check_stops(void)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    iso_scene scene = scene_of(-0.3, J, 10, 0.1);
    iso_comparison *c;
    double part = 40 / 101.0;
    must(iso_compare(ctx, &scene, stop_at, &part, &c), "a comparison that is stopped");
    for (int b = 0; b < c->runs; b++)
        gsl_test_int((int)iso_record_rows(c->run[b].trajectory), 40, "rows of a backend before a stop");
    gsl_test_int((int)iso_record_rows(c->difference), 40, "rows compared before a stop");
    iso_comparison_free(c);
    scene.end = 1e22, scene.step = 5e21; /* the second row is out of reach */
    gsl_test(iso_compare(ctx, &scene, NULL, NULL, &c) != ISO_BAD_ARGUMENT || c, "times out of reach");
    scene = scene_of(-0.3, J, 10, 0.1);
    snprintf(scene.method, sizeof scene.method, "rk9");
    gsl_test(iso_compare(ctx, &scene, NULL, NULL, &c) != ISO_BAD_ARGUMENT || c, "no such method");
    snprintf(scene.method, sizeof scene.method, "auto");
    scale(scene.start.y, 0);
    gsl_test(iso_compare(ctx, &scene, NULL, NULL, &c) != ISO_NOT_MAPPED || c, "a ball at rest is not compared");
}

/* In these units s grows beyond all doubles: what was compared before is kept. */
static void check_numerical_failure(void)
{
    static const double J[3] = {0.14, 0.21, 0.3};
    iso_scene scene = scene_of(1, J, 1e308, 1e306);
    iso_comparison *c = NULL;
    scale(scene.start.y, 1e-305);
    const iso_status status = iso_compare(ctx, &scene, NULL, NULL, &c);
    gsl_test(status != ISO_NUMERICAL || !c, "a comparison that cannot go on: %s", iso_context_message(ctx));
    if (!c) return;
    const size_t rows = iso_record_rows(c->difference);
    gsl_test(rows < 5 || rows > 50, "rows before a failure: %zu of %zu", rows, iso_scene_rows(&scene));
    for (int b = 0; b < c->runs; b++)
        gsl_test_int((int)iso_record_rows(c->run[b].trajectory), (int)rows, "rows of a backend before a failure");
    gsl_test(!(c->worst[1] < 1e-9), "they agree to %.2g", c->worst[1]);
    iso_comparison_free(c);
}

static void check_compare(void)
{
    static const double J[3] = {1.4, 2.1, 3.0}, symmetric[3] = {2, 3, 2};
    const double scenes[] = {1, -1, 0.5, -0.3};
    const char *const extra[] = {"F_plane", "F_shell", NULL, NULL};
    for (int i = 0; i < 4; i++) {
        const iso_scene scene = scene_of(scenes[i], J, i % 2 ? -100 : 100, 1);
        check_scene(&scene, extra[i]);
    }
    const iso_scene axis = scene_of(0.75, symmetric, 20, 0.3), still = scene_of(0.5, J, 0, 0);
    check_scene(&axis, "F_axis2");
    check_scene(&still, NULL);
    check_drift();
    check_stops();
    check_interruptions();
    check_numerical_failure();
}

int main(void)
{
    ctx = iso_context_create();
    check_compare();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

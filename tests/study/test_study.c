/* Both backends side by side (iso_compare), and whether a record solves its model (iso_check). */
#include "orbit/orbit_impl.h"
#include "studies.h"
#include "task/check/check.h"
#include "task/compare.h"
#include "task/convert/convert.h"

/* --- compare --------------------------------------------------------------------------------------------------- */

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

/* --- check ----------------------------------------------------------------------------------------------------- */

enum { ROWS = 9 };

/* An orbit's record with the columns first ... last of a trajectory, and the clocks before them: t, T for
 * tau, s. */
static iso_record *record_of(const iso_params *p, const iso_start *start, int first, int last, const char *clocks)
{
    iso_orbit_options o = iso_orbit_defaults(start);
    const char *names[ISO_TRAJECTORY_COLUMNS];
    int columns[ISO_TRAJECTORY_COLUMNS], width = 0;
    iso_orbit *orbit;
    iso_record *record;
    for (int c = 0; c < ISO_CLOCKS; c++) {
        o.with_clock[c] = strchr(clocks, "tTs"[c]) != NULL;
        if (o.with_clock[c]) columns[width++] = c;
    }
    for (int c = first; c <= last; c++) columns[width++] = c;
    for (int c = 0; c < width; c++) names[c] = iso_column_name(columns[c]);
    o.tolerance = 1e-14;
    o.shown = first < 9                  ? last > 9 ? ISO_SHOW_BOTH : ISO_SHOW_BALL
              : start->model == ISO_BALL ? ISO_SHOW_BOTH
                                         : ISO_SHOW_POINT;
    must(iso_orbit_create(ctx, p, start, &o, &orbit), "an orbit");
    must(iso_record_create(ctx, (size_t)width, names, &record), "a record");
    for (int i = 0; i < ROWS; i++) {
        iso_sample s;
        double *row;
        must(iso_orbit_at(orbit, 0.4 * i, &s), "a sample");
        must(iso_record_append(ctx, record, &row), "a row");
        for (int c = 0; c < width; c++) row[c] = iso_sample_column(&s, columns[c]);
    }
    if (start->model == ISO_POINT) must(iso_record_set_numbers(ctx, record, "eps", 1, &start->eps), "eps");
    iso_orbit_free(orbit);
    return record;
}

/* Whether the residuals above `bound` are exactly those whose names are in the list, " a, b, ". */
static void expect(const iso_params *p, const iso_record *record, double bound, const char *list, const char *what)
{
    iso_residuals r;
    char name[64];
    must(iso_check(ctx, p, record, 1e-14, &r), what);
    int named = 0;
    for (int i = 0; i < r.count; i++) {
        const iso_residual *x = &r.residual[i];
        snprintf(name, sizeof name, " %s,", x->name);
        const bool wanted = strstr(list, name) != NULL;
        named += wanted;
        gsl_test((x->worst > bound) != wanted, "%s: %s is %.2g in row %zu", what, x->name, x->worst, x->row);
    }
    int commas = 0;
    for (const char *c = list; *c; c++) commas += *c == ',';
    gsl_test_int(named, commas, "%s: residuals that tell (%s)", what, list);
}

static void check_good(void)
{
    static const double J[3] = {1.4, 2.1, 3.0}, symmetric[3] = {2, 3, 2};
    static const struct {
        double k;
        const double *J;
        int first, last, residuals; /* |x|, (x,y), energy; the extra integral; flow; clocks; map */
        const char *clocks;
    } records[] = {
        {1, J, 3, 8, 4, ""},      {-1, J, 3, 8, 5, "t"},  {0.5, J, 3, 8, 4, "s"},   {0.75, symmetric, 3, 8, 6, "ts"},
        {1, J, 9, 14, 4, ""},     {-1, J, 9, 14, 5, "s"}, {-0.3, J, 9, 14, 4, "t"}, {4, J, 9, 14, 5, "Ts"},
        {1, J, 3, 14, 14, "tTs"}, {0.5, J, 3, 14, 7, ""}};
    for (size_t i = 0; i < sizeof records / sizeof *records; i++) {
        const iso_params p = laws_params(records[i].k, records[i].J);
        const iso_start start = {.model = ISO_BALL, .y = {0.8, 0.5, -0.6, 0.6, 0, 0.8}};
        iso_record *record = record_of(&p, &start, records[i].first, records[i].last, records[i].clocks);
        iso_residuals r;
        must(iso_check(ctx, &p, record, 1e-14, &r), "a good record");
        gsl_test_int(r.count, records[i].residuals, "k = %g, clocks '%s': residuals", p.k, records[i].clocks);
        expect(&p, record, 1e-12, "", "a good record");
        iso_record_free(record);
    }
}

/* A record with both models and all clocks, where `count` numbers of row 4 are scaled, or the unit vector of their
 * model is added `along` times: what that raises is the list. */
static void check_damage(double k, const char *column, int count, double along, const char *list)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    const iso_params p = laws_params(k, J);
    const iso_start start = {.model = ISO_BALL, .y = {0.8, 0.5, -0.6, 0.6, 0, 0.8}};
    iso_record *record = record_of(&p, &start, 3, 14, "tTs");
    double *x = iso_record_row(record, 3) + iso_record_find(record, column);
    for (int i = 0; i < count; i++) x[i] = along > 0 ? x[i] + along * x[3 + i] : (1 + 1e-7) * x[i];
    expect(&p, record, 1e-11, list, column);
    iso_record_free(record);
}

static void check_damages(void)
{
    check_damage(0.75, "n1", 3, 0, " ball |n|, ball flow,");
    check_damage(0.75, "gamma1", 3, 0, " point |gamma|, point H, point flow, map,");
    check_damage(0.75, "omega1", 3, 1e-7, " ball omega.n, ball h, ball flow, map,");
    check_damage(0.75, "M1", 3, 1e-7, " point M.gamma, point flow, map,");
    check_damage(0.75, "omega1", 3, 0, " ball h, ball flow, clock tau, clock s, map,");
    check_damage(1, "omega1", 3, 0, " ball h, ball F_plane, ball flow, clock tau, clock s, map,");
    check_damage(-1, "omega1", 3, 0, " ball h, ball F_shell, ball flow, clock tau, clock s, map,");
    check_damage(0.75, "M1", 3, 0, " point H, point flow, clock t, clock tau, map,");
    check_damage(1, "M1", 3, 0, " point H, point F_plane, point flow, clock t, clock tau, map,");
    check_damage(-1, "M1", 3, 0, " point H, point F_shell, point flow, clock t, clock tau, map,");
    check_damage(0.75, "s", 1, 0, " clock t, clock tau, clock s, point flow,");
    check_damage(0.75, "tau", 1, 0, " clock tau,");
    check_damage(0.75, "t", 1, 0, " clock t, clock tau, clock s, ball flow,");
}

static void check_off_level(void)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    const iso_params p = laws_params(-1, J);
    const iso_start start = {.model = ISO_POINT, .y = {0, 0.3, -0.2, 1, 0, 0}, .eps = 2};
    iso_record *record = record_of(&p, &start, 9, 14, "s");
    expect(&p, record, 1e-11, "", "a point off the level H = 0");
    must(iso_record_set(ctx, record, "eps", "2.1"), "a line");
    expect(&p, record, 1e-6, " point H, point F_shell, point flow,", "another eps");
    iso_record_free(record);
}

static void check_bad_records(void)
{
    static const double J[3] = {1.4, 2.1, 3.0};
    const iso_params p = laws_params(0.5, J);
    const iso_start start = {.model = ISO_BALL, .y = {0.8, 0.5, -0.6, 0.6, 0, 0.8}};
    iso_residuals r;
    iso_record *record = record_of(&p, &start, 3, 8, "t");
    iso_record_row(record, 2)[3] = NAN; /* every number: hard/test_hard_study_numbers.c */
    gsl_test(iso_check(ctx, &p, record, 1e-13, &r) != ISO_BAD_INPUT || !strstr(iso_context_message(ctx), "row 3"),
             "NaN: %s", iso_context_message(ctx));
    iso_record_free(record);
    const char *const names[] = {"t", "omega1", "omega2", "omega3", "n1", "n2", "n3"};
    must(iso_record_create(ctx, 7, names, &record), "a record");
    gsl_test(iso_check(ctx, &p, record, 1e-13, &r) != ISO_BAD_INPUT, "no rows: %s", iso_context_message(ctx));
    iso_record_free(record);
    must(iso_record_create(ctx, 6, names, &record), "a record");
    gsl_test(iso_check(ctx, &p, record, 1e-13, &r) != ISO_BAD_INPUT, "no model: %s", iso_context_message(ctx));
    iso_record_free(record);
}

int main(void)
{
    ctx = iso_context_create();
    check_compare();
    check_good();
    check_damages();
    check_off_level();
    check_bad_records();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

/* Studies on levels of the energy: rows of sections have the scene's H and its additional integral, shares are 0 where
 * they must be, a scene is put on a level (iso_scene_on_level), and what cannot be is refused. */
#include "instrument/chaos/chaos.h"
#include "instrument/section/section.h"
#include "map/section_impl.h"
#include "orbit/orbit_impl.h"
#include "studies.h"
#include "task/check/check.h"

/* --- rows have the scene's numbers ------------------------------------------------------------------------------ */

/* H and the additional integrals of the points in the rows, against those of the first. */
typedef struct law {
    iso_problem problem;
    const iso_integral *integral[4];
    int count;
    double first[4];
    size_t rows;
    int axis, states; /* numbers of a row's states */
    laws_worst H, F, chart;
    const char *what;
    iso_record *file; /* all that the section wrote */
} law;

static iso_status see_row(void *data, int table, const double row[], size_t count)
{
    law *k = data;
    if (table > 0) return ISO_OK;
    const double *point = row + count - ISO_STATE;
    double size;
    const double H = iso_system_point.energy(&k->problem, point, &size);
    laws_note(&k->H, fabs(H - k->problem.energy), 1e-11 * size, &k->problem.p, k->what);
    for (int i = 0; i < k->count; i++) {
        const double F = k->integral[i]->value(&k->problem, point, &size);
        if (row[1] == 1) k->first[i] = F; /* each orbit has its own */
        laws_note(&k->F, fabs(F - k->first[i]), 1e-11 * size, &k->problem.p, k->what);
    }
    double l, x;
    iso_section_chart(k->axis, point, &l, &x);
    const double *chart = row + count - k->states - 2;
    laws_note(&k->chart, fabs(point[3 + k->axis]), 1e-12, &k->problem.p, k->what);
    laws_note(&k->chart, fabs(remainder(l - chart[0], 2 * M_PI)) + fabs(x - chart[1]), 1e-12, &k->problem.p, k->what);
    k->rows++;
    return ISO_OK;
}

/* The largest residual of the file, by its own lines. */
static double worst_of(const law *k)
{
    iso_params params;
    iso_residuals r;
    double worst = 0;
    gsl_test(iso_record_params(ctx, k->file, &params) != ISO_OK ||
                 iso_check(ctx, &params, k->file, 1e-13, &r) != ISO_OK,
             "%s: is checked: %s", k->what, iso_context_message(ctx));
    for (int i = 0; i < r.count; i++) worst = fmax(worst, r.residual[i].worst);
    return worst;
}

/* The file passes its check. It does not if one row, or all rows of one orbit, have another energy. */
static void check_file(law *k)
{
    const double good = worst_of(k);
    gsl_test(!(good <= 1e-9), "%s: the section passes its check: %.2g", k->what, good);
    const size_t rows = iso_record_rows(k->file), state = iso_record_columns(k->file) - ISO_STATE;
    for (size_t first = rows / 5; rows >= 5 && first < rows; first += rows / 5) { /* orbits 1 to 4 */
        for (size_t row = first; row < first + rows / 5 && row < rows; row++)
            for (size_t i = 0; i < 3; i++) iso_record_row(k->file, row)[state + i] *= 1.001;
        gsl_test(!(worst_of(k) > 1e-5), "%s: another level from row %zu on is found", k->what, first + 1);
        for (size_t row = first; row < first + rows / 5 && row < rows; row++)
            for (size_t i = 0; i < 3; i++) iso_record_row(k->file, row)[state + i] /= 1.001;
    }
    iso_record_free(k->file);
    k->file = NULL;
}

static void find_integrals(law *k)
{
    k->count = 0;
    for (const iso_integral *i = iso_system_point.integrals; i->name; i++)
        if (i->name[0] == 'F' && (!i->holds || i->holds(&k->problem))) k->integral[k->count++] = i;
}

/* Random scenes: k, J (of some bodies equal), H; points, and balls with the effect `level`; by the ball, the point,
 * and both. */
static void check_rows(void)
{
    static const double ks[] = {0.5, -0.5, 1, -1, 2, -2};
    iso_random *r = iso_random_create(3);
    law k = {.rows = 0};
    for (int i = 0; i < tests_length(24, 240); i++) {
        const double eps = 1;
        char what[64];
        double J[3] = {iso_random_uniform(r, 1, 3), iso_random_uniform(r, 1, 3), iso_random_uniform(r, 1, 3)};
        double gamma[3], M[3];
        if (i % 7 == 3 || i % 7 == 5) J[1] = J[0]; /* two equal moments */
        if (i % 7 == 5) J[2] = J[0];               /* three             */
        iso_random_direction(r, gamma);
        iso_random_direction(r, M);
        const double fast = iso_random_uniform(r, 0.05, 3);
        snprintf(what, sizeof what, "scene %d", i);
        scale(M, fast);
        iso_scene scene = iso_scene_default();
        scene.params = laws_params(ks[i % 6], J);
        iso_effects_set_level(&scene.effects, i % 2 == 0, 1);
        must(i % 2 ? iso_start_point(ctx, M, gamma, &eps, true, &scene.start)
                   : iso_start_ball(ctx, M, gamma, ISO_SPIN_REMOVE, &scene.start),
             what);
        if (i % 2 == 0) /* a level above 0 is reached from everywhere */
            gsl_test(iso_scene_on_level(ctx, &scene, iso_random_uniform(r, 0, 2)) != ISO_OK, "%s: %s", what,
                     iso_context_message(ctx));
        iso_orbit_options oo = iso_orbit_defaults(&scene.start);
        iso_orbit *orbit;
        oo.effects = &scene.effects;
        gsl_test(iso_orbit_create(ctx, &scene.params, &scene.start, &oo, &orbit) != ISO_OK, "%s", what);
        const iso_effects effects = iso_orbit_effects(orbit);
        k.problem = (iso_problem){.p = scene.params, .eps = iso_orbit_coupling(orbit)};
        k.problem.energy =
            iso_effects_have_level(&effects) ? iso_coupling(&scene.params, iso_effects_level(&effects)) : 0;
        iso_orbit_free(orbit);
        find_integrals(&k);
        k.what = what;
        k.axis = iso_section_axis((iso_point_motion){&k.problem.p, k.problem.eps, k.problem.energy});
        k.states = i % 4 < 2 ? ISO_STATE : 2 * ISO_STATE;
        const iso_sink sink = {.row = see_row, .data = &k};
        iso_record *tables[2] = {NULL, NULL};
        iso_section_options o = iso_section_defaults();
        iso_section_result result;
        o.crossings = 5;
        o.starts = 4;
        o.models = (iso_models)(i / 2 % 3);
        o.shown = i % 4 < 2 ? ISO_SHOW_POINT : ISO_SHOW_BOTH;
        const size_t before = k.rows;
        gsl_test(iso_section_run(ctx, &scene, &o, &sink, tables, &result) != ISO_OK, "%s: %s", what,
                 iso_context_message(ctx));
        gsl_test(!result.nature.global || k.rows - before != 25 || result.unequal > 0, "%s: %zu rows of 25, %s", what,
                 k.rows - before, result.words);
        k.file = tables[0];
        iso_record_free(tables[1]);
        check_file(&k);
    }
    laws_report(&k.H, "rows of a section have the H of the scene");
    laws_report(&k.F, "and keep the additional integral on every level");
    laws_report(&k.chart, "they lie on the section, and l and x are those of their states");
    iso_random_free(r);
}

/* --- shares ----------------------------------------------------------------------------------------------------- */

static iso_chaos_fraction share_of(const char *point, double level, size_t starts, long turns, iso_models models)
{
    iso_scene scene = parse(point);
    iso_chaos_options o = iso_chaos_defaults();
    iso_chaos *c = NULL;
    o.starts = starts;
    o.turns = turns;
    o.models = models;
    gsl_test(iso_scene_on_level(ctx, &scene, level) != ISO_OK || iso_chaos_run(ctx, &scene, &o, &c) != ISO_OK,
             "level %g: %s", level, iso_context_message(ctx));
    gsl_test(c && c->axis < 0, "level %g: a turn is a return to the section", level);
    const iso_chaos_fraction share = c ? c->share : (iso_chaos_fraction){.share = NAN};
    iso_chaos_free(c);
    return share;
}

#define POINT(k)                                                                                                     \
    "point: {k: " k ", J: [1, 2, 5], eps: 1}\n"                                                                      \
    "initial: {gamma: [0.96, 0, 0.28], M: [0, 1, 0.5], project: true}\ntime: {end: 1}\n"
#define SHELL                                                                                                        \
    "point: {k: -1, J: [1, 2, 5], eps: 1}\n"                                                                         \
    "initial: {gamma: [0.28, 0, 0.96], M: [0, 1, 0.5], project: true}\ntime: {end: 1}\n"

static void check_shares(void)
{
    for (int i = 0; i < 3; i++) {
        const double level = (double[]){-0.7, 0.4, 3}[i];
        const iso_models models = i == 1 ? ISO_SHOW_BOTH : ISO_SHOW_POINT;
        gsl_test_int((int)share_of(POINT("1"), level, 16, 200, models).chaotic, 0, "k = 1, level %g: no chaos",
                     level);
        gsl_test_int((int)share_of(SHELL, level, 16, 200, models).chaotic, 0, "k = -1, level %g: no chaos", level);
    }
    const iso_chaos_fraction some = share_of(POINT("0.5"), -0.3, 24, 400, ISO_SHOW_POINT);
    gsl_test(!(some.share > 0.1), "k = 0.5, level -0.3: chaos, share %g", some.share);
    const iso_chaos_fraction none = share_of(POINT("0.5"), 1000, 24, 400, ISO_SHOW_POINT);
    gsl_test_int((int)none.chaotic, 0, "k = 0.5, level 1000: nearly free on the sphere");
}

/* --- a scene on a level ----------------------------------------------------------------------------------------- */

#define BALL "reduced: {k: -0.7, J: [2, 1, 3]}\ninitial: {normal: [0.6, 0, 0.8], angular_velocity: "

static void check_on_level(void)
{
    static const char *const texts[] = {POINT("0.5"), POINT("-0.5"), BALL "[0, 0.7, 0]}\ntime: {end: 1}\n"};
    for (int t = 0; t < 3; t++)
        for (int i = 0; i < 5; i++) {
            const double level = (double[]){-0.01, 0, 0.3, 5, 1e6}[i];
            iso_scene scene = parse(texts[t]);
            gsl_test(iso_scene_on_level(ctx, &scene, 0.7) != ISO_OK ||
                         iso_scene_on_level(ctx, &scene, level) != ISO_OK,
                     "scene %d on %g: %s", t, level, iso_context_message(ctx));
            /* a ball's h is a difference of terms that are `level` times larger */
            const double bound = 1e-13 * (1 + fabs(level)) + (t == 2 ? 4e-16 * level * level : 0);
            iso_orbit_options o = iso_orbit_defaults(&scene.start);
            iso_orbit *orbit;
            o.effects = &scene.effects;
            must(iso_orbit_create(ctx, &scene.params, &scene.start, &o, &orbit), "its orbit");
            const iso_point_motion m = iso_orbit_motion(orbit);
            gsl_test_abs(iso_level_of(m.p, m.energy / m.eps), level, bound, "scene %d is on its level", t);
            iso_orbit_free(orbit);
        }
}

static void refuse(const char *text, double level, const char *about, const char *words)
{
    iso_scene scene = parse(text);
    gsl_test_int((int)iso_scene_on_level(ctx, &scene, level), ISO_BAD_INPUT, "level %g is refused", level);
    gsl_test(strcmp(iso_context_about(ctx), about) != 0 || !strstr(iso_context_message(ctx), words), "about %s: %s",
             about, iso_context_message(ctx));
}

static void check_refusals(void)
{
    refuse(POINT("0.5"), -100, "level", "is not reached at this gamma");
    refuse(BALL "[0, 0.7, 0]}\ntime: {end: 1}\n", -100, "level", "is not reached at this normal");
    refuse(BALL "[0, 0, 0]}\ntime: {end: 1}\n", 1, "angular_velocity", "at rest");
    refuse("point: {k: 1, J: [1, 2, 5], eps: 1}\ninitial: {gamma: [1, 0, 0], M: [0, 0, 0]}\ntime: {end: 1}\n", 1, "M",
           "no direction");
    refuse(BALL "[0, 0.7, 0]}\ntime: {end: 1}\neffects: {field: {linear: [0.1, 0, 0]}}\n", 1, "field", "field");
    refuse(POINT("0.5"), NAN, "level", "no level");
    iso_scene scene = parse(POINT("0.5")); /* E < 0: the circle of l is closed near pi/2 */
    const double at[1][2] = {{1.5, 0.1}};
    iso_section_options o = iso_section_defaults();
    iso_chaos_options chaos = iso_chaos_defaults();
    iso_chaos *c;
    iso_section_result result;
    chaos.at = at;
    chaos.at_count = 1;
    iso_scene_on_level(ctx, &scene, -1.5);
    gsl_test_int((int)iso_chaos_run(ctx, &scene, &chaos, &c), ISO_BAD_INPUT, "chaos: closed at l");
    gsl_test(!strstr(iso_context_message(ctx), "n_3 = 0 is closed at l = 1.5"), "%s", iso_context_message(ctx));
    o.starts = 2;
    o.axis = 0; /* n_1 = 0 is closed as a whole */
    gsl_test_int((int)iso_section_run(ctx, &scene, &o, &(iso_sink){0}, NULL, &result), ISO_BAD_INPUT, "closed");
    gsl_test(!strstr(iso_context_message(ctx), "n_1 = 0 is closed everywhere"), "%s", iso_context_message(ctx));
}

int main(void)
{
    ctx = iso_context_create();
    check_rows();
    check_shares();
    check_on_level();
    check_refusals();
    iso_context_free(ctx);
    return gsl_test_summary();
}

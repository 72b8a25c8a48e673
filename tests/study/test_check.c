/* The law of iso_check: in a file that a run made, every number of every column and of every line, changed by a
 * millionth, raises a residual above what the file itself passes, or the check says that nobody looks at it. Over the
 * tables: every effect on every kind of ball, with all that observes, both models, every choice of columns. And which
 * residuals tell. */
#include "effects.h"
#include "orbit/description.h"
#include "scenes.h"
#include "studies.h"
#include "task/check/check_impl.h"
#include "task/run.h"

/* The files pass it; numbers of this size of order one, changed by CHANGE, must not. Numbers below SMALL are too
 * small beside the others of their vector. */
static const double BOUND = 1e-11, CHANGE = 1e-6, SMALL = 1e-3;

static size_t changed, small, told;

/* --- checks ----------------------------------------------------------------------------------------------------- */

typedef struct answer {
    iso_status status;
    double worst;
    char unseen[1024]; /* ";mu;# tolerance;" */
} answer;

static void keep_name(void *data, const char *name)
{
    char *unseen = data;
    const size_t used = strlen(unseen);
    snprintf(unseen + used, 1024 - used, "%s;", name);
}

static answer check_of(const iso_record *record, bool with_unseen)
{
    answer a = {.unseen = ";"};
    iso_params params;
    iso_residuals r;
    iso_checking *c;
    a.status = iso_record_params(ctx, record, &params);
    if (a.status == ISO_OK) a.status = iso_checking_create(ctx, &params, record, 1e-14, &c);
    if (a.status != ISO_OK) return a;
    for (size_t row = 0; a.status == ISO_OK && row < iso_record_rows(record); row++)
        a.status = iso_checking_put(c, iso_record_const_row(record, row));
    if (a.status == ISO_OK) a.status = iso_checking_end(c, &r);
    if (a.status == ISO_OK && with_unseen) iso_checking_unseen(c, keep_name, a.unseen);
    for (int i = 0; a.status == ISO_OK && i < r.count; i++) a.worst = fmax(a.worst, r.residual[i].worst);
    iso_checking_free(c);
    return a;
}

static bool tells(const answer *a, const char *name)
{
    char wanted[80];
    snprintf(wanted, sizeof wanted, ";%s;", name);
    return strstr(a->unseen, wanted) != NULL;
}

/* The record, with one number changed: it is noticed, or the check of the record as it was told that it is not. */
static void expect(const iso_record *record, const answer *before, const char *file, const char *name,
                   const char *part, double number)
{
    const bool said = tells(before, name) || tells(before, part);
    changed++;
    told += said;
    if (number != 0 && fabs(number) < SMALL) {
        small++;
        return;
    }
    const answer a = said ? *before : check_of(record, false);
    gsl_test(!said && a.status == ISO_OK && !(a.worst > BOUND), "%s: %s (%g) off by a millionth is noticed: %.2g",
             file, part, number, a.worst);
}

static double another(double number)
{
    return number == 0 ? CHANGE : number * (1 + CHANGE);
}

/* The numbers of a line; words are none. */
static size_t numbers_of(const char *text, double x[16])
{
    size_t count = 0;
    char *end;
    for (; *text && count < 16; text = end) {
        x[count++] = strtod(text, &end);
        if (end == text || (*end && *end != ' ')) return 0;
    }
    return count;
}

/* The texts of effects that the scene writes; `work` says what they do, and is tried when the file is read. */
static bool is_expression(const char *key)
{
    return strncmp(key, "potential.", 10) == 0 || strncmp(key, "torque.", 7) == 0 ||
           strncmp(key, "integrals.", 10) == 0;
}

static void expect_expression(iso_record *record, const char *file, const char *key, const char *kept)
{
    char text[600];
    if (strcmp(key, "torque.work") == 0) return;
    const bool claimed = strncmp(key, "integrals.", 10) == 0; /* 1.01 F is an integral where F is */
    snprintf(text, sizeof text, claimed ? "(%s) + 0.01*n1" : "1.01*(%s)", kept);
    must(iso_record_set(ctx, record, key, text), "a line");
    const answer a = check_of(record, false);
    gsl_test(a.status == ISO_OK && !(a.worst > BOUND), "%s: %s changed by 1 %% is noticed: %.2g", file, key, a.worst);
    must(iso_record_set(ctx, record, key, kept), "a line");
}

static void change_lines(iso_record *record, const answer *before, const char *file)
{
    const char *key, *value;
    char kept[512], name[64], part[80];
    double x[16];
    for (size_t i = 0; iso_record_line(record, i, &key, &value); i++) {
        snprintf(kept, sizeof kept, "%s", value);
        snprintf(name, sizeof name, "# %s", key);
        const size_t count = numbers_of(kept, x);
        for (size_t j = 0; j < count; j++) {
            const double number = x[j];
            snprintf(part, sizeof part, "# %s, number %zu", key, j + 1);
            x[j] = another(number);
            must(iso_record_set_numbers(ctx, record, key, count, x), "a line");
            expect(record, before, file, name, part, number);
            x[j] = number;
        }
        if (count == 0 && is_expression(key))
            expect_expression(record, file, key, kept);
        else if (count == 0 && strcmp(key, "effects") != 0)
            gsl_test(!tells(before, name), "%s: the words of %s are looked at by nobody", file, name);
        must(iso_record_set(ctx, record, key, kept), "a line");
    }
}

/* The drifts of each model that the file has: the line of an integral has the largest of its column. */
static void hold_drifts(const iso_record *record, const char *file)
{
    static const char *const first[] = {"n1", "gamma1"};
    iso_params params;
    iso_record *drifts;
    iso_status status = iso_record_params(ctx, record, &params);
    for (int m = 0; m < 2 && status == ISO_OK; m++) {
        if (iso_record_find(record, first[m]) < 0) continue;
        status = iso_check_drifts(ctx, &params, record, m, &drifts);
        gsl_test(status != ISO_OK, "%s: has drifts: %s", file, iso_context_message(ctx));
        for (size_t c = 1; status == ISO_OK && c < iso_record_columns(drifts); c++) {
            double largest = 0, worst = 0;
            char key[80];
            snprintf(key, sizeof key, "%s.worst", iso_record_name(drifts, c));
            const bool described = iso_record_get_numbers(ctx, drifts, key, 1, &worst, &status);
            for (size_t i = 0; i < iso_record_rows(drifts); i++)
                largest = fmax(largest, iso_record_const_row(drifts, i)[c]);
            gsl_test(described && worst != largest, "%s: %s is %g, the largest of its drifts %g", file, key, worst,
                     largest);
            gsl_test(!(largest <= BOUND), "%s: %s drifts by %.2g", file, iso_record_name(drifts, c), largest);
        }
        iso_record_free(drifts);
    }
}

static void hold(const iso_scene *scene, const char *file)
{
    iso_record *record = NULL;
    const iso_sink sink = {.data = NULL};
    if (iso_run(ctx, scene, NULL, &sink, &record, NULL) != ISO_OK) { /* it makes no sense: a constant field */
        iso_record_free(record);
        return;
    }
    const answer before = check_of(record, true);
    gsl_test(before.status != ISO_OK, "%s: is checked: %s", file, iso_context_message(ctx));
    gsl_test(!(before.worst <= BOUND), "%s: passes %g: %.2g", file, BOUND, before.worst);
    if (before.status == ISO_OK) {
        for (size_t row = 0; row < iso_record_rows(record); row++)
            for (size_t i = 0; i < iso_record_columns(record); i++) {
                double *x = iso_record_row(record, row) + i;
                const double kept = *x;
                *x = another(kept);
                expect(record, &before, file, iso_record_name(record, i), iso_record_name(record, i), kept);
                *x = kept;
            }
        change_lines(record, &before, file);
        hold_drifts(record, file);
    }
    iso_record_free(record);
}

/* --- over the tables -------------------------------------------------------------------------------------------- */

static iso_scene scene_of(const rolling *ball, iso_model_kind model, const iso_effects *effects, iso_models as,
                          iso_random *random)
{
    iso_scene scene = iso_scene_default();
    scene.params = ball->p;
    scene.start = scene_start(ball, random);
    scene.effects = *effects;
    TWO_SIDED(&scene.effects) = 1;
    scene.end = 0.75;
    scene.step = 0.25;
    scene.tolerance = 1e-14;
    scene.as = as;
    if (model == ISO_BALL) return scene;
    iso_ball_to_point(&ball->p, scene.start.y, scene.start.y);
    scene.start.model = ISO_POINT;
    scene.start.eps = NAN;
    scene.step = 0.25 / (1 + norm(scene.start.y)); /* s of a point runs as its M says */
    scene.end = 3 * scene.step;
    return scene;
}

/* Every effect, alone or with all observers; none. At the short length each has one choice of columns of three. */
static void hold_effect(const rolling *ball, int which, int acting, iso_random *random)
{
    char file[128];
    int subset = acting < ISO_EFFECTS ? 1 << acting : 0;
    for (int e = 0; e < ISO_EFFECTS && which % 2; e++) subset |= iso_effect_list[e]->observes ? 1 << e : 0;
    for (int model = 0; model < 2; model++)
        for (int as = (which + acting + model) % 3, i = 0; i < tests_length(1, 3); as = (as + 1) % 3, i++) {
            const iso_effects effects = effects_random(random, &ball->p, subset, 1, 1, 1);
            const iso_scene scene = scene_of(ball, (iso_model_kind)model, &effects, (iso_models)as, random);
            const int used = snprintf(file, sizeof file, "%s, %s as %s, ", ball->name, iso_model_kind_name(model),
                                      iso_models_name(as));
            effects_name(subset, file + used, sizeof file - (size_t)used);
            hold(&scene, file);
        }
}

/* --- which residuals tell ---------------------------------------------------------------------------------------- */

/* Row 4 of a free ball's file with both models and all clocks: the vector that begins with the column, or the clock, is
 * scaled, or the unit vector behind it is added `along` times. What that raises, and nothing else. */
static const struct damage {
    double k;
    const char *column;
    double along;
    const char *raised;
} damages[] = {
    {0.75, "n1", 0, " ball |n|, ball flow,"},
    {0.75, "gamma1", 0, " point |gamma|, point H, point flow, map,"},
    {0.75, "omega1", 1e-7, " ball omega.n, ball h, ball flow, map,"},
    {0.75, "M1", 1e-7, " point M.gamma, point flow, map,"},
    {0.75, "omega1", 0, " ball h, ball flow, clock tau, clock s, map,"},
    {1, "omega1", 0, " ball h, ball F_plane, ball flow, clock tau, clock s, map,"},
    {-1, "omega1", 0, " ball h, ball F_shell, ball flow, clock tau, clock s, map,"},
    {0.75, "M1", 0, " point H, point flow, clock t, clock tau, map,"},
    {1, "M1", 0, " point H, point F_plane, point flow, clock t, clock tau, map,"},
    {-1, "M1", 0, " point H, point F_shell, point flow, clock t, clock tau, map,"},
    {0.75, "s", 0, " clock t, clock tau, clock s, point flow,"},
    {0.75, "tau", 0, " clock tau,"},
    {0.75, "t", 0, " clock t, clock tau, clock s, ball flow,"},
};

static void hold_damage(const struct damage *d)
{
    iso_scene scene = ball_scene(d->k, (const double[]){1.4, 2.1, 3});
    iso_record *record;
    iso_residuals r;
    scene.end = 3.2, scene.step = 0.4, scene.tolerance = 1e-14, scene.as = ISO_SHOW_BOTH;
    scene.effects.on[ISO_CLOCK] = true;
    must(iso_run(ctx, &scene, NULL, &(iso_sink){.data = NULL}, &record, NULL), "a run");
    double *x = iso_record_row(record, 3) + iso_record_find(record, d->column);
    for (int i = 0; i < (strchr(d->column, '1') ? 3 : 1); i++)
        x[i] += d->along > 0 ? d->along * x[3 + i] : 1e-7 * x[i];
    must(iso_check(ctx, &scene.params, record, 1e-14, &r), "a check");
    int raised = 0, commas = 0;
    for (int i = 0; i < r.count; i++) {
        char name[64];
        snprintf(name, sizeof name, " %s,", r.residual[i].name);
        const bool wanted = strstr(d->raised, name) != NULL;
        raised += wanted;
        gsl_test((r.residual[i].worst > BOUND) != wanted, "%s, k = %g: %s is %.2g", d->column, d->k,
                 r.residual[i].name, r.residual[i].worst);
    }
    for (const char *c = d->raised; *c; c++) commas += *c == ',';
    gsl_test_int(raised, commas, "%s, k = %g: residuals that tell (%s)", d->column, d->k, d->raised);
    iso_record_free(record);
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *random = iso_random_create(29);
    for (size_t i = 0; i < sizeof damages / sizeof *damages; i++) hold_damage(&damages[i]);
    for (int which = 0; which < ROLLINGS; which++) {
        const rolling ball = rolling_ball(ctx, which);
        for (int acting = 0; acting <= ISO_EFFECTS; acting++) hold_effect(&ball, which, acting, random);
    }
    printf("%zu numbers changed, %zu of them not looked at, %zu too small\n", changed, told, small);
    gsl_test(small > changed / 50, "%zu of %zu numbers are too small to be seen", small, changed);
    iso_random_free(random);
    iso_context_free(ctx);
    return gsl_test_summary();
}

/* test_run_contact.c - iso_run (task/run.h) of a ball that leaves its support, or is not pressed to it. */
#include "runs.h"

static int place_of(const iso_scene *scene, const char *name)
{
    int columns[ISO_MAX_COLUMNS];
    const int count = iso_scene_column_list(scene, columns);
    for (int c = 0; c < count; c++)
        if (strcmp(iso_column_name(columns[c]), name) == 0) return c;
    laws_stop_if(ctx, true, "a column is missing");
    return -1;
}

/* The ball rolls down the outside of a sphere, after the start as before it, and leaves it. */
static void check_loss(void)
{
    const iso_scene scene = parse(OUTSIDE "initial: {normal: [0, 0, 1], angular_velocity: [0.3, 0.2, 0]}\n"
                                          "time: {end: 6, step: 0.25}\n"
                                          "effects: {gravity: {g: 9.81, up: [0, 0, 1]}, reactions: {}}\n");
    const int pressure = place_of(&scene, "pressure");
    double times[MOST];
    kept *k = run(&scene, NULL, 0);
    const double lost = k->result.lost_at[0], weight = 2 * 9.81;
    bool pressed = true;
    for (size_t i = 0; i + 1 < k->rows; i++) pressed = pressed && k->row[i][pressure] > 0;
    gsl_test(k->status != ISO_OK || !k->result.lost[0] || k->result.lost[1] || !(lost > 0 && lost < 6), "lost at %g",
             lost);
    gsl_test(k->notes != 1 || !strstr(k->note, "contact is lost at") || k->rows_at_note + 1 != k->rows,
             "said once, before its row");
    gsl_test(!pressed || k->row[k->rows - 1][0] != lost || !(fabs(k->row[k->rows - 1][pressure]) < 1e-12 * weight),
             "pressed until then, and not there: %.1e", k->row[k->rows - 1][pressure]);
    gsl_test(k->rows != (size_t)floor(lost / 0.25) + 2, "%zu rows: those before, and that one", k->rows);
    free(k);
    const size_t count = shuffle(&scene, 1, times);
    k = run(&scene, times, count);
    const double before = k->result.lost_at[1];
    size_t expected = 2; /* the two moments of loss */
    int wrong = k->status != ISO_OK || !k->result.lost[0] || !k->result.lost[1] || k->notes != 2;
    for (size_t i = 0, at = 0; i < count; i++) {
        const double time = at < k->rows ? k->row[at][0] : NAN;
        expected += times[i] < lost && times[i] > before;
        if (time == times[i])
            wrong += different(&scene, k, at++, times[i]);
        else if ((times[i] > lost && time == lost) || (times[i] < before && time == before))
            at++;
        else
            wrong += times[i] < lost && times[i] > before;
    }
    gsl_test(wrong || k->rows != expected || k->result.lost_at[0] != lost,
             "times in any order: rows between %.6g and %.6g, and at both", before, lost);
    free(k);
}

/* Nothing presses the ball at the start, or the support would have to pull it there. */
static void check_no_pressure(void)
{
    iso_scene scene = parse(OUTSIDE "initial: {normal: [0, 0, 1], angular_velocity: [0.3, 0.2, 0]}\n"
                                    "time: {end: 1, step: 0.25}\n"
                                    "effects: {gravity: {g: 9.81, up: [0, 0, -1]}, reactions: {}}\n");
    kept *k = run(&scene, NULL, 0);
    gsl_test(k->status != ISO_OK || k->notes != 1 || !strstr(k->note, "the support would have to pull") ||
                 k->rows_at_note != 0 || k->rows != 5 || k->result.lost[0],
             "below the sphere: two-sided, %zu rows", k->rows);
    free(k);
    scene = parse(OUTSIDE "initial: {normal: [0, 0, 1], angular_velocity: [0, 0, 0]}\n"
                          "time: {end: 1, step: 0.25}\n"
                          "effects: {gravity: {g: 9.81, up: [0, 1, 0]}, reactions: {}}\n");
    k = run(&scene, NULL, 0);
    gsl_test(k->status != ISO_OK || k->notes != 1 || !strstr(k->note, "contact is lost at 0:") || k->rows != 1 ||
                 !k->result.lost[0] || k->result.lost_at[0] != 0,
             "at rest beside the sphere: one row, %zu", k->rows);
    free(k);
}

int main(void)
{
    ctx = iso_context_create();
    check_loss();
    check_no_pressure();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

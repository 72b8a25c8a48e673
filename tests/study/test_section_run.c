/* iso_section_run (instrument/section/section.h): its rows equal the crossings of each orbit computed separately;
 * starts, both models, refusals, and the rows that stay when a sink, the monitor or a failure ends the work. */
#include <limits.h>

#include "instrument/section/section_impl.h"
#include "map/state.h"
#include "orbit/orbit_impl.h"
#include "studies.h"

enum { MOST = 24000, WIDTH = 40 };

/* What a sink was given. */
typedef struct kept {
    size_t rows, columns, pairs, headers, notes, most; /* most: rows that it takes */
    double (*row)[WIDTH];
    char names[512], words[512];
    double part;
    iso_section_result result;
    iso_status status;
} kept;

static iso_status keep_header(void *data, int table, const iso_record *header)
{
    kept *k = data;
    if (table > 0) return ISO_OK;
    k->headers++;
    k->columns = iso_record_columns(header);
    for (size_t i = 0; i < k->columns; i++) {
        strcat(k->names, i ? "," : "");
        strcat(k->names, iso_record_name(header, i));
    }
    return ISO_OK;
}

static iso_status keep_row(void *data, int table, const double row[], size_t count)
{
    kept *k = data;
    if (table > 0) { /* this crossing by the point, behind that by the ball */
        const double *ball = k->row[k->rows - 1];
        k->pairs += row[0] == ball[0] && row[1] == ball[1] && isfinite(row[5]);
        return ISO_OK;
    }
    gsl_test(count != k->columns || k->headers != 1, "a row has the header's columns");
    if (k->rows == k->most) return iso_context_fail(ctx, ISO_FILE_TROUBLE, "", "full");
    memcpy(k->row[k->rows++], row, count * sizeof *row);
    return ISO_OK;
}

static void keep_note(void *data, const char *words)
{
    kept *k = data;
    k->notes++;
    snprintf(k->words, sizeof k->words, "%s", words);
}

static void keep_progress(void *data, double part)
{
    kept *k = data;
    gsl_test(!(part >= k->part && part <= 1), "progress grows to 1: %g after %g", part, k->part);
    k->part = part;
}

static kept *run(const char *text, const iso_section_options *o, size_t most)
{
    const iso_scene scene = parse(text);
    kept *k = calloc(1, sizeof *k);
    k->row = calloc(MOST, sizeof *k->row);
    k->most = most;
    const iso_sink sink = {keep_header, keep_row, keep_note, keep_progress, k};
    k->status = iso_section_run(ctx, &scene, o, &sink, NULL, &k->result);
    return k;
}

static void release(kept *k)
{
    free(k->row);
    free(k);
}

#define REDUCED(k) "reduced: {k: " k ", J: [1, 2, 5], D: 0.5}\n"
#define START "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}\n"
#define TIME "time: {end: 1}\n"
#define FREE(k) REDUCED(k) START TIME

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* Rows are ordered by orbit and crossing, and orbit i is the one of the chart's point. */
static void check_rows(void)
{
    static const double at[2][2] = {{0.5, 0.1}, {-2, 0.999999}};
    iso_section_options o = iso_section_defaults();
    o.crossings = 7;
    o.starts = 40;
    o.seed = 5;
    o.at = at;
    o.at_count = 2;
    o.models = ISO_SHOW_BALL;
    kept *all = run(FREE("0.5"), &o, MOST);
    gsl_test_int((int)all->status, ISO_OK, "a section: %s", iso_context_message(ctx));
    gsl_test_int((int)all->rows, 43 * 7, "all rows");
    gsl_test_str(all->names, "orbit,crossing,t,tau,s,l,x", "columns");
    gsl_test(all->part < 1, "progress comes to its end");
    gsl_test(!all->result.nature.global || all->result.nature.axis != 2 || all->notes,
             "the global section is silent");
    int order = 0;
    for (size_t i = 0; i < all->rows; i++)
        order += all->row[i][0] != (double)(i / 7) || all->row[i][1] != (double)(i % 7 + 1);
    gsl_test_int(order, 0, "rows by orbit, then by crossing");
    o.starts = 0; /* each orbit of --at stays the same */
    kept *few = run(FREE("0.5"), &o, MOST);
    gsl_test_int(memcmp(all->row[0] + 2, few->row[0] + 2, 5 * sizeof(double)), 0, "the scene's own orbit");
    for (size_t i = 0; i < 14; i++)
        gsl_test_int(memcmp(all->row[41 * 7 + i] + 2, few->row[7 + i] + 2, 5 * sizeof(double)), 0,
                     "given starts, row %zu", i);
    release(few);
    release(all);
}

/* l is an angle: the seam at pi does not make neighbours distant. */
static void check_distance(void)
{
    const iso_crossing a = {.l = 3.1, .x = 0.25}, b = {.l = -3.1, .x = 0.25}, c = {.l = 3, .x = -0.25};
    gsl_test_rel(iso_section_distance(&a, &b), 2 * (M_PI - 3.1), 1e-13, "the distance across the seam");
    gsl_test_abs(iso_section_distance(&a, &c), 0.5, 1e-15, "the distance in x");
    gsl_test_abs(iso_section_distance(&c, &a), 0.5, 1e-15, "the other way");
}

/* --- both models ------------------------------------------------------------------------------------------------ */

/* k = -1 is integrable: the models stay together. k = 0.5 is not: chaotic orbits part. */
static void check_both(void)
{
    iso_section_options o = iso_section_defaults();
    o.starts = (size_t)tests_length(20, 100);
    o.crossings = (size_t)tests_length(60, 200);
    kept *k = run(FREE("-1"), &o, MOST);
    const iso_section_result *r = &k->result;
    gsl_test_int((int)r->models, ISO_SHOW_BOTH, "both models, if nothing is said");
    gsl_test(r->crossings[0] != k->rows || r->crossings[1] != k->rows || r->unequal, "equal numbers of crossings");
    gsl_test_int((int)k->pairs, (int)k->rows, "each row has its pair");
    gsl_test(!(r->distance > 0 && r->distance < 1e-9) || r->parted, "k = -1: together, %g apart", r->distance);
    release(k);
    k = run(FREE("0.5"), &o, MOST);
    r = &k->result;
    gsl_test(r->parted == 0 || r->parted == o.starts + 1 || r->parted_crossing < 5,
             "k = 0.5: %zu part, the first is %zu at %zu", r->parted, r->parted_orbit, r->parted_crossing);
    gsl_test(!(k->result.distance < ISO_SECTION_PARTED), "and others do not");
    release(k);
}

static void check_effects(void)
{
    iso_section_options o = iso_section_defaults();
    o.crossings = 3;
    o.shown = ISO_SHOW_BALL;
    kept *k = run(FREE("0.5") "effects: {gravity: {mgb: 0.3, up: [0, 0.6, 0.8]}, attitude: {}}\n", &o, MOST);
    gsl_test_str(k->names, "orbit,crossing,t,l,x,omega1,omega2,omega3,n1,n2,n3,e1,e2,e3", "gravity: columns");
    gsl_test(k->rows != 3 || k->result.nature.global || !strstr(k->words, "'gravity'"), "gravity: %s", k->words);
    gsl_test_int((int)k->result.models, ISO_SHOW_BALL, "gravity: the ball alone");
    release(k);
    k = run(FREE("0.5") "effects: {field: {linear: [0.1, 0.1, 0.05]}}\n", &o, MOST);
    gsl_test(k->rows != 3 || k->result.nature.global || k->result.distance > 1e-10, "a field has both models");
    release(k);
    o.axis = 0;
    k = run(FREE("0.5"), &o, MOST);
    gsl_test(k->result.nature.global || !strstr(k->words, "n_3 = 0 is global"), "another axis: %s", k->words);
    release(k);
    o.axis = ISO_AXIS_AUTO;
    o.column = iso_column_find("gamma3");
    k = run(FREE("0.5"), &o, MOST);
    kept *same = run(FREE("0.5"), NULL, 3);
    gsl_test(!k->result.nature.global || memcmp(k->row[2], same->row[2], 7 * sizeof(double)) != 0,
             "gamma3 = 0 is the section of axis 3");
    release(same);
    o.value = 0.3;
    release(k);
    k = run(FREE("0.5"), &o, MOST);
    gsl_test_str(k->names, "orbit,crossing,t,tau,s,omega1,omega2,omega3,n1,n2,n3", "an event has no chart");
    gsl_test(k->rows != 3 || !(k->result.distance < 1e-9) || k->notes != 1, "an event");
    release(k);
}

/* --- refusals and ends ------------------------------------------------------------------------------------------ */

static void refuse(const char *scene, const iso_section_options *o, iso_status status, const char *words)
{
    kept *k = run(scene, o, MOST);
    gsl_test_int((int)k->status, (int)status, "refused: %s", iso_context_message(ctx));
    gsl_test(!strstr(iso_context_message(ctx), words), "in the words '%s': %s", words, iso_context_message(ctx));
    gsl_test(k->headers || k->rows, "before any row");
    release(k);
}

/* What others refuse as well: foreign/test_refusals.c. */
static void check_refusals(void)
{
    static const double bad[][2] = {{NAN, 0}, {0, NAN}};
    iso_section_options o = iso_section_defaults();
    o.at_count = 1;
    for (int i = 0; i < 2; i++) o.at = &bad[i], refuse(FREE("0.5"), &o, ISO_BAD_INPUT, "outside the chart");
    o = iso_section_defaults();
    o.crossings = 0, refuse(FREE("0.5"), &o, ISO_BAD_ARGUMENT, "no crossing");
    o = iso_section_defaults();
    o.threads = -1, refuse(FREE("0.5"), &o, ISO_BAD_ARGUMENT, "threads");
    o = iso_section_defaults();
    refuse(REDUCED("0.5") "initial: {normal: [0.6, 0.8, 0], angular_velocity: [0, 0, 2]}\n" TIME, &o, ISO_BAD_INPUT,
           "boundary of the section");
    o.starts = 3, o.column = iso_column_find("omega1");
    refuse(FREE("0.5"), &o, ISO_BAD_INPUT, "no chart");
    o = iso_section_defaults();
    o.column = iso_column_find("pressure");
    refuse(FREE("0.5"), &o, ISO_BAD_INPUT, "needs the effect 'reactions'");
}

/* An orbit that cannot go on is counted; the others have all their rows. */
static void check_failure(void)
{
    iso_section_options o = iso_section_defaults();
    o.starts = 3;
    o.crossings = 4;
    kept *k = run(REDUCED("0.5") "initial: {normal: [0.6, 0.8, 0], angular_velocity: [0, 0, 2]}\n" TIME, &o, MOST);
    gsl_test_int((int)k->status, ISO_OK, "the others go on: %s", iso_context_message(ctx));
    gsl_test(k->rows != 12 || k->result.failed != 1 || k->result.failure != ISO_BAD_INPUT || k->row[0][0] != 1,
             "one orbit of four fails: %s", k->result.words);
    gsl_test(strncmp(k->result.words, "orbit 0: this orbit is the rotation about axis 3", 48) != 0, "the reason");
    release(k);
}

static void check_stop(void)
{
    iso_section_options o = iso_section_defaults();
    o.starts = 5;
    o.crossings = 400;
    int left = INT_MAX;
    iso_context_set_monitor(ctx, some_times, &left);
    kept *all = run(FREE("0.5"), &o, MOST);
    left = (INT_MAX - left) / 2;
    kept *k = run(FREE("0.5"), &o, MOST);
    iso_context_set_monitor(ctx, NULL, NULL);
    gsl_test_int((int)k->status, ISO_STOPPED, "stopped");
    gsl_test(k->rows == 0 || k->rows == all->rows, "before its end, after %zu rows", k->rows);
    int wrong = 0;
    for (size_t i = 0; i < k->rows; i++) {
        const size_t at = (size_t)k->row[i][0] * 400 + (size_t)k->row[i][1] - 1;
        wrong += memcmp(k->row[i], all->row[at], 7 * sizeof(double)) != 0;
    }
    gsl_test_int(wrong, 0, "rows before are the right ones");
    release(k);
    release(all);
}

int main(void)
{
    ctx = iso_context_create();
    check_rows();
    check_distance();
    check_both();
    check_effects();
    check_refusals();
    check_failure();
    check_stop();
    iso_context_free(ctx);
    return gsl_test_summary();
}

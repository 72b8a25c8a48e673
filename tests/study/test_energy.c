/* test_energy.c - energies along a trajectory (study/energy.h), and what is up in its axes of space
 * (iso_record_up). */
#include "runs.h"

#include "orbit/description.h"
#include "study/energy.h"

#define BALL "ball: {mass: 0.1, radius: 0.03, inertia: [2.8e-5, 3.6e-5, 4.4e-5]}\n"
#define IN_BOWL BALL "surface: {kind: inside, radius: 0.3}\n"
#define ON_PLANE BALL "surface: {kind: plane}\n"
#define ROLLS "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [4, -3, 0]}\ntime: {end: 1, step: 0.02}\n"
#define WEIGHT "gravity: {g: 9.81, up: [-0.48, 0.6, -0.64]}"

static iso_record *record_of(const char *text)
{
    const iso_scene scene = parse(text);
    iso_record *r = NULL;
    const iso_sink sink = {.data = NULL};
    if (iso_run(ctx, &scene, NULL, &sink, &r, NULL) != ISO_OK)
        fprintf(stderr, "%s\n", iso_context_message(ctx)), exit(1);
    return r;
}

static iso_record *energies_of(const iso_record *r)
{
    iso_params p;
    iso_record *e;
    if (iso_record_params(ctx, r, &p) != ISO_OK) exit(1);
    gsl_test((int)iso_record_energies(ctx, &p, r, &e), "energies: %s", iso_context_message(ctx));
    return e;
}

static double at(const iso_record *r, size_t row, const char *name)
{
    return iso_record_const_row(r, row)[iso_record_find(r, name)];
}

/* The largest |h(row) - h(0)|, and the largest h(row) - h(row - 1), of the energies' largest. */
static void drift_of(const iso_record *e, double *drift, double *rise)
{
    double size = 0;
    *drift = *rise = 0;
    for (size_t i = 0; i < iso_record_rows(e); i++) {
        size = fmax(size, fabs(at(e, i, "h")));
        if (iso_record_find(e, "kinetic") >= 0) size = fmax(size, at(e, i, "kinetic"));
        *drift = fmax(*drift, fabs(at(e, i, "h") - at(e, 0, "h")));
        if (i > 0) *rise = fmax(*rise, at(e, i, "h") - at(e, i - 1, "h"));
    }
    *drift /= size, *rise /= size;
}

/* The potential energy is m g times the height of the centre, up to a constant. */
static double off_the_height(const iso_record *r, const iso_record *e)
{
    static const char *const names[] = {"centre1", "centre2", "centre3"};
    double up[3], worst = 0, first = 0, size = 0;
    int c[3];
    if (!iso_record_up(ctx, r, up) || !iso_record_find_all(r, 3, names, c, NULL)) return INFINITY;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        const double *x = iso_record_const_row(r, i);
        const double rest =
            at(e, i, "potential") - 0.1 * 9.81 * (x[c[0]] * up[0] + x[c[1]] * up[1] + x[c[2]] * up[2]);
        if (i == 0) first = rest;
        worst = fmax(worst, fabs(rest - first));
        size = fmax(size, at(e, i, "kinetic"));
    }
    return worst / size;
}

static void check_conserved(const char *what, const char *text)
{
    iso_record *r = record_of(text), *e = energies_of(r);
    double drift, rise, worst = 0;
    drift_of(e, &drift, &rise);
    gsl_test(!(drift <= 1e-12), "%s: h is constant to %.2g", what, drift);
    for (size_t i = 0; i < iso_record_rows(e) && iso_record_columns(e) == 4; i++)
        worst = fmax(worst, fabs(at(e, i, "kinetic") + at(e, i, "potential") - at(e, i, "h")));
    gsl_test(!(worst <= 1e-15), "%s: h = kinetic + potential to %.2g", what, worst);
    gsl_test(iso_record_rows(e) != iso_record_rows(r) || strcmp(iso_record_name(e, 0), "t") != 0, "%s: rows over t",
             what);
    if (iso_record_columns(e) == 4) {
        const double off = off_the_height(r, e);
        gsl_test(!(off <= 1e-12), "%s: potential = m g height to %.2g", what, off);
    }
    iso_record_free(e);
    iso_record_free(r);
}

static void check_energies(void)
{
    check_conserved("bowl", IN_BOWL ROLLS "effects: {" WEIGHT ", attitude: {}}\n");
    check_conserved("bowl, a frame of its own",
                    IN_BOWL ROLLS "effects: {" WEIGHT ", attitude: {quaternion: [0.5, -0.5, 0.5, 0.5]}}\n");
    check_conserved("slope", ON_PLANE ROLLS "effects: {" WEIGHT ", attitude: {}}\n");
    check_conserved("twist without resistance",
                    IN_BOWL ROLLS "effects: {" WEIGHT ", attitude: {}, twist: {resistance: 0}}\n");
    check_conserved("free", IN_BOWL ROLLS);
    iso_record *r =
        record_of(IN_BOWL ROLLS "effects: {" WEIGHT ", attitude: {}, rolling_resistance: {coefficient: 1e-6}}\n");
    iso_record *e = energies_of(r);
    double drift, rise;
    drift_of(e, &drift, &rise);
    gsl_test(!(rise <= 0 && drift > 1e-3), "resistance: h falls in every row, by %.2g (rises by %.2g)", drift, rise);
    gsl_test(!(off_the_height(r, e) <= 1e-12), "resistance: potential = m g height");
    iso_record_free(e);
    iso_record_free(r);
    r = record_of(ON_PLANE ROLLS "effects: {" WEIGHT "}\n");
    e = energies_of(r);
    gsl_test(e != NULL, "on a slope the energy is not known without the height");
    iso_record_free(e);
    iso_record_free(r);
}

/* Up by the lines of the file is up by the columns of every row; without both it is not known. */
static void check_up(void)
{
    static const char *const frames[] = {"attitude: {}", "attitude: {quaternion: [0.5, -0.5, 0.5, 0.5]}"};
    for (int which = 0; which < 2; which++) {
        char text[600];
        snprintf(text, sizeof text, IN_BOWL ROLLS "effects: {" WEIGHT ", %s}\n", frames[which]);
        iso_record *r = record_of(text), *row = record_of(text);
        double up[3], again[3], worst = 0;
        gsl_test(!iso_record_up(ctx, r, up), "up is known");
        gsl_test(which == 0 && !(fabs(up[2] - 1) + fabs(up[0]) + fabs(up[1]) <= 1e-15), "axis 3 is up");
        gsl_test(which == 1 && !(fabs(up[2] - 1) > 0.1), "a frame of its own");
        iso_record_set(ctx, row, "attitude.quaternion", "1 0 0");
        for (size_t i = 0; i < iso_record_rows(r); i++) {
            memcpy(iso_record_row(row, 0), iso_record_const_row(r, i), iso_record_columns(r) * sizeof(double));
            if (!iso_record_up(ctx, row, again)) worst = INFINITY;
            for (int c = 0; c < 3; c++) worst = fmax(worst, fabs(again[c] - up[c]));
        }
        gsl_test(!(worst <= 1e-12), "by the columns of each row: %.2g", worst);
        iso_record_free(r);
        iso_record_free(row);
    }
    iso_record *r = record_of(IN_BOWL ROLLS "effects: {attitude: {}}\n");
    double up[3];
    gsl_test(iso_record_up(ctx, r, up), "without gravity nothing is up");
    iso_record_set(ctx, r, "gravity.up", "0 0 3");
    gsl_test(iso_record_up(ctx, r, up), "nor with a line that is no unit vector");
    iso_record_free(r);
}

/* What is no ball's trajectory is refused. */
static void check_refused(void)
{
    static const char *const names[] = {"t", "n1", "n2", "n3"};
    iso_params p;
    iso_record *r, *e = NULL;
    double *row;
    iso_params_reduced(ctx, 0.5, (double[]){1, 2, 5}, &p);
    if (iso_record_create(ctx, 4, names, &r) != ISO_OK) exit(1);
    gsl_test(iso_record_energies(ctx, &p, r, &e) != ISO_BAD_INPUT || e, "no rows: %s", iso_context_message(ctx));
    if (iso_record_append(ctx, r, &row) != ISO_OK) exit(1);
    row[3] = 1;
    gsl_test(iso_record_energies(ctx, &p, r, &e) != ISO_BAD_INPUT || e, "no omega: %s", iso_context_message(ctx));
    iso_record_set(ctx, r, "effects", "gravity");
    gsl_test(iso_record_energies(ctx, &p, r, &e) != ISO_BAD_INPUT || e, "no line: %s", iso_context_message(ctx));
    iso_record_free(r);
}

int main(void)
{
    ctx = iso_context_create();
    check_energies();
    check_up();
    check_refused();
    iso_context_free(ctx);
    return gsl_test_summary();
}

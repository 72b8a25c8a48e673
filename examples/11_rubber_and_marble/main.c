/* Rubber and marble: one ball on a sphere, three contacts that resist twisting more or less, the same start.
 *
 *     cc main.c $(pkg-config --cflags --libs isoroll) -Wl,-rpath,$(pkg-config --variable=libdir isoroll) -o contacts
 *     ./contacts
 *
 * Three balls side by side: the rubber ball of the paper, whose contact cannot twist; a contact with the resistance
 * c = 10; and the classical Chaplygin ball, c = 0. Each n takes its own path. The spin (omega,n) is 0, small, large.
 * The first and the last ball keep their energy, the second loses some. The file scene.yaml in this folder gives the
 * same scenes to the command: remove `twist`, or change its number.
 */
#include <math.h>
#include <stdio.h>

#include <isoroll/isoroll.h>

enum { CONTACTS = 3, ROWS = 11 };

static const char *const names[CONTACTS] = {"rubber", "c = 10", "c = 0"};
static const char *const effects[CONTACTS] = {"", "effects: {twist: {resistance: 10}}\n",
                                              "effects: {twist: {resistance: 0}}\n"};
static const double J[3] = {1.4, 2.1, 3.0}, D = 0.5;

/* The rows omega, n of one contact at t = 0, 2, 4, ... */
static iso_status roll(iso_context *ctx, int contact, double rows[ROWS][6])
{
    char text[400];
    double times[ROWS];
    iso_scene *scene = NULL;
    iso_solution *solution = NULL;
    const int length = snprintf(text, sizeof text,
                                "reduced: {k: 0.75, J: [%g, %g, %g], D: %g}\n"
                                "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}\n"
                                "time: {end: 20}\n"
                                "output: {columns: [omega1, omega2, omega3, n1, n2, n3]}\n%s",
                                J[0], J[1], J[2], D, effects[contact]);
    for (int row = 0; row < ROWS; row++) times[row] = 2 * row;
    iso_status status = iso_scene_parse(ctx, names[contact], text, (size_t)length, &scene);
    if (status == ISO_OK) status = iso_solution_create(ctx, scene, &solution);
    if (status == ISO_OK) {
        status = iso_solution_at(solution, times, ROWS, rows[0], NULL, 0);
        if (status != ISO_OK) fprintf(stderr, "%s\n", iso_context_message(iso_solution_context(solution)));
    }
    iso_solution_free(solution);
    iso_scene_free(scene);
    return status;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The energy (K,omega)/2, K = J omega - D (omega,n) n. */
static double energy(const double row[6])
{
    const double *w = row, *n = row + 3;
    double h = -D * dot(w, n) * dot(w, n) / 2;
    for (int i = 0; i < 3; i++) h += J[i] * w[i] * w[i] / 2;
    return h;
}

int main(void)
{
    static double rows[CONTACTS][ROWS][6];
    double drift[CONTACTS];
    iso_context *ctx = iso_context_create();
    for (int c = 0; c < CONTACTS; c++)
        if (!ctx || roll(ctx, c, rows[c]) != ISO_OK)
            return fprintf(stderr, "contacts: %s\n", ctx ? iso_context_message(ctx) : "no memory"), 1;
    printf("%4s", "t");
    for (int c = 0; c < CONTACTS; c++) printf(" | %-7s %7s %7s %8s %7s", names[c], "n2", "n3", "spin", "energy");
    printf("\n");
    for (int row = 0; row < ROWS; row++) {
        printf("%4d", 2 * row);
        for (int c = 0; c < CONTACTS; c++) {
            const double *w = rows[c][row], *n = w + 3;
            printf(" | %7.4f %7.4f %7.4f %8.4f %7.4f", n[0], n[1], n[2], dot(w, n), energy(w));
        }
        printf("\n");
    }
    for (int c = 0; c < CONTACTS; c++) drift[c] = energy(rows[c][ROWS - 1]) / energy(rows[c][0]) - 1;
    iso_context_free(ctx);
    return fabs(drift[0]) < 1e-11 && fabs(drift[2]) < 1e-11 && drift[1] < 0 ? 0 : 1;
}

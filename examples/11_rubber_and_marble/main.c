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
#include <stdio.h>

#include <isoroll/isoroll.h>

enum { CONTACTS = 3, ROWS = 11 };

static const char *const names[CONTACTS] = {"rubber", "c = 10", "c = 0"};

/* The orbit of one contact; NULL with a message in the context. */
static iso_orbit *open_orbit(iso_context *ctx, const iso_params *p, int contact)
{
    const double resistance = contact == 1 ? 10 : 0;
    iso_effects effects = iso_effects_default();
    iso_start start;
    iso_orbit *orbit = NULL;
    if (contact > 0 && iso_effects_set(ctx, &effects, "twist", "resistance", 1, &resistance)) return NULL;
    if (iso_start_ball(ctx, (double[]){0.9, -0.3, -0.225}, (double[]){0.36, 0.48, 0.8}, ISO_SPIN_REFUSE, &start))
        return NULL;
    iso_orbit_options options = iso_orbit_defaults(&start);
    options.effects = &effects;
    return iso_orbit_create(ctx, p, &start, &options, &orbit) ? NULL : orbit;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The energy (K,omega)/2, K = J omega - D (omega,n) n. */
static double energy(const iso_params *p, const double w[3], const double n[3])
{
    double h = -p->D * dot(w, n) * dot(w, n) / 2;
    for (int i = 0; i < 3; i++) h += p->J[i] * w[i] * w[i] / 2;
    return h;
}

int main(void)
{
    const double J[3] = {1.4, 2.1, 3.0};
    iso_context *ctx = iso_context_create();
    iso_params p;
    iso_orbit *orbit[CONTACTS] = {NULL};
    double first[CONTACTS], last[CONTACTS] = {0};
    int failed = !ctx || iso_params_reduced(ctx, 0.75, J, &p) || iso_params_set_D(ctx, 0.5, &p);
    for (int c = 0; c < CONTACTS && !failed; c++) failed = !(orbit[c] = open_orbit(ctx, &p, c));
    printf("%4s", "t");
    for (int c = 0; c < CONTACTS; c++) printf(" | %-7s %7s %7s %8s %7s", names[c], "n2", "n3", "spin", "energy");
    printf("\n");
    for (int row = 0; row < ROWS && !failed; row++) {
        printf("%4d", 2 * row);
        for (int c = 0; c < CONTACTS && !failed; c++) {
            iso_sample s;
            failed = iso_orbit_at(orbit[c], 2 * row, &s) != ISO_OK;
            if (failed) break;
            const double *w = s.ball, *n = s.ball + 3;
            last[c] = energy(&p, w, n);
            if (row == 0) first[c] = last[c];
            printf(" | %7.4f %7.4f %7.4f %8.4f %7.4f", n[0], n[1], n[2], dot(w, n), last[c]);
        }
        printf("\n");
    }
    if (failed) fprintf(stderr, "contacts: %s\n", ctx ? iso_context_message(ctx) : "no memory");
    for (int c = 0; c < CONTACTS; c++) iso_orbit_free(orbit[c]);
    iso_context_free(ctx);
    if (failed) return 1;
    const double rubber = last[0] / first[0] - 1, marble = last[2] / first[2] - 1;
    return rubber < 1e-11 && rubber > -1e-11 && marble < 1e-11 && marble > -1e-11 && last[1] < first[1] ? 0 : 1;
}

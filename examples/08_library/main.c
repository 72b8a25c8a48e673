/* Where is the ball at t = 10? A small program that uses the library and computes the answer in two ways.
 *
 *     cc main.c -o twice $(pkg-config --cflags --libs isoroll) -lm && ./twice
 *
 * (installed in a prefix of your own, first: export PKG_CONFIG_PATH=PREFIX/lib/pkgconfig)
 *
 * The first answer integrates the ball (9). The second integrates the point on a sphere (24) and maps the state back.
 * The two states agree to about 13 digits. The integral F (11) of the shell with B = 2A is the same at both times.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <isoroll/isoroll.h>

/* A globe of 1.8 kg, radius 0.3 m, rolls around a fixed ball of radius 0.15 m (../02_neumann_shell): k = -1. */
static const char text[] = "ball: {mass: 1.8, radius: 0.3, inertia: [0.081, 0.108, 0.135]}\n"
                           "surface: {kind: shell, radius: 0.15}\n"
                           "initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.8, -0.6, 0]}\n"
                           "time: {end: 10}\n"
                           "output: {as: ball, columns: [omega1, omega2, omega3, n1, n2, n3]}\n";

/* F = [ (Jw,Jw) + det J (w,Jw)(J^-1 n,J^-1 n) ] / (n,J^-1 n), constant for k = -1. */
static double F(const double J[3], const double state[6])
{
    const double *w = state, *n = state + 3;
    double JwJw = 0, wJw = 0, nn = 0, g = 0;
    for (int i = 0; i < 3; i++) {
        JwJw += J[i] * w[i] * J[i] * w[i];
        wJw += w[i] * J[i] * w[i];
        nn += n[i] * n[i] / (J[i] * J[i]);
        g += n[i] * n[i] / J[i];
    }
    return (JwJw + J[0] * J[1] * J[2] * wJw * nn) / g;
}

/* The states at t = 0 and t = 10, found by integrating the model `backend`. */
static iso_status ask(iso_context *ctx, iso_scene *scene, const char *backend, double states[2][6])
{
    iso_solution *solution;
    iso_status status = iso_scene_set(ctx, scene, "backend", backend);
    if (status == ISO_OK) status = iso_solution_create(ctx, scene, &solution);
    if (status != ISO_OK) return status;
    status = iso_solution_at(solution, (double[]){0, 10}, 2, states[0], NULL, 0);
    iso_solution_free(solution);
    return status;
}

int main(void)
{
    static const char *const names[] = {"omega1", "omega2", "omega3", "n1", "n2", "n3"};
    double a[2][6], b[2][6], J[6], worst = 0;
    iso_context *ctx = iso_context_create();
    iso_scene *scene = NULL;
    if (!ctx || iso_scene_parse(ctx, "globe", text, strlen(text), &scene) || ask(ctx, scene, "ball", a) ||
        ask(ctx, scene, "point", b)) {
        fprintf(stderr, "twice: %s\n", ctx ? iso_context_message(ctx) : "no memory");
        return 1;
    }
    iso_scene_numbers(scene, "J", J);
    printf("t = 10         backend ball         backend point  difference\n");
    for (int i = 0; i < 6; i++) {
        printf("%-6s %20.15f  %20.15f  %10.1e\n", names[i], a[1][i], b[1][i], b[1][i] - a[1][i]);
        worst = fmax(worst, fabs(b[1][i] - a[1][i]));
    }
    const double F0 = F(J, a[0]), F10 = F(J, a[1]);
    printf("F = %.15f at t = 0, %.15f at t = 10\n", F0, F10);
    iso_scene_free(scene);
    iso_context_free(ctx);
    return worst < 1e-10 && fabs(F10 / F0 - 1) < 1e-11 ? 0 : 1;
}

/* Where is the ball at t = 10? A small program that uses the library and computes the answer in two ways.
 *
 *     cc main.c $(pkg-config --cflags --libs isoroll) -Wl,-rpath,$(pkg-config --variable=libdir isoroll) -lm -o twice
 *     ./twice
 *
 * (installed in a prefix of your own, first: export PKG_CONFIG_PATH=PREFIX/lib/pkgconfig)
 *
 * The first answer integrates the ball (9). The second integrates the point on a sphere (24) and maps the state back.
 * The two states agree to about 13 digits. The integral F (11) of the shell with B = 2A is the same at both times.
 */
#include <math.h>
#include <stdio.h>

#include <isoroll/isoroll.h>

/* F = [ (Jw,Jw) + det J (w,Jw)(J^-1 n,J^-1 n) ] / (n,J^-1 n), constant for k = -1. */
static double F(const iso_params *p, const double w[3], const double n[3])
{
    double JwJw = 0, wJw = 0, nn = 0, g = 0;
    for (int i = 0; i < 3; i++) {
        JwJw += p->J[i] * w[i] * p->J[i] * w[i];
        wJw += w[i] * p->J[i] * w[i];
        nn += n[i] * n[i] / (p->J[i] * p->J[i]);
        g += n[i] * n[i] / p->J[i];
    }
    return (JwJw + p->det_J * wJw * nn) / g;
}

/* The ball at t = 10, found by integrating the model `backend`. */
static iso_status ask(iso_context *ctx, const iso_params *p, const iso_start *start, iso_backend backend,
                      iso_sample *at)
{
    iso_orbit *orbit;
    iso_orbit_options options = iso_orbit_defaults(start);
    options.backend = backend;
    iso_status status = iso_orbit_create(ctx, p, start, &options, &orbit);
    if (status != ISO_OK) return status;
    status = iso_orbit_at(orbit, 10, at);
    iso_orbit_free(orbit);
    return status;
}

int main(void)
{
    /* A globe of 1.8 kg, radius 0.3 m, rolls around a fixed ball of radius 0.15 m (../02_neumann_shell): k = -1. */
    const iso_body globe = {1.8, 0.3, {0.081, 0.108, 0.135}, ISO_SHELL, 0.15};
    const double w[3] = {0.8, -0.6, 0}, n[3] = {0.36, 0.48, 0.8};
    iso_context *ctx = iso_context_create();
    iso_params p;
    iso_start start;
    iso_sample a, b;
    if (!ctx || iso_params_physical(ctx, &globe, &p) || iso_start_ball(ctx, w, n, false, &start) ||
        ask(ctx, &p, &start, ISO_BACKEND_BALL, &a) || ask(ctx, &p, &start, ISO_BACKEND_POINT, &b)) {
        fprintf(stderr, "twice: %s\n", ctx ? iso_context_message(ctx) : "no memory");
        return 1;
    }
    double worst = 0;
    printf("t = 10         backend ball         backend point  difference\n");
    for (int i = 0; i < ISO_STATE; i++) {
        printf("%-6s %20.15f  %20.15f  %10.1e\n", iso_system_at(ISO_BALL)->state[i], a.ball[i], b.ball[i],
               b.ball[i] - a.ball[i]);
        worst = fmax(worst, fabs(b.ball[i] - a.ball[i]));
    }
    const double F0 = F(&p, w, n), F10 = F(&p, a.ball, a.ball + 3);
    printf("F = %.15f at t = 0, %.15f at t = 10\n", F0, F10);
    iso_context_free(ctx);
    return worst < 1e-10 && fabs(F10 / F0 - 1) < 1e-11 ? 0 : 1;
}

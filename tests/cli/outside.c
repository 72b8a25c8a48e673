/* outside.c - a program of somebody else, built outside the tree against the installed library (install.sh). */
#include <stdio.h>
#include <string.h>

#include <isoroll/isoroll.h>
#include <isoroll/map/state.h>
#include <isoroll/task/cost/cost.h>

int main(void)
{
    const double J[3] = {1.4, 2.1, 3.0};
    iso_params p = {0};
    iso_context *ctx = iso_context_create();
    if (!ctx || iso_params_reduced(ctx, -1, J, &p) != ISO_OK) {
        fprintf(stderr, "outside: %s\n", ctx ? iso_context_message(ctx) : "no memory");
        return 1;
    }
    const double ball[ISO_STATE] = {0.3, -0.2, 0.5, 0, 0.6, 0.8};
    const iso_cost_options cost = iso_cost_defaults();
    const int same = strcmp(iso_version(), ISO_VERSION) == 0 && iso_ball_energy(&p, ball) > 0;
    const int right =
        same && cost.size == sizeof cost && p.k == -1 && p.J[0] == J[0] && p.J[1] == J[1] && p.J[2] == J[2];
    printf("k = %g\n", p.k);
    iso_context_free(ctx);
    return right ? 0 : 1;
}

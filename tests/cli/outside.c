/* outside.c - a program of somebody else, built outside the tree against the installed library (install.sh). */
#include <stdio.h>

#include <isoroll/isoroll.h>

int main(void)
{
    const double J[3] = {1.4, 2.1, 3.0};
    iso_params p = {0};
    iso_context *ctx = iso_context_create();
    if (!ctx || iso_params_reduced(ctx, -1, J, &p) != ISO_OK) {
        fprintf(stderr, "outside: %s\n", ctx ? iso_context_message(ctx) : "no memory");
        return 1;
    }
    const int right = p.k == -1 && p.J[0] == J[0] && p.J[1] == J[1] && p.J[2] == J[2];
    printf("k = %g\n", p.k);
    iso_context_free(ctx);
    return right ? 0 : 1;
}

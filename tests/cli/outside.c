/* outside.c - a program of somebody else, built outside the tree against the installed library (install.sh). */
#include <stdio.h>
#include <string.h>

#include <isoroll/isoroll.h>

int main(void)
{
    static const char text[] = "reduced: {k: -1, J: [1.4, 2.1, 3]}\n"
                               "initial: {normal: [0, 0.6, 0.8], angular_velocity: [0.3, -0.4, 0.3]}\n"
                               "time: {end: 1}\n";
    double k[6] = {0}, J[6] = {0};
    iso_scene *scene = NULL;
    iso_record *table[ISO_TABLES];
    iso_context *ctx = iso_context_create();
    if (!ctx || iso_scene_parse(ctx, "outside", text, strlen(text), &scene) != ISO_OK ||
        iso_study_ask(ctx, "run", scene, NULL, "t-end=2", NULL, table) != ISO_OK) {
        fprintf(stderr, "outside: %s\n", ctx ? iso_context_message(ctx) : "no memory");
        return 1;
    }
    iso_scene_numbers(scene, "k", k);
    iso_scene_numbers(scene, "J", J);
    const int right = strcmp(iso_version(), ISO_VERSION) == 0 && iso_record_rows(table[0]) == 101 && k[0] == -1 &&
                      J[0] == 1.4 && J[1] == 2.1 && J[2] == 3.0;
    printf("k = %g\n", k[0]);
    iso_record_free(table[0]);
    iso_scene_free(scene);
    iso_context_free(ctx);
    return right ? 0 : 1;
}

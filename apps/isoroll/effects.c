/* effects.c - prints the effects of an orbit. */
#include <stdio.h>

#include "scene_options.h"

static void print_number(const iso_effects *effects, const iso_effect_number *n)
{
    const double *x = iso_effect_values(effects, n);
    printf("  %s =", n->name);
    for (int i = 0; i < n->count; i++) printf(" %.10g", x[i]);
}

void print_effects(const iso_effects *effects, bool docs)
{
    int shown = 0;
    for (int e = 0; e < ISO_EFFECTS; e++) {
        if (!effects->on[e]) continue;
        printf("%s  %-18s", shown++ ? "" : "effects\n", iso_effect_list[e]->name);
        if (docs) printf(" %s", iso_effect_list[e]->doc);
        if (docs && iso_effect_list[e]->numbers) printf("\n  %-18s", "");
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; n && n->name; n++) print_number(effects, n);
        printf("\n");
    }
    if (shown) printf("\n");
}

/* effects.c - the ball and the effects that act, in words. */
#include <math.h>
#include <stdio.h>

#include "base/number_impl.h"
#include "orbit/orbit_impl.h"
#include "study/study_impl.h"

void iso_params_print(FILE *to, const iso_params *p)
{
    const bool given = p->body.surface == ISO_REDUCED;
    fprintf(to, "k = %s, J =", given ? ISO_SHORT(p->k) : ISO_ROUNDED(p->k, 15));
    for (int i = 0; i < 3; i++) fprintf(to, " %s", given ? ISO_SHORT(p->J[i]) : ISO_ROUNDED(p->J[i], 15));
}

/* The text and the numbers of an effect, on lines of their own or not; none that a scene alone states. */
static void print_numbers(FILE *to, const iso_effects *effects, iso_effect_id id, const char *begin)
{
    const iso_effect *effect = iso_effect_list[id];
    iso_effect_number n;
    for (int i = 0; effect->expressions && effect->expressions[i]; i++) {
        if (!iso_written_has(effects, id, i)) continue;
        fprintf(to, "%s  %s = %s", begin, effect->expressions[i], effects->written[effect->written].expression[i]);
        if (*begin != '\n') begin = "";
    }
    for (int i = 0; iso_effect_number_at(effects, id, i, &n); i++) {
        if (n.scene_only) continue;
        const double *x = iso_effect_values(effects, id, &n);
        fprintf(to, "%s  %s =", begin, n.name);
        if (n.kind == ISO_NUMBER_WORD) fprintf(to, " %s", x[0] < 0 ? "measured" : n.word((int)x[0]));
        for (int j = 0; n.kind != ISO_NUMBER_WORD && j < n.count; j++) fprintf(to, " %s", ISO_SHORT(x[j]));
        begin = "";
    }
}

void iso_effects_print(FILE *to, const iso_effects *effects, bool docs)
{
    char line[32];
    int shown = 0;
    snprintf(line, sizeof line, "\n    ");
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        if (!effects->on[e]) continue;
        fprintf(to, "%s  %-18s", shown++ ? "" : "effects\n", iso_effect_list[e]->name);
        if (docs) fprintf(to, " %s", iso_effect_list[e]->doc);
        print_numbers(to, effects, e, docs ? line : "");
        fprintf(to, "\n");
    }
    if (shown) fprintf(to, "\n");
}

char *iso_fraction_text(char text[static ISO_FRACTION_SIZE], double x)
{
    snprintf(text, ISO_FRACTION_SIZE, "%.6g", x);
    for (int below = 1; below < 13; below++) {
        const double above = nearbyint(x * below);
        if (above == 0 || fabs(above) >= 100 || fabs(above / below - x) > 1e-15 * fabs(x)) continue;
        snprintf(text, ISO_FRACTION_SIZE, below > 1 ? "%.0f/%d" : "%.0f", above, below);
        break;
    }
    return text;
}

char *iso_ball_text(char text[static ISO_BALL_SIZE], const iso_params *p)
{
    char k[ISO_FRACTION_SIZE];
    snprintf(text, ISO_BALL_SIZE, "k = %s, J = (%.6g, %.6g, %.6g)", iso_fraction_text(k, p->k), p->J[0], p->J[1],
             p->J[2]);
    return text;
}

/* effects_columns.c - the columns of all effects, counted through (effect.h). */
#include "model/effects_impl.h"

const char *iso_effect_column_name(int i, iso_effect_id *effect, const iso_effect_column **group, int *in_group)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_column *c = iso_effect_list[e]->columns; c && c->name; c++) {
            if (i < c->count) {
                if (effect) *effect = e;
                if (group) *group = c;
                if (in_group) *in_group = i;
                return c->column[i];
            }
            i -= c->count;
        }
    return NULL;
}

int iso_effect_columns(void)
{
    return iso_effect_first_column(ISO_EFFECTS);
}

int iso_effect_first_column(iso_effect_id id)
{
    int count = 0;
    for (iso_effect_id e = 0; e < id; e++)
        for (const iso_effect_column *c = iso_effect_list[e]->columns; c && c->name; c++) count += c->count;
    return count;
}

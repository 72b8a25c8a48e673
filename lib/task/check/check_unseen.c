/* check_unseen.c - which columns and lines of a file its check does not depend on (check_impl.h). A test changes every
 * number of many files by a millionth: a residual notices, or the number is named here. */
#include <stdio.h>
#include <string.h>

#include "task/check/check_impl.h"

static bool is_followed(const checker *c)
{
    return c->model[ISO_BALL].followed || c->model[ISO_POINT].followed;
}

/* A residual has the name of the line: it was compared with rows. */
static bool is_compared(const checker *c, const char *name)
{
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < c->model[k].found.count; i++)
            if (strcmp(c->model[k].found.residual[i].name, name) == 0) return true;
    return false;
}

/* Whether the line is a number or a text of the equations. What turns with the ball is taken from the rows. */
static bool is_of_equations(const checker *c, const char *key)
{
    char line[ISO_NAME_SIZE];
    if (strcmp(key, "k") == 0 || strcmp(key, "J") == 0 || strcmp(key, "effects") == 0) return true;
    const bool radius = strcmp(key, "radius") == 0, D = strcmp(key, "D") == 0;
    if ((radius || D) && iso_checker_has_effects(c)) return true;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        const size_t length = strlen(effect->name);
        if (D && effect->needs_D && c->effects.on[e] && !c->effects.idle[e]) return true;
        if (!c->effects.on[e] || strncmp(key, effect->name, length) != 0 || key[length] != '.') continue;
        for (const iso_effect_number *n = effect->numbers; n && n->name; n++) {
            iso_effect_line(line, effect, n->name);
            if (strcmp(line, key) == 0) return !n->turns_with && !c->effects.idle[e];
        }
        return true;
    }
    return false;
}

void iso_checking_unseen(iso_checking *c, void (*note)(void *data, const char *name), void *data)
{
    char name[ISO_NAME_SIZE + 8];
    const char *key, *value;
    if (!is_followed(c)) note(data, "the flow from row to row");
    for (size_t i = 0; i < c->width; i++) {
        const int column = iso_column_find(iso_record_name(c->record, i));
        const bool orbit = strcmp(iso_record_name(c->record, i), ISO_ORBIT_COLUMN) == 0;
        if (!orbit && (column < 0 || !c->looked[column])) note(data, iso_record_name(c->record, i));
    }
    for (size_t i = 0; iso_record_line(c->record, i, &key, &value); i++) {
        snprintf(name, sizeof name, "# %.*s", ISO_NAME_SIZE, key);
        if (!is_compared(c, name) && !(is_followed(c) && is_of_equations(c, key))) note(data, name);
    }
}

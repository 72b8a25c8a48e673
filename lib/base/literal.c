/* literal.c - numbers as they are written (literal_impl.h). */
#include <stdlib.h>
#include <string.h>

#include "base/literal_impl.h"

const iso_literal *iso_literal_find(const iso_literals *all, const char *name)
{
    for (int i = 0; i < all->count; i++)
        if (strcmp(all->one[i].name, name) == 0) return &all->one[i];
    return NULL;
}

void iso_literals_clear(iso_literals *all)
{
    for (int i = 0; i < all->count; i++)
        for (int j = 0; j < all->one[i].count; j++) free(all->one[i].text[j]);
    all->count = 0;
}

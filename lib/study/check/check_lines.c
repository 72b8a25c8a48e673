/* check_lines.c - what lines state of the energy and of the start, against a row (check_impl.h). These numbers make
 * no motion of their own, so that no flow shows when they are wrong. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/model_impl.h"
#include "orbit/orbit_impl.h"
#include "study/check/check_impl.h"

/* --- energy: h, eps, c ------------------------------------------------------------------------------------------ */

/* The energy h in own units that a line states, by itself or by eps; false: it does not, or *status. */
static bool stated_energy(const checker *c, const iso_units *units, const char *key, double *h, iso_status *status)
{
    const bool eps = strcmp(key, "eps") == 0;
    if (!iso_record_get_numbers(c->ctx, c->record, key, 1, h, status)) return false;
    *h /= iso_unit(units, eps ? iso_dimension_eps : iso_dimension_h);
    if (eps) *h = iso_energy(&units->own, *h);
    return isfinite(*h);
}

/* How far the first row is from the energy h, relative to the size of its terms. A point has it if its H is that of
 * its level. */
static double off_energy(const checked_model *m, const double own[], double h)
{
    double size;
    iso_problem f = m->expect.problem;
    const bool ball = m->kind == ISO_BALL;
    if (!ball) f.eps = iso_coupling(&f.p, h);
    const double here = m->system->energy(&f, own, &size), wanted = ball ? h : m->expect.level;
    return here == wanted ? 0 : fabs(here - wanted) / fmax(size, fabs(wanted));
}

/* A free point may have any H: then only h and eps can be compared, with each other. */
static void take_level(checked_model *m, const double own[], double eps)
{
    double size;
    iso_problem f = m->expect.problem;
    f.eps = eps;
    m->expect.level = m->system->energy(&f, own, &size);
}

static void note_line(checker *c, checked_model *m, const char *key, const char *what, double off)
{
    char name[sizeof m->found.residual[0].name];
    snprintf(name, sizeof name, "# %s", key);
    iso_checker_note(&m->found, name, what, off, c->number);
}

iso_status iso_checker_energy(checker *c, checked_model *m, const double first[])
{
    const iso_units *units = iso_orbit_units(m->orbit);
    const bool ball = m->kind == ISO_BALL, level = iso_effects_have_level(&c->stated);
    const bool any_level = !ball && !m->expect.on_level;
    const char *what = any_level ? "h and eps of the file, against each other" : "this line, against the first row";
    double h, eps, own[ISO_MAX_STATE], least = INFINITY;
    iso_status status = ISO_OK;
    const bool has_h = stated_energy(c, units, "h", &h, &status);
    const bool has_eps = status == ISO_OK && stated_energy(c, units, "eps", &eps, &status);
    if (status != ISO_OK || !iso_orbit_has_twin(m->orbit) || (!ball && c->model[ISO_BALL].there)) return status;
    iso_checker_own(c, &m->expect, first, own);
    if (any_level) { /* nothing but the other of the two can be compared with it; the flow depends on eps */
        if (!has_h || !has_eps) return ISO_OK;
        take_level(m, own, iso_coupling(&units->own, eps));
    }
    if (has_h) note_line(c, m, "h", what, least = off_energy(m, own, h));
    if (has_eps) note_line(c, m, "eps", what, off_energy(m, own, any_level ? h : eps));
    if (has_eps) least = fmin(least, off_energy(m, own, eps));
    char key[ISO_NAME_SIZE];
    const iso_effect *of_level = level ? iso_effect_list[iso_effect_find(iso_level_name())] : NULL;
    if (!level || isinf(least)) return ISO_OK;
    iso_effect_line(key, of_level, of_level->numbers);
    note_line(c, m, key, "this line, against the first row and h or eps", least);
    return ISO_OK;
}

/* --- the start -------------------------------------------------------------------------------------------------- */

static void compare_beginning(checker *c, checked_model *ball, iso_effect_id id, const iso_effect_number *n,
                              const double row[])
{
    const iso_effect_column *g = iso_effect_list[id]->columns;
    int column = ISO_COLUMN_EFFECTS + iso_effect_first_column(id);
    double error = 0, size = 0;
    char key[ISO_NAME_SIZE];
    for (; strcmp(g->name, n->turns_with) != 0; g++) column += g->count;
    for (int i = 0; i < n->count; i++) {
        const double stated = iso_effect_values(&c->stated, id, n)[i], there = iso_checker_at(c, row, column + i);
        error = fmax(error, fabs(there - stated));
        size = fmax(size, fmax(fabs(there), fabs(stated)));
    }
    iso_effect_line(key, iso_effect_list[id], n);
    note_line(c, ball, key, "this line, against the row at time 0", size > 0 ? error / size : 0);
}

void iso_checker_beginning(checker *c, checked_model *ball, const double row[])
{
    if (ball->clock < 0 || iso_checker_at(c, row, ball->clock) != 0) return;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        for (const iso_effect_number *n = iso_effect_list[e]->numbers; c->stated.on[e] && n && n->name; n++)
            if (n->turns_with && iso_checker_has_group(c, e, n->turns_with)) compare_beginning(c, ball, e, n, row);
}

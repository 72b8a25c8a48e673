/* check_common.c - what all parts of a check ask: residuals by name, a row as a state and as a sample, distances. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "orbit/orbit_impl.h"
#include "study/check/check_impl.h"

iso_residual *iso_checker_residual(iso_residuals *r, const char *name, const char *what)
{
    int i = 0;
    while (i < r->count && strcmp(r->residual[i].name, name) != 0) i++;
    if (i == ISO_MAX_RESIDUALS) return NULL;
    iso_residual *at = &r->residual[i];
    if (i < r->count) return at;
    r->count++;
    *at = (iso_residual){.what = what};
    snprintf(at->name, sizeof at->name, "%s", name);
    return at;
}

void iso_checker_note(iso_residuals *found, const char *name, const char *what, double value, size_t row)
{
    iso_residual *at = iso_checker_residual(found, name, what);
    if (!at || (!(fabs(value) > at->worst) && !isnan(value))) return;
    at->worst = isnan(value) ? INFINITY : fabs(value);
    at->row = row;
}

void iso_checker_state(const checker *c, const checked_model *m, const double row[], double y[ISO_STATE])
{
    for (int i = 0; i < ISO_STATE; i++) y[i] = iso_checker_at(c, row, m->first + i);
}

void iso_checker_sample(const checker *c, const double row[], iso_sample *sample)
{
    for (int i = 0; i < ISO_TRAJECTORY_COLUMNS; i++)
        iso_sample_set_column(sample, i, c->columns[i] < 0 ? NAN : row[c->columns[i]]);
}

iso_effects iso_checker_effects(const checker *c, iso_model_kind kind)
{
    if (kind == ISO_BALL) return c->effects;
    iso_effects effects = iso_effects_acting(&c->effects);
    if (iso_record_get(c->record, "eps") || iso_record_get(c->record, "h"))
        iso_effects_set_level(&effects, iso_effects_have_level(&effects), NAN);
    return effects;
}

double iso_checker_distance(const double a[ISO_STATE], const double b[ISO_STATE])
{
    double d[ISO_STATE];
    const double size = fmax(largest(a), largest(b));
    for (int i = 0; i < 3; i++) {
        d[i] = size > 0 ? a[i] / size - b[i] / size : 0;
        d[3 + i] = a[3 + i] - b[3 + i];
    }
    return fmax(norm(d), norm(d + 3));
}

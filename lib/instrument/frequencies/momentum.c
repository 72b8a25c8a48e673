/* momentum.c - the image of the momentum map and its parts; the formulas stand in momentum.h. */
#include "instrument/frequencies/frequencies_impl.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"

static double sum_of_roots(const iso_momentum *m, double h)
{
    return m->b[0] + m->b[1] + m->b[2] + m->H / (h * m->det_J);
}

/* F where one of the roots is z. */
static double F_at(const iso_momentum *m, double h, double z)
{
    const double eps = h * m->det_J; /* k^2 = 1 */
    if (m->k == 1) return 2 * eps * m->b[0] * m->b[1] * m->b[2] / z;
    return 2 * eps / m->det_J * z * (sum_of_roots(m, h) - z);
}

bool iso_momentum_make(const iso_params *p, double H, iso_momentum *m)
{
    ISO_DEFAULT_ARITHMETIC;
    if ((p->k != 1 || H != 0) && p->k != -1) return false;
    *m = (iso_momentum){.k = (int)p->k, .det_J = p->det_J, .H = H};
    m->F = m->k == 1 ? "F_plane" : "F_shell";
    sort_by((const double[]){-m->k * p->J[0], -m->k * p->J[1], -m->k * p->J[2]}, m->axis);
    for (int i = 0; i < 3; i++) m->b[i] = m->k == 1 ? 1 / p->J[m->axis[i]] : p->J[m->axis[i]];
    return true;
}

double iso_momentum_rotation(const iso_momentum *m, double h, int i)
{
    if (i < 3) return F_at(m, h, m->b[i]);
    return m->k == 1 ? INFINITY : F_at(m, h, sum_of_roots(m, h) / 2);
}

bool iso_momentum_interval(const iso_momentum *m, double h, iso_momentum_part part, double *low, double *high)
{
    const double *b = m->b, S = m->k == 1 ? INFINITY : sum_of_roots(m, h), half = S / 2;
    const double al[ISO_MOMENTUM_PARTS][2] = {
        [ISO_TURNS_ABOUT_1] = {b[0], fmin(b[1], S - b[2])},
        [ISO_TURNS_ABOUT_3] = {b[1], fmin(b[2], S - b[2])},
        [ISO_ON_ONE_SIDE] = {fmax(b[1], S - b[2]), half},
        [ISO_SWINGS_ABOUT_3] = {fmax(b[0], S - b[2]), fmin(b[1], S - b[1])},
    };
    if (!(al[part][0] < al[part][1]) || (m->k == 1 && part > ISO_TURNS_ABOUT_3)) return false;
    const double one = F_at(m, h, al[part][0]), other = F_at(m, h, al[part][1]);
    *low = fmin(one, other);
    *high = fmax(one, other);
    return true;
}

iso_momentum_part iso_momentum_find(const iso_momentum *m, double h, double F)
{
    iso_momentum_part nearest = ISO_TURNS_ABOUT_1;
    double least = INFINITY, low, high;
    for (iso_momentum_part part = 0; part < ISO_MOMENTUM_PARTS; part++) {
        if (!iso_momentum_interval(m, h, part, &low, &high)) continue;
        const double away = fmax(fmax(low - F, F - high), 0);
        if (away < least) least = away, nearest = part;
    }
    return nearest;
}

bool iso_momentum_at(const iso_params *p, double H, double h, const char *integral, double F, iso_momentum *m)
{
    double low, high;
    return h > 0 && iso_momentum_make(p, H, m) && strcmp(integral, m->F) == 0 &&
           iso_momentum_interval(m, h, iso_momentum_find(m, h, F), &low, &high);
}

/* --- for a picture ---------------------------------------------------------------------------------------------- */

/* One row; false: a bound does not fit a double. */
static bool fill(const iso_momentum *m, double h, double row[])
{
    double lowest = INFINITY, highest = -INFINITY;
    row[0] = h;
    for (iso_momentum_part part = 0; part < ISO_MOMENTUM_PARTS; part++) {
        double *const at = row + 1 + 2 * part;
        at[0] = at[1] = NAN;
        if (!iso_momentum_interval(m, h, part, &at[0], &at[1])) continue;
        if (!isfinite(at[0]) || !isfinite(at[1])) return false;
        lowest = fmin(lowest, at[0]);
        highest = fmax(highest, at[1]);
    }
    for (int i = 0; i < ISO_MOMENTUM_LINES; i++) {
        const double F = iso_momentum_rotation(m, h, i), room = 1e-12 * highest;
        const bool meets = i < 3 || !isnan(row[1 + 2 * ISO_ON_ONE_SIDE]);
        row[1 + 2 * ISO_MOMENTUM_PARTS + i] = meets && F >= lowest - room && F <= highest + room ? F : NAN;
    }
    return highest > lowest;
}

iso_status iso_momentum_bounds(iso_context *ctx, const iso_momentum *m, double h, iso_record **bounds)
{
    ISO_DEFAULT_ARITHMETIC;
    enum { ROWS = 201 };
    static const char *const names[1 + 2 * ISO_MOMENTUM_PARTS + ISO_MOMENTUM_LINES] = {
        "h",          "about_1_low", "about_1_high", "about_3_low", "about_3_high", "side_low",  "side_high",
        "swings_low", "swings_high", "rotation_1",   "rotation_2",  "rotation_3",   "roots_meet"};
    *bounds = NULL;
    if (!isfinite(m->H) || !(h > 0 && isfinite(h)))
        return ISO_FAIL_NUMERICAL(ctx, "h = %g, H = %g: no point of the image of (h, %s) has such values", h, m->H,
                                  m->F);
    iso_status status = iso_record_create(ctx, sizeof names / sizeof *names, names, bounds);
    for (int i = 0; status == ISO_OK && i < ROWS; i++) {
        double *row;
        status = iso_record_append(ctx, *bounds, &row);
        if (status == ISO_OK && !fill(m, h * fmax(2.0 * i / (ROWS - 1), 1e-6), row) && m->H == 0)
            status = ISO_FAIL_NUMERICAL(ctx, "the image of (h, %s) does not fit doubles", m->F);
    }
    if (status == ISO_OK) return ISO_OK;
    iso_record_free(*bounds);
    *bounds = NULL;
    return status;
}

void iso_momentum_name_part(const iso_momentum *m, iso_momentum_part part, char words[ISO_MOMENTUM_WORDS])
{
    static const char *const names[ISO_MOMENTUM_PARTS] = {
        [ISO_TURNS_ABOUT_1] = "turns about axis %d",
        [ISO_TURNS_ABOUT_3] = "turns about axis %d",
        [ISO_ON_ONE_SIDE] = "turns about axis %d, on one side",
        [ISO_SWINGS_ABOUT_3] = "swings about axis %d",
    };
    snprintf(words, ISO_MOMENTUM_WORDS, names[part], m->axis[part == ISO_TURNS_ABOUT_1 ? 0 : 2] + 1);
}

void iso_momentum_name_line(const iso_momentum *m, int i, char words[ISO_MOMENTUM_WORDS])
{
    const bool separatrix = m->H == 0 && (i == 1 || (i == 2 && m->k == -1 && m->b[2] > m->b[0] + m->b[1]));
    if (i == 3)
        snprintf(words, ISO_MOMENTUM_WORDS, "stays on a cone");
    else
        snprintf(words, ISO_MOMENTUM_WORDS, "rotation about axis %d%s", m->axis[i] + 1,
                 separatrix ? ", separatrix" : "");
}

/* convert_lines.c - the header of a converted trajectory: its columns and its `# key: value` lines. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "orbit/convert_impl.h"
#include "orbit/orbit_impl.h"

/* Lines for the first value of a clock that the result has no column for. */
static const char *const origin_line[] = {[ISO_CLOCK_T] = "t0", [ISO_CLOCK_S] = "s0"};

/* h and eps are those that the record states, if its first row confirms them; else those of the first row. */
static iso_status describe_energy(const iso_conversion *c, iso_model_kind to, iso_record *out)
{
    char key[ISO_NAME_SIZE];
    snprintf(key, sizeof key, "%s.c", iso_level_name());
    const bool named = !iso_effects_have_level(&c->effects) || iso_record_get(out, key);
    return iso_record_describe(c->ctx, out, iso_model_kind_name((int)to), c->params,
                               !c->replaces && named ? NULL : c->first);
}

/* Lines that do not hold for the result: of effects that only observe, of how a clock was computed. */
static bool is_left_behind(const iso_conversion *c, const char *key)
{
    static const char *const keys[] = {"effects", "s.from", "s.error", "t.from", "t.error", "radius"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(key, keys[i]) == 0) return true;
    for (int e = 0; e < ISO_EFFECTS; e++) {
        const iso_effect *effect = iso_effect_list[e];
        const size_t length = strlen(effect->name);
        const bool its_line = strncmp(key, effect->name, length) == 0 && key[length] == '.';
        if (its_line && (!c->effects.on[e] || effect->is_level)) return true;
    }
    return false;
}

static iso_status set_lines(const iso_conversion *c, iso_model_kind to, double begin, iso_record *out)
{
    const char *key, *value, *origin = origin_line[c->own];
    iso_status status = ISO_OK;
    for (size_t i = 0; status == ISO_OK && iso_record_line(c->in, i, &key, &value); i++)
        if (!is_left_behind(c, key)) status = iso_record_set(c->ctx, out, key, value);
    if (status == ISO_OK) status = iso_record_describe_effects(c->ctx, out, &c->effects);
    if (status == ISO_OK) status = describe_energy(c, to, out);
    if (status == ISO_OK && c->own_column >= 0 && (begin != 0 || iso_record_get(out, origin)))
        status = iso_record_set_numbers(c->ctx, out, origin, 1, &begin);
    return status;
}

/* The first value of the computed clock. */
static iso_status find_origin(iso_conversion *c)
{
    iso_status status = ISO_OK;
    c->sum = 0;
    iso_record_get_numbers(c->ctx, c->in, origin_line[c->other], 1, &c->sum, &status);
    return status;
}

iso_status iso_conversion_describe(iso_conversion *c, double begin, iso_record **header)
{
    const iso_model_kind to = c->from == ISO_BALL ? ISO_POINT : ISO_BALL;
    const iso_system *target = to == ISO_BALL ? &iso_system_ball : &iso_system_point;
    const int has_clock = c->own_column >= 0 || c->other_column >= 0;
    const char *names[1 + ISO_STATE] = {iso_clock_name(c->other)};
    for (int i = 0; i < ISO_STATE; i++) names[has_clock + i] = target->state[i];
    iso_status status = iso_record_create(c->ctx, (size_t)(has_clock + ISO_STATE), names, header);
    if (status == ISO_OK) status = set_lines(c, to, begin, *header);
    if (status == ISO_OK) status = find_origin(c);
    if (status == ISO_OK) return ISO_OK;
    iso_record_free(*header);
    *header = NULL;
    return status;
}

double iso_conversion_largest_drift(iso_context *ctx, const iso_record *header, double row_tolerance)
{
    double tolerance = 0;
    iso_status unused;
    iso_record_get_numbers(ctx, header, "tolerance", 1, &tolerance, &unused);
    const double row = row_tolerance > ISO_ROW_TOLERANCE ? 10 * row_tolerance : 0;
    return fmax(fmax(1e-5, row), 100 * tolerance);
}

bool iso_conversion_clock_lines(const iso_conversion_summary *s, char key[2][ISO_NAME_SIZE], char value[2][160])
{
    if (!s->computed) return false;
    snprintf(key[0], ISO_NAME_SIZE, "%s.from", iso_clock_name(s->clock));
    snprintf(value[0], 160, "the rows, %zu intervals by two-point Taylor quadrature, %zu by integration", s->between,
             s->integrated);
    snprintf(key[1], ISO_NAME_SIZE, "%s.error", iso_clock_name(s->clock));
    snprintf(value[1], 160, "%.2g", s->error);
    return true;
}

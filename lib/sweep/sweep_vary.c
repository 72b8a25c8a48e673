/* sweep_vary.c - reads what varies in a sweep: each key of `vary` becomes an axis, `samples` says how those without a
 * count are drawn. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/names_impl.h"
#include "base/number_impl.h"
#include "base/random_impl.h"
#include "method/method.h"
#include "model/model_impl.h"
#include "sweep/sweep_draft_impl.h"

static const double most_points = 1e12;
enum { MOST_LISTED = 1000000 };

/* --- where values go -------------------------------------------------------------------------------------------- */

/* A number of the scene, "k"; a vector, "J"; a component, "J2"; a ratio of moments, "J2/J1". */
static bool find_number(const iso_draft_number list[], int count, iso_sweep_axis *a)
{
    char part[2], of[2];
    int used = 0;
    const bool ratio = sscanf(a->name, "J%1[123]/J%1[123]%n", part, of, &used) == 2 && !a->name[used] && *part != *of;
    for (int i = 0; i < count; i++) {
        const char *name = list[i].name;
        const size_t length = strlen(name);
        const bool J = strcmp(name, "J") == 0, all = strcmp(a->name, name) == 0,
                   component = list[i].count == 3 && strncmp(a->name, name, length) == 0 &&
                               strspn(a->name + length, "123") == 1 && !a->name[length + 1];
        if (!all && !component && !(ratio && J)) continue;
        a->target = ratio ? ISO_TO_RATIO : ISO_TO_NUMBER;
        a->width = all ? list[i].count : 1;
        a->part = all ? 0 : (ratio ? *part : a->name[length]) - '1';
        a->of = ratio ? *of - '1' : 0;
        a->moments = !J ? 0 : all ? 7 : 1 << a->part;
        a->offset = list[i].offset + (ratio ? 0 : (size_t)a->part * sizeof(double));
        return true;
    }
    return false;
}

static iso_status find_target(iso_sweep_file *f, const yaml_node_t *key, iso_sweep_axis *a)
{
    static const char *const others[] = {/* first places on the section, and the level */
                                         "l", "x", "start", "level", "J1", "J2", "J3", "J2/J1", "J3/J1"};
    iso_draft_number list[ISO_SWEEP_NAMES];
    const char *names[ISO_SWEEP_NAMES + 9];
    size_t named = 0;
    const int count = iso_draft_numbers(&f->draft, ISO_SWEEP_NAMES, list);
    if (key->type != YAML_SCALAR_NODE || key->data.scalar.length >= ISO_NAME_SIZE)
        return ISO_FAIL_AT(f, key, "a key should be the name of a number of the scene");
    snprintf(a->name, sizeof a->name, "%s", (const char *)key->data.scalar.value);
    for (int i = 0; i < 4; i++) {
        if (strcmp(a->name, others[i]) != 0) continue;
        a->target = i == 3 ? ISO_TO_LEVEL : ISO_TO_CHART;
        a->chart = i;
        a->width = i == 2 ? 2 : 1;
        return ISO_OK;
    }
    if (find_number(list, count, a)) return ISO_OK;
    for (int i = 0; i < count; i++) names[named++] = list[i].name;
    const bool moments = strstr(a->name, "J") != NULL;
    for (size_t i = 0; i < (moments ? 9u : 4u); i++) names[named++] = others[i];
    return iso_yaml_unknown(&f->yaml, key, "number of this scene", named, names);
}

/* --- where they come from --------------------------------------------------------------------------------------- */

static iso_status make_list(iso_sweep_file *f, iso_sweep_axis *a, size_t count)
{
    a->values = ISO_FROM_LIST;
    a->count = count;
    a->list = calloc(count + 1, (size_t)a->width * sizeof *a->list);
    return a->list ? ISO_OK : iso_context_no_memory(f->yaml.ctx, "'%s'", a->name);
}

static iso_status check_tolerance(iso_sweep_file *f, const yaml_node_t *node, const iso_sweep_axis *a, double x)
{
    if (strcmp(a->name, "tolerance") != 0 || iso_tolerance_is_good(x)) return ISO_OK;
    return ISO_FAIL_AT(f, node, "'tolerance' must be in " ISO_TOLERANCE_RANGE);
}

static iso_status read_range(iso_sweep_file *f, const yaml_node_t *node, iso_sweep_axis *a)
{
    static const iso_sweep_setting settings[] = {
        {.name = "from", .missing = "a range"},
        {.name = "to", .missing = "a range"},
        {.name = "count", .usual = NAN, .least = 1, .most = 1e9, .whole = true},
        {.name = "logarithmic", .flag = true},
        {.name = NULL},
    };
    double value[4];
    if (a->width != 1) return iso_yaml_expected(&f->yaml, node, a->name, "a list of vectors");
    ISO_TRY(iso_sweep_read_mapping(&f->yaml, node, a->name, settings, value));
    a->from = value[0];
    a->to = value[1];
    a->values = isnan(value[2]) ? ISO_FROM_DRAWING : ISO_FROM_RANGE;
    a->count = isnan(value[2]) ? 1 : (size_t)value[2];
    a->logarithmic = value[3] > 0;
    ISO_TRY(check_tolerance(f, node, a, a->from));
    ISO_TRY(check_tolerance(f, node, a, a->to));
    const double ratio = a->to / a->from, most = fmax(fabs(a->from), fabs(a->to)) * fmax((double)a->count, 2);
    if (a->logarithmic && !(copysign(1, a->from) * a->to > 0 && a->from != 0))
        return ISO_FAIL_AT(f, node, "a logarithmic range from %s to %s: both ends must be above 0, or both below",
                           ISO_SHORT(a->from), ISO_SHORT(a->to));
    if (a->logarithmic ? isfinite(ratio) && ratio > 0 : isfinite(most)) return ISO_OK; /* no value overflows */
    return ISO_FAIL_AT(f, node, "a range from %s to %s is too wide", ISO_SHORT(a->from), ISO_SHORT(a->to));
}

/* Values, and ranges of values with a count. list NULL: only counts them. */
static iso_status read_items(iso_sweep_file *f, const yaml_node_t *node, iso_sweep_axis *a, size_t *count)
{
    *count = 0;
    for (const yaml_node_item_t *i = node->data.sequence.items.start; i < node->data.sequence.items.top; i++) {
        const yaml_node_t *item = iso_yaml_node(&f->yaml, *i);
        iso_sweep_axis range = {.width = a->width, .count = 1};
        double value[9], *to = a->list ? a->list + *count * (size_t)a->width : value;
        if (item->type == YAML_MAPPING_NODE && a->width == 1) {
            strcpy(range.name, a->name);
            ISO_TRY(read_range(f, item, &range));
            if (range.values == ISO_FROM_DRAWING || range.count > MOST_LISTED)
                return ISO_FAIL_AT(f, item, "a range in a list needs a 'count', at most %d", MOST_LISTED);
            for (size_t j = 0; a->list && j < range.count; j++) to[j] = iso_sweep_in_range(&range, j);
        } else {
            ISO_TRY(a->width == 1 ? iso_yaml_number(&f->yaml, item, a->name, to)
                                  : iso_yaml_numbers(&f->yaml, item, a->name, a->width, to));
            ISO_TRY(check_tolerance(f, item, a, *to));
        }
        *count += range.count;
    }
    return ISO_OK;
}

/* All a + b + c = sum from 1 on; ordered: a < b < c. */
static iso_status read_triangle(iso_sweep_file *f, const yaml_node_t *node, iso_sweep_axis *a)
{
    static const iso_sweep_setting settings[] = {
        {.name = "triangle", .usual = NAN, .least = 3, .most = 100000, .whole = true},
        {.name = "ordered", .flag = true},
        {.name = NULL},
    };
    double value[2];
    ISO_TRY(iso_sweep_read_mapping(&f->yaml, node, a->name, settings, value));
    if (strcmp(a->name, "J") != 0 || isnan(value[0]))
        return iso_yaml_expected(&f->yaml, node, a->name, "a list of vectors");
    a->values = ISO_FROM_TRIANGLE;
    a->sum = (long)value[0];
    a->ordered = value[1] > 0;
    if (a->ordered && a->sum < 6) return ISO_FAIL_AT(f, node, "an ordered triangle begins at 1 + 2 + 3 = 6");
    a->count = a->ordered ? 0 : (size_t)(a->sum - 1) * (size_t)(a->sum - 2) / 2;
    for (long least = 1; a->ordered && 3 * least + 3 <= a->sum; least++)
        a->count += (size_t)((a->sum - least - 1) / 2 - least);
    return ISO_OK;
}

static iso_status read_spread(iso_sweep_file *f, const yaml_node_t *node, iso_sweep_axis *a)
{
    static const iso_sweep_setting settings[] = {
        {.name = "spread", .least = 1, .most = 1e12, .whole = true, .missing = "'start': the number of starts"},
        {.name = "seed", .least = 0, .most = 0x1p53, .whole = true},
        {.name = NULL},
    };
    double value[2];
    ISO_TRY(iso_sweep_read_mapping(&f->yaml, node, a->name, settings, value));
    a->values = ISO_FROM_SPREAD;
    a->count = (size_t)value[0];
    a->seed = (uint64_t)value[1];
    return ISO_OK;
}

static iso_status read_values(iso_sweep_file *f, const yaml_node_t *node, iso_sweep_axis *a)
{
    size_t count;
    if (node->type == YAML_SEQUENCE_NODE) {
        if (node->data.sequence.items.start == node->data.sequence.items.top)
            return iso_yaml_expected(&f->yaml, node, a->name, "a list of at least one value");
        ISO_TRY(read_items(f, node, a, &count));
        ISO_TRY(make_list(f, a, count));
        return read_items(f, node, a, &count);
    }
    if (node->type == YAML_MAPPING_NODE) {
        if (a->target == ISO_TO_CHART && a->chart == 2) return read_spread(f, node, a);
        return a->width == 3 ? read_triangle(f, node, a) : read_range(f, node, a);
    }
    if (a->width > 1)
        return iso_yaml_expected(&f->yaml, node, a->name,
                                 a->chart == 2 ? "a list of [l, x], or {spread: ...}" : "a list of vectors");
    ISO_TRY(make_list(f, a, 1));
    ISO_TRY(iso_yaml_number(&f->yaml, node, a->name, a->list));
    return check_tolerance(f, node, a, *a->list);
}

/* --- what must hold --------------------------------------------------------------------------------------------- */

static iso_status check_chart(iso_sweep_file *f, const yaml_node_t *node, const iso_sweep_axis *a)
{
    const iso_effect *effect = iso_effects_off_chart(&f->draft.scene.effects);
    if (a->target != ISO_TO_CHART) return ISO_OK;
    f->on_section = true;
    if (effect)
        return ISO_FAIL_AT(f, node, "'%s' acts: a start on the section needs a free motion, without it",
                           effect->name);
    for (size_t i = 0; a->list && a->chart > 0 && i < a->count; i++) {
        const double x = a->list[i * (size_t)a->width + (size_t)a->width - 1];
        if (!(fabs(x) < 1)) return ISO_FAIL_AT(f, node, "x = %s is outside the chart: |x| < 1", ISO_SHORT(x));
    }
    if (!a->list && a->chart == 1 && !(fabs(a->from) < 1 && fabs(a->to) < 1))
        return ISO_FAIL_AT(f, node, "x is from %s to %s: |x| < 1 in the chart", ISO_SHORT(a->from), ISO_SHORT(a->to));
    return ISO_OK;
}

/* A point's eps, or a ball's c, must stand in the scene, which then has a level. */
static iso_status check_level(iso_sweep_file *f, const yaml_node_t *key, iso_sweep_axis *a)
{
    iso_draft_number list[ISO_SWEEP_NAMES];
    const bool point = f->base.start.model == ISO_POINT;
    const char *needed = point ? "eps" : "level.c";
    if (a->target != ISO_TO_LEVEL) return ISO_OK;
    f->level = a;
    int stated = iso_draft_numbers(&f->draft, ISO_SWEEP_NAMES, list);
    while (stated > 0 && strcmp(list[stated - 1].name, needed) != 0) stated--;
    if (stated == 0)
        return ISO_FAIL_AT(f, key, "'level' needs %s in the scene",
                           point ? "'eps'" : "'effects: {level: {c: 1}}', whose c it sets,");
    for (const iso_sweep_axis *b = f->axis; b < f->axis + f->axes; b++)
        if (strcmp(b->name, needed) == 0 && !point)
            return ISO_FAIL_AT(f, key, "'level' and '%s' set the same number", needed);
    return ISO_OK;
}

/* The names of the columns of an axis. */
static iso_status name_columns(iso_sweep_file *f, const yaml_node_t *key, iso_sweep_axis *a)
{
    a->column = f->plan.family.columns;
    for (int i = 0; i < a->width; i++) {
        char *name = f->column[f->plan.family.columns++], digit[2] = {a->width == 1 ? '\0' : (char)('1' + i), '\0'};
        if (a->target == ISO_TO_CHART)
            snprintf(name, ISO_NAME_SIZE, "%s", a->chart == 1 || i == 1 ? "x" : "l");
        else if (a->target == ISO_TO_RATIO)
            snprintf(name, ISO_NAME_SIZE, "J%d_over_J%d", a->part + 1, a->of + 1);
        else
            snprintf(name, ISO_NAME_SIZE, "%.29s%s", a->name, digit);
        for (int c = 0; c < f->plan.family.columns - 1; c++)
            if (strcmp(f->column[c], name) == 0) return ISO_FAIL_AT(f, key, "'%s' varies twice", name);
    }
    return ISO_OK;
}

static iso_status read_axis(iso_sweep_file *f, const yaml_node_pair_t *pair)
{
    const yaml_node_t *key = iso_yaml_node(&f->yaml, pair->key), *value = iso_yaml_node(&f->yaml, pair->value);
    if (f->axes == ISO_SWEEP_AXES) return ISO_FAIL_AT(f, key, "more than %d numbers vary", ISO_SWEEP_AXES);
    iso_sweep_axis *a = &f->axis[f->axes++];
    ISO_TRY(find_target(f, key, a));
    ISO_TRY(read_values(f, value, a));
    ISO_TRY(check_chart(f, value, a));
    ISO_TRY(check_level(f, key, a));
    ISO_TRY(name_columns(f, key, a));
    for (const iso_sweep_axis *b = f->axis; b < a; b++) { /* J1 behind J2/J1 would change the ratio in the row */
        if (a->moments & b->moments)
            return ISO_FAIL_AT(f, key, "'%s' and '%s' set the same moment", b->name, a->name);
        if (b->target == ISO_TO_RATIO && a->moments & 1 << b->of)
            return ISO_FAIL_AT(f, key, "'%s' changes '%s': write it first", a->name, b->name);
    }
    if (a->values != ISO_FROM_DRAWING) return ISO_OK;
    if (f->drawn == ISO_SWEEP_DRAWN) return ISO_FAIL_AT(f, key, "more than %d numbers are drawn", ISO_SWEEP_DRAWN);
    a->drawn = f->drawn++;
    return ISO_OK;
}

/* --- samples ---------------------------------------------------------------------------------------------------- */

static ISO_NAMES(kind_of_samples, int, "even", "random")

    static iso_status read_samples(iso_sweep_file *f, const yaml_node_t *vary, const yaml_node_t *samples)
{
    static const iso_sweep_setting settings[] = {
        {.name = "count", .least = 1, .most = 1e12, .whole = true, .missing = "'samples'"},
        {.name = "kind", .word = kind_of_samples},
        {.name = "seed", .least = 0, .most = 0x1p53, .whole = true},
        {.name = NULL},
    };
    double value[3], r = 1.5, step = 1;
    if (f->drawn > 0 && !samples)
        return ISO_FAIL_AT(f, vary, "a range without a count is drawn: 'samples: {count: ...}' is missing");
    if (!samples) return ISO_OK;
    if (f->drawn == 0)
        return ISO_FAIL_AT(f, samples, "'samples' draws numbers of ranges without a count, and there are none");
    ISO_TRY(iso_sweep_read_mapping(&f->yaml, samples, "samples", settings, value));
    f->samples = (size_t)value[0];
    f->random = value[1] > 0;
    /* Evenly: the additive recurrence of f->drawn steps 1/r, 1/r^2, ..., r^(drawn + 1) = r + 1 (M. Roberts). */
    for (int i = 0; i < 200; i++) {
        double power = 1;
        for (int j = 0; j <= f->drawn; j++) power *= r;
        r -= (power - r - 1) / ((f->drawn + 1) * (power / r) - 1);
    }
    uint64_t number = (uint64_t)value[2];
    for (int j = 0; j < f->drawn; j++) {
        step /= r;
        f->step[j] = (uint64_t)(step * 0x1p64);
        f->shift[j] = number = iso_scatter(number);
    }
    return ISO_OK;
}

iso_status iso_sweep_read_vary(iso_sweep_file *f, const yaml_node_t *vary, const yaml_node_t *samples)
{
    if (vary->type == YAML_MAPPING_NODE && vary->data.mapping.pairs.start == vary->data.mapping.pairs.top)
        return ISO_FAIL_AT(f, vary, "'vary' names no number: write k: [0.5, 1], for example");
    if (vary->type != YAML_MAPPING_NODE)
        return iso_yaml_expected(&f->yaml, vary, "vary", "a mapping with the numbers that vary");
    f->column = calloc(9 * ISO_SWEEP_AXES, sizeof *f->column);
    if (!f->column) return iso_context_no_memory(f->yaml.ctx, "a sweep");
    const yaml_node_pair_t *end = vary->data.mapping.pairs.top;
    for (const yaml_node_pair_t *p = vary->data.mapping.pairs.start; p < end; p++) ISO_TRY(read_axis(f, p));
    int have[2] = {0, 0}; /* l and x are both there, once */
    for (int i = 0; i < f->axes; i++)
        for (int c = 0; c < 2; c++)
            have[c] += f->axis[i].target == ISO_TO_CHART && (f->axis[i].chart == c || f->axis[i].chart == 2);
    if (f->on_section && (have[0] != 1 || have[1] != 1))
        return ISO_FAIL_AT(f, vary,
                           "a start on the section is 'l' and 'x' (one of them may be a single number), or "
                           "'start' alone");
    ISO_TRY(read_samples(f, vary, samples));
    size_t *points = &f->plan.family.count;
    *points = f->drawn > 0 ? f->samples : 1;
    for (int i = 0; i < f->axes; i++) {
        if ((double)*points * (double)f->axis[i].count > most_points)
            return ISO_FAIL_AT(f, vary, "more than %g points", most_points);
        *points *= f->axis[i].count;
    }
    return ISO_OK;
}

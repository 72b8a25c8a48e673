/* convert.c - the calls of a conversion: begin, one row after the other, end. */
#include "task/convert/convert.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "orbit/orbit_impl.h"
#include "task/convert/convert_impl.h"

static iso_status begin(iso_conversion *c, const double row[], const conversion_row *r)
{
    iso_record *header;
    iso_status status = ISO_OK;
    c->rows = (iso_rows){.ctx = c->ctx,
                         .model = c->from,
                         .clock = c->own,
                         .columns = c->columns,
                         .width = iso_record_columns(c->in),
                         .open = iso_conversion_open,
                         .data = c};
    if (c->own_column >= 0) status = iso_rows_begin(&c->rows, c->first, row, c->how->tolerance);
    if (status == ISO_OK) status = iso_conversion_describe(c, r->time, &header);
    if (status != ISO_OK) return status;
    c->width = iso_record_columns(header);
    status = c->sink.header(c->sink.data, 0, header);
    iso_record_free(header);
    c->begun = true;
    return status;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* From the first good row on it is known which effects only observe. Those that break the isomorphism are refused. */
static iso_status settle_effects(iso_conversion *c, const double row[])
{
    iso_start start;
    iso_effects effects = c->effects;
    if (c->settled || iso_record_start_at(c->ctx, c->in, c->params, c->from, row, &start, &effects) != ISO_OK)
        return ISO_OK;
    const iso_effect *e = iso_effects_breaking(&effects);
    c->effects = iso_effects_acting(&effects);
    c->settled = true;
    if (!e) return ISO_OK;
    return iso_context_fail(c->ctx, ISO_NOT_MAPPED, "effects",
                            "this trajectory was made with '%s', which breaks the isomorphism: %s", e->name,
                            iso_effect_why_broken(e));
}

iso_status iso_conversion_put(iso_conversion *c, const double row[], size_t line)
{
    ISO_DEFAULT_ARITHMETIC;
    conversion_row r = {.line = line};
    c->summary.rows++;
    ISO_TRY(settle_effects(c, row));
    iso_status status = iso_conversion_read_row(c, row, &r);
    /* the first row fits, and three after it have other energies: the file's eps or h is wrong, not these rows */
    if (r.other_energy && c->good == 1 && ++c->strangers == 3) return status;
    if (status != ISO_OK) return iso_conversion_bad(c, line, status);
    c->good++;
    if (!c->begun) status = begin(c, row, &r);
    if (status != ISO_OK) return status;
    return c->own_column >= 0 ? iso_conversion_follow(c, row, &r) : iso_conversion_write(c, r.out);
}

iso_status iso_conversion_skip(iso_conversion *c)
{
    c->summary.rows++;
    c->summary.bad++;
    return iso_conversion_mark(c);
}

static void add_summary(iso_conversion_summary *all, const iso_conversion_summary *one)
{
    const iso_conversion_summary before = *all;
    *all = *one;
    if (before.rows == 0) return;
    all->rows += before.rows;
    all->bad += before.bad;
    all->missed += before.missed;
    if (before.missed > 0) all->missed_line = before.missed_line;
    iso_worst *const to[] = {&all->constraint, &all->energy, &all->defect, &all->drift};
    const iso_worst *const from[] = {&before.constraint, &before.energy, &before.defect, &before.drift};
    for (int i = 0; i < 4; i++)
        if (from[i]->line > 0) iso_worst_note(to[i], from[i]->value, from[i]->line);
    all->checked = all->checked || before.checked;
    all->between += before.between;
    all->integrated += before.integrated;
    all->error = fmax(all->error, before.error);
    if (before.stated_count == 0) return;
    all->stated_count = before.stated_count;
    memcpy(all->stated, before.stated, sizeof before.stated);
}

iso_status iso_conversion_end(iso_conversion *c, iso_conversion_summary *all)
{
    ISO_DEFAULT_ARITHMETIC;
    c->summary.checked = c->begun && c->own_column >= 0;
    if (c->summary.checked) iso_conversion_settle(c);
    c->summary.clock = c->other;
    add_summary(all, &c->summary);
    if (c->begun) return ISO_OK;
    if (c->first_text) return iso_context_fail(c->ctx, c->first_failure, "", "%s", c->first_text);
    return ISO_FAIL_INPUT(c->ctx, "", c->summary.rows ? "no row could be read" : "the trajectory has no rows");
}

/* --- beginning and end ------------------------------------------------------------------------------------------ */

/* Refuses a line that is no number. These lines are read later, where an error would be lost. */
static iso_status check_lines(const iso_conversion *c)
{
    static const char *const keys[] = {"h", "eps", "tolerance", "t0", "s0"};
    iso_status status = ISO_OK;
    double x;
    for (size_t i = 0; status == ISO_OK && i < sizeof keys / sizeof *keys; i++)
        iso_record_get_numbers(c->ctx, c->in, keys[i], 1, &x, &status);
    return status;
}

static iso_status find_columns(iso_conversion *c)
{
    int state[ISO_STATE];
    const iso_model_kind to = c->from == ISO_BALL ? ISO_POINT : ISO_BALL;
    const iso_status status = iso_record_find_state(c->ctx, c->in, c->from, state);
    if (status != ISO_OK && iso_record_find_state(c->ctx, c->in, to, state) == ISO_OK)
        return ISO_FAIL_INPUT(c->ctx, "columns", "this is a %s's trajectory already", iso_model_kind_name((int)to));
    if (status != ISO_OK) return iso_record_find_state(c->ctx, c->in, c->from, state);
    iso_record_find_columns(c->in, c->columns);
    c->own = c->from == ISO_BALL ? ISO_CLOCK_T : ISO_CLOCK_S;
    c->other = c->from == ISO_BALL ? ISO_CLOCK_S : ISO_CLOCK_T;
    c->own_column = c->columns[c->own];
    c->other_column = c->columns[c->other];
    c->summary.computed = c->own_column >= 0 && c->other_column < 0;
    return ISO_OK;
}

iso_status iso_conversion_create(iso_context *ctx, const iso_params *params, const iso_record *header,
                                 const iso_convert_request *how, const char *name, const iso_sink *sink,
                                 iso_conversion **conversion)
{
    iso_conversion *c = *conversion = calloc(1, sizeof *c);
    if (!c) return iso_context_no_memory(ctx, "a conversion");
    c->ctx = ctx;
    c->params = params;
    c->in = header;
    c->how = how;
    c->name = name;
    c->sink = *sink;
    c->from = how->to == ISO_BALL ? ISO_POINT : ISO_BALL;
    c->row_tolerance = iso_record_row_tolerance(header);
    const double miss = iso_rows_largest_miss(ctx, header, c->row_tolerance);
    c->summary.max_defect = isnan(how->max_defect) ? miss : how->max_defect;
    c->summary.max_drift = isnan(how->max_defect) ? miss : INFINITY;
    iso_status status = check_lines(c);
    if (status == ISO_OK) status = find_columns(c);
    if (status == ISO_OK && how->shift_J && (c->from != ISO_POINT || params->k != -1))
        status = ISO_FAIL_ARGUMENT(ctx, "shift-J", "energy can shift J for a point with k = -1 alone");
    if (status == ISO_OK) status = iso_record_effects(ctx, header, &c->effects);
    double eps;
    c->stated_level = iso_effects_have_level(&c->effects) ? iso_effects_level(&c->effects) : 0;
    c->stated_eps = NAN;
    if (status == ISO_OK && c->from == ISO_POINT && iso_record_coupling(ctx, header, params, &eps, &status))
        c->stated_eps = eps;
    if (status == ISO_OK) return ISO_OK;
    iso_conversion_free(c);
    *conversion = NULL;
    return status;
}

void iso_conversion_free(iso_conversion *c)
{
    if (!c) return;
    iso_rows_free(&c->rows);
    iso_orbit_free(c->first);
    free(c->first_text);
    free(c);
}

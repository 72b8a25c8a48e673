/* view_trajectory.c - a trajectory file for the page: its rows in order, thinned out, and completed (see view.h). */
#include <math.h>
#include <string.h>

#include "base/number_impl.h"
#include "map/state.h"
#include "orbit/rows_impl.h"
#include "report.h"
#include "view/view.h"

#define LOST 1e-9 /* a pressure below this part of the largest is 0, as for plots */

/* --- lines ------------------------------------------------------------------------------------------------------ */

bool view_is_broken(view_page *page)
{
    const iso_effect *breaking = iso_effects_breaking(&page->effects);
    if (breaking)
        snprintf(page->alone, sizeof page->alone, "the effect '%s' breaks the isomorphism: %s", breaking->name,
                 iso_effect_why_broken(breaking));
    return breaking != NULL;
}

/* The first row says which effects are idle. A row that is no start is refused later, with its place. */
iso_status view_read_lines(iso_context *ctx, const file_options *from, iso_record *r, view_page *page)
{
    const iso_model_kind model = iso_record_find(r, "n1") >= 0 ? ISO_BALL : ISO_POINT;
    iso_status status;
    iso_start start;
    if (from) ISO_TRY(parameters_of_file(ctx, from, r, &page->params));
    ISO_TRY(iso_record_effects(ctx, r, &page->effects));
    iso_effects settled = page->effects;
    if (iso_record_rows(r) > 0 && iso_record_start(ctx, r, &page->params, model, 0, &start, &settled) == ISO_OK)
        memcpy(page->effects.idle, settled.idle, sizeof settled.idle);
    if (from) page->attitude = page->effects.on[ISO_ATTITUDE];
    if (!from && *page->alone) return ISO_OK;
    if (!iso_record_get_numbers(ctx, r, "h", 1, &page->h, &status)) page->h = NAN;
    if (status == ISO_OK && !iso_record_coupling(ctx, r, &page->params, &page->eps, &status)) page->eps = NAN;
    if (status == ISO_OK) view_is_broken(page);
    return status;
}

/* --- what the file must have ------------------------------------------------------------------------------------ */

static iso_status check_columns(iso_context *ctx, const iso_record *r, iso_clock *clock)
{
    const char *ball, *point;
    int columns[ISO_STATE];
    const bool is_ball = iso_record_find_all(r, ISO_STATE, iso_system_ball.state, columns, &ball),
               is_point = iso_record_find_all(r, ISO_STATE, iso_system_point.state, columns, &point);
    if (!is_ball && !is_point) {
        const bool more_ball = iso_record_find(r, "n1") >= 0 || iso_record_find(r, "omega1") >= 0;
        return ISO_FAIL_INPUT(ctx, "columns",
                              "there is no column '%s': a page needs omega1 ... n3 of the ball, or M1 ... gamma3 "
                              "of the point; 'isoroll run SCENE' writes them",
                              more_ball ? ball : point);
    }
    const bool t = iso_record_find(r, "t") >= 0, s = iso_record_find(r, "s") >= 0;
    if (!t && !s)
        return ISO_FAIL_INPUT(ctx, "columns",
                              "there is no column 't' or 's': a page needs the time of each row; 'isoroll run' "
                              "writes it, or output.columns of the scene asks for it");
    *clock = t && (is_ball || !s) ? ISO_CLOCK_T : ISO_CLOCK_S;
    return ISO_OK;
}

/* --- order and number of rows ----------------------------------------------------------------------------------- */

/* As many rows as there is room for, each `every`-th and the last, by growing times; of rows with equal times the
 * first. Their lines say of how many. */
static iso_status thin_out(iso_context *ctx, const iso_record *in, const view_page *page, iso_record **out)
{
    const int time = iso_record_find(in, iso_clock_name(page->clock));
    const size_t rows = iso_record_rows(in), every = (rows + VIEW_MOST_ROWS - 2) / (VIEW_MOST_ROWS - 1);
    double last = -INFINITY;
    if (rows < 2) return ISO_FAIL_INPUT(ctx, "", "a page needs at least two rows, found %zu", rows);
    const bool back = iso_record_const_row(in, rows - 1)[time] < iso_record_const_row(in, 0)[time];
    ISO_TRY(iso_record_create_like(ctx, in, 0, NULL, out));
    ISO_TRY(view_count(ctx, *out, "total", rows));
    ISO_TRY(view_count(ctx, *out, "every", every));
    for (size_t i = 0; i < rows; i++) {
        const size_t from = back ? rows - 1 - i : i;
        const double *row = iso_record_const_row(in, from);
        if (row[time] == last) continue;
        if (row[time] < last)
            return ISO_FAIL_INPUT(
                ctx, "", "row %zu: its %s = %s is out of order: a page plays the rows in the order of their times",
                from + 1, iso_record_name(in, (size_t)time), ISO_SHORT(row[time]));
        last = row[time];
        if (i % every == 0 || i == rows - 1) ISO_TRY(iso_record_add(ctx, *out, 1, row));
    }
    if (iso_record_rows(*out) < 2) return ISO_FAIL_INPUT(ctx, "", "all rows have the same time: nothing moves");
    return ISO_OK;
}

/* --- the page --------------------------------------------------------------------------------------------------- */

/* If the file does not state h and eps: from its first row, if the ball is free. */
static void find_energy(view_page *page, const iso_record *rows)
{
    iso_sample first;
    const iso_effects acting = iso_effects_acting(&page->effects);
    if (*page->alone || !isnan(page->eps)) return;
    for (int e = 0; e < ISO_EFFECTS; e++)
        if (acting.on[e]) return;
    iso_record_sample(rows, 0, &first);
    page->h = iso_ball_energy(&page->params, first.ball);
    page->eps = iso_coupling(&page->params, page->h);
}

/* Says, here and on the page, that rows do not follow the equations. */
static void note_miss(const char *file, view_page *page, const iso_record *rows, const iso_row_miss *worst)
{
    const char *clock = iso_clock_name(page->clock);
    if (worst->by == 0) return;
    const double time = *view_vector(rows, worst->row, clock);
    page->no_orbit = true;
    view_note(page, "Rows are no orbit: the row at %s = %.6g is missed by %.2g by the orbit through the row before.",
              clock, time, worst->by);
    warn("%s: rows are no orbit: the row at %s = %.10g is missed by %.2g by the orbit through the row before: "
         "they do not solve the equations that the file or the options state (k, J, clock), or have too few digits",
         file, clock, time, worst->by);
}

/* Where a run has lost contact, its last row, or of times that run backwards the first of the page, has pressure 0.
 * The page looks for notes that begin with "contact is lost", and says that it is lost at the end. */
static void note_loss(view_page *page, const iso_record *rows)
{
    const int pressure = iso_record_find(rows, "pressure");
    const size_t last = iso_record_rows(rows) - 1;
    const int time = iso_record_find(rows, iso_clock_name(page->clock));
    double largest = 0;
    if (pressure < 0) return;
    for (size_t i = 0; i <= last; i++) largest = fmax(largest, fabs(iso_record_const_row(rows, i)[pressure]));
    for (size_t i = 0; i <= last; i += last) {
        const double *row = iso_record_const_row(rows, i);
        if (row[pressure] > LOST * largest) continue;
        if (i == last)
            view_note(page, "contact is lost at %s = %.6g", iso_clock_name(page->clock), row[time]);
        else
            view_note(page, "Before %s = %.6g there is no contact.", iso_clock_name(page->clock), row[time]);
    }
}

static iso_status of_record(iso_context *ctx, const file_options *from, iso_record *in, iso_record **thin,
                            view_page *page)
{
    const char *names[ISO_TRAJECTORY_COLUMNS];
    iso_record *rows;
    iso_row_miss worst;
    ISO_TRY(view_read_lines(ctx, from, in, page));
    ISO_TRY(check_columns(ctx, in, &page->clock));
    ISO_TRY(thin_out(ctx, in, page, thin));
    const double *omega = view_vector(*thin, 0, "omega1");
    if (!*page->alone && omega && omega[0] == 0 && omega[1] == 0 && omega[2] == 0)
        snprintf(page->alone, sizeof page->alone, "a ball at rest has no point");
    const size_t count = view_columns(page, *thin, names);
    ISO_TRY(iso_rows_complete(ctx, &page->params, &page->effects, !*page->alone, *thin, count, names, &rows, &worst));
    note_miss(from->file, page, rows, &worst);
    note_loss(page, rows);
    find_energy(page, rows);
    return view_add_orbit(ctx, page, rows);
}

iso_status view_of_trajectory(iso_context *ctx, const file_options *from, view_page *page)
{
    iso_record *in = NULL, *thin = NULL;
    iso_status status = iso_table_read(ctx, from->file, "trajectory", from->columns, &in, NULL);
    if (status == ISO_OK) status = of_record(ctx, from, in, &thin, page);
    iso_record_free(in);
    iso_record_free(thin);
    return name_the_file(ctx, from->file, status);
}

/* splitting_report.c - the splitting as a table, as JSON, as rows and as a picture (see splitting_report.h). */
#include "splitting_report.h"

#include <math.h>
#include <string.h>

#include "json.h"
#include "plot/plot.h"
#include "report.h"
#include "table.h"

/* --- the table -------------------------------------------------------------------------------------------------- */

/* The axes are those of each row that did not fail; NULL: all did. */
static const iso_separatrix_splitting *first_good(const iso_separatrix_table *s)
{
    for (size_t i = 0; i < s->rows; i++)
        if (s->row[i].status == ISO_OK) return &s->row[i];
    return NULL;
}

bool splitting_is_by_level(const iso_separatrix_table *s)
{
    bool differ = false;
    for (size_t i = 1; i < s->rows; i++) differ = differ || s->row[i].level != s->row[0].level;
    return differ;
}

/* What differs from row to row. */
static double number_of(const iso_separatrix_splitting *s, bool by_level)
{
    return by_level ? s->level : s->k;
}

bool splitting_has_rows(const iso_separatrix_table *s)
{
    return first_good(s) != NULL;
}

static void print_head(const double J[3], const iso_separatrix_splitting *row, bool by_level)
{
    printf("J = %.15g %.15g %.15g\n", J[0], J[1], J[2]);
    if (!row) return;
    if (by_level) printf("k = %.15g\n", row->k);
    if (!by_level && row->level != 0) printf("level of the point, (H/eps) J2^(1/k): %.15g\n", row->level);
    printf("The unstable manifold of the rotation about axis %d meets l = pi/2 on the section n_%d = 0 at x,\n"
           "with the slope m. The stable one has -m: they are one curve only if m = 0.\n\n",
           row->middle + 1, row->axis + 1);
    printf("%16s %11s %19s %24s %7s %7s\n", by_level ? "level" : "k", "multiplier", "x", "m", "error", "digits");
}

static void print_row(const iso_separatrix_splitting *s, bool by_level)
{
    const double at = number_of(s, by_level);
    if (s->status == ISO_STOPPED) return;
    if (s->status != ISO_OK) {
        printf("%16.15g %s\n", at, s->words);
        return;
    }
    printf("%16.15g %11.8g %19.16g ", at, s->lambda, s->x);
    if (s->from_zero)
        printf("%24.16e %7.1e %7d\n", s->m, s->error, s->digits);
    else if (fabs(s->m) > s->error)
        printf("%24.16e %7.1e %7d   undecided: less than 100 errors from 0\n", s->m, s->error, s->digits);
    else /* 1.05: rounding of the bound to two digits must not make it smaller */
        printf("%24s %7.1e %7d   not distinguishable from 0: below %.1e\n", "0", s->error, s->digits,
               1.05 * (fabs(s->m) + s->error));
    if (s->words[0]) printf("%16s %s\n", "", s->words);
}

static void print_zero(const iso_separatrix_splitting *s, bool by_level)
{
    printf("\nm = 0 at %s = %.16g +- %.1e, where the manifolds touch at x = %.15g.\n", by_level ? "level" : "k",
           number_of(s, by_level), by_level ? s->level_error : s->k_error, s->x);
    if (isfinite(s->next_m))
        printf("On the section n_%d = 0 they meet next at l = %.12g, x = %.12g,\n"
               "and there with slopes %.6e above and below their mean: %s.",
               s->section + 1, s->next_l, s->next_x, fabs(s->next_m),
               fabs(s->next_m) > 100 * fmax(s->error, fabs(s->m)) ? "they cross there"
                                                                  : "too small for these digits, undecided");
    printf("\n");
}

void splitting_print(const iso_scene *scene, const iso_separatrix_table *s)
{
    const bool by_level = splitting_is_by_level(s);
    print_head(scene->params.J, first_good(s), by_level);
    for (size_t i = 0; i < s->rows; i++) print_row(&s->row[i], by_level);
    for (size_t i = 0; i < s->zeros; i++) print_zero(&s->zero[i], by_level);
}

/* --- JSON and CSV ----------------------------------------------------------------------------------------------- */

bool splitting_print_json(const iso_scene *scene, const iso_separatrix_table *s)
{
    static const iso_field J[] = {ISO_MEMBER(iso_params, "J", J, "moment of inertia", "about the contact"),
                                  ISO_FIELD_END};
    json_t *o = json_of(J, &scene->params);
    json_add(o, iso_separatrix_table_fields, s);
    return json_print(o);
}

/* A row for each k or level that did not fail, then one for each zero. */
static iso_status make_table(iso_context *ctx, const iso_scene *scene, const iso_separatrix_table *s,
                             const char *title, iso_record **table)
{
    const table_line lines[] = {{.key = "title", .text = title}, {.key = NULL}};
    iso_status status = table_create(ctx, "splitting", scene, lines, iso_separatrix_fields, table);
    for (size_t i = 0; status == ISO_OK && i < s->rows + s->zeros; i++) {
        const iso_separatrix_splitting *row = i < s->rows ? &s->row[i] : &s->zero[i - s->rows];
        if (row->status == ISO_OK) status = iso_columns_append(ctx, iso_separatrix_fields, row, *table);
    }
    return status;
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

/* The row whose curves are best seen: |m| is about 1/30. */
static const iso_separatrix_splitting *clearest(const iso_separatrix_table *s)
{
    const iso_separatrix_splitting *best = NULL;
    double least = INFINITY;
    for (size_t i = 0; i < s->rows; i++) {
        const double apart = fabs(log(fmax(fabs(s->row[i].m), 1e-40) * 30));
        if (s->row[i].status == ISO_OK && apart < least) best = &s->row[i], least = apart;
    }
    return best;
}

/* As many half returns beyond the crossing as the lobes need to be seen: they grow like lambda^(1/2) each. */
static int halves_of(const iso_separatrix_splitting *s)
{
    const double needed = log(0.3 / fmax(fabs(s->section_m), 1e-4)) / (log(s->lambda) / 2);
    return (int)fmin(fmax(needed, 2) + 2, 60);
}

int splitting_save(iso_context *ctx, const iso_scene *scene, const iso_separatrix_table *s, iso_table_writer *to,
                   const char *plot)
{
    const double *J = scene->params.J;
    const iso_separatrix_splitting *at = clearest(s);
    iso_record *table = NULL, *curve = NULL;
    char title[160];
    if (!at) return finish(ctx, table_write(ctx, to, ISO_STOPPED, NULL));
    const bool by_level = splitting_is_by_level(s);
    int length = snprintf(title, sizeof title, "splitting of the separatrix, J = %.6g %.6g %.6g", J[0], J[1], J[2]);
    if (by_level)
        snprintf(title + length, sizeof title - (size_t)length, ", k = %.6g", at->k);
    else if (at->level != 0)
        snprintf(title + length, sizeof title - (size_t)length, ", level %.6g", at->level);
    iso_status status = make_table(ctx, scene, s, title, &table);
    status = table_write(ctx, to, status, table);
    if (status == ISO_OK && plot) status = iso_separatrix_curve(ctx, at->k, J, at->level, halves_of(at), &curve);
    if (status == ISO_OK && plot)
        status = iso_plot_splitting(ctx, plot, title, s->rows > 1 ? table : NULL, curve, number_of(at, by_level),
                                    at->section);
    iso_record_free(table);
    iso_record_free(curve);
    return finish(ctx, status);
}

/* separatrix_print.c - the text of splitting (study/study.h). */
#include <math.h>

#include "base/number_impl.h"
#include "instrument/separatrix/separatrix.h"
#include "study/study_impl.h"

static void print_head(FILE *to, const double J[3], const iso_separatrix_table *t)
{
    fprintf(to, "J = %s %s %s\n", ISO_ROUNDED(J[0], 15), ISO_ROUNDED(J[1], 15), ISO_ROUNDED(J[2], 15));
    if (t->middle < 0) return;
    if (t->by_level) fprintf(to, "k = %s\n", ISO_ROUNDED(t->row->k, 15));
    if (!t->by_level && t->row->level != 0)
        fprintf(to, "level of the point, (H/eps) J2^(1/k): %s\n", ISO_ROUNDED(t->row->level, 15));
    fprintf(to,
            "The unstable manifold of the rotation about axis %d meets l = pi/2 on the section n_%d = 0 at x, "
            "with the slope m. The stable one has -m: they are one curve only if m = 0.\n\n",
            t->middle + 1, t->axis + 1);
}

static void print_row(FILE *to, const iso_separatrix_splitting *s, bool by_level)
{
    const double at = by_level ? s->level : s->k;
    if (s->status == ISO_STOPPED) return;
    if (s->status != ISO_OK) {
        fprintf(to, "%.15g\t%s\n", at, s->text);
        return;
    }
    const int digits = (int)fmax(1, fmin(16, ceil(log10(fabs(s->m) / s->error)))); /* of the slope, until its error */
    fprintf(to, "%.15g\t%.8g\t%.16g\t", at, s->lambda, s->x);
    if (s->from_zero)
        fprintf(to, "%.*e\t%.1e\t%d\t\n", digits, s->m, s->error, s->digits);
    else if (fabs(s->m) > s->error)
        fprintf(to, "%.*e\t%.1e\t%d\tundecided: less than 100 errors from 0\n", digits, s->m, s->error, s->digits);
    else /* 1.05: rounding of the bound to two digits must not make it smaller */
        fprintf(to, "0\t%.1e\t%d\tnot distinguishable from 0: below %.1e\n", s->error, s->digits,
                1.05 * (fabs(s->m) + s->error));
    if (s->text[0]) fprintf(to, "\t%s\n", s->text);
}

static void print_zero(FILE *to, const iso_separatrix_splitting *s, bool by_level)
{
    fprintf(to, "\nm = 0 at %s = %.15g +- %.1e, where the manifolds touch at x = %.15g.\n", by_level ? "level" : "k",
            by_level ? s->level : s->k, by_level ? s->level_error : s->k_error, s->x);
    if (isfinite(s->next_m))
        fprintf(to,
                "On the section n_%d = 0 they meet next at l = %.12g, x = %.12g, "
                "and there with slopes %.6e above and below their mean: %s.",
                s->section + 1, s->next_l, s->next_x, fabs(s->next_m),
                fabs(s->next_m) > 100 * fmax(s->error, fabs(s->m)) ? "they cross there"
                                                                   : "too small for these digits, undecided");
    fputs("\n", to);
}

void iso_separatrix_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_separatrix_table *t = result->found;
    const bool by_level = t->by_level;
    (void)options;
    print_head(to, scene->params.J, t);
    iso_table_begin(to, 1);
    fprintf(to, "%s\tmultiplier\tx\tm\terror\tdigits\tremark\n", by_level ? "level" : "k");
    for (size_t i = 0; i < t->rows; i++) print_row(to, &t->row[i], by_level);
    iso_table_end(to);
    for (size_t i = 0; i < t->zeros; i++) print_zero(to, &t->zero[i], by_level);
}

const iso_separatrix_splitting *iso_separatrix_clearest(const iso_separatrix_table *s)
{
    const iso_separatrix_splitting *best = NULL;
    double least = INFINITY;
    for (size_t i = 0; i < s->rows; i++) {
        const double apart = fabs(log(fmax(fabs(s->row[i].m), 1e-40) * 30));
        if (s->row[i].status == ISO_OK && apart < least) best = &s->row[i], least = apart;
    }
    return best;
}

iso_status iso_separatrix_describe(iso_context *ctx, const iso_scene *scene, const void *options,
                                   iso_study_result *result)
{
    const iso_separatrix_table *t = result->found;
    const iso_separatrix_splitting *at = iso_separatrix_clearest(t);
    const double *J = scene->params.J;
    const bool by_level = t->by_level;
    char k[ISO_FRACTION_SIZE + 8] = "", level[32] = "", number[ISO_FRACTION_SIZE];
    (void)options;
    if (at && (by_level || t->rows == 1)) snprintf(k, sizeof k, "k = %s, ", iso_fraction_text(number, at->k));
    if (at && !by_level && at->level != 0) snprintf(level, sizeof level, ", level %.6g", at->level);
    return iso_study_title(ctx, result, "Splitting of the separatrix        %sJ = (%.6g, %.6g, %.6g)%s", k, J[0],
                           J[1], J[2], level);
}

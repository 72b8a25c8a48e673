/* plot_over.c - what is drawn over a section: periodic orbits, and the manifolds of the middle axis' rotation. */
#include <math.h>
#include <string.h>

#include "io/table.h"
#include "map/section_impl.h"
#include "orbit/description.h"
#include "plot/gnuplot.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"
#include "study/separatrix/separatrix.h"

enum { STABLE, UNSTABLE, LEAVES, ENTERS, KINDS };

static const struct {
    const char *look, *under, *name; /* under: what is drawn first, to set it off */
} kinds[KINDS] = {{"p pt 6 ps 0.9 lw 1.6 lc rgb 'black'", "p pt 7 ps 0.9 lc rgb 'white'", "stable periodic orbit"},
                  {"p pt 2 ps 0.8 lw 1.6 lc rgb 'black'", NULL, "unstable periodic orbit"},
                  {"l lw 1.4 lc rgb " ISO_PLOT_VERMILLION, NULL, "leaves the unstable rotation"},
                  {"l lw 1.4 dt (12,7) lc rgb " ISO_PLOT_BLUE, NULL, "enters it"}};

/* --- reading ---------------------------------------------------------------------------------------------------- */

static bool is_near(double a, double b)
{
    return fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b));
}

static iso_status refuse(iso_context *ctx, const char *file, const char *why)
{
    return iso_context_fail(ctx, ISO_BAD_INPUT, "over", "--over '%s': %s", file, why);
}

static iso_status check_moments(iso_context *ctx, const char *file, const iso_record *table,
                                const iso_plot_section *s, bool k)
{
    iso_params p;
    ISO_TRY(iso_record_params(ctx, table, &p));
    bool same = !k || is_near(p.k, s->params->k);
    for (int i = 0; i < 3; i++) same = same && is_near(p.J[i], s->params->J[i]);
    return same ? ISO_OK : refuse(ctx, file, "it has other k or J than the section");
}

void iso_plot_image(int n, double l, double x, double image[2])
{
    image[0] = remainder((n & 1 ? -l : l) + (n & 2 ? M_PI : 0), 2 * M_PI);
    image[1] = n & 4 ? -x : x;
}

/* The number of a piece grows with each image: lines end there. */
static iso_status add_images(iso_context *ctx, double l, double x, int kind, double piece, int n, iso_record *over)
{
    double at[4] = {0, 0, kind, piece};
    iso_plot_image(n, l, x, at);
    return iso_record_add(ctx, over, 1, at);
}

static iso_status add_orbits(iso_context *ctx, const char *file, const iso_record *table, const iso_plot_section *s,
                             iso_record *over)
{
    ISO_TRY(check_moments(ctx, file, table, s, true));
    if (iso_plot_axis_of(table) != s->axis) return refuse(ctx, file, "its section is about another axis");
    for (size_t i = 0; i < iso_record_rows(table); i++) {
        const bool stable = iso_plot_is(table, i, "stability", "stable");
        for (int n = 0; n < 8; n++)
            ISO_TRY(add_images(ctx, iso_plot_number(table, i, "l"), iso_plot_number(table, i, "x"),
                               stable ? STABLE : UNSTABLE, 0, n, over));
    }
    return ISO_OK;
}

/* An image by one of the reversors enters where the curve leaves: it turns the section over. */
static iso_status add_curve(iso_context *ctx, const iso_record *curve, double corner, iso_record *over)
{
    for (int n = 0; n < 8; n++)
        for (size_t i = 0; i < iso_record_rows(curve); i++) {
            const double *row = iso_record_const_row(curve, i);
            const bool turned = (n & 1) != (n >> 2 & 1);
            ISO_TRY(add_images(ctx, row[0] + corner, row[1], turned ? ENTERS : LEAVES, n, n, over));
        }
    return ISO_OK;
}

/* l of the rotation about the middle axis. The section is about the axis of the largest moment if k > 0, else of the
 * smallest: of the other two axes b and c the middle one is nearer to it. */
static double corner_of(const iso_params *p, int axis)
{
    const double b = p->J[(axis + 1) % 3], c = p->J[(axis + 2) % 3];
    return (p->k > 0 ? c > b : c < b) ? 0 : M_PI / 2;
}

/* The row of the section's k and level; its curves are computed anew, which takes less than a second. */
static iso_status add_manifolds(iso_context *ctx, const char *file, const iso_record *table,
                                const iso_plot_section *s, iso_record *over)
{
    const iso_params *p = s->params;
    const int axis = iso_section_axis((iso_point_motion){p, s->eps, s->energy});
    const double level = iso_level_of(p, s->energy / s->eps);
    size_t i = 0;
    ISO_TRY(check_moments(ctx, file, table, s, false));
    while (i < iso_record_rows(table) && !(is_near(iso_plot_number(table, i, "k"), p->k) &&
                                           fabs(iso_plot_number(table, i, "level") - level) <= 1e-12))
        i++;
    if (i == iso_record_rows(table)) return refuse(ctx, file, "no row has the k and the level of the section");
    if (axis != s->axis) return refuse(ctx, file, "its section is about another axis");
    const double m = fabs(iso_plot_number(table, i, "m")), lambda = iso_plot_number(table, i, "multiplier");
    const double halves = log(0.3 / fmax(m, 1e-4)) / (log(lambda) / 2);
    iso_record *curve = NULL;
    iso_status status = iso_separatrix_curve(ctx, p->k, p->J, level, (int)fmin(fmax(halves, 2) + 2, 60), &curve);
    if (status == ISO_OK) status = add_curve(ctx, curve, corner_of(p, axis), over);
    iso_record_free(curve);
    return status;
}

static iso_status add_file(iso_context *ctx, const char *file, const iso_plot_section *s, iso_record *over)
{
    iso_record *table = NULL;
    iso_status status = iso_table_read(ctx, file, NULL, NULL, &table, NULL);
    if (status != ISO_OK) return status;
    if (strcmp(iso_record_kind(table), "periodic") == 0)
        status = add_orbits(ctx, file, table, s, over);
    else if (strcmp(iso_record_kind(table), "splitting") == 0)
        status = add_manifolds(ctx, file, table, s, over);
    else
        status = refuse(ctx, file, "expected what 'periodic -o' or 'splitting -o' writes");
    iso_record_free(table);
    return status;
}

iso_status iso_plot_read_over(iso_context *ctx, const iso_plot_page *page, const iso_plot_section *s,
                              iso_record **over)
{
    *over = NULL;
    if (!page->over[0]) return ISO_OK;
    if (!s->alone) return refuse(ctx, page->over[0], "the section must be of a free ball, or of one on a level");
    iso_status status = iso_record_create(ctx, 4, (const char *[]){"l", "x", "kind", "piece"}, over);
    for (int i = 0; status == ISO_OK && i < ISO_PLOT_OVERS && page->over[i]; i++)
        status = add_file(ctx, page->over[i], s, *over);
    return status;
}

/* --- drawing ---------------------------------------------------------------------------------------------------- */

void iso_plot_put_over(FILE *f, const iso_plot_section *s, const char *side,
                       iso_plot_spot (*place)(const iso_plot_section *s, const double chart[2]))
{
    for (int kind = 0; s->over && kind < KINDS; kind++) {
        double piece = -1, last = 0;
        fprintf(f, "$%s%d << EOD\nNaN NaN\n", side, kind);
        for (size_t i = 0; i < iso_record_rows(s->over); i++) {
            const double *row = iso_record_const_row(s->over, i);
            const iso_plot_spot at = place(s, row);
            if (row[2] != kind || !isfinite(at.right) || !isfinite(at.up)) continue;
            if (row[3] != piece || fabs(at.right - last) > M_PI) fputc('\n', f); /* a line ends */
            fprintf(f, "%.6f %.7g\n", at.right, at.up);
            piece = row[3], last = at.right;
        }
        fputs("EOD\n", f);
    }
}

static bool has_kind(const iso_plot_section *s, int kind)
{
    for (size_t i = 0; s->over && i < iso_record_rows(s->over); i++)
        if (iso_record_const_row(s->over, i)[2] == kind) return true;
    return false;
}

void iso_plot_draw_over(FILE *f, const iso_plot_section *s, const char *side)
{
    for (int i = KINDS - 1; i >= 0; i--) { /* the orbits on top */
        if (!has_kind(s, i)) continue;
        if (kinds[i].under) fprintf(f, ", $%s%d w %s notitle", side, i, kinds[i].under);
        fprintf(f, ", $%s%d w %s notitle", side, i, kinds[i].look);
    }
}

void iso_plot_over_key(FILE *f, const iso_plot_section *s, double y)
{
    char entries[600] = "NaN notitle";
    for (int i = 0; i < KINDS; i++) {
        const size_t used = strlen(entries);
        if (has_kind(s, i))
            snprintf(entries + used, sizeof entries - used, ", NaN w %s title '%s'", kinds[i].look, kinds[i].name);
    }
    fputs("unset colorbox\n", f);
    iso_plot_key(f, 0.5, y, entries);
}

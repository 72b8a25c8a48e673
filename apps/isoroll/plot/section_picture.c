/* section_picture.c - collects crossings for the picture of a section (see section_picture.h). */
#include "plot/section_picture.h"

#include <stdlib.h>
#include <string.h>

#include "model/effects_impl.h"
#include "orbit/description.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"
#include "study/section/section_impl.h"

/* The most points in a picture: more cannot be seen in a .png, and would make a .svg too large. */
enum { MOST = 200000, MOST_IN_SVG = 40000 };

enum { ORBIT, L, X, POINT_L, POINT_X, GREY, HASH, COLUMNS };

struct section_picture {
    iso_plot_section plot;
    iso_params params;
    int l, x;      /* columns of the rows; l -1: there is none  */
    uint64_t rows; /* that came so far                          */
    double limit;  /* rows whose hash is below it are kept      */
    bool last_kept;
    iso_record *kept;
    size_t orbits;
    iso_record *first, *who; /* the first crossing of each orbit that has one, (l, x), and whose it is */
    iso_record *grey;        /* of each orbit: 1: ball and point have parted, or a verdict says that it is chaotic */
};

iso_status section_picture_create(iso_context *ctx, const iso_record *header, section_picture **picture)
{
    static const char *const names[] = {"orbit", "l", "x", "point_l", "point_x", "grey", "hash"};
    const char *eps = iso_record_get(header, "eps"), *effects = iso_record_get(header, "effects"),
               *c = iso_record_get(header, "level.c");
    const bool level = effects && c && strcmp(effects, iso_level_name()) == 0;
    section_picture *p = *picture = calloc(1, sizeof *p);
    if (!p) return iso_context_no_memory(ctx, "a picture");
    ISO_TRY(iso_record_params(ctx, header, &p->params));
    p->plot = (iso_plot_section){.params = &p->params, .axis = iso_plot_axis_of(header)};
    p->l = p->plot.axis < 0 ? -1 : iso_record_find(header, "l");
    p->x = iso_record_find(header, "x");
    p->limit = 1;
    p->plot.eps = eps && (!effects || level) ? strtod(eps, NULL) : 0; /* with other effects L is not G(l) x */
    p->plot.energy = level ? iso_coupling(&p->params, strtod(c, NULL)) : 0;
    ISO_TRY(iso_record_create(ctx, COLUMNS, names, &p->kept));
    ISO_TRY(iso_record_create(ctx, 2, &names[L], &p->first));
    ISO_TRY(iso_record_create(ctx, 1, names, &p->who));
    return iso_record_create(ctx, 1, &names[GREY], &p->grey);
}

void section_picture_free(section_picture *p)
{
    if (!p) return;
    iso_record_free(p->kept);
    iso_record_free(p->first);
    iso_record_free(p->who);
    iso_record_free(p->grey);
    free(p);
}

/* Numbers in [0, 1) without a pattern, which choose the rows that are kept. If every second row were kept, an
 * orbit that jumps between two islands would show only one of them. */
static double hash_of(uint64_t i)
{
    i = (i + 1) * UINT64_C(0x9E3779B97F4A7C15);
    i = (i ^ i >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    return (double)((i ^ i >> 31) >> 11) / 9007199254740992.0; /* 2^53 */
}

/* Halves the limit until no more than `most` rows have a hash below it, and keeps only these. */
static iso_status thin_out(iso_context *ctx, section_picture *p, size_t most)
{
    iso_status status = ISO_OK;
    while (status == ISO_OK && iso_record_rows(p->kept) > most) {
        iso_record *const all = p->kept;
        p->limit /= 2;
        status = iso_record_create_like(ctx, all, 0, NULL, &p->kept);
        for (size_t i = 0; status == ISO_OK && i < iso_record_rows(all); i++) {
            const double *from = iso_record_const_row(all, i);
            if (from[HASH] < p->limit) status = iso_record_add(ctx, p->kept, 1, from);
        }
        iso_record_free(all);
    }
    return status;
}

iso_status section_picture_row(iso_context *ctx, section_picture *p, const double row[])
{
    const double hash = hash_of(p->rows++);
    if (p->l < 0) return ISO_OK;
    const bool is_first = iso_record_rows(p->who) == 0 || (size_t)row[0] >= p->orbits;
    p->orbits = (size_t)row[0] + 1;
    if (is_first) ISO_TRY(iso_record_add(ctx, p->first, 1, (double[]){row[p->l], row[p->x]}));
    if (is_first) ISO_TRY(iso_record_add(ctx, p->who, 1, row));
    ISO_TRY(thin_out(ctx, p, MOST - 1));
    p->last_kept = hash < p->limit;
    if (!p->last_kept) return ISO_OK;
    const double l = row[p->l], x = row[p->x];
    return iso_record_add(ctx, p->kept, 1, (double[COLUMNS]){row[0], l, x, l, x, 0, hash});
}

/* Orbits that nobody has asked for are not grey. */
static bool is_grey(const section_picture *p, size_t orbit)
{
    return orbit < iso_record_rows(p->grey) && *iso_record_const_row(p->grey, orbit) != 0;
}

static iso_status set_grey(iso_context *ctx, section_picture *p, size_t orbit, bool grey)
{
    while (iso_record_rows(p->grey) <= orbit) ISO_TRY(iso_record_add(ctx, p->grey, 1, (double[]){0}));
    *iso_record_row(p->grey, orbit) = grey;
    return ISO_OK;
}

iso_status section_picture_pair(iso_context *ctx, section_picture *p, const iso_crossing *ball,
                                const iso_crossing *point)
{
    if (p->l < 0) return ISO_OK;
    if (iso_section_distance(ball, point) > ISO_SECTION_PARTED) ISO_TRY(set_grey(ctx, p, p->orbits - 1, true));
    if (!p->last_kept) return ISO_OK;
    double *row = iso_record_row(p->kept, iso_record_rows(p->kept) - 1);
    row[POINT_L] = point->l;
    row[POINT_X] = point->x;
    return ISO_OK;
}

size_t section_picture_starts(section_picture *p, const double (**starts)[2])
{
    const size_t count = iso_record_rows(p->first);
    *starts = count > 0 ? (const double(*)[2])(const void *)iso_record_const_row(p->first, 0) : NULL;
    return count;
}

iso_status section_picture_judge(iso_context *ctx, section_picture *p, const iso_chaos *chaos)
{
    for (size_t i = 0; i < chaos->starts && i < iso_record_rows(p->who); i++) {
        const size_t orbit = (size_t)*iso_record_const_row(p->who, i);
        ISO_TRY(set_grey(ctx, p, orbit, chaos->start[i].verdict == ISO_CHAOTIC));
    }
    p->plot.grey_means = "chaotic";
    return ISO_OK;
}

iso_status section_picture_draw(iso_context *ctx, section_picture *p, const iso_plot_page *page)
{
    const size_t length = strlen(page->path);
    const bool png = length > 4 && strcmp(page->path + length - 4, ".png") == 0;
    char title[ISO_PLOT_TITLE];
    bool any = false;
    if (p->l < 0) return iso_context_fail(ctx, ISO_BAD_INPUT, "", "--plot: an event has no coordinates l, x");
    ISO_TRY(thin_out(ctx, p, png ? MOST : MOST_IN_SVG));
    for (size_t i = 0; i < iso_record_rows(p->kept); i++) {
        double *row = iso_record_row(p->kept, i);
        row[GREY] = is_grey(p, (size_t)row[ORBIT]);
    }
    for (size_t i = 0; i < iso_record_rows(p->grey); i++) any = any || is_grey(p, i);
    const char *means = p->plot.grey_means ? p->plot.grey_means : "ball and point part: chaotic";
    iso_plot_section plot = p->plot;
    plot.title = iso_plot_title(title, &p->params, ": %zu orbit%s", p->orbits, p->orbits == 1 ? "" : "s");
    plot.rows = p->kept;
    plot.grey_means = any ? means : NULL;
    return iso_plot_sections(ctx, page, &plot);
}

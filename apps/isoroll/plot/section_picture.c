/* section_picture.c - collects crossings for the picture of a section (see section_picture.h). */
#include "plot/section_picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/effects_impl.h"
#include "orbit/description.h"
#include "plot/plot.h"
#include "plot/plot_parts.h"
#include "study/section/section_impl.h"

/* The most points in a picture: more cannot be seen in a .png, and would make a .svg too large. */
enum { MOST = 200000, MOST_IN_SVG = 40000 };

/* The most crossings of an orbit by which its rotation number is found. */
enum { MOST_OF_ORBIT = 20000 };

enum { ORBIT, L, X, POINT_L, POINT_X, GREY, ROTATION, HASH, COLUMNS };

struct section_picture {
    iso_plot_section plot;
    iso_params params;
    unsigned reversors;     /* that the return map has, see iso_section_reversors */
    int l, x;               /* columns of the rows; l -1: there is none  */
    uint64_t rows;          /* that came so far                          */
    double limit;           /* rows whose hash is below it are kept      */
    bool last_kept, judged; /* judged: there are verdicts */
    iso_record *kept;
    size_t orbits;
    iso_record *first, *who; /* the first crossing of each orbit that has one, (l, x), and whose it is */
    iso_record *grey;        /* of each orbit: its shade, as in plot.h; chaotic if ball and point have parted */
    iso_record *now;         /* crossings (l, x) of the orbit whose rows come                              */
    iso_record *rotation;    /* of each orbit before it; NaN: not found                                    */
};

iso_status section_picture_create(iso_context *ctx, const iso_record *header, section_picture **picture)
{
    static const char *const names[] = {"orbit", "l", "x", "point_l", "point_x", "grey", "rotation", "hash"};
    const char *eps = iso_record_get(header, "eps");
    iso_problem f = {.eps = 0};
    section_picture *p = *picture = calloc(1, sizeof *p);
    if (!p) return iso_context_no_memory(ctx, "a picture");
    ISO_TRY(iso_record_params(ctx, header, &p->params));
    ISO_TRY(iso_record_effects(ctx, header, &f.effects));
    f.p = p->params;
    p->plot = (iso_plot_section){.params = &p->params, .axis = iso_plot_axis_of(header)};
    p->l = p->plot.axis < 0 ? -1 : iso_record_find(header, "l");
    p->x = iso_record_find(header, "x");
    p->limit = 1;
    const bool level = iso_effects_have_level(&f.effects);
    p->plot.eps = eps && !iso_effects_off_chart(&f.effects) ? strtod(eps, NULL) : 0; /* else L is not G(l) x */
    p->plot.energy = level ? iso_coupling(&p->params, iso_effects_level(&f.effects)) : 0;
    p->plot.alone = p->plot.eps > 0 && iso_effects_are_free(&f.effects);
    if (p->plot.eps > 0) p->reversors = iso_section_reversors(&f, p->plot.axis);
    ISO_TRY(iso_record_create(ctx, COLUMNS, names, &p->kept));
    ISO_TRY(iso_record_create(ctx, 2, &names[L], &p->first));
    ISO_TRY(iso_record_create(ctx, 1, names, &p->who));
    ISO_TRY(iso_record_create(ctx, 2, &names[L], &p->now));
    ISO_TRY(iso_record_create(ctx, 1, &names[ROTATION], &p->rotation));
    return iso_record_create(ctx, 1, &names[GREY], &p->grey);
}

void section_picture_free(section_picture *p)
{
    if (!p) return;
    iso_record_free(p->kept);
    iso_record_free(p->first);
    iso_record_free(p->who);
    iso_record_free(p->grey);
    iso_record_free(p->now);
    iso_record_free(p->rotation);
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

/* All rows of the orbit have come. Orbits without a row have no number. */
static iso_status end_orbit(iso_context *ctx, section_picture *p)
{
    const size_t count = iso_record_rows(p->now);
    const double(*z)[2] = count > 0 ? (const double(*)[2])(const void *)iso_record_const_row(p->now, 0) : NULL;
    if (p->orbits == 0) return ISO_OK;
    while (iso_record_rows(p->rotation) + 1 < p->orbits)
        ISO_TRY(iso_record_add(ctx, p->rotation, 1, (double[]){NAN}));
    ISO_TRY(iso_record_add(ctx, p->rotation, 1, (double[]){iso_section_rotation(z, count)}));
    iso_record_free(p->now);
    return iso_record_create_like(ctx, p->first, 0, NULL, &p->now);
}

iso_status section_picture_row(iso_context *ctx, section_picture *p, const double row[])
{
    const double hash = hash_of(p->rows++);
    if (p->l < 0) return ISO_OK;
    const bool is_first = iso_record_rows(p->who) == 0 || (size_t)row[0] >= p->orbits;
    if (is_first) ISO_TRY(end_orbit(ctx, p));
    p->orbits = (size_t)row[0] + 1;
    if (iso_record_rows(p->now) < MOST_OF_ORBIT)
        ISO_TRY(iso_record_add(ctx, p->now, 1, (double[]){row[p->l], row[p->x]}));
    if (is_first) ISO_TRY(iso_record_add(ctx, p->first, 1, (double[]){row[p->l], row[p->x]}));
    if (is_first) ISO_TRY(iso_record_add(ctx, p->who, 1, row));
    ISO_TRY(thin_out(ctx, p, MOST - 1));
    p->last_kept = hash < p->limit;
    if (!p->last_kept) return ISO_OK;
    const double l = row[p->l], x = row[p->x];
    return iso_record_add(ctx, p->kept, 1, (double[COLUMNS]){row[0], l, x, l, x, 0, NAN, hash});
}

/* Orbits that nobody has asked for are taken for regular. */
static int shade_of(const section_picture *p, size_t orbit)
{
    return orbit < iso_record_rows(p->grey) ? (int)*iso_record_const_row(p->grey, orbit) : 0;
}

static iso_status set_shade(iso_context *ctx, section_picture *p, size_t orbit, int shade)
{
    while (iso_record_rows(p->grey) <= orbit) ISO_TRY(iso_record_add(ctx, p->grey, 1, (double[]){0}));
    *iso_record_row(p->grey, orbit) = shade;
    return ISO_OK;
}

iso_status section_picture_pair(iso_context *ctx, section_picture *p, const iso_crossing *ball,
                                const iso_crossing *point)
{
    if (p->l < 0) return ISO_OK;
    if (iso_section_distance(ball, point) > ISO_SECTION_PARTED)
        ISO_TRY(set_shade(ctx, p, p->orbits - 1, ISO_PLOT_CHAOTIC));
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
        const iso_verdict verdict = chaos->start[i].verdict;
        ISO_TRY(set_shade(ctx, p, (size_t)*iso_record_const_row(p->who, i),
                          verdict == ISO_CHAOTIC     ? ISO_PLOT_CHAOTIC
                          : verdict == ISO_UNDECIDED ? ISO_PLOT_UNDECIDED
                                                     : 0));
    }
    p->judged = true;
    return ISO_OK;
}

/* Of each row what is drawn. Without verdicts an orbit without a rotation number is grey. */
static void put_shades(section_picture *p, bool any[ISO_PLOT_SHADES])
{
    for (size_t i = 0; i < iso_record_rows(p->kept); i++) {
        double *row = iso_record_row(p->kept, i);
        int shade = shade_of(p, (size_t)row[ORBIT]);
        const double rotation = *iso_record_const_row(p->rotation, (size_t)row[ORBIT]);
        if (shade == 0 && isnan(rotation)) shade = p->judged ? ISO_PLOT_UNDECIDED : ISO_PLOT_CHAOTIC;
        row[GREY] = shade;
        row[ROTATION] = shade == 0 ? rotation : (double)NAN;
        any[shade] = true;
    }
}

/* The reversors of the return map, S1: (l, -x), S2: (-l, x) and S3: (pi - l, x). A free ball, and one on a level, has
 * all of them. They carry an orbit to an orbit with the same rotation number: so each island shows where one of its images
 * has a start. */
static iso_status add_images(iso_context *ctx, section_picture *p)
{
    static const int l[] = {L, POINT_L}, x[] = {X, POINT_X};
    /* the reversors that make image n of iso_plot_image, as bits */
    static const unsigned makes[8] = {0, 2, 2 | 4, 4, 1, 1 | 2, 1 | 2 | 4, 1 | 4};
    const size_t rows = iso_record_rows(p->kept);
    for (size_t i = 0; i < rows; i++)
        for (int n = 1; n < 8; n++) {
            double row[COLUMNS];
            if (makes[n] & ~p->reversors) continue;
            memcpy(row, iso_record_const_row(p->kept, i), sizeof row);
            if (row[GREY] != 0) break;
            for (int c = 0; c < 2; c++) {
                double image[2];
                iso_plot_image(n, row[l[c]], row[x[c]], image);
                row[l[c]] = image[0], row[x[c]] = image[1];
            }
            row[HASH] = hash_of(p->rows++) * p->limit;
            ISO_TRY(iso_record_add(ctx, p->kept, 1, row));
        }
    return ISO_OK;
}

iso_status section_picture_draw(iso_context *ctx, section_picture *p, const iso_plot_page *page)
{
    const size_t length = strlen(page->path);
    const bool png = length > 4 && strcmp(page->path + length - 4, ".png") == 0;
    char title[ISO_PLOT_TITLE];
    bool any[ISO_PLOT_SHADES] = {false};
    if (p->l < 0) return iso_context_fail(ctx, ISO_BAD_INPUT, "", "--plot: an event has no coordinates l, x");
    ISO_TRY(end_orbit(ctx, p));
    ISO_TRY(thin_out(ctx, p, MOST / 4));
    put_shades(p, any);
    ISO_TRY(add_images(ctx, p));
    ISO_TRY(thin_out(ctx, p, png ? MOST : MOST_IN_SVG));
    const char *means = p->judged ? "chaotic" : "chaotic, or too few crossings to tell";
    iso_plot_section plot = p->plot;
    plot.title = iso_plot_title(title, &p->params, ": %zu orbit%s%s", p->orbits, p->orbits == 1 ? "" : "s",
                                p->reversors && any[0] ? " and mirror images" : "");
    plot.rows = p->kept;
    plot.grey_means = any[ISO_PLOT_CHAOTIC] ? means : NULL;
    plot.dark_means = any[ISO_PLOT_UNDECIDED] ? "undecided" : NULL;
    iso_record *over;
    iso_status status = iso_plot_read_over(ctx, page, &plot, &over);
    plot.over = over;
    if (status == ISO_OK) status = iso_plot_sections(ctx, page, &plot);
    iso_record_free(over);
    return status;
}

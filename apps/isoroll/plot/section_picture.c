/* section_picture.c - collects crossings for the picture of `isoroll section` (see section_picture.h). */
#include "plot/section_picture.h"
#include "model/effects_impl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "orbit/crossings.h"
#include "plot/plot.h"
#include "study/section/section_impl.h"

/* The most points in a picture: more cannot be seen in a .png, and would make a .svg too large. */
enum { MOST = 200000, MOST_IN_SVG = 40000 };

enum { ORBIT, L, X, POINT_L, POINT_X, GREY, HASH, COLUMNS };

struct section_picture {
    const iso_params *params;
    double eps, energy;
    int axis, l, x; /* axis: -1: none. l, x: columns of the rows */
    uint64_t rows;  /* that came so far                          */
    double limit;   /* rows whose hash is below it are kept      */
    bool last_kept;
    iso_record *kept;
    size_t orbits, grey_room;
    bool *grey;  /* of each orbit: ball and point have parted, or ... */
    bool judged; /* ... a verdict says that it is chaotic             */
};

iso_status section_picture_create(iso_context *ctx, const iso_params *params, section_picture **picture)
{
    static const char *const names[] = {"orbit", "l", "x", "point_l", "point_x", "grey", "hash"};
    section_picture *p = *picture = calloc(1, sizeof *p);
    if (!p) return iso_context_no_memory(ctx, "a picture");
    p->params = params, p->axis = -1, p->limit = 1;
    return iso_record_create(ctx, COLUMNS, names, &p->kept);
}

void section_picture_free(section_picture *p)
{
    if (!p) return;
    iso_record_free(p->kept);
    free(p->grey);
    free(p);
}

void section_picture_begin(section_picture *p, const iso_record *header)
{
    const char *axis = iso_record_get(header, "axis"), *eps = iso_record_get(header, "eps");
    p->l = iso_record_find(header, "l");
    p->x = iso_record_find(header, "x");
    p->axis = axis && p->l >= 0 ? axis[0] - '1' : -1;
    const char *effects = iso_record_get(header, "effects"), *c = iso_record_get(header, "level.c");
    const bool level = effects && c && strcmp(effects, iso_level_name()) == 0;
    p->eps = eps && (!effects || level) ? strtod(eps, NULL) : 0; /* with other effects L is not G(l) x */
    p->energy = level ? iso_coupling(p->params, strtod(c, NULL)) : 0;
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

static bool know_orbit(section_picture *p, size_t orbit)
{
    if (orbit < p->grey_room) return true;
    const size_t room = 2 * orbit + 64;
    bool *grey = realloc(p->grey, room * sizeof *grey);
    if (!grey) return false;
    memset(grey + p->grey_room, 0, (room - p->grey_room) * sizeof *grey);
    p->grey = grey;
    p->grey_room = room;
    return true;
}

iso_status section_picture_row(iso_context *ctx, section_picture *p, const double row[])
{
    const double hash = hash_of(p->rows++), l = p->axis < 0 ? 0 : row[p->l], x = p->axis < 0 ? 0 : row[p->x];
    if (p->axis < 0) return ISO_OK;
    if (!know_orbit(p, (size_t)row[0])) return iso_context_no_memory(ctx, "the picture");
    p->orbits = (size_t)row[0] + 1;
    const iso_status status = thin_out(ctx, p, MOST - 1);
    p->last_kept = hash < p->limit;
    if (!p->last_kept || status != ISO_OK) return status;
    return iso_record_add(ctx, p->kept, 1, (double[COLUMNS]){row[0], l, x, l, x, 0, hash});
}

void section_picture_pair(section_picture *p, const iso_crossing *ball, const iso_crossing *point)
{
    if (p->axis < 0) return;
    if (iso_section_distance(ball, point) > ISO_SECTION_PARTED) p->grey[p->orbits - 1] = true;
    if (!p->last_kept) return;
    double *row = iso_record_row(p->kept, iso_record_rows(p->kept) - 1);
    row[POINT_L] = point->l;
    row[POINT_X] = point->x;
}

void section_picture_judge(section_picture *p, const iso_chaos *chaos)
{
    for (size_t i = 0; i < p->orbits; i++) {
        const bool known = i == 0 || i <= chaos->starts;
        const iso_verdict verdict = !known   ? ISO_UNDECIDED
                                    : i == 0 ? chaos->own.verdict
                                             : chaos->start[i - 1].verdict;
        p->grey[i] = verdict == ISO_CHAOTIC;
    }
    p->judged = true;
}

iso_status section_picture_draw(iso_context *ctx, section_picture *p, const char *path)
{
    const double *J = p->params->J;
    const size_t length = strlen(path);
    char title[160];
    bool any = false;
    if (p->axis < 0) return iso_context_fail(ctx, ISO_BAD_INPUT, "", "--plot: an event has no coordinates l, x");
    const iso_status status =
        thin_out(ctx, p, length > 4 && strcmp(path + length - 4, ".png") == 0 ? MOST : MOST_IN_SVG);
    if (status != ISO_OK) return status;
    for (size_t i = 0; i < iso_record_rows(p->kept); i++) {
        double *row = iso_record_row(p->kept, i);
        row[GREY] = p->grey[(size_t)row[ORBIT]];
    }
    for (size_t i = 0; i < p->orbits; i++) any = any || p->grey[i];
    snprintf(title, sizeof title, "k = %.6g, J = %.6g %.6g %.6g: %zu orbit%s", p->params->k, J[0], J[1], J[2],
             p->orbits, p->orbits == 1 ? "" : "s");
    const iso_plot_section section = {.title = title,
                                      .params = p->params,
                                      .eps = p->eps,
                                      .energy = p->energy,
                                      .axis = p->axis,
                                      .rows = p->kept,
                                      .grey_means = !any        ? NULL
                                                    : p->judged ? "chaotic"
                                                                : "ball and point part: chaotic"};
    return iso_plot_sections(ctx, path, &section);
}

/* section_plot.c - collects crossings for the picture of `isoroll section` (see section_plot.h). */
#include "section_plot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "orbit/crossings.h"
#include "plot/plot.h"
#include "study/section/section.h"

/* The most points in a picture: more cannot be seen in a .png, and would make a .svg too large. */
enum { MOST = 200000, MOST_IN_SVG = 40000 };

struct section_picture {
    const iso_scene *scene;
    double eps, energy;
    int axis, l, x; /* axis: -1: none. l, x: columns of the rows */
    uint64_t rows;  /* that came so far                          */
    uint64_t limit; /* rows whose hash is below it are kept      */
    bool last_kept;
    size_t count, orbits;
    uint32_t *orbit;
    uint64_t *hash;
    double (*ball)[2], (*point)[2];
    size_t grey_room;
    bool *grey;  /* of each orbit: ball and point have parted, or ... */
    bool judged; /* ... a verdict says that it is chaotic             */
};

section_picture *section_picture_create(const iso_scene *scene)
{
    section_picture *p = calloc(1, sizeof *p);
    if (!p) return NULL;
    *p = (section_picture){.scene = scene, .axis = -1, .limit = UINT64_MAX};
    p->orbit = malloc(MOST * sizeof *p->orbit);
    p->hash = malloc(MOST * sizeof *p->hash);
    p->ball = malloc(MOST * sizeof *p->ball);
    p->point = malloc(MOST * sizeof *p->point);
    if (p->orbit && p->hash && p->ball && p->point) return p;
    section_picture_free(p);
    return NULL;
}

void section_picture_free(section_picture *p)
{
    if (!p) return;
    free(p->orbit);
    free(p->hash);
    free(p->ball);
    free(p->point);
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
    p->energy = level ? iso_coupling(&p->scene->params, strtod(c, NULL)) : 0;
}

/* Numbers without a pattern, which choose the rows that are kept. If every second row were kept, an orbit that jumps
 * between two islands would show only one of them. */
static uint64_t hash_of(uint64_t i)
{
    i = (i + 1) * UINT64_C(0x9E3779B97F4A7C15);
    i = (i ^ i >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    return i ^ i >> 31;
}

/* Keeps only the rows whose hash is below a limit. */
static void thin_out(section_picture *p, uint64_t limit)
{
    size_t kept = 0;
    p->limit = limit;
    for (size_t i = 0; i < p->count; i++) {
        if (p->hash[i] >= limit) continue;
        p->orbit[kept] = p->orbit[i];
        p->hash[kept] = p->hash[i];
        memcpy(p->ball[kept], p->ball[i], sizeof p->ball[i]);
        memcpy(p->point[kept++], p->point[i], sizeof p->point[i]);
    }
    p->count = kept;
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

bool section_picture_row(section_picture *p, const double row[])
{
    const uint64_t hash = hash_of(p->rows++);
    if (p->axis < 0) return true;
    if (!know_orbit(p, (size_t)row[0])) return false;
    p->orbits = (size_t)row[0] + 1;
    while (p->count == MOST) thin_out(p, p->limit / 2);
    p->last_kept = hash < p->limit;
    if (!p->last_kept) return true;
    p->orbit[p->count] = (uint32_t)row[0];
    p->hash[p->count] = hash;
    p->ball[p->count][0] = p->point[p->count][0] = row[p->l];
    p->ball[p->count][1] = p->point[p->count][1] = row[p->x];
    p->count++;
    return true;
}

void section_picture_pair(section_picture *p, const iso_crossing *ball, const iso_crossing *point)
{
    if (p->axis < 0) return;
    if (iso_section_distance(ball, point) > ISO_SECTION_PARTED) p->grey[p->orbits - 1] = true;
    if (!p->last_kept) return;
    p->point[p->count - 1][0] = point->l;
    p->point[p->count - 1][1] = point->x;
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

iso_status section_picture_draw(iso_context *ctx, const section_picture *p, const char *path)
{
    const double *J = p->scene->params.J;
    const size_t length = strlen(path),
                 most = length > 4 && strcmp(path + length - 4, ".png") == 0 ? MOST : MOST_IN_SVG;
    section_picture drawn = *p; /* its arrays are those of p, and thinning out overwrites them */
    char title[160];
    bool any = false;
    if (p->axis < 0) return iso_context_fail(ctx, ISO_BAD_INPUT, "", "--plot: an event has no coordinates l, x");
    while (drawn.count > most) thin_out(&drawn, drawn.limit / 2);
    for (size_t i = 0; i < p->orbits; i++) any = any || p->grey[i];
    snprintf(title, sizeof title, "k = %.6g, J = %.6g %.6g %.6g: %zu orbit%s", p->scene->params.k, J[0], J[1], J[2],
             p->orbits, p->orbits == 1 ? "" : "s");
    const iso_plot_section section = {.title = title,
                                      .params = &p->scene->params,
                                      .eps = p->eps,
                                      .energy = p->energy,
                                      .axis = p->axis,
                                      .count = drawn.count,
                                      .orbit = p->orbit,
                                      .ball = (const double(*)[2])p->ball,
                                      .point = (const double(*)[2])p->point,
                                      .orbits = p->orbits,
                                      .grey = p->grey,
                                      .grey_means = !any        ? NULL
                                                    : p->judged ? "chaotic"
                                                                : "ball and point part: chaotic"};
    return iso_plot_sections(ctx, path, &section);
}

/* section_points.c - collects crossings for the picture of a section (see section_impl.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "instrument/section/section_impl.h"
#include "map/section_impl.h"
#include "model/effects/effects_impl.h"
#include "orbit/description.h"
#include "picture/section_impl.h"

/* Rows that are kept, at most: more cannot be seen. With their images there may be twice as many. */
enum { MOST = 200000 };

/* The most crossings of an orbit by which its rotation number is found. */
enum { MOST_OF_ORBIT = 20000 };

/* Beside those of crossings. */
enum { ORBIT = ISO_PICTURE_COLUMNS, HASH, COLUMNS };

struct iso_picture_points {
    iso_picture_charts charts;
    unsigned reversors;               /* that the return map has, see iso_section_reversors */
    int l, x;                         /* columns of the rows; l -1: there is none */
    uint64_t rows;                    /* that came so far */
    double limit;                     /* rows whose hash is below it are kept */
    bool last_kept, verdicts, parted; /* there are verdicts; the models part on an orbit */
    iso_record *kept;
    /* Of each orbit that has a crossing its number, shade and rotation number (NaN: not found), and its first crossing
     * (l, x). A row is of another orbit than the one before if its number differs. */
    iso_record *orbits, *first;
    iso_record *now; /* crossings (l, x) of the last of them */
};

enum { NUMBER, SHADE, ROTATION };

/* G(l) and the reversors need what acts on the ball. */
static iso_status read_motion(iso_context *ctx, const iso_record *header, iso_picture_points *p)
{
    iso_picture_charts *c = &p->charts;
    iso_problem f = {.eps = 0};
    double eps = 0;
    iso_status status = ISO_OK;
    ISO_TRY(iso_record_params(ctx, header, &c->params));
    ISO_TRY(iso_record_effects(ctx, header, &f.effects));
    iso_record_get_numbers(ctx, header, "eps", 1, &eps, &status);
    f.p = c->params;
    if (iso_effects_off_chart(&f.effects) || !(eps > 0)) return status; /* L is not G(l) x */
    c->eps = eps;
    if (iso_effects_have_level(&f.effects)) c->energy = iso_coupling(&c->params, iso_effects_level(&f.effects));
    c->alone = iso_effects_are_free(&f.effects);
    if (c->axis >= 0) p->reversors = iso_section_reversors(&f, c->axis);
    return status;
}

iso_status iso_picture_points_create(iso_context *ctx, const iso_record *header, iso_picture_points **points)
{
    const char *names[COLUMNS] = {[ORBIT] = "orbit", [HASH] = "hash"};
    iso_picture_points *p = *points = calloc(1, sizeof *p);
    if (!p) return iso_context_no_memory(ctx, "a picture");
    for (int i = 0; i < ISO_PICTURE_COLUMNS; i++) names[i] = iso_picture_crossing_names[i];
    p->charts.axis = iso_picture_axis(header);
    p->l = p->charts.axis < 0 ? -1 : iso_record_find(header, "l");
    p->x = iso_record_find(header, "x");
    p->limit = 1;
    ISO_TRY(read_motion(ctx, header, p));
    ISO_TRY(iso_record_create(ctx, COLUMNS, names, &p->kept));
    ISO_TRY(iso_record_create(ctx, 3, (const char *const[]){"orbit", "shade", "rotation"}, &p->orbits));
    ISO_TRY(iso_record_create(ctx, 2, names, &p->first));
    return iso_record_create(ctx, 2, names, &p->now);
}

void iso_picture_points_free(iso_picture_points *p)
{
    if (!p) return;
    iso_record_free(p->kept);
    iso_record_free(p->orbits);
    iso_record_free(p->first);
    iso_record_free(p->now);
    free(p);
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

/* Numbers in [0, 1) without a pattern, which choose the rows that are kept. If every second row were kept, an
 * orbit that jumps between two islands would show only one of them. */
static double hash_of(uint64_t i)
{
    i = (i + 1) * UINT64_C(0x9E3779B97F4A7C15);
    i = (i ^ i >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    return (double)((i ^ i >> 31) >> 11) / 9007199254740992.0; /* 2^53 */
}

/* Halves the limit until no more than `most` rows have a hash below it, and keeps only these. */
static iso_status thin_out(iso_context *ctx, iso_picture_points *p, size_t most)
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

static const double (*pairs(const iso_record *r))[2]
{
    return iso_record_rows(r) > 0 ? (const double(*)[2])(const void *)iso_record_const_row(r, 0) : NULL;
}

static double *last_orbit(const iso_picture_points *p)
{
    return iso_record_row(p->orbits, iso_record_rows(p->orbits) - 1);
}

/* All rows of the orbit have come. */
static iso_status end_orbit(iso_context *ctx, iso_picture_points *p)
{
    if (iso_record_rows(p->orbits) == 0) return ISO_OK;
    last_orbit(p)[ROTATION] = iso_section_rotation(pairs(p->now), iso_record_rows(p->now));
    iso_record_free(p->now);
    return iso_record_create_like(ctx, p->first, 0, NULL, &p->now);
}

iso_status iso_picture_points_row(iso_context *ctx, iso_picture_points *p, const double row[])
{
    const double hash = hash_of(p->rows++);
    if (p->l < 0) return ISO_OK;
    const double at[2] = {row[p->l], row[p->x]};
    if (iso_record_rows(p->orbits) == 0 || row[0] != last_orbit(p)[NUMBER]) {
        ISO_TRY(end_orbit(ctx, p));
        ISO_TRY(iso_record_add(ctx, p->first, 1, at));
        ISO_TRY(iso_record_add(ctx, p->orbits, 1, (double[]){row[0], ISO_PICTURE_COLOURED, NAN}));
    }
    if (iso_record_rows(p->now) < MOST_OF_ORBIT) ISO_TRY(iso_record_add(ctx, p->now, 1, at));
    ISO_TRY(thin_out(ctx, p, MOST - 1));
    p->last_kept = hash < p->limit;
    if (!p->last_kept) return ISO_OK;
    const double orbit = (double)(iso_record_rows(p->orbits) - 1);
    return iso_record_add(ctx, p->kept, 1,
                          (double[COLUMNS]){at[0], at[1], at[0], at[1], [ORBIT] = orbit, [HASH] = hash});
}

size_t iso_picture_points_starts(iso_picture_points *p, const double (**starts)[2])
{
    *starts = pairs(p->first);
    return iso_record_rows(p->first);
}

/* --- shades ----------------------------------------------------------------------------------------------------- */

/* The distance in the chart: the larger one of |dl|, modulo 2 pi, and |dx|. */
static double distance(const double a[2], const double b[2])
{
    return fmax(fabs(remainder(a[0] - b[0], 2 * M_PI)), fabs(a[1] - b[1]));
}

void iso_picture_points_pair(iso_picture_points *p, const double ball[2], const double point[2])
{
    if (p->l < 0) return;
    if (distance(ball, point) > ISO_SECTION_PARTED) {
        last_orbit(p)[SHADE] = ISO_PICTURE_GREY;
        p->parted = true;
    }
    if (!p->last_kept) return;
    double *row = iso_record_row(p->kept, iso_record_rows(p->kept) - 1);
    row[ISO_PICTURE_POINT_L] = point[0];
    row[ISO_PICTURE_POINT_X] = point[1];
}

void iso_picture_points_verdict(iso_picture_points *p, double l, double x, const char *verdict)
{
    const bool regular = strcmp(verdict, iso_verdict_name(ISO_REGULAR)) == 0 ||
                         strcmp(verdict, iso_verdict_name(ISO_INTEGRABLE)) == 0,
               chaotic = strcmp(verdict, iso_verdict_name(ISO_CHAOTIC)) == 0;
    for (size_t i = 0; i < iso_record_rows(p->first); i++) {
        if (!(distance(iso_record_const_row(p->first, i), (double[]){l, x}) <= 1e-12)) continue;
        iso_record_row(p->orbits, i)[SHADE] = regular   ? ISO_PICTURE_COLOURED
                                              : chaotic ? ISO_PICTURE_GREY
                                                        : ISO_PICTURE_DARK;
        p->verdicts = true;
    }
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

/* Without verdicts an orbit without a rotation number is grey. any: which shades there are. */
static void find_shades(iso_picture_points *p, bool any[3])
{
    /* The images by the reversors that the return map has carry an orbit to an orbit with the same rotation number: so
     * each island shows where one of its images has a start. makes: the reversors that make image n of
     * iso_picture_image, as bits. */
    static const unsigned makes[8] = {0, 2, 2 | 4, 4, 1, 1 | 2, 1 | 2 | 4, 1 | 4};
    unsigned images = 0;
    for (unsigned n = 0; n < 8; n++)
        if (!(makes[n] & ~p->reversors)) images |= 1u << n;
    for (size_t i = 0; i < iso_record_rows(p->orbits); i++) {
        double *orbit = iso_record_row(p->orbits, i);
        if (orbit[SHADE] == ISO_PICTURE_COLOURED && isnan(orbit[ROTATION]))
            orbit[SHADE] = p->verdicts ? ISO_PICTURE_DARK : ISO_PICTURE_GREY;
    }
    for (size_t i = 0; i < iso_record_rows(p->kept); i++) {
        double *row = iso_record_row(p->kept, i);
        const double *orbit = iso_record_const_row(p->orbits, (size_t)row[ORBIT]);
        const bool coloured = orbit[SHADE] == ISO_PICTURE_COLOURED;
        row[ISO_PICTURE_SHADE] = orbit[SHADE];
        row[ISO_PICTURE_COLOUR] = coloured ? orbit[ROTATION] : 0;
        row[ISO_PICTURE_IMAGES] = coloured ? images : 1;
        any[(int)orbit[SHADE]] = true;
    }
}

iso_status iso_picture_points_make(iso_context *ctx, iso_picture_points *p, const iso_record *const over[],
                                   const char *options, iso_picture *picture)
{
    const iso_picture_request q = {.options = options};
    const size_t count = iso_record_rows(p->orbits);
    char ball[ISO_BALL_SIZE];
    bool any[3] = {false};
    iso_record *orbits;
    if (p->l < 0) return ISO_FAIL_INPUT(ctx, "", "no picture: an event has no coordinates l, x");
    if (count == 0) return ISO_FAIL_INPUT(ctx, "", "no picture: there is no crossing");
    picture->layout = "section";
    ISO_TRY(iso_picture_charts_options(ctx, &q, &p->charts));
    ISO_TRY(end_orbit(ctx, p));
    ISO_TRY(thin_out(ctx, p, MOST / 4));
    find_shades(p, any);
    ISO_TRY(iso_picture_charts_add(ctx, &p->charts, p->kept, picture));
    ISO_TRY(iso_picture_add(ctx, picture, "orbits", "orbit shade rotation", &orbits));
    ISO_TRY(iso_record_add(ctx, orbits, count, iso_record_const_row(p->orbits, 0)));
    ISO_TRY(iso_picture_line(ctx, picture, "title", "%s: %zu orbit%s%s", iso_ball_text(ball, &p->charts.params),
                             count, count == 1 ? "" : "s",
                             p->reversors && any[ISO_PICTURE_COLOURED] ? " and mirror images" : ""));
    ISO_TRY(iso_picture_line(ctx, picture, "grey_means", "%s",
                             !any[ISO_PICTURE_GREY] ? ""
                             : p->verdicts          ? "chaotic"
                             : p->parted            ? "ball and point part: chaotic; or too few crossings to tell"
                                                    : "chaotic, or too few crossings to tell"));
    ISO_TRY(iso_picture_line(ctx, picture, "dark_means", "%s", any[ISO_PICTURE_DARK] ? "undecided" : ""));
    return iso_picture_over(ctx, &p->charts, over, picture);
}

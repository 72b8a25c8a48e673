/* section_over.c - what is drawn over a section: periodic orbits, and the manifolds of the middle axis' rotation (see
 * section_impl.h). */
#include <math.h>
#include <string.h>

#include "instrument/separatrix/separatrix.h"
#include "map/section_impl.h"
#include "orbit/description.h"
#include "picture/section_impl.h"

/* The tables of both sides, the ball's first. */
typedef struct over {
    const iso_picture_charts *charts;
    iso_record *orbits[2], *curve[2][2]; /* curve: leaves, enters */
    bool stable[2];                      /* there are unstable ones, stable ones */
} over;

static bool is_near(double a, double b)
{
    return fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b));
}

/* A table that was read has a line with the name of its file. */
static iso_status refuse(iso_context *ctx, const iso_record *table, const char *why)
{
    const char *file = iso_record_get(table, "file");
    return ISO_FAIL_INPUT(ctx, "over", "over the section '%s': %s", file ? file : iso_record_kind(table), why);
}

static iso_status check_moments(iso_context *ctx, const iso_record *table, const iso_params *wanted, bool k)
{
    iso_params p;
    ISO_TRY(iso_record_params(ctx, table, &p));
    bool same = !k || is_near(p.k, wanted->k);
    for (int i = 0; i < 3; i++) same = same && is_near(p.J[i], wanted->J[i]);
    return same ? ISO_OK : refuse(ctx, table, "it has other k or J than the section");
}

static iso_status add_orbits(iso_context *ctx, over *o, const iso_record *table)
{
    ISO_TRY(check_moments(ctx, table, &o->charts->params, true));
    if (iso_picture_axis(table) != o->charts->axis) return refuse(ctx, table, "its section is about another axis");
    for (size_t i = 0; i < iso_record_rows(table); i++) {
        const bool stable = iso_picture_is(table, i, "stability", "stable");
        o->stable[stable] = true;
        for (int n = 0; n < 16; n++) {
            double at[2];
            iso_picture_image(n / 2, iso_picture_number(table, i, "l"), iso_picture_number(table, i, "x"), at);
            const iso_picture_spot s = iso_picture_place(o->charts, n % 2 == 0, at[0], at[1]);
            if (!isfinite(s.right) || !isfinite(s.up)) continue;
            ISO_TRY(iso_record_add(ctx, o->orbits[n % 2], 1, (double[]){s.right, s.up, stable}));
            if (fabs(s.right) > M_PI - 1e-9) /* on the other edge, too */
                ISO_TRY(iso_record_add(ctx, o->orbits[n % 2], 1, (double[]){-s.right, s.up, stable}));
        }
    }
    return ISO_OK;
}

/* All images of the curve on both sides. An image by one of the reversors enters where the curve leaves: it turns the
 * section over. A row of NaN is a gap of the line. */
static iso_status add_curve(iso_context *ctx, const over *o, const iso_record *curve, double corner)
{
    for (int n = 0; n < 16; n++) {
        iso_record *to = o->curve[n / 8][(n & 1) != (n >> 2 & 1)];
        double last = INFINITY, at[2];
        for (size_t i = 0; i < iso_record_rows(curve); i++) {
            iso_picture_image(n % 8, iso_picture_at(curve, i, 0) + corner, iso_picture_at(curve, i, 1), at);
            const iso_picture_spot s = iso_picture_place(o->charts, n < 8, at[0], at[1]);
            if (!isfinite(s.right) || !isfinite(s.up)) continue;
            if (fabs(s.right - last) > M_PI) ISO_TRY(iso_record_add(ctx, to, 1, (double[]){NAN, NAN}));
            ISO_TRY(iso_record_add(ctx, to, 1, (double[]){s.right, s.up}));
            last = s.right;
        }
    }
    return ISO_OK;
}

/* The lobes grow like lambda^(1/2) with each half return. */
iso_status iso_picture_separatrix(iso_context *ctx, double k, const double J[3], double level, double m,
                                  double lambda, iso_record **curve)
{
    const double needed = log(0.3 / fmax(fabs(m), 1e-4)) / (log(lambda) / 2);
    return iso_separatrix_curve(ctx, k, J, level, (int)fmin(fmax(needed, 2) + 2, 60), curve);
}

/* The row of the section's k and level; its curves are computed anew, which takes less than a second. */
static iso_status add_manifolds(iso_context *ctx, const over *o, const iso_record *table)
{
    const iso_picture_charts *charts = o->charts;
    const iso_params *p = &charts->params;
    const int axis = iso_section_axis((iso_point_motion){p, charts->eps, charts->energy});
    const double level = iso_level_of(p, charts->energy / charts->eps);
    size_t i = 0;
    ISO_TRY(check_moments(ctx, table, p, false));
    while (i < iso_record_rows(table) && !(is_near(iso_picture_number(table, i, "k"), p->k) &&
                                           fabs(iso_picture_number(table, i, "level") - level) <= 1e-12))
        i++;
    if (i == iso_record_rows(table)) return refuse(ctx, table, "no row has the k and the level of the section");
    if (axis != charts->axis) return refuse(ctx, table, "its section is about another axis");
    /* l of the rotation about the middle axis. The section is about the axis of the largest moment if k > 0, else of
     * the smallest: of the other two axes b and c the middle one is nearer to it. */
    const double b = p->J[(axis + 1) % 3], c = p->J[(axis + 2) % 3];
    const double corner = (p->k > 0 ? c > b : c < b) ? 0 : M_PI / 2;
    iso_record *curve = NULL;
    iso_status status = iso_picture_separatrix(ctx, p->k, p->J, level, iso_picture_number(table, i, "m"),
                                               iso_picture_number(table, i, "multiplier"), &curve);
    if (status == ISO_OK) status = add_curve(ctx, o, curve, corner);
    iso_record_free(curve);
    return status;
}

iso_status iso_picture_over(iso_context *ctx, const iso_picture_charts *c, const iso_record *const table[],
                            iso_picture *picture)
{
    static const char *const names[2][3] = {{"ball_orbits", "ball_leaves", "ball_enters"},
                                            {"point_orbits", "point_leaves", "point_enters"}};
    over o = {.charts = c};
    for (int side = 0; side < 2; side++) {
        ISO_TRY(iso_picture_add(ctx, picture, names[side][0], "right up stable", &o.orbits[side]));
        for (int enters = 0; enters < 2; enters++)
            ISO_TRY(iso_picture_add(ctx, picture, names[side][1 + enters], "right up", &o.curve[side][enters]));
    }
    for (; table && *table; table++) {
        const bool orbits = strcmp(iso_record_kind(*table), "periodic") == 0;
        if (!orbits && strcmp(iso_record_kind(*table), "splitting") != 0) continue;
        if (!c->alone) return refuse(ctx, *table, "the section must be of a free ball, or of one on a level");
        ISO_TRY(orbits ? add_orbits(ctx, &o, *table) : add_manifolds(ctx, &o, *table));
    }
    return iso_picture_set(ctx, picture, "stable unstable curves",
                           (double[]){o.stable[true], o.stable[false], iso_record_rows(o.curve[0][0]) > 0});
}

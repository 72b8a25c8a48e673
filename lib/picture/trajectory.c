/* trajectory.c - one trajectory: its path in space, on the spheres of ball and point, and charts over a clock.
 *
 * Tables: curves and values (curves.c) of the charts "energies", "pressure", "paces" and "drift"; losses (t): where
 * contact is lost; path and marks (space.c); ball and point with ends and axes (sphere.c). Lines: on_ball, on_point,
 * above: titles of the panels that there are; noise: in place of the chart of drifts, if all of them are rounding;
 * lost: what lost contact is called; note: what the user should know.
 *
 * What the file does not hold is computed: the path of the other model by the isomorphism, energies, drifts, clocks.
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "orbit/description.h"
#include "orbit/orbit_impl.h"
#include "picture/picture_impl.h"
#include "study/energy.h"
#include "task/check/check_impl.h"
#include "task/convert/convert.h"

static const char *const trace[] = {"trace1", "trace2", "trace3"};

typedef struct parts {
    const iso_record *file, *ball, *point; /* ball and point: the file, or its conversion; NULL: not known */
    iso_params params;
} parts;

/* --- what the file does not hold -------------------------------------------------------------------------------- */

/* The model of the file; the ball if it has both. */
static iso_model_kind model_of(const iso_record *r)
{
    return iso_record_find(r, "n1") >= 0 && iso_record_find(r, "omega1") >= 0 ? ISO_BALL : ISO_POINT;
}

/* Converts the file. A ball at rest, or with effects that break the isomorphism, has no twin and is drawn alone. */
static iso_status find_twin(iso_context *ctx, iso_picture *picture, parts *p)
{
    const iso_model_kind to = model_of(p->file) == ISO_BALL ? ISO_POINT : ISO_BALL;
    iso_record **twin = iso_picture_aside(picture);
    if (iso_record_find(p->file, "n1") >= 0) p->ball = p->file;
    if (iso_record_find(p->file, "gamma1") >= 0) p->point = p->file;
    if (p->ball && p->point) return ISO_OK;
    const iso_status status = iso_convert(ctx, p->file, to, 1e-12, twin);
    if (status == ISO_OK) *(to == ISO_POINT ? &p->point : &p->ball) = *twin;
    const bool orbits = iso_record_find(p->file, ISO_ORBIT_COLUMN) >= 0; /* of different energies */
    if (status != ISO_NOT_MAPPED && !(orbits && status == ISO_BAD_INPUT)) return status;
    return iso_picture_line(ctx, picture, "note", "%s is drawn alone: %s", to == ISO_POINT ? "the ball" : "the point",
                            iso_context_message(ctx));
}

/* --- spheres and space ------------------------------------------------------------------------------------------ */

/* The contact on a ball without its point as unit vectors, if the ball has the columns trace1..3; else NULL. */
static iso_status find_trace(iso_context *ctx, iso_picture *picture, const parts *p, const iso_record **found)
{
    int column[3];
    iso_record **made = iso_picture_aside(picture);
    *found = NULL;
    if (p->point || !iso_record_find_all(p->ball, 3, trace, column, NULL)) return ISO_OK;
    ISO_TRY(iso_record_create(ctx, 3, trace, made));
    *found = *made;
    for (size_t i = 0; i < iso_record_rows(p->ball); i++) {
        double to[3];
        for (int c = 0; c < 3; c++) to[c] = iso_picture_at(p->ball, i, column[c]);
        if (norm(to) == 0)
            return iso_context_fail(ctx, ISO_NUMERICAL, trace[0], "a picture: the trace is 0 in row %zu", i + 1);
        make_unit(to);
        ISO_TRY(iso_record_add(ctx, *made, 1, to));
    }
    return ISO_OK;
}

static iso_status add_spheres(iso_context *ctx, iso_picture *picture, const parts *p)
{
    if (p->ball) {
        const iso_record *touched;
        ISO_TRY(find_trace(ctx, picture, p, &touched));
        ISO_TRY(iso_picture_line(ctx, picture, "on_ball",
                                 touched ? "on the ball: where it touched the support" : ISO_PICTURE_OF_BALL));
        ISO_TRY(
            iso_picture_sphere(ctx, picture, "ball", touched ? touched : p->ball, touched ? trace : iso_picture_n));
    }
    if (!p->point) return ISO_OK;
    ISO_TRY(iso_picture_line(ctx, picture, "on_point", ISO_PICTURE_OF_POINT));
    return iso_picture_sphere(ctx, picture, "point", p->point, iso_picture_gamma);
}

/* --- charts ----------------------------------------------------------------------------------------------------- */

static iso_status add_energies(iso_context *ctx, iso_picture *picture, const parts *p)
{
    static const char *const names[] = {"energy h", "kinetic", "potential"};
    iso_record **energies = iso_picture_aside(picture);
    double size = 0, most = 0, range[2];
    /* of a free ball the energy is one of the integrals, whose drift is drawn */
    if (model_of(p->file) != ISO_BALL || !iso_record_get(p->file, "effects")) return ISO_OK;
    ISO_TRY(iso_record_energies(ctx, &p->params, p->file, energies));
    for (int c = 1; *energies && c < (int)iso_record_columns(*energies); c++) {
        iso_picture_range(*energies, c, range);
        size = fmax(size, fmax(fabs(range[0]), fabs(range[1])));
        most = fmax(most, range[1] - range[0]);
    }
    if (!(most > 1e-9 * size)) return ISO_OK; /* nothing changes by more than rounding */
    return iso_picture_add_chart(ctx, picture, "energies", *energies, names, ISO_PICTURE_EXTREMES);
}

/* mu grows without bound where the pressure falls to 0: then its axis ends at about 3 times its usual size. */
static double top_of_mu(const iso_record *r, int mu)
{
    const size_t rows = iso_record_rows(r);
    double sum = 0, range[2];
    for (size_t i = 0; i < rows; i++) {
        const double x = iso_picture_at(r, i, mu);
        sum += x / (1 + x); /* the mean of x/(1+x) stays below 1 */
    }
    const double middle = sum / (double)rows, usual = middle / (1 - fmin(middle, 0.9));
    iso_picture_range(r, mu, range);
    return range[1] > 5 * usual ? fmax(3 * usual, 2 * iso_picture_at(r, 0, mu)) : INFINITY;
}

static iso_status add_pressure(iso_context *ctx, iso_picture *picture, const iso_record *r)
{
    static const char *const clocks[] = {"t", "tau", "s"};
    size_t lost[ISO_PICTURE_LOSSES];
    iso_record *losses;
    int clock = -1;
    for (int i = 0; r && clock < 0 && i < 3; i++) clock = iso_record_find(r, clocks[i]);
    const int pressure = clock < 0 ? -1 : iso_record_find(r, "pressure"),
              mu = pressure < 0 ? -1 : iso_record_find(r, "mu");
    ISO_TRY(iso_picture_add(ctx, picture, "losses", "t", &losses));
    if (pressure < 0) return ISO_OK;
    iso_picture_curve curve = {"pressure", "pressure", r, clock, pressure, false, ISO_PICTURE_EXTREMES, INFINITY};
    if (mu >= 0) {
        iso_picture_curve of_mu = curve;
        of_mu.name = "μ needed (right)", of_mu.right = true;
        of_mu.column = mu, of_mu.top = top_of_mu(r, mu);
        ISO_TRY(iso_picture_add_curve(ctx, picture, &of_mu));
    }
    ISO_TRY(iso_picture_add_curve(ctx, picture, &curve));
    const int count = iso_picture_losses(r, lost);
    for (int i = 0; i < count; i++) ISO_TRY(iso_record_add(ctx, losses, 1, &iso_record_const_row(r, lost[i])[clock]));
    if (count == 0) return ISO_OK;
    const bool ends = lost[count - 1] + 1 == iso_record_rows(r); /* a ball that is held on both sides goes on */
    return iso_picture_line(ctx, picture, "lost", ends ? "contact lost" : "pressure 0");
}

/* ds/dt and dtau/dt in every row, each with the mean 1: powers of q = (gamma, J gamma), (16) and (24) of the theory.
 * Where there is a twin, there are other clocks. */
static iso_status add_paces(iso_context *ctx, iso_picture *picture, const parts *p)
{
    static const char *const symbols[] = {"ds/dt", "dτ/dt"};
    const iso_model_kind model = model_of(p->file);
    const char *names[] = {model == ISO_BALL ? "t" : "s", "ds/dt", "dtau/dt"};
    const int clock = iso_record_find(p->file, names[0]),
              at = iso_record_find(p->file, model == ISO_BALL ? "n1" : "gamma1");
    const size_t rows = iso_record_rows(p->file);
    double first = 0, sum[3] = {0}, e = 1 / (2 * p->params.k);
    iso_record **paces = iso_picture_aside(picture);
    if (clock < 0 || !(p->ball && p->point)) return ISO_OK;
    ISO_TRY(iso_record_create(ctx, 3, names, paces));
    for (size_t i = 0; i < rows; i++) {
        double y[ISO_STATE] = {0};
        copy(iso_record_const_row(p->file, i) + at, y + 3, 3);
        const double q = iso_systems[model]->q(&p->params, y, NULL);
        if (i == 0) first = q;
        const double pace[] = {iso_picture_at(p->file, i, clock), pow(q / first, 1 + e), pow(q / first, 1 - e)};
        for (int c = 1; c < 3; c++) sum[c] += pace[c];
        ISO_TRY(iso_record_add(ctx, *paces, 1, pace));
    }
    for (size_t i = 0; i < rows; i++)
        for (int c = 1; c < 3; c++) iso_record_row(*paces, i)[c] *= (double)rows / sum[c];
    return iso_picture_add_chart(ctx, picture, "paces", *paces, symbols, ISO_PICTURE_EXTREMES);
}

/* Drifts of rounding are no chart, but a line: "integrals hold up to rounding: no drift above 3e-16 of h, omega.n". */
static iso_status add_drifts(iso_context *ctx, iso_picture *picture, const parts *p)
{
    iso_record **drifts = iso_picture_aside(picture);
    char names[200] = "";
    double largest = 0, range[2];
    ISO_TRY(iso_check_drifts(ctx, &p->params, p->file, -1, drifts));
    for (int c = 1, used = 0; c < (int)iso_record_columns(*drifts); c++) {
        iso_picture_range(*drifts, c, range);
        largest = fmax(largest, range[1]);
        if (used < 160)
            used += snprintf(names + used, sizeof names - (size_t)used, "%s%.31s", c > 1 ? ", " : "",
                             iso_picture_symbol(iso_record_name(*drifts, (size_t)c)));
    }
    if (largest < 1000 * DBL_EPSILON)
        return iso_picture_line(ctx, picture, "noise", "integrals hold up to rounding: no drift above %.0e of %s",
                                largest, names);
    return iso_picture_add_chart(ctx, picture, "drift", *drifts, NULL, ISO_PICTURE_LARGEST);
}

/* --- the sheet -------------------------------------------------------------------------------------------------- */

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    const iso_record *r = q->table[0];
    parts p = {.file = r};
    double up[3];
    ISO_TRY(iso_record_params(ctx, r, &p.params));
    ISO_TRY(iso_picture_add_curves(ctx, picture));
    ISO_TRY(find_twin(ctx, picture, &p));
    const bool space = iso_record_find(r, "centre1") >= 0 || iso_record_find(r, "contact1") >= 0;
    if (space) ISO_TRY(iso_picture_space(ctx, r, iso_record_up(ctx, r, up) ? up : NULL, p.params.k == 1, picture));
    ISO_TRY(add_spheres(ctx, picture, &p));
    ISO_TRY(add_energies(ctx, picture, &p));
    ISO_TRY(add_pressure(ctx, picture, p.ball));
    ISO_TRY(add_paces(ctx, picture, &p));
    ISO_TRY(add_drifts(ctx, picture, &p));
    return iso_picture_title(ctx, q, picture,
                             space               ? "The path of a ball"
                             : p.ball && p.point ? "One orbit on both spheres"
                             : p.ball            ? "A ball without a twin"
                                                 : "A point without a twin",
                             &p.params);
}

const iso_picture_maker iso_picture_trajectory = {"trajectory", "A trajectory", {NULL}, .options = " ", .make = make};

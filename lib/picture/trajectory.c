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

static const char *const normal[] = {"n1", "n2", "n3"}, *const place[] = {"gamma1", "gamma2", "gamma3"},
                         *const trace[] = {"trace1", "trace2", "trace3"};

/* The file, its conversion, and numbers from both. */
typedef struct parts {
    const iso_record *file, *ball, *point; /* ball and point: the file or the twin; NULL: not known */
    iso_params params;
    iso_record *twin, *trace, *drifts, *paces, *energies;
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
    if (iso_record_find(p->file, "n1") >= 0) p->ball = p->file;
    if (iso_record_find(p->file, "gamma1") >= 0) p->point = p->file;
    if (p->ball && p->point) return ISO_OK;
    const iso_status status = iso_convert(ctx, p->file, to, 1e-12, &p->twin);
    if (status == ISO_OK) *(to == ISO_POINT ? &p->point : &p->ball) = p->twin;
    if (status != ISO_NOT_MAPPED) return status;
    char note[500];
    snprintf(note, sizeof note, "%s is drawn alone: %s", to == ISO_POINT ? "the ball" : "the point",
             iso_context_message(ctx));
    return iso_picture_say(ctx, picture, "note", note);
}

/* ds/dt and dtau/dt in every row, each with the mean 1: powers of q = (gamma, J gamma), (16) and (24) of the theory.
 * Where there is a twin, there are other clocks. */
static iso_status find_paces(iso_context *ctx, parts *p)
{
    const iso_model_kind model = model_of(p->file);
    const char *names[] = {model == ISO_BALL ? "t" : "s", "ds/dt", "dtau/dt"};
    const int clock = iso_record_find(p->file, names[0]),
              at = iso_record_find(p->file, model == ISO_BALL ? "n1" : "gamma1");
    const size_t rows = iso_record_rows(p->file);
    double first = 0, sum[3] = {0}, e = 1 / (2 * p->params.k);
    if (clock < 0 || !(p->ball && p->point)) return ISO_OK;
    ISO_TRY(iso_record_create(ctx, 3, names, &p->paces));
    for (size_t i = 0; i < rows; i++) {
        double y[ISO_STATE] = {0};
        copy(iso_record_const_row(p->file, i) + at, y + 3, 3);
        const double q = iso_system_at((int)model)->q(&p->params, y, NULL);
        if (i == 0) first = q;
        const double pace[] = {iso_record_const_row(p->file, i)[clock], pow(q / first, 1 + e), pow(q / first, 1 - e)};
        for (int c = 1; c < 3; c++) sum[c] += pace[c];
        ISO_TRY(iso_record_add(ctx, p->paces, 1, pace));
    }
    for (size_t i = 0; i < rows; i++)
        for (int c = 1; c < 3; c++) iso_record_row(p->paces, i)[c] *= (double)rows / sum[c];
    return ISO_OK;
}

/* The contact on a ball without its point as unit vectors, if the ball has the columns trace1..3. */
static iso_status find_trace(iso_context *ctx, parts *p)
{
    int column[3];
    if (!p->ball || p->point || !iso_record_find_all(p->ball, 3, trace, column, NULL)) return ISO_OK;
    ISO_TRY(iso_record_create(ctx, 3, trace, &p->trace));
    for (size_t i = 0; i < iso_record_rows(p->ball); i++) {
        double to[3];
        for (int c = 0; c < 3; c++) to[c] = iso_record_const_row(p->ball, i)[column[c]];
        if (norm(to) == 0)
            return iso_context_fail(ctx, ISO_NUMERICAL, trace[0], "a picture: the trace is 0 in row %zu", i + 1);
        scale(to, 1 / norm(to));
        ISO_TRY(iso_record_add(ctx, p->trace, 1, to));
    }
    return ISO_OK;
}

/* --- spheres and space ------------------------------------------------------------------------------------------ */

static iso_status add_sphere(iso_context *ctx, iso_picture *picture, const char *name, const iso_record *r,
                             const char *const columns[3])
{
    int first;
    ISO_TRY(iso_picture_find(ctx, r, 3, columns, &first));
    ISO_TRY(iso_picture_path(ctx, picture, name, r, first));
    return iso_picture_axes(ctx, picture, name, r, first, 1 + iso_record_rows(r) / 400);
}

static iso_status add_spheres(iso_context *ctx, iso_picture *picture, parts *p)
{
    ISO_TRY(find_trace(ctx, p));
    if (p->ball) {
        ISO_TRY(iso_picture_say(ctx, picture, "on_ball",
                                p->trace ? "on the ball: where it touched the support" : ISO_PICTURE_OF_BALL));
        ISO_TRY(add_sphere(ctx, picture, "ball", p->trace ? p->trace : p->ball, p->trace ? trace : normal));
    }
    if (!p->point) return ISO_OK;
    ISO_TRY(iso_picture_say(ctx, picture, "on_point", ISO_PICTURE_OF_POINT));
    return add_sphere(ctx, picture, "point", p->point, place);
}

static iso_status add_space(iso_context *ctx, iso_picture *picture, const parts *p, const char **seen)
{
    double up[3];
    const iso_record *r = p->file;
    if (iso_record_find(r, "centre1") < 0 && iso_record_find(r, "contact1") < 0) return ISO_OK;
    *seen = "The path of a ball";
    return iso_picture_space(ctx, r, iso_record_up(ctx, r, up) ? up : NULL, p->params.k == 1, picture);
}

/* --- charts ----------------------------------------------------------------------------------------------------- */

static double largest_of(const iso_record *r, size_t column)
{
    double most = 0;
    for (size_t i = 0; i < iso_record_rows(r); i++) most = fmax(most, iso_record_const_row(r, i)[column]);
    return most;
}

/* Whether no column but the first changes by more than rounding of the largest number of them. */
static bool is_constant(const iso_record *r)
{
    double size = 0, most = 0;
    for (size_t c = 1; c < iso_record_columns(r); c++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t i = 0; i < iso_record_rows(r); i++) {
            low = fmin(low, iso_record_const_row(r, i)[c]);
            high = fmax(high, iso_record_const_row(r, i)[c]);
        }
        size = fmax(size, fmax(fabs(low), fabs(high)));
        most = fmax(most, high - low);
    }
    return !(most > 1e-9 * size);
}

/* The chart of a record over its first column: all others. */
static iso_status add_chart(iso_context *ctx, iso_picture *picture, const char *chart, const iso_record *r,
                            const char *const names[], iso_picture_thinning thinning)
{
    for (int c = 1; c < (int)iso_record_columns(r); c++)
        ISO_TRY(iso_picture_add_curve(
            ctx, picture,
            &(iso_picture_curve){chart, names ? names[c - 1] : NULL, r, 0, c, false, thinning, INFINITY}));
    return ISO_OK;
}

static iso_status add_energies(iso_context *ctx, iso_picture *picture, parts *p)
{
    static const char *const names[] = {"energy h", "kinetic", "potential"};
    /* of a free ball the energy is one of the integrals, whose drift is drawn */
    if (model_of(p->file) != ISO_BALL || !iso_record_get(p->file, "effects")) return ISO_OK;
    ISO_TRY(iso_record_energies(ctx, &p->params, p->file, &p->energies));
    if (!p->energies || is_constant(p->energies)) return ISO_OK;
    return add_chart(ctx, picture, "energies", p->energies, names, ISO_PICTURE_EXTREMES);
}

/* mu grows without bound where the pressure falls to 0: then its axis ends at about 3 times its usual size. */
static double top_of_mu(const iso_record *r, int mu)
{
    const size_t rows = iso_record_rows(r);
    double sum = 0;
    for (size_t i = 0; i < rows; i++) {
        const double x = iso_record_const_row(r, i)[mu];
        sum += x / (1 + x); /* the mean of x/(1+x) stays below 1 */
    }
    const double middle = sum / (double)rows, usual = middle / (1 - fmin(middle, 0.9));
    if (!(largest_of(r, (size_t)mu) > 5 * usual)) return INFINITY;
    return fmax(3 * usual, 2 * iso_record_const_row(r, 0)[mu]);
}

static iso_status add_pressure(iso_context *ctx, iso_picture *picture, const parts *p)
{
    static const char *const clocks[] = {"t", "tau", "s"};
    size_t lost[ISO_PICTURE_LOSSES];
    iso_record *losses;
    int clock = -1;
    const iso_record *r = p->ball;
    for (int i = 0; r && clock < 0 && i < 3; i++) clock = iso_record_find(r, clocks[i]);
    const int pressure = clock < 0 ? -1 : iso_record_find(r, "pressure"),
              mu = pressure < 0 ? -1 : iso_record_find(r, "mu");
    ISO_TRY(iso_picture_add(ctx, picture, "losses", 1, (const char *const[]){"t"}, &losses));
    if (pressure < 0) return ISO_OK;
    iso_picture_curve of_mu = {"pressure", "μ needed (right)", r, clock, mu, true, ISO_PICTURE_EXTREMES, 0};
    if (mu >= 0) of_mu.top = top_of_mu(r, mu);
    if (mu >= 0) ISO_TRY(iso_picture_add_curve(ctx, picture, &of_mu));
    const iso_picture_curve of_pressure = {"pressure", "pressure",           r,       clock, pressure,
                                           false,      ISO_PICTURE_EXTREMES, INFINITY};
    ISO_TRY(iso_picture_add_curve(ctx, picture, &of_pressure));
    const int count = iso_picture_losses(r, lost);
    for (int i = 0; i < count; i++) ISO_TRY(iso_record_add(ctx, losses, 1, &iso_record_const_row(r, lost[i])[clock]));
    if (count == 0) return ISO_OK;
    const bool ends = lost[count - 1] + 1 == iso_record_rows(r); /* a ball that is held on both sides goes on */
    return iso_picture_say(ctx, picture, "lost", ends ? "contact lost" : "pressure 0");
}

/* "integrals hold up to rounding: no drift above 3e-16 of h, omega.n, |n|" */
static iso_status say_noise(iso_context *ctx, iso_picture *picture, const iso_record *r, double largest)
{
    char text[300];
    int used = snprintf(text, sizeof text, "integrals hold up to rounding: no drift above %.0e of ", largest);
    for (size_t c = 1; c < iso_record_columns(r) && used < 200; c++)
        used += snprintf(text + used, sizeof text - (size_t)used, "%s%.31s", c > 1 ? ", " : "",
                         iso_picture_symbol(iso_record_name(r, c)));
    return iso_picture_say(ctx, picture, "noise", text);
}

static iso_status add_drifts(iso_context *ctx, iso_picture *picture, parts *p)
{
    double largest = 0;
    ISO_TRY(iso_check_drifts(ctx, &p->params, p->file, -1, &p->drifts));
    for (size_t c = 1; c < iso_record_columns(p->drifts); c++) largest = fmax(largest, largest_of(p->drifts, c));
    if (largest < 1000 * DBL_EPSILON) return say_noise(ctx, picture, p->drifts, largest);
    return add_chart(ctx, picture, "drift", p->drifts, NULL, ISO_PICTURE_LARGEST);
}

static iso_status add_charts(iso_context *ctx, iso_picture *picture, parts *p)
{
    static const char *const names[] = {"ds/dt", "dτ/dt"};
    ISO_TRY(add_energies(ctx, picture, p));
    ISO_TRY(add_pressure(ctx, picture, p));
    ISO_TRY(find_paces(ctx, p));
    if (p->paces) ISO_TRY(add_chart(ctx, picture, "paces", p->paces, names, ISO_PICTURE_EXTREMES));
    return add_drifts(ctx, picture, p);
}

/* --- the sheet -------------------------------------------------------------------------------------------------- */

static iso_status add_all(iso_context *ctx, const iso_picture_request *q, iso_picture *picture, parts *p)
{
    char title[ISO_PICTURE_TITLE];
    ISO_TRY(iso_record_params(ctx, p->file, &p->params));
    ISO_TRY(iso_picture_add_curves(ctx, picture));
    ISO_TRY(find_twin(ctx, picture, p));
    const char *seen = p->ball && p->point ? "One orbit on both spheres"
                       : p->ball           ? "A ball without a twin"
                                           : "A point without a twin";
    ISO_TRY(add_space(ctx, picture, p, &seen));
    ISO_TRY(add_spheres(ctx, picture, p));
    ISO_TRY(add_charts(ctx, picture, p));
    return iso_picture_say(ctx, picture, "title",
                           iso_record_get(p->file, "title") ? q->title : iso_picture_title(title, seen, &p->params));
}

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    parts p = {.file = q->table[0]};
    const iso_status status = add_all(ctx, q, picture, &p);
    iso_record *const made[] = {p.twin, p.trace, p.drifts, p.paces, p.energies};
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) iso_record_free(made[i]);
    return status;
}

const iso_picture_maker iso_picture_trajectory = {"trajectory", "A trajectory", {NULL}, .options = " ", .make = make};

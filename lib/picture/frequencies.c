/* frequencies.c - the spectral lines of n(t), or where the problem separates the image of the momentum map.
 *
 * Layout "frequencies": lines (signal: 1: n_j + i n_l, 2: n_axis, (axis, j, l) cyclic; frequency, amplitude; label:
 * "m,n" at the strongest lines, m times frequency 1 and n times frequency 2, where there is room; else ""). Lines:
 * axis; labels, how many; warning: what is to be known of these lines, or "". The frequencies are those of the lines of
 * the table, "estimate.lines_turning.0.frequency".
 *
 * Layout "momentum": kinds of motion over the energy h and the integral F, and the orbit: parts (part, h, low, high of
 * F), kinds (part, name; h, over: where the name stands in the picture of F/h; NaN: it has no room), lines (line, h, f)
 * and rotations (line, name). Lines: f, the name of F; at_h, at_f: the orbit; low, high: F/h that is drawn.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number_impl.h"
#include "instrument/frequencies/momentum.h"
#include "orbit/description.h"
#include "picture/picture_impl.h"

/* --- the image of the momentum map ------------------------------------------------------------------------------ */

enum { PARTS = ISO_MOMENTUM_PARTS };

/* Largest and least F/h, with room. */
static void find_range(const iso_record *bounds, double range[2])
{
    double low = INFINITY, high = -INFINITY;
    const size_t rows = iso_record_rows(bounds);
    for (size_t i = rows / 4; i < rows; i++) /* near h = 0, off H = 0, it grows without bound */
        for (int c = 1; c <= 2 * PARTS; c++) {
            const double x = iso_picture_at(bounds, i, c) / iso_picture_at(bounds, i, 0);
            if (isfinite(x)) low = fmin(low, x), high = fmax(high, x);
        }
    const double room = high > low ? 0.06 * (high - low) : 0.1 * fabs(high);
    range[0] = low - room, range[1] = high + room;
}

/* h and F/h where a part is thickest, if it is thicker than `room`; else NaN. low: the column of its bounds. */
static void find_place(const iso_record *bounds, int low, double room, double place[2])
{
    const int high = low + 1;
    const size_t rows = iso_record_rows(bounds);
    const double *best = iso_record_const_row(bounds, rows * 2 / 5);
    double thickest = isfinite(best[low]) ? 1.001 * (best[high] - best[low]) / best[0] : 0;
    for (size_t i = rows / 4; i < rows * 3 / 4; i++) {
        const double *row = iso_record_const_row(bounds, i), here = (row[high] - row[low]) / row[0];
        if (here > thickest) thickest = here, best = row;
    }
    place[0] = thickest > room ? best[0] : (double)NAN;
    place[1] = thickest > room ? (best[low] + best[high]) / 2 / best[0] : (double)NAN;
}

/* The rows of a part, or of a line: first is last, and the table has three columns. Then its name, and where it
 * stands, if there is a row. */
static iso_status add_rows(iso_context *ctx, const iso_record *bounds, int number, int first, int last,
                           iso_record *table, const char *name, const double place[2], iso_record *names)
{
    double row[4] = {number, 0, place[0], place[1]};
    bool any = false;
    for (size_t i = 0; i < iso_record_rows(bounds); i++) {
        const double *from = iso_record_const_row(bounds, i);
        if (!isfinite(from[first]) || !isfinite(from[last])) continue;
        any = true;
        ISO_TRY(iso_record_add(ctx, table, 1, (double[]){number, from[0], from[first], from[last]}));
    }
    ISO_TRY(iso_record_intern(ctx, names, name, &row[1]));
    return any ? iso_record_add(ctx, names, 1, row) : ISO_OK;
}

static iso_status make_map(iso_context *ctx, const iso_momentum *m, const double at[2], iso_picture *picture)
{
    iso_record *parts, *kinds, *lines, *rotations, **bounds = iso_picture_aside(picture);
    double range[2], place[2];
    char name[ISO_MOMENTUM_WORDS];
    picture->layout = "momentum";
    ISO_TRY(iso_picture_add(ctx, picture, "parts", "part h low high", &parts));
    ISO_TRY(iso_picture_add(ctx, picture, "kinds", "part name' h over", &kinds));
    ISO_TRY(iso_picture_add(ctx, picture, "lines", "line h f", &lines));
    ISO_TRY(iso_picture_add(ctx, picture, "rotations", "line name'", &rotations));
    ISO_TRY(iso_picture_line(ctx, picture, "f", m->k == 1 ? "plane" : "shell"));
    ISO_TRY(iso_picture_set(ctx, picture, "at_h at_f", at));
    ISO_TRY(iso_momentum_bounds(ctx, m, at[0], bounds)); /* columns: h, low and high of each part, F of each line */
    find_range(*bounds, range);
    for (int i = 0; i < PARTS; i++) {
        const int low = 1 + 2 * i;
        find_place(*bounds, low, 0.12 * (range[1] - range[0]), place);
        iso_momentum_name_part(m, (iso_momentum_part)i, name);
        ISO_TRY(add_rows(ctx, *bounds, i + 1, low, low + 1, parts, name, place, kinds));
    }
    for (int i = 0; i < ISO_MOMENTUM_LINES; i++) {
        const int column = 1 + 2 * PARTS + i;
        iso_momentum_name_line(m, i, name);
        ISO_TRY(add_rows(ctx, *bounds, i + 1, column, column, lines, name, place, rotations));
    }
    return iso_picture_set(ctx, picture, "low high", range);
}

/* --- spectral lines --------------------------------------------------------------------------------------------- */

enum { LABELLED = 3, LABEL = 32 };
static const char *const signals[] = {"lines_turning", "lines_along"};

/* The number of a line "estimate.SIGNAL.i.KEY"; NaN: there is none. */
static double number_of(const iso_record *r, int signal, int i, const char *key)
{
    char name[96];
    double x;
    snprintf(name, sizeof name, "estimate.%s.%d.%s", signals[signal], i, key);
    const char *text = iso_record_get(r, name);
    return text && iso_number_read(text, strlen(text), &x) ? x : (double)NAN;
}

/* Labels that have a place keep others away. */
typedef struct labels {
    double at[2 * LABELLED], span;
    int count;
    bool none; /* the orbit is not regular */
} labels;

/* The strongest lines come first. Each may have the combination of the two frequencies, if it is known, as a label. */
static iso_status add_signal(iso_context *ctx, const iso_record *r, int signal, labels *l, iso_record *lines)
{
    int known = 0;
    for (int i = 0; isfinite(number_of(r, signal, i, "frequency")); i++) {
        double row[] = {signal + 1, number_of(r, signal, i, "frequency"), number_of(r, signal, i, "amplitude"), 0};
        const double m = number_of(r, signal, i, "m"), n = number_of(r, signal, i, "n");
        char label[LABEL] = "";
        if (!(row[2] > 0)) continue;
        bool labelled = isfinite(m) && isfinite(n) && !l->none && known++ < LABELLED;
        for (int j = 0; j < l->count; j++) labelled = labelled && !(fabs(l->at[j] - row[1]) < 0.02 * l->span);
        if (labelled) {
            l->at[l->count++] = row[1];
            snprintf(label, sizeof label, "%.0f,%.0f", m, n);
        }
        ISO_TRY(iso_record_intern(ctx, lines, label, &row[3]));
        ISO_TRY(iso_record_add(ctx, lines, 1, row));
    }
    return ISO_OK;
}

static iso_status make_lines(iso_context *ctx, const iso_record *r, iso_picture *picture)
{
    const char *axis = iso_record_get(r, "estimate.axis"), *verdict = iso_record_get(r, "estimate.verdict"),
               *warning = "";
    double low = INFINITY, high = -INFINITY, x;
    iso_record *lines;
    picture->layout = "frequencies";
    if (verdict && strcmp(verdict, "chaotic") == 0)
        warning = "this orbit is chaotic: it has no fixed frequencies, and these lines are of this stretch only";
    if (verdict && strcmp(verdict, "undecided") == 0)
        warning = "it is not decided whether this orbit has fixed frequencies: a longer one may tell";
    if (!axis) return ISO_FAIL_INPUT(ctx, "", "no picture: there is no map (h, F), and no frequency is estimated");
    ISO_TRY(iso_picture_add(ctx, picture, "lines", "signal frequency amplitude label'", &lines));
    for (int s = 0; s < 2; s++)
        for (int i = 0; isfinite(x = number_of(r, s, i, "frequency")); i++) low = fmin(low, x), high = fmax(high, x);
    labels l = {.span = high - low, .none = *warning != '\0'};
    for (int s = 0; s < 2; s++) ISO_TRY(add_signal(ctx, r, s, &l, lines));
    if (iso_record_rows(lines) == 0) return ISO_FAIL_INPUT(ctx, "", "a picture of lines needs at least one line");
    ISO_TRY(iso_picture_line(ctx, picture, "axis", "%s", axis));
    ISO_TRY(iso_picture_line(ctx, picture, "warning", "%s", warning));
    return iso_picture_set(ctx, picture, "labels", (double[]){l.count});
}

/* h, F and the level H of the point, and the map with an area about them. */
static bool has_map(const iso_record *r, const iso_params *p, iso_momentum *m, double at[2])
{
    const char *const text[] = {iso_record_get(r, "h"), iso_record_get(r, "integral.value"), iso_record_get(r, "H")};
    const char *name = iso_record_get(r, "integral.name");
    double x[3];
    for (int i = 0; i < 3; i++)
        if (!text[i] || !iso_number_read(text[i], strlen(text[i]), &x[i])) return false;
    memcpy(at, x, 2 * sizeof *at);
    return name && iso_momentum_at(p, x[2], x[0], name, x[1], m);
}

static iso_status make(iso_context *ctx, const iso_picture_request *q, iso_picture *picture)
{
    const iso_record *r = q->table[0];
    iso_params p;
    iso_momentum m;
    double at[2];
    ISO_TRY(iso_record_params(ctx, r, &p));
    const bool map = has_map(r, &p, &m, at);
    ISO_TRY(map ? make_map(ctx, &m, at, picture) : make_lines(ctx, r, picture));
    return iso_picture_title(ctx, q, picture,
                             map ? "Kinds of motion, by energy h and integral F" : "Spectrum of n(t)", &p);
}

const iso_picture_maker iso_picture_frequencies = {"frequencies", "Frequencies", {NULL}, .alone = true, .make = make};

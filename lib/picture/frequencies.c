/* frequencies.c - the spectral lines of n(t), or where the problem separates the image of the momentum map
 * (momentum.c).
 *
 * Tables: lines (signal: 1: n_j + i n_l, 2: n_axis, (axis, j, l) cyclic; frequency, amplitude; label: "m,n" at the
 * strongest lines, m times frequency 1 and n times frequency 2, where there is room; else "").
 * Lines: axis; labels, how many; warning: what is to be known of these lines, or "".
 * The frequencies are those of the lines of the table, "estimate.lines_turning.0.frequency".
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number_impl.h"
#include "instrument/frequencies/momentum.h"
#include "orbit/description.h"
#include "picture/picture_impl.h"

enum { LABELLED = 3, WORD = 32 };

/* The number of a line "estimate.SIGNAL.i.KEY"; NaN: there is none. */
static double number_of(const iso_record *r, const char *signal, int i, const char *key)
{
    char name[96];
    double x;
    snprintf(name, sizeof name, "estimate.%s.%d.%s", signal, i, key);
    const char *text = iso_record_get(r, name);
    return text && iso_number_read(text, strlen(text), &x) ? x : (double)NAN;
}

static const char *warning_of(const iso_record *r)
{
    const char *verdict = iso_record_get(r, "estimate.verdict");
    if (verdict && strcmp(verdict, "chaotic") == 0)
        return "this orbit is chaotic: it has no fixed frequencies, and these lines are of this stretch only";
    if (verdict && strcmp(verdict, "undecided") == 0)
        return "it is not decided whether this orbit has fixed frequencies: a longer one may tell";
    return "";
}

/* The combination of the two frequencies at a line; "": it is not known. */
static void name_line(const iso_record *r, const char *signal, int i, char word[static WORD])
{
    const double m = number_of(r, signal, i, "m"), n = number_of(r, signal, i, "n");
    *word = '\0';
    if (isfinite(m) && isfinite(n)) snprintf(word, WORD, "%.0f,%.0f", m, n);
}

/* Labels that have a place keep others away. */
typedef struct labels {
    double at[2 * LABELLED], span;
    int count;
    bool none; /* the orbit is not regular */
} labels;

static bool has_room(const labels *l, double frequency)
{
    for (int i = 0; i < l->count; i++)
        if (fabs(l->at[i] - frequency) < 0.02 * l->span) return false;
    return true;
}

/* The strongest lines come first. */
static iso_status add_signal(iso_context *ctx, const iso_record *r, const char *signal, int number, labels *l,
                             iso_record *lines)
{
    int known = 0;
    char word[WORD];
    for (int i = 0; isfinite(number_of(r, signal, i, "frequency")); i++) {
        double row[] = {number, number_of(r, signal, i, "frequency"), number_of(r, signal, i, "amplitude"), 0};
        if (!(row[2] > 0)) continue;
        name_line(r, signal, i, word);
        const bool labelled = *word && !l->none && known++ < LABELLED && has_room(l, row[1]);
        if (labelled) l->at[l->count++] = row[1];
        ISO_TRY(iso_record_intern(ctx, lines, labelled ? word : "", &row[3]));
        ISO_TRY(iso_record_add(ctx, lines, 1, row));
    }
    return ISO_OK;
}

/* From the least to the largest frequency of both signals. */
static double span_of(const iso_record *r, const char *const signals[2])
{
    double range[2] = {INFINITY, -INFINITY}, x;
    for (int s = 0; s < 2; s++)
        for (int i = 0; isfinite(x = number_of(r, signals[s], i, "frequency")); i++)
            range[0] = fmin(range[0], x), range[1] = fmax(range[1], x);
    return range[1] - range[0];
}

static iso_status make_lines(iso_context *ctx, const iso_record *r, iso_picture *picture)
{
    static const char *const names[] = {"signal", "frequency", "amplitude", "label"}, *const signals[] = {
                                                                                          "lines_turning",
                                                                                          "lines_along"};
    const char *axis = iso_record_get(r, "estimate.axis"), *warning = warning_of(r);
    labels l = {.span = span_of(r, signals), .none = *warning != '\0'};
    iso_record *lines;
    picture->layout = "frequencies";
    if (!axis) return ISO_FAIL_INPUT(ctx, "", "no picture: there is no map (h, F), and no frequency is estimated");
    ISO_TRY(iso_picture_add(ctx, picture, "lines", 4, names, &lines));
    iso_record_set_words(lines, 3, true);
    for (int s = 0; s < 2; s++) ISO_TRY(add_signal(ctx, r, signals[s], s + 1, &l, lines));
    if (iso_record_rows(lines) == 0) return ISO_FAIL_INPUT(ctx, "", "a picture of lines needs at least one line");
    ISO_TRY(iso_picture_say(ctx, picture, "axis", axis));
    ISO_TRY(iso_picture_say(ctx, picture, "warning", warning));
    return iso_picture_count(ctx, picture, "labels", l.count);
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
    char title[ISO_PICTURE_TITLE];
    iso_params p;
    iso_momentum m;
    double at[2];
    ISO_TRY(iso_record_params(ctx, r, &p));
    const bool map = has_map(r, &p, &m, at);
    ISO_TRY(map ? iso_picture_momentum(ctx, &m, at, picture) : make_lines(ctx, r, picture));
    if (iso_record_get(r, "title")) return ISO_OK;
    iso_picture_title(title, map ? "Kinds of motion, by energy h and integral F" : "Spectrum of n(t)", &p);
    return iso_picture_say(ctx, picture, "title", title);
}

const iso_picture_maker iso_picture_frequencies = {"frequencies", "Frequencies", {NULL}, .alone = true, .make = make};

/* two_point.c - the quadrature of two_point.h. The Taylor coefficients at both samples come from the recurrences of
 * the Taylor method. */
#include "method/two_point_impl.h"

#include "model/model_impl.h"

/* The macros that the series are made with. They end with this file. */
#include "model/series/double_impl.h"
#define EPSILON DBL_EPSILON
#define FINER 1
#define FINEST_ORDER 28
#define NODES 8
#define LANES 1

#include "method/taylor/form_impl.h"
#include "method/taylor/plain_impl.h"

enum { LEAST = 2, HIGHEST = 14 }; /* p; where more is needed, steps are cheaper */

/* What is known at a sample: the coefficients of the derivatives of both vectors, and of the rates of the clocks. */
typedef struct sample {
    double y[ISO_STATE];
    double value[ISO_STATE]; /* omega and n, or gamma' and gamma */
    int known;               /* coefficients 0 to known; -1: none */
    bool plain;              /* what the scene writes hides nothing in a gap of this length, as seen from here */
    double gap;
    real slope[HIGHEST + 1][ISO_STATE], rate[ISO_CLOCKS][HIGHEST + 1];
} sample;

struct iso_two_point {
    form T;
    sample at[2], *left, *right;
    double tolerance;
    double weight[HIGHEST + 1][HIGHEST + 1], change[HIGHEST + 1][HIGHEST + 1]; /* c_j at [p][j], less that at [p-1] */
    int p, easy; /* easy: how many measurements in a row would have been good with a lower p */
    iso_inside *inside;
    bool declines; /* the system is neither the ball nor the point: it is followed in steps    */
};

iso_status iso_two_point_create(iso_context *ctx, const iso_model *model, double tolerance, iso_two_point **two_point)
{
    iso_inside *inside = NULL;
    iso_two_point *b = *two_point = iso_inside_create(&model->problem, &inside) ? calloc(1, sizeof *b) : NULL;
    if (!b) return iso_inside_free(inside), iso_context_no_memory(ctx, "the quadrature between two samples");
    b->inside = inside;
    set_shape(&b->T, model, b->inside, tolerance);
    set_numbers(&b->T, 0, model);
    for (int p = 0; p <= HIGHEST; p++) { /* c_0 = 1/2, c_j/c_(j-1) = (p-j+1) j / ((2p+2-j) (j+1)) */
        b->weight[p][0] = 0.5;
        for (int j = 1; j <= p; j++)
            b->weight[p][j] = b->weight[p][j - 1] * (p - j + 1) * j / ((double)(2 * p + 2 - j) * (j + 1));
        for (int j = 0; p > 0 && j <= p; j++) b->change[p][j] = b->weight[p][j] - b->weight[p - 1][j];
    }
    b->tolerance = tolerance;
    b->declines = model->system != &iso_system_ball && model->system != &iso_system_point;
    b->p = LEAST;
    b->left = &b->at[0], b->right = &b->at[1];
    return ISO_OK;
}

void iso_two_point_free(iso_two_point *b)
{
    if (b) iso_inside_free(b->inside);
    free(b);
}

void iso_two_point_add(iso_two_point *b, const double y[ISO_STATE])
{
    sample *const older = b->left;
    b->left = b->right, b->right = older;
    memcpy(b->right->y, y, sizeof b->right->y);
    b->right->known = -1;
}

/* The coefficients at a sample, up to p, for a gap of h. */
static void compute_coefficients(iso_two_point *b, sample *s, int p, double h)
{
    form *T = &b->T;
    series *S = &T->S;
    if (s->known >= p && (!b->inside || fabs(h) <= 1.05 * s->gap)) return; /* rows are even but for rounding */
    load(T, 0, s->y);
    begin(T);
    S->order = p + 1;
    expand(S);
    s->known = p;
    s->plain = !b->inside || is_plain(T, fabs(h));
    s->gap = fabs(h);
    const vector *fast = T->is_point ? S->n + 1 : S->w;
    for (int j = 0; j <= p; j++)
        for (int i = 0; i < 3; i++) {
            s->slope[j][i] = AT(fast[j + 1], i) * (j + 1) * (T->is_point ? j + 2 : 1);
            s->slope[j][3 + i] = AT(S->n[j + 1], i) * (j + 1);
        }
    for (int i = 0; i < 3; i++) s->value[i] = AT(fast[0], i), s->value[3 + i] = AT(S->n[0], i);
    for (int j = 0; j <= p; j++) set_slope(S, 0, j); /* which motions without powers of q leave out */
    for (int c = 0; c < T->clocks; c++) {
        const iso_clock clock = T->clock_of[c];
        for (int j = 0; j <= p; j++) s->rate[clock][j] = power_of_base(S, T->power[clock], s->rate[clock], 0, j);
    }
}

/* sum_j weight_j h^(j+1) (f_j + (-1)^j g_j). Coefficients stand `stride` apart. *last: how much order p changed. */
static inline double integral(const iso_two_point *b, const double power[], const double f[], const double g[],
                              int stride, double *last)
{
    double sum = 0, change = 0;
    for (int j = b->p; j >= 0; j--) {
        const double term = power[j] * (j % 2 == 0 ? f[j * stride] + g[j * stride] : f[j * stride] - g[j * stride]);
        sum += b->weight[b->p][j] * term;
        change += b->change[b->p][j] * term;
    }
    *last = fabs(change);
    return sum;
}

/* The gap by the coefficients up to b->p. *left: the error that is still left, divided by the error allowed. */
static void measure(iso_two_point *b, double h, double noise, iso_gap *gap, double *left)
{
    const sample *f = b->left, *g = b->right;
    const double of_state = 1e-12 + noise, of_clock = larger(b->tolerance, 4 * DBL_EPSILON) + noise;
    double power[HIGHEST + 1] = {h}, last;
    *gap = (iso_gap){.defect = 0};
    *left = 0;
    for (int j = 1; j <= b->p; j++) power[j] = power[j - 1] * h;
    for (int c = 0; c < b->T.clocks; c++) {
        const iso_clock clock = b->T.clock_of[c];
        gap->gained[clock] = integral(b, power, f->rate[clock], g->rate[clock], 1, &last) * b->T.rate[clock];
        gap->error[clock] = last * fabs(b->T.rate[clock]);
        *left = larger(*left, gap->error[clock] / (of_clock * fabs(gap->gained[clock]) + DBL_MIN));
        if (gap->gained[clock] != gap->gained[clock]) *left = INFINITY;
    }
    for (int v = 0; v < ISO_STATE; v += 3) {
        const double size = larger(length3(f->value + v), length3(g->value + v));
        for (int i = v; i < v + 3; i++) {
            const double way = integral(b, power, f->slope[0] + i, g->slope[0] + i, ISO_STATE, &last);
            gap->motion[i] = size > 0 ? (g->value[i] - f->value[i] - way) / size : 0;
            if (size > 0) *left = larger(*left, last / (of_state * size));
        }
        gap->defect = larger(gap->defect, length3(gap->motion + v));
    }
    if (!(gap->defect < 1e100)) *left = INFINITY;
}

bool iso_two_point_measure(iso_two_point *b, double h, double noise, iso_gap *gap)
{
    enum { EASY = 32 };
    double left;
    if (b->declines) return false;
    for (;; b->p++, b->easy = 0) {
        compute_coefficients(b, b->left, b->p, h);
        compute_coefficients(b, b->right, b->p, h);
        if (!b->left->plain || !b->right->plain) return false;
        measure(b, h, noise, gap, &left);
        if (left <= 1) break;
        if (b->p == HIGHEST || !(left < 1e100)) return false;
    }
    b->easy = left < 1e-4 ? b->easy + 1 : 0;
    if (b->easy < EASY || b->p == LEAST) return true;
    b->p--;
    b->easy = 0;
    return true;
}

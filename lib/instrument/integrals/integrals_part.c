/* integrals_part.c - one parity of the space V_d: which of its functions are constant along the sampled orbits. */
#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>

#include "base/math_impl.h"
#include "base/vec3_impl.h"
#include "instrument/integrals/integrals_impl.h"
#include "model/effects/effects_impl.h"

/* A function that is smaller than this part of its terms is zero on the surface: what is left of it is rounding. */
static const double least = 1e-13;

/* --- terms ------------------------------------------------------------------------------------------------------ */

integral_space iso_integral_space_of(const iso_problem *f, int coefficients)
{
    integral_space space = {.coefficients = coefficients};
    for (int i = 0; i < 3; i++) {
        double sign[3] = {1, 1, 1};
        sign[i] = -1;
        space.mirror[i] = iso_effects_reversible(f, sign);
        space.magnetic = space.magnetic || !space.mirror[i];
    }
    return space;
}

/* |gamma| = 1 makes gamma3^2 the sum of other terms, (M, gamma) = 0 makes M3 gamma3 one. */
static bool is_wanted(const integral_space *space, const integral_term *t, unsigned wanted)
{
    const unsigned char *e = t->exponent;
    unsigned parity = 0;
    bool all = false;
    for (unsigned i = 0; i < 3; i++) {
        const unsigned one = (unsigned)e[i] + e[3 + i], of_gamma = (unsigned)e[3] + e[4] + e[5];
        if (space->mirror[i] || !all) parity |= (space->mirror[i] ? one : of_gamma) % 2 << i;
        all = all || !space->mirror[i];
    }
    return e[5] <= 1 && !(e[2] > 0 && e[5] > 0) && parity == wanted;
}

/* The next exponents of three numbers with a sum of `most` or less. False: these were the last. */
static bool next_exponents(unsigned char e[3], int most)
{
    for (int i = 0; i < 3; i++) {
        if (e[0] + e[1] + e[2] < most) return e[i]++, true;
        e[i] = 0;
    }
    return false;
}

size_t iso_integral_terms(const integral_space *space, int degree, unsigned parity, integral_term term[])
{
    integral_term t = {{0}};
    size_t count = 0;
    do {
        const int left = degree - t.exponent[0] - t.exponent[1] - t.exponent[2];
        if (!space->magnetic && left % 2 != 0) continue;
        for (int v = 0; v <= (space->magnetic && left > 0); v++) {
            t.exponent[INTEGRAL_V] = (unsigned char)v;
            do {
                if (!is_wanted(space, &t, parity)) continue;
                if (term) term[count] = t;
                count++;
            } while (next_exponents(t.exponent + 3, space->coefficients));
        }
    } while (next_exponents(t.exponent, degree));
    return count;
}

/* --- values ----------------------------------------------------------------------------------------------------- */

/* q^(-1/(2k)) */
double iso_integral_v(const iso_problem *f, const double state[ISO_STATE])
{
    return pow(dot_diag(state + 3, f->p.J, state + 3), -1 / (2 * f->p.k));
}

static void take_powers(const double state[INTEGRAL_NUMBERS], double power[INTEGRAL_NUMBERS][INTEGRAL_POWERS])
{
    for (int i = 0; i < INTEGRAL_NUMBERS; i++) {
        power[i][0] = 1;
        for (int p = 1; p < INTEGRAL_POWERS; p++) power[i][p] = power[i][p - 1] * state[i];
    }
}

static double value_of(const integral_term *t, double power[INTEGRAL_NUMBERS][INTEGRAL_POWERS])
{
    double product = 1;
    for (int i = 0; i < INTEGRAL_NUMBERS; i++) product *= power[i][t->exponent[i]];
    return product;
}

double iso_integral_slope(const integral_function *f, const iso_problem *problem, const double state[ISO_STATE],
                          const double deviation[ISO_STATE])
{
    const double *J = problem->p.J, *gamma = state + 3;
    double y[INTEGRAL_NUMBERS], dy[INTEGRAL_NUMBERS], power[INTEGRAL_NUMBERS][INTEGRAL_POWERS], sum = 0;
    copy(state, y, ISO_STATE);
    copy(deviation, dy, ISO_STATE);
    y[INTEGRAL_V] = iso_integral_v(problem, state);
    dy[INTEGRAL_V] = -y[INTEGRAL_V] / problem->p.k * dot_diag(gamma, J, dy + 3) / dot_diag(gamma, J, gamma);
    take_powers(y, power);
    for (size_t i = 0; i < f->terms; i++)
        for (int j = 0; j < INTEGRAL_NUMBERS; j++) {
            integral_term t = f->term[i];
            const int exponent = t.exponent[j];
            if (exponent == 0) continue;
            t.exponent[j]--;
            sum += f->coefficient[i] * exponent * value_of(&t, power) * dy[j];
        }
    return sum;
}

/* --- linear algebra --------------------------------------------------------------------------------------------- */

/* The room of one part. Column order[i] of A is the sum of Q's columns 0 to i with the factors R[order[i]]. What Q has
 * not of another column is taken for rounding, but can also be a function that is small on the surface. */
typedef struct algebra {
    const integral_samples *samples;
    size_t terms, functions; /* columns of A; those that are independent: of Q                          */
    double dropped;          /* the largest part of another column that Q has not                        */
    integral_term *term;
    double *length; /* of the columns of A, before they were made unit vectors                 */
    double *column; /* what is left of those of A without their parts along Q; the first become Q */
    double *R;      /* terms x terms                                                           */
    size_t *order;
    gsl_matrix *varying, *V, *square, *triangle;
    gsl_vector *work, *S;
} algebra;

static double *column_of(const algebra *a, size_t i)
{
    return a->column + a->order[i] * a->samples->rows;
}

static void end(algebra *a)
{
    free(a->term);
    free(a->length);
    free(a->column);
    free(a->R);
    free(a->order);
    gsl_matrix_free(a->varying);
    gsl_matrix_free(a->V);
    gsl_matrix_free(a->square);
    gsl_matrix_free(a->triangle);
    gsl_vector_free(a->work);
    gsl_vector_free(a->S);
}

/* Four sums side by side: the processor adds them at the same time. */
static double product(const double x[], const double y[], size_t count)
{
    double sum[4] = {0};
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (size_t j = 0; j < 4; j++) sum[j] += x[i + j] * y[i + j];
    for (; i < count; i++) sum[0] += x[i] * y[i];
    return sum[0] + sum[1] + (sum[2] + sum[3]);
}

/* Unit columns: the values of each term on the samples. False: a number does not fit. */
static bool fill(algebra *a)
{
    const size_t rows = a->samples->rows;
    for (size_t row = 0; row < rows; row++) {
        double power[INTEGRAL_NUMBERS][INTEGRAL_POWERS];
        take_powers(a->samples->state[row], power);
        for (size_t j = 0; j < a->terms; j++) a->column[j * rows + row] = value_of(&a->term[j], power);
    }
    for (size_t j = 0; j < a->terms; j++) {
        double *x = a->column + j * rows;
        a->order[j] = j;
        a->length[j] = sqrt(product(x, x, rows));
        for (size_t i = 0; i < rows && a->length[j] > 0; i++) x[i] /= a->length[j];
    }
    return all_finite(a->length, (int)a->terms);
}

/* Takes the part along Q's column i away from column `order[j]`. */
static void project(algebra *a, size_t i, size_t j)
{
    const size_t rows = a->samples->rows;
    const double *q = column_of(a, i);
    double *x = column_of(a, j);
    const double along = product(q, x, rows);
    for (size_t row = 0; row < rows; row++) x[row] -= along * q[row];
    a->R[a->order[j] * a->terms + i] += along;
}

/* The column of which most is left becomes the next of Q. It is freed once more from those before, because rounding
 * errors grow as it becomes small. False: nothing is left. */
static bool take_next(algebra *a, double left[])
{
    const size_t n = a->functions, rows = a->samples->rows;
    size_t best = n;
    for (size_t j = n; j < a->terms; j++)
        if (left[a->order[j]] > left[a->order[best]]) best = j;
    const size_t chosen = a->order[best];
    a->order[best] = a->order[n];
    a->order[n] = chosen;
    for (size_t i = 0; i < n; i++) project(a, i, n);
    double *q = column_of(a, n);
    const double size = sqrt(product(q, q, rows));
    left[chosen] = size;
    if (!(size > least)) return false;
    for (size_t row = 0; row < rows; row++) q[row] /= size;
    a->R[chosen * a->terms + n] = size;
    return true;
}

/* The method of Gram and Schmidt, with the largest column first: how many are independent, Q and R. */
static bool make_basis(algebra *a)
{
    const size_t rows = a->samples->rows;
    double *left = malloc(a->terms * sizeof *left);
    if (!left) return false;
    for (size_t j = 0; j < a->terms; j++) left[j] = a->length[j] > 0;
    while (a->functions < a->terms && take_next(a, left)) {
        const size_t n = a->functions++;
        for (size_t j = n + 1; j < a->terms; j++) {
            if (!(left[a->order[j]] > least)) continue;
            project(a, n, j);
            left[a->order[j]] = sqrt(product(column_of(a, j), column_of(a, j), rows));
        }
    }
    for (size_t j = a->functions; j < a->terms; j++) a->dropped = fmax(a->dropped, left[a->order[j]]);
    free(left);
    return true;
}

/* --- what is kept ----------------------------------------------------------------------------------------------- */

/* The singular values, which GSL lets fall, and the functions found: Q v, v the column of V. Its coefficients c in unit
 * columns follow from R c = v; an error has the size of sum |c|. False: no memory. */
static bool keep(algebra *a, unsigned parity, double delta, double within, integral_part *part)
{
    const size_t n = a->functions, rows = a->samples->rows;
    gsl_vector *c = a->work;
    part->functions = n;
    part->value = calloc(n, sizeof *part->value);
    part->function = calloc(n, sizeof *part->function);
    if (!part->value || !part->function) return false;
    for (size_t i = 0; i < n; i++) {
        const size_t column = n - 1 - i;
        iso_integral_value *v = &part->value[i];
        *v = (iso_integral_value){.value = gsl_vector_get(a->S, column), .parity = parity};
        gsl_matrix_get_col(c, a->V, column);
        gsl_blas_dtrsv(CblasUpper, CblasNoTrans, CblasNonUnit, a->triangle, c);
        v->error = (delta + a->dropped) * gsl_blas_dasum(c);
        if (!integral_is_found(v, within)) continue;
        integral_function *f = &part->function[part->found];
        double *basis = realloc(part->basis, (part->found + 1) * rows * sizeof *basis);
        if (basis) part->basis = basis;
        part->found++;
        f->terms = n;
        f->term = malloc(n * sizeof *f->term);
        f->coefficient = malloc(n * sizeof *f->coefficient);
        if (!basis || !f->term || !f->coefficient) return false;
        basis += (part->found - 1) * rows;
        for (size_t row = 0; row < rows; row++) basis[row] = 0;
        for (size_t j = 0; j < n; j++) {
            const double part_of_j = gsl_matrix_get(a->V, j, column);
            for (size_t row = 0; row < rows; row++) basis[row] += part_of_j * column_of(a, j)[row];
            f->term[j] = a->term[a->order[j]];
            f->coefficient[j] = gsl_vector_get(c, j) / a->length[a->order[j]] * sqrt((double)rows);
        }
    }
    return true;
}

/* Q, and the singular values of Q without the mean of each orbit. */
static iso_status solve(iso_context *ctx, algebra *a)
{
    const size_t each = ISO_INTEGRAL_ROWS;
    if (!fill(a)) return ISO_FAIL_NUMERICAL(ctx, "powers of M do not fit a double for this k and J");
    const bool made = make_basis(a);
    const size_t n = a->functions;
    if (!made) return iso_context_no_memory(ctx, "%zu functions", n);
    if (n == 0) return ISO_OK;
    a->varying = gsl_matrix_alloc(a->samples->rows, n);
    a->V = gsl_matrix_alloc(n, n);
    a->square = gsl_matrix_alloc(n, n);
    a->triangle = gsl_matrix_calloc(n, n);
    a->work = gsl_vector_alloc(n);
    a->S = gsl_vector_alloc(n);
    if (!a->varying || !a->V || !a->square || !a->triangle || !a->work || !a->S)
        return iso_context_no_memory(ctx, "%zu functions", n);
    for (size_t j = 0; j < n; j++) {
        for (size_t orbit = 0; orbit < a->samples->orbits; orbit++) {
            const double *q = column_of(a, j) + orbit * each;
            double mean = 0;
            for (size_t i = 0; i < each; i++) mean += q[i] / (double)each;
            for (size_t i = 0; i < each; i++) gsl_matrix_set(a->varying, orbit * each + i, j, q[i] - mean);
        }
        for (size_t i = 0; i <= j; i++) gsl_matrix_set(a->triangle, i, j, a->R[a->order[j] * a->terms + i]);
    }
    gsl_linalg_SV_decomp_mod(a->varying, a->square, a->V, a->S, a->work);
    return ISO_OK;
}

iso_status iso_integral_search_part(iso_context *ctx, const integral_samples *samples, const integral_space *space,
                                    int degree, unsigned parity, double delta, double within, integral_part *part)
{
    const size_t terms = iso_integral_terms(space, degree, parity, NULL);
    *part = (integral_part){.terms = terms};
    if (terms == 0) return ISO_OK;
    algebra a = {.samples = samples,
                 .terms = terms,
                 .term = malloc(terms * sizeof *a.term),
                 .length = calloc(terms, sizeof *a.length),
                 .column = malloc(terms * samples->rows * sizeof *a.column),
                 .R = calloc(terms * terms, sizeof *a.R),
                 .order = malloc(terms * sizeof *a.order)};
    iso_status status = ISO_OK;
    if (a.term && a.length && a.column && a.R && a.order)
        iso_integral_terms(space, degree, parity, a.term);
    else
        status = iso_context_no_memory(ctx, "%zu terms", terms);
    if (status == ISO_OK) status = solve(ctx, &a);
    if (status == ISO_OK && a.functions > 0 && !keep(&a, parity, delta, within, part))
        status = iso_context_no_memory(ctx, "%zu functions", a.functions);
    end(&a);
    return status;
}

void iso_integral_free_part(integral_part *part)
{
    for (size_t i = 0; i < part->found; i++) {
        free(part->function[i].term);
        free(part->function[i].coefficient);
    }
    free(part->value);
    free(part->function);
    free(part->basis);
}

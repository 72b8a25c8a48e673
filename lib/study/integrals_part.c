/* integrals_part.c - one parity of the space V_d: which of its functions are constant along the sampled orbits. */
#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>

#include "base/finite_impl.h"
#include "study/integrals_impl.h"

/* A function that is smaller than this part of its terms is zero on the surface: what is left of it is rounding. */
static const double least = 1e-13;

/* --- terms ------------------------------------------------------------------------------------------------------ */

/* |gamma| = 1 makes gamma3^2 the sum of other terms, (M, gamma) = 0 makes M3 gamma3 one. */
static bool is_wanted(const integral_term *t, unsigned parity)
{
    const unsigned char *e = t->exponent;
    if (e[5] > 1 || (e[2] > 0 && e[5] > 0)) return false;
    for (unsigned i = 0; i < 3; i++)
        if (((unsigned)e[i] + e[3 + i]) % 2 != (parity >> i & 1)) return false;
    return true;
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

size_t iso_integral_terms(int degree, int coefficients, unsigned parity, integral_term term[])
{
    integral_term t = {{0}};
    size_t count = 0;
    do {
        const int of_M = t.exponent[0] + t.exponent[1] + t.exponent[2];
        if ((degree - of_M) % 2 != 0) continue;
        do {
            if (!is_wanted(&t, parity)) continue;
            if (term) term[count] = t;
            count++;
        } while (next_exponents(t.exponent + 3, coefficients));
    } while (next_exponents(t.exponent, degree));
    return count;
}

/* --- values ----------------------------------------------------------------------------------------------------- */

static void take_powers(const double state[ISO_STATE], double power[ISO_STATE][INTEGRAL_POWERS])
{
    for (int i = 0; i < ISO_STATE; i++) {
        power[i][0] = 1;
        for (int p = 1; p < INTEGRAL_POWERS; p++) power[i][p] = power[i][p - 1] * state[i];
    }
}

static double value_of(const integral_term *t, double power[ISO_STATE][INTEGRAL_POWERS])
{
    double product = 1;
    for (int i = 0; i < ISO_STATE; i++) product *= power[i][t->exponent[i]];
    return product;
}

double iso_integral_slope(const integral_function *f, const double state[ISO_STATE],
                          const double deviation[ISO_STATE])
{
    double power[ISO_STATE][INTEGRAL_POWERS], sum = 0;
    take_powers(state, power);
    for (size_t i = 0; i < f->terms; i++)
        for (int j = 0; j < ISO_STATE; j++) {
            integral_term t = f->term[i];
            const int exponent = t.exponent[j];
            if (exponent == 0) continue;
            t.exponent[j]--;
            sum += f->coefficient[i] * exponent * value_of(&t, power) * deviation[j];
        }
    return sum;
}

/* --- linear algebra --------------------------------------------------------------------------------------------- */

/* The room of one part: A P = Q R. */
typedef struct algebra {
    const integral_samples *samples;
    size_t terms, functions; /* columns of A; those that are independent */
    integral_term *term;
    double *length; /* of the columns, before they were made unit vectors */
    gsl_matrix *A, *Q, *varying, *V, *square;
    gsl_vector *tau, *work, *S;
    gsl_permutation *P;
} algebra;

static bool begin(algebra *a, const integral_samples *samples, size_t terms)
{
    a->samples = samples;
    a->terms = terms;
    a->term = malloc(terms * sizeof *a->term);
    a->length = calloc(terms, sizeof *a->length);
    a->A = gsl_matrix_alloc(samples->rows, terms);
    a->tau = gsl_vector_alloc(terms);
    a->work = gsl_vector_alloc(terms);
    a->P = gsl_permutation_alloc(terms);
    return a->term && a->length && a->A && a->tau && a->work && a->P;
}

static bool begin_basis(algebra *a)
{
    const size_t n = a->functions;
    a->Q = gsl_matrix_alloc(a->samples->rows, n);
    a->varying = gsl_matrix_alloc(a->samples->rows, n);
    a->V = gsl_matrix_alloc(n, n);
    a->square = gsl_matrix_alloc(n, n);
    a->S = gsl_vector_alloc(n);
    return a->Q && a->varying && a->V && a->square && a->S;
}

static void end(algebra *a)
{
    free(a->term);
    free(a->length);
    gsl_matrix_free(a->A);
    gsl_matrix_free(a->Q);
    gsl_matrix_free(a->varying);
    gsl_matrix_free(a->V);
    gsl_matrix_free(a->square);
    gsl_vector_free(a->tau);
    gsl_vector_free(a->work);
    gsl_vector_free(a->S);
    gsl_permutation_free(a->P);
}

/* A: a row for each sample, a unit column for each term. False: a number does not fit. */
static bool fill(algebra *a)
{
    for (size_t row = 0; row < a->samples->rows; row++) {
        double power[ISO_STATE][INTEGRAL_POWERS];
        take_powers(a->samples->state[row], power);
        for (size_t j = 0; j < a->terms; j++) gsl_matrix_set(a->A, row, j, value_of(&a->term[j], power));
    }
    for (size_t j = 0; j < a->terms; j++) {
        gsl_vector_view column = gsl_matrix_column(a->A, j);
        a->length[j] = gsl_blas_dnrm2(&column.vector);
        if (a->length[j] > 0) gsl_vector_scale(&column.vector, 1 / a->length[j]);
    }
    return all_finite(a->length, (int)a->terms);
}

/* How many columns are independent, and Q of these. */
static iso_status make_basis(iso_context *ctx, algebra *a)
{
    int sign;
    gsl_linalg_QRPT_decomp(a->A, a->tau, a->P, &sign, a->work);
    const double first = fabs(gsl_matrix_get(a->A, 0, 0));
    while (a->functions < a->terms && fabs(gsl_matrix_get(a->A, a->functions, a->functions)) > least * first)
        a->functions++;
    if (a->functions == 0) return ISO_OK;
    if (!begin_basis(a)) return iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for %zu functions", a->functions);
    for (size_t j = 0; j < a->functions; j++) {
        gsl_vector_view reflectors = gsl_vector_subvector(a->tau, 0, a->functions);
        gsl_matrix_view columns = gsl_matrix_submatrix(a->A, 0, 0, a->samples->rows, a->functions);
        gsl_vector_view q = gsl_matrix_column(a->Q, j);
        gsl_vector_set_basis(&q.vector, j);
        gsl_linalg_QR_Qvec(&columns.matrix, &reflectors.vector, &q.vector);
    }
    return ISO_OK;
}

/* Q without the mean of each orbit. A mean does not change with the length of the orbit's rows. */
static void take_means_away(algebra *a)
{
    const size_t each = ISO_INTEGRAL_ROWS;
    gsl_matrix_memcpy(a->varying, a->Q);
    for (size_t orbit = 0; orbit < a->samples->orbits; orbit++)
        for (size_t j = 0; j < a->functions; j++) {
            double mean = 0;
            for (size_t i = 0; i < each; i++) mean += gsl_matrix_get(a->Q, orbit * each + i, j) / (double)each;
            for (size_t i = 0; i < each; i++) *gsl_matrix_ptr(a->varying, orbit * each + i, j) -= mean;
        }
}

/* The coefficients of Q v in unit columns: R c = v. Gives the sum of |c|. */
static double coefficients_of(const algebra *a, size_t column, gsl_vector *c)
{
    gsl_matrix_const_view R = gsl_matrix_const_submatrix(a->A, 0, 0, a->functions, a->functions);
    gsl_matrix_get_col(c, a->V, column);
    gsl_blas_dtrsv(CblasUpper, CblasNoTrans, CblasNonUnit, &R.matrix, c);
    return gsl_blas_dasum(c);
}

/* --- what is kept ----------------------------------------------------------------------------------------------- */

static bool keep_function(const algebra *a, const gsl_vector *c, integral_function *f)
{
    f->term = malloc(a->functions * sizeof *f->term);
    f->coefficient = malloc(a->functions * sizeof *f->coefficient);
    if (!f->term || !f->coefficient) return false;
    f->terms = a->functions;
    for (size_t i = 0; i < a->functions; i++) {
        const size_t j = gsl_permutation_get(a->P, i);
        f->term[i] = a->term[j];
        f->coefficient[i] = gsl_vector_get(c, i) / a->length[j] * sqrt((double)a->samples->rows);
    }
    return true;
}

static void keep_basis(const algebra *a, size_t column, double *basis)
{
    gsl_vector_view to = gsl_vector_view_array(basis, a->samples->rows);
    gsl_vector_const_view v = gsl_matrix_const_column(a->V, column);
    gsl_blas_dgemv(CblasNoTrans, 1, a->Q, &v.vector, 0, &to.vector);
}

/* GSL's singular values fall. */
static bool keep(const algebra *a, unsigned parity, double delta, double within, integral_part *part)
{
    const size_t n = a->functions, rows = a->samples->rows;
    gsl_vector_view c = gsl_vector_subvector(a->work, 0, n);
    part->functions = n;
    part->value = calloc(n, sizeof *part->value);
    part->function = calloc(n, sizeof *part->function);
    if (!part->value || !part->function) return false;
    for (size_t i = 0; i < n; i++) {
        const size_t column = n - 1 - i;
        iso_integral_value *v = &part->value[i];
        *v = (iso_integral_value){.value = gsl_vector_get(a->S, column), .parity = parity};
        v->error = delta * coefficients_of(a, column, &c.vector);
        if (!integral_is_found(v, within)) continue;
        double *basis = realloc(part->basis, (part->found + 1) * rows * sizeof *basis);
        if (!basis) return false;
        part->basis = basis;
        keep_basis(a, column, basis + part->found * rows);
        if (!keep_function(a, &c.vector, &part->function[part->found++])) return false;
    }
    return true;
}

static iso_status solve(iso_context *ctx, algebra *a, int degree, int coefficients, unsigned parity)
{
    iso_integral_terms(degree, coefficients, parity, a->term);
    if (!fill(a)) return iso_context_fail(ctx, ISO_NUMERICAL, "", "powers of M do not fit a double for this k and J");
    const iso_status status = make_basis(ctx, a);
    if (status != ISO_OK || a->functions == 0) return status;
    take_means_away(a);
    gsl_vector_view work = gsl_vector_subvector(a->work, 0, a->functions);
    gsl_linalg_SV_decomp_mod(a->varying, a->square, a->V, a->S, &work.vector);
    return ISO_OK;
}

iso_status iso_integral_search_part(iso_context *ctx, const integral_samples *samples, int degree, int coefficients,
                                    unsigned parity, double delta, double within, integral_part *part)
{
    algebra a = {0};
    *part = (integral_part){.terms = iso_integral_terms(degree, coefficients, parity, NULL)};
    if (part->terms == 0) return ISO_OK;
    iso_status status = ISO_OK;
    if (!begin(&a, samples, part->terms))
        status = iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for %zu terms", part->terms);
    if (status == ISO_OK) status = solve(ctx, &a, degree, coefficients, parity);
    if (status == ISO_OK && a.functions > 0 && !keep(&a, parity, delta, within, part))
        status = iso_context_fail(ctx, ISO_NO_MEMORY, "", "no memory for %zu functions", a.functions);
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

/* Whole records from one model to the other and back (iso_convert): states, clocks, lines, and what is refused. */
#include "length.h"
#include "orbit/orbit_impl.h"
#include "reference.h"
#include "task/convert/convert_impl.h"

static const double J_three[3] = {1.4, 2.1, 3.0};

static iso_context *ctx;

/* --- records --------------------------------------------------------------------------------------------------- */

/* The orbit of a ball at the times t, the first of which is its start, as a record in one model. */
static iso_record *record_of(const iso_params *p, const iso_start *start, iso_model_kind model, bool with_t,
                             bool with_s, const double times[], int count)
{
    const char *names[8];
    int columns[8], width = 0;
    iso_orbit_options o = iso_orbit_defaults(start);
    iso_orbit *orbit;
    iso_record *record;
    if (with_t) columns[width++] = 0;
    if (with_s) columns[width++] = 2;
    for (int i = 0; i < ISO_STATE; i++) columns[width++] = (model == ISO_BALL ? 3 : 9) + i;
    for (int i = 0; i < width; i++) names[i] = iso_column_name(columns[i]);
    o.tolerance = 1e-14;
    o.shown = ISO_SHOW_BOTH;
    o.with_clock[ISO_CLOCK_S] = true;
    laws_stop_if(ctx, iso_orbit_create(ctx, p, start, &o, &orbit), "an orbit");
    laws_stop_if(ctx, iso_record_create(ctx, (size_t)width, names, &record), "a record");
    for (int i = 0; i < count; i++) {
        iso_sample s;
        double *row;
        laws_stop_if(ctx, iso_orbit_at(orbit, times[i] - times[0], &s), "an orbit's sample");
        laws_stop_if(ctx, iso_record_append(ctx, record, &row), "a row");
        s.clock[ISO_CLOCK_T] = times[i];
        for (int c = 0; c < width; c++) row[c] = iso_sample_column(&s, columns[c]);
    }
    laws_stop_if(ctx, iso_record_describe(ctx, record, iso_model_kind_name((int)model), p, orbit), "the lines");
    iso_orbit_free(orbit);
    return record;
}

static iso_record *convert(const iso_record *in, iso_model_kind to)
{
    iso_record *out;
    laws_stop_if(ctx, iso_convert(ctx, in, to, 1e-14, &out), "a conversion");
    return out;
}

/* Largest difference of a column over the rows, relative to its largest number. */
static double column_difference(const iso_record *a, const iso_record *b, const char *name)
{
    const int i = iso_record_find(a, name), j = iso_record_find(b, name);
    double worst = 0, largest = 0;
    if (i < 0 || j < 0 || iso_record_rows(a) != iso_record_rows(b)) return NAN;
    for (size_t row = 0; row < iso_record_rows(a); row++) {
        const double x = iso_record_const_row(a, row)[i], y = iso_record_const_row(b, row)[j];
        if (isnan(x) || isnan(y)) return NAN;
        worst = fmax(worst, fabs(x - y));
        largest = fmax(largest, fabs(y));
    }
    return worst == 0 ? 0 : worst / largest;
}

/* Largest difference of the states, in units in the last place of each vector's norm. */
static double state_ulps(const iso_record *a, const iso_record *b, const char *const names[ISO_STATE])
{
    double worst = 0;
    for (size_t row = 0; row < iso_record_rows(b); row++)
        for (int v = 0; v < 2; v++) {
            double x[3], y[3];
            for (int i = 0; i < 3; i++) {
                x[i] = iso_record_const_row(a, row)[iso_record_find(a, names[3 * v + i])];
                y[i] = iso_record_const_row(b, row)[iso_record_find(b, names[3 * v + i])];
            }
            const double ulp = ldexp(DBL_EPSILON, ilogb(laws_norm(y)));
            for (int i = 0; i < 3; i++) {
                const double error = fabs(x[i] - y[i]) / ulp;
                if (!(error <= worst)) worst = error;
                if (isnan(error)) return error;
            }
        }
    return worst;
}

/* --- there and back -------------------------------------------------------------------------------------------- */

static laws_worst s_clock, t_clock, states;

/* The times a record may have: from 0, from elsewhere, backwards, uneven, with repetitions, a single one. */
enum { KINDS = 6, MOST = 12 };
static const struct {
    const char *name;
    int count;
    double t[MOST];
} kinds[KINDS] = {
    {"from 0", 5, {0, 1, 2, 3, 4}},
    {"from 5", 4, {5, 5.5, 7, 9}},
    {"backwards", 4, {3, 2.5, 0, -4}},
    {"repeated", 7, {0, 0, 1, 1, 1, 2, 2}},
    {"uneven", 6, {-2, -1.999999, -1, 3, 3.000001, 8}},
    {"single", 1, {5}},
};

static void check_trip(const iso_params *p, const iso_start *start, int kind)
{
    const double *t = kinds[kind].t, half = fmax(1, 1 / fabs(2 * p->k));
    const int count = kinds[kind].count;
    iso_record *ball = record_of(p, start, ISO_BALL, true, false, t, count);
    iso_record *truth = record_of(p, start, ISO_POINT, false, true, t, count);
    iso_record *point = convert(ball, ISO_POINT), *back = convert(point, ISO_BALL), *again = convert(back, ISO_POINT);
    const double there = column_difference(point, truth, "s");
    laws_note(&s_clock, there, 1e-12 * half, p, kinds[kind].name);
    laws_note(&s_clock, column_difference(again, point, "s"), 1e-12 * half, p, kinds[kind].name);
    laws_note(&t_clock, column_difference(back, ball, "t"), 1e-12 * half, p, kinds[kind].name);
    laws_note(&states, state_ulps(point, truth, iso_system_point.state), 8 * half, p, "to the point");
    laws_note(&states, state_ulps(back, ball, iso_system_ball.state), 4 * half, p, "and back");
    laws_note(&states, iso_record_columns(again) == iso_record_columns(point) ? 0 : 1, 0.5, p, "columns");
    iso_record_free(ball);
    iso_record_free(truth);
    iso_record_free(point);
    iso_record_free(back);
    iso_record_free(again);
}

static void check_trips(void)
{
    static const double ks[] = {1, -1, 0.5, 0.05, -0.3, 4, 50, 0.02, -0.02, 0.005};
    iso_random *random = iso_random_create(9);
    for (size_t i = 0; i < sizeof ks / sizeof *ks; i++) {
        const iso_params p = laws_params(ks[i], J_three);
        iso_problem f = {.p = p};
        iso_start start = {.model = ISO_BALL};
        laws_sample(&iso_system_ball, &f, random, start.y);
        for (int kind = 0; kind < KINDS; kind++) check_trip(&p, &start, kind);
    }
    iso_random_free(random);
    laws_report(&s_clock, "s of a ball's record");
    laws_report(&t_clock, "t comes back, with its origin");
    laws_report(&states, "states of a record, ulp");
}

/* Rounding of n -> gamma changes the factor of omega: taken from n one way and gamma back, omega drifts by it each
 * time. Each trip rounds (18) and its inverse once; what is rounded is nearly the same each time and settles. */
static void check_many_trips(void)
{
    static const double ks[] = {1, -1, 0.4}, t[] = {0, 0.5, 1};
    const iso_start start = {.model = ISO_BALL, .y = {0.9, -0.3, -0.225, 0.36, 0.48, 0.8}};
    for (int i = 0; i < 3; i++) {
        const iso_params p = laws_params(ks[i], J_three);
        iso_record *first = record_of(&p, &start, ISO_BALL, false, false, t, 3), *ball = convert(first, ISO_POINT);
        const int trips = tests_length(100, 1000);
        for (int n = 1; n < 2 * trips; n++) {
            iso_record *next = convert(ball, n % 2 ? ISO_BALL : ISO_POINT);
            iso_record_free(ball);
            ball = next;
        }
        const double ulps = state_ulps(ball, first, iso_system_ball.state);
        gsl_test(!(ulps <= 8), "k = %g: %.2g units in the last place after %d trips", ks[i], ulps, trips);
        iso_record_free(first);
        iso_record_free(ball);
    }
}

/* t is 1e26 times s: a sum of steps that starts at 0. */
static void check_far_clocks(void)
{
    static const double J[3] = {1.4e10, 2.1e10, 3e10}, t[] = {0, 1e20, 2e20, 5e20, 1e21};
    const iso_start start = {.model = ISO_BALL, .y = {0.9e-20, -0.3e-20, -0.225e-20, 0.36, 0.48, 0.8}};
    const iso_params p = laws_params(-1, J);
    iso_record *ball = record_of(&p, &start, ISO_BALL, true, false, t, 5), *point = convert(ball, ISO_POINT),
               *back = convert(point, ISO_BALL);
    const double s = iso_record_const_row(point, 4)[0], apart = column_difference(back, ball, "t");
    gsl_test(!(s < 1e-4 && apart <= 1e-11), "s = %.1e at t = 1e21; t comes back to %.2g", s, apart);
    iso_record_free(ball);
    iso_record_free(point);
    iso_record_free(back);
}

static void check_reference(void)
{
    static const int counts[] = {3, 10, 100};
    reference rows[REFERENCE_ROWS];
    laws_worst worst = {0}, told = {0};
    const int all = reference_read(ctx, rows);
    for (int r = 0; r < all; r++) {
        double times[100];
        const int count = counts[r % 3];
        if (rows[r].t > 100) continue;
        for (int i = 0; i < count; i++) times[i] = rows[r].t * i / (count - 1);
        iso_record *ball = record_of(&rows[r].p, &rows[r].start, ISO_BALL, true, false, times, count),
                   *point = convert(ball, ISO_POINT);
        const double s = iso_record_const_row(point, (size_t)count - 1)[0];
        const char *error = iso_record_get(point, "s.error");
        laws_note(&worst, fabs(s / rows[r].s - 1), 1e-12, &rows[r].p, "");
        laws_note(&told, fabs(s - rows[r].s), error ? strtod(error, NULL) : 0, &rows[r].p, "");
        iso_record_free(ball);
        iso_record_free(point);
    }
    gsl_test_int((int)worst.cases, 26, "rows of free_ball.csv with t <= 100");
    laws_report(&worst, "s of records of 3 to 100 rows");
    laws_report(&told, "its error is covered by the line s.error");
}

/* --- columns and lines ----------------------------------------------------------------------------------------- */

static void check_lines(void)
{
    static const double t[4] = {5, 6, 6.5, 9};
    const iso_params p = laws_params(-0.3, J_three);
    const iso_start start = {.model = ISO_BALL, .y = {0.8, 0.5, -0.6, 0.6, 0, 0.8}};
    iso_record *both = record_of(&p, &start, ISO_BALL, true, true, t, 4);
    laws_stop_if(ctx, iso_record_set(ctx, both, "note", "a ball of mine"), "a line");
    iso_record *point = convert(both, ISO_POINT), *back;
    iso_params read;
    gsl_test(column_difference(point, both, "s") != 0, "a clock that is there is taken as it is");
    gsl_test(iso_record_find(point, "t") >= 0 || iso_record_columns(point) != 7,
             "a point's record has s and its state");
    gsl_test_str(iso_record_get(point, "model"), "point", "the model of the result");
    gsl_test_str(iso_record_get(point, "note"), "a ball of mine", "lines travel");
    gsl_test_str(iso_record_get(point, "eps"), iso_record_get(both, "eps"), "eps travels");
    laws_stop_if(ctx, iso_record_params(ctx, point, &read), "k and J");
    gsl_test(read.k != p.k || memcmp(read.J, p.J, sizeof p.J) != 0, "k and J travel to the last bit");
    back = convert(point, ISO_BALL);
    gsl_test(iso_record_const_row(back, 0)[0] != 5, "t0 is where the record began");
    iso_record_free(back);
    iso_record_free(point);
    /* an origin from an earlier conversion gives way to the record's own clock */
    laws_stop_if(ctx, iso_record_set(ctx, both, "t0", "77"), "a line");
    for (size_t i = 0; i < 4; i++) iso_record_row(both, i)[0] -= 5;
    point = convert(both, ISO_POINT), back = convert(point, ISO_BALL);
    gsl_test(iso_record_const_row(back, 0)[0] != 0, "an old t0 does not stay");
    iso_record_free(back);
    iso_record_free(point);
    iso_record_free(both);
}

/* Small steps from a far origin: every row is rounded once, not once for each row before it. */
static void check_sum(void)
{
    enum { ROWS = 400 };
    const iso_params p = laws_params(-0.3, J_three);
    const iso_start start = {.model = ISO_BALL, .y = {0.8, 0.5, -0.6, 0.6, 0, 0.8}};
    double t[ROWS], worst = 0;
    for (int i = 0; i < ROWS; i++) t[i] = 0.01 * i;
    iso_record *ball = record_of(&p, &start, ISO_BALL, true, false, t, ROWS);
    iso_record *truth = record_of(&p, &start, ISO_POINT, false, true, t, ROWS);
    laws_stop_if(ctx, iso_record_set(ctx, ball, "s0", "1e8"), "a line");
    iso_record *point = convert(ball, ISO_POINT);
    for (size_t i = 0; i < ROWS; i++)
        worst = fmax(worst, fabs(iso_record_const_row(point, i)[0] - (1e8 + iso_record_const_row(truth, i)[0])));
    gsl_test(!(worst <= 1.5e-8), "s from 1e8 in 400 small steps: worst %.2g, a unit in the last place is 1.5e-8",
             worst);
    iso_record_free(ball);
    iso_record_free(truth);
    iso_record_free(point);
}

/* --- refusals -------------------------------------------------------------------------------------------------- */

/* Refused with the status, and the words in the message; `in` is freed. */
static void refused(iso_record *in, iso_model_kind to, iso_status wanted, const char *words, const char *what)
{
    iso_record *out = in;
    const iso_status got = iso_convert(ctx, in, to, 1e-13, &out);
    gsl_test(got != wanted || out != NULL || !strstr(iso_context_message(ctx), words), "%s: %s (%s)", what,
             iso_status_text(got), iso_context_message(ctx));
    if (out != in) iso_record_free(out);
    iso_record_free(in);
}

/* A good record of six rows, one number of which is changed: x -> factor x + term. */
static iso_record *damaged(iso_model_kind model, const char *column, size_t row, double factor, double term)
{
    static const double t[6] = {0, 1, 2, 3, 4, 5};
    const iso_params p = laws_params(-0.3, J_three);
    const iso_start start = {.model = ISO_BALL, .y = {0.8, 0.5, -0.6, 0.6, 0, 0.8}};
    iso_record *record = record_of(&p, &start, model, model == ISO_BALL, model == ISO_POINT, t, 6);
    double *x = iso_record_row(record, row) + iso_record_find(record, column);
    *x = factor * *x + term;
    return record;
}

static void check_refusals(void)
{
    static const double bad[3] = {NAN, INFINITY, -INFINITY};
    static const char *const columns[] = {"t", "omega1", "n2"}, *const row3[] = {"row 3", "row 3", "row 3"};
    iso_record *r = damaged(ISO_POINT, "s", 0, 1, 0);
    for (int i = 0; i < 3; i++) iso_record_row(r, 3)[1 + i] *= 1.01;
    refused(r, ISO_BALL, ISO_NOT_MAPPED, "row 4", "off the level");
    r = damaged(ISO_BALL, "t", 0, 1, 0);
    for (int i = 0; i < 3; i++) iso_record_row(r, 2)[1 + i] = 0;
    refused(r, ISO_POINT, ISO_NOT_MAPPED, "row 3", "at rest");
    refused(damaged(ISO_BALL, "omega2", 1, 1, 0.01), ISO_POINT, ISO_BAD_INPUT, "row 2", "not orthogonal");
    refused(damaged(ISO_BALL, "n3", 5, 1.01, 0.01), ISO_POINT, ISO_BAD_INPUT, "row 6", "no unit vector");
    refused(damaged(ISO_BALL, "t", 0, 1, 0), ISO_BALL, ISO_BAD_INPUT, "already", "a ball as if it were a point");
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3; c++)
            refused(damaged(ISO_BALL, columns[c], 2, 0, bad[i]), ISO_POINT, ISO_BAD_INPUT, row3[c], columns[c]);
    refused(damaged(ISO_BALL, "t", 5, 1, 1e300), ISO_POINT, ISO_BAD_INPUT, "row 6", "a time that no one can reach");
    r = damaged(ISO_BALL, "t", 0, 1, 0);
    for (int i = 0; i < 3; i++) iso_record_row(r, 2)[1 + i] *= 1e12;
    refused(r, ISO_POINT, ISO_NUMERICAL, "row 4", "a row so fast that its orbit is not followed to the next");
    const char *const names[] = {"t", "omega1", "omega2", "omega3", "n1", "n2", "n3"};
    const double k = -0.3;
    laws_stop_if(ctx, iso_record_create(ctx, 7, names, &r), "a record");
    laws_stop_if(ctx, iso_record_set_numbers(ctx, r, "k", 1, &k), "k");
    laws_stop_if(ctx, iso_record_set_numbers(ctx, r, "J", 3, J_three), "J");
    refused(r, ISO_POINT, ISO_BAD_INPUT, "no rows", "no rows");
    laws_stop_if(ctx, iso_record_create(ctx, 6, names, &r), "a record");
    laws_stop_if(ctx, iso_record_set_numbers(ctx, r, "k", 1, &k), "k");
    laws_stop_if(ctx, iso_record_set_numbers(ctx, r, "J", 3, J_three), "J");
    refused(r, ISO_POINT, ISO_BAD_INPUT, "n3", "a missing column");
    r = damaged(ISO_POINT, "s", 0, 1, 0);
    laws_stop_if(ctx, iso_record_set(ctx, r, "eps", "1e"), "a line");
    refused(r, ISO_BALL, ISO_BAD_INPUT, "eps", "an eps that is no number");
}

/* Rows that the orbit through the row before misses, and times that turn back, are counted, and converted as they
 * stand: a damaged row in the middle is missed, and misses the next. The others are the same to the bit. */
static void check_missed(void)
{
    const struct {
        const char *column;
        size_t row, missed;
        double factor, term;
    } cases[] = {{"t", 4, 2, 0, 2.5}, {"t", 3, 2, 0, 3.5},  {"t", 5, 1, 1, 0.25},
                 {"t", 3, 2, 0, 2},   {"t", 0, 1, 0, 1000}, {"omega1", 0, 0, 1, 0}};
    iso_convert_request how = ISO_CONVERT_UNSET;
    how.to = ISO_POINT;
    iso_record *good = damaged(ISO_BALL, "t", 0, 1, 0), *right = convert(good, ISO_POINT);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        iso_study_result r = {.text = NULL};
        iso_record *in = damaged(ISO_BALL, cases[i].column, cases[i].row, cases[i].factor, cases[i].term);
        const iso_study_subject subject = {.record = in};
        double most = 0;
        laws_stop_if(ctx, iso_study_answer(ctx, &iso_convert_study, &subject, &how, &r) != ISO_OK, cases[i].column);
        const iso_conversion_summary s = ((const iso_convert_found *)r.found)->all;
        const iso_record *out = r.table[0];
        for (size_t row = 0; row < 6; row++)
            for (int c = 1; c < 7; c++)
                if (row != cases[i].row || *cases[i].column == 't')
                    most = fmax(most, fabs(iso_record_const_row(out, row)[c] - iso_record_const_row(right, row)[c]));
        gsl_test(s.missed != cases[i].missed || s.bad != 0, "%s of row %zu: %zu rows are missed, %zu wanted",
                 cases[i].column, cases[i].row, s.missed, cases[i].missed);
        gsl_test(most != 0, "%s of row %zu: the states of the others stay, %.2g", cases[i].column, cases[i].row,
                 most);
        iso_record_free(in);
        iso_study_result_free(&r);
    }
    iso_record_free(good);
    iso_record_free(right);
}

static void check_missing_lines(void)
{
    const char *const names[] = {"t"};
    iso_params p;
    iso_record *r;
    laws_stop_if(ctx, iso_record_create(ctx, 1, names, &r), "a record");
    gsl_test(iso_record_params(ctx, r, &p) != ISO_BAD_INPUT || strcmp(iso_context_about(ctx), "k") != 0, "no k");
    laws_stop_if(ctx, iso_record_set(ctx, r, "k", "-1"), "a line");
    gsl_test(iso_record_params(ctx, r, &p) != ISO_BAD_INPUT || strcmp(iso_context_about(ctx), "J") != 0, "no J");
    laws_stop_if(ctx, iso_record_set(ctx, r, "J", "1 2"), "a line");
    gsl_test(iso_record_params(ctx, r, &p) != ISO_BAD_INPUT, "two moments: %s", iso_context_message(ctx));
    laws_stop_if(ctx, iso_record_set(ctx, r, "J", "1 2 3"), "a line");
    gsl_test(iso_record_params(ctx, r, &p) != ISO_OK || p.k != -1 || p.J[2] != 3, "k and J are read");
    iso_record_free(r);
}

int main(void)
{
    ctx = iso_context_create();
    check_trips();
    check_many_trips();
    check_far_clocks();
    check_reference();
    check_lines();
    check_sum();
    check_refusals();
    check_missed();
    check_missing_lines();
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

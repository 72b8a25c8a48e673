/* Exponent, MEGNO, GALI_2 and the verdict of lib/instrument/chaos/indicators.h, on maps of the plane with exact
 * derivatives. */
#include "base/math_impl.h"
#include "instrument/chaos/chaos_impl.h"
#include "laws.h"

enum { TURNS = 3000 };

/* An orbit of a map with two deviations beside it. The deviation i is d[i] exp(grown[i]). */
typedef struct orbit {
    double x, y, d[2][2], grown[2];
    long turns;
} orbit;

typedef struct map {
    const char *name;
    void (*step)(orbit *o, double parameter);
    double parameter;
} map;

static void apply(orbit *o, double a, double b, double c, double d)
{
    for (int i = 0; i < 2; i++) {
        double *v = o->d[i], u = a * v[0] + b * v[1];
        v[1] = c * v[0] + d * v[1];
        v[0] = u;
        const double length = hypot(v[0], v[1]);
        if (length < 1e6 && length > 1e-6) continue;
        for (int j = 0; j < 2; j++) v[j] /= length;
        o->grown[i] += log(length);
    }
}

/* y' = y + K sin x, x' = x + y' */
static void standard(orbit *o, double K)
{
    const double slope = K * cos(o->x);
    o->y = remainder(o->y + K * sin(o->x), 2 * ISO_PI);
    o->x = remainder(o->x + o->y, 2 * ISO_PI);
    apply(o, 1 + slope, 1, slope, 1);
}

/* McMillan: x' = y, y' = -x + 2 mu y/(1 + y^2), with the integral x^2 y^2 + x^2 + y^2 - 2 mu x y. For mu > 1 the
 * origin is unstable and I = 0 its separatrix. */
static void mcmillan(orbit *o, double mu)
{
    const double y = o->y, square = 1 + y * y;
    o->y = -o->x + 2 * mu * y / square;
    o->x = y;
    apply(o, 0, 1, -1, 2 * mu * (1 - y * y) / (square * square));
}

/* (x, y) -> (2 x + y, x + y): its exponent is ln((3 + sqrt 5)/2) */
static void cat(orbit *o, double unused)
{
    const double x = o->x, y = o->y;
    (void)unused;
    o->x = remainder(2 * x + y, 2 * ISO_PI);
    o->y = remainder(x + y, 2 * ISO_PI);
    apply(o, 2, 1, 1, 1);
}

static void turn(orbit *o, double angle)
{
    const double c = cos(angle), s = sin(angle), x = o->x;
    o->x = c * x - s * o->y;
    o->y = s * x + c * o->y;
    apply(o, c, -s, s, c);
}

static orbit start(double x, double y)
{
    return (orbit){.x = x, .y = y, .d = {{1, 0}, {0, 1}}};
}

/* The clocks run 2, 3 and 1/2 times as fast as the turns. */
static iso_turn_sample turn_of(const orbit *o)
{
    const double n = (double)o->turns, x = o->x, y = o->y;
    iso_turn_sample b = {.clock = {2 * n, 3 * n, n / 2}};
    double length[2];
    for (int i = 0; i < 2; i++) {
        length[i] = hypot(o->d[i][0], o->d[i][1]);
        b.growth[i] = o->grown[i] + log(length[i]);
    }
    b.area = fabs(o->d[0][0] * o->d[1][1] - o->d[0][1] * o->d[1][0]) / (length[0] * length[1]);
    b.observable[0] = cos(x) + sin(x) * cos(y);
    b.observable[1] = sin(x + 1) * sin(x + 1);
    b.observable[2] = cos(y) + sin(y) / 2;
    return b;
}

static void go_on(const map *m, orbit *o, iso_indicators *it)
{
    m->step(o, m->parameter);
    o->turns++;
    const iso_turn_sample b = turn_of(o);
    iso_indicators_add(it, &b);
}

/* Until it is decided, or `most` turns. */
static iso_indication follow(const map *m, orbit *o, long most)
{
    iso_indicators it;
    iso_indication result;
    iso_indicators_begin(&it, most);
    while (o->turns < most && iso_indicators_verdict(&it) == ISO_UNDECIDED) go_on(m, o, &it);
    iso_indicators_read(&it, &result);
    return result;
}

/* --- single orbits ---------------------------------------------------------------------------------------------- */

static void check_cat(void)
{
    const double exact = log((3 + sqrt(5)) / 2);
    const map m = {"the cat map", cat, 0};
    orbit o = start(1, 0.3);
    const iso_indication result = follow(&m, &o, TURNS);
    gsl_test_int((int)result.verdict, ISO_CHAOTIC, "verdict of the cat map");
    gsl_test_int(result.turns < 200, 1, "the cat map is decided at %ld turns", result.turns);
    gsl_test(!isnan(result.per_turn_error), "an orbit that is too short to know the error: %g",
             result.per_turn_error);
    gsl_test_abs(result.per_turn, exact, 1e-12, "exponent of the cat map");
    gsl_test_abs(result.exponent[ISO_CLOCK_T], exact / 2, 1e-12, "... per unit of t");
    gsl_test_abs(result.exponent[ISO_CLOCK_TAU], exact / 3, 1e-12, "... of tau");
    gsl_test_abs(result.exponent[ISO_CLOCK_S], exact * 2, 1e-12, "... of s");
    gsl_test_abs(result.megno_now, exact * (double)result.turns, 2, "MEGNO of the cat map, lam n");
    gsl_test_abs(result.megno_mean, exact * (double)(result.turns + 1) / 2, 2, "its mean, lam n/2");
    gsl_test(!(result.gali2 < 1e-12), "GALI_2 of the cat map: %g", result.gali2);
}

/* A rotation has no shear: MEGNO is 0. A rotation is a regular motion. */
static void check_rotation(void)
{
    const map m = {"a rotation", turn, 2.3};
    orbit o = start(1, 0.3);
    const iso_indication result = follow(&m, &o, TURNS);
    gsl_test_int((int)result.verdict, ISO_REGULAR, "verdict of a rotation");
    gsl_test_abs(result.megno, 0, 0.02, "MEGNO of a rotation");
    gsl_test_abs(result.gali2, 1, 1e-9, "GALI_2 of a rotation");
    gsl_test_abs(result.per_turn, 0, 1e-9, "exponent of a rotation");
}

static iso_indication go_to(const map *m, orbit *o, iso_indicators *it, long turns)
{
    iso_indication result;
    while (o->turns < turns) go_on(m, o, it);
    iso_indicators_read(it, &result);
    return result;
}

/* For large K the exponent of the standard map is ln(K/2) + O(1/K^2), and nothing sticks. The error that is stated is
 * not less than the scatter of orbits. Without its part for what an orbit may have missed, 2.5/sqrt(gain) of the
 * exponent, it is not more than three times as large. */
static void check_exponent(iso_random *r)
{
    enum { ORBITS = 300, LONG = 2000 };
    const map m = {"K = 30", standard, 30};
    double sum = 0, square = 0, stated = 0;
    for (int i = 0; i < ORBITS; i++) {
        orbit o = start(iso_random_uniform(r, -ISO_PI, ISO_PI), iso_random_uniform(r, -ISO_PI, ISO_PI));
        iso_indicators it;
        iso_indicators_begin(&it, LONG);
        const iso_indication result = go_to(&m, &o, &it, LONG);
        gsl_test_int((int)result.exponent_turns, LONG, "turns of the exponent");
        sum += result.per_turn;
        square += (result.per_turn - log(15)) * (result.per_turn - log(15));
        stated += result.per_turn_error;
    }
    const double scatter = sqrt(square / ORBITS), mean = stated / ORBITS, missed = 2.5 * sqrt(log(15) / LONG);
    gsl_test_abs(sum / ORBITS, log(15), 2e-3, "exponent of the standard map at K = 30");
    gsl_test(!(mean >= scatter && mean <= hypot(3 * scatter, missed)), "its error is %g, orbits scatter by %g", mean,
             scatter);
}

/* Orbits of a sea with islands stick to them for times of all lengths. At every length at most one in ten is off by
 * more than two of the errors that are stated: this is what was asked for. The exponent of the sea is the mean of all
 * orbits over the turns after the longest of these lengths; orbits of other seas have less than half of it. */
static void check_error(iso_random *r, double K)
{
    enum { MOST = 200, LENGTHS = 3, LATE = 12000 };
    static const long length[LENGTHS] = {1000, 2000, 4000};
    const map m = {"standard", standard, K};
    static iso_indication result[MOST][LENGTHS];
    double late[MOST], sea = 0, among = 0;
    const int count = tests_length(MOST * 3 / 10, MOST);
    for (int i = 0; i < count; i++) {
        orbit o = start(iso_random_uniform(r, -ISO_PI, ISO_PI), iso_random_uniform(r, -ISO_PI, ISO_PI));
        iso_indicators it;
        iso_indicators_begin(&it, TURNS);
        for (int n = 0; n < LENGTHS; n++) result[i][n] = go_to(&m, &o, &it, length[n]);
        const double before = it.before;
        go_to(&m, &o, &it, LATE);
        late[i] = (it.before - before) / (double)(LATE - length[LENGTHS - 1]);
    }
    for (int pass = 0; pass < 2; pass++) {
        const double least = pass == 0 ? 0.01 : sea / 2;
        sea = among = 0;
        for (int i = 0; i < count; i++)
            if (late[i] > least) sea += late[i], among++;
        sea /= among;
    }
    for (int n = 0; n < LENGTHS; n++) {
        int stated = 0, off = 0, of_regular = 0;
        for (int i = 0; i < count; i++) {
            const iso_indication *t = &result[i][n];
            of_regular += t->verdict == ISO_REGULAR && !(fabs(t->per_turn) <= t->per_turn_error);
            if (!(late[i] > sea / 2) || isnan(t->per_turn_error)) continue;
            stated++;
            off += fabs(t->per_turn - sea) > 2 * t->per_turn_error;
            gsl_test(t->verdict != ISO_CHAOTIC, "K = %g: an error without a verdict", K);
        }
        gsl_test(n > 0 && stated < among * 3 / 4, "K = %g, %ld turns: %d of %g orbits have an error", K, length[n],
                 stated, among);
        gsl_test(off > stated / 10., "K = %g, %ld turns: %d of %d are off by more than two errors", K, length[n], off,
                 stated);
        gsl_test_int(of_regular, 0, "K = %g: regular orbits whose error does not reach 0", K);
    }
}

/* --- many orbits ------------------------------------------------------------------------------------------------ */

/* Next to a separatrix |d| changes by factors of up to 1e12 and grows like n on the average. */
static void check_separatrix(iso_random *r)
{
    const int count = tests_length(300, 5000);
    int verdicts[3] = {0}, off = 0;
    for (int i = 0; i < count; i++) {
        const double mu = iso_random_uniform(r, 1.1, 3),
                     I = pow(10, iso_random_uniform(r, -6, -1)) * (i % 2 ? 1 : -1);
        const double root = (mu - 1) * (mu - 1) + I, square = mu - 1 + sqrt(fmax(root, 0));
        const map m = {"McMillan", mcmillan, mu};
        orbit o = start(sqrt(square), sqrt(square));
        const iso_indication result = follow(&m, &o, TURNS);
        verdicts[result.verdict]++;
        off += result.verdict == ISO_REGULAR && result.megno != result.megno_mean && fabs(result.megno - 2) > 0.02 &&
               fabs(result.megno) > 0.02;
    }
    gsl_test_int(verdicts[ISO_CHAOTIC], 0, "integrable orbits called chaotic, of %d", count);
    gsl_test(verdicts[ISO_UNDECIDED] > count / 100, "integrable orbits undecided: %d of %d", verdicts[ISO_UNDECIDED],
             count);
    gsl_test_int(off, 0, "regular orbits whose limit of MEGNO is known and not 2 +- 0.02");
}

/* Digits decide early: most orbits of a regular region at the first look that may tell. They decide where MEGNO does
 * not settle, on orbits of an island; then its mean is told. */
static void check_digits(iso_random *r)
{
    enum { ORBITS = 100, FIRST = 190 };
    const map m = {"McMillan", mcmillan, 0.5};
    int early = 0;
    for (int i = 0; i < ORBITS; i++) {
        orbit o = start(iso_random_uniform(r, 0.5, 2), 0);
        const iso_indication result = follow(&m, &o, TURNS);
        gsl_test_int((int)result.verdict, ISO_REGULAR, "orbit %d of McMillan's map with mu = 0.5", i);
        early += result.turns <= FIRST;
    }
    for (int i = 0; i < 3; i++) {
        const map island = {"standard", standard, 0.9};
        orbit o = start((const double[]){2.68, 3.15, 3.6}[i], 0);
        const iso_indication result = follow(&island, &o, TURNS);
        gsl_test_int((int)result.verdict, ISO_REGULAR, "orbit %d of the island", i);
        gsl_test(result.turns > 600 || result.megno != result.megno_mean, "it takes %ld turns, and MEGNO is %g",
                 result.turns, result.megno);
    }
    gsl_test(early < ORBITS / 2, "%d of %d orbits are decided at %d turns", early, ORBITS, FIRST);
}

/* The chaotic sea, with the orbits that stick to islands for long. What is chaotic, a long run tells. */
static void check_sea(iso_random *r, double K, double most_undecided)
{
    const int count = tests_length(80, 2500);
    const map m = {"standard", standard, K};
    int sea[3] = {0}, rest[3] = {0}, all = 0;
    for (int i = 0; i < count; i++) {
        orbit o = start(iso_random_uniform(r, -ISO_PI, ISO_PI), iso_random_uniform(r, -ISO_PI, ISO_PI));
        const iso_indication result = follow(&m, &o, TURNS);
        const double before = o.grown[0]; /* exp(40): longer than a regular orbit can make a linear growth */
        for (; o.turns < 100000 && o.grown[0] - before < 40; o.turns++) m.step(&o, m.parameter);
        const bool chaotic = o.turns < 100000;
        (chaotic ? sea : rest)[result.verdict]++;
        all += chaotic;
    }
    gsl_test_int(sea[ISO_REGULAR], 0, "K = %g: chaotic orbits called regular, of %d", K, all);
    const double undecided = most_undecided * all; /* and three of its standard deviations, by chance */
    gsl_test(sea[ISO_UNDECIDED] > undecided + 3 * sqrt(undecided), "K = %g: chaotic orbits undecided: %d of %d", K,
             sea[ISO_UNDECIDED], all);
    gsl_test(rest[ISO_CHAOTIC] > 0.005 * count + 1, "K = %g: regular orbits called chaotic: %d of %d", K,
             rest[ISO_CHAOTIC], count - all);
    gsl_test(rest[ISO_UNDECIDED] > 0.25 * count, "K = %g: regular orbits undecided: %d of %d", K, rest[ISO_UNDECIDED],
             count - all);
}

/* A verdict holds, and what is result before there is anything to tell is NaN. */
static void check_edges(void)
{
    iso_indicators it;
    iso_indication result;
    iso_indicators_begin(&it, TURNS);
    iso_indicators_read(&it, &result);
    gsl_test_int((int)result.verdict, ISO_UNDECIDED, "verdict of nothing");
    gsl_test(!isnan(result.per_turn) || !isnan(result.megno), "exponent and MEGNO of nothing are not known");
    const map m = {"K = 5", standard, 5};
    orbit o = start(3, 0.2);
    const iso_indication first = follow(&m, &o, 50);
    gsl_test_int((int)first.verdict, ISO_UNDECIDED, "verdict at 50 turns");
    iso_indicators_begin(&it, 50); /* it may go on */
    for (o = start(3, 0.2); o.turns < 1000;) go_on(&m, &o, &it);
    gsl_test_int((int)iso_indicators_verdict(&it), ISO_CHAOTIC, "verdict of one that goes on");
}

int main(void)
{
    iso_random *r = iso_random_create(11);
    check_cat();
    check_rotation();
    check_edges();
    check_exponent(r);
    check_error(r, 1.5);
    check_error(r, 2.5);
    check_error(r, 5);
    check_separatrix(r);
    check_digits(r);
    check_sea(r, 0.9, 0.06);
    check_sea(r, 1.5, 0.015);
    check_sea(r, 5, 0.01);
    iso_random_free(r);
    return gsl_test_summary();
}

/* The machine under the numbers: threads, and what a host program may have set for itself, its rounding, its
 * subnormal numbers, its traps and its locale. None of it may change a bit of an answer, base/arithmetic_impl.h. */
#define _GNU_SOURCE /* memmem, feenableexcept */
#include <fenv.h>
#include <locale.h>
#include <pthread.h>
#include <sys/wait.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "machine.h"

static answer orbit_answer[HARD_WAYS], study_answer[STUDIES];

static void find_answers(void)
{
    for (int i = 0; i < hard_ways; i++) orbit_answer[i] = orbit_by(ctx, &hard_way[i]);
    for (int i = 0; i < STUDIES; i++) {
        study_answer[i] = study_by(&studies[i]);
        const void *failure = memmem(study_answer[i].bytes, study_answer[i].length, "unexpected", 10);
        gsl_test(failure != NULL, "%s: every call is answered %.200s", studies[i].name,
                 failure ? (const char *)failure - 60 : "");
    }
}

/* --- runs and threads ------------------------------------------------------------------------------------------- */

typedef struct walk {
    bool backwards;
    double differing[HARD_WAYS];
} walk;

static void *walk_ways(void *data)
{
    walk *w = data;
    iso_context *own = iso_context_create();
    for (int i = 0; own && i < hard_ways; i++) {
        const int way = w->backwards ? hard_ways - 1 - i : i;
        answer a = orbit_by(own, &hard_way[way]);
        w->differing[way] = differing(&orbit_answer[way], &a);
        free(a.bytes);
    }
    iso_context_free(own);
    return NULL;
}

/* x1 + ... + xn, then xn + ... + x1: what a shared sum becomes when threads come in another order. */
static double sum_of_batch(bool backwards)
{
    double sum = 0;
    for (int i = 0; i < 1000; i++) sum += 1.0 / (1 + (backwards ? 999 - i : i));
    return sum;
}

static void check_threads(void)
{
    hard_case("threads",
              "bytes of the state at t = 10 that differ: two threads at once, the methods in opposite order",
              "global state of a library, and of SUNDIALS and GSL under it, would show in another thread's numbers");
    static walk walks[2] = {{.backwards = false}, {.backwards = true}};
    pthread_t thread;
    gsl_test(pthread_create(&thread, NULL, walk_ways, &walks[1]), "a thread");
    walk_ways(&walks[0]);
    pthread_join(thread, NULL);
    for (int i = 0; i < hard_ways; i++) hard_hold(&hard_way[i], walks[0].differing[i] + walks[1].differing[i], 0);
    hard_naive("a sum of 1000 numbers in the order in which threads bring them",
               fabs(sum_of_batch(false) - sum_of_batch(true)), 0);
}

/* --- what a host program has set -------------------------------------------------------------------------------- */

enum { FLUSH = 0x8040 }; /* of MXCSR: flush-to-zero, denormals-are-zero */

typedef struct host {
    const char *name;
    int round; /* as fesetround takes it, or FLUSH */
} host;

static void set(int round)
{
#ifdef __SSE2__
    if (round == FLUSH) _mm_setcsr(_mm_getcsr() | FLUSH);
#endif
    if (round != FLUSH) fesetround(round);
}

/* Whether it still is so. */
static bool stands(int round)
{
#ifdef __SSE2__
    if (round == FLUSH) return (_mm_getcsr() & FLUSH) == FLUSH;
#endif
    return fegetround() == round;
}

/* Bytes that differ from a plain program's, and one if the host does not find again what it has set. */
static double under(const host *h, const answer *plain, const hard_road *way, const struct study *study)
{
    set(h->round);
    answer a = way ? orbit_by(ctx, way) : study_by(study);
    const bool kept = stands(h->round);
    fesetenv(FE_DFL_ENV);
    const double count = differing(plain, &a) + !kept;
    gsl_test(count > 0, "%s: %s %s: %g bytes differ%s", h->name,
             way ? iso_backend_name((int)way->backend) : study->name, way && way->method ? way->method->name : "",
             count, kept ? "" : ", and what the host had set is gone");
    free(a.bytes);
    return count;
}

static void check_hosts(const host hosts[], int count)
{
    for (int i = 0; i < hard_ways; i++) {
        double sum = 0;
        for (int h = 0; h < count; h++) sum += under(&hosts[h], &orbit_answer[i], &hard_way[i], NULL);
        hard_hold(&hard_way[i], sum, 0);
    }
    for (int i = 0; i < STUDIES; i++)
        for (int h = 0; h < count; h++) hard_hold(NULL, under(&hosts[h], &study_answer[i], NULL, &studies[i]), 0);
}

static double sum_of_tenths(void)
{
    volatile double sum = 0;
    for (int i = 0; i < 1000; i++) sum += 0.1;
    return sum;
}

static void check_rounding(void)
{
    static const host hosts[] = {
        {"FE_UPWARD", FE_UPWARD}, {"FE_DOWNWARD", FE_DOWNWARD}, {"FE_TOWARDZERO", FE_TOWARDZERO}};
    hard_case(
        "rounding", "bytes that differ where the host rounds up, down or to zero, which it does afterwards, too",
        "rounding one way makes errors that add up; sums of two numbers are exact only to nearest; decimals are "
        "read and written by the same rule");
    check_hosts(hosts, 3);
    const double nearest = sum_of_tenths();
    set(FE_UPWARD);
    const double up = sum_of_tenths();
    fesetenv(FE_DFL_ENV);
    hard_naive("a sum in the host's own rounding, upward", fabs(up - nearest), 0);
}

#ifdef __SSE2__
static void check_subnormal(void)
{
    static const host hosts[] = {{"flush-to-zero", FLUSH}};
    volatile double J = 1.4e-310;
    hard_case("subnormal numbers",
              "bytes that differ where the host makes subnormal numbers 0, which it does afterwards",
              "a host linked with -ffast-math starts so; a body of 1e-310 is none then");
    check_hosts(hosts, 1);
    set(FLUSH);
    volatile const double made = J * 0x1p100 / 0x1p100; /* here, not later */
    fesetenv(FE_DFL_ENV);
    hard_naive("a moment of inertia scaled up and down in the host's own arithmetic: relative error",
               fabs(made - J) / J, 0);
}
#else
static void check_subnormal(void)
{
    hard_case("subnormal numbers", "bytes that differ where the host makes subnormal numbers 0", "");
    hard_refused(NULL, true, "this processor has no such mode, or not where this test looks for it");
}
#endif

/* --- traps ------------------------------------------------------------------------------------------------------ */

enum { TRAPS = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW };

/* In a process of its own, which a trap ends: 1 when it does, or when the answer differs. */
static double trapped(const answer *plain, const hard_road *way, const struct study *study)
{
    int ended = 0;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        feclearexcept(FE_ALL_EXCEPT); /* flags of earlier work would trap here, in the host itself */
        feenableexcept(TRAPS);
        answer a = way ? orbit_by(ctx, way) : study_by(study);
        const bool stands = fegetexcept() == TRAPS;
        _exit(differing(plain, &a) > 0 || !stands);
    }
    const bool survived =
        child > 0 && waitpid(child, &ended, 0) == child && WIFEXITED(ended) && WEXITSTATUS(ended) == 0;
    gsl_test(!survived, "a host that traps: %s %s: status %x",
             way ? iso_backend_name((int)way->backend) : study->name, way && way->method ? way->method->name : "",
             (unsigned)ended);
    return survived ? 0 : 1;
}

static void check_traps(void)
{
    hard_case(
        "traps", "hosts that trap division by 0, invalid operations and overflow, and do not survive",
        "steps that are tried and given up, lanes without an orbit and vectors with garbage in their ends may raise "
        "any of them, here, in SUNDIALS, GSL and the C library");
    if (feenableexcept(0) < 0) {
        hard_refused(NULL, true, "this processor does not trap");
        return;
    }
    int raising = 0;
    for (int i = 0; i < hard_ways; i++) hard_hold(&hard_way[i], trapped(&orbit_answer[i], &hard_way[i], NULL), 0);
    for (int i = 0; i < STUDIES; i++) {
        hard_hold(NULL, trapped(&study_answer[i], NULL, &studies[i]), 0);
        feclearexcept(FE_ALL_EXCEPT);
        answer a = study_by(&studies[i]);
        raising += fetestexcept(TRAPS) != 0;
        free(a.bytes);
    }
    hard_naive("the same studies, had the host's traps stood: how many raise one", raising, 0);
}

/* --- a comma for a point ---------------------------------------------------------------------------------------- */

/* A locale made here, since a fresh machine has none with a comma, also for gnuplot; else one that is there. */
static bool take_comma(void)
{
    static const char *const there[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "ps_AF.UTF-8"};
    char folder[4096];
    FILE *source = fopen("hard_machine_comma.src", "w");
    if (!source) return false;
    fputs("comment_char %\nescape_char /\nLC_NUMERIC\ndecimal_point \"<U002C>\"\nthousands_sep \"<U002E>\"\n"
          "grouping 3;3\nEND LC_NUMERIC\n",
          source);
    fclose(source);
    (void)!system("localedef -c -f ANSI_X3.4-1968 -i hard_machine_comma.src ./hard_machine_comma >/dev/null 2>&1");
    unlink("hard_machine_comma.src");
    if (getcwd(folder, sizeof folder)) setenv("LOCPATH", folder, 1);
    setenv("LC_ALL", "hard_machine_comma", 1);
    if (setlocale(LC_ALL, "")) return true;
    unsetenv("LOCPATH");
    for (size_t i = 0; i < sizeof there / sizeof *there; i++)
        if (setenv("LC_ALL", there[i], 1) == 0 && setlocale(LC_ALL, "") && *localeconv()->decimal_point == ',')
            return true;
    return false;
}

static void check_comma(void)
{
    hard_case("comma",
              "bytes of what is read, computed, written and drawn that differ where the host's locale has a comma",
              "printf and strtod of the C library follow the host's locale; 1,5 is two columns of a CSV file");
    if (!take_comma()) {
        hard_refused(NULL, true, "this machine has no locale with a comma, and no localedef to make one");
        return;
    }
    double count[STUDIES];
    for (int i = 0; i < STUDIES; i++) {
        answer a = study_by(&studies[i]);
        count[i] = differing(&study_answer[i], &a);
        free(a.bytes);
    }
    char text[32];
    snprintf(text, sizeof text, "%.17g", 1.5);
    const double naive = fabs(strtod("1.5", NULL) - 1.5) + !strchr(text, '.');
    setlocale(LC_ALL, "C"); /* the book is kept with points */
    for (int i = 0; i < STUDIES; i++) {
        gsl_test(count[i] > 0, "a comma: %s: %g bytes differ", studies[i].name, count[i]);
        hard_hold(NULL, count[i], 0);
    }
    hard_naive("strtod of \"1.5\", and of what printf makes of 1.5", naive, 0);
    (void)!system("rm -rf hard_machine_comma");
}

int main(void)
{
    ctx = iso_context_create();
    iso_random *dice = iso_random_create(10);
    batch_fill(&pool, ctx, dice);
    iso_random_free(dice);
    hard_topic("10. Machine");
    find_answers();
    check_threads();
    check_rounding();
    check_subnormal();
    check_traps();
    check_comma();
    for (int i = 0; i < hard_ways; i++) free(orbit_answer[i].bytes);
    for (int i = 0; i < STUDIES; i++) free(study_answer[i].bytes);
    iso_context_free(ctx);
    return hard_summary();
}

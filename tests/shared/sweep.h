/* sweep.h - calls with a bad number. Each number of a call in turn becomes NaN, infinite, zero, subnormal or the
 * largest.
 *
 * The call must answer with a status. With ISO_OK all its numbers must be finite. It must refuse NaN and infinity.
 * A call here gets its numbers as an array, and gives back the numbers that a caller would read.
 */
#ifndef ISO_TESTS_SWEEP_H
#define ISO_TESTS_SWEEP_H

#include <time.h>

#include "hard.h"

enum { SWEEP_NUMBERS = 32, SWEEP_ANSWERS = 400 };

typedef struct sweep_answer {
    int count;
    double value[SWEEP_ANSWERS];
} sweep_answer;

typedef struct sweep_call {
    const char *name;
    iso_status (*call)(iso_context *ctx, const void *data, const double v[], sweep_answer *answer);
    const void *data; /* what is no number */
    int count;
    double usual[SWEEP_NUMBERS];
    unsigned long free; /* bits of the numbers that may be NaN or infinite: "not stated", "no bound" */
} sweep_call;

static inline void sweep_give(sweep_answer *a, const double x[], int count)
{
    for (int i = 0; i < count && a->count < SWEEP_ANSWERS; i++) a->value[a->count++] = x[i];
}

/* Stops long work: no call here should take more than a moment. */
static clock_t sweep_began;
static inline bool sweep_goes_on(void *data)
{
    (void)data;
    return (double)(clock() - sweep_began) < 2.0 * CLOCKS_PER_SEC;
}

/* NULL, or what is wrong with the answer. */
static inline const char *sweep_fault(const sweep_call *c, int place, double special, iso_status status,
                                      const sweep_answer *a)
{
    const bool number = isfinite(special), optional = c->free >> place & 1;
    if (status == ISO_STOPPED) return "takes too long";
    if (status != ISO_OK) return NULL;
    if (!number && !optional) return "is taken";
    for (int i = 0; i < a->count; i++)
        if (!isfinite(a->value[i])) return "gives what is no number";
    return NULL;
}

/* The number of wrong answers of a call; each has a line on standard error. 1 if the call fails with its good
 * numbers. */
static inline int sweep(iso_context *ctx, const sweep_call *c, int *cases)
{
    static const double special[] = {NAN,          INFINITY,     -INFINITY,     0.0,     -0.0,    DBL_MIN / 2,
                                     -DBL_MIN / 2, DBL_TRUE_MIN, -DBL_TRUE_MIN, DBL_MAX, -DBL_MAX};
    int wrong = 0;
    sweep_answer answer = {0};
    iso_context_set_monitor(ctx, sweep_goes_on, NULL);
    sweep_began = clock();
    if (c->call(ctx, c->data, c->usual, &answer) != ISO_OK) {
        gsl_test(1, "%s as it should be: %s", c->name, iso_context_message(ctx));
        return 1;
    }
    for (int place = 0; place < c->count; place++)
        for (size_t i = 0; i < sizeof special / sizeof *special; i++) {
            double v[SWEEP_NUMBERS];
            for (int j = 0; j < c->count; j++) v[j] = c->usual[j];
            v[place] = special[i];
            answer.count = 0;
            sweep_began = clock();
            const iso_status status = c->call(ctx, c->data, v, &answer);
            const char *fault = sweep_fault(c, place, special[i], status, &answer);
            ++*cases;
            if (!fault) continue;
            wrong++;
            fprintf(stderr, "%s: %g as number %d %s\n", c->name, special[i], place + 1, fault);
        }
    iso_context_set_monitor(ctx, NULL, NULL);
    return wrong;
}

/* Every call of the list, each a line of the book of hard cases: no wrong answer is allowed. */
static inline void sweep_all(iso_context *ctx, const sweep_call calls[], size_t count, const char *what)
{
    hard_case(what, "wrong answers to NaN, infinity, zeros, subnormals and the largest numbers",
              "a comparison with NaN is false, and a check that reads x < 0 lets it pass");
    for (size_t i = 0; i < count; i++) {
        int cases = 0;
        const int wrong = sweep(ctx, &calls[i], &cases);
        gsl_test(cases == 0, "%s: %d cases", calls[i].name, cases);
        hard_hold(NULL, wrong, 0);
    }
}

#endif

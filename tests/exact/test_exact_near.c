/* The closed solution against long double on a thousand orbits, most of them next to a separatrix, to equal moments
 * or to a principal plane, in every clock and both ways. */
#include "exact_orbits.h"

static iso_context *ctx;

enum { TIMES = 3 };

/* Units of an orbit's time (of which a turn has 6) it is followed, and every tenth. */
static const double NEAR = 100, FAR = 628;

/* Errors up to `enough` are asked no question; above, they may be what rounding of the start's components does,
 * ROUNDING times the condition, and ITSELF times what the reference differs by from itself with other steps. */
static const double ROUNDING = 1e-15, ITSELF = 10;

static double enough(exact_family family)
{
    return family < EXACT_SEPARATRIX ? 5e-12 : 1e-11;
}

typedef struct states {
    double y[TIMES][ISO_MAX_STATE];
} states;

/* By steps in long double. A field of strength 0 keeps the method from restoring the second integral, which it would
 * take from the start as given, off |gamma| = 1 and H by rounding. */
static states stepped(const orbit *o, const double times[TIMES], double tolerance)
{
    orbit copied = *o;
    states s;
    copied.model.problem.effects.on[ISO_FIELD] = true;
    exact_in_clock(&copied, o->model.clock);
    iso_integrator *it =
        orbit_start(&copied, iso_method_find("taylor_extended"), &(iso_method_options){.tolerance = tolerance});
    for (int j = 0; j < TIMES; j++)
        if (iso_integrator_at(it, times[j], s.y[j]) != ISO_OK) s.y[j][0] = NAN;
    iso_integrator_free(it);
    return s;
}

/* The largest error of M and gamma; clocks have an error of their own. */
static double difference(const orbit *o, const states *a, const states *b)
{
    orbit state = *o;
    double most = 0;
    state.model.dim = ISO_STATE;
    for (int j = 0; j < TIMES; j++) {
        const double error = orbit_error(&state, a->y[j], b->y[j]);
        if (!(error <= most)) most = error; /* NaN stays */
        if (isnan(error)) break;
    }
    return most;
}

static double clock_difference(const orbit *o, const states *a, const states *b)
{
    double most = 0;
    for (int j = 0; j < TIMES; j++)
        for (int c = ISO_STATE; c < ISO_STATE + o->model.clocks; c++) {
            const double error = fabs(a->y[j][c] / b->y[j][c] - 1);
            if (!(error <= most)) most = error;
        }
    return most;
}

/* What relative changes of single components of the start, one after the other, do to the states: the sum over all
 * six, which bounds what changes of each of any sign do. The stepped orbits are asked. Changes are a hundredth of the
 * distance from a separatrix, and |gamma|, (M,gamma) and H are kept. */
static double condition(const orbit *o, const states *s, const double times[TIMES])
{
    double excess[3], sum = 0;
    iso_conical at;
    iso_separation_coordinates(&o->model.problem.p, o->y0, &at);
    iso_separation_constant(&o->model.problem, &at, excess);
    const double distance = fmin(fabs(excess[1]), fabs(excess[2])) / laws_max(3, excess);
    const double h = fmax(2e-14, fmin(1e-8, distance / 100)); /* other k: NaN, 1e-8 */
    for (int i = 0; i < ISO_STATE; i++) {
        orbit moved = *o;
        if (o->y0[i] == 0) continue;
        moved.y0[i] *= 1 + h;
        moved.model.system->project(&moved.model.problem, moved.y0);
        const states other = stepped(&moved, times, 1e-15);
        sum += difference(o, &other, s) / h;
    }
    return sum;
}

typedef struct book {
    laws_worst state, clock, invariants;
    int orbits, conditioned, by_reference, refused;
    double largest; /* condition */
} book;

static void note_invariants(const orbit *o, const states *s, const char *name, book *b)
{
    const iso_params *p = &o->model.problem.p;
    for (int j = 0; j < TIMES; j++) {
        const double *y = s->y[j];
        double size;
        const double H = iso_system_point.energy(&o->model.problem, y, &size);
        laws_note(&b->invariants, fabs(H - o->model.problem.energy) / size, 1e-14, p, name);
        laws_note(&b->invariants, fabs(norm(y + 3) - 1), 1e-14, p, name);
        laws_note(&b->invariants, fabs(dot(y, y + 3)) / norm(y), 1e-14, p, name);
    }
}

static void note_errors(const orbit *o, const states *y, const double times[TIMES], exact_family family, book *b)
{
    const states s = stepped(o, times, 1e-15);
    const double error = difference(o, y, &s);
    const char *const name = exact_names[family];
    double allowed = enough(family);
    if (!(error <= allowed)) {
        const states again = stepped(o, times, 2e-15);
        const double number = condition(o, &s, times), itself = ITSELF * difference(o, &again, &s);
        b->conditioned++;
        b->by_reference += !(error <= ROUNDING * number);
        allowed = fmax(allowed, ROUNDING * number + itself);
        b->largest = fmax(b->largest, number);
    }
    laws_note(&b->state, error, allowed, &o->model.problem.p, name);
    laws_note(&b->clock, clock_difference(o, y, &s), fmax(1e-13, allowed), &o->model.problem.p, name);
}

static void check_orbit(const orbit *start, int i, exact_family family, book *b)
{
    orbit o = *start;
    b->orbits++;
    const iso_clock clock = (iso_clock)(i % ISO_CLOCKS);
    iso_exact *exact;
    double times[TIMES], clocks[ISO_CLOCKS];
    states s;
    if (iso_exact_create(ctx, &o.model.problem, o.y0, exact_clocks, &exact) != ISO_OK) {
        b->refused++;
        return;
    }
    exact_in_clock(&o, clock);
    for (int j = 0; j < TIMES; j++) {
        times[j] = (i / ISO_CLOCKS % 2 ? -1 : 1) * (j + 1) * (i % 10 ? NEAR : FAR) / TIMES * o.unit;
        if (iso_exact_at(ctx, exact, clock, times[j], s.y[j], clocks) != ISO_OK) s.y[j][0] = NAN;
        for (int c = 0; c < o.model.clocks; c++) s.y[j][ISO_STATE + c] = clocks[o.model.clock_of[c]];
    }
    note_errors(&o, &s, times, family, b);
    note_invariants(&o, &s, exact_names[family], b);
    iso_exact_free(exact);
}

static void report(exact_family family, const book *b)
{
    char name[96];
    snprintf(name, sizeof name, "%s, %d of %d by condition, up to %.0e", exact_names[family], b->conditioned,
             b->orbits, b->largest);
    laws_report(&b->state, name);
    laws_report(&b->clock, "clocks");
    laws_report(&b->invariants, "H, |gamma| and (M,gamma)");
    /* past the pole nearer than 0.01 or so, bodies next to revolution need too many terms */
    gsl_test(b->refused > (family == EXACT_NEAR_POLE ? b->orbits * 2 / 5 : 0), "%d refused", b->refused);
    gsl_test(b->by_reference > 1 + b->orbits / 20, "in %d of %d the reference is not enough", b->by_reference,
             b->orbits);
}

int main(void)
{
    static const exact_family list[EXACT_FAMILIES] = {
        EXACT_ANY,  EXACT_SEPARATRIX, EXACT_WIDE,     EXACT_SECOND,    EXACT_LEVEL,    EXACT_NEAR_EQUAL,
        EXACT_AXIS, EXACT_NEAR_PLANE, EXACT_IN_PLANE, EXACT_NEAR_AXIS, EXACT_NEAR_POLE};
    static book of[EXACT_FAMILIES];
    ctx = iso_context_create();
    iso_random *random = iso_random_create(1000);
    const int orbits = tests_length(110, 550);
    for (int i = 0; i < orbits; i++) {
        const exact_family family = list[i % EXACT_FAMILIES];
        const double delta = pow(10, -iso_random_uniform(random, 1, 12));
        const orbit o = exact_orbit(ctx, family, i / EXACT_FAMILIES, delta, random);
        check_orbit(&o, i / EXACT_FAMILIES, family, &of[family]);
    }
    for (exact_family f = 0; f < EXACT_FAMILIES; f++) report(f, &of[f]);
    iso_random_free(random);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

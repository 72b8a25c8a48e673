#include "hard.h"

#include "method/methods_impl.h"

hard_road hard_way[HARD_WAYS];
int hard_ways;

static struct {
    const char *topic;
    char name[128];
    FILE *table;
} book;

static double usual_tolerance(const iso_method *m)
{
    const bool bdf = m->implicit && strstr(m->name, "bdf");
    if (m->order == 0) return bdf ? 1e-8 : 1e-12;
    return m->order <= 2 ? 1e-6 : m->order <= 4 ? 1e-9 : 1e-12;
}

/* At the short length every third method, of each topic others; and two that tests call by their names. */
static bool is_taken(const iso_method *m, size_t number)
{
    return number % 3 == strlen(book.topic) % 3 || tests_length(0, 1) || strcmp(m->name, "taylor") == 0 ||
           strcmp(m->name, "rk8pd") == 0;
}

void hard_topic(const char *title)
{
    char path[64] = "hard_";
    book.topic = title;
    for (const char *c = title; *c && strlen(path) < 40; c++) {
        const char small[2] = {(*c >= 'A' && *c <= 'Z') ? (char)(*c - 'A' + 'a') : *c, '\0'};
        if ((small[0] >= 'a' && small[0] <= 'z') || (small[0] >= '0' && small[0] <= '9')) strcat(path, small);
    }
    book.table = fopen(strcat(path, ".tsv"), "we");
    if (!book.table) gsl_test(1, "%s cannot be written", path);
    for (int backend = ISO_BACKEND_BALL; backend <= ISO_BACKEND_POINT; backend++)
        for (int i = 0; iso_methods[i] && hard_ways < HARD_WAYS - 1; i++) {
            const iso_method *m = iso_methods[i];
            const iso_system *system = backend == ISO_BACKEND_BALL ? &iso_system_ball : &iso_system_point;
            if (m->reference || (m->system && m->system != system) || !is_taken(m, (size_t)i)) continue;
            hard_way[hard_ways++] = (hard_road){(iso_backend)backend, m, usual_tolerance(m)};
        }
    hard_way[hard_ways++] = (hard_road){ISO_BACKEND_EXACT, NULL, 1e-12};
}

static void enter(const char *kind, const char *backend, const char *method, const char *measured, double bound)
{
    if (!book.table) return;
    fprintf(book.table, "%s\t%s\t%s\t%s\t%s\t%s\t%.1g\n", book.topic, book.name, kind, backend, method, measured,
            bound);
}

void hard_case(const char *name, const char *quantity, const char *why)
{
    snprintf(book.name, sizeof book.name, "%s", name);
    enter("case", quantity, why, "", 0);
}

static void number(char text[32], double x)
{
    snprintf(text, 32, x == 0 ? "0" : "%.1e", x);
}

void hard_hold(const hard_road *way, double measured, double bound)
{
    char text[32];
    const char *backend = way ? iso_backend_name((int)way->backend) : "";
    const char *method = way && way->method ? way->method->name : "";
    number(text, measured);
    enter("hold", backend, method, text, bound);
    gsl_test(!(measured <= bound), "%s %s: %s %s: %.2g, bound %.2g", book.topic, book.name, backend, method, measured,
             bound);
}

void hard_refused(const hard_road *way, bool refused, const char *words)
{
    const char *backend = way ? iso_backend_name((int)way->backend) : "";
    const char *method = way && way->method ? way->method->name : "";
    enter("refused", backend, method, words, 0);
    gsl_test(!refused, "%s %s: %s %s: refused: %s", book.topic, book.name, backend, method, words);
}

void hard_naive(const char *how, double measured, double bound)
{
    char text[32];
    number(text, measured);
    enter("naive", how, "", text, bound);
    gsl_test(measured <= bound, "%s %s: naive (%s) fails: %.2g, bound %.2g", book.topic, book.name, how, measured,
             bound);
}

int hard_summary(void)
{
    if (book.table && fclose(book.table) != 0) gsl_test(1, "the table of %s cannot be written", book.topic);
    return gsl_test_summary();
}

iso_status hard_solve(iso_context *ctx, const hard_road *way, const iso_params *p, const iso_start *start,
                      const iso_effects *effects, bool both, iso_clock clock, double time, iso_sample *sample)
{
    iso_orbit *orbit;
    iso_orbit_options o = iso_orbit_defaults(start);
    o.effects = effects;
    o.backend = way->backend;
    o.method = way->method;
    o.tolerance = way->tolerance;
    o.clock = clock;
    o.max_steps = 10000000;
    if (both) o.shown = ISO_SHOW_BOTH;
    for (int c = 0; c < ISO_CLOCKS; c++) o.with_clock[c] = both;
    iso_status status = iso_orbit_create(ctx, p, start, &o, &orbit);
    if (status != ISO_OK) return status;
    status = iso_orbit_at(orbit, time, sample);
    iso_orbit_free(orbit);
    return status;
}

double hard_error(const double a[ISO_STATE], const double b[ISO_STATE])
{
    double worst = 0;
    for (int v = 0; v < ISO_STATE; v += 3) {
        const double size = norm(b + v),
                     apart = norm((double[]){a[v] - b[v], a[v + 1] - b[v + 1], a[v + 2] - b[v + 2]});
        const double error = apart == 0 ? 0 : apart / size;
        if (!(error <= worst)) worst = error;
    }
    return worst;
}

void hard_naive_squares(const double J[3], const double x[3], double square[3])
{
    double sum = 0, product = 0;
    for (int i = 0; i < 3; i++) {
        const double b = J[(i + 1) % 3], c = J[(i + 2) % 3];
        sum += x[i] * x[i] * (b + c), product += x[i] * x[i] * b * c;
    }
    const double root = sqrt(fmax(0, sum * sum - 4 * product)), z[2] = {(sum - root) / 2, (sum + root) / 2};
    for (int i = 0; i < 3; i++)
        square[i] = (J[i] - z[0]) * (J[i] - z[1]) / ((J[i] - J[(i + 1) % 3]) * (J[i] - J[(i + 2) % 3]));
}

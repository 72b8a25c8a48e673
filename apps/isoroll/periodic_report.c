/* periodic_report.c - periodic orbits as a table, as JSON, as rows and as a picture (see periodic_report.h). */
#include "periodic_report.h"

#include <math.h>
#include <stdlib.h>

#include "json.h"
#include "plot/plot.h"
#include "table.h"

/* --- the table -------------------------------------------------------------------------------------------------- */

static void print_multipliers(const iso_multipliers *m)
{
    if (m->krein)
        printf("exp(+-%.9g i), Krein %+d", atan2(m->value[0][1], m->value[0][0]), m->krein);
    else
        printf("%.9g, %.9g", m->value[0][0], m->value[1][0]);
}

static void print_rotations(const periodic_report *r)
{
    printf("rotations about the principal axes, half a turn (Hill's equation)\n");
    printf("  axis  %-*s  error    %-10s  multipliers\n", r->polish ? 33 : 20, "trace", "");
    for (int a = 0; a < 3; a++) {
        const iso_rotation *o = &r->found->rotation[a];
        char text[ISO_DIGITS_SIZE];
        iso_periodic_digits(o->half_turn_trace, o->tail, text);
        printf("  %4d  ", a + 1);
        if (o->oscillates) {
            printf("none on this level: an oscillation between two places of rest\n");
            continue;
        }
        r->polish ? printf("%-33s", text) : printf("%-20.15g", o->half_turn_trace);
        printf("  %.1e  %-10s  ", o->error, iso_stability_name(o->half.stability));
        print_multipliers(&o->half);
        putchar('\n');
    }
}

static void print_orbit(const periodic_report *r, size_t i)
{
    const iso_periodic_orbit *o = &r->found->orbit[i];
    char words[ISO_DIGITS_SIZE], l[ISO_DIGITS_SIZE], x[ISO_DIGITS_SIZE], trace[ISO_DIGITS_SIZE];
    iso_symmetry_words(o->symmetry, words);
    if (!r->polish) {
        printf("%4zu  %4d  %18.15f  %18.15f  %18.11g  %.0e  %-10s  %-8s  %6d  %.9g\n", i + 1, o->period, o->l, o->x,
               o->trace, o->error, iso_stability_name(o->multipliers.stability), words, o->copies, o->clock[0]);
        return;
    }
    iso_periodic_digits(o->l, o->l_tail, l);
    iso_periodic_digits(o->x, o->x_tail, x);
    iso_periodic_digits(o->trace, o->trace_tail, trace);
    printf("%4zu  %4d  %34s  %34s  %34s  %.0e  %7.0e  %-10s  %s\n", i + 1, o->period, l, x, trace, o->error,
           o->closure, iso_stability_name(o->multipliers.stability), words);
}

void periodic_print(const periodic_report *r)
{
    const double *J = r->scene->params.J;
    const iso_periodic *f = r->found;
    size_t copies = 0, tori = 0;
    printf("k = %.15g, J = %.15g %.15g %.15g; section n_%d = 0, n_%d increasing\n", r->scene->params.k, J[0], J[1],
           J[2], f->axis + 1, f->axis + 1);
    if (f->level != 0) printf("level of the point, (H/eps) J2^(1/k): %.15g\n", f->level);
    putchar('\n');
    print_rotations(r);
    printf("\n%s orbits of %d returns at most, but the rotations: %zu\n", r->all ? "periodic" : "symmetric periodic",
           r->period, f->count);
    if (f->count > 0)
        printf(r->polish ? "  no  period  %25s  %34s  %34s  error  closure  stability   symmetry\n"
                         : "  no  period  %10s  %18s  %24s  error  stability   symmetry  copies  t\n",
               "l", "x", "trace");
    for (size_t i = 0; i < f->count; i++) {
        print_orbit(r, i);
        copies += (size_t)f->orbit[i].copies;
        tori += f->orbit[i].torus;
    }
    if (f->count > 0) printf("with their copies by R, S1 S2 and T%s: %zu\n", r->all ? " (and S1)" : "", copies);
    if (tori > 0)
        printf(
            "k = %g: %zu of them lie on resonant tori, which are full of such orbits: the trace is 2, and they are "
            "degenerate\n",
            r->scene->params.k, tori);
}

/* --- JSON ------------------------------------------------------------------------------------------------------- */

static json_t *numbers(size_t count, const double x[])
{
    json_t *a = json_array();
    for (size_t i = 0; i < count; i++) json_array_append_new(a, json_number(x[i]));
    return a;
}

static json_t *pairs(size_t count, const double (*x)[2])
{
    json_t *a = json_array();
    for (size_t i = 0; i < count; i++) json_array_append_new(a, numbers(2, x[i]));
    return a;
}

static void put_clocks(json_t *o, const double clock[ISO_CLOCKS])
{
    for (iso_clock c = 0; c < ISO_CLOCKS; c++) json_object_set_new(o, iso_clock_name(c), json_number(clock[c]));
}

static void put_multipliers(json_t *o, const iso_multipliers *m)
{
    json_object_set_new(o, "stable", json_boolean(m->stability == ISO_STABLE));
    json_object_set_new(o, "stability", json_string(iso_stability_name(m->stability)));
    json_object_set_new(o, "multipliers", pairs(2, m->value));
    json_object_set_new(o, "krein", m->krein ? json_integer(m->krein) : json_null());
}

static void put_digits(json_t *o, const char *key, double head, double tail)
{
    char text[ISO_DIGITS_SIZE];
    iso_periodic_digits(head, tail, text);
    json_object_set_new(o, key, json_string(text));
}

static json_t *rotation_of(const periodic_report *r, int axis)
{
    const iso_rotation *a = &r->found->rotation[axis];
    json_t *o = json_pack("{s:i, s:o, s:o, s:o, s:o, s:o, s:o}", "axis", axis + 1, "half_turn_trace",
                          json_number(a->half_turn_trace), "error", json_number(a->error), "by_section",
                          json_number(a->by_section), "turn_trace", json_number(a->turn_trace), "l",
                          json_number(a->x < 1 ? a->l : NAN), "x", json_number(a->x));
    json_object_set_new(o, "oscillates", json_boolean(a->oscillates));
    if (a->oscillates) return o;
    put_multipliers(o, &a->half);
    put_clocks(o, a->clock);
    if (r->polish) put_digits(o, "half_turn_trace_digits", a->half_turn_trace, a->tail);
    return o;
}

static json_t *orbit_of(const periodic_report *r, size_t i)
{
    const iso_periodic_orbit *p = &r->found->orbit[i];
    char words[ISO_DIGITS_SIZE];
    iso_symmetry_words(p->symmetry, words);
    json_t *o = json_pack("{s:i, s:o, s:o, s:o, s:o, s:o, s:o, s:s, s:b}", "period", p->period, "l",
                          json_number(p->l), "x", json_number(p->x), "trace", json_number(p->trace), "error",
                          json_number(p->error), "closure", json_number(p->closure), "determinant",
                          json_number(1 + p->determinant), "symmetry", words, "torus", (int)p->torus);
    json_object_set_new(o, "line", p->line >= 0 ? json_string(iso_symmetry_line_name(p->line)) : json_null());
    put_clocks(o, p->clock);
    put_multipliers(o, &p->multipliers);
    json_object_set_new(o, "copies", pairs((size_t)p->copies, p->copy));
    json_object_set_new(o, "omega", numbers(3, p->ball));
    json_object_set_new(o, "n", numbers(3, p->ball + 3));
    json_object_set_new(o, "M", numbers(3, p->point));
    json_object_set_new(o, "gamma", numbers(3, p->point + 3));
    json_t *points = json_array();
    for (int n = 0; n < p->period; n++)
        json_array_append_new(points, numbers(2, p->half[n == 0 ? 2 * p->period - 1 : 2 * n - 1]));
    json_object_set_new(o, "points", points);
    if (!r->polish) return o;
    put_digits(o, "l_digits", p->l, p->l_tail);
    put_digits(o, "x_digits", p->x, p->x_tail);
    put_digits(o, "trace_digits", p->trace, p->trace_tail);
    return o;
}

bool periodic_print_json(const periodic_report *r)
{
    const iso_params *p = &r->scene->params;
    json_t *rotations = json_array(), *orbits = json_array();
    for (int a = 0; a < 3; a++) json_array_append_new(rotations, rotation_of(r, a));
    for (size_t i = 0; i < r->found->count; i++) json_array_append_new(orbits, orbit_of(r, i));
    json_t *o = json_pack("{s:s, s:o, s:o, s:o, s:{s:i}, s:i, s:o, s:o, s:I, s:I}", "isoroll", iso_version(), "k",
                          json_number(p->k), "J", numbers(3, p->J), "level", json_number(r->found->level), "section",
                          "axis", r->found->axis + 1, "longest_period", r->period, "rotations", rotations, "orbits",
                          orbits, "unresolved", (json_int_t)r->found->unresolved, "lost", (json_int_t)r->found->lost);
    return json_print(o);
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

static void write_rows(const periodic_report *r, FILE *to)
{
    for (size_t i = 0; i < r->found->count; i++) {
        const iso_periodic_orbit *o = &r->found->orbit[i];
        char words[ISO_DIGITS_SIZE];
        iso_symmetry_words(o->symmetry, words);
        fprintf(to, "%zu,%d,%.17g,%.17g,%.17g,%.3g,%s,%s,%d", i + 1, o->period, o->l, o->x, o->trace, o->error,
                iso_stability_name(o->multipliers.stability), words, o->copies);
        for (int c = 0; c < ISO_CLOCKS; c++) fprintf(to, ",%.17g", o->clock[c]);
        fprintf(to, ",%.3g", o->closure);
        for (int j = 0; j < ISO_STATE; j++) fprintf(to, ",%.17g", o->ball[j]);
        for (int j = 0; j < ISO_STATE; j++) fprintf(to, ",%.17g", o->point[j]);
        fputc('\n', to);
    }
}

iso_status periodic_write_csv(iso_context *ctx, const periodic_report *r, iso_output *to)
{
    const table_line lines[] = {{.key = "level", .number = r->found->level},
                                {.key = "longest_period", .number = r->period},
                                {.key = "axis", .number = r->found->axis + 1},
                                {.key = NULL}};
    const iso_status status =
        table_begin(ctx, to, "periodic", r->scene, lines,
                    "orbit,period,l,x,trace,error,stability,symmetry,copies,t,tau,s,closure,omega1,omega2,omega3,n1,"
                    "n2,n3,M1,M2,M3,gamma1,gamma2,gamma3");
    if (status == ISO_OK) write_rows(r, iso_output_stream(to));
    return table_end(ctx, to, status);
}

/* --- the picture ------------------------------------------------------------------------------------------------ */

typedef struct picture {
    double (*at)[2];
    uint32_t *orbit;
    bool *grey;
    size_t count;
} picture;

static void put_orbit(picture *p, const iso_periodic_orbit *o, size_t i)
{
    p->grey[i] = o->multipliers.stability == ISO_UNSTABLE || o->multipliers.stability == ISO_INVERSE_HYPERBOLIC;
    for (int n = 0; n < 16 * o->period; n++) { /* by S1 S2, R, T and S1 */
        const double *z = o->half[n / 8], sign = n & 1 ? -1 : 1;
        p->orbit[p->count] = (uint32_t)i;
        p->at[p->count][0] = remainder(sign * z[0] + (n & 2 ? acos(-1) : 0), 2 * acos(-1));
        p->at[p->count++][1] = (n & 4 ? -sign : sign) * z[1];
    }
}

iso_status periodic_draw(iso_context *ctx, const periodic_report *r, const char *path)
{
    const iso_periodic *f = r->found;
    const double *J = r->scene->params.J;
    size_t count = 0;
    for (size_t i = 0; i < f->count; i++) count += 16 * (size_t)f->orbit[i].period;
    picture p = {malloc(count * sizeof *p.at), malloc(count * sizeof *p.orbit), malloc(f->count * sizeof *p.grey), 0};
    char title[160];
    snprintf(title, sizeof title, "k = %.6g, J = %.6g %.6g %.6g: periodic orbits of %d returns at most",
             r->scene->params.k, J[0], J[1], J[2], r->period);
    iso_status status = p.at && p.orbit && p.grey ? ISO_OK : iso_context_no_memory(ctx, "a picture");
    for (size_t i = 0; i < f->count && status == ISO_OK; i++) put_orbit(&p, &f->orbit[i], i);
    const iso_plot_section plot = {.title = title,
                                   .params = &r->scene->params,
                                   .axis = f->axis,
                                   .count = p.count,
                                   .orbit = p.orbit,
                                   .ball = (const double(*)[2])p.at,
                                   .point = (const double(*)[2])p.at,
                                   .orbits = f->count,
                                   .grey = p.grey,
                                   .grey_means = "unstable"};
    if (status == ISO_OK) status = iso_plot_sections(ctx, path, &plot);
    free(p.at);
    free(p.orbit);
    free(p.grey);
    return status;
}

/* periodic_report.c - periodic orbits as a table, as rows and as a picture (see periodic_report.h). */
#include "periodic_report.h"

#include <math.h>
#include <stdlib.h>

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
           r->found->longest, f->count);
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

/* --- rows ------------------------------------------------------------------------------------------------------- */

iso_status periodic_write_csv(iso_context *ctx, const periodic_report *r, iso_output *to)
{
    const table_line lines[] = {{.key = "level", .number = r->found->level},
                                {.key = "longest_period", .number = r->found->longest},
                                {.key = "axis", .number = r->found->axis + 1},
                                {.key = NULL}};
    const iso_status status = table_begin(ctx, to, "periodic", r->scene, lines, iso_periodic_orbit_fields);
    for (size_t i = 0; status == ISO_OK && i < r->found->count; i++)
        iso_row_write(iso_output_stream(to), iso_periodic_orbit_fields, &r->found->orbit[i]);
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
             r->scene->params.k, J[0], J[1], J[2], r->found->longest);
    iso_status status =
        p.at && p.orbit && p.grey ? ISO_OK : iso_context_no_memory(ctx, "a picture");
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

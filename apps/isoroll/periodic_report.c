/* periodic_report.c - periodic orbits as a table, as rows and as a picture (see periodic.h). */
#include "periodic.h"

#include <math.h>

#include "plot/plot.h"
#include "study/fields_impl.h"
#include "table.h"

/* --- the table -------------------------------------------------------------------------------------------------- */

static void print_multipliers(const iso_multipliers *m)
{
    if (m->krein)
        printf("exp(+-%.9g i), Krein %+d", atan2(m->value[0][1], m->value[0][0]), m->krein);
    else
        printf("%.9g, %.9g", m->value[0][0], m->value[1][0]);
}

static void print_rotations(const iso_periodic *found, bool polish)
{
    printf("rotations about the principal axes, half a turn (Hill's equation)\n");
    printf("  axis  %-*s  error    %-10s  multipliers\n", polish ? 33 : 20, "trace", "");
    for (int a = 0; a < 3; a++) {
        const iso_rotation *o = &found->rotation[a];
        char text[ISO_DIGITS_SIZE];
        iso_periodic_digits(o->half_turn_trace, o->tail, text);
        printf("  %4d  ", a + 1);
        if (o->oscillates) {
            printf("none on this level: an oscillation between two places of rest\n");
            continue;
        }
        polish ? printf("%-33s", text) : printf("%-20.15g", o->half_turn_trace);
        printf("  %.1e  %-10s  ", o->error, iso_stability_name(o->half.stability));
        print_multipliers(&o->half);
        putchar('\n');
    }
}

static void print_orbit(const iso_periodic *found, bool polish, size_t i)
{
    const iso_periodic_orbit *o = &found->orbit[i];
    char words[ISO_DIGITS_SIZE], l[ISO_DIGITS_SIZE], x[ISO_DIGITS_SIZE], trace[ISO_DIGITS_SIZE];
    iso_symmetry_words(o->symmetry, words);
    if (!polish) {
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

void periodic_print(const periodic_options *o, const iso_scene *scene, const iso_periodic *f)
{
    const double *J = scene->params.J;
    size_t copies = 0, tori = 0;
    printf("k = %.15g, J = %.15g %.15g %.15g; section n_%d = 0, n_%d increasing\n", scene->params.k, J[0], J[1], J[2],
           f->axis + 1, f->axis + 1);
    if (f->level != 0) printf("level of the point, (H/eps) J2^(1/k): %.15g\n", f->level);
    putchar('\n');
    print_rotations(f, o->study.polish);
    printf("\n%s orbits of %d returns at most, but the rotations: %zu\n",
           o->study.all ? "periodic" : "symmetric periodic", f->longest, f->count);
    if (f->count > 0)
        printf(o->study.polish ? "  no  period  %25s  %34s  %34s  error  closure  stability   symmetry\n"
                               : "  no  period  %10s  %18s  %24s  error  stability   symmetry  copies  t\n",
               "l", "x", "trace");
    for (size_t i = 0; i < f->count; i++) {
        print_orbit(f, o->study.polish, i);
        copies += (size_t)f->orbit[i].copies;
        tori += f->orbit[i].torus;
    }
    if (f->count > 0) printf("with their copies by R, S1 S2 and T%s: %zu\n", o->study.all ? " (and S1)" : "", copies);
    if (tori > 0)
        printf(
            "k = %g: %zu of them lie on resonant tori, which are full of such orbits: the trace is 2, and they are "
            "degenerate\n",
            scene->params.k, tori);
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

iso_status periodic_table(iso_context *ctx, const iso_scene *scene, const iso_periodic *found, bool whole,
                          iso_record **table)
{
    char title[ISO_PLOT_TITLE];
    iso_plot_title(title, &scene->params, ": periodic orbits of %d returns at most", found->longest);
    const table_line lines[] = {{.key = "level", .number = found->level},
                                {.key = "longest_period", .number = found->longest},
                                {.key = "axis", .number = found->axis + 1},
                                {.key = whole ? "title" : NULL, .text = title},
                                {.key = NULL}};
    iso_status status = table_create(ctx, "periodic", scene, lines, iso_periodic_orbit_fields, table);
    for (size_t i = 0; i < found->count; i++) {
        iso_periodic_orbit o = found->orbit[i];
        for (int n = 0; status == ISO_OK && n < (whole ? 2 * o.period : 1); n++) {
            if (whole) o.l = found->orbit[i].half[n][0], o.x = found->orbit[i].half[n][1];
            status = iso_columns_append(ctx, iso_periodic_orbit_fields, &o, *table);
        }
    }
    return status;
}

/* periodic_print.c - the text of periodic: the list, branches, the chart (study/study.h). */
#include <math.h>
#include <stdio.h>

#include "base/number_impl.h"
#include "instrument/periodic/periodic_study_impl.h"
#include "study/study_impl.h"

static void print_level(FILE *to, double level)
{
    if (level != 0) fprintf(to, "level of the point, (H/eps) J2^(1/k): %s\n", ISO_SHORT(level));
}

static void print_rotations(FILE *to, const iso_periodic *found, bool polish)
{
    fputs("rotations about the principal axes, half a turn (Hill's equation)\n", to);
    iso_table_begin(to, 1);
    fputs("axis\ttrace\terror\tstability\tmultipliers\n", to);
    for (int a = 0; a < 3; a++) {
        const iso_rotation *o = &found->rotation[a];
        char text[ISO_DIGITS_SIZE];
        iso_periodic_digits(o->half_turn_trace, o->tail, text);
        if (o->oscillates) {
            fprintf(to, "%d\tnone on this level: an oscillation between two places of rest\n", a + 1);
            continue;
        }
        fprintf(to, "%d\t%s\t%.1e\t%s\t", a + 1, polish ? text : ISO_ROUNDED(o->half_turn_trace, 15), o->error,
                iso_stability_name((int)o->half.stability));
        const iso_multipliers *m = &o->half;
        if (m->krein)
            fprintf(to, "exp(+-%.9g i), Krein %+d\n", atan2(m->value[0][1], m->value[0][0]), m->krein);
        else
            fprintf(to, "%.9g, %.9g\n", m->value[0][0], m->value[1][0]);
    }
    iso_table_end(to);
}

static void print_orbit(FILE *to, const iso_periodic_orbit *o, bool polish)
{
    const char *stability = iso_stability_name((int)o->multipliers.stability);
    char symmetry[ISO_DIGITS_SIZE], l[ISO_DIGITS_SIZE], x[ISO_DIGITS_SIZE], trace[ISO_DIGITS_SIZE];
    iso_symmetry_text(o->symmetry, symmetry);
    iso_periodic_digits(o->l, o->l_tail, l);
    iso_periodic_digits(o->x, o->x_tail, x);
    iso_periodic_digits(o->trace, o->trace_tail, trace);
    if (polish)
        fprintf(to, "%zu\t%d\t%s\t%s\t%s\t%.0e\t%.0e\t%s\t%s\n", o->number, o->period, l, x, trace, o->error,
                o->closure, stability, symmetry);
    else
        fprintf(to, "%zu\t%d\t%.15f\t%.15f\t%.11g\t%.0e\t%s\t%s\t%d\t%.9g\n", o->number, o->period, o->l, o->x,
                o->trace, o->error, stability, symmetry, o->copies, o->clock[0]);
}

static void print_list(FILE *to, const iso_params *p, const iso_periodic_options *how, const iso_periodic *f)
{
    size_t copies = 0, tori = 0;
    iso_params_print(to, p);
    fprintf(to, "; section n_%d = 0, n_%d increasing\n", f->axis + 1, f->axis + 1);
    print_level(to, f->level);
    fputs("\n", to);
    print_rotations(to, f, how->polish);
    fprintf(to, "\n%s orbits of %d returns at most, but the rotations: %zu\n",
            how->all ? "periodic" : "symmetric periodic", f->longest, f->count);
    if (f->count > 0) {
        iso_table_begin(to, 2);
        fprintf(to, "no\tperiod\tl\tx\ttrace\terror\t%s\n",
                how->polish ? "closure\tstability\tsymmetry" : "stability\tsymmetry\tcopies\tt");
    }
    for (size_t i = 0; i < f->count; i++) {
        print_orbit(to, &f->orbit[i], how->polish);
        copies += (size_t)f->orbit[i].copies;
        tori += f->orbit[i].torus;
    }
    if (f->count > 0) iso_table_end(to);
    if (f->count > 0)
        fprintf(to, "with their copies by R, S1 S2 and T%s: %zu\n", how->all ? " (and S1)" : "", copies);
    if (tori > 0)
        fprintf(
            to,
            "k = %s: %zu of them lie on resonant tori, which are full of such orbits: the trace is 2, and they are "
            "degenerate\n",
            ISO_SHORT(p->k), tori);
}

static void print_branches(FILE *to, const iso_continuations *f)
{
    const char *name = iso_vary_name((int)f->vary);
    for (const iso_branch *b = f->branch; b < f->branch + f->count; b++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t j = 0; j < b->points; j++)
            low = fmin(low, b->point[j].value), high = fmax(high, b->point[j].value);
        fprintf(to, "\nbranch %zu: period %d, on the line of %s, %s from %.12g to %.12g, %zu points",
                (size_t)(b - f->branch) + 1, b->period, iso_symmetry_line_name(b->line), name, low, high, b->points);
        if (b->parent >= 0) fprintf(to, ", from branch %d", b->parent + 1);
        fputs("\n", to);
        if (b->events == 0) continue;
        iso_table_begin(to, 1);
        fprintf(to, "event\t%s\tl\tx\ttrace\twhat happens\n", name);
        for (const iso_branch_event *e = b->event; e < b->event + b->events; e++)
            fprintf(to, "%s\t%.13g\t%.9g\t%.9g\t%.8g\t%s\n", iso_branch_kind_name((int)e->kind), e->at.value, e->at.l,
                    e->at.x, e->at.trace, e->text);
        iso_table_end(to);
    }
}

#define EDGE 1e-9 /* with equal moments a trace is 2 or -2 up to rounding */

static void print_chart(FILE *to, const iso_chart_found *f)
{
    const iso_stability_options *o = &f->how;
    const iso_record *grid = f->grid;
    size_t count[2][3] = {{0}}, none[2] = {0};
    static const char *const axes[] = {"least", "greatest"};
    for (size_t i = 0; i < iso_record_rows(grid); i++)
        for (int which = 0; which < 2; which++) {
            const double T = iso_record_const_row(grid, i)[2 + which];
            if (!isnan(T))
                count[which][T < -2 - EDGE ? 0 : T > 2 + EDGE ? 2 : 1]++;
            else
                none[which] += fabs(iso_record_const_row(grid, i)[0]) >= ISO_LEAST_K;
        }
    fprintf(to, "k from %s to %s, %s from %s to %s; share of the grid points\n", ISO_SHORT(o->from[0]),
            ISO_SHORT(o->to[0]), iso_chart_name(o->moment), ISO_SHORT(o->from[1]), ISO_SHORT(o->to[1]));
    iso_table_begin(to, 1);
    fputs("rotation about\tT < -2\tstable\tT > 2\n", to);
    for (int which = 0; which < 2; which++) {
        const double all = (double)(count[which][0] + count[which][1] + count[which][2]);
        fprintf(to, "%s moment\t%.4f\t%.4f\t%.4f\n", axes[which], (double)count[which][0] / all,
                (double)count[which][1] / all, (double)count[which][2] / all);
    }
    iso_table_end(to);
    print_level(to, o->level);
    for (int which = 0; which < 2; which++)
        if (none[which] > 0)
            fprintf(to,
                    "left out: %zu grid points, where there is no rotation about the axis of the %s moment, but an "
                    "oscillation between two places of rest\n",
                    none[which], axes[which]);
    fprintf(to, "%zu points of the borders T = 2 and T = -2: see -o, --json and --plot\n",
            iso_record_rows(f->borders));
}

static iso_status describe_chart(iso_context *ctx, const iso_study_result *result)
{
    const iso_stability_options *o = &((const iso_chart_found *)result->found)->how;
    const double *J = o->J;
    const int a = o->moment == 0 ? 1 : 0, b = o->moment == 2 ? 1 : 2; /* the other moments */
    char level[48] = "";
    if (o->moment == ISO_CHART_LEVEL)
        return iso_study_title(ctx, result, "stable rotations: J = (%.6g, %.6g, %.6g)", J[0], J[1], J[2]);
    if (o->level != 0) snprintf(level, sizeof level, ", level %.6g", o->level);
    ISO_TRY(iso_record_set_numbers(ctx, result->table[0], "level", 1, &o->level));
    return iso_study_title(ctx, result, "stable rotations: J%d = %.6g, J%d = %.6g%s", a + 1, J[a], b + 1, J[b],
                           level);
}

void iso_periodic_print(FILE *to, const iso_scene *scene, const void *options, const iso_study_result *result)
{
    const iso_periodic_request *r = options;
    if (r->chart)
        print_chart(to, result->found);
    else if (r->follow)
        print_branches(to, result->found);
    else
        print_list(to, &scene->params, &r->how, result->found);
}

iso_status iso_periodic_describe(iso_context *ctx, const iso_scene *scene, const void *options,
                                 iso_study_result *result)
{
    const iso_periodic_request *r = options;
    char ball[ISO_BALL_SIZE];
    if (r->chart) return describe_chart(ctx, result);
    iso_ball_text(ball, &scene->params);
    if (r->follow)
        return iso_study_title(ctx, result, "%s: periodic orbits followed along %s", ball,
                               iso_vary_name((int)((const iso_continuations *)result->found)->vary));
    const iso_periodic *f = result->found;
    const double longest = f->longest, axis = f->axis + 1;
    ISO_TRY(iso_record_set_numbers(ctx, result->table[0], "level", 1, &f->level));
    ISO_TRY(iso_record_set_numbers(ctx, result->table[0], "longest_period", 1, &longest));
    ISO_TRY(iso_record_set_numbers(ctx, result->table[0], "axis", 1, &axis));
    return iso_study_title(ctx, result, "%s: periodic orbits of %d returns at most", ball, f->longest);
}

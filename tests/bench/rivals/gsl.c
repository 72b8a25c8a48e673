/* gsl.c - GSL's rk8pd: an orbit to its end, kept steps for any time, and crossings with variations. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <stdlib.h>
#include <string.h>

#include "crossing.h"
#include "rivals.h"

static int slopes(double t, const double y[], double dy[], void *problem)
{
    (void)t;
    rival_rhs(problem, y, dy);
    return GSL_SUCCESS;
}

static int varied(double t, const double y[], double dy[], void *problem)
{
    (void)t;
    rival_varied(problem, y, dy);
    return GSL_SUCCESS;
}

typedef struct loop {
    gsl_odeiv2_system system;
    gsl_odeiv2_step *step;
    gsl_odeiv2_control *control;
    gsl_odeiv2_evolve *evolve;
} loop;

static void begin(loop *l, const rival_problem *p, double tolerance)
{
    const size_t size = 6 + 6 * (size_t)p->variations;
    l->system = (gsl_odeiv2_system){p->variations > 0 ? varied : slopes, NULL, size,
                                    (rival_problem *)p}; /* GSL's data is not const */
    l->step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size);
    l->control = gsl_odeiv2_control_standard_new(tolerance, tolerance, 1, 0);
    l->evolve = gsl_odeiv2_evolve_alloc(size);
}

static void end(loop *l)
{
    gsl_odeiv2_evolve_free(l->evolve);
    gsl_odeiv2_control_free(l->control);
    gsl_odeiv2_step_free(l->step);
}

bool rival_gsl_rk8pd(const rival_problem *p, double tolerance, double end_time, double y[6])
{
    loop l;
    double t = 0, h = 0.01;
    int status = GSL_SUCCESS;
    begin(&l, p, tolerance);
    for (long n = 0; t < end_time && (double)n < RIVAL_STEPS * end_time && status == GSL_SUCCESS; n++)
        status = gsl_odeiv2_evolve_apply(l.evolve, l.control, l.step, &l.system, &t, end_time, &h, y);
    end(&l);
    return t >= end_time && status == GSL_SUCCESS;
}

/* --- any time --------------------------------------------------------------------------------------------------- */

typedef struct kept {
    double t, y[6], slope[6];
} kept;

struct rival_path {
    rival_problem problem;
    loop loop;
    double h;
    size_t count, room;
    kept *kept;
};

rival_path *rival_path_create(const rival_problem *p, double tolerance, const double y[6])
{
    rival_path *path = calloc(1, sizeof *path);
    if (!path) return NULL;
    path->problem = *p;
    path->h = 0.01;
    path->count = 1, path->room = 1024;
    path->kept = malloc(path->room * sizeof *path->kept);
    if (!path->kept) return free(path), NULL;
    begin(&path->loop, &path->problem, tolerance);
    path->kept[0].t = 0;
    memcpy(path->kept[0].y, y, sizeof path->kept[0].y);
    path->problem.variations = 0;
    rival_rhs(&path->problem, y, path->kept[0].slope);
    return path;
}

/* One step more at the end. */
static bool lengthen(rival_path *path)
{
    loop *l = &path->loop;
    if (path->count == path->room) {
        kept *more = realloc(path->kept, 2 * path->room * sizeof *more);
        if (!more) return false;
        path->kept = more;
        path->room *= 2;
    }
    kept *next = &path->kept[path->count];
    *next = path->kept[path->count - 1];
    const int status =
        gsl_odeiv2_evolve_apply(l->evolve, l->control, l->step, &l->system, &next->t, INFINITY, &path->h, next->y);
    memcpy(next->slope, l->evolve->dydt_out, sizeof next->slope);
    path->count += status == GSL_SUCCESS;
    return status == GSL_SUCCESS;
}

bool rival_path_at(rival_path *path, double t, double y[6])
{
    double error[6];
    while (path->kept[path->count - 1].t < t)
        if (!lengthen(path)) return false;
    size_t low = 0, high = path->count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(path->kept[middle].t <= t ? &low : &high) = middle;
    }
    const kept *from = &path->kept[low];
    memcpy(y, from->y, sizeof from->y);
    return gsl_odeiv2_step_apply(path->loop.step, 0, t - from->t, y, error, from->slope, NULL, &path->loop.system) ==
           GSL_SUCCESS;
}

void rival_path_free(rival_path *path)
{
    if (!path) return;
    end(&path->loop);
    free(path->kept);
    free(path);
}

/* --- crossings -------------------------------------------------------------------------------------------------- */

/* The crossing within the last step, of length h from `old`, where the slope was `slope`: a step to the zero of the
 * cubic, and from there along the tangent. Gives its time after the old one; y is its state. */
static double refine(loop *l, int i, const double old[], const double slope[], double h, const double y_end[],
                     double y[])
{
    double error[RIVAL_MOST], out[RIVAL_MOST];
    double x = rival_cubic_root(old[i], slope[i], y_end[i], l->evolve->dydt_out[i], h), more;
    for (int n = 0;; n++) {
        memcpy(y, old, l->system.dimension * sizeof *y);
        gsl_odeiv2_step_apply(l->step, 0, x, y, error, slope, out, &l->system);
        more = -y[i] / out[i];
        x += more;
        if (fabs(more) < 1e-7 || n == 5) break; /* the rest of the tangent is of the order of its square */
    }
    for (size_t j = 0; j < l->system.dimension; j++) y[j] += more * out[j];
    return x;
}

bool rival_follow_gsl(const rival_problem *p, int axis, double tolerance, int turns, const double start[],
                      rival_seen *seen, void *data)
{
    loop l;
    double y[RIVAL_MOST], old[RIVAL_MOST], slope[RIVAL_MOST], crossing[RIVAL_MOST], growth[2] = {0, 0};
    double t = 0, h = 0.01;
    const int height = 3 + axis; /* the place in y */
    int found = 0;
    begin(&l, p, tolerance);
    memcpy(y, start, l.system.dimension * sizeof *y);
    while (found < turns) {
        const double t_old = t;
        memcpy(old, y, l.system.dimension * sizeof *y);
        if (gsl_odeiv2_evolve_apply(l.evolve, l.control, l.step, &l.system, &t, INFINITY, &h, y) != GSL_SUCCESS)
            break;
        if (t_old > 0 && old[height] < 0 && y[height] >= 0) {
            memcpy(slope, l.evolve->dydt_in, l.system.dimension * sizeof *slope);
            const double x = refine(&l, height, old, slope, t - t_old, y, crossing);
            seen(data, found++, t_old + x, crossing, growth);
            if (rival_shorten(y, l.system.dimension, growth))
                gsl_odeiv2_evolve_reset(l.evolve), gsl_odeiv2_step_reset(l.step);
        }
    }
    end(&l);
    return found == turns;
}

#include "sections.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <string.h>

static int ball(double t, const double y[], double dy[], void *data)
{
    (void)t;
    rival_ball(data, y, dy);
    return GSL_SUCCESS;
}

static int point(double t, const double y[], double dy[], void *data)
{
    (void)t;
    rival_point(data, y, dy);
    return GSL_SUCCESS;
}

typedef struct loop {
    gsl_odeiv2_system system;
    gsl_odeiv2_step *step;
    gsl_odeiv2_control *control;
    gsl_odeiv2_evolve *evolve;
    int height; /* the place in y */
} loop;

static void begin(loop *l, const rival_problem *p, bool is_point, int axis, double tolerance)
{
    rival_problem *data = (rival_problem *)p; /* GSL's data is not const */
    const size_t size = 6 + 6 * (is_point ? (size_t)p->variations : 0);
    l->system = (gsl_odeiv2_system){is_point ? point : ball, NULL, size, data};
    l->step = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size);
    l->control = gsl_odeiv2_control_standard_new(tolerance, tolerance, 1, 0);
    l->evolve = gsl_odeiv2_evolve_alloc(size);
    l->height = 3 + axis;
}

static void end(loop *l)
{
    gsl_odeiv2_evolve_free(l->evolve);
    gsl_odeiv2_control_free(l->control);
    gsl_odeiv2_step_free(l->step);
}

/* The x in [0, h] where the cubic that has the two values and slopes is 0. */
static double cubic_root(double before, double slope, double after, double slope_after, double h)
{
    double low = 0, high = 1, x = before / (before - after);
    const double a = h * slope, b = h * slope_after;
    for (int i = 0; i < 60 && high - low > 1e-15; i++) {
        const double y = 1 - x;
        const double value = y * y * ((1 + 2 * x) * before + x * a) + x * x * ((3 - 2 * x) * after - y * b);
        const double rate = 6 * x * y * (after - before) + y * (1 - 3 * x) * a + x * (3 * x - 2) * b;
        *(value < 0 ? &low : &high) = x;
        const double next = x - value / rate;
        if (fabs(next - x) < 1e-14) break;
        x = next > low && next < high ? next : (low + high) / 2;
    }
    return h * x;
}

/* The crossing within the last step, of length h from `old`, where the slope was `slope`: a step to the zero of the
 * cubic, and from there along the tangent. Gives its time after the old one; y is its state. */
static double refine(loop *l, const double old[], const double slope[], double h, const double y_end[], double y[])
{
    double error[RIVAL_MOST], out[RIVAL_MOST];
    const int i = l->height;
    double x = cubic_root(old[i], slope[i], y_end[i], l->evolve->dydt_out[i], h), more;
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

/* Makes long variations as long as 1, and forgets the slopes of the old ones. */
static void shorten(loop *l, double y[], double growth[2])
{
    bool changed = false;
    for (size_t v = 1; 6 * v < l->system.dimension; v++) {
        double square = 0;
        for (size_t i = 6 * v; i < 6 * v + 6; i++) square += y[i] * y[i];
        if (square < 1e8) continue;
        for (size_t i = 6 * v; i < 6 * v + 6; i++) y[i] /= sqrt(square);
        growth[v - 1] += log(square) / 2;
        changed = true;
    }
    if (changed) gsl_odeiv2_evolve_reset(l->evolve), gsl_odeiv2_step_reset(l->step);
}

bool rival_follow(const rival_problem *p, bool is_point, int axis, double tolerance, int turns, const double start[],
                  rival_seen *seen, void *data)
{
    loop l;
    double y[RIVAL_MOST], old[RIVAL_MOST], slope[RIVAL_MOST], crossing[RIVAL_MOST], growth[2] = {0, 0};
    double t = 0, h = 0.01;
    int found = 0;
    begin(&l, p, is_point, axis, tolerance);
    memcpy(y, start, l.system.dimension * sizeof *y);
    while (found < turns) {
        const double t_old = t;
        memcpy(old, y, l.system.dimension * sizeof *y);
        if (gsl_odeiv2_evolve_apply(l.evolve, l.control, l.step, &l.system, &t, INFINITY, &h, y) != GSL_SUCCESS)
            break;
        if (t_old > 0 && old[l.height] < 0 && y[l.height] >= 0) {
            memcpy(slope, l.evolve->dydt_in, l.system.dimension * sizeof *slope);
            const double x = refine(&l, old, slope, t - t_old, y, crossing);
            seen(data, found++, t_old + x, crossing, growth);
            shorten(&l, y, growth);
        }
    }
    end(&l);
    return found == turns;
}

/* integrals_impl.h - conditions under which first integrals hold, shared by both systems' tables. */
#ifndef ISO_MODEL_INTEGRALS_IMPL_H
#define ISO_MODEL_INTEGRALS_IMPL_H

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/model_impl.h"

static inline bool holds_plane(const iso_problem *f)
{
    return f->p.k == 1 && iso_effects_keep(f, ISO_F_PLANE);
}

static inline bool holds_shell(const iso_problem *f)
{
    return f->p.k == -1 && iso_effects_keep(f, ISO_F_SHELL);
}

/* The body is symmetric about an axis, and the effects as well. */
static inline bool holds_axis(const iso_problem *f, int axis)
{
    return iso_params_symmetric(&f->p, axis) && iso_effects_keep(f, (iso_additional)(ISO_F_AXIS1 + axis));
}

/* |n| or |gamma| */
static inline double unit_length(const iso_problem *f, const double y[], double *size)
{
    (void)f;
    *size = 1;
    return norm(y + 3);
}

/* The same as functions of rows, for axis i = 1, 2, 3, and the integral f_axis(f, y, axis, size) of the file. */
#define ISO_OF_AXIS(i)                                                                                               \
    static bool holds_axis##i(const iso_problem *f)                                                                  \
    {                                                                                                                \
        return holds_axis(f, i - 1);                                                                                 \
    }                                                                                                                \
    static double f_axis##i(const iso_problem *f, const double y[], double *size)                                    \
    {                                                                                                                \
        return f_axis(f, y, i - 1, size);                                                                            \
    }

/* An integral `name` of the ball, and the same of its point, by the map (18); call: its value, from f, ball, size. */
#define ISO_OF_BALL_AND_POINT(name, call)                                                                            \
    static double name(const iso_problem *f, const double ball[], double *size)                                      \
    {                                                                                                                \
        return call;                                                                                                 \
    }                                                                                                                \
    static double name##_of_point(const iso_problem *f, const double y[], double *size)                              \
    {                                                                                                                \
        double ball[ISO_STATE];                                                                                      \
        iso_point_to_point_in_t(&f->p, y, ball);                                                                     \
        iso_point_in_t_to_ball(&f->p, ball, ball);                                                                   \
        return call;                                                                                                 \
    }

/* A row: name, dimension, value, further members; and that of F_axis i. */
#define ISO_INTEGRAL(name_, a, b, c, value_, ...)                                                                    \
    {                                                                                                                \
        .name = name_, .dimension = {a, b, c}, .value = value_, __VA_ARGS__                                          \
    }
#define ISO_AXIS_INTEGRAL(i, doc_) ISO_INTEGRAL("F_axis" #i, 0, -1, 1, f_axis##i, .holds = holds_axis##i, .doc = doc_)

#endif

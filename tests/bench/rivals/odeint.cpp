// odeint.cpp - Boost.odeint: Runge-Kutta-Fehlberg 7(8) and Bulirsch-Stoer, with steps that the library chooses: an
// orbit to its end, and crossings with variations.
#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>

#include "crossing.h"
#include "rivals.h"

namespace ode = boost::numeric::odeint;

namespace
{

using state = std::array<double, 6>;

template <class Stepper> bool solve(Stepper stepper, const rival_problem *p, double end, double y[6])
{
    const auto equations = [p](const state &at, state &slope, double) { rival_rhs(p, at.data(), slope.data()); };
    state at;
    std::copy(y, y + 6, at.begin());
    double t = 0, h = 0.01;
    for (long n = 0; t < end && (double)n < double{RIVAL_STEPS} * end; n++) {
        if (t + h > end) h = end - t;
        if (t + h == t) return false;
        stepper.try_step(equations, at, t, h);
    }
    std::copy(at.begin(), at.end(), y);
    return t >= end;
}

// --- crossings ------------------------------------------------------------------------------------------------------

template <std::size_t N> using many = std::array<double, N>;

// Fehlberg has no dense output: a crossing is reached by a shorter step from the start of the last one.
template <std::size_t N> class fehlberg_steps
{
    ode::runge_kutta_fehlberg78<many<N>> plain;
    decltype(ode::make_controlled(0.0, 0.0, plain)) controlled;

  public:
    explicit fehlberg_steps(double tolerance) : controlled(ode::make_controlled(tolerance, tolerance, plain))
    {
    }

    void begin(const many<N> &, double, double)
    {
    }

    template <class Equations>
    bool step(const Equations &equations, const many<N> &old, many<N> &y, double &t, double &h)
    {
        y = old;
        for (int n = 0; n < 100; n++)
            if (controlled.try_step(equations, y, t, h) == ode::success) return true;
        return false;
    }

    template <class Equations>
    void at(const Equations &equations, const many<N> &old, double t_old, double x, many<N> &y)
    {
        plain.do_step(equations, old, t_old, y, x);
    }
};

// The state anywhere within a step of Bulirsch and Stoer is its dense output.
template <std::size_t N> class stoer_steps
{
    ode::bulirsch_stoer_dense_out<many<N>> dense;

  public:
    explicit stoer_steps(double tolerance) : dense(tolerance, tolerance)
    {
    }

    void begin(const many<N> &y, double t, double h)
    {
        dense.initialize(y, t, h);
    }

    template <class Equations>
    bool step(const Equations &equations, const many<N> &, many<N> &y, double &t, double &h)
    {
        t = dense.do_step(equations).second;
        y = dense.current_state();
        h = dense.current_time_step();
        return true;
    }

    template <class Equations> void at(const Equations &, const many<N> &, double t_old, double x, many<N> &y)
    {
        dense.calc_state(t_old + x, y);
    }
};

// From the zero of a cubic by Newton's method. Gives the time of the crossing after the start of the step.
template <std::size_t N, class Steps, class Equations>
double refine(Steps &steps, const Equations &equations, std::size_t i, const many<N> &old, double t_old,
              const many<N> &end, double h, many<N> &y)
{
    many<N> slope, slope_end;
    equations(old, slope, 0);
    equations(end, slope_end, 0);
    double x = rival_cubic_root(old[i], slope[i], end[i], slope_end[i], h), more;
    for (int n = 0;; n++) {
        steps.at(equations, old, t_old, x, y);
        equations(y, slope, 0);
        more = -y[i] / slope[i];
        x += more;
        if (std::fabs(more) < 1e-7 || n == 5) break; // the rest of the tangent is of the order of its square
    }
    for (std::size_t j = 0; j < N; j++) y[j] += more * slope[j];
    return x;
}

template <std::size_t N, class Steps>
bool follow(Steps steps, const rival_problem *p, int axis, int turns, const double start[], rival_seen *seen,
            void *data)
{
    const auto equations = [p](const many<N> &at, many<N> &slope, double) {
        if constexpr (N == 6)
            rival_rhs(p, at.data(), slope.data());
        else
            rival_varied(p, at.data(), slope.data());
    };
    const std::size_t height = 3 + (std::size_t)axis;
    many<N> y, old, crossing;
    double t = 0, h = 0.01, growth[2] = {0, 0};
    std::copy(start, start + N, y.begin());
    steps.begin(y, t, h);
    for (int found = 0; found < turns;) {
        const double t_old = t;
        old = y;
        if (!steps.step(equations, old, y, t, h)) return false;
        if (t_old == 0 || old[height] >= 0 || y[height] < 0) continue;
        const double x = refine(steps, equations, height, old, t_old, y, t - t_old, crossing);
        seen(data, found++, t_old + x, crossing.data(), growth);
        if (rival_shorten(y.data(), N, growth)) steps.begin(y, t, h);
    }
    return true;
}

// The numbers of a state: with none or with two variations.
template <template <std::size_t> class Steps>
bool follow_any(const rival_problem *p, int axis, double tolerance, int turns, const double y[], rival_seen *seen,
                void *data)
{
    return p->variations == 0 ? follow<6>(Steps<6>(tolerance), p, axis, turns, y, seen, data)
                              : follow<RIVAL_MOST>(Steps<RIVAL_MOST>(tolerance), p, axis, turns, y, seen, data);
}

} // namespace

bool rival_odeint_fehlberg(const rival_problem *p, double tolerance, double end, double y[6])
{
    return solve(ode::make_controlled(tolerance, tolerance, ode::runge_kutta_fehlberg78<state>()), p, end, y);
}

bool rival_odeint_stoer(const rival_problem *p, double tolerance, double end, double y[6])
{
    return solve(ode::bulirsch_stoer<state>(tolerance, tolerance), p, end, y);
}

bool rival_follow_fehlberg(const rival_problem *p, int axis, double tolerance, int turns, const double y[],
                           rival_seen *seen, void *data)
{
    return follow_any<fehlberg_steps>(p, axis, tolerance, turns, y, seen, data);
}

bool rival_follow_stoer(const rival_problem *p, int axis, double tolerance, int turns, const double y[],
                        rival_seen *seen, void *data)
{
    return follow_any<stoer_steps>(p, axis, tolerance, turns, y, seen, data);
}

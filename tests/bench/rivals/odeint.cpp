// odeint.cpp - Boost.odeint: Runge-Kutta-Fehlberg 7(8) and Bulirsch-Stoer, with steps that the library chooses.
#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>

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

} // namespace

bool rival_odeint_fehlberg(const rival_problem *p, double tolerance, double end, double y[6])
{
    return solve(ode::make_controlled(tolerance, tolerance, ode::runge_kutta_fehlberg78<state>()), p, end, y);
}

bool rival_odeint_stoer(const rival_problem *p, double tolerance, double end, double y[6])
{
    return solve(ode::bulirsch_stoer<state>(tolerance, tolerance), p, end, y);
}

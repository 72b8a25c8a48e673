#include "model/model.h"

#include <math.h>

#include "base/vec3_impl.h"

static void rhs_own_clock(const iso_model *m, const double y[], double dy[])
{
    m->system->rhs(&m->field, y, dy);
}

static void jacobian_own_clock(const iso_model *m, const double y[], double jac[])
{
    m->system->jacobian(&m->field, y, jac);
}

/* d(clock)/d(independent variable) at q, and the exponent of q in it */
static double rate(const iso_model *m, iso_clock clock, double q, double *exponent)
{
    double e, e_independent;
    const double numerator = iso_clock_rate(&m->field.p, clock, q, &e);
    const double denominator = iso_clock_rate(&m->field.p, m->clock, q, &e_independent);
    *exponent = e - e_independent;
    return numerator / denominator;
}

static void rhs_clocks(const iso_model *m, const double y[], double dy[])
{
    double exponent;
    const double q = m->system->q(&m->field.p, y, NULL);
    m->system->rhs(&m->field, y, dy);
    if (m->clock != m->system->clock) {
        const double r = rate(m, m->system->clock, q, &exponent);
        for (int i = 0; i < ISO_STATE; i++) dy[i] *= r;
    }
    for (int c = 0; c < m->carried; c++) dy[ISO_STATE + c] = rate(m, m->carry[c], q, &exponent);
}

/* With r = r(q) ~ q^e:  d(r f_i)/dy_j = r df_i/dy_j + f_i (e r/q) dq/dy_j, and the last term alone for a clock. */
static void jacobian_clocks(const iso_model *m, const double y[], double jac[])
{
    double f[ISO_STATE], own[ISO_STATE * ISO_STATE], dq[ISO_STATE], exponent;
    const double q = m->system->q(&m->field.p, y, dq);
    m->system->rhs(&m->field, y, f);
    m->system->jacobian(&m->field, y, own);
    for (int i = 0; i < m->dim * m->dim; i++) jac[i] = 0;
    const double r = rate(m, m->system->clock, q, &exponent);
    for (int i = 0; i < ISO_STATE; i++)
        for (int j = 0; j < ISO_STATE; j++)
            jac[m->dim * i + j] = r * (own[ISO_STATE * i + j] + f[i] * exponent / q * dq[j]);
    for (int c = 0; c < m->carried; c++) {
        const double r_c = rate(m, m->carry[c], q, &exponent);
        for (int j = 0; j < ISO_STATE; j++) jac[m->dim * (ISO_STATE + c) + j] = r_c * exponent / q * dq[j];
    }
}

iso_model iso_model_assemble(const iso_system *system, const iso_field *field, iso_clock clock,
                             const bool carry[ISO_CLOCKS])
{
    iso_model m = {.system = system, .field = *field, .clock = clock};
    for (iso_clock c = 0; c < ISO_CLOCKS; c++)
        if (carry[c] && c != clock) m.carry[m.carried++] = c;
    const bool plain = clock == system->clock && m.carried == 0;
    m.dim = ISO_STATE + m.carried;
    m.rhs = plain ? rhs_own_clock : rhs_clocks;
    m.jacobian = plain ? jacobian_own_clock : jacobian_clocks;
    return m;
}

double iso_model_project(const iso_model *m, double y[])
{
    return m->system->project(&m->field, y);
}

void iso_model_size(const iso_model *m, const double y[], double size[])
{
    /* a state at rest has no size: any positive number does, since nothing moves */
    const double speed = fmax(m->system->speed(&m->field, y), 1e-100);
    const double length = norm(y + 3);
    for (int i = 0; i < 3; i++) {
        size[i] = speed;
        size[3 + i] = length;
    }
    if (m->carried == 0) return;
    const double q = m->system->q(&m->field.p, y, NULL);
    for (int c = 0; c < m->carried; c++) {
        double exponent;
        size[ISO_STATE + c] = fabs(y[ISO_STATE + c]) + rate(m, m->carry[c], q, &exponent);
    }
}

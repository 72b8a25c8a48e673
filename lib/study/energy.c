/* energy.c - the energies of a ball along a trajectory: those of the integral h, in the caller's units. */
#include "study/energy.h"

#include <math.h>
#include <string.h>

#include "base/arithmetic_impl.h"
#include "base/vec3_impl.h"
#include "model/model_impl.h"
#include "orbit/description.h"
#include "orbit/orbit_impl.h"
#include "orbit/scene.h"

typedef struct energies {
    iso_context *ctx;
    const iso_params *params;
    const iso_record *record;
    iso_effects effects;
    int columns[ISO_TRAJECTORY_COLUMNS]; /* of the record, -1: not there */
    const iso_orbit *first;              /* the orbit of the first row   */
    const iso_integral *h;
} energies;

/* Whether all effects say what they do to the energy. */
static bool is_known(const energies *e)
{
    const iso_problem *f = &iso_orbit_model(e->first)->problem;
    for (iso_effect_id id = 0; id < ISO_EFFECTS; id++) {
        const iso_effect *effect = iso_effect_list[id];
        if (!iso_effect_acts(&f->effects, id)) continue;
        if (!effect->work || effect->work(f) == ISO_WORK_UNKNOWN) return false;
    }
    return true;
}

static double kinetic(const energies *e, const double omega[3], const double n[3])
{
    const double *J = e->params->J, spin = dot(omega, n);
    const double D = iso_effects_twist(&e->effects) ? e->params->D : 0;
    return 0.5 *
           (J[0] * omega[0] * omega[0] + J[1] * omega[1] * omega[1] + J[2] * omega[2] * omega[2] - D * spin * spin);
}

/* Clock, h, kinetic, potential of one row. */
static void read_row(const energies *e, int clock, size_t row, double to[4])
{
    iso_sample sample;
    double size;
    const double *x = iso_record_const_row(e->record, row);
    iso_sample_of_row(e->columns, x, &sample);
    to[0] = clock < 0 ? (double)row + 1 : x[e->columns[clock]];
    to[1] = iso_orbit_integral(e->first, &iso_system_ball, e->h, &sample, &size) *
            iso_unit(iso_orbit_units(e->first), e->h->dimension);
    to[2] = kinetic(e, sample.ball, sample.ball + 3);
    to[3] = to[1] - to[2];
}

static iso_status read_rows(const energies *e, iso_record **answer)
{
    int clock = 0;
    while (clock < ISO_CLOCKS && e->columns[clock] < 0) clock++;
    if (clock == ISO_CLOCKS) clock = -1;
    const char *const names[] = {clock < 0 ? "row" : iso_clock_name((iso_clock)clock), "h", "kinetic", "potential"};
    const int count = iso_effects_pull(&e->effects) ? 4 : 2;
    iso_status status = iso_record_create(e->ctx, (size_t)count, names, answer);
    for (size_t row = 0; status == ISO_OK && row < iso_record_rows(e->record); row++) {
        double number[4], *to;
        read_row(e, clock, row, number);
        status = iso_record_append(e->ctx, *answer, &to);
        for (int i = 0; status == ISO_OK && i < count; i++) {
            to[i] = number[i];
            if (!isfinite(to[i]))
                status = iso_context_fail(e->ctx, ISO_NUMERICAL, names[i], "row %zu: %s is no finite number", row + 1,
                                          names[i]);
        }
    }
    return status;
}

iso_status iso_record_energies(iso_context *ctx, const iso_params *params, const iso_record *record,
                               iso_record **answer)
{
    ISO_DEFAULT_ARITHMETIC;
    energies e = {.ctx = ctx, .params = params, .record = record, .h = iso_system_ball.integrals};
    iso_start start;
    iso_orbit *first = NULL;
    *answer = NULL;
    while (strcmp(e.h->name, "h") != 0) e.h++;
    iso_record_find_columns(record, e.columns);
    if (iso_record_rows(record) == 0) return ISO_FAIL_INPUT(ctx, "", "the trajectory has no rows");
    ISO_TRY(iso_record_effects(ctx, record, &e.effects));
    /* effects that act on nothing are left out if the record lacks their columns: the motion does not need them */
    for (iso_effect_id id = 0; id < ISO_EFFECTS; id++)
        if (iso_effect_list[id]->observes && !iso_columns_have_beginning(e.columns, params, id))
            e.effects.on[id] = false;
    iso_effects effects = e.effects;
    ISO_TRY(iso_record_start(ctx, record, params, ISO_BALL, 0, &start, &effects));
    iso_orbit_options o = iso_orbit_defaults(&start);
    o.effects = &effects;
    iso_status status = iso_orbit_create(ctx, params, &start, &o, &first);
    e.first = first;
    if (status == ISO_OK && is_known(&e)) status = read_rows(&e, answer);
    iso_orbit_free(first);
    if (status != ISO_OK) iso_record_free(*answer), *answer = NULL;
    return status;
}

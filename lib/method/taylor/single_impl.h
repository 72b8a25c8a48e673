/* single_impl.h - one orbit by Taylor series, as an iso_integrator. */
#include "base/math_impl.h"
#include "method/integrator_impl.h"
#include "method/taylor/code_impl.h"
#include "method/taylor/restore_impl.h"

typedef struct single {
    form T;
    real length; /* of the last step, in the own variable */
} single;

static iso_status create(iso_integrator *it)
{
    single *own = it->data = aligned_alloc(64, (sizeof *own + 63) / 64 * 64);
    if (!own) return iso_context_fail(it->ctx, ISO_NO_MEMORY, "", "no memory for %s", it->method->name);
    set_shape(&own->T, &it->model, it->inside, it->options.tolerance);
    own->T.unprojected = it->options.no_projection;
    it->saved = offsetof(state, own) + (size_t)(it->model.moving - ISO_STATE) * sizeof(real);
    return ISO_OK;
}

static iso_status start(iso_integrator *it)
{
    single *own = it->data;
    start_orbit(&own->T, 0, &it->model, it->at_right);
    return ISO_OK;
}

static iso_status give_state(iso_integrator *it, const state *s, real moved, double y[])
{
    single *own = it->data;
    it->statistics.correction = fmax(it->statistics.correction, (double)moved);
    store(&own->T, 0, s, y);
    if (all_finite(y, it->model.dim)) return ISO_OK;
    return iso_integrator_stopped(it, "the series diverges; taylor_extended has numbers of a wider range, the other "
                                      "backend other terms");
}

static iso_status step(iso_integrator *it, double y[], double *h)
{
    single *own = it->data;
    form *T = &own->T;
    begin(T);
    expand(&T->S);
    it->statistics.rhs += T->S.order;
    real gained[ISO_CLOCKS], moved;
    if (it->options.fixed_step > 0) {
        const real length = choose_step(T, it->direction, gained);
        *h = it->direction * it->options.fixed_step;
        own->length = solve_for_time(T, *h, length * (*h / gained[it->model.clock]));
        moved = find_state(T, own->length, NULL, &T->now);
    } else {
        own->length = choose_near(T, it->direction, gained, &T->now, &moved);
        *h = (double)gained[it->model.clock];
    }
    return give_state(it, &T->now, moved, y);
}

static iso_status dense(iso_integrator *it, double dt, double y[])
{
    single *own = it->data;
    state s;
    const real moved = find_state(&own->T, solve_for_time(&own->T, dt, own->length * (dt / it->h)), NULL, &s);
    return give_state(it, &s, moved, y);
}

/* A step is made of the state at its left end, and of nothing else. */
static void save(const iso_integrator *it, void *to)
{
    const single *own = it->data;
    memcpy(to, &own->T.now, it->saved);
}

static void recall(iso_integrator *it, const void *from, double y[])
{
    single *own = it->data;
    memcpy(&own->T.now, from, it->saved);
    store(&own->T, 0, &own->T.now, y);
}

static void release(iso_integrator *it)
{
    free(it->data);
}

#define SINGLE .start = start, .step = step, .dense = dense, .save = save, .recall = recall, .free = release

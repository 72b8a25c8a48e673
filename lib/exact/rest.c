/* rest.c - the form of a point at rest in an equilibrium off the level H = 0: the clocks alone go on. */
#include <math.h>
#include <stdlib.h>

#include "base/vec3_impl.h"
#include "exact/form_impl.h"
#include "model/model_impl.h"

typedef struct rest {
    double point[ISO_STATE];
    real rate[ISO_CLOCKS]; /* d clock/ds */
} rest;

/* M = 0, and gamma x J gamma with it */
static bool serves(const iso_problem *f, const double y[ISO_STATE])
{
    const double *g = y + 3, *J = f->p.J;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        if (y[i] != 0 || (J[j] != J[l] && g[j] != 0 && g[l] != 0)) return false;
    }
    return true;
}

static iso_status make(const iso_problem *f, const double y[ISO_STATE], const bool clocks[ISO_CLOCKS], form_motion *m)
{
    rest *r = m->data = calloc(1, sizeof *r);
    if (!r) return ISO_NO_MEMORY;
    copy(y + 3, r->point + 3, 3);
    make_unit(r->point + 3);
    const double q = dot_diag(r->point + 3, f->p.J, r->point + 3);
    const double s = iso_clock_rate(&f->p, ISO_CLOCK_S, q, NULL);
    for (iso_clock c = 0; c < ISO_CLOCKS; c++)
        r->rate[c] = m->rate[c] = clocks[c] ? iso_clock_rate(&f->p, c, q, NULL) / s : NAN;
    return ISO_OK;
}

static void find(const void *data, iso_clock clock, real time, form_place *p)
{
    const rest *r = data;
    p->along = time / r->rate[clock];
    copy(r->point, p->point, ISO_STATE);
    for (int c = 0; c < ISO_CLOCKS; c++) p->clock[c] = c == (int)clock ? time : r->rate[c] * p->along;
}

static void describe(const void *data, const bool clocks[ISO_CLOCKS], iso_exact_torus *to)
{
    (void)data, (void)clocks;
    to->kind = ISO_EXACT_REST;
}

const iso_form iso_form_rest = {.serves = serves, .make = make, .free = free, .find = find, .describe = describe};

/* orbit_impl.h - what an orbit is made of, for orbit.c and orbit_start.c. */
#ifndef ISO_ORBIT_ORBIT_IMPL_H
#define ISO_ORBIT_ORBIT_IMPL_H

#include "orbit/orbit.h"

struct iso_orbit {
    iso_context *ctx;
    iso_orbit_options options;
    iso_units units;
    double unit_M, unit_clock[ISO_CLOCKS]; /* one own unit in the caller's */
    double h, eps;                         /* own units                    */
    iso_model model;
    iso_integrator *integrator;
};

/* Sets o->units, o->h and o->eps from a start and what o->options ask for (backend not ISO_AUTO), and gives the start in
 * the backend's variables and own units, with the energy it lives on there. Errors: those of iso_orbit_create. */
iso_status iso_orbit_find_start(iso_orbit *o, const iso_params *p, const iso_start *start, double y[ISO_STATE],
                                double *energy);

#endif

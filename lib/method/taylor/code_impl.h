/* code_impl.h - one compilation of the method `taylor`: there is one for each kind of processor and of number. */
#ifndef ISO_METHOD_TAYLOR_IMPL_H
#define ISO_METHOD_TAYLOR_IMPL_H

#include "method/integrator_impl.h"

/* The functions of iso_method, for one compilation. `create` allocates it->data; the first member there is a pointer
 * to this struct. */
typedef struct iso_taylor_build {
    iso_status (*create)(iso_integrator *it);
    iso_status (*start)(iso_integrator *it);
    iso_status (*step)(iso_integrator *it, double y[], double *h);
    iso_status (*dense)(iso_integrator *it, double dt, double y[]);
    void (*save)(const iso_integrator *it, void *to);
    void (*recall)(iso_integrator *it, const void *from, double y[]);
} iso_taylor_build;

extern const iso_taylor_build iso_taylor_plain, iso_taylor_avx2, iso_taylor_extended, iso_taylor_quad;

/* Whether this processor can run iso_taylor_avx2, which builds for x86 have. */
bool iso_taylor_has_avx2(void);

#endif

/* section_area.h - the area of a section, from the table by which starts are spread over it. */
#ifndef ISO_TESTS_SECTION_AREA_H
#define ISO_TESTS_SECTION_AREA_H

#include "base/math_impl.h"
#include "map/section_impl.h"

/* The area of the whole section, the integral of 2 G dl over the part of the circle that is open. Its relative error
 * is about 1e-15 on H = 0 and for |k| >= 1/2, and below 1e-8 for |k| >= 0.05. */
static inline double section_area(iso_point_motion m, int axis)
{
    iso_section_spread s;
    if (!iso_section_is_open(m, axis, 0) && !iso_section_is_open(m, axis, ISO_PI / 2)) return 0;
    iso_section_spread_prepare(&s, m, axis, 0);
    const double unit = m.energy == 0 ? iso_section_momentum_at(s.k, m.eps, 0, s.largest) : 1;
    return 8 * unit * s.part[ISO_SPREAD_STEPS];
}

#endif

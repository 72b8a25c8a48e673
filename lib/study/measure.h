/* measure.h - is the invariant measure kept? A cloud of states distributed by it is carried by the flow, and tested
 * against it again.
 *
 *     iso_measure m;
 *     iso_measure_options o = iso_measure_defaults();
 *     o.count = 1000000;
 *     status = iso_measure_flow(ctx, &scene, &o, &m);           m.kept, m.p, m.line[m.worst].name
 *     status = iso_measure_returns(ctx, &scene, &o, &m);
 *
 * The measure (10) is g^(1/(2k)) dw dn on (w,n) = 0. On a level of the energy, with v = J^(1/2) w, it is
 *
 *     g^(1/(2k) - 1/2) dn dtheta = q^(-1 - 1/(2k)) dgamma dtheta,     q = (gamma, J gamma) = 1/g
 *
 * where dn, dgamma are areas on the unit sphere and theta is the direction of v in the plane normal to gamma; of its
 * length the energy leaves no choice. This is what the flow keeps in equal times t. In another clock, d clock = N dt,
 * it keeps N times that; in s it is dgamma dtheta, Liouville's measure of the point on H = 0. The returns to a
 * section keep dL dl = G(l) dx dl (map/section.h).
 *
 * The test. The cloud is made of 32 clouds of equal numbers. Each is one low-discrepancy sequence in the three (of
 * returns two) variables in which the measure is uniform, shifted by a random vector modulo 1. So every point is
 * distributed by the measure exactly, the 32 clouds are independent, and means over each come much closer to the
 * exact ones than those of random points. The cloud is looked at four times. Each time the mean of each test
 * function, over each of the 32 clouds, is compared with its exact mean, which comes from quadrature. Student's t
 * with 31 degrees of freedom tells how likely so large a deviation is. All these tests count as one (Bonferroni): p
 * is the least probability times their number.
 *
 * Test functions of equal times: the energy h (relative; a ball that loses energy leaves the level), ln g, which
 * changes most where the exponent is wrong, products of components of n, of v/|v| and of u = gamma x v/|v|. Of
 * returns: h, ln G, products of x and of cosines and sines of l.
 *
 * `resolution` tells how sharp the test was: an exponent that is wrong by this part of 1/(2k) is found out. It is
 * computed from the cloud: how the means change with the exponent, against how well they are known.
 */
#ifndef ISO_STUDY_MEASURE_H
#define ISO_STUDY_MEASURE_H

#include <math.h>

#include "../base/api.h"
#include "../orbit/orbit.h"

ISO_C_BEGIN

enum {
    ISO_MEASURE_CLOUDS = 32,
    ISO_MEASURE_LEAST = 16 * ISO_MEASURE_CLOUDS,
    ISO_MEASURE_ROWS = 4,
    ISO_MEASURE_RETURNS = 1 << (ISO_MEASURE_ROWS - 1)
};

typedef struct iso_measure_options {
    size_t size;  /* set by iso_measure_defaults; see isoroll.h                                        */
    size_t count; /* orbits, ISO_MEASURE_LEAST or more; rounded up to a multiple of ISO_MEASURE_CLOUDS */
    unsigned long seed;
    double exponent;     /* the measure that is drawn and tested against is g^(exponent/(2k)) dw dn, of returns
                            G^exponent dx dl. 1: (10); no other is kept, unless all moments are equal         */
    double turns;        /* of n, about, for which the flow carries the cloud; it is looked at after 1/64,
                            1/16, 1/4 of this and all of it                                                   */
    double end;          /* the same as a time of the clock; NaN: by turns                                    */
    iso_clock clock;     /* in equal times of which the flow carries the cloud                                */
    int returns;         /* of the cloud to the section, ISO_MEASURE_RETURNS or more; it is looked at after
                            1/8, 1/4, 1/2 of them and all of them                                             */
    int axis;            /* of the section: 0 to 2; ISO_AXIS_AUTO (orbit/crossings.h): the global one         */
    double significance; /* the measure is not kept where p is less                                           */
    double tolerance;    /* of the integration                                                                */
    iso_backend backend; /* as in batches                                                                     */
    int threads;         /* 0: as many as there are processors to run on                                      */
    void (*progress)(double share, void *data); /* may be NULL; share of the work done, in [0, 1]             */
    void *data;
} iso_measure_options;

/* 100000 orbits, seed 1, the right measure, 8 turns or returns, clock t, significance 1e-4, tolerance 1e-10. */
static inline iso_measure_options iso_measure_defaults(void)
{
    iso_measure_options o = ISO_ALL_ZERO;
    o.size = sizeof o;
    o.count = 100000;
    o.seed = 1;
    o.exponent = 1;
    o.turns = 8;
    o.end = NAN;
    o.clock = ISO_CLOCK_T;
    o.returns = 8;
    o.axis = -1;
    o.significance = 1e-4;
    o.tolerance = 1e-10;
    o.backend = ISO_BACKEND_AUTO;
    return o;
}

/* One test function at one time. */
typedef struct iso_measure_line {
    const char *name;      /* the function, such as "ln g"                                                  */
    double time;           /* of the clock, or the number of the return                                     */
    double mean, expected; /* over the cloud, and by the measure                                            */
    double error;          /* standard error of `mean`; at least what the integration's tolerance allows    */
    double deviation;      /* (mean - expected)/error                                                       */
    double p;              /* the probability of such a deviation, on either side                           */
    double slope; /* d(mean - expected)/d(exponent)                                                           */
} iso_measure_line;

enum { ISO_MEASURE_FUNCTIONS = 24, ISO_MEASURE_LINES = ISO_MEASURE_FUNCTIONS * ISO_MEASURE_ROWS };

typedef struct iso_measure {
    size_t count;     /* orbits of the cloud                                                              */
    size_t lost;      /* orbits that effects stop before they return: one line, p = 0; the rest is not tried */
    int axis;         /* of the section; flow: -1                                                              */
    iso_clock clock;  /* flow                                                                                  */
    double end;       /* the last time, or number of the last return                                           */
    int lines, worst; /* and the line that deviates most                                                       */
    iso_measure_line line[ISO_MEASURE_LINES];
    double p;          /* the probability that a measure that is kept shows a deviation like the worst          */
    bool kept;         /* p >= significance                                                                     */
    double resolution; /* see above; infinite where three moments (on the section two) are equal: every
                          exponent is right                                                                     */
} iso_measure;

/* The scene gives the ball, the energy and the effects; its start matters only through the energy. With a potential
 * that depends on n alone (effects `field` and `level`) the measure is the same, and |w| is that of the energy at n.
 * Effects without a potential act on the cloud of the free ball: it is found out that they do not keep its measure.
 * Errors: ISO_BAD_ARGUMENT about "count", "turns", "end", "exponent", "significance" or "clock"; ISO_NOT_MAPPED for a
 * ball at rest, and about an effect whose potential is not one of n alone; ISO_BAD_INPUT about "energy" where not
 * every n can be reached with it; those of iso_batch_run, among them ISO_STOPPED. */
ISO_API iso_status iso_measure_flow(iso_context *ctx, const iso_scene *scene, const iso_measure_options *options,
                                    iso_measure *measure);

/* Effects with a potential are refused: ISO_NOT_MAPPED. Otherwise as above; errors also ISO_BAD_ARGUMENT about
 * "returns" or "axis", and those of iso_crossings_go. */
ISO_API iso_status iso_measure_returns(iso_context *ctx, const iso_scene *scene, const iso_measure_options *options,
                                       iso_measure *measure);

ISO_C_END

#endif

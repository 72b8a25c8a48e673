/* measure.h - does the flow keep the invariant measure? A cloud of states is drawn by the measure and carried by the
 * flow. Then it is tested whether the cloud is still distributed by the measure.
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
 * where dn, dgamma are areas on the unit sphere, and theta is the direction of v in the plane normal to gamma. The
 * energy determines the length of v. The flow in equal times t keeps this measure. The flow in equal times of another
 * clock, d clock = N dt, keeps N times this measure; in s it is dgamma dtheta, Liouville's measure of the point on H
 * = 0. The returns to a section keep dL dl = G(l) dx dl (map/section.h).
 *
 * The test. The cloud consists of 32 smaller clouds with equal numbers of states. Each of these is a low-discrepancy
 * sequence in the three variables (for returns: two) in which the measure is uniform, shifted by a random vector
 * modulo 1. So each state is distributed by the measure exactly, the 32 clouds are independent, and the mean over a
 * cloud is much closer to the exact mean than that of random states. The cloud is tested at four times. At each time
 * the means of each test function over the 32 clouds are compared with the exact mean, which comes from quadrature.
 * Student's t with 31 degrees of freedom gives the probability of such a deviation. All these tests are combined into
 * one (Bonferroni): p is the least probability times the number of tests.
 *
 * Test functions at equal times: the relative energy h (a ball that loses energy leaves the level); ln g, which
 * changes most if the exponent is wrong; products of components of n, of v/|v| and of u = gamma x v/|v|. At returns:
 * h, ln G, products of x and of cosines and sines of l.
 *
 * `resolution` is the sensitivity of the test: the least relative error of the exponent 1/(2k) that it detects. It is
 * computed from the cloud: the errors of the means, divided by their slopes with the exponent.
 */
#ifndef ISO_STUDY_MEASURE_H
#define ISO_STUDY_MEASURE_H

#include <math.h>

#include "../../base/api.h"
#include "../../orbit/orbit.h"

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
    /* The measure is g^(exponent/(2k)) dw dn, for returns G^exponent dx dl. 1 is (10). No other measure is kept,
     * unless all moments are equal. */
    double exponent;
    /* About how many turns of n the flow carries the cloud. It is tested after 1/64, 1/16, 1/4 of them, and at the
     * end. */
    double turns;
    double end;      /* the end as a time of the clock; NaN: given by `turns`                             */
    iso_clock clock; /* the flow carries the cloud in equal times of this clock                           */
    /* Number of returns to the section, ISO_MEASURE_RETURNS or more. The cloud is tested after 1/8, 1/4, 1/2 of them,
     * and at the end. */
    int returns;
    int axis;            /* of the section: 0 to 2; ISO_AXIS_AUTO (orbit/crossings.h): the global one         */
    double significance; /* the measure counts as not kept if p is less than this                             */
    double tolerance;    /* of the integration                                                                */
    iso_backend backend; /* as in batches                                                                     */
    int threads;         /* 0: as many as there are processors to run on                                      */
    void (*progress)(double share, void *data); /* may be NULL; share: the part of the work done, in [0, 1]   */
    void *data;
} iso_measure_options;

/* 100000 orbits, seed 1, exponent 1, 8 turns or returns, clock t, significance 1e-4, tolerance 1e-10. */
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
typedef struct iso_measure_entry {
    const char *name;      /* the function, such as "ln g"                                                  */
    double time;           /* the time of the clock, or the number of the return                            */
    double mean, expected; /* over the cloud, and by the measure                                            */
    double error;          /* standard error of `mean`; not less than the error that the tolerance allows   */
    double deviation;      /* (mean - expected)/error                                                       */
    double p;              /* the probability of a deviation as large as this, of either sign               */
    double slope; /* d(mean - expected)/d(exponent)                                                           */
} iso_measure_entry;

enum { ISO_MEASURE_FUNCTIONS = 24, ISO_MEASURE_LINES = ISO_MEASURE_FUNCTIONS * ISO_MEASURE_ROWS };

typedef struct iso_measure {
    size_t count; /* orbits of the cloud */
    /* If an effect stops orbits before they return: how many, among the first few thousand orbits where this happens.
     * Then there is one line, with p = 0, and the test ends. */
    size_t lost;
    int axis;         /* of the section; flow: -1                                                              */
    iso_clock clock;  /* flow                                                                                  */
    double end;       /* the last time, or the number of the last return                                       */
    int lines, worst; /* number of lines; the line that deviates most                                          */
    iso_measure_entry line[ISO_MEASURE_LINES];
    double p;  /* the probability that a measure that is kept deviates as much as the worst line        */
    bool kept; /* p >= significance                                                                     */
    /* See above; infinite if the three moments (for returns: the two beside the axis) are equal, since every exponent
     * is right then. */
    double resolution;
} iso_measure;

/* The scene gives the ball, the energy and the effects. Of its start only the energy matters. With a potential that
 * depends on n only (effects `field` and `level`) the measure is the same, and the energy gives |w| at each n.
 * Effects without a potential act on the cloud of the free ball; the test detects that they do not keep its measure.
 * Errors: ISO_BAD_ARGUMENT about "count", "turns", "end", "exponent", "significance" or "clock"; ISO_BAD_INPUT at rest,
 * about an effect whose potential depends on more than n, and about "energy" if the ball cannot reach every n with
 * it; those of iso_batch_run, among them ISO_STOPPED. */
ISO_API iso_status iso_measure_flow(iso_context *ctx, const iso_scene *scene, const iso_measure_options *options,
                                    iso_measure *measure);

/* Effects with a potential are refused: ISO_BAD_INPUT. Otherwise as above; errors also ISO_BAD_ARGUMENT about
 * "returns" or "axis", and those of iso_crossings_go. */
ISO_API iso_status iso_measure_returns(iso_context *ctx, const iso_scene *scene, const iso_measure_options *options,
                                       iso_measure *measure);

ISO_C_END

#endif

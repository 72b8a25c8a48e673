/* crossing.h - what the loops that look for crossings share. C and C++. */
#ifndef ISO_TESTS_RIVALS_CROSSING_H
#define ISO_TESTS_RIVALS_CROSSING_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* The x in [0, h] where the cubic that has the two values and slopes is 0. */
static inline double rival_cubic_root(double before, double slope, double after, double slope_after, double h)
{
    double low = 0, high = 1, x = before / (before - after);
    const double a = h * slope, b = h * slope_after;
    for (int i = 0; i < 60 && high - low > 1e-15; i++) {
        const double y = 1 - x;
        const double value = y * y * ((1 + 2 * x) * before + x * a) + x * x * ((3 - 2 * x) * after - y * b);
        const double rate = 6 * x * y * (after - before) + y * (1 - 3 * x) * a + x * (3 * x - 2) * b;
        *(value < 0 ? &low : &high) = x;
        const double next = x - value / rate;
        if (fabs(next - x) < 1e-14) break;
        x = next > low && next < high ? next : (low + high) / 2;
    }
    return h * x;
}

/* Makes long variations as long as 1. Gives whether one was: then the slopes of the old ones are to be forgotten. */
static inline bool rival_shorten(double y[], size_t size, double growth[2])
{
    bool changed = false;
    for (size_t v = 1; 6 * v < size; v++) {
        double square = 0;
        for (size_t i = 6 * v; i < 6 * v + 6; i++) square += y[i] * y[i];
        if (square < 1e8) continue;
        for (size_t i = 6 * v; i < 6 * v + 6; i++) y[i] /= sqrt(square);
        growth[v - 1] += log(square) / 2;
        changed = true;
    }
    return changed;
}

#endif

/* palette.c - the colours of several lines, and of the scale (see palette.h). */
#include "plot/palette.h"

#include <math.h>

/* The last three repeat colours with other dashes: colour-blind readers tell no more than seven apart. */
const char *iso_plot_stroke(int i)
{
    static const char *const strokes[ISO_PLOT_STROKES] = {"dt 1 lc rgb " ISO_PLOT_BLUE,
                                                          "dt (8,3) lc rgb " ISO_PLOT_VERMILLION,
                                                          "dt (8,3,2,3) lc rgb " ISO_PLOT_GREEN,
                                                          "dt (2,3) lc rgb 'black'",
                                                          "dt (12,4) lc rgb " ISO_PLOT_PURPLE,
                                                          "dt 1 lc rgb " ISO_PLOT_ORANGE,
                                                          "dt (4,4) lc rgb " ISO_PLOT_SKY,
                                                          "dt (2,2) lc rgb " ISO_PLOT_BLUE,
                                                          "dt (12,3,2,3,2,3) lc rgb " ISO_PLOT_GREEN,
                                                          "dt (5,2) lc rgb " ISO_PLOT_ORANGE};
    return strokes[i % ISO_PLOT_STROKES];
}

/* viridis of matplotlib (CC0), nine of its colours. */
static const int viridis[] = {0x440154, 0x472C7A, 0x3B518B, 0x2C718E, 0x21908D,
                              0x27AD81, 0x5CC863, 0xAADC32, 0xFDE725};
enum { PIECES = sizeof viridis / sizeof *viridis - 1 };

int iso_plot_mix(int a, int b, double part)
{
    int colour = 0;
    for (int shift = 0; shift < 24; shift += 8)
        colour |= (int)lround((1 - part) * (a >> shift & 255) + part * (b >> shift & 255)) << shift;
    return colour;
}

int iso_plot_scale(double part)
{
    const int piece = part < 1 ? (int)(part * PIECES) : PIECES - 1;
    return iso_plot_mix(viridis[piece], viridis[piece + 1], part * PIECES - piece);
}

void iso_plot_put_scale(FILE *f, double most)
{
    fputs("set palette defined (", f);
    for (int i = 0; i <= PIECES; i++) fprintf(f, "%s%d '#%06X'", i ? ", " : "", i, iso_plot_scale(most * i / PIECES));
    fputs(")\n", f);
}

/* palette.h - all colours of the pictures. Colours of lines are near to Okabe and Ito's, for all kinds of sight;
 * the scale is viridis, which grows lighter throughout. Two lines of one plot that are alike in grey have different
 * dashes or signs. tests/cli/colours.sh checks this for colour-blind readers, and in grey.
 */
#ifndef ISOROLL_PALETTE_H
#define ISOROLL_PALETTE_H

#include <stdio.h>

/* Lines and signs. */
#define ISO_PLOT_BLUE "'#0072B2'"
#define ISO_PLOT_VERMILLION "'#D55E00'"
#define ISO_PLOT_GREEN "'#009E73'"
#define ISO_PLOT_PURPLE "'#8320E4'"
#define ISO_PLOT_SKY "'#56B4E9'"
#define ISO_PLOT_ORANGE "'#E8AA00'"
#define ISO_PLOT_DARK_RED "'#8B1A00'"

/* The same on the far side of a sphere, and areas. */
#define ISO_PLOT_FAR_BLUE "'#A9CDE2'"
#define ISO_PLOT_FAR_VERMILLION "'#F0BE9B'"
#define ISO_PLOT_PALE_BLUE "'#CFE3F2'"
#define ISO_PLOT_PALE_YELLOW "'#F7E3B0'"
#define ISO_PLOT_PALE_PURPLE "'#D9A9C6'"
#define ISO_PLOT_PALE_GREEN "'#8FCBB4'"

/* Greys, from dark to light: words, axes, what only helps; chaos, and what has no value; grids, areas. */
#define ISO_PLOT_INK "'#404040'"
#define ISO_PLOT_WORDS "'#505050'"
#define ISO_PLOT_LINE "'#606060'"
#define ISO_PLOT_HELP "'#707070'"
#define ISO_PLOT_OUTLINE "'#8A939B'"
#define ISO_PLOT_BEHIND "'#909090'"
#define ISO_PLOT_GREY "'#B0B0B0'"
#define ISO_PLOT_OTHERS "'#B4BABF'"
#define ISO_PLOT_NEAR_GRID "'#B9C0C7'"
#define ISO_PLOT_GRID "'#DDE1E5'"
#define ISO_PLOT_BAND "'#E8ECEF'"
#define ISO_PLOT_SPHERE "'#F4F6F8'"
enum {
    ISO_PLOT_WHITE_CODE = 0xFFFFFF,
    ISO_PLOT_GREY_CODE = 0xB0B0B0,
    ISO_PLOT_SPHERE_CODE = 0xF4F6F8,
    ISO_PLOT_FAINT_CODE = 0x707880,
    ISO_PLOT_INK_CODE = 0x404040
};

/* Dash and colour of the i-th of several lines. After ISO_PLOT_STROKES they begin again. */
enum { ISO_PLOT_STROKES = 10 };
const char *iso_plot_stroke(int i);

/* A colour of the scale, part from 0 to 1, and a mixture of two, as 0xRRGGBB. */
int iso_plot_scale(double part);
int iso_plot_mix(int a, int b, double part);

/* The scale up to `most` as gnuplot's palette. */
void iso_plot_put_scale(FILE *script, double most);

#endif

/* momentum.h - the image of the momentum map (h, F) where the problem separates, and what moves how in its parts.
 *
 *     k = 1, no effects:                  F = F_plane = 2 c,          c = eps D/al, D = b1 b2 b3
 *     k = -1, no effects but a `level`:   F = F_shell = -2 c/det J,   c = -eps al (S - al), S = b1 + b2 + b3 + H/eps
 *
 * with b = 1/J (k = 1) or J (k = -1), ascending, eps = h det J/k^2, and al <= be (k = -1: al + be = S) the roots of
 * R(z) + c (lib/doc/theory.md) between which the coordinates b1 <= u <= b2 <= v <= b3 move. A root that meets b_i
 * is a rotation about the axis of b_i: for H = 0 the rays F/h = 2 J_i (k = 1) and F/h = 2 J_i (J_j + J_l) (k = -1).
 * The two roots meet at F/h = (J1 + J2 + J3)^2/2, where k = -1 and b3 > b1 + b2.
 */
#ifndef ISO_INSTRUMENT_FREQUENCIES_MOMENTUM_H
#define ISO_INSTRUMENT_FREQUENCIES_MOMENTUM_H

#include "base/record.h"
#include "model/system.h"

/* Parts of the image. Axes 1, 2, 3 are those of b1, b2, b3. */
typedef enum iso_momentum_part {
    ISO_TURNS_ABOUT_1,  /* gamma turns about axis 1, swings through the plane across: u in [b1, al], v in [b2, b3] */
    ISO_TURNS_ABOUT_3,  /* the same about axis 3: u in [b1, b2], v in [al, b3]                                      */
    ISO_ON_ONE_SIDE,    /* gamma turns about axis 3, on one side of that plane: u in [b1, b2], v in [al, be]        */
    ISO_SWINGS_ABOUT_3, /* gamma swings both ways about axis 3: u in [b1, al], v in [b2, be]; only for H < 0        */
    ISO_MOMENTUM_PARTS
} iso_momentum_part;

typedef struct iso_momentum {
    int k, axis[3];        /* axis[i]: the caller's axis, 0 to 2, of b[i]                              */
    double b[3], det_J, H; /* H: the point's level                                                      */
    const char *F;         /* "F_plane", "F_shell"                                                      */
} iso_momentum;

/* False: there is none, k is not 1 or -1, or k = 1 and H is not 0. Any consistent units. */
bool iso_momentum_make(const iso_params *params, double H, iso_momentum *momentum);

/* For an energy h > 0 of the ball: the values of F of a part. False: it is empty. */
bool iso_momentum_interval(const iso_momentum *m, double h, iso_momentum_part part, double *low, double *high);

/* The image with the orbit at (h, F), F the value of this integral, for a picture. False: there is none, or it has no
 * area, as with equal moments. */
bool iso_momentum_at(const iso_params *params, double H, double h, const char *integral, double F,
                     iso_momentum *momentum);

/* For a picture of the image round an energy h: rows with h' from about 0 to 2 h, then low and high F of each part,
 * then F of the four rotations; NaN where there is none. Errors: ISO_NUMERICAL (h, H or a bound fits no double),
 * ISO_NO_MEMORY. */
enum { ISO_MOMENTUM_LINES = 4 };
iso_status iso_momentum_bounds(iso_context *ctx, const iso_momentum *m, double h, iso_record **bounds);

/* What moves how in a part, and which rotation it is, as text. */
enum { ISO_MOMENTUM_WORDS = 64 };
void iso_momentum_name_part(const iso_momentum *m, iso_momentum_part part, char words[ISO_MOMENTUM_WORDS]);
void iso_momentum_name_line(const iso_momentum *m, int i, char words[ISO_MOMENTUM_WORDS]);

/* The part in which (h, F) lies, the nearest if it lies outside by rounding. */
iso_momentum_part iso_momentum_find(const iso_momentum *m, double h, double F);

#endif

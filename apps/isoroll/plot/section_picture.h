/* section_picture.h - collects crossings for the picture of `isoroll section`. */
#ifndef ISOROLL_SECTION_PICTURE_H
#define ISOROLL_SECTION_PICTURE_H

#include "isoroll.h"
#include "orbit/crossings.h"
#include "plot/page.h"
#include "study/chaos/chaos.h"

typedef struct section_picture section_picture;

/* Takes the header of the rows; to be freed also after an error. */
iso_status section_picture_create(iso_context *ctx, const iso_record *header, section_picture **picture);
void section_picture_free(section_picture *p);

/* Takes the next row. Of very many rows only an even choice is kept. Errors: ISO_NO_MEMORY. */
iso_status section_picture_row(iso_context *ctx, section_picture *p, const double row[]);

/* Takes the crossing of the last row by both models. */
iso_status section_picture_pair(iso_context *ctx, section_picture *p, const iso_crossing *ball,
                                const iso_crossing *point);

/* The first crossing (l, x) of each orbit that has one. Gives how many; valid until the next row. */
size_t section_picture_starts(section_picture *p, const double (**starts)[2]);

/* Tells which orbits are chaotic, by those that start at these crossings: they are drawn in grey. Without this call,
 * orbits are grey on which the two models part, or of which no rotation number is found. */
iso_status section_picture_judge(iso_context *ctx, section_picture *p, const iso_chaos *chaos);

/* Draws the picture. Errors: ISO_BAD_INPUT if the section is an event, which has no coordinates; those of
 * iso_plot_sections. */
iso_status section_picture_draw(iso_context *ctx, section_picture *p, const iso_plot_page *page);

#endif

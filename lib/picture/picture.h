/* picture.h - what a picture of a table shows: from the tables of studies to the tables that are drawn.
 *
 *     iso_picture picture;
 *     status = iso_picture_make(ctx, (const iso_record *[]){section, chaos, NULL}, "window=0:1,0:0.5", &picture);
 *     ... picture.layout is "section", picture.table[0], "ball", has the columns right, up, shade, colour
 *     iso_picture_free(&picture);
 *
 * The command's templates (apps/isoroll/pictures), Matplotlib and the page draw these tables, and compute nothing:
 * which rows are grey, dashed, marked or left out is said here, once. The head of each .c file here lists its tables.
 */
#ifndef ISO_PICTURE_PICTURE_H
#define ISO_PICTURE_PICTURE_H

#include "base/record.h"

enum { ISO_PICTURE_TABLES = 16, ISO_PICTURE_ASIDE = 8 };

typedef struct iso_picture {
    const char *layout; /* how the tables are laid out: the name of a template, such as "section" */
    /* NULL after the last. The kind of a table is its name in the template. The lines of the first one are its
     * texts and numbers: the title, names of axes. */
    iso_record *table[ISO_PICTURE_TABLES];
    iso_record *aside[ISO_PICTURE_ASIDE]; /* that are not drawn, while the picture is made */
} iso_picture;

/* Makes the picture of table[0]; more tables with NULL behind them add to it, by their kinds: the verdicts of `chaos`,
 * or orbits of `periodic`, to a section. A table of a kind that is not in the list here is drawn as it is, by the
 * layout of its kind, and lives as long as the picture. options: lines NAME=VALUE with a newline between, or NULL:
 *   columns=X,Y            of a trajectory: Y over X alone
 *   value=NAME             of a sweep: the column that is drawn
 *   window=L0:L1,X0:X1     of a section: this part of it
 *   points=N               of a section: at most so many spots a side; of more an image is made
 * Errors: ISO_BAD_INPUT: the table has no rows, or a column or line is missing;
 * ISO_BAD_ARGUMENT about an option; ISO_NUMERICAL, ISO_NO_MEMORY. The picture is then empty. */
iso_status iso_picture_make(iso_context *ctx, const iso_record *const table[], const char *options,
                            iso_picture *picture);
void iso_picture_free(iso_picture *picture);

/* Whether tables of this kind are in the list. */
bool iso_picture_has(const char *kind);

/* The table of this name, or NULL. */
iso_record *iso_picture_table(const iso_picture *picture, const char *name);

#endif

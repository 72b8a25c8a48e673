/* picture_impl.h - what the pictures of this folder share. */
#ifndef ISO_PICTURE_PICTURE_IMPL_H
#define ISO_PICTURE_PICTURE_IMPL_H

#include "model/params.h"
#include "picture/picture.h"

/* What is asked for. */
typedef struct iso_picture_request {
    const iso_record *const *table; /* NULL behind the last; table[0] is drawn */
    const char *options;            /* lines NAME=VALUE, or NULL               */
    const char *title;              /* of table[0]: its own, or what it shows, with k and J */
} iso_picture_request;

/* The first of the further tables of this kind; NULL: there is none. */
const iso_record *iso_picture_given(const iso_picture_request *request, const char *kind);

/* The value of an option, in `value`; false: it is not given. */
enum { ISO_PICTURE_OPTION = 128 };
bool iso_picture_option(const iso_picture_request *request, const char *name, char value[static ISO_PICTURE_OPTION]);

/* Adds an empty table `name` with these columns, to be filled by iso_record_add. */
iso_status iso_picture_add(iso_context *ctx, iso_picture *picture, const char *name, size_t columns,
                           const char *const names[], iso_record **table);

/* Lines of the first table: a text, a number. */
iso_status iso_picture_say(iso_context *ctx, iso_picture *picture, const char *key, const char *text);
iso_status iso_picture_count(iso_context *ctx, iso_picture *picture, const char *key, double number);

/* A number of a table by the name of its column (NaN: there is none); whether a word is this one; the axis of the
 * line "axis", 0 to 2 (-1: there is none). */
double iso_picture_number(const iso_record *table, size_t row, const char *column);
bool iso_picture_is(const iso_record *table, size_t row, const char *column, const char *word);
int iso_picture_axis(const iso_record *table);

/* "1/2" of 0.5, if the number is such a fraction to its last digits; else its first digits. Returns `text`. */
enum { ISO_PICTURE_FRACTION = 32 };
char *iso_picture_fraction(char text[static ISO_PICTURE_FRACTION], double x);

/* A symbol for the name of a column: "γ" for "gamma", "n₁" for "n1"; the name itself if there is none. */
const char *iso_picture_symbol(const char *name);

/* What is seen, a gap, and "k = ..., J = (...)". Returns `title`. */
enum { ISO_PICTURE_TITLE = 400 };
char *iso_picture_title(char title[static ISO_PICTURE_TITLE], const char *seen, const iso_params *p);

/* A kind of table. */
typedef struct iso_picture_maker {
    const char *kind, *shows; /* shows: the title of a table that has none */
    const char *columns[5];   /* that the picture needs; NULL ends them    */
    bool axis;                /* and the line "axis"                       */
    const char *options;      /* those that it takes, with blanks around: " window points " */
    iso_status (*make)(iso_context *ctx, const iso_picture_request *request, iso_picture *picture);
} iso_picture_maker;

extern const iso_picture_maker iso_picture_chaos, iso_picture_indicators, iso_picture_periodic, iso_picture_section;
extern const iso_picture_maker iso_picture_splitting;

#endif

/* turns_fields.c - what a table of turns holds: the rows of its kind in lib/task/list/tables.c. */

typedef struct turn {
    double number, angle;
} turn;

static const iso_field turn_fields[] = {ISO_MEMBER(turn, "number", number, "", "of the turn, from 1"),
                                        ISO_MEMBER(turn, "angle", angle, "rad", "by which it goes on"),
                                        ISO_FIELD_END};

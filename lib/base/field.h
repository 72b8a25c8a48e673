/* field.h - what a result holds, said once: the name, place, unit and meaning of each member of a struct.
 *
 *     static const iso_field fields[] = {
 *         ISO_MEMBER(circle, "radius", radius, "length", "distance of the rim"),
 *         ISO_MEMBER(circle, "centre", at, "length", "its place"),              double at[2]: centre1, centre2
 *         ISO_FIELD_END,
 *     };
 *     iso_columns_append(ctx, fields, &c, record);                             a row
 *
 * From such a list are made: the columns of tables and their rows, JSON, and lists of the columns with their meaning.
 * So a member becomes a column by one line. In JSON "ball.exponent" is the member "exponent" of the object "ball"; in
 * a table it is the column ball_exponent.
 */
#ifndef ISO_BASE_FIELD_H
#define ISO_BASE_FIELD_H

#include <stdbool.h>
#include <stddef.h>

#include "base/record.h"

typedef enum iso_field_type {
    ISO_FIELD_REAL,
    ISO_FIELD_INT, /* int, or an enum */
    ISO_FIELD_LONG,
    ISO_FIELD_SIZE,
    ISO_FIELD_BOOL,
    ISO_FIELD_TEXT,   /* char[]: "" is none                                                   */
    ISO_FIELD_NAME,   /* const char *: NULL is none                                           */
    ISO_FIELD_STRUCT, /* another struct, with fields of its own                               */
    ISO_FIELD_RECORD, /* iso_record *; no column                                              */
    ISO_FIELD_LIST    /* structs, one after the other; pointers in their place: ISO_LIST_AT   */
} iso_field_type;

/* How a field is shown. */
enum {
    ISO_IN_TABLE = 1, /* in tables alone ...                                                           */
    ISO_IN_TREE = 2,  /* ... or in JSON alone. Neither of these bits: in both                          */
    ISO_OPTIONAL = 4, /* JSON leaves it out where it is not there; else it is null. A nan is there   */
    ISO_FROM_ONE = 8, /* a number that counts from 0, such as an axis, is shown from 1 on; < 0 is none */
    ISO_EMPTY = 16,   /* tables leave a nan out                                                        */
    ISO_QUOTED = 32   /* tables quote this text if it has a blank                                           */
};

enum { ISO_VALUE_ROOM = 64, ISO_COLUMN_SIZE = 64 };

typedef struct iso_value {
    bool there;
    double number;             /* that of a word is its place in the list of words; other texts: NaN     */
    const char *text;          /* of words and texts; else NULL                                          */
    char room[ISO_VALUE_ROOM]; /* for a text that is made                                                */
} iso_value;

typedef struct iso_field {
    const char *name; /* "": the members of the struct stand among those of the outer one; NULL ends a list   */
    iso_field_type type;
    size_t offset;
    int count;                      /* of numbers (0: one); of the structs of a list, if that is fixed       */
    const char *unit, *doc;         /* unit "": a number without one. doc: one line                         */
    const char *(*word)(int value); /* an int is shown as this word; of several numbers: their names          */
    const char *column;             /* its name in tables, if that is another one                           */
    int digits;                     /* in tables; 0: all                                                    */
    unsigned how;                   /* ISO_IN_TABLE, ...                                                    */
    const struct iso_field *fields; /* of a struct, or of each struct of a list                             */
    size_t size, counter;           /* of a list: size of a struct; offset of the number of structs ...       */
    size_t counter_size;            /* ... and its size (0: `count` are there)                              */
    bool pointer;                   /* the list, or the struct, is behind a pointer                         */
    bool (*skip)(const void *item); /* structs of a list that are left out; NULL: none                      */
    bool (*there)(const void *row); /* NULL: always                                                         */
    size_t when;                    /* there only if this bool is true, see ISO_WHEN; 0: always             */
    /* What finds a value that no member holds: a number, a bool, or whatever is set in *value. */
    double (*number)(const void *row);
    bool (*is)(const void *row);
    void (*find)(const void *row, int i, iso_value *value);
    /* The i-th struct of a list that is no array; NULL: there are no more. */
    const void *(*item)(const void *row, size_t i);
} iso_field;

/* clang-format off */
/* Fields of the struct T, for the lists of fields. Behind the doc may follow more, such as .word = ..., .how = ... */
#define ISO_FIELD_END {.name = NULL}

/* A member; its type and count are found. And `numbers` doubles from a member on. */
#define ISO_MEMBER(T, key, member, unit_, ...)                                                                        \
    {.name = key, .type = ISO_TYPE_OF(((T *)0)->member), .count = ISO_COUNT_OF(((T *)0)->member),                    \
     .offset = offsetof(T, member), .unit = unit_, .doc = __VA_ARGS__}
#define ISO_NUMBERS(T, key, member, numbers, unit_, ...)                                                             \
    {.name = key, .type = ISO_FIELD_REAL, .count = numbers, .offset = offsetof(T, member), .unit = unit_,            \
     .doc = __VA_ARGS__}

/* It is there only if this bool of T is true. */
#define ISO_WHEN(T, member) .when = offsetof(T, member) + 1

/* What a function makes from the struct: a double, a whole number, a bool, anything. */
#define ISO_NUMBER(key, function, unit_, ...)                                                                        \
    {.name = key, .type = ISO_FIELD_REAL, .number = function, .unit = unit_, .doc = __VA_ARGS__}
#define ISO_COUNT(key, function, unit_, ...)                                                                         \
    {.name = key, .type = ISO_FIELD_INT, .number = function, .unit = unit_, .doc = __VA_ARGS__}
#define ISO_IS(key, function, ...)                                                                                   \
    {.name = key, .type = ISO_FIELD_BOOL, .is = function, .unit = "", .doc = __VA_ARGS__}
#define ISO_FOUND(key, type_, finder, unit_, ...)                                                                    \
    {.name = key, .type = type_, .find = finder, .unit = unit_, .doc = __VA_ARGS__}

/* A struct in T; and fields of T itself, one level deeper. */
#define ISO_STRUCT(T, key, member, fields_, ...)                                                                     \
    {.name = key, .type = ISO_FIELD_STRUCT, .offset = offsetof(T, member), .fields = fields_, .doc = __VA_ARGS__}
#define ISO_GROUP(key, fields_, ...)                                                                                 \
    {.name = key, .type = ISO_FIELD_STRUCT, .fields = fields_, .doc = __VA_ARGS__}

/* Structs in an array of T; behind a pointer in T; in an array that is always full; and those that a function returns.
 * `number` is a member, an int or a size_t. */
#define ISO_LIST(T, key, member, number, fields_, ...)                                                               \
    {ISO_LIST_OF(T, key, member, fields_), ISO_COUNTER(T, number), .doc = __VA_ARGS__}
#define ISO_LIST_AT(T, key, member, number, fields_, ...)                                                            \
    {ISO_LIST_OF(T, key, member, fields_), ISO_COUNTER(T, number), .pointer = true, .doc = __VA_ARGS__}
#define ISO_ARRAY(T, key, member, fields_, ...)                                                                      \
    {ISO_LIST_OF(T, key, member, fields_), .count = sizeof((T *)0)->member / sizeof *((T *)0)->member,               \
     .doc = __VA_ARGS__}
#define ISO_ITEMS(key, function, fields_, ...)                                                                       \
    {.name = key, .type = ISO_FIELD_LIST, .item = function, .fields = fields_, .doc = __VA_ARGS__}

#define ISO_LIST_OF(T, key, member, fields_)                                                                         \
    .name = key, .type = ISO_FIELD_LIST, .offset = offsetof(T, member), .size = sizeof *((T *)0)->member,            \
    .fields = fields_
#define ISO_COUNTER(T, number) .counter = offsetof(T, number), .counter_size = sizeof((T *)0)->number
#define ISO_TYPE_OF(x) _Generic((x), double: ISO_FIELD_REAL, double *: ISO_FIELD_REAL, int: ISO_FIELD_INT,           \
                                     unsigned: ISO_FIELD_INT, long: ISO_FIELD_LONG, size_t: ISO_FIELD_SIZE,          \
                                     bool: ISO_FIELD_BOOL, char *: ISO_FIELD_TEXT, const char *: ISO_FIELD_NAME,     \
                                     iso_record *: ISO_FIELD_RECORD)
#define ISO_COUNT_OF(x) _Generic((x), double *: (int)(sizeof(x) / sizeof(double)), default: 1)
/* clang-format on */

/* Value i of a field that is no struct, record or list, i from 0 to its count - 1. row NULL: there is none. */
void iso_field_read(const iso_field *field, const void *row, int i, iso_value *value);

/* Whether it has a value, a struct or a list in this row; row NULL: no. */
bool iso_field_is_there(const iso_field *field, const void *row);

/* The struct of a field, and the i-th of a list. NULL: there is none, or there are no more. */
const void *iso_field_struct(const iso_field *field, const void *row);
const void *iso_field_item(const iso_field *field, const void *row, size_t i);

/* Copies fields, all but `without` and those below it, "without.x" (NULL: all), to change them. At most
 * ISO_MOST_FIELDS - 1. */
enum { ISO_MOST_FIELDS = 64 };
void iso_fields_copy(const iso_field *fields, const char *without, iso_field copy[ISO_MOST_FIELDS]);

/* Calls `visit` for each column of a table, with its name and its value in this row (NULL: there are no values). */
typedef void iso_column_visitor(void *data, const char *name, const iso_field *field, const iso_value *value);
void iso_columns_visit(const iso_field *fields, const void *row, iso_column_visitor *visit, void *data);

/* The same for each number of a struct, also those that JSON alone has: "ball.exponent.t" is ball_exponent_t, and the
 * first struct of the list "rows" has rows1_m. The number of a word is its place in the list of words. Times that were
 * measured, in seconds, are left out. row NULL: of a list without a fixed length the first struct. */
void iso_numbers_visit(const iso_field *fields, const void *row, iso_column_visitor *visit, void *data);

/* A record with these columns, and a row of it. What is not there is NaN, or the empty word. Errors: as record.h. */
iso_status iso_columns_create(iso_context *ctx, const iso_field *fields, iso_record **record);
iso_status iso_columns_append(iso_context *ctx, const iso_field *fields, const void *row, iso_record *record);

/* Puts all that JSON shows of a struct into lines of a record: "ball.exponent.t", and of the structs of a list
 * "orbit.0.period". What is not there has no line. Errors: those of iso_record_set. */
iso_status iso_record_set_fields(iso_context *ctx, iso_record *record, const iso_field *fields, const void *row);

#endif

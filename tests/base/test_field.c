/* test_field.c - fields of structs: the values that are read, the columns and rows that are made of them, and that the
 * type of a field is the member's. */
#include "base/field.h"
#include "base/number_impl.h"
#include "laws.h"

typedef enum colour { RED, GREEN } colour;

typedef struct inner {
    double x, y[2];
} inner;

typedef struct outer {
    double real, vector[3];
    int whole, axis;
    long many;
    size_t size;
    bool yes;
    char text[16];
    const char *name;
    colour colour;
    inner in, out;
    int count;
    inner list[4];
    size_t others;
    inner *other;
} outer;

static const char *colour_word(int i)
{
    static const char *const words[] = {"red", "green"};
    return i < 2 ? words[i] : NULL;
}

static const char *clock_word(int i)
{
    static const char *const words[] = {"t", "tau", "s"};
    return words[i];
}

static void find_sum(const void *row, int i, iso_value *v)
{
    const outer *o = row;
    v->number = o->real + i;
}

static bool is_yes(const void *row)
{
    return ((const outer *)row)->yes;
}

static const iso_field inner_fields[] = {ISO_MEMBER(inner, "x", x, "", "a number"),
                                         ISO_MEMBER(inner, "y", y, "", "two numbers", .how = ISO_IN_TREE),
                                         ISO_FIELD_END};

static const iso_field fields[] = {
    ISO_MEMBER(outer, "real", real, "length", "a number"),
    ISO_MEMBER(outer, "short", real, "length", "the same", .digits = 3),
    ISO_MEMBER(outer, "vector", vector, "", "three numbers"),
    ISO_MEMBER(outer, "at.clock", vector, "", "the same", .word = clock_word),
    ISO_MEMBER(outer, "whole", whole, "", "an int", .column = "int"),
    ISO_MEMBER(outer, "axis", axis, "", "an axis", .how = ISO_FROM_ONE),
    ISO_MEMBER(outer, "many", many, "", "a long"),
    ISO_MEMBER(outer, "size", size, "", "a size"),
    ISO_MEMBER(outer, "yes", yes, "", "a bool"),
    ISO_MEMBER(outer, "text", text, "", "a text", .how = ISO_QUOTED),
    ISO_MEMBER(outer, "name", name, "", "a name"),
    ISO_MEMBER(outer, "colour", colour, "", "a word", .word = colour_word),
    ISO_FOUND("sum", ISO_FIELD_REAL, find_sum, "", "two sums", .count = 2),
    ISO_MEMBER(outer, "if", real, "", "a number that may not be there", .there = is_yes, .how = ISO_EMPTY),
    ISO_STRUCT(outer, "in", in, inner_fields, "a struct"),
    ISO_STRUCT(outer, "out", out, inner_fields, "another one", .there = is_yes),
    ISO_LIST(outer, "list", list, count, inner_fields, "no column"),
    ISO_FIELD_END,
};

static const iso_field lists[] = {
    ISO_LIST(outer, "list", list, count, inner_fields, "some"),
    ISO_LIST_AT(outer, "other", other, others, inner_fields, "behind a pointer"),
    ISO_ARRAY(outer, "all", list, inner_fields, "all"),
    ISO_FIELD_END,
};

static const iso_field *find(const char *name)
{
    const iso_field *f = fields;
    while (strcmp(f->name, name) != 0) f++;
    return f;
}

static double number_of(const char *name, const outer *o, int i)
{
    iso_value v;
    iso_field_read(find(name), o, i, &v);
    return v.there ? v.number : (double)NAN;
}

static void test_values(const outer *o)
{
    iso_value v;
    gsl_test(number_of("real", o, 0) != 0.1, "real");
    gsl_test(number_of("vector", o, 2) != 3, "the third of a vector");
    gsl_test(number_of("whole", o, 0) != -7, "int");
    gsl_test(number_of("axis", o, 0) != 3, "an axis counts from 1");
    gsl_test(number_of("many", o, 0) != -1e12, "long");
    gsl_test(number_of("size", o, 0) != 1e15, "size_t");
    gsl_test(number_of("colour", o, 0) != GREEN, "a word is a number, too");
    gsl_test(number_of("sum", o, 1) != 1.1, "a sum");
    gsl_test(!isnan(number_of("if", o, 0)), "not there");
    iso_field_read(find("colour"), o, 0, &v);
    gsl_test(strcmp(v.text, "green") != 0, "a word");
    iso_field_read(find("real"), NULL, 0, &v);
    gsl_test(v.there, "without a row there is no value");
}

static void test_lists(const outer *o)
{
    static const size_t counts[] = {2, 3, 4};
    for (int f = 0; f < 3; f++) {
        size_t count = 0;
        for (const inner *x; (x = iso_field_item(&lists[f], o, count)); count++)
            gsl_test(x->x != (double)(10 * (f == 1) + (int)count), "item %zu of %s", count, lists[f].name);
        gsl_test(count != counts[f], "%zu structs in %s", count, lists[f].name);
    }
}

static void append_name(void *data, const char *name, const iso_field *field, const iso_value *value)
{
    char *text = data;
    gsl_test(!*field->doc || !field->unit || !value->there, "%s: meaning, unit or value is missing", name);
    strcat(strcat(text, name), ",");
}

/* The first row of a record made of these fields, as numbers of all digits and words. */
static void print_row(iso_context *ctx, const iso_field *list, const void *row, char text[400])
{
    iso_record *r = NULL;
    *text = '\0';
    gsl_test(iso_columns_create(ctx, list, &r) != ISO_OK || iso_columns_append(ctx, list, row, r) != ISO_OK, "%s",
             iso_context_message(ctx));
    for (size_t i = 0; r && i < iso_record_columns(r); i++) {
        const double x = iso_record_const_row(r, 0)[i];
        char number[ISO_NUMBER_SIZE];
        iso_number_print(number, x);
        strcat(strcat(text, iso_record_has_words(r, i) ? iso_record_word(r, x) : isnan(x) ? "nan" : number), ",");
    }
    iso_record_free(r);
}

static void test_columns(iso_context *ctx, const outer *o)
{
    char text[400] = "";
    outer all = *o; /* here all values are there */
    all.yes = true;
    all.name = "c";
    iso_columns_visit(fields, &all, append_name, text);
    gsl_test(strcmp(text, "real,short,vector1,vector2,vector3,at_clock_t,at_clock_tau,at_clock_s,int,axis,many,size,"
                          "yes,text,name,colour,sum1,sum2,if,in_x,out_x,") != 0,
             "columns: %s", text);
    print_row(ctx, fields, o, text);
    gsl_test(strcmp(text, "0.10000000000000001,0.10000000000000001,1,2,3,1,2,3,-7,3,-1000000000000,1000000000000000,"
                          "0,a \"b\",,green,0.10000000000000001,1.1000000000000001,nan,5,nan,") != 0,
             "row: %s", text);
}

static void test_record(iso_context *ctx, const outer *o)
{
    iso_record *r = NULL;
    if (iso_columns_create(ctx, fields, &r) != ISO_OK || iso_columns_append(ctx, fields, o, r) != ISO_OK)
        gsl_test(1, "%s", iso_context_message(ctx));
    iso_record_set_words(r, (size_t)iso_record_find(r, "colour"), false);
    gsl_test(iso_columns_append(ctx, fields, o, r) != ISO_OK ||
                 iso_record_const_row(r, 1)[iso_record_find(r, "colour")] != GREEN,
             "a word in a column of numbers is its number");
    iso_record_free(r);
}

static double double_of(const void *row)
{
    return 2 * ((const outer *)row)->real;
}

static void test_functions(iso_context *ctx, const outer *o)
{
    static const iso_field made[] = {ISO_NUMBER("double", double_of, "", "a number"),
                                     ISO_COUNT("count", double_of, "", "a whole number"),
                                     ISO_IS("yes", is_yes, "a bool"),
                                     ISO_MEMBER(outer, "when", real, "", "a member", ISO_WHEN(outer, yes)),
                                     ISO_STRUCT(outer, "group", in, inner_fields, "a struct", ISO_WHEN(outer, yes)),
                                     ISO_FIELD_END};
    outer all = *o;
    char text[400];
    print_row(ctx, made, o, text);
    gsl_test(strcmp(text, "0.20000000000000001,0.20000000000000001,0,nan,nan,") != 0, "without: %s", text);
    all.yes = true;
    print_row(ctx, made, &all, text);
    gsl_test(strcmp(text, "0.20000000000000001,0.20000000000000001,1,0.10000000000000001,5,") != 0, "with: %s", text);
}

static void test_copy(void)
{
    enum { ALL = sizeof fields / sizeof *fields };
    iso_field copy[ISO_MOST_FIELDS];
    iso_fields_copy(fields, NULL, copy);
    gsl_test(!copy[ALL - 2].name || copy[ALL - 1].name, "a copy of all fields");
    iso_fields_copy(fields, "vector", copy);
    gsl_test(strcmp(copy[2].name, "at.clock") != 0 || !copy[ALL - 3].name || copy[ALL - 2].name,
             "a copy without one");
}

/* A row with more columns than a list can have would be written past its end. */
static void test_too_many(iso_context *ctx)
{
    static const iso_field wide[] = {{.name = "a", .count = ISO_MOST_FIELDS, .unit = "", .doc = "just as many"},
                                     ISO_FIELD_END};
    static const iso_field wider[] = {{.name = "a", .count = ISO_MOST_FIELDS, .unit = "", .doc = "just as many"},
                                      {.name = "b", .unit = "", .doc = "one more"},
                                      ISO_FIELD_END};
    iso_record *record;
    gsl_test(iso_columns_create(ctx, wide, &record) != ISO_OK || iso_record_columns(record) != ISO_MOST_FIELDS,
             "the most columns");
    iso_record_free(record);
    gsl_test(iso_columns_create(ctx, wider, &record) != ISO_BAD_ARGUMENT || record, "one more column is refused");
    iso_record_free(record);
}

int main(void)
{
    inner others[3] = {{.x = 10}, {.x = 11}, {.x = 12}};
    const outer o = {.real = 0.1,
                     .vector = {1, 2, 3},
                     .whole = -7,
                     .axis = 2,
                     .many = -1000000000000,
                     .size = 1000000000000000,
                     .text = "a \"b\"",
                     .colour = GREEN,
                     .in = {.x = 5},
                     .count = 2,
                     .list = {{.x = 0}, {.x = 1}, {.x = 2}, {.x = 3}},
                     .others = 3,
                     .other = others};
    test_values(&o);
    test_lists(&o);
    test_copy();
    iso_context *ctx = iso_context_create();
    test_columns(ctx, &o);
    test_functions(ctx, &o);
    test_record(ctx, &o);
    test_too_many(ctx);
    iso_context_free(ctx);
    return gsl_test_summary();
}

/* test_table.c - files of tables of every kind, as CSV and as HDF5: what is written reads back exactly, numbers, nan,
 * words, lines and texts; damaged files are refused with the place. */
#include <float.h>
#include <gsl/gsl_math.h>

#include "base/field.h"
#include "folder.h"
#include "io/table.h"

static iso_context *ctx;
static bool has_hdf5; /* the build has it */

/* --- there and back --------------------------------------------------------------------------------------------- */

/* A kind of table with its columns: @ stands before those of words, of which `reason` is empty in most rows. */
static const struct {
    const char *kind, *columns;
} tables[] = {
    {"section", "orbit,crossing,t,tau,s,l,x,omega1,omega2,omega3,n1,n2,n3"},
    {"section", "orbit,crossing,t,n3"},
    {"chaos", "orbit,l,x,@verdict,@ball_verdict,ball_turns,ball_megno"},
    {"periodic", "orbit,period,l,x,trace,error,@stability,@symmetry,t,tau,s,M1,M2,M3,gamma1,gamma2,gamma3"},
    {"periodic follow", "branch,@line,period,k,l,x,trace,@event"},
    {"periodic chart", "@kind,k,J2,least,greatest"},
    {"splitting", "k,x,m,error,x_error,multiplier,digits,zero,level"},
    {"cost", "@backend,@method,tolerance,error,steps,@failure"},
    {"sweep", "point,k,state_n1,status,@reason"},
    {"sweep part", "point,k,state_n1,status,@reason"},
    {"check", "@name,worst,row,@of,above_the_bound"},
    {"section area", "orbit,@model,turns,worst,bound,@area,@failure"},
    {"something new", "a,b,omega2,worst,name"},
    {"something new", "@method"},
    {"something new", "omega1,@b,c,@of"},
};

/* What rows of a sweep are bound to: points by growing number, and reasons for those that have failed. */
static void make_sweep(iso_record *r)
{
    iso_record_set(ctx, r, "names", "vary/k state/n1");
    iso_record_set(ctx, r, "hash", "00123456789012345678901234567890");
    const size_t step = strcmp(iso_record_kind(r), "sweep") == 0 ? 1 : 3;
    for (size_t i = 0; i < iso_record_rows(r); i++) {
        double *row = iso_record_row(r, i);
        row[0] = (double)(step * i);
        row[3] = row[4] > 0 ? 5 : 0;
    }
}

static iso_record *make(const char *kind, const char *columns, size_t rows)
{
    static const double numbers[] = {0.1, -1e-300, DBL_MAX, 4.9e-324, 1e22, -0.0, 1.0 / 3, M_PI, 7};
    static const char *const words[] = {"", "chaotic", "R, S1 S2 and T", "it \"said\" so", "nan", "12", "#a"};
    char text[512], *rest = text;
    const char *names[64];
    const bool finite = strcmp(kind, "section") == 0; /* the writer refuses others */
    bool is_word[64];
    iso_record *r;
    size_t count = 0;
    snprintf(text, sizeof text, "%s", columns);
    for (char *name; (name = strsep(&rest, ",")); count++) {
        is_word[count] = *name == '@';
        names[count] = name + is_word[count];
    }
    if (iso_record_create(ctx, count, names, &r) != ISO_OK) exit(1);
    iso_record_set_kind(r, kind);
    for (size_t c = 0; c < count; c++)
        if (is_word[c]) iso_record_set_words(r, c, true);
    iso_record_set(ctx, r, "model", "both: ball and point");
    iso_record_set_numbers(ctx, r, "J", 3, numbers);
    iso_record_set(ctx, r, "isoroll", "0.1.0");
    iso_record_set(ctx, r, "scene", "one: 1\n\n  two | three\n# four\n");
    for (size_t i = 0; i < rows; i++) {
        double *row;
        if (iso_record_append(ctx, r, &row) != ISO_OK) exit(1);
        for (size_t c = 0; c < count; c++)
            if (is_word[c])
                iso_record_intern(ctx, r, words[(3 * i + c) % 7], &row[c]);
            else
                row[c] = finite              ? numbers[(i + c) % 9]
                         : (i + c) % 5 == 4  ? (double)NAN
                         : (i + c) % 11 == 3 ? -INFINITY
                                             : numbers[(i + c) % 9];
    }
    if (strncmp(kind, "sweep", 5) == 0) make_sweep(r);
    return r;
}

static bool same_cell(const iso_record *a, const iso_record *b, size_t row, size_t c)
{
    const double x = iso_record_const_row(a, row)[c], y = iso_record_const_row(b, row)[c];
    if (iso_record_has_words(a, c)) return strcmp(iso_record_word(a, x), iso_record_word(b, y)) == 0;
    return (isnan(x) && isnan(y)) || (x == y && signbit(x) == signbit(y));
}

/* Lines in any order: HDF5 has none. */
static bool same_lines(const iso_record *a, const iso_record *b)
{
    const char *key, *value, *other;
    bool same = true;
    for (size_t i = 0; iso_record_line(a, i, &key, &value); i++)
        same = same && (other = iso_record_get(b, key)) && strcmp(value, other) == 0;
    return same;
}

static bool same(const iso_record *a, const iso_record *b)
{
    bool good = strcmp(iso_record_kind(a), iso_record_kind(b)) == 0 && same_lines(a, b) && same_lines(b, a) &&
                iso_record_columns(a) == iso_record_columns(b) && iso_record_rows(a) == iso_record_rows(b);
    for (size_t c = 0; good && c < iso_record_columns(a); c++) {
        good = strcmp(iso_record_name(a, c), iso_record_name(b, c)) == 0 &&
               iso_record_has_words(a, c) == iso_record_has_words(b, c);
        for (size_t i = 0; good && i < iso_record_rows(a); i++) good = same_cell(a, b, i, c);
    }
    return good;
}

/* Writes, reads, and writes what was read: the same record, and the same text. */
static void there_and_back(const iso_record *r, const char *name)
{
    const char *path = in_folder(name), *again = in_folder("again.csv"), *first = in_folder("first.csv");
    iso_record *read = NULL;
    iso_status status = iso_table_write(ctx, path, r);
    if (status == ISO_OK) status = iso_table_read(ctx, path, iso_record_kind(r), NULL, &read, NULL);
    if (status == ISO_BAD_ARGUMENT && strstr(iso_context_message(ctx), "no HDF5")) return;
    has_hdf5 = has_hdf5 || strstr(name, ".h5");
    gsl_test(status != ISO_OK, "%s, %s: %s", name, iso_record_kind(r), iso_context_message(ctx));
    if (status != ISO_OK) return;
    gsl_test(!same(r, read), "%s, %s of %zu rows: it reads back exactly", name, iso_record_kind(r),
             iso_record_rows(r));
    if (strstr(name, ".csv") && iso_table_write(ctx, again, read) == ISO_OK &&
        iso_table_write(ctx, first, r) == ISO_OK) {
        char *const text = strdup(file_text(again));
        gsl_test(!text || strcmp(text, file_text(first)) != 0, "%s: the same text again", iso_record_kind(r));
        free(text);
    }
    iso_record_free(read);
    gsl_test(iso_table_read(ctx, path, "orbit of nobody", NULL, &read, NULL) != ISO_BAD_INPUT || read,
             "%s: another kind is wanted", name);
}

static void test_kinds(void)
{
    static const size_t rows[] = {0, 1, 40, 9000};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        for (size_t n = 0; n < sizeof rows / sizeof *rows; n++) {
            iso_record *r = make(tables[i].kind, tables[i].columns, rows[n]);
            there_and_back(r, "table.csv");
            there_and_back(r, "table.h5");
            iso_record_free(r);
        }
}

/* --- words ------------------------------------------------------------------------------------------------------ */

static void test_words(void)
{
    enum { MANY = 3000 };
    static const char *const names[] = {"number", "new"};
    iso_record *r;
    double number[MANY], again;
    char word[32];
    if (iso_record_create(ctx, 2, names, &r) != ISO_OK) exit(1);
    int bad = 0;
    for (int i = 0; i < MANY; i++) {
        snprintf(word, sizeof word, "word %d", i);
        bad += iso_record_intern(ctx, r, word, &number[i]) != ISO_OK;
    }
    for (int i = 0; i < MANY; i++) {
        snprintf(word, sizeof word, "word %d", i);
        bad += iso_record_intern(ctx, r, word, &again) != ISO_OK || again != number[i] ||
               strcmp(iso_record_word(r, again), word) != 0;
    }
    gsl_test(bad, "%d of %d words are not found again", bad, MANY);
    gsl_test(iso_record_intern(ctx, r, "", &again) != ISO_OK || again != 0 || *iso_record_word(r, 0) ||
                 *iso_record_word(r, -1) || *iso_record_word(r, MANY + 1) || *iso_record_word(r, NAN),
             "numbers of no word are the empty word");
    iso_record_free(r);
}

/* Tables of earlier states have no line of words: words are what is no number, empty cells what the others are. */
static void test_older(void)
{
    iso_record *r;
    const char *path = in_folder("good.csv");
    const char *const made = "# isoroll periodic follow 1\nbranch,x,event,line,none\n0,,,S1,\n1,nan,,S2,\n"
                             "2,0.5,\"it folds, 2\",,\n3,,,R,\n";
    put_file(path, made, strlen(made));
    gsl_test(iso_table_read(ctx, path, NULL, NULL, &r, NULL) != ISO_OK, "%s", iso_context_message(ctx));
    if (!r) return;
    static const bool words[] = {false, false, true, true, true};
    static const char *const cells[][3] = {{"", "S1", ""}, {"", "S2", ""}, {"it folds, 2", "", ""}, {"", "R", ""}};
    for (size_t c = 0; c < 5; c++)
        gsl_test(iso_record_has_words(r, c) != words[c], "%s: words or numbers", iso_record_name(r, c));
    for (size_t i = 0; i < 4; i++) {
        const double *row = iso_record_const_row(r, i);
        gsl_test(i == 2 ? row[1] != 0.5 : !isnan(row[1]), "an empty cell among numbers is nan");
        for (size_t c = 2; c < 5; c++)
            gsl_test(!isfinite(row[c]) || strcmp(iso_record_word(r, row[c]), cells[i][c - 2]) != 0, "row %zu, %s", i,
                     iso_record_name(r, c));
    }
    iso_record_free(r);
}

/* --- what a file would not give back ---------------------------------------------------------------------------- */

/* Refused by both formats, and nothing is left of the file. */
static void refuse_write(const char *kind, const char *columns, const char *key, const char *value)
{
    iso_record *r = make(kind, columns, 2);
    if (key) iso_record_set(ctx, r, key, value);
    for (int i = 0; i < (has_hdf5 ? 2 : 1); i++) {
        const char *path = in_folder(i ? "table.h5" : "table.csv");
        unlink(path);
        gsl_test(iso_table_write(ctx, path, r) != ISO_BAD_ARGUMENT || access(path, F_OK) == 0,
                 "%s with the columns %s, %s: %s", path, columns, key ? key : "no line", iso_context_message(ctx));
    }
    iso_record_free(r);
}

static void test_lost(void)
{
    static const char *const columns[] = {".", "..", "#k,l", "a\"b,l", "a\nb,l"};
    static const char *const lines[][2] = {{"a:b", "x"}, {"a", " x"}, {"a", "x\r"}, {"a", "x\ny"}, {"", "x"}};
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) refuse_write("mine", columns[i], NULL, NULL);
    refuse_write("mine", "a,@two words", NULL, NULL);
    refuse_write("section", "t,@n1", NULL, NULL);
    refuse_write("mine", "a,@b", "words", "b");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) refuse_write("mine", "a,b", lines[i][0], lines[i][1]);
    iso_record *r;
    if (iso_record_create(ctx, 0, NULL, &r) != ISO_OK) exit(1);
    gsl_test(iso_table_write(ctx, in_folder("table.csv"), r) != ISO_BAD_ARGUMENT, "a table without columns");
    iso_record_free(r);
}

/* --- fields ----------------------------------------------------------------------------------------------------- */

typedef struct thing {
    double whole, error;
    int number;
    const char *kind, *reason;
} thing;

/* What fields make of a struct: digits of their own, words, and empty cells where nothing is there. */
static void test_fields(void)
{
    static const iso_field fields[] = {ISO_MEMBER(thing, "whole", whole, "", "all digits, or nan"),
                                       ISO_MEMBER(thing, "error", error, "", "few", .digits = 3),
                                       ISO_MEMBER(thing, "if", error, "", "empty if not finite", .how = ISO_EMPTY),
                                       ISO_MEMBER(thing, "number", number, "", "from 1", .how = ISO_FROM_ONE),
                                       ISO_MEMBER(thing, "kind", kind, "", "a text"),
                                       ISO_MEMBER(thing, "reason", reason, "", "a text", .how = ISO_QUOTED),
                                       ISO_FIELD_END};
    static const thing things[] = {
        {0.1, 1.0 / 3, 4, "one, two", "x y"}, {NAN, INFINITY, -1, NULL, "y"}, {1, 0.25, 0, "it is so", ""}};
    iso_record *r = NULL;
    iso_status status = iso_columns_create(ctx, fields, &r);
    for (size_t i = 0; status == ISO_OK && i < 3; i++) status = iso_columns_append(ctx, fields, &things[i], r);
    if (status == ISO_OK) iso_record_set_kind(r, "things");
    if (status == ISO_OK) status = iso_table_write(ctx, in_folder("fields.csv"), r);
    gsl_test(status != ISO_OK, "fields: %s", iso_context_message(ctx));
    const char *text = file_text(in_folder("fields.csv"));
    gsl_test(strcmp(text, "# isoroll things 1\n# words: kind reason\nwhole,error,if,number,kind,reason\n"
                          "0.10000000000000001,0.333,0.33333333333333331,5,\"one, two\",\"x y\"\n"
                          "nan,inf,,,,y\n1,0.25,0.25,1,it is so,\n"),
             "rows made of fields: %s", text);
    if (status == ISO_OK && has_hdf5) there_and_back(r, "fields.h5");
    iso_record_free(r);
}

/* A row of a trajectory or a section is finite, or a mark: nan in every column. Marks are passed over if that is asked.
 */
static void test_finite(void)
{
    static const char *const kinds[] = {"trajectory", "section", "periodic"}, *const names[] = {"t", "n1"};
    static const double good[] = {1, 2}, bad[] = {1, NAN};
    const char *path = in_folder("good.csv");
    for (int i = 0; i < 3; i++) {
        iso_table_writer *w;
        iso_record *r, *read;
        size_t passed;
        if (iso_record_create(ctx, 2, names, &r) != ISO_OK) exit(1);
        iso_status status = iso_table_writer_open(ctx, path, kinds[i], &w);
        if (status == ISO_OK) status = iso_table_write_header(ctx, w, r);
        gsl_test(status != ISO_OK, "%s: %s", kinds[i], iso_context_message(ctx));
        gsl_test(iso_table_write_row(ctx, w, bad) != (i < 2 ? ISO_NUMERICAL : ISO_OK), "%s: nan", kinds[i]);
        gsl_test(iso_table_write_row(ctx, w, NULL) != (i < 2 ? ISO_OK : ISO_BAD_ARGUMENT), "%s: a mark", kinds[i]);
        gsl_test(iso_table_write_row(ctx, w, good) != ISO_OK || iso_table_writer_close(ctx, w, true) != ISO_OK,
                 "%s: a row", kinds[i]);
        iso_record_free(r);
        if (i > 0) continue;
        gsl_test(iso_table_read(ctx, path, kinds[i], NULL, &r, NULL) != ISO_BAD_INPUT || r, "a mark is refused");
        status = iso_table_read(ctx, path, kinds[i], NULL, &read, &passed);
        gsl_test(status != ISO_OK || passed != 1 || iso_record_rows(read) != 1, "a mark is passed over");
        if (status == ISO_OK) iso_record_free(read);
    }
}

/* --- damaged files ---------------------------------------------------------------------------------------------- */

static void refuse(const char *text, const char *words)
{
    iso_record *r;
    const char *path = in_folder("bad.csv");
    put_file(path, text, strlen(text));
    const iso_status status = iso_table_read(ctx, path, NULL, NULL, &r, NULL);
    const char *message = iso_context_message(ctx);
    const char *found = status == ISO_BAD_INPUT && !r ? strstr(message, words) : NULL;
    gsl_test(!found || strncmp(message, path, strlen(path)) != 0, "'%s' is wanted: status %d, %s", words, (int)status,
             message);
    iso_record_free(r);
}

static void test_damaged(void)
{
#define HEAD "# isoroll chaos 1\n# k: 1\norbit,l,verdict\n"
#define TYPED "# isoroll chaos 1\n# words: verdict\norbit,l,verdict\n"
    refuse("", ":1:1: expected a line of column names");
    refuse("orbit,l,verdict\n0,1,x\n", ":1:1: expected '# isoroll KIND 1'");
    refuse("# isoroll\norbit\n", ":1:1: expected '# isoroll KIND 1'");
    refuse("# isoroll chaos 2\norbit\n", ":1:17: expected version 1 of the format, not 2");
    refuse("# isoroll chaos 1\n", "expected a line of column names");
    refuse("# isoroll chaos 1\n# no key\norbit\n", ":2:1: expected '# key: value'");
    refuse("# isoroll chaos 1\n# k: 1\n# k: 2\norbit\n", ":3:3: duplicate key k");
    refuse("# isoroll chaos 1\norbit,,l\n", ":2:7: expected the name of a column");
    refuse("# isoroll chaos 1\norbit,orbit\n", ":2:1: expected names of columns, all different");
    refuse(HEAD "0,1.5\n", ":4:6: expected more cells");
    refuse(HEAD "0,1.5,regular,2\n", ":4:15: expected one cell for each column, found more");
    refuse(HEAD "0,1.5,regular\n0,1.5x,regular\n", ":5:3: expected a number for l, not 1.5x");
    refuse(HEAD "0,1.5,\"regular\n", ":4:7: expected a closing quote");
    refuse(HEAD "0,infinity,regular\n", ":4:3: expected a number for l, not infinity");
    refuse(HEAD "0,0x,regular\n", ":4:3: expected a number for l");
    refuse(HEAD "0,abc,regular\n1,0.5,regular\n",
           ":5:3: expected a word for l, as in the rows before, not the number");
    refuse(HEAD "0,0.5,regular\n1,abc,regular\n", ":5:3: expected a number for l, not abc");
    refuse("# isoroll periodic 1\nperiod,n1\n1,abc\n", ":3:3: expected a number for n1, not abc");
    refuse("# isoroll section 1\norbit,x\n0,abc\n", ":3:3: expected a number for x, not abc");
    refuse(TYPED "0,abc,regular\n", ":4:3: expected a number for l, not abc");
    refuse("# isoroll chaos 1\n# words: verdict l\norbit,verdict\n",
           ":3:1: the line '# words: ...' names the column 'l'");
    refuse(TYPED "0,0.5,regular\n# words: l\n", ":5:3: expected the line of words before the names");
    if (has_hdf5) refuse("\211HDF\r\n\032\n and nothing else", "this is not an HDF5 file, or it is damaged");
#undef HEAD
#undef TYPED
}

/* What isoroll wrote is read with the ends of lines of other systems, empty lines, and lines behind the rows. */
static void test_tolerated(void)
{
    iso_record *r;
    const char *path = in_folder("good.csv");
    const char *const made =
        "# isoroll cost 1\r\n# k: 1\r\nbackend,error,failure\r\n\r\nball,,\"a \"\"b\"\"\"\r\npoint,-nan,\r\n"
        "# later: yes\r\n# | text\r\n# |\r\n# | more";
    put_file(path, made, strlen(made));
    gsl_test(iso_table_read(ctx, path, "cost", NULL, &r, NULL) != ISO_OK, "%s", iso_context_message(ctx));
    if (!r) return;
    const double *row = iso_record_const_row(r, 0);
    gsl_test(iso_record_rows(r) != 2 || !isnan(row[1]) || !isnan(row[4]) ||
                 strcmp(iso_record_word(r, row[2]), "a \"b\"") != 0 ||
                 strcmp(iso_record_word(r, row[3]), "point") != 0,
             "cells of a text of another system");
    const char *later = iso_record_get(r, "later"), *text = iso_record_get(r, "sweep");
    gsl_test(!later || strcmp(later, "yes") != 0, "a line behind the rows");
    gsl_test(!text || strcmp(text, "text\n\nmore\n") != 0, "a text behind the rows");
    iso_record_free(r);
}

/* A text may have lines of megabytes. */
static void test_long_lines(void)
{
    enum { LONG = 3000000 };
    char *text = malloc(LONG + 2);
    iso_record *r = make("sweep", "point,k,state_n1,status,@reason", 3);
    if (!text) exit(1);
    memset(text, 'x', LONG);
    memcpy(text + LONG, "\n", 2);
    iso_record_set(ctx, r, "sweep", text);
    there_and_back(r, "long.csv");
    free(text);
    iso_record_free(r);
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx || !mkdtemp(folder)) return 1;
    test_kinds();
    test_words();
    test_older();
    test_lost();
    test_fields();
    test_finite();
    test_damaged();
    test_tolerated();
    test_long_lines();
    static const char *const files[] = {"table.csv", "table.h5", "again.csv",  "first.csv", "bad.csv",
                                        "good.csv",  "long.csv", "fields.csv", "fields.h5"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) unlink(in_folder(files[i]));
    gsl_test(rmdir(folder) != 0, "nothing is left over");
    iso_context_free(ctx);
    return gsl_test_summary();
}

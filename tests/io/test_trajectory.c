/* test_trajectory.c - trajectory files: exact round trips, what is let pass, what is refused and where, and that a
 * target is either whole or untouched. */
#include <float.h>
#include <gsl/gsl_math.h>
#include <signal.h>

#include "folder.h"
#include "io/table_impl.h"

static iso_context *ctx;

/* For gsl_test, which wants 0 for a test passed. */
static int failed(iso_status status)
{
    return status != ISO_OK;
}

static iso_record *make_record(void)
{
    static const char *const names[] = {"t", "omega1", "n1"};
    static const double rows[][3] = {{0, 0.1, -1e-300},
                                     {1.0 / 3, DBL_MAX, DBL_MIN},
                                     {1e22, -0.0, 4.9e-324},
                                     {M_PI, DBL_EPSILON, 1},
                                     {-7, 123456789.123456789, 2.0 / 3}};
    iso_record *record;
    double *row;
    if (iso_record_create(ctx, 3, names, &record) != ISO_OK) exit(1);
    iso_record_set(ctx, record, "model", "ball");
    iso_record_set_numbers(ctx, record, "J", 3, rows[3]);
    iso_record_set(ctx, record, "empty", "");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (iso_record_append(ctx, record, &row) == ISO_OK) memcpy(row, rows[i], sizeof rows[i]);
    return record;
}

/* Writes with so many digits. */
static iso_status write_digits(const char *path, const iso_record *a, int digits)
{
    iso_table_writer *w;
    iso_status status = iso_table_writer_open(ctx, path, "trajectory", &w);
    if (status != ISO_OK) return status;
    iso_table_set_digits(w, digits);
    status = iso_table_write_header(ctx, w, a);
    for (size_t i = 0; status == ISO_OK && i < iso_record_rows(a); i++)
        status = iso_table_write_row(ctx, w, iso_record_const_row(a, i));
    const iso_status closed = iso_table_writer_close(ctx, w, status == ISO_OK);
    return status == ISO_OK ? closed : status;
}

/* Text of 17 digits, hexadecimal, and HDF5 if the build has it: numbers read back bit by bit. */
static void test_round_trip(const char *name, int digits)
{
    iso_record *a = make_record(), *b = NULL;
    const char *path = in_folder(name), *key, *value;
    const iso_status written = write_digits(path, a, digits);
    if (written == ISO_BAD_ARGUMENT && strstr(iso_context_message(ctx), "no HDF5")) {
        iso_record_free(a);
        return;
    }
    gsl_test(failed(written), "write: %s", iso_context_message(ctx));
    gsl_test(failed(iso_table_read(ctx, path, "trajectory", NULL, &b, NULL)), "read: %s", iso_context_message(ctx));
    if (!b) exit(1);
    gsl_test(iso_record_rows(b) != iso_record_rows(a) || iso_record_columns(b) != 3, "as many rows and columns");
    for (size_t i = 0; i < iso_record_rows(b); i++)
        gsl_test(memcmp(iso_record_const_row(a, i), iso_record_const_row(b, i), 3 * sizeof(double)) != 0,
                 "%s: row %zu reads back bit by bit", name, i);
    for (size_t i = 0; iso_record_line(a, i, &key, &value); i++)
        gsl_test(!iso_record_get(b, key) || strcmp(iso_record_get(b, key), value) != 0, "%s: line %s", name, key);
    gsl_test(strcmp(iso_record_name(b, 1), "omega1") != 0, "names");
    gsl_test(files_in_folder() != 1, "no temporary file is left");
    iso_record_free(a);
    iso_record_free(b);
    unlink(path);
}

/* Row by row: a bad row is passed, a mark is one, a line may follow the rows. */
static void test_rows(void)
{
    static const char text[] = "# isoroll trajectory 1\n# k: 1\nt,n1\n1,2\n3,x\n\nnan,nan\n4,5\n# k: 2\n";
    const char *path = in_folder("a.csv"), *const ignored = "x,t,n1,\n1,2,3,4\n";
    iso_table_reader *r;
    double row[2];
    bool more;
    put_file(path, text, sizeof text - 1);
    gsl_test(failed(iso_table_reader_open(ctx, path, "trajectory", NULL, &r)), "opened: %s",
             iso_context_message(ctx));
    gsl_test(iso_table_next(ctx, r, row, &more) != ISO_OK || !more || row[1] != 2, "a row");
    gsl_test(iso_table_next(ctx, r, row, &more) != ISO_BAD_INPUT, "a bad one");
    gsl_test(iso_table_at(r)->line != 5 || !strstr(iso_context_message(ctx), ":5:3: "), "and its line");
    gsl_test(iso_table_next(ctx, r, row, &more) != ISO_BAD_INPUT || iso_table_at(r)->line != 7, "a mark");
    gsl_test(iso_table_next(ctx, r, row, &more) != ISO_OK || !more || row[1] != 5, "the row behind them");
    gsl_test(iso_table_next(ctx, r, row, &more) != ISO_OK || more, "the end");
    gsl_test(strcmp(iso_record_get(iso_table_header(r), "k"), "2") != 0, "a line behind the rows");
    gsl_test(iso_table_at(r)->ignored != NULL, "nothing is passed over");
    iso_table_reader_close(r);
    put_file(path, ignored, strlen(ignored));
    gsl_test(failed(iso_table_reader_open(ctx, path, "trajectory", NULL, &r)), "opened: %s",
             iso_context_message(ctx));
    gsl_test(!iso_table_at(r)->ignored || !strstr(iso_table_at(r)->ignored, "'x'"), "x is passed over");
    gsl_test(iso_table_next(ctx, r, row, &more) != ISO_OK || row[0] != 2 || row[1] != 3, "the others are read");
    iso_table_reader_close(r);
    gsl_test(failed(iso_table_reader_open(ctx, path, "trajectory", "n1,-,-,t", &r)), "named: %s",
             iso_context_message(ctx));
    gsl_test(iso_table_next(ctx, r, row, &more) != ISO_OK || row[0] != 1 || row[1] != 4, "by the caller's names");
    iso_table_reader_close(r);
    gsl_test(iso_table_reader_open(ctx, path, "trajectory", "n1,t,t", &r) != ISO_BAD_ARGUMENT || r, "a name twice");
    unlink(path);
}

/* Files people and other programs make. */
static void test_accepted(void)
{
    static const char *const texts[] = {
        "t,n1\n1,2\n3,4\n",
        "t,n1\r\n1,2\r\n3,4\r\n",
        "t,n1\n1,2\n3,4",
        "\xEF\xBB\xBFt,n1\n1,2\n3,4\n",
        "# isoroll trajectory 1\n# k: 2\n#no colon\n\n t , n1 \n 1,\t2 \n# interrupted: yes\n3,4\n\n",
        "# isoroll trajectory 1\r\n# k: 2\r\nt,n1\r\n1,2\r\n3.0,+4e0\r\n",
        "t;n1\n1;2\n3;4\n",
        "  t   n1\n  1   2\n  0.3D+01   4d0  \n",
        "t\tn1\n1\t2\n3\t4\n",
        "# t n1\n1 2\n3 4\n",
        "\"t\",\"n1\"\n1,2\n3,4\n",
        "t,n1,colour,\n1,2,red,\n3,4,\"deep blue\",\n",
        "t,n1\n1,2\n0x1.8p+1,0X4\n",
    };
    const char *path = in_folder("a.csv");
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        iso_record *record;
        put_file(path, texts[i], strlen(texts[i]));
        gsl_test(failed(iso_table_read(ctx, path, "trajectory", NULL, &record, NULL)), "text %zu: %s", i,
                 iso_context_message(ctx));
        if (!record) continue;
        gsl_test(iso_record_rows(record) != 2 || iso_record_row(record, 1)[1] != 4, "numbers of text %zu", i);
        const char *k = iso_record_get(record, "k"), *interrupted = iso_record_get(record, "interrupted");
        gsl_test(strstr(texts[i], "k:") && (!k || strcmp(k, "2") != 0), "the line k of text %zu", i);
        gsl_test(i == 4 && (!interrupted || strcmp(interrupted, "yes") != 0), "a line after the rows");
        iso_record_free(record);
    }
    unlink(path);
}

static const struct mistake {
    const char *text;
    int line, column;
    const char *says;
} mistakes[] = {
    {"", 1, 1, "expected a line of column names"},
    {"# isoroll trajectory 1\n# k: 2\n", 2, 1, "found the end of the file"},
    {"# isoroll trajectory 2\nt\n1\n", 1, 22, "expected version 1 of the trajectory format, not 2"},
    {"# k: 1\n#  k: 2\nt\n1\n", 2, 4, "duplicate key k"},
    {"0,1,2\n", 1, 1, "expected a line of column names"},
    {"# isoroll trajectory 1\nt,omgea1\n0,1\n", 2, 3, "unknown column 'omgea1'; did you mean 'omega1'?"},
    {"# isoroll trajectory 1\nt,colour\n0,1\n", 2, 3, "unknown column 'colour'; valid are t, tau, s"},
    {"# isoroll trajectory 1\nt,n1,\n0,1,\n", 2, 6, "unknown column ''"},
    {"t,n1, t\n0,1,2\n", 1, 7, "duplicate column t"},
    {"colour,form\n0,1\n", 1, 1, "unknown column 'colour'"},
    {"t;n1\n0;0,5\n", 2, 3, "not '0,5'"},
    {"t n1\n0 1 2\n", 2, 5, "found more than 2"},
    {"t,n1\n0\n", 2, 2, "expected 2 numbers, one for each column, found 1"},
    {"t,n1\n0,1\n0,1,2\n", 3, 5, "expected 2 numbers, one for each column, found more than 2"},
    {"t,n1\n0,1x\n", 2, 3, "expected a finite number for n1, not '1x'"},
    {"t,n1\n0, nan\n", 2, 4, "not 'nan'"},
    {"t,n1\n-inf,0\n", 2, 1, "expected a finite number for t, not '-inf'"},
    {"t,n1\n0,1e400\n", 2, 3, "not '1e400'"},
    {"t,n1\n0,0x1g\n", 2, 3, "not '0x1g'"},
    {"t,n1\n0,\n", 2, 3, "not ''"},
    {"t,n1\n0,1 2\n", 2, 3, "not '1 2'"},
    {"t,n1\n0,\033[2J\n", 2, 3, "not '?[2J'"},
};

static void test_mistakes(void)
{
    const char *path = in_folder("a.csv");
    for (size_t i = 0; i < sizeof mistakes / sizeof *mistakes; i++) {
        const struct mistake *m = &mistakes[i];
        iso_record *record;
        char place[192];
        put_file(path, m->text, strlen(m->text));
        snprintf(place, sizeof place, "%s:%d:%d: ", path, m->line, m->column);
        gsl_test(iso_table_read(ctx, path, "trajectory", NULL, &record, NULL) != ISO_BAD_INPUT || record,
                 "mistake %zu", i);
        const char *message = iso_context_message(ctx);
        gsl_test(strncmp(message, place, strlen(place)) != 0, "mistake %zu at %sis said: %s", i, place, message);
        gsl_test(!strstr(message, m->says), "mistake %zu, \"%s\": %s", i, m->says, message);
    }
    iso_record *record;
    put_file(path, "t,n1\n0,\0001\n", 10);
    gsl_test(iso_table_read(ctx, path, "trajectory", NULL, &record, NULL) != ISO_BAD_INPUT, "a NUL byte");
    gsl_test(!strstr(iso_context_message(ctx), ":2:3: a NUL byte"), "%s", iso_context_message(ctx));
    unlink(path);
}

static void test_troubles(void)
{
    iso_record *record, *r = make_record();
    gsl_test(iso_table_read(ctx, "/nowhere/a.csv", "trajectory", NULL, &record, NULL) != ISO_FILE_TROUBLE,
             "no file to read");
    gsl_test(iso_table_read(ctx, folder, "trajectory", NULL, &record, NULL) != ISO_FILE_TROUBLE, "a folder to read");
    gsl_test(iso_table_write(ctx, "/nowhere/a.csv", r) != ISO_FILE_TROUBLE, "no folder to write in");
    gsl_test(iso_table_write(ctx, folder, r) != ISO_FILE_TROUBLE, "a folder to write");
    if (access("/dev/full", W_OK) == 0) {
        gsl_test(iso_table_write(ctx, "/dev/full", r) != ISO_FILE_TROUBLE, "a full disk");
        gsl_test(!strstr(iso_context_message(ctx), "No space left"), "%s", iso_context_message(ctx));
        gsl_test(access("/dev/full", W_OK) != 0, "/dev/full is still there");
    }
    iso_record_set(ctx, r, "note", "two\nlines");
    gsl_test(iso_table_write(ctx, in_folder("b.csv"), r) != ISO_BAD_ARGUMENT, "a value of two lines");
    gsl_test(files_in_folder() != 0, "nothing is left of it");
    iso_record_free(r);
}

/* What was there stays until the new file is whole. */
static void test_replacing(void)
{
    const char *path = in_folder("old.csv"), *link_path = in_folder("link.csv");
    iso_table_writer *w;
    iso_record *r = make_record();
    double row[3] = {1, 2, GSL_NAN};
    struct stat s;
    put_file(path, "old", 3);
    chmod(path, 0640);
    gsl_test(symlink(path, link_path), "symlink");
    gsl_test(failed(iso_table_writer_open(ctx, link_path, "trajectory", &w)), "open: %s", iso_context_message(ctx));
    gsl_test(iso_table_write_row(ctx, w, row) != ISO_BAD_ARGUMENT, "a row before the header");
    gsl_test(failed(iso_table_write_header(ctx, w, r)), "header: %s", iso_context_message(ctx));
    gsl_test(iso_table_write_header(ctx, w, r) != ISO_BAD_ARGUMENT, "a second header");
    gsl_test(iso_table_write_row(ctx, w, row) != ISO_NUMERICAL, "a row that is not finite");
    gsl_test(strcmp(iso_context_about(ctx), "n1") != 0, "its column");
    gsl_test(failed(iso_table_writer_close(ctx, w, false)), "close");
    gsl_test(strcmp(file_text(path), "old") != 0, "the old file stays");
    gsl_test(files_in_folder() != 2, "the new one goes");
    gsl_test(failed(iso_table_write(ctx, link_path, r)), "write: %s", iso_context_message(ctx));
    gsl_test(lstat(link_path, &s) || !S_ISLNK(s.st_mode), "the link stays a link");
    gsl_test(stat(path, &s) || (s.st_mode & 0777) != 0640 || strcmp(file_text(path), "old") == 0,
             "the file behind it is replaced");
    gsl_test(files_in_folder() != 2, "no temporary file is left");
    gsl_test(failed(iso_table_writer_close(ctx, NULL, true)), "closing nothing");
    iso_record_free(r);
    unlink(link_path);
    unlink(path);
}

/* Standard output and a reader that has gone. */
static void test_pipe(void)
{
    int ends[2];
    iso_record *r = make_record();
    fflush(stdout);
    const int saved = dup(1);
    if (saved < 0 || pipe(ends)) exit(1);
    close(ends[0]);
    dup2(ends[1], 1);
    close(ends[1]);
    const iso_status status = iso_table_write(ctx, "-", r);
    dup2(saved, 1);
    close(saved);
    clearerr(stdout);
    gsl_test(status != ISO_CLOSED_PIPE, "a closed pipe: %s", iso_status_text(status));
    gsl_test(strcmp(iso_status_text(status), "closed pipe") != 0, "a closed pipe is told apart");
    iso_record_free(r);
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx || !mkdtemp(folder)) return 1;
    signal(SIGPIPE, SIG_IGN);
    test_round_trip("a.csv", 17);
    test_round_trip("a.csv", ISO_HEXADECIMAL);
    test_round_trip("a.h5", 17);
    test_rows();
    test_accepted();
    test_mistakes();
    test_troubles();
    test_replacing();
    test_pipe();
    rmdir(folder);
    iso_context_free(ctx);
    return gsl_test_summary();
}

/* test_plot.c - pictures: the three formats, hostile titles and names, odd records, and a gnuplot that is not there,
 * complains, dies or stops half-way. A target is either a whole picture or untouched. */
#include <gsl/gsl_math.h>
#include <signal.h>

#include "base/vec3_impl.h"
#include "folder.h"
#include "plot/draw.h"

static iso_context *ctx;

static bool starts_with(const char *path, const char *magic)
{
    return strncmp(file_text(path), magic, strlen(magic)) == 0;
}

static bool file_contains(const char *path, const char *text)
{
    return strstr(file_text(path), text);
}

/* --- records ---------------------------------------------------------------------------------------------------- */

/* n and gamma on curves, `turn` radians between rows. */
static iso_record *make_path(size_t rows, double turn)
{
    static const char *const names[] = {"t", "s", "n1", "n2", "n3", "gamma1", "gamma2", "gamma3"};
    iso_record *r;
    double *row;
    if (iso_record_create(ctx, 8, names, &r) != ISO_OK) exit(1);
    for (size_t i = 0; i < rows; i++) {
        const double a = turn * (double)i, b = 0.3 + 0.1 * a;
        const double n[3] = {cos(a) * cos(b), cos(a) * sin(b), sin(a)}, gamma[3] = {n[1], n[2], n[0]};
        if (iso_record_append(ctx, r, &row) != ISO_OK) exit(1);
        row[0] = a, row[1] = a + 0.1 * sin(a);
        memcpy(row + 2, n, sizeof n);
        memcpy(row + 5, gamma, sizeof gamma);
    }
    return r;
}

/* A ball's n on the same curve; it rolls along the curve, but at a speed that keeps no integral. */
static iso_record *make_ball(size_t rows, double turn, double unit)
{
    static const char *const names[] = {"t", "omega1", "omega2", "omega3", "n1", "n2", "n3"};
    iso_record *path = make_path(rows, turn), *r;
    if (iso_record_create(ctx, 7, names, &r) != ISO_OK) exit(1);
    for (size_t i = 0; i < rows; i++) {
        const double *n = iso_record_const_row(path, i) + 2, axis[3] = {0.6, 0, 0.8};
        double *row;
        if (iso_record_append(ctx, r, &row) != ISO_OK) exit(1);
        row[0] = unit * turn * (double)i;
        cross(n, axis, row + 1);
        memcpy(row + 4, n, 3 * sizeof *n);
    }
    iso_record_free(path);
    return r;
}

static void set(iso_record *r, const char *key, const char *text)
{
    if (iso_record_set(ctx, r, key, text) != ISO_OK) exit(1);
}

/* Draws a comparison, and takes its record apart again. */
static iso_status draw(const char *path, const char *title, iso_record *r)
{
    iso_record *curve;
    if (iso_record_create_like(ctx, r, 0, NULL, &curve) != ISO_OK) exit(1);
    const size_t rows = iso_record_rows(r);
    if (rows > 0 && iso_record_add(ctx, curve, rows, iso_record_const_row(r, 0)) != ISO_OK) exit(1);
    iso_record_set_kind(r, "compare");
    iso_record_set_kind(curve, "curve");
    set(r, "k", "0.5"), set(r, "J", "1 2 5"), set(r, "compared", "3");
    set(r, "title", title ? title : ""), set(r, "result", title ? title : "");
    const iso_status status =
        plot_tables(ctx, &(iso_plot_page){.path = path}, (const iso_record *[]){r, curve, NULL}, NULL);
    iso_record_free(r);
    iso_record_free(curve);
    return status;
}

static iso_status draw_simple(const char *path, const char *title)
{
    return draw(path, title, make_path(100, 0.1));
}

/* The same of a trajectory. */
static iso_status draw_sheet(const char *path, const char *title, iso_record *r)
{
    set(r, "k", "0.5"), set(r, "J", "1 2 5"), set(r, "title", title);
    const iso_status status = plot_tables(ctx, &(iso_plot_page){.path = path}, (const iso_record *[]){r, NULL}, NULL);
    iso_record_free(r);
    return status;
}

/* --- tests ------------------------------------------------------------------------------------------------------ */

static void test_formats(void)
{
    static const char *const names[] = {"a.svg", "a.png", "a.pdf"};
    static const char *const magic[] = {"<?xml", "\x89PNG\r\n\x1a\n", "%PDF-"};
    for (int i = 0; i < 3; i++) {
        const char *path = in_folder(names[i]);
        gsl_test((int)draw_simple(path, "three formats"), "%s: %s", names[i], iso_context_message(ctx));
        gsl_test(!starts_with(path, magic[i]), "%s begins as it should", names[i]);
        gsl_test(files_in_folder() != 1, "%s: no temporary file is left", names[i]);
        unlink(path);
    }
    static const char *const bad[] = {"a.gif", "a", ".svg.", "svg", "a.svg/", "a.SVG", "-"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        gsl_test(draw_simple(in_folder(bad[i]), "") != ISO_BAD_ARGUMENT, "'%s' is refused", bad[i]);
        gsl_test(iso_plot_check_page(ctx, &(iso_plot_page){.path = bad[i]}) != ISO_BAD_ARGUMENT,
                 "'%s' is refused before the work", bad[i]);
        gsl_test(!strstr(iso_context_message(ctx), ".svg, .png or .pdf"), "what to write instead of '%s'", bad[i]);
    }
    gsl_test(files_in_folder() != 0, "nothing is left");
}

/* Titles are drawn as they are, whatever they would mean to a shell, to gnuplot or to XML. */
static void test_hostile_texts(void)
{
    static const char *const titles[] = {
        "it's \"quoted\" \\ \\n `touch OWNED` $(touch OWNED) @x a_b^c {/:Bold x} %d %s ~x{y}",
        "'; system('touch OWNED'); '",
        "one line\n!touch OWNED\nset output 'OWNED'\r\n",
        "<script>&amp;</script> ]]>",
        "broken \xff\xfe \xc0\xaf \xed\xa0\x80 \xf5 \x01\x7f \xef\xbf\xbe utf-8, \xc3\xa9 \xce\xb3 whole",
        "\xe2\x82",
        "a title that goes on and on and on and on and on and on and on and on and on and on and on and on and on",
        "a/0 b-1 c'2 d\"3 e`4 f@5 g\\6 h$7 i%8 j(9)0",
        "",
        NULL,
    };
    char back[4096];
    gsl_test(!getcwd(back, sizeof back) || chdir(folder) != 0, "into the folder");
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++)
        for (int format = 0; format < 2; format++) {
            const char *path = format == 0 ? "b.svg" : "b.png";
            gsl_test((int)draw_simple(path, titles[i]), "title %zu: %s", i, iso_context_message(ctx));
            if (i == 0 && format == 0)
                gsl_test(!file_contains(path, "$(touch OWNED) @x a_b^c {/:Bold x}"), "as it is");
            if (i == 7 && format == 0) gsl_test(!file_contains(path, titles[i]), "each sign before a digit");
            if (i == 3 && format == 0) gsl_test(file_contains(path, "<script>"), "escaped for XML");
            unlink(path);
            gsl_test(files_in_folder() != 0, "title %zu runs nothing", i);
        }
    static const char *const names[] = {"it's.svg", "`touch OWNED`.svg", "$(touch OWNED) ; x.svg",
                                        "-o.svg",   "a\nb.svg",          "\"\\.svg",
                                        "%s%n.svg", "|touch OWNED.svg"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        gsl_test((int)draw_simple(names[i], "names"), "name %zu: %s", i, iso_context_message(ctx));
        gsl_test(unlink(names[i]) != 0 || files_in_folder() != 0, "name %zu is the name, and runs nothing", i);
    }
    gsl_test(chdir(back) != 0, "back");
}

static void test_records(void)
{
    const char *path = in_folder("c.svg");
    gsl_test((int)draw(path, "one row", make_path(1, 1)), "%s", iso_context_message(ctx));
    gsl_test((int)draw(path, "backwards", make_path(50, -0.1)), "%s", iso_context_message(ctx));
    gsl_test((int)draw(path, "no time passes", make_path(50, 0)), "%s", iso_context_message(ctx));
    gsl_test((int)draw_sheet(path, "one row", make_ball(1, 1, 1)), "%s", iso_context_message(ctx));
    gsl_test(!file_contains(path, "up to rounding"), "one row has no drift");
    gsl_test((int)draw_sheet(path, "rows far apart", make_ball(50, 2, 1)), "%s", iso_context_message(ctx));
    gsl_test(!file_contains(path, "≤10") || file_contains(path, "up to rounding"), "the floor is a tick");
    gsl_test((int)draw_sheet(path, "backwards", make_ball(50, -0.1, 1)), "%s", iso_context_message(ctx));
    gsl_test((int)draw_sheet(path, "long times", make_ball(50, 0.1, 1e5)), "%s", iso_context_message(ctx));
    gsl_test(!file_contains(path, "t / 10⁵"), "which the name of the axis says");
    gsl_test((int)draw_sheet(path, "many rows", make_ball(200000, 0.001, 1)), "%s", iso_context_message(ctx));
    struct stat s;
    gsl_test(stat(path, &s) != 0 || s.st_size > 1 << 20, "200000 rows are thinned");
    unlink(path);
}

/* What cannot be drawn is refused before anything is written. */
static void test_refused(void)
{
    static const double bad[] = {NAN, INFINITY, -INFINITY};
    const char *path = in_folder("d.svg");
    for (int i = 0; i < 3; i++) {
        iso_record *r = make_path(10, 0.1);
        iso_record_row(r, 7)[6] = bad[i];
        gsl_test(draw(path, "not finite", r) != ISO_NUMERICAL, "not finite: %s", iso_context_message(ctx));
        gsl_test(strcmp(iso_context_about(ctx), "gamma2") != 0, "which: %s", iso_context_about(ctx));
    }
    gsl_test(draw(path, "", make_path(0, 1)) != ISO_BAD_INPUT, "no rows");
    gsl_test(draw(path, "", make_ball(5, 1, 1)) != ISO_BAD_INPUT, "no gamma");
    gsl_test(files_in_folder() != 0, "nothing is left");
}

static iso_record *make_work(void)
{
    iso_record *r;
    gsl_test((int)iso_record_create(ctx, 4, (const char *[]){"backend", "method", "error", "total"}, &r), "a record");
    for (size_t i = 0; i < 2; i++) iso_record_set_words(r, i, true);
    return r;
}

static void put_work(iso_record *r, const char *backend, const char *method, double error, double seconds)
{
    double *row;
    gsl_test((int)iso_record_append(ctx, r, &row), "a row");
    iso_record_intern(ctx, r, backend, &row[0]);
    iso_record_intern(ctx, r, method, &row[1]);
    row[2] = error;
    row[3] = seconds;
}

static iso_status draw_work(const char *path, const char *title, iso_record *r)
{
    iso_record_set_kind(r, "cost");
    if (title) iso_record_set(ctx, r, "title", title);
    return plot_tables(ctx, &(iso_plot_page){.path = path}, (const iso_record *[]){r, NULL}, NULL);
}

/* A work-precision diagram: what it draws of what was measured, and what it refuses. */
static void test_work(void)
{
    const char *path = in_folder("w.svg");
    const double error[] = {1e-3, 0, NAN, 1e-9, 5}, seconds[] = {1e-5, 1e-3, 1, -1, 1e-6};
    iso_record *r = make_work();
    for (int i = 0; i < 5; i++) {
        put_work(r, "ball", "it's `touch OWNED` <b>", error[i], seconds[i]);
        put_work(r, "po'int\n!touch OWNED", "b", error[i], seconds[i]);
    }
    put_work(r, "exact", "", 0, 1e-6);
    iso_record_set(ctx, r, "uncertainty", "1e-14");
    gsl_test((int)draw_work(path, "a/0 'title'", r), "%s", iso_context_message(ctx));
    gsl_test(!file_contains(path, "'touch OWNED' &lt;b"), "a name is drawn as it is, but for backticks");
    gsl_test(!file_contains(path, "closed solution") || file_contains(path, "other methods"),
             "what there is is named, what there is not is not");
    iso_record_free(r);
    unlink(path);
    r = make_work();
    put_work(r, "ball", "a", NAN, 1);
    gsl_test(draw_work(path, "", r) != ISO_BAD_INPUT, "no points");
    put_work(r, "exact", "", 1e-15, 1e-6);
    gsl_test((int)draw_work(path, NULL, r), "the closed solution alone: %s", iso_context_message(ctx));
    gsl_test(file_contains(path, "below what is known"), "nothing is known of it");
    static const char *const many[] = {"a", "b", "c", "d", "e", "f", "g", "h"};
    for (int i = 0; i < 8; i++) put_work(r, "point", many[i], 1e-3, 1e-5);
    gsl_test((int)draw_work(path, NULL, r), "%s", iso_context_message(ctx));
    gsl_test(!file_contains(path, ">f<") || file_contains(path, ">g<") || !file_contains(path, "other methods"),
             "six methods of a backend have names");
    iso_record_free(r);
    unlink(path);
    gsl_test(files_in_folder() != 0, "nothing is left");
}

static iso_record *make_crossings(const char *kind, const double rows[][3], size_t count)
{
    iso_record *r = NULL;
    gsl_test((int)iso_record_create(ctx, 3, (const char *[]){"orbit", "l", "x"}, &r), "a record");
    iso_record_set_kind(r, kind);
    for (size_t i = 0; i < count; i++) iso_record_add(ctx, r, 1, rows[i]);
    iso_record_set_numbers(ctx, r, "k", 1, (double[]){-1});
    iso_record_set_numbers(ctx, r, "J", 3, (double[]){1, 2, 5});
    iso_record_set_numbers(ctx, r, "eps", 1, (double[]){6.5});
    iso_record_set_numbers(ctx, r, "axis", 1, (double[]){1});
    return r;
}

/* Sections: two models, grey orbits, few crossings, and what is refused. */
static void test_sections(void)
{
    static const double rows[][3] = {{0, 0.1, 0.2}, {1, -3, -0.999999}, {2, 3.1, 1 - 1e-12}},
                        others[][3] = {{0, 0.1, 0.2}, {1, -3, -0.9}, {2, 3.1, 1}};
    const char *path = in_folder("s.svg");
    const iso_plot_page page = {.path = path, .title = "it's `touch OWNED`"};
    iso_record *none = make_crossings("section", NULL, 0), *r = make_crossings("section", rows, 3),
               *point = make_crossings("section", others, 3);
    gsl_test(plot_tables(ctx, &page, (const iso_record *[]){none, NULL}, NULL) != ISO_BAD_INPUT, "no crossing");
    gsl_test((int)plot_tables(ctx, &page, (const iso_record *[]){r, point, NULL}, "points=4000\n"), "%s",
             iso_context_message(ctx));
    gsl_test(!file_contains(path, "ball and point part: chaotic") || !file_contains(path, "units of the scene"),
             "key and axes");
    gsl_test(!file_contains(path, "touch OWNED"), "a title is drawn as it is");
    gsl_test(file_contains(path, "<image"), "few points are points");
    gsl_test((int)plot_tables(ctx, &page, (const iso_record *[]){r, NULL}, "points=1\n"), "%s",
             iso_context_message(ctx));
    gsl_test(!file_contains(path, "<image"), "many points are an image");
    iso_record_set(ctx, r, "eps", NULL);
    gsl_test((int)plot_tables(ctx, &page, (const iso_record *[]){r, NULL}, NULL), "no free point: %s",
             iso_context_message(ctx));
    gsl_test(file_contains(path, "units of the scene"), "then x is drawn");
    unlink(path);
    gsl_test(plot_tables(ctx, &page, (const iso_record *[]){r, NULL}, "window=1:0,0:1") != ISO_BAD_ARGUMENT,
             "no window");
    gsl_test(plot_tables(ctx, &page, (const iso_record *[]){r, NULL}, "value=l") != ISO_BAD_ARGUMENT,
             "an option of another kind");
    iso_record_set(ctx, r, "axis", "4");
    gsl_test(plot_tables(ctx, &page, (const iso_record *[]){r, NULL}, NULL) != ISO_BAD_INPUT, "an axis that is none");
    iso_record_free(none);
    iso_record_free(r);
    iso_record_free(point);
    gsl_test(files_in_folder() != 0, "nothing is left");
}

static void test_targets(void)
{
    gsl_test(draw_simple(in_folder("no/such/a.svg"), "") != ISO_FILE_TROUBLE, "a missing folder");
    gsl_test(!strstr(iso_context_message(ctx), "no/such/a.svg"), "%s", iso_context_message(ctx));
    const char *path = in_folder("e.svg"), *link = in_folder("f.svg");
    mkdir(path, 0777);
    gsl_test(draw_simple(path, "") != ISO_FILE_TROUBLE, "a folder in its place");
    rmdir(path);
    gsl_test((int)draw_simple(path, "first"), "%s", iso_context_message(ctx));
    chmod(path, 0640);
    gsl_test(symlink("e.svg", link) != 0 || draw_simple(link, "second") != ISO_OK, "%s", iso_context_message(ctx));
    struct stat s;
    gsl_test(lstat(link, &s) != 0 || !S_ISLNK(s.st_mode), "a link stays one");
    gsl_test(stat(path, &s) != 0 || (s.st_mode & 0777) != 0640, "a file keeps its permissions");
    gsl_test(!file_contains(path, "second"), "the file behind the link is replaced");
    unlink(link);
    unlink(path);
}

static void test_no_gnuplot(void)
{
    static const struct {
        const char *body, *said;
        bool cannot_run; /* then the message says what to install, and else it does not */
    } fakes[] = {
        {"exit 0", "nothing", false},
        {"echo 'line 3: undefined\t terminal' >&2; exit 1", "line 3: undefined terminal", false},
        {"yes complaint | head -n 100000 >&2; echo last words >&2; exit 2", "complaint last words", false},
        {"kill -9 $$", "signal 9", true},
        {"echo '<?xml'; exit 0", "nothing", false}, /* stopped half-way: a full disk */
    };
    char path[256], saved[8192];
    snprintf(path, sizeof path, "%s", in_folder("g.svg"));
    snprintf(saved, sizeof saved, "%s", getenv("PATH") ? getenv("PATH") : "");
    put_file(path, "old", 3);
    if (mkdir(in_folder("bin"), 0777) != 0) exit(1);
    char fake_path[9000];
    setenv("PATH", in_folder("bin"), 1);
    gsl_test(draw_simple(path, "") != ISO_FILE_TROUBLE, "no gnuplot: %s", iso_context_message(ctx));
    gsl_test(!strstr(iso_context_message(ctx), "gnuplot-nox"), "says what to install");
    snprintf(fake_path, sizeof fake_path, "%s:%s", in_folder("bin"), saved);
    setenv("PATH", fake_path, 1);
    for (size_t i = 0; i < sizeof fakes / sizeof *fakes; i++) {
        put_gnuplot(in_folder("bin/gnuplot"), fakes[i].body);
        gsl_test(draw_simple(path, "") != ISO_FILE_TROUBLE, "%s: %s", fakes[i].body, iso_context_message(ctx));
        gsl_test(!strstr(iso_context_message(ctx), fakes[i].said), "its words: %s", iso_context_message(ctx));
        gsl_test((strstr(iso_context_message(ctx), "gnuplot-nox") != NULL) != fakes[i].cannot_run,
                 "says what to install where it cannot run: %s", iso_context_message(ctx));
    }
    unlink(in_folder("bin/gnuplot"));
    rmdir(in_folder("bin"));
    setenv("PATH", saved, 1);
    gsl_test(!starts_with(path, "old") || files_in_folder() != 1, "the old picture is still there, and nothing else");
    unlink(path);
}

/* A host program may have closed its standard streams, or ignore its children. */
static void test_odd_hosts(void)
{
    const char *path = in_folder("h.png");
    signal(SIGCHLD, SIG_IGN);
    gsl_test((int)draw_simple(path, "SIGCHLD ignored"), "%s", iso_context_message(ctx));
    signal(SIGCHLD, SIG_DFL);
    fflush(stdout);
    const int saved[3] = {dup(0), dup(1), dup(2)};
    for (int i = 0; i < 3; i++) close(i);
    const iso_status status = draw_simple(path, "no standard streams");
    for (int i = 0; i < 3; i++)
        if (saved[i] >= 0) {
            dup2(saved[i], i);
            close(saved[i]);
        }
    gsl_test((int)status, "closed streams: %s", iso_context_message(ctx));
    gsl_test(!starts_with(path, "\x89PNG"), "a whole picture");
    unlink(path);
}

static void test_pictures(void)
{
    test_formats();
    test_hostile_texts();
    test_records();
    test_refused();
    test_work();
    test_sections();
    test_targets();
    test_odd_hosts();
}

int main(void)
{
    ctx = iso_context_create();
    if (!ctx || !mkdtemp(folder)) return 1;
    if (system("command -v gnuplot >/dev/null 2>&1") == 0)
        test_pictures();
    else
        puts("SKIP plot: pictures: gnuplot is not installed");
    test_no_gnuplot();
    gsl_test(rmdir(folder) != 0, "an empty folder remains");
    iso_context_free(ctx);
    return gsl_test_summary();
}

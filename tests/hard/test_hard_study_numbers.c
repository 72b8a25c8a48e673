/* NaN, infinity, zeros, subnormals and the largest numbers in records, scenes and studies. */
#include "api/typed_impl.h"
#include "base/number_impl.h"
#include "instrument/frequencies/frequencies.h"
#include "instrument/frequencies/frequencies_impl.h"
#include "instrument/frequencies/momentum.h"
#include "orbit/orbit_impl.h"
#include "sweep.h"
#include "task/analogue.h"
#include "task/check/check.h"
#include "task/compare.h"
#include "task/cost/cost_impl.h"

/* --- records ---------------------------------------------------------------------------------------------------- */

enum { ROWS = 3, ROW = 1 + ISO_STATE };
static const char *const ball_columns[ROW] = {"t", "omega1", "omega2", "omega3", "n1", "n2", "n3"},
                         *const point_columns[ROW] = {"s", "M1", "M2", "M3", "gamma1", "gamma2", "gamma3"};
static const double k = -1, J[3] = {1.4, 2.1, 3};

/* Three rows, a time and a state each; a row is v, the others are usual. */
static iso_status make_record(iso_context *ctx, const iso_params *p, bool point, const double v[], int place,
                              iso_record **record)
{
    static const double ball[ROW] = {1, 0.9, -0.3, -0.225, 0.36, 0.48, 0.8};
    static const double M[ROW] = {1, 0.7, -0.3, -0.135, 0.36, 0.48, 0.8};
    double *row;
    iso_status status = iso_record_create(ctx, ROW, point ? point_columns : ball_columns, record);
    if (status == ISO_OK) status = iso_record_describe(ctx, *record, point ? "point" : "ball", p, NULL);
    for (int i = 0; i < ROWS && status == ISO_OK; i++) {
        status = iso_record_append(ctx, *record, &row);
        if (status != ISO_OK) break;
        memcpy(row, i == place ? v : point ? M : ball, ROW * sizeof *row);
        if (i != place) row[0] = i;
    }
    return status;
}

static void give_record(sweep_answer *a, const iso_record *record)
{
    for (size_t i = 0; i < iso_record_rows(record); i++)
        sweep_give(a, iso_record_const_row(record, i), (int)iso_record_columns(record));
}

typedef struct carried {
    bool point;
    int row;
} carried;

/* a row, a tolerance */
static iso_status convert(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    const carried *c = data;
    iso_params p;
    iso_record *in = NULL, *out = NULL;
    iso_status status = iso_params_reduced(ctx, k, J, &p);
    if (status == ISO_OK) status = make_record(ctx, &p, c->point, v, c->row, &in);
    if (status == ISO_OK) status = iso_convert(ctx, in, c->point ? ISO_BALL : ISO_POINT, v[ROW], &out);
    if (status == ISO_OK) give_record(a, out);
    iso_record_free(in);
    iso_record_free(out);
    return status;
}

static iso_status check(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    const carried *c = data;
    iso_params p;
    iso_record *in = NULL;
    iso_residuals r;
    iso_status status = iso_params_reduced(ctx, k, J, &p);
    if (status == ISO_OK) status = make_record(ctx, &p, c->point, v, c->row, &in);
    if (status == ISO_OK) status = iso_check(ctx, &p, in, v[ROW], &r);
    for (int i = 0; status == ISO_OK && i < r.count; i++) sweep_give(a, &r.residual[i].worst, 1);
    iso_record_free(in);
    return status;
}

static iso_status start_of_row(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    const carried *c = data;
    iso_params p;
    iso_record *in = NULL;
    iso_start start;
    iso_effects effects;
    iso_status status = iso_params_reduced(ctx, k, J, &p);
    if (status == ISO_OK) status = make_record(ctx, &p, c->point, v, 1, &in);
    if (status == ISO_OK)
        status = iso_record_start(ctx, in, &p, c->point ? ISO_POINT : ISO_BALL, 1, &start, &effects);
    if (status == ISO_OK) sweep_give(a, start.y, ISO_STATE);
    iso_record_free(in);
    return status;
}

/* Numbers of a line, k, J, eps, there and back. */
static iso_status lines(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_params p;
    iso_record *record;
    double eps;
    (void)data;
    iso_status status = iso_record_create(ctx, ROW, point_columns, &record);
    if (status != ISO_OK) return status;
    status = iso_record_set_numbers(ctx, record, "k", 1, v);
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, record, "J", 3, v + 1);
    if (status == ISO_OK) status = iso_record_set_numbers(ctx, record, "eps", 1, v + 4);
    if (status == ISO_OK) status = iso_record_params(ctx, record, &p);
    if (status == ISO_OK && iso_record_coupling(ctx, record, &p, &eps, &status)) sweep_give(a, &eps, 1);
    if (status == ISO_OK) sweep_give(a, p.J, 3), sweep_give(a, p.inv_J, 3);
    iso_record_free(record);
    return status;
}

static iso_status written(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_table_writer *w;
    iso_record *header;
    iso_status status = iso_record_create(ctx, ROW, ball_columns, &header);
    (void)data, (void)a;
    if (status != ISO_OK) return status;
    status = iso_table_writer_open(ctx, "hard_numbers.csv", "trajectory", &w);
    if (status == ISO_OK) status = iso_table_write_header(ctx, w, header);
    if (status == ISO_OK) status = iso_table_write_row(ctx, w, v);
    const iso_status closed = iso_table_writer_close(ctx, w, false);
    iso_record_free(header);
    return status == ISO_OK ? closed : status;
}

/* --- scenes ----------------------------------------------------------------------------------------------------- */

enum { STATE = 4, EPS = 10, END, STEP, SCENE_TOLERANCE, AFTER_SCENE };

/* k, J, start, eps, end, step, tolerance: a scene that nothing has checked. */
static iso_status make_scene(iso_context *ctx, iso_model_kind model, const double v[], iso_scene *scene)
{
    *scene = iso_scene_default();
    memcpy(scene->start.y, v + STATE, sizeof scene->start.y);
    scene->start.model = model, scene->start.eps = v[EPS];
    scene->end = v[END], scene->step = v[STEP], scene->tolerance = v[SCENE_TOLERANCE];
    return iso_params_reduced(ctx, v[0], v + 1, &scene->params);
}

static iso_status compare(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_scene scene;
    iso_comparison *c = NULL;
    iso_status status = make_scene(ctx, *(const iso_model_kind *)data, v, &scene);
    if (status == ISO_OK) status = iso_compare(ctx, &scene, NULL, NULL, &c);
    if (status == ISO_OK) {
        sweep_give(a, c->worst, ISO_DIFFERENCES);
        give_record(a, c->run[ISO_BALL].trajectory);
        give_record(a, c->run[ISO_POINT].trajectory);
    }
    iso_comparison_free(c);
    return status;
}

/* and turns, end and samples of the estimate; data: what finds them */
static iso_status frequencies(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    const bool found = *(const bool *)data;
    iso_scene scene;
    iso_frequencies f;
    const double *of = v + AFTER_SCENE;
    const iso_frequencies_options o = {.turns = of[0], .end = of[1], .samples = of[2]};
    iso_status status = make_scene(ctx, ISO_BALL, v, &scene);
    if (status == ISO_OK)
        status = found ? iso_frequencies_find(ctx, &scene, &o, &f) : iso_frequencies_estimate(ctx, &scene, &o, &f);
    for (int i = 0; status == ISO_OK && i < f.angles; i++)
        sweep_give(a, f.angle[i].frequency, found ? ISO_CLOCKS : 1);
    return status;
}

/* A scene whose end, step and start are no numbers is refused before anything is measured. */
static iso_status cost(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_scene scene;
    iso_cost *c = NULL;
    iso_cost_options o = iso_cost_defaults();
    o.quick = true, o.seconds = 0.2, o.times = 2;
    o.backend = ISO_BACKEND_BALL, o.method = iso_method_find("taylor"), o.tolerance = v[SCENE_TOLERANCE];
    iso_status status = make_scene(ctx, *(const iso_model_kind *)data, v, &scene);
    if (status == ISO_OK) status = iso_cost_measure(ctx, &scene, &o, &c);
    for (int i = 0; status == ISO_OK && i < c->cells; i++)
        if (iso_cost_is_measured(&c->cell[i])) sweep_give(a, &c->cell[i].error, 1);
    iso_cost_free(c);
    return status;
}

/* --- the rest --------------------------------------------------------------------------------------------------- */

static void give_ball(sweep_answer *a, const iso_analogue_ball *b)
{
    sweep_give(a, (double[]){b->eps, b->h, b->level, b->params.k}, 4);
    sweep_give(a, b->params.J, 3);
}

/* c, k, J, eps, energy, mass, radius, s */
static iso_status analogue(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    const iso_analogue_problem p = {.neumann = *(const bool *)data,
                                    .c = {v[0], v[1], v[2]},
                                    .k = v[3],
                                    .J = {v[4], v[5], v[6]},
                                    .eps = v[7],
                                    .energy = v[8]};
    iso_analogue found;
    iso_scene scene;
    double point[ISO_STATE];
    iso_status status = iso_analogue_find(ctx, &p, v[9], v[10], &found);
    if (status != ISO_OK) return status;
    give_ball(a, &found.reduced);
    if (found.has_body) give_ball(a, &found.body);
    if (found.has_body) sweep_give(a, &found.scale, 1);
    sweep_give(a, (double[]){found.lowest, found.highest, found.shift}, 3);
    iso_analogue_start(&found, point);
    status = iso_analogue_scene(ctx, &found.reduced, point, v[11], &scene);
    if (status == ISO_OK) sweep_give(a, scene.start.y, ISO_STATE), sweep_give(a, &scene.end, 1);
    return status;
}

/* step, one sample */
static iso_status spectrum(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    enum { COUNT = 64 };
    double signal[2 * COUNT];
    iso_spectral_line line[3];
    int found;
    (void)data;
    for (int i = 0; i < COUNT; i++) signal[2 * i] = cos(0.7 * i), signal[2 * i + 1] = sin(0.7 * i);
    signal[9] = v[1];
    const iso_status status = iso_spectrum_find(ctx, signal, COUNT, v[0], 3, line, &found);
    for (int i = 0; status == ISO_OK && i < found; i++)
        sweep_give(a, (double[]){line[i].frequency, line[i].amplitude, line[i].phase}, 3);
    return status;
}

/* H, h */
static iso_status momentum(iso_context *ctx, const void *data, const double v[], sweep_answer *a)
{
    iso_params p;
    iso_momentum m;
    iso_record *bounds = NULL;
    (void)data;
    iso_status status = iso_params_reduced(ctx, k, J, &p);
    if (status != ISO_OK || !iso_momentum_make(&p, v[0], &m)) return ISO_BAD_ARGUMENT;
    status = iso_momentum_bounds(ctx, &m, v[1], &bounds);
    if (status == ISO_OK) sweep_give(a, &a->value[0], 0);
    iso_record_free(bounds);
    return status;
}

#define SCENE 1.4, 2.1, 3, 0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1
#define BALL_ROW 1, 0.9, -0.3, -0.225, 0.36, 0.48, 0.8
#define POINT_ROW 1, 0.7, -0.3, -0.135, 0.36, 0.48, 0.8
enum { EPS_BIT = 1 << EPS, ESTIMATE_BITS = 7 << AFTER_SCENE, UNREAD = 1 << END | 1 << STEP };
enum { NO_BODY = 1 << 9 | 1 << 10 }; /* without a mass or a radius there is no body, which the analogue says */

static const iso_model_kind ball = ISO_BALL, point = ISO_POINT;
static const carried ball_row = {false, 1}, point_row = {true, 1}, first_row = {false, 0}, first_point = {true, 0};
static const bool neumann = true, braden = false, yes = true, no = false;

static const sweep_call calls[] = {
    {"a ball's row", convert, &ball_row, ROW + 1, {BALL_ROW, 1e-9}, 0},
    {"a point's row", convert, &point_row, ROW + 1, {POINT_ROW, 1e-9}, 0},
    {"a ball's first row", convert, &first_row, ROW + 1, {0, 0.9, -0.3, -0.225, 0.36, 0.48, 0.8, 1e-9}, 0},
    {"a point's first row", convert, &first_point, ROW + 1, {0, 0.7, -0.3, -0.135, 0.36, 0.48, 0.8, 1e-9}, 0},
    {"a ball's row, checked", check, &ball_row, ROW + 1, {BALL_ROW, 1e-9}, 0},
    {"a point's row, checked", check, &point_row, ROW + 1, {POINT_ROW, 1e-9}, 0},
    {"a ball's row as a start", start_of_row, &ball_row, ROW, {BALL_ROW}, 1},
    {"a point's row as a start", start_of_row, &point_row, ROW, {POINT_ROW}, 1},
    {"lines", lines, NULL, 5, {-1, 1.4, 2.1, 3, 0.3}, 0},
    {"a row of a file", written, NULL, ROW, {BALL_ROW}, 0},
    {"balls compared", compare, &ball, AFTER_SCENE, {-1, SCENE, 1, 0.5, 1e-9}, EPS_BIT},
    {"k = 0.7 compared", compare, &ball, AFTER_SCENE, {0.7, SCENE, 1, 0.5, 1e-9}, EPS_BIT},
    {"points compared",
     compare,
     &point,
     AFTER_SCENE,
     {-1, 1.4, 2.1, 3, 0.7, -0.3, -0.135, 0.36, 0.48, 0.8, 0.3, 1, 0.5, 1e-9},
     EPS_BIT},
    {"frequencies",
     frequencies,
     &yes,
     AFTER_SCENE + 3,
     {-1, SCENE, 1, 0.5, 1e-9, 50, 1e3, 1024},
     EPS_BIT | ESTIMATE_BITS | UNREAD | 1 << SCENE_TOLERANCE},
    {"frequencies estimated",
     frequencies,
     &no,
     AFTER_SCENE + 3,
     {0.7, SCENE, 1, 0.5, 1e-9, 50, 300, 1024},
     EPS_BIT | ESTIMATE_BITS | UNREAD | 1 << SCENE_TOLERANCE},
    {"cost", cost, &ball, AFTER_SCENE, {-1, SCENE, 1, 0.5, 1e-9}, EPS_BIT | 1 << STEP},
    {"Neumann's problem", analogue, &neumann, 12, {1, 2, 3, 1, 1, 1, 1, 1, 2, 3, 0.1, 5}, 0xf8 | NO_BODY},
    {"Braden's problem", analogue, &braden, 12, {1, 2, 3, 1, 1.4, 2.1, 3, 0.7, 0.1, 3, 0.1, 5}, 7 | NO_BODY},
    {"lines of a signal", spectrum, NULL, 2, {0.1, 0.3}, 0},
    {"the momentum map", momentum, NULL, 2, {0.1, 1}, 0},
};

/* Whether a number as printf writes it is one to whoever reads the file. */
static bool is_written(double x)
{
    char text[ISO_NUMBER_SIZE];
    double back;
    const int length = snprintf(text, sizeof text, "%.17g", x);
    return iso_number_read(text, (size_t)length, &back);
}

int main(void)
{
    iso_context *ctx = iso_context_create();
    hard_topic("8b. Numbers of records and studies");
    sweep_all(ctx, calls, sizeof calls / sizeof *calls, "studies");
    hard_naive("a row by printf", !is_written(NAN) + !is_written(-INFINITY) + !is_written(0.1), 0);
    iso_context_free(ctx);
    return hard_summary();
}

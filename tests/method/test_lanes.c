/* Taylor series in lanes, lib/method/taylor/lanes_impl.h: the states of each code, and that no lane feels another. */
#include "method/taylor/lanes_impl.h"
#include "orbits.h"

enum { ROWS = 4, CODES = 8 };
static const iso_lane_options finest = {.tolerance = 1e-15};

static iso_context *ctx;
static iso_random *dice;
static const iso_method *extended;

/* --- orbits ----------------------------------------------------------------------------------------------------- */

typedef struct member {
    effects_case c;
    orbit o;
    double time[ROWS], expected[ROWS][ISO_MAX_STATE], y[CODES][ROWS][ISO_MAX_STATE];
    bool taken; /* into a group */
} member;

static member **members;
static int count;

/* Not what lanes are not made for, nor what acts on neither the motion nor a state of it. */
static void collect(const effects_case *c, laws_worst *worst)
{
    static int variant;
    static const double part[ROWS] = {0, 0.3, 1.7, 4};
    (void)worst;
    if (c->subset & (1 << ISO_REACTIONS | 1 << ISO_CLOCK) || iso_effects_stiffness(&c->model.problem) > ISO_STIFF)
        return;
    if (c->system == &iso_system_point &&
        c->subset & ~(1 << ISO_FIELD | 1 << ISO_LEVEL | 1 << ISO_ROTOR | 1 << ISO_POTENTIAL))
        return; /* the others have no image */
    if (pow(laws_spread(&c->model.problem.p), 1 / fabs(c->model.problem.p.k)) > 1e50) return; /* s has no scale */
    member *m = calloc(1, sizeof *m);
    members = realloc(members, (size_t)(count + 1) * sizeof *members);
    if (!m || !members) exit(1);
    members[count++] = m;
    m->c = *c;
    m->o = orbit_of(ctx, c, variant);
    const double length = orbit_stretch(c, &m->o) * (variant++ % 5 < 3 ? 1 : -1);
    iso_integrator *it = orbit_start(&m->o, extended, &(iso_method_options){.tolerance = 1e-15});
    for (int i = 0; i < ROWS; i++) {
        m->time[i] = part[i] * length;
        if (iso_integrator_at(it, m->time[i], m->expected[i]) != ISO_OK) m->expected[i][0] = NAN;
    }
    iso_integrator_free(it);
}

static void collect_all(void)
{
    laws_worst unused = {0};
    for (int i = 0; iso_systems[i]; i++) effects_each(iso_systems[i], tests_length(4, 2), collect, &unused);
}

/* --- groups of orbits that are alike ---------------------------------------------------------------------------- */

enum { MOST = 1024 };

static void shuffle(iso_lane_job *list[], int length)
{
    for (int i = length - 1; i > 0; i--) {
        const int j = (int)iso_random_uniform(dice, 0, i + 1);
        iso_lane_job *const swapped = list[i];
        list[i] = list[j], list[j] = swapped;
    }
}

static iso_lane_job job_of(const member *m, int first, double *states)
{
    iso_lane_job job = {.model = &m->o.model,
                        .rows = (size_t)(ROWS - first),
                        .time = m->time + first,
                        .unit = 1,
                        .states = states,
                        .stride = ISO_MAX_STATE};
    copy(m->o.y0, job.start, m->o.model.dim);
    return job;
}

/* Whether the rows from `first` on are those of the member, bit by bit. */
static bool same(const member *m, int code, int first, double y[][ISO_MAX_STATE])
{
    bool equal = true;
    for (int i = first; i < ROWS; i++)
        equal = equal && memcmp(y[i - first], m->y[code][i], (size_t)m->o.model.dim * sizeof(double)) == 0;
    return equal;
}

static laws_worst right, bits, broken;

static void note_member(const member *m, int code, const iso_lane_job *job)
{
    const char *name = iso_lane_builds[code]->name;
    /* as for one orbit by itself; long bodies amplify rounding */
    const double allowed = 1e-13 * fmax(1, sqrt(laws_spread(&m->o.model.problem.p)) / 8);
    effects_note(&m->c, &bits, job->done == ROWS && !job->error ? 0 : 1, 0.5, "all rows reached");
    for (int i = 0; i < ROWS; i++)
        effects_note(&m->c, &right, orbit_error(&m->o, m->y[code][i], m->expected[i]), allowed, name);
}

/* All of a group in random order, each twice, all rows and the last alone, and among them some that are no numbers;
 * then each by itself. */
static void solve_group(member *group[], int size, int code)
{
    const iso_lane_build *lanes = iso_lane_builds[code];
    static iso_lane_job full[MOST], last[MOST], none[MOST / 8];
    static double one[MOST][1][ISO_MAX_STATE], nowhere[MOST / 8][ROWS][ISO_MAX_STATE];
    iso_lane_job *list[3 * MOST];
    int length = 0;
    for (int i = 0; i < size; i++) {
        full[i] = job_of(group[i], 0, group[i]->y[code][0]);
        last[i] = job_of(group[i], ROWS - 1, one[i][0]);
        list[length++] = &full[i];
        list[length++] = &last[i];
        if (i % 8 != 0) continue;
        iso_lane_job *const nan = &none[i / 8];
        *nan = job_of(group[i], 0, nowhere[i / 8][0]);
        nan->start[iso_random_uniform(dice, 0, 2) < 1 ? 0 : 4] = NAN;
        list[length++] = nan;
    }
    shuffle(list, length);
    effects_note(&group[0]->c, &bits, lanes->solve(list, (size_t)length, &finest) ? 0 : 1, 0.5, "solved");
    for (int i = 0; i < size; i++) {
        double alone[ROWS][ISO_MAX_STATE];
        iso_lane_job job = job_of(group[i], 0, alone[0]), *const only = &job;
        lanes->solve(&only, 1, &finest);
        note_member(group[i], code, &full[i]);
        effects_note(&group[i]->c, &bits, same(group[i], code, 0, alone) ? 0 : 1, 0.5, "alone");
        effects_note(&group[i]->c, &bits, same(group[i], code, ROWS - 1, one[i]) ? 0 : 1, 0.5, "the last row alone");
        if (i % 8 != 0) continue;
        const iso_lane_job *const nan = &none[i / 8];
        effects_note(&group[i]->c, &broken, nan->done == 0 && nan->error && strstr(nan->error, "diverges") ? 0 : 1,
                     0.5, lanes->name);
    }
}

static void solve_groups(void)
{
    int groups = 0;
    member *group[MOST];
    for (int i = 0; i < count; i++) {
        int size = 0;
        if (members[i]->taken) continue;
        for (int j = i; j < count && size < MOST; j++)
            if (!members[j]->taken && iso_lanes_alike(&members[i]->o.model, &members[j]->o.model))
                members[j]->taken = true, group[size++] = members[j];
        for (int code = 0; iso_lane_builds[code]; code++)
            if (iso_lane_builds[code]->runs_here()) solve_group(group, size, code);
        groups++;
    }
    printf("%d orbits in %d groups\n", count, groups);
    laws_report(&right, "lanes: states as by long double");
    laws_report(&bits, "lanes: no orbit feels another, by a bit");
    laws_report(&broken, "lanes: what is no number is said to diverge");
}

int main(void)
{
    ctx = iso_context_create();
    dice = iso_random_create(4);
    extended = iso_method_find("taylor_extended");
    for (int code = 0; iso_lane_builds[code]; code++)
        if (!iso_lane_builds[code]->runs_here()) printf("no %s here: not tested\n", iso_lane_builds[code]->name);
    collect_all();
    solve_groups();
    for (int i = 0; i < count; i++) free(members[i]);
    free(members);
    iso_random_free(dice);
    iso_context_free(ctx);
    exit(gsl_test_summary());
}

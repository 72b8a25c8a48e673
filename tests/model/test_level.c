/* What effects leave of the levels that motions stay on, and of the isomorphism: integrals, the energy that is lost,
 * the point's equations and energy as images of the ball's. */
#include "effects.h"

/* --- integrals ------------------------------------------------------------------------------------------------- */

typedef struct integral_of {
    const iso_problem *problem;
    const iso_integral *integral;
} integral_of;

static void integral_value(const void *data, const double y[], double I[])
{
    const integral_of *of = data;
    double size;
    I[0] = of->integral->value(of->problem, y, &size);
}

/* dI/dt; *unit is the size of I per step, of which `laws_rounding` is the error */
static double change(const effects_case *c, const iso_integral *integral, double *unit)
{
    const integral_of of = {&c->model.problem, integral};
    const double h = effects_step(c);
    double f[ISO_MAX_STATE], slope, size;
    c->model.rhs(&c->model, c->y, f);
    laws_slope(integral_value, &of, 1, c->model.dim, c->y, f, h, &slope);
    integral->value(&c->model.problem, c->y, &size);
    if (integral == c->system->integrals && c->system == &iso_system_ball) size = effects_energy_size(c);
    *unit = size / h;
    return slope;
}

static void integrals_hold(const effects_case *c, laws_worst *worst)
{
    const iso_integral *list[ISO_MAX_INTEGRALS];
    const int count = iso_integrals_holding(c->system, &c->model.problem, list, ISO_MAX_INTEGRALS);
    for (int i = 0; i < count; i++) {
        double unit;
        const double slope = change(c, list[i], &unit);
        effects_note(c, worst, fabs(slope), 2 * laws_rounding(&c->model.problem.p) * unit, list[i]->name);
    }
}

/* dh/dt = -c_r (w,w) - c (w,n)^2 + (w,M), and on a plane whose height nobody knows + (w, mgb e x n) */
static void energy_lost(const effects_case *c, laws_worst *worst)
{
    const iso_problem *f = &c->model.problem;
    const iso_effects *e = &f->effects;
    const double *w = c->y, *n = c->y + 3;
    double unit, power = 0, e_n[3], T[3];
    if (e->on[ISO_ROLLING_RESISTANCE]) power -= ROLLING_COEFFICIENT(e) * dot(w, w);
    if (e->on[ISO_TWIST]) power -= TWIST_RESISTANCE(e) * dot(w, n) * dot(w, n);
    effects_torque_of(e, w, n, c->y + f->at[ISO_GRAVITY], T);
    if (e->on[ISO_TORQUE]) power += dot(w, T);
    cross(c->y + f->at[ISO_GRAVITY], n, e_n);
    if (e->on[ISO_GRAVITY] && f->p.k == 1 && !e->on[ISO_ATTITUDE]) power += GRAVITY_MGB(e) * dot(w, e_n);
    const double slope = change(c, laws_integral(c->system, "h"), &unit);
    effects_note(c, worst, fabs(slope - power), 2 * laws_rounding(&f->p) * unit, "dh/dt");
    effects_note(c, worst, iso_effects_keep_energy(f) != (power == 0), 0.5, "energy kept");
}

/* What is not listed changes: the largest drift of each integral for each subset, over the k and J it could
 * hold for. */
enum { ANYWHERE, PLANE_AT_ZERO, PLANE_UNLESS_TWISTING, SHELL, AXIS1, AXIS2, AXIS3, ROUND, TWISTING, WEIGHT };

typedef struct drift_of {
    const char *name;
    int where;                  /* it could hold */
    bool seen[EFFECTS_SUBSETS]; /* not listed there for some k and J */
    double most[EFFECTS_SUBSETS];
} drift_of;

static bool could_hold(const effects_case *c, int where)
{
    const iso_params *p = &c->model.problem.p;
    const int unseen = 1 << ISO_ATTITUDE | 1 << ISO_REACTIONS | 1 << ISO_CLOCK;
    switch (where) {
    case PLANE_AT_ZERO: /* the states of points here are on H = 0, also with `level` */
        return p->k == 1 && !(c->system == &iso_system_point && effects_on(c, ISO_LEVEL));
    case PLANE_UNLESS_TWISTING: /* (Jw x n)^2 = (K x n)^2 stays however the contact twists; only a level spoils it */
        return p->k == 1 && (c->subset & (EFFECTS_CLASSICAL - 1) & ~unseen) != 1 << ISO_TWIST;
    case SHELL: return p->k == -1;
    case AXIS1:
    case AXIS2:
    case AXIS3: return iso_params_symmetric(p, where - AXIS1);
    case ROUND: return iso_params_symmetric(p, 0) && iso_params_symmetric(p, 1);
    case TWISTING: return c->subset & 1 << ISO_TWIST;
    case WEIGHT: return c->subset & 1 << ISO_GRAVITY;
    default: return true;
    }
}

static drift_of drifts[] = {
    {.name = "h", .where = ANYWHERE},
    {.name = "omega.n", .where = ANYWHERE},
    {.name = "F_plane", .where = PLANE_UNLESS_TWISTING},
    {.name = "F_shell", .where = SHELL},
    {.name = "F_axis1", .where = AXIS1},
    {.name = "F_axis2", .where = AXIS2},
    {.name = "F_axis3", .where = AXIS3},
    {.name = "F_rotor", .where = PLANE_AT_ZERO},
    {.name = "F_rotor1", .where = AXIS1},
    {.name = "F_rotor2", .where = AXIS2},
    {.name = "F_rotor3", .where = AXIS3},
    {.name = "F_round", .where = ROUND},
    {.name = "K.K", .where = TWISTING},
    {.name = "K.n", .where = TWISTING},
    {.name = "AK.n", .where = TWISTING},
    {.name = "K.e", .where = WEIGHT},
    {.name = "e.n", .where = ANYWHERE},
};
enum { DRIFTS = sizeof drifts / sizeof *drifts };

static void note_drift(const effects_case *c, const iso_integral *integral)
{
    const iso_integral *list[ISO_MAX_INTEGRALS];
    const int count = iso_integrals_holding(c->system, &c->model.problem, list, ISO_MAX_INTEGRALS);
    drift_of *drift = NULL;
    for (int i = 0; i < DRIFTS; i++)
        if (strcmp(drifts[i].name, integral->name) == 0) drift = &drifts[i];
    if (c->subset & EFFECTS_STIFF) return; /* nearly the rubber ball: changes are small */
    for (int i = 0; i < count; i++)
        if (list[i] == integral) return;
    if (drift && !could_hold(c, drift->where)) return;
    if (!drift) gsl_test(1, "%s is not listed [%d]", integral->name, c->subset);
    if (!drift || (c->system == &iso_system_point && iso_effects_breaking(&c->model.problem.effects))) return;
    double unit;
    const double turn = norm(c->y) * (c->system == &iso_system_ball ? fmax(1, fabs(c->model.problem.p.k)) : 1);
    const double slope = change(c, integral, &unit), part = fabs(slope) / (unit * effects_step(c) * turn);
    drift->seen[c->subset] = true;
    drift->most[c->subset] = fmax(drift->most[c->subset], part);
}

/* More states: some hardly change. At short length k = 1 and -1, and 0.5 with moments as different as those of bodies,
 * or equal. */
static void collect_drifts(const effects_case *c, laws_worst *worst)
{
    const double k = c->model.problem.p.k, spread = laws_spread(&c->model.problem.p);
    const bool usual = fabs(k) == 1 || (k == 0.5 && spread < 3 && (spread == 1 || spread > 1.1));
    (void)worst;
    if (tests_length(1, 0) && !usual) return;
    for (int i = 0; i < LAWS_STATES; i++) {
        const effects_case another = effects_sample(c->system, &c->model.problem.p, c->subset, c->random);
        for (const iso_integral *j = c->system->integrals; j->name; j++) note_drift(&another, j);
        for (int e = 0; e < ISO_EFFECTS; e++)
            for (const iso_integral *j = iso_effect_integrals_of(iso_effect_list[e], c->system); j && j->name; j++)
                if (effects_on(&another, e)) note_drift(&another, j);
    }
}

static void unlisted_change(const iso_system *system)
{
    laws_worst worst = {0};
    for (int i = 0; i < DRIFTS; i++)
        for (int s = 0; s < EFFECTS_SUBSETS; s++) drifts[i].most[s] = 0, drifts[i].seen[s] = false;
    effects_each(system, 1, collect_drifts, &worst);
    for (int i = 0; i < DRIFTS; i++) {
        int seen = 0, least = 0;
        for (int s = 0; s < EFFECTS_SUBSETS; s++) {
            if (!drifts[i].seen[s]) continue;
            if (seen++ == 0 || drifts[i].most[s] < drifts[i].most[least]) least = s;
        }
        char name[80];
        effects_name(least, name, sizeof name);
        const bool of_ball_alone = i < 2 || i >= DRIFTS - 5; /* the point's H and constraints hold always */
        if (system == &iso_system_point && of_ball_alone) continue;
        gsl_test(seen == 0 || drifts[i].most[least] < 0.01,
                 "%s: %s changes in the %d subsets that do not list it, by %.2g at least [%s]", system->name,
                 drifts[i].name, seen, drifts[i].most[least], name);
    }
}

/* --- isomorphism ----------------------------------------------------------------------------------------------- */

/* The point that has the ball's orbit, as the orbit is the ball's: eps from the whole h (24). */
static iso_model twin(const effects_case *c)
{
    static const bool none[ISO_CLOCKS] = {false};
    iso_problem f = {.p = c->model.problem.p, .effects = c->model.problem.effects};
    f.eps = iso_coupling(&f.p, c->model.problem.energy);
    if (effects_on(c, ISO_LEVEL)) f.energy = iso_coupling(&f.p, LEVEL_C(&f.effects));
    return iso_model_assemble(&iso_system_point, &f, ISO_CLOCK_S, none);
}

static void to_point(const void *params, const double y[], double point[])
{
    iso_ball_to_point(params, y, point);
}

/* d/dt of the image is the point's right-hand side times ds/dt. Gives the largest error in units of the speeds, and
 * in *rounding what differences and cancelling terms leave of it. */
static double image_error(const effects_case *c, double *rounding)
{
    const iso_params *p = &c->model.problem.p;
    const iso_model point = twin(c);
    const double h = effects_step(c);
    double f[ISO_MAX_STATE], image[ISO_STATE], pushed[ISO_STATE], own[ISO_STATE];
    c->model.rhs(&c->model, c->y, f);
    iso_ball_to_point(p, c->y, image);
    laws_slope(to_point, p, ISO_STATE, ISO_STATE, c->y, f, h, pushed);
    point.rhs(&point, image, own);
    const double ds = iso_clock_rate(p, ISO_CLOCK_S, point.system->q(p, image, NULL), NULL);
    for (int i = 0; i < ISO_STATE; i++) pushed[i] = (pushed[i] - ds * own[i]) / (i < 3 ? norm(image) : 1);
    const double time = 128 * h / laws_reach(p);
    *rounding = 4 * laws_rounding(p) * (1 + effects_energy_size(c) / c->kinetic * laws_reach(p) / 128) * time / h;
    return laws_max(ISO_STATE, pushed) * time;
}

static void vector_field_mapped(const effects_case *c, laws_worst *worst)
{
    double rounding;
    if (iso_effects_breaking(&c->model.problem.effects)) return;
    const double error = image_error(c, &rounding);
    effects_note(c, worst, error, rounding, "image");
}

/* Each of the effects that break the isomorphism does so visibly. */
enum { BREAKERS = 3 };
static const iso_effect_id breaker[BREAKERS] = {ISO_GRAVITY, ISO_TWIST, ISO_ROLLING_RESISTANCE};

static void vector_field_lost(const effects_case *c, laws_worst worst[BREAKERS])
{
    double rounding;
    for (int i = 0; i < BREAKERS; i++)
        if ((c->subset & (1 << ISO_GRAVITY | 1 << ISO_TWIST | 1 << ISO_ROLLING_RESISTANCE)) == 1 << breaker[i])
            effects_note(c, &worst[i], image_error(c, &rounding), 0.01, "image");
}

static void breakers(void)
{
    laws_worst worst[BREAKERS] = {{0}};
    effects_each(&iso_system_ball, tests_length(0, 1), vector_field_lost, worst);
    for (int i = 0; i < BREAKERS; i++)
        gsl_test(!(worst[i].cases > 0 && worst[i].ratio >= 1), "%s breaks the isomorphism visibly: %.2g (%s)",
                 iso_effect_list[breaker[i]]->name, worst[i].error, worst[i].where);
}

/* V of the field and of a written potential is U/G; H is that of the level, else 0. */
static void potentials_mapped(const effects_case *c, laws_worst *worst)
{
    const iso_problem *f = &c->model.problem;
    const iso_params *p = &f->p;
    if (iso_effects_breaking(&f->effects)) return;
    const iso_model point = twin(c);
    double image[ISO_STATE], size;
    iso_ball_to_point(p, c->y, image);
    const double q = point.system->q(p, image, NULL), G = p->k * p->k / p->det_J * pow(q, 1 / p->k);
    const double U = effects_potential(c, ISO_FIELD) + effects_potential(c, ISO_POTENTIAL);
    const double allowed = 2 * laws_rounding(p) * effects_energy_size(c) / G;
    effects_note(c, worst, fabs(iso_effects_image(&point.problem, image) - U / G), allowed, "U/G");
    const double H = point.system->energy(&point.problem, image, &size);
    effects_note(c, worst, fabs(H - point.problem.energy), allowed, "H");
}

/* The ball's integral of this name, its own or an effect's. */
static const iso_integral *ball_integral(const effects_case *c, const char *name)
{
    for (int e = 0; e < ISO_EFFECTS; e++)
        for (const iso_integral *i = iso_effect_list[e]->integrals; effects_on(c, e) && i && i->name; i++)
            if (strcmp(i->name, name) == 0) return i;
    return laws_integral(&iso_system_ball, name);
}

/* F_plane, F_shell, F_axis and those of the rotor are the same functions of the orbit in both pictures, on every
 * level. */
static void integrals_mapped(const effects_case *c, laws_worst *worst)
{
    const iso_integral *list[ISO_MAX_INTEGRALS];
    const iso_model point = twin(c);
    const iso_params *p = &c->model.problem.p;
    double image[ISO_STATE], size, image_size;
    if (iso_effects_breaking(&c->model.problem.effects)) return;
    iso_ball_to_point(p, c->y, image);
    const int count = iso_integrals_holding(&iso_system_point, &point.problem, list, ISO_MAX_INTEGRALS);
    for (int i = 0; i < count; i++) {
        if (list[i]->name[0] != 'F') continue;
        const iso_integral *own = ball_integral(c, list[i]->name);
        effects_note(c, worst, !(own->holds && own->holds(&c->model.problem)), 0.5, "holds in both");
        const double F = own->value(&c->model.problem, c->y, &size);
        const double F_image = list[i]->value(&point.problem, image, &image_size);
        const double level = effects_energy_size(c) / c->kinetic;
        effects_note(c, worst, fabs(F - F_image), 4 * laws_rounding(p) * level * fmax(size, image_size), own->name);
    }
}

/* --- other units ----------------------------------------------------------------------------------------------- */

/* There and back: exact, but for c of a level where the unit of J has a broken power. */
static void scaled_and_back(const effects_case *c, laws_worst *worst)
{
    iso_units units;
    const iso_effects *e = &c->model.problem.effects;
    const double k = c->model.problem.p.k, J_unit[] = {1, 0x1p-100, 0x1p60};
    for (int u = 0; u < 3; u++) {
        iso_units_choose(&c->model.problem.p, norm(c->y) * J_unit[u], &units);
        iso_effects back = *e;
        iso_effects_scale(&back, &units, -1);
        iso_effects_scale(&back, &units, 1);
        for (iso_effect_id i = 0; i < ISO_EFFECTS; i++)
            for (const iso_effect_number *n = iso_effect_list[i]->numbers; n && n->name; n++)
                for (int j = 0; j < n->count; j++) {
                    const double x = iso_effect_values(e, i, n)[j];
                    const double again = iso_effect_values(&back, i, n)[j];
                    const bool exact = n->dimension.J_2k == 0 || rint(1 / k) == 1 / k;
                    effects_note(c, worst, fabs(again - x), exact ? DBL_MIN : 4 * DBL_EPSILON * fabs(x), n->name);
                }
    }
}

/* In own units the equations are the same ones: w' in units of w^2, all else in units of w. */
static void same_in_own_units(const effects_case *c, laws_worst *worst)
{
    iso_units units;
    double y[ISO_MAX_STATE], f[ISO_MAX_STATE], dy[ISO_MAX_STATE], size[ISO_MAX_STATE];
    iso_units_choose(&c->model.problem.p, 8 * norm(c->y), &units);
    iso_problem problem = {.p = units.own, .effects = c->model.problem.effects};
    iso_effects_scale(&problem.effects, &units, -1);
    const iso_model own = iso_model_assemble(c->system, &problem, ISO_CLOCK_T, (const bool[]){false, false, false});
    if (own.dim != c->model.dim || effects_lambda(c) > 0) return; /* stiffness is a matter of units */
    copy(c->y, y, c->model.dim);
    scale(y, 1 / units.w);
    c->model.rhs(&c->model, c->y, dy);
    own.rhs(&own, y, f);
    effects_sizes(c, size);
    for (int i = 0; i < c->model.dim; i++)
        effects_note(c, worst, fabs(f[i] * units.w * (i < 3 ? units.w : 1) - dy[i]),
                     laws_rounding(&c->model.problem.p) * size[i], "own units");
}

int main(void)
{
    effects_hold("listed integrals stay", NULL, 1, integrals_hold);
    effects_hold("energy lost to resistance", &iso_system_ball, 1, energy_lost);
    unlisted_change(&iso_system_ball);
    unlisted_change(&iso_system_point);
    effects_hold("vector field mapped to the point's", &iso_system_ball, 1, vector_field_mapped);
    breakers();
    effects_hold("potential and energy mapped", &iso_system_ball, 1, potentials_mapped);
    effects_hold("integrals mapped", &iso_system_ball, 1, integrals_mapped);
    effects_hold("there and back between units", &iso_system_ball, 1, scaled_and_back);
    effects_hold("the same equations in own units", &iso_system_ball, 1, same_in_own_units);
    exit(gsl_test_summary());
}

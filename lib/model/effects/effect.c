/* effect.c - the effects of one orbit together: sums and questions, each a loop over the rows of the effects that are
 * on.
 *
 * The table here lists the rows, and some rows ask the functions here about the other effects: gravity asks whether
 * attitude is on, the twisting contact whether another torque acts. This circle of calls is meant. It stays within
 * the files of the effects, the contact and the two systems: effects have a part in their integrals and energies. */
#include "model/model_impl.h"

#include <string.h>

#include "base/vec3_impl.h"
#include "model/effects/effects_impl.h"
#include "model/formula/formula_lines_impl.h"
#include "model/model.h"

const iso_effect *const iso_effect_list[ISO_EFFECTS] = {
#define ISO_EFFECT_ENTRY(ID, name) [ISO_##ID] = &iso_effect_##name,
    ISO_EFFECT_LIST(ISO_EFFECT_ENTRY)
#undef ISO_EFFECT_ENTRY
};

const iso_effect *iso_effect_at(int i)
{
    return i >= 0 && i < ISO_EFFECTS ? iso_effect_list[i] : NULL;
}

iso_effect_id iso_effect_find(const char *name)
{
    int e = 0;
    while (e < ISO_EFFECTS && strcmp(iso_effect_list[e]->name, name) != 0) e++;
    return (iso_effect_id)e;
}

bool iso_is_plane(const iso_problem *f)
{
    return f->p.k == 1;
}

iso_work iso_no_work(const iso_problem *f)
{
    (void)f;
    return ISO_WORK_NONE;
}

iso_work iso_work_lost(const iso_problem *f)
{
    (void)f;
    return ISO_WORK_LOST;
}

/* The row of the next effect that is on, beginning with effect *e; NULL: there is none. Moves *e behind it. */
static const iso_effect *next_on(const iso_effects *effects, int *e)
{
    while (*e < ISO_EFFECTS && !effects->on[*e]) ++*e;
    return *e < ISO_EFFECTS ? iso_effect_list[(*e)++] : NULL;
}

/* The same, of those that act. */
static const iso_effect *next_acting(const iso_effects *effects, int *e)
{
    while (*e < ISO_EFFECTS && !iso_effect_acts(effects, (iso_effect_id)*e)) ++*e;
    return *e < ISO_EFFECTS ? iso_effect_list[(*e)++] : NULL;
}

/* --- what they are ---------------------------------------------------------------------------------------------- */

bool iso_effect_acts(const iso_effects *effects, iso_effect_id id)
{
    return effects->on[id] && !effects->idle[id] && !iso_effect_list[id]->observes;
}

iso_effects iso_effects_acting(const iso_effects *effects)
{
    iso_effects acting = *effects;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        acting.on[e] = iso_effect_acts(effects, e) || (effects->on[e] && iso_effect_list[e]->watches);
    return acting;
}

const char *iso_effect_why_broken(const iso_effect *effect)
{
    if (effect->breaks) return effect->breaks;
    if (effect->observes || effect->is_level || effect->image) return NULL;
    return "its row gives it no image on the point";
}

/* The first effect of which the condition holds (NULL: none), or whether there is one. next: of those that are on, or
 * of those that act. */
#define FIRST(type, question, next, condition)                                                                       \
    type question(const iso_effects *effects)                                                                        \
    {                                                                                                                \
        const iso_effect *effect;                                                                                    \
        int e = iso_effects_none(effects) ? ISO_EFFECTS : 0;                                                         \
        while ((effect = next(effects, &e)) && !(condition)) continue;                                               \
        return effect;                                                                                               \
    }

FIRST(const iso_effect *, iso_effects_breaking, next_acting, iso_effect_why_broken(effect))
FIRST(const iso_effect *, iso_effects_beyond_level, next_acting, !effect->is_level)
FIRST(const iso_effect *, iso_effects_beyond_rotor, next_acting, !effect->is_level && !effect->is_rotor)
FIRST(const iso_effect *, iso_effects_ball_only, next_on, effect->ball_only)
FIRST(bool, iso_effects_twist, next_on, effect->twists)
FIRST(bool, iso_effects_clocks, next_on, effect->clocks)
FIRST(bool, iso_effects_need_D, next_on, effect->needs_D)
FIRST(bool, iso_effects_need_radius, next_on, effect->needs_radius)
FIRST(bool, iso_effects_have_image, next_acting, effect->image)
FIRST(bool, iso_effects_pull, next_acting, effect->potential)
FIRST(const iso_effect *, iso_effects_off_chart, next_acting,
      !effect->is_level && (effect->potential || !effect->image))

static iso_effect_id rotor_id(const iso_effects *effects)
{
    int e = 0;
    while (e < ISO_EFFECTS && !(iso_effect_list[e]->is_rotor && effects->on[e])) e++;
    return (iso_effect_id)e;
}

const double *iso_effects_rotor(const iso_effects *effects)
{
    static const double none[3] = {0};
    return rotor_id(effects) < ISO_EFFECTS ? effects->number[rotor_id(effects)] : none;
}

void iso_effects_set_rotor(iso_effects *effects, const double K[3])
{
    for (int i = 0; rotor_id(effects) < ISO_EFFECTS && i < 3; i++) effects->number[rotor_id(effects)][i] = K[i];
}

bool iso_effects_are_free(const iso_effects *effects)
{
    return !iso_effects_beyond_level(effects);
}

const iso_effect *iso_effects_without_frequencies(const iso_problem *f, const char **why)
{
    int e = 0;
    const iso_effect *effect;
    *why = NULL;
    while (!*why && (effect = next_acting(&f->effects, &e)))
        *why = effect->no_frequencies ? effect->no_frequencies(f) : NULL;
    return *why ? effect : NULL;
}

bool iso_effects_keep(const iso_problem *f, iso_additional integral)
{
    const iso_effect *effect;
    bool keep = true;
    for (int e = 0; (effect = next_acting(&f->effects, &e));)
        keep = keep && effect->keeps && effect->keeps(f, integral);
    return keep;
}

bool iso_effects_reversible(const iso_problem *f, const double sign[3])
{
    const iso_effect *effect;
    bool holds = true;
    for (int e = 0; (effect = next_acting(&f->effects, &e));)
        holds = holds && effect->reversible && effect->reversible(f, sign);
    return holds;
}

static iso_work work_of(const iso_problem *f, const iso_effect *effect)
{
    return effect->work ? effect->work(f) : ISO_WORK_UNKNOWN;
}

bool iso_effects_keep_energy(const iso_problem *f)
{
    const iso_effect *effect;
    bool keep = true;
    for (int e = 0; (effect = next_acting(&f->effects, &e));) keep = keep && work_of(f, effect) == ISO_WORK_NONE;
    return keep;
}

static const iso_effect *first_with(const iso_problem *f, iso_work work)
{
    int e = 0;
    const iso_effect *effect;
    while ((effect = next_acting(&f->effects, &e)) && work_of(f, effect) != work) continue;
    return effect;
}

const iso_effect *iso_effects_taking_energy(const iso_problem *f)
{
    return first_with(f, ISO_WORK_LOST);
}

const iso_effect *iso_effects_changing_energy(const iso_problem *f)
{
    return first_with(f, ISO_WORK_UNKNOWN);
}

/* --- writing their equations down ------------------------------------------------------------------------------- */

int iso_effect_states(const iso_effect *effect, const iso_problem *f)
{
    int count = 0;
    for (const iso_effect_state *s = effect->states; s && s->name; s++)
        if (!s->there || s->there(f)) count += s->count;
    return count;
}

bool iso_effect_is_derived(const iso_effect *effect)
{
    return effect->states && effect->states->kind == ISO_STATE_DERIVED;
}

/* What kind of state stands at y[at]. */
static uint8_t kind_at(const iso_problem *f, int at)
{
    for (int e = 0; e < ISO_EFFECTS; e++) {
        int here = f->at[e];
        for (const iso_effect_state *s = iso_effect_list[e]->states; here > 0 && s && s->name; s++) {
            if (s->there && !s->there(f)) continue;
            if (at >= here && at < here + s->count) return (uint8_t)s->kind;
            here += s->count;
        }
    }
    return ISO_STATE_ANY;
}

static void finish_formula(const iso_problem *f, iso_formula *F)
{
    for (int i = 0; i < F->states; i++) F->state[i].kind = kind_at(f, F->state[i].at);
    iso_formula_finish(F, &f->p);
}

/* How many rates y[at] has; the rate of a vector state is that of three numbers. */
static int rates_of(const iso_formula *F, int at)
{
    int rates = 0;
    for (int i = 0; i < F->lines; i++) {
        const iso_formula_line *l = &F->line[i];
        const bool is_vector = l->operation == ISO_R_VECTOR_RATE;
        for (int s = 0; (is_vector || l->operation == ISO_R_SCALAR_RATE) && s < F->states; s++)
            if (F->state[s].node == l->to && F->state[s].is_vector == is_vector)
                rates += at >= F->state[s].at && at < F->state[s].at + (is_vector ? 3 : 1);
    }
    return rates;
}

/* How many of the formula's states hold y[at]. */
static int shapes_of(const iso_formula *F, int at)
{
    int shapes = 0;
    for (int s = 0; s < F->states; s++)
        shapes += at >= F->state[s].at && at < F->state[s].at + (F->state[s].is_vector ? 3 : 1);
    return shapes;
}

/* Each state of an effect that is on has one rate, and one shape. A series has no derived states. */
static const char *wrong_states(const iso_problem *f, iso_effect_id e, const iso_formula *F)
{
    const int first = f->at[e], states = first > 0 ? iso_effect_states(iso_effect_list[e], f) : 0;
    for (int at = first; at < first + states; at++) {
        if (F->series && kind_at(f, at) == ISO_STATE_DERIVED) continue;
        if (rates_of(F, at) != 1) return "a state has no rate, or more than one";
        if (shapes_of(F, at) != 1) return "a state is read as a number here and as part of a vector there";
    }
    return NULL;
}

/* Adds the lines of one effect. */
static void record_motion_of(const iso_problem *f, iso_effect_id e, iso_formula *F)
{
    const bool torques = F->torques;
    F->torques = false;
    if (iso_effect_list[e]->motion) iso_effect_list[e]->motion(F, f);
    if (!iso_effect_acts(&f->effects, e) && F->torques) F->wrong = "it observes, and has a torque";
    F->torques = F->torques || torques;
}

void iso_effects_record_motion(const iso_problem *f, bool series, iso_formula *F)
{
    iso_formula_begin(F, ISO_FORMULA_MOTION, series);
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++)
        if (f->effects.on[e]) record_motion_of(f, e, F);
    for (iso_effect_id e = 0; e < ISO_EFFECTS && !F->wrong; e++)
        if (f->effects.on[e]) F->wrong = wrong_states(f, e, F);
    finish_formula(f, F);
}

void iso_effects_record_energy(const iso_problem *f, iso_formula *F)
{
    const iso_effect *effect;
    iso_formula_begin(F, ISO_FORMULA_ENERGY, false);
    for (int e = 0; (effect = next_acting(&f->effects, &e));)
        if (effect->potential) effect->potential(F, f);
    finish_formula(f, F);
}

void iso_effects_record_image(const iso_problem *f, iso_formula *F)
{
    const iso_effect *effect;
    iso_formula_begin(F, ISO_FORMULA_IMAGE, false);
    for (int e = 0; (effect = next_acting(&f->effects, &e));)
        if (effect->image) effect->image(F, f);
    finish_formula(f, F);
}

const iso_effect *iso_effects_magnetic(const iso_problem *f)
{
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        iso_formula F;
        if (!iso_effect_acts(&f->effects, e) || !iso_effect_list[e]->image) continue;
        iso_formula_begin(&F, ISO_FORMULA_IMAGE, false);
        iso_effect_list[e]->image(&F, f);
        if (F.magnetic) return iso_effect_list[e];
    }
    return NULL;
}

/* --- sums ------------------------------------------------------------------------------------------------------- */

void iso_effects_torque(const iso_problem *f, const double y[], double T[3], double dy[])
{
    const iso_effect *effect;
    T[0] = T[1] = T[2] = 0;
    if (f->motion.kind == ISO_FORMULA_MOTION && f->motion.lines > 0) iso_formula_rates(&f->motion, &f->p, y, T, dy);
    for (int e = 0; (effect = next_acting(&f->effects, &e));)
        if (effect->torque) effect->torque(f, y, T);
}

double iso_effects_twist_torque(const iso_problem *f, const double y[])
{
    iso_problem twisting = *f;
    double T[3], dy[ISO_MAX_STATE];
    for (int e = 0; e < ISO_EFFECTS; e++) twisting.effects.on[e] = f->effects.on[e] && iso_effect_list[e]->twists;
    iso_effects_record_motion(&twisting, false, &twisting.motion);
    iso_effects_torque(&twisting, y, T, dy);
    return dot(T, y + 3) / dot(y + 3, y + 3);
}

double iso_effects_potential(const iso_problem *f, const double y[])
{
    if (iso_effects_none(&f->effects)) return 0;
    if (f->energy_formula.kind == ISO_FORMULA_ENERGY) return iso_formula_energy(&f->energy_formula, &f->p, y);
    iso_formula F;
    iso_effects_record_energy(f, &F);
    return iso_formula_energy(&F, &f->p, y);
}

double iso_effects_image(const iso_problem *f, const double y[])
{
    if (iso_effects_none(&f->effects)) return 0;
    if (f->energy_formula.kind == ISO_FORMULA_IMAGE) return iso_formula_image(&f->energy_formula, &f->p, y).potential;
    iso_formula F;
    iso_effects_record_image(f, &F);
    return iso_formula_image(&F, &f->p, y).potential;
}

/* The largest number that a function of the rows gives; 0: none has the function. */
#define LARGEST(question, function, parameters, arguments)                                                           \
    double question parameters                                                                                       \
    {                                                                                                                \
        const iso_effect *effect;                                                                                    \
        double most = 0;                                                                                             \
        for (int e = 0; (effect = next_acting(&f->effects, &e));)                                                    \
            if (effect->function) most = fmax(most, effect->function arguments);                                     \
        return most;                                                                                                 \
    }

LARGEST(iso_effects_strength, strength, (const iso_problem *f, const double y[]), (f, y))
LARGEST(iso_effects_largest, range, (const iso_problem *f, const double y[]), (f, y))
LARGEST(iso_effects_stiffness, stiffness, (const iso_problem *f), (f))

double iso_effects_range(const iso_problem *f, const double y[])
{
    return fmax(iso_effects_strength(f, y), iso_effects_largest(f, y));
}

/* Everything that acts takes motion away, and something does. */
static bool only_resisted(const iso_problem *f)
{
    const iso_effect *effect;
    bool only = true;
    for (int e = 0; (effect = next_acting(&f->effects, &e));)
        only = only && !effect->potential && work_of(f, effect) != ISO_WORK_UNKNOWN;
    return only && iso_effects_stiffness(f) > 0;
}

double iso_effects_moving(const iso_problem *f)
{
    const iso_effect *effect;
    double least = INFINITY;
    if (!only_resisted(f)) return INFINITY;
    for (int e = 0; (effect = next_acting(&f->effects, &e));)
        if (effect->time_to_rest) least = fmin(least, effect->time_to_rest(f));
    return least;
}

bool iso_effects_at_rest(const iso_problem *f, const double y[])
{
    return largest(y) < ISO_REST && only_resisted(f);
}

const iso_integral *iso_effect_integrals_of(const iso_effect *effect, const iso_system *system)
{
    return system == &iso_system_ball    ? effect->integrals
           : system == &iso_system_point ? effect->image_integrals
                                         : NULL;
}

int iso_integrals_holding(const iso_system *system, const iso_problem *f, const iso_integral *list[], int most)
{
    const iso_effect *effect;
    int count = 0;
    for (const iso_integral *i = system->integrals; i->name && count < most; i++)
        if (!i->holds || i->holds(f)) list[count++] = i;
    for (int e = 0; (effect = next_on(&f->effects, &e));)
        for (const iso_integral *i = iso_effect_integrals_of(effect, system); i && i->name; i++)
            if ((!i->holds || i->holds(f)) && count < most) list[count++] = i;
    return count;
}

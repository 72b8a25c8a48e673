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
        acting.on[e] = iso_effect_acts(effects, e) || (effects->on[e] && e == ISO_INTEGRALS);
    return acting;
}

const char *iso_effect_why_broken(const iso_effect *effect)
{
    if (effect->breaks) return effect->breaks;
    if (effect->observes || effect == &iso_effect_level || effect->image) return NULL;
    return "its row gives it no image on the point";
}

/* A question to the first effect of which the condition holds; the answer is that effect (NULL: none), whether there is
 * one, or that there is none. next: of those that are on, or of those that act. */
#define FIRST(question, next, effects, condition, answer)                                                            \
    question                                                                                                         \
    {                                                                                                                \
        const iso_effect *effect;                                                                                    \
        int e = iso_effects_none(effects) ? ISO_EFFECTS : 0;                                                         \
        while ((effect = next(effects, &e)) && !(condition)) continue;                                               \
        return answer;                                                                                               \
    }
#define FIRST_ON(answer, question, condition)                                                                        \
    FIRST(answer question(const iso_effects *effects), next_on, effects, condition, effect)
#define FIRST_ACTING(answer, question, condition)                                                                    \
    FIRST(answer question(const iso_effects *effects), next_acting, effects, condition, effect)

FIRST_ACTING(const iso_effect *, iso_effects_breaking, iso_effect_why_broken(effect))
FIRST_ACTING(const iso_effect *, iso_effects_beyond_level, effect != &iso_effect_level)
FIRST_ACTING(const iso_effect *, iso_effects_beyond_rotor, effect != &iso_effect_level && effect != &iso_effect_rotor)
FIRST_ACTING(const iso_effect *, iso_effects_off_chart,
             effect != &iso_effect_level && (effect->potential || !effect->image))
FIRST_ACTING(const iso_effect *, iso_effects_without_formula, effect->torque)
FIRST_ACTING(bool, iso_effects_have_image, effect->image)
FIRST_ACTING(bool, iso_effects_pull, effect->potential)
FIRST_ACTING(bool, iso_effects_written, effect->expressions)
FIRST(bool iso_effects_are_free(const iso_effects *effects), next_acting, effects, effect != &iso_effect_level,
      !effect)
FIRST_ON(const iso_effect *, iso_effects_idle, effects->idle[e - 1]) /* e is behind it */
FIRST_ON(const iso_effect *, iso_effects_ball_only, effect->ball_only)
FIRST_ON(bool, iso_effects_twist, effect->twists)
FIRST_ON(bool, iso_effects_clocks, effect == &iso_effect_clock)
FIRST_ON(bool, iso_effects_need_D, effect->needs_D)
FIRST_ON(bool, iso_effects_need_radius, effect->needs_radius)

static iso_work work_of(const iso_problem *f, const iso_effect *effect)
{
    return effect->work ? effect->work(f) : ISO_WORK_UNKNOWN;
}

FIRST(const iso_effect *iso_effects_taking_energy(const iso_problem *f), next_acting, &f->effects,
      work_of(f, effect) == ISO_WORK_LOST, effect)
FIRST(const iso_effect *iso_effects_changing_energy(const iso_problem *f), next_acting, &f->effects,
      work_of(f, effect) == ISO_WORK_UNKNOWN, effect)
FIRST(bool iso_effects_keep_energy(const iso_problem *f), next_acting, &f->effects,
      work_of(f, effect) != ISO_WORK_NONE, !effect)
FIRST(bool iso_effects_keep(const iso_problem *f, iso_additional integral), next_acting, &f->effects,
      !effect->keeps || !effect->keeps(f, integral), !effect)
FIRST(bool iso_effects_reversible(const iso_problem *f, const double sign[3]), next_acting, &f->effects,
      !effect->reversible || !effect->reversible(f, sign), !effect)

/* Everything that acts takes motion away, and something does. */
FIRST(static bool only_resisted(const iso_problem *f), next_acting, &f->effects,
      effect->potential || work_of(f, effect) == ISO_WORK_UNKNOWN, !effect && iso_effects_stiffness(f) > 0)

const iso_effect *iso_effects_without_frequencies(const iso_problem *f, const char **why)
{
    int e = 0;
    const iso_effect *effect;
    *why = NULL;
    while (!*why && (effect = next_acting(&f->effects, &e)))
        *why = effect->no_frequencies ? effect->no_frequencies(f) : NULL;
    return *why ? effect : NULL;
}

/* --- the level and the rotor, which the isomorphism carries to the point ----------------------------------------- */

const char *iso_level_name(void)
{
    return iso_effect_level.name;
}

iso_dimension iso_level_dimension(void)
{
    return iso_effect_level.numbers->dimension;
}

const double *iso_effects_rotor(const iso_effects *effects)
{
    static const double none[3] = {0};
    return effects->on[ISO_ROTOR] ? effects->number[ISO_ROTOR] : none;
}

void iso_effects_set_rotor(iso_effects *effects, const double K[3])
{
    if (effects->on[ISO_ROTOR]) copy(K, effects->number[ISO_ROTOR], 3);
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

int iso_effects_place_states(iso_problem *f)
{
    int at = ISO_STATE;
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        const int states = f->effects.on[e] ? iso_effect_states(iso_effect_list[e], f) : 0;
        f->at[e] = states > 0 ? at : 0;
        at += states;
    }
    return at;
}

const iso_effect_state *iso_effects_state_at(const iso_problem *f, int at, iso_effect_id *effect, int *in_group)
{
    for (*effect = 0; *effect < ISO_EFFECTS; ++*effect) {
        *in_group = at - f->at[*effect];
        if (f->at[*effect] == 0 || *in_group < 0) continue;
        for (const iso_effect_state *s = iso_effect_list[*effect]->states; s && s->name; s++) {
            if (s->there && !s->there(f)) continue;
            if (*in_group < s->count) return s;
            *in_group -= s->count;
        }
    }
    return NULL;
}

static void finish_formula(const iso_problem *f, iso_formula *F)
{
    iso_effect_id effect;
    int in_group;
    for (int i = 0; i < F->states; i++) {
        const iso_effect_state *s = iso_effects_state_at(f, F->state[i].at, &effect, &in_group);
        F->state[i].kind = s ? (uint8_t)s->kind : ISO_STATE_ANY;
    }
    iso_formula_finish(F, &f->p);
}

/* Each state of an effect that is on has one rate, and one shape; the rate of a vector state is that of three numbers.
 * A series has no derived states. */
static const char *wrong_states(const iso_problem *f, iso_effect_id e, const iso_formula *F)
{
    const int first = f->at[e], states = first > 0 ? iso_effect_states(iso_effect_list[e], f) : 0;
    for (int at = first; at < first + states && !(F->series && iso_effect_is_derived(iso_effect_list[e])); at++) {
        int rates = 0, shapes = 0;
        for (int s = 0; s < F->states; s++) {
            const bool is_vector = F->state[s].is_vector;
            if (at < F->state[s].at || at >= F->state[s].at + (is_vector ? 3 : 1)) continue;
            shapes++;
            for (int i = 0; i < F->lines; i++)
                rates += F->line[i].to == F->state[s].node &&
                         F->line[i].operation == (is_vector ? ISO_R_VECTOR_RATE : ISO_R_SCALAR_RATE);
        }
        if (rates != 1) return "a state has no rate, or more than one";
        if (shapes != 1) return "a state is read as a number here and as part of a vector there";
    }
    return NULL;
}

void iso_effects_record_motion(const iso_problem *f, bool series, iso_formula *F)
{
    bool torques = false;
    iso_formula_begin(F, ISO_FORMULA_MOTION, series);
    for (iso_effect_id e = 0; e < ISO_EFFECTS; e++) {
        F->torques = false;
        if (f->effects.on[e] && iso_effect_list[e]->motion) iso_effect_list[e]->motion(F, f);
        if (F->torques && !iso_effect_acts(&f->effects, e)) F->wrong = "it observes, and has a torque";
        torques = torques || F->torques;
    }
    F->torques = torques;
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

static bool is_magnetic(const iso_problem *f, const iso_effect *effect)
{
    iso_formula F;
    iso_formula_begin(&F, ISO_FORMULA_IMAGE, false);
    if (effect->image) effect->image(&F, f);
    return F.magnetic;
}

FIRST(const iso_effect *iso_effects_magnetic(const iso_problem *f), next_acting, &f->effects, is_magnetic(f, effect),
      effect)

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

/* The largest number that a function of the rows returns; 0: none has the function. */
#define LARGEST(question, function, parameters, arguments)                                                           \
    question parameters                                                                                              \
    {                                                                                                                \
        const iso_effect *effect;                                                                                    \
        double most = 0;                                                                                             \
        for (int e = 0; (effect = next_acting(&f->effects, &e));)                                                    \
            if (effect->function) most = fmax(most, effect->function arguments);                                     \
        return most;                                                                                                 \
    }

LARGEST(double iso_effects_strength, strength, (const iso_problem *f, const double y[]), (f, y))
LARGEST(double iso_effects_largest, range, (const iso_problem *f, const double y[]), (f, y))
LARGEST(double iso_effects_stiffness, stiffness, (const iso_problem *f), (f))

double iso_effects_range(const iso_problem *f, const double y[])
{
    return fmax(iso_effects_strength(f, y), iso_effects_largest(f, y));
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

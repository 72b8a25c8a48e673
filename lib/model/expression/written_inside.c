/* written_inside.c - looks inside steps: how much the expressions of a scene vary where a step goes.
 *
 * A method chooses its steps by what it sees at a few places. An expression of the scene may have a feature between
 * them, such as a narrow hill, a jump or a wall, which these places do not show. So a method asks here how much the
 * expressions vary over a box that holds the way of the step, or a part of it.
 */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "model/expression/written_impl.h"
#include "model/model_impl.h"

/* A degree up to which a polynomial in n, omega and e is no narrower than the motion itself. */
enum { FLAT_DEGREE = 12 };

typedef struct actor { /* an expression by which an effect acts */
    iso_effect_id id;
    iso_expression e;
} actor;

struct iso_inside {
    iso_written text[ISO_WRITTEN]; /* as they were read last, into `actor` */
    int actors;
    actor actor[ISO_WRITTEN * ISO_EXPRESSIONS];
};

/* Reads the texts, if they are not those that were read last. */
static void read_texts(iso_inside *inside, const iso_effects *effects)
{
    if (inside->actors > 0 && memcmp(inside->text, effects->written, sizeof inside->text) == 0) return;
    inside->actors = 0;
    memcpy(inside->text, effects->written, sizeof inside->text);
    for (iso_effect_id id = 0; id < ISO_EFFECTS; id++)
        for (int i = 0;
             iso_effect_acts(effects, id) && iso_written_drives(effects, id) && iso_effect_list[id]->expressions[i];
             i++) {
            actor *p = &inside->actor[inside->actors];
            p->id = id;
            if (iso_written_read(effects, id, i, &p->e)) inside->actors++; /* else the orbit is refused */
        }
}

bool iso_inside_create(const iso_problem *f, iso_inside **inside)
{
    const bool any = iso_effects_written(&f->effects);
    *inside = NULL;
    if (any) *inside = calloc(1, sizeof **inside);
    return !any || *inside;
}

void iso_inside_free(iso_inside *inside)
{
    free(inside);
}

bool iso_inside_flat(iso_inside *inside, const iso_problem *f)
{
    bool flat = true;
    read_texts(inside, &f->effects);
    for (int i = 0; i < inside->actors; i++) flat = flat && iso_expression_degree(&inside->actor[i].e) <= FLAT_DEGREE;
    return flat;
}

/* The largest change of an expression that does not matter: of U, `least` of the energy of the motion; of a torque,
 * what changes omega by `least` of it in the time of the step. In the caller's units; speed: |omega|. */
static double negligible(const iso_problem *f, const actor *p, const iso_stretch *stretch, double speed, double least)
{
    const double *number = f->effects.number[p->id], W = number[ISO_WRITTEN_W];
    const double unit = number[ISO_WRITTEN_J] * W * W, inertia = min3(f->p.J);
    if (iso_effect_list[p->id]->potential) return least * unit * inertia * speed * speed;
    return least * unit * inertia * speed / stretch->time;
}

double iso_inside_variation(iso_inside *inside, const iso_model *m, const iso_stretch *stretch, double least)
{
    const iso_problem *f = &m->problem;
    const bool point = m->system == &iso_system_point;
    double ball[ISO_MAX_STATE], most = 0;
    read_texts(inside, &f->effects);
    copy(stretch->y, ball, m->moving);
    if (point) iso_point_to_point_in_t(&f->p, stretch->y, ball), iso_point_in_t_to_ball(&f->p, ball, ball);
    const double speed = norm(ball) * (1 + stretch->omega / (norm(stretch->y) + DBL_MIN));
    for (int i = 0; i < inside->actors; i++) {
        const actor *p = &inside->actor[i];
        if (point && !iso_effect_list[p->id]->image) continue;
        /* n = J^(1/2) gamma / |J^(1/2) gamma| moves at most (max J/min J)^(1/2) times as far as gamma */
        const iso_expression_box box = {.middle = iso_written_state(f, p->id, ball),
                                        .n = stretch->n * (point ? sqrt(max3(f->p.J) / min3(f->p.J)) : 1),
                                        .omega = stretch->omega * f->effects.number[p->id][ISO_WRITTEN_W],
                                        .e = stretch->e};
        most = fmax(most, iso_expression_variation(&p->e, &box, negligible(f, p, stretch, speed, least)));
    }
    return most;
}

double iso_inside_longest(iso_inside *inside, const iso_model *m, int direction, const double y[], double least)
{
    const int up = m->problem.at[ISO_GRAVITY];
    double dy[ISO_MAX_STATE], middle[ISO_MAX_STATE];
    m->rhs(m, y, dy);
    const double dn = norm(dy + 3), domega = norm(dy), de = up > 0 ? norm(dy + up) : 0;
    double h = 1 / (dn + sqrt(domega)); /* about a radian, by the speed dn/dt or from rest */
    for (int i = 0; i < 64; i++, h /= 2) {
        const double reach = 0.75 * h; /* from the middle; the rates may grow on the way */
        for (int j = 0; j < m->moving; j++) middle[j] = y[j] + direction * h / 2 * dy[j];
        const iso_stretch stretch = {.y = middle,
                                     .n = reach * (dn + h * domega),
                                     .omega = reach * domega,
                                     .e = de > 0 ? reach * (de + h * domega) : 0,
                                     .time = h};
        if (!(iso_inside_variation(inside, m, &stretch, least) > 1)) break;
    }
    return h;
}

bool iso_inside_is_lost(const iso_model *m, const double y[], double h)
{
    double dy[ISO_MAX_STATE]; /* rates of omega, then of n; of a point, of M and gamma */
    m->rhs(m, y, dy);
    return fabs(h) * (norm(dy + 3) + sqrt(norm(dy))) < 1e-8;
}

/* past.c - what an integrator keeps of its steps, so that a time already passed is found without starting again.
 *
 * In each direction it keeps places: ends of steps, with their exact times. There are two kinds of methods.
 * - A method that can save its state (iso_method.save) takes steps again from a place, with the same bits. It keeps
 *   the end of every fourth step. That takes 0.7 % of the time of a free point; every step would take 3 %, most of
 *   it for fresh pages of memory. Where places fill the memory allowed, every second one is dropped. Then up to 8,
 *   16, ... steps are taken again.
 * - Of other methods, which carry a history of their own, every step's end is kept. Times between two places are
 *   found from the first (gsl.c), with the same bits, and the method itself stays where it is. Where places fill
 *   the memory, the older half is dropped. Times before it are found from the start again.
 * A method that finds times within a step from its history (bdf) keeps nothing.
 */
#include <stdlib.h>
#include <string.h>

#include "base/vec3_impl.h"
#include "method/integrator_impl.h"
#include "model/model_impl.h"

/* The head of a place. The state follows: of the method, or at the end of the step. */
typedef struct place {
    iso_instant end; /* of step `first + i stride`, which place i stands for */
    double h;        /* of this step */
} place;

enum { FIRST_ROOM = 16 };

static bool can_save(const iso_integrator *it)
{
    return it->method->save != NULL;
}

static size_t size_of_place(const iso_integrator *it)
{
    return sizeof(place) + (can_save(it) ? it->saved : (size_t)it->model.dim * sizeof(double));
}

static place head(const iso_integrator *it, const iso_past *p, size_t i)
{
    place head;
    memcpy(&head, p->places + i * size_of_place(it), sizeof head);
    return head;
}

static void *state(const iso_integrator *it, const iso_past *p, size_t i)
{
    return p->places + i * size_of_place(it) + sizeof(place);
}

/* --- keeping ---------------------------------------------------------------------------------------------------- */

/* Makes room by dropping places: every second one, or the older half. */
static void drop(const iso_integrator *it, iso_past *p)
{
    const size_t size = size_of_place(it), half = p->count / 2;
    if (can_save(it)) {
        for (size_t i = 0; i < half; i++) memcpy(p->places + i * size, p->places + (2 * i + 1) * size, size);
        p->stride *= 2;
        p->first = p->stride;
        p->count = half;
    } else {
        memmove(p->places, p->places + half * size, (p->count - half) * size);
        p->first += (long)half;
        p->count -= half;
    }
}

/* Whether there is room for one more place. Without memory for more, it makes do with what it has. */
static bool make_room(const iso_integrator *it, iso_past *p)
{
    if (p->count < p->room) return true;
    const size_t size = size_of_place(it), most = it->options.memory / size;
    const size_t room = p->room == 0 ? FIRST_ROOM : 2 * p->room < most ? 2 * p->room : most;
    char *more = room > p->room && room <= most ? realloc(p->places, room * size) : NULL;
    if (more) p->places = more, p->room = room;
    if (!more && p->room >= FIRST_ROOM) drop(it, p);
    return p->count < p->room;
}

void iso_past_keep(iso_integrator *it)
{
    iso_past *p = iso_past_of(it, it->direction);
    const bool stale = can_save(it) && it->resting; /* at rest no steps are taken: the method's state is old */
    if (it->options.memory == 0 || stale || (!can_save(it) && it->method->dense)) return;
    if (p->stride == 0) p->first = p->stride = can_save(it) ? 4 : 1; /* see the head of this file */
    if (it->number != p->first + (long)p->count * p->stride || !make_room(it, p)) return;
    if (it->number != p->first + (long)p->count * p->stride) return; /* just dropped by half */
    const place end = {iso_instant_later(it->left, it->h), it->h};
    const size_t i = p->count++;
    memcpy(p->places + i * size_of_place(it), &end, sizeof end);
    if (can_save(it))
        it->method->save(it, state(it, p, i));
    else
        memcpy(state(it, p, i), it->at_right, (size_t)it->model.dim * sizeof(double));
}

void iso_past_forget(iso_integrator *it)
{
    for (int side = 0; side < 2; side++) {
        free(it->past[side].places);
        it->past[side] = (iso_past){0};
    }
}

/* --- going back to it ------------------------------------------------------------------------------------------- */

/* How many places lie before t. */
static size_t count_before(const iso_integrator *it, const iso_past *p, int direction, double t)
{
    size_t from = 0, to = p->count;
    while (from < to) {
        const size_t middle = from + (to - from) / 2;
        if (direction * iso_instant_since(head(it, p, middle).end, t) > 0)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

/* The current step becomes the one that ends at place i, seen from outside: the method does not move. */
static void see(iso_integrator *it, const iso_past *p, int direction, size_t i)
{
    const size_t bytes = (size_t)it->model.dim * sizeof(double);
    const place end = head(it, p, i);
    const bool first = p->first + (long)i == 1;
    it->direction = direction;
    it->number = p->first + (long)i;
    it->left = first ? (iso_instant){0, 0} : head(it, p, i - 1).end;
    it->h = end.h;
    memcpy(it->at_left, first ? it->y0 : state(it, p, i - 1), bytes);
    memcpy(it->at_right, state(it, p, i), bytes);
    it->resting = direction > 0 && iso_model_at_rest(&it->model, it->at_left);
}

/* Whether the step that ends at place i can be seen: its beginning is kept, too. */
static bool can_see(const iso_integrator *it, const iso_past *p, size_t i)
{
    return !can_save(it) && i < p->count && (i > 0 || p->first == 1);
}

/* The method goes on from the end of place i. The current step has no length yet. */
static void go_on_from(iso_integrator *it, const iso_past *p, int direction, size_t i)
{
    it->direction = direction;
    it->stopped = it->resting = false;
    it->number = it->method_number = p->first + (long)i * p->stride;
    it->method_direction = direction;
    it->left = head(it, p, i).end;
    it->h = 0;
    it->method->recall(it, state(it, p, i), it->at_right);
    copy(it->at_right, it->at_left, it->model.dim);
}

bool iso_past_recall(iso_integrator *it, int direction, double t)
{
    const iso_past *p = iso_past_of(it, direction);
    const bool onwards = direction == it->direction && direction * iso_integrator_since(it, t) >= 0;
    const size_t before = count_before(it, p, direction, t);
    if (can_save(it)) {
        if (before == 0) return onwards;
        const long number = p->first + (long)(before - 1) * p->stride;
        if (!onwards || number > it->number) go_on_from(it, p, direction, before - 1);
        return true;
    }
    if (can_see(it, p, before))
        see(it, p, direction, before);
    else if (before > 0 && before == p->count && can_see(it, p, before - 1))
        see(it, p, direction, before - 1);
    else
        return onwards;
    return true;
}

bool iso_past_next(iso_integrator *it)
{
    const iso_past *p = iso_past_of(it, it->direction);
    if (it->number < p->first - 1 || !can_see(it, p, (size_t)(it->number + 1 - p->first))) return false;
    see(it, p, it->direction, (size_t)(it->number + 1 - p->first));
    return true;
}

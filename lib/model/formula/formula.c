/* formula.c - writes formulas down, line by line (formula.h). series/evaluate_impl.h computes them. */
#include "model/formula/formula_lines_impl.h"

#include <string.h>

#include "model/system.h"

_Static_assert(ISO_FORMULA_CONSTANTS <= UINT8_MAX && ISO_FORMULA_SCALARS <= UINT8_MAX &&
                   ISO_FORMULA_VECTORS <= UINT8_MAX && ISO_R_MAGNETIC <= UINT8_MAX,
               "a line holds them in uint8_t");

void iso_formula_begin(iso_formula *F, iso_formula_kind kind, bool series)
{
    F->kind = kind;
    F->series = series;
    F->overrun = F->late = F->torques = F->magnetic = false;
    F->wrong = NULL;
    F->constants = F->lines = F->states = 0;
    F->scalars = ISO_GIVEN_SCALARS;
    F->vectors = ISO_GIVEN_VECTORS;
    memset(F->late_line, 0, sizeof F->late_line);
    memset(F->late_scalar, 0, sizeof F->late_scalar);
    memset(F->late_vector, 0, sizeof F->late_vector);
    F->late_vector[ISO_GIVEN_OMEGA_DOT] = true;
}

/* The place of the next of `count`, of which there is room for `most`; the last one again where there is none. */
static int next_place(iso_formula *F, int *count, int most)
{
    if (*count < most) return (*count)++;
    F->overrun = true;
    return most - 1;
}

static iso_formula_line line_of(iso_operation operation, int to, int a, int b)
{
    return (iso_formula_line){(uint8_t)operation, (uint8_t)to, (uint8_t)a, (uint8_t)b};
}

int iso_formula_constant(iso_formula *F, iso_operation operation, int a, int b)
{
    const int at = next_place(F, &F->constants, ISO_FORMULA_CONSTANTS);
    F->constant[at] = line_of(operation, at, a, b);
    F->value[at] = 0;
    return at;
}

int iso_formula_value(iso_formula *F, double x)
{
    const int at = iso_formula_constant(F, ISO_C_VALUE, 0, 0);
    F->value[at] = x;
    return at;
}

/* What goes into a line as a and b: a scalar (s), a vector (v), a constant (c), a constant vector (C) or matrix (M). */
static const char operands[][3] = {
    [ISO_S_ADD] = "ss",         [ISO_S_SUB] = "ss",     [ISO_S_MUL] = "ss",       [ISO_S_DIV] = "ss",
    [ISO_S_TIMES] = "cs",       [ISO_S_PLUS] = "cs",    [ISO_S_POWER] = "sc",     [ISO_S_EXP] = "s",
    [ISO_S_LOG] = "s",          [ISO_S_SIN] = "ss",     [ISO_S_COS] = "ss",       [ISO_S_DOT] = "vv",
    [ISO_S_DOT_C] = "Cv",       [ISO_V_ADD] = "vv",     [ISO_V_SUB] = "vv",       [ISO_V_TIMES] = "cv",
    [ISO_V_SCALE] = "sv",       [ISO_V_SCALE_C] = "Cs", [ISO_V_CROSS] = "vv",     [ISO_V_BY] = "Cv",
    [ISO_V_MATRIX] = "Mv",      [ISO_V_PLUS] = "Cv",    [ISO_R_TORQUE] = "cv",    [ISO_R_VECTOR_RATE] = "cv",
    [ISO_R_SCALAR_RATE] = "cs", [ISO_R_ENERGY] = "cs",  [ISO_R_POTENTIAL] = "cs", [ISO_R_GRADIENT] = "cv",
    [ISO_R_MAGNETIC] = "cs"};

/* A set of scalars and a set of vectors: whether each is in it. */
typedef struct sets {
    const bool *scalars, *vectors;
} sets;

/* Whether the line takes a scalar or a vector of the sets. */
static bool takes(sets of, const iso_formula_line *l)
{
    const char *kind = operands[l->operation];
    bool any = false;
    for (int i = 0; i < 2; i++) {
        const int place = i == 0 ? l->a : l->b;
        any = any || (kind[i] == 's' && of.scalars[place]) || (kind[i] == 'v' && of.vectors[place]);
    }
    return any;
}

/* What is not given to a formula of this kind: energies depend on n and on states, images on gamma alone. */
static sets not_given(iso_formula_kind kind)
{
    static const bool none[ISO_FORMULA_SCALARS] = {false}, spin[ISO_FORMULA_SCALARS] = {[ISO_GIVEN_SPIN] = true};
    static const bool moving[ISO_FORMULA_VECTORS] = {[ISO_GIVEN_OMEGA] = true, [ISO_GIVEN_OMEGA_DOT] = true};
    static const bool all_but_n[ISO_FORMULA_VECTORS] = {
        [ISO_GIVEN_OMEGA] = true, [ISO_GIVEN_U] = true, [ISO_GIVEN_OMEGA_DOT] = true};
    switch (kind) {
    case ISO_FORMULA_ENERGY: return (sets){spin, moving};
    case ISO_FORMULA_IMAGE: return (sets){spin, all_but_n};
    default: return (sets){none, none};
    }
}

/* Writes the line; returns whether it is late. */
static bool write_line(iso_formula *F, iso_operation operation, int to, int a, int b)
{
    const int at = next_place(F, &F->lines, ISO_FORMULA_LINES);
    const iso_formula_line *l = &F->line[at];
    F->line[at] = line_of(operation, to, a, b);
    const bool late = takes((sets){F->late_scalar, F->late_vector}, l);
    F->late_line[at] = late;
    F->late = F->late || late;
    const int constants = operands[operation][0] == 'M' ? 9 : operands[operation][0] == 'C' ? 3 : 0;
    if (!F->overrun && constants > 0 && a + constants > F->constants)
        F->wrong = "a constant is used as a vector or a matrix, and is none";
    if (takes(not_given(F->kind), l)) F->wrong = "an energy depends on what moves, or an image on more than gamma";
    return late;
}

int iso_formula_scalar(iso_formula *F, iso_operation operation, int a, int b)
{
    const int to = next_place(F, &F->scalars, ISO_FORMULA_SCALARS);
    F->late_scalar[to] = write_line(F, operation, to, a, b);
    return to;
}

int iso_formula_vector(iso_formula *F, iso_operation operation, int a, int b)
{
    const int to = next_place(F, &F->vectors, ISO_FORMULA_VECTORS);
    F->late_vector[to] = write_line(F, operation, to, a, b);
    return to;
}

int iso_formula_sine(iso_formula *F, int a)
{
    const int sine = next_place(F, &F->scalars, ISO_FORMULA_SCALARS);
    const int cosine = next_place(F, &F->scalars, ISO_FORMULA_SCALARS);
    F->late_scalar[sine] = write_line(F, ISO_S_SIN, sine, a, cosine);
    F->late_scalar[cosine] = write_line(F, ISO_S_COS, cosine, a, sine);
    return sine;
}

void iso_formula_result(iso_formula *F, iso_operation operation, int to, int a, int b)
{
    const bool late = write_line(F, operation, to, a, b);
    F->torques = F->torques || operation == ISO_R_TORQUE;
    F->magnetic = F->magnetic || operation == ISO_R_MAGNETIC;
    const bool rate = operation == ISO_R_VECTOR_RATE || operation == ISO_R_SCALAR_RATE;
    bool is_state = false;
    for (int i = 0; i < F->states; i++)
        is_state = is_state || (F->state[i].node == to && F->state[i].is_vector == (operation == ISO_R_VECTOR_RATE));
    if (rate && !is_state) F->wrong = "a rate is given to what is no state";
    if (late && !rate) F->wrong = "a torque depends on omega', which follows from the torque";
}

int iso_formula_state(iso_formula *F, bool is_vector, int at)
{
    for (int i = 0; i < F->states; i++)
        if (F->state[i].at == at && F->state[i].is_vector == is_vector) return F->state[i].node;
    if (at < ISO_STATE || F->kind == ISO_FORMULA_IMAGE) F->wrong = "it reads a state that is not there";
    const int i = next_place(F, &F->states, ISO_FORMULA_STATES);
    const int node =
        is_vector ? next_place(F, &F->vectors, ISO_FORMULA_VECTORS) : next_place(F, &F->scalars, ISO_FORMULA_SCALARS);
    F->state[i].is_vector = is_vector;
    F->state[i].node = (uint8_t)node;
    F->state[i].at = (uint8_t)at;
    F->state[i].kind = 0;
    return node;
}

/* Takes out the lines that no result needs. From the last to the first: what a line takes is needed if it is. A sine
 * and its cosine need each other. */
void iso_formula_shorten(iso_formula *F)
{
    bool scalars[ISO_FORMULA_SCALARS] = {false}, vectors[ISO_FORMULA_VECTORS] = {false};
    bool needed[ISO_FORMULA_LINES];
    for (int i = F->lines - 1; i >= 0; i--) {
        const iso_formula_line *l = &F->line[i];
        const bool scalar = l->operation < ISO_V_ADD, circle = l->operation == ISO_S_COS && scalars[l->b];
        needed[i] = l->operation >= ISO_R_TORQUE || (scalar ? scalars[l->to] || circle : vectors[l->to]);
        for (int j = 0; needed[i] && j < 2; j++) {
            const char kind = operands[l->operation][j];
            if (kind == 's') scalars[j == 0 ? l->a : l->b] = true;
            if (kind == 'v') vectors[j == 0 ? l->a : l->b] = true;
        }
    }
    int kept = 0;
    for (int i = 0; i < F->lines; i++) {
        if (!needed[i]) continue;
        F->late_line[kept] = F->late_line[i];
        F->line[kept++] = F->line[i];
    }
    F->lines = kept;
}

bool iso_formula_alike(const iso_formula *F, const iso_formula *G)
{
    if (F->kind != G->kind) return false;
    if (F->kind == ISO_FORMULA_NONE) return true;
    if (F->constants != G->constants || F->lines != G->lines || F->states != G->states) return false;
    return memcmp(F->constant, G->constant, (size_t)F->constants * sizeof *F->constant) == 0 &&
           memcmp(F->line, G->line, (size_t)F->lines * sizeof *F->line) == 0 &&
           memcmp(F->state, G->state, (size_t)F->states * sizeof *F->state) == 0;
}

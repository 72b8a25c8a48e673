/* quantity_impl.h - what a part of an expression is worth, as a part of a formula: nothing, exactly 1, a constant or a
 * scalar. Sums and products of quantities write no line where none is needed. */
#ifndef ISO_MODEL_EXPRESSION_QUANTITY_IMPL_H
#define ISO_MODEL_EXPRESSION_QUANTITY_IMPL_H

#include "model/formula/formula_impl.h"

typedef struct iso_quantity {
    enum { ISO_IS_ZERO, ISO_IS_ONE, ISO_IS_CONSTANT, ISO_IS_SCALAR } kind;
    int at;
} iso_quantity;

static const iso_quantity zero_q = {ISO_IS_ZERO, 0}, one_q = {ISO_IS_ONE, 0};

static inline iso_quantity constant_q(iso_constant c)
{
    return (iso_quantity){ISO_IS_CONSTANT, c.at};
}

static inline iso_quantity variable_q(iso_scalar s)
{
    return (iso_quantity){ISO_IS_SCALAR, s.at};
}

/* Whether it is the same all along an orbit. */
static inline bool is_fixed_q(iso_quantity a)
{
    return a.kind != ISO_IS_SCALAR;
}

/* That one as a constant of the formula. */
static inline iso_constant fixed_q(iso_formula *F, iso_quantity a)
{
    return a.kind == ISO_IS_CONSTANT ? (iso_constant){a.at} : constant(F, a.kind == ISO_IS_ONE);
}

/* As a scalar of the formula. */
static inline iso_scalar scalar_q(iso_formula *F, iso_quantity a)
{
    if (a.kind == ISO_IS_SCALAR) return (iso_scalar){a.at};
    const iso_scalar base = {ISO_GIVEN_BASE}; /* of ball and point */
    return plus_c(F, fixed_q(F, a), sub(F, base, base));
}

static inline iso_quantity add_q(iso_formula *F, iso_quantity a, iso_quantity b)
{
    if (a.kind == ISO_IS_ZERO) return b;
    if (b.kind == ISO_IS_ZERO) return a;
    if (is_fixed_q(a) && is_fixed_q(b)) return constant_q(add_c(F, fixed_q(F, a), fixed_q(F, b)));
    if (is_fixed_q(a)) return variable_q(plus_c(F, fixed_q(F, a), (iso_scalar){b.at}));
    if (is_fixed_q(b)) return variable_q(plus_c(F, fixed_q(F, b), (iso_scalar){a.at}));
    return variable_q(add(F, (iso_scalar){a.at}, (iso_scalar){b.at}));
}

static inline iso_quantity mul_q(iso_formula *F, iso_quantity a, iso_quantity b)
{
    if (a.kind == ISO_IS_ZERO || b.kind == ISO_IS_ONE) return a;
    if (b.kind == ISO_IS_ZERO || a.kind == ISO_IS_ONE) return b;
    if (is_fixed_q(a) && is_fixed_q(b)) return constant_q(mul_c(F, (iso_constant){a.at}, (iso_constant){b.at}));
    if (is_fixed_q(a)) return variable_q(times_c(F, (iso_constant){a.at}, (iso_scalar){b.at}));
    if (is_fixed_q(b)) return variable_q(times_c(F, (iso_constant){b.at}, (iso_scalar){a.at}));
    return variable_q(mul(F, (iso_scalar){a.at}, (iso_scalar){b.at}));
}

static inline iso_quantity negative_q(iso_formula *F, iso_quantity a)
{
    return mul_q(F, constant_q(constant(F, -1)), a);
}

static inline iso_quantity sub_q(iso_formula *F, iso_quantity a, iso_quantity b)
{
    if (!is_fixed_q(a) && !is_fixed_q(b)) return variable_q(sub(F, (iso_scalar){a.at}, (iso_scalar){b.at}));
    if (is_fixed_q(a) && is_fixed_q(b)) return constant_q(sub_c(F, fixed_q(F, a), fixed_q(F, b)));
    return add_q(F, a, negative_q(F, b));
}

static inline iso_quantity div_q(iso_formula *F, iso_quantity a, iso_quantity b)
{
    if (is_fixed_q(b)) {
        if (is_fixed_q(a)) return constant_q(div_c(F, fixed_q(F, a), fixed_q(F, b)));
        return mul_q(F, constant_q(div_c(F, constant(F, 1), fixed_q(F, b))), a);
    }
    if (!is_fixed_q(a)) return variable_q(quotient_of(F, (iso_scalar){a.at}, (iso_scalar){b.at}));
    return mul_q(F, a, variable_q(power_of(F, (iso_scalar){b.at}, constant(F, -1))));
}

static inline iso_quantity log_q(iso_formula *F, iso_quantity a)
{
    if (!is_fixed_q(a)) return variable_q(log_of(F, (iso_scalar){a.at}));
    const iso_constant fixed = fixed_q(F, a);
    return constant_q(function_c(F, ISO_C_LOG, fixed, fixed));
}

/* a^n, n from 1 on: products alone, which hold for every a */
static inline iso_quantity power_q(iso_formula *F, iso_quantity a, int n)
{
    iso_quantity power = one_q;
    for (; n > 0; n /= 2) {
        if (n % 2 == 1) power = mul_q(F, power, a);
        if (n > 1) a = mul_q(F, a, a);
    }
    return power;
}

/* Constants one after the other. */
static inline iso_constant row_q(iso_formula *F, int count, const iso_quantity x[])
{
    const iso_constant once = constant(F, 1);
    iso_constant first = {0};
    for (int i = 0; i < count; i++) {
        const iso_constant c = x[i].kind == ISO_IS_CONSTANT ? mul_c(F, once, (iso_constant){x[i].at})
                                                            : constant(F, x[i].kind == ISO_IS_ONE);
        if (i == 0) first = c;
    }
    return first;
}

#endif

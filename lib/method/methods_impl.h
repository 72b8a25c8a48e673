/* methods_impl.h - the registry of methods, and how to add one.
 *
 * 1. Write lib/method/NAME.c with one row, `const iso_method iso_method_NAME = {...}`. Every member is explained in
 *    method.h, what `create`, `start` and `step` must do in integrator_impl.h. gsl.c is a short example.
 * 2. Say in the row what the method needs of a model: `implicit`, `own_equations`, `steps_in_s`, `system`. A model
 *    that lacks it is then refused by name (method.c), and "auto" passes the method over. If the method needs
 *    something that has no member yet, add the member to iso_method and the check to method.c.
 * 3. If "auto" may take it, write `suits`, with the measurement that says when it is the best.
 * 4. Add X(NAME) to ISO_METHOD_LIST below. No other list names a method: commands, scenes, comparisons and tests go
 *    through this one.
 *
 * The closed solution is a method too (orbit/exact_method.c), but no row of this list: it is a backend.
 */
#ifndef ISO_METHOD_METHODS_IMPL_H
#define ISO_METHOD_METHODS_IMPL_H

#include "method/method.h"

/* gcc and the GNU C library have numbers of 128 bits. */
#include <math.h>
#if defined __HAVE_FLOAT128 && __HAVE_FLOAT128 && !defined __clang__
#define ISO_TAYLOR_HAS_QUAD
#define ISO_QUAD(X) X(taylor_quad)
#else
#define ISO_QUAD(X)
#endif

/* clang-format off */
/* Those of SUNDIALS, and what messages about a method's name add where they are left out (ISO_SUNDIALS=OFF). */
#ifdef ISO_SUNDIALS
#define ISO_WITHOUT_SUNDIALS ""
#define ISO_SUNDIALS_LIST(X)                                                                                       \
    X(adams) X(bdf)                                                                                                \
    X(heun_euler_2_1_2) X(bogacki_shampine_4_2_3) X(ark324l2sa_erk_4_2_3) X(zonneveld_5_3_4)                       \
    X(ark436l2sa_erk_6_3_4) X(ark437l2sa_erk_7_3_4) X(sayfy_aburub_6_3_4) X(cash_karp_6_4_5) X(fehlberg_6_4_5)     \
    X(dormand_prince_7_4_5) X(ark548l2sa_erk_8_4_5) X(ark548l2sab_erk_8_4_5) X(verner_8_5_6) X(fehlberg_13_7_8)
#else
#define ISO_WITHOUT_SUNDIALS " (isoroll was built without SUNDIALS: no cvode, no arkode)"
#define ISO_SUNDIALS_LIST(X)
#endif

/* Every method of the library, in the order in which lists show them. */
#define ISO_METHOD_LIST(X)                                                                                         \
    ISO_SUNDIALS_LIST(X)                                                                      /* sundials.c */     \
    X(rk4) X(rkf45) X(rkck) X(rk8pd) X(msadams) X(msbdf) X(bsimp)                             /* gsl.c    */       \
    X(taylor) X(taylor_extended) ISO_QUAD(X)                                                  /* taylor.c */       \
    X(strang) X(blanes_moan4) X(blanes_moan6) X(kahan_li8) X(sofroniou_spaletta10)        /* symplectic.c */
/* clang-format on */

/* From this stiffness on bdf needs less time than bsimp, which is more exact below it. */
enum { ISO_VERY_STIFF = 1000 };

/* How far a step is moved, relative to its size, back to its constraints and integrals. A sound step is moved by at
 * most 30 tolerances, of series by 0.2, and by some roundings (lib/doc/measured.md). Farther than the first bound,
 * series take a shorter step. Farther than the second, the step is no answer: roundings alone are 1e-10 at most. */
#define ISO_FAR_CORRECTION(tolerance) fmax(100 * (tolerance), 1e-13)
#define ISO_FALSE_CORRECTION(tolerance) fmax(1e5 * (tolerance), 1e-8)
#define ISO_MOVED_TOO_FAR                                                                                            \
    "a step has left the constraints and the energy by far more than its tolerance: it does not see how fast the "   \
    "forces change; take a smaller tolerance, another method or the other backend"

#define ISO_METHOD_DECLARE(name) extern const iso_method iso_method_##name;
ISO_METHOD_LIST(ISO_METHOD_DECLARE)
#undef ISO_METHOD_DECLARE

/* Whether a scene's method is one of them. Errors: ISO_BAD_ARGUMENT about "method", with the nearest name. */
iso_status iso_method_check(iso_context *ctx, const char *name);

/* Whether the method can simulate the model. If not, `why` says what is missing, in words that follow the method's
 * name. */
enum { ISO_WHY_SIZE = 256 };
bool iso_method_serves(const iso_method *method, const iso_model *model, char why[ISO_WHY_SIZE]);

/* What "auto" means for a model: of the methods that serve it the one that suits it best (iso_method.suits), the
 * first of equals in the registry. As a rule:
 * - stiff models (iso_effects_stiffness): `bsimp`, the stiffest `bdf`;
 * - (24) with |k| so small that (max J/min J)^(1/|k|) > 1e10: `rk8pd`;
 * - all others: `taylor`. */
const iso_method *iso_method_auto(const iso_model *model);

/* For references: the method with the least digits above `digits`; and the method asked as `place`-th whether another
 * code confirms a result (the order is that of iso_method.witness). NULL: there is none. */
const iso_method *iso_method_with_more_digits(int digits);
const iso_method *iso_method_witness(int place);

/* A claim of the scene about a torque is tested at this many places of a step, and at its end. */
enum { ISO_CLAIM_PLACES = 8 };

/* For a model whose effects the scene writes, and that series integrate: a method that looks at other places than they
 * do. NULL: the model needs none. */
const iso_method *iso_method_of_other_kind(const iso_model *model);

/* The registry, ended by NULL. */
extern const iso_method *const iso_methods[];

/* The names that a scene can give its method: "auto", then those of the methods. NULL past the last. */
const char *iso_method_word(int i);

#endif

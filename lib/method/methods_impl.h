/* methods_impl.h - the rows of the registry, one line each. */
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

#define ISO_METHOD_LIST(X)                                                                                         \
    X(adams) X(bdf)                                                                           /* cvode.c  */       \
    X(heun_euler) X(bogacki_shampine) X(ark324) X(zonneveld) X(ark436) X(ark437) X(sayfy_aburub)                   \
    X(cash_karp) X(fehlberg45) X(dormand_prince) X(ark548) X(ark548b) X(verner) X(fehlberg78) /* arkode.c */       \
    X(rk4) X(rkf45) X(rkck) X(rk8pd) X(msadams) X(msbdf) X(bsimp)                             /* gsl.c    */       \
    X(taylor) X(taylor_extended) ISO_QUAD(X)                                                  /* taylor.c */       \
    X(strang) X(blanes_moan4) X(blanes_moan6) X(kahan_li8) X(sofroniou_spaletta10)        /* splitting.c */

#define ISO_METHOD_DECLARE(name) extern const iso_method iso_method_##name;
ISO_METHOD_LIST(ISO_METHOD_DECLARE)
#undef ISO_METHOD_DECLARE

#endif

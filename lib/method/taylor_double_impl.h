/* taylor_double_impl.h - the kernel in double precision; NAME is defined by who includes it. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "method/taylor_impl.h"

#define REAL          double
#define ROOT          sqrt
#define LOG           log
#define EXP           exp
#define FMA           fma
#define FABS          fabs
#define EPSILON       DBL_EPSILON
#define TAYLOR_FINER  1

enum { TAYLOR_MOST = 32 };

#include "method/taylor_kernel_impl.h"
#include "method/taylor_method_impl.h"

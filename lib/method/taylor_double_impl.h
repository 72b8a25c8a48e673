/* taylor_double_impl.h - the numbers of the codes in double precision. */
#define NUMBER       double
#define ROOT         sqrt
#define POW          pow
#define FMA          fma
#define EPSILON      DBL_EPSILON
#define FINER        1
#define FINEST_ORDER 28
#define NODES        8

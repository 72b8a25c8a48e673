/* double_impl.h - the macros of number_impl.h for series in doubles; LANES is left to who includes it. */
#define NUMBER double
#define ROOT sqrt
#define POW pow
#define FMA fma
#define ABS fabs
#define EXP exp
#define LOG log
#define SIN sin
#define COS cos

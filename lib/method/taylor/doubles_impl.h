/* doubles_impl.h - the numbers of lanes as doubles, and questions about them. LANES and `real` are those of the
 * variant that includes it. */

/* Times are doubles, whatever the numbers of the series. */
typedef double doubles __attribute__((vector_size(LANES * sizeof(double))));
typedef __typeof__((doubles){0} < (doubles){0}) double_mask;

static inline doubles doubles_of(real a)
{
#if LANES == 1
    return (doubles){(double)a};
#else
    return __builtin_convertvector(a, doubles);
#endif
}

static inline doubles size_of(doubles a)
{
    return (doubles)((double_mask)a & ~(double_mask)(-0.0 - (doubles){0}));
}

static inline bool holds_somewhere(double_mask m)
{
#if LANES == 1
    return m[0] != 0;
#else
    return any(m);
#endif
}

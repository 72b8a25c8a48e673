/* arb_impl.h - balls of Arb, a library of its own before it became a part of FLINT 3. */
#ifndef ISO_BASE_ARB_IMPL_H
#define ISO_BASE_ARB_IMPL_H

#include <flint/fmpq.h>
#if __FLINT_RELEASE >= 30000
#include <flint/arb.h>
#include <flint/arb_mat.h>
#else
#include <arb.h>
#include <arb_mat.h>
#endif

/* A struct of balls, or its first `size` bytes, as one list of them. */
static inline void iso_balls_init(void *balls, size_t size)
{
    for (size_t i = 0; i < size / sizeof(arb_struct); i++) arb_init((arb_ptr)balls + i);
}

static inline void iso_balls_clear(void *balls, size_t size)
{
    for (size_t i = 0; i < size / sizeof(arb_struct); i++) arb_clear((arb_ptr)balls + i);
}

/* Balls for the work of a block: 0 at first, cleared where the block ends, by a return as well.
 *
 *     ISO_BALLS(x, y);                       arb_t x, y; up to four
 *     ISO_BALL_ROW(z, 3);                    arb_struct z[3]
 *     pair p;   ISO_BALLS_OF(p);             a struct of balls that is there already
 */
typedef struct iso_balls_list {
    void *balls;
    size_t size;
} iso_balls_list;

static inline iso_balls_list iso_balls_begin(void *balls, size_t size)
{
    iso_balls_init(balls, size);
    return (iso_balls_list){balls, size};
}

static inline void iso_balls_end(const iso_balls_list *list)
{
    iso_balls_clear(list->balls, list->size);
}

#define ISO_BALLS_OF(x)                                                                                              \
    __attribute__((cleanup(iso_balls_end), unused)) const iso_balls_list x##_list = iso_balls_begin(&(x), sizeof(x))
#define ISO_BALL_ROW(x, count)                                                                                       \
    arb_struct x[count];                                                                                             \
    ISO_BALLS_OF(x)
#define ISO_BALLS_1(x) ISO_BALL_ROW(x, 1)
#define ISO_BALLS_2(x, ...)                                                                                          \
    ISO_BALLS_1(x);                                                                                                  \
    ISO_BALLS_1(__VA_ARGS__)
#define ISO_BALLS_3(x, ...)                                                                                          \
    ISO_BALLS_1(x);                                                                                                  \
    ISO_BALLS_2(__VA_ARGS__)
#define ISO_BALLS_4(x, ...)                                                                                          \
    ISO_BALLS_1(x);                                                                                                  \
    ISO_BALLS_3(__VA_ARGS__)
#define ISO_BALLS_FOR(a, b, c, d, name, ...) name
#define ISO_BALLS(...) ISO_BALLS_FOR(__VA_ARGS__, ISO_BALLS_4, ISO_BALLS_3, ISO_BALLS_2, ISO_BALLS_1, )(__VA_ARGS__)

#endif

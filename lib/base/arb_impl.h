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

#endif

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

#endif

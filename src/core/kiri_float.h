/* Same bits on every machine: each operation on floats and doubles is rounded separately, in its own type. Every file
   includes this one first, so a host may choose its compiler options. An option that no pragma can correct stops the
   compilation, or the creation of a world (kiri_vec.h). */
#ifndef KIRI_FLOAT_H
#define KIRI_FLOAT_H

/* No fused multiply-add: it rounds once where two operations round twice. GCC obeys this where it is set for functions,
   which keeps them from being inlined into others: only where the processor has the instruction. GCC 12 vectorizes a
   product plus and minus another one by such an instruction all the same (vfmaddsub), unless it vectorizes loops alone. */
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__) && (defined(__FP_FAST_FMA) || defined(__FP_FAST_FMAF))
#pragma GCC optimize("fp-contract=off", "no-tree-slp-vectorize")
#elif defined(_MSC_VER)
#pragma fp_contract(off)
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0) ||                           \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__) ||                   \
    defined(_M_FP_FAST)
#error "Kiri gives the same bits everywhere only without -ffast-math, -Ofast, /fp:fast and what they consist of."
#endif

#include <float.h>

/* 16: also each _Float16 operation is rounded to its type. */
#if FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16
#error                                                                                                                 \
    "Kiri needs floats and doubles without excess precision: -msse2 -mfpmath=sse on x86, -fexcess-precision=fast on s390x."
#endif

#endif

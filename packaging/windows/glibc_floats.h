// SPDX-License-Identifier: Apache-2.0
// For libraries.sh: the parts of glibc that its float functions need (sysdeps/ieee754/flt-32 of 2.36 and 2.41), in their
// plain C variant, for processors that round to nearest.
#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#define __atanf atanf
#define __cbrtf cbrtf
#define __exp2f exp2f
#define __expf expf
#define __expm1f expm1f
#define __hypotf hypotf
#define __ieee754_atan2f atan2f
#define COSF cosf
#define SINCOSF __wrap_sincosf // preprocess/CMakeLists.txt
#define SINF sinf
#define __frexpf frexpf
#define __ldexpf ldexpf

// No aliases, symbol versions or visibility attributes.
#define attribute_hidden
#define libm_alias_finite(from, to)
#define libm_alias_float(from, to)
#define libm_alias_float_other(from, to)
#define strong_alias(from, to)
#define versioned_symbol(library, from, to, version)
#define LIBM_SVID_COMPAT 1

// cbrtf compares classes by glibc's numbers.
#undef FP_ZERO
#define FP_ZERO 2
#undef fpclassify
#define fpclassify(x) __builtin_fpclassify(0, 1, 4, 3, FP_ZERO, x)

#define GET_FLOAT_WORD(word, number) ((word) = (int32_t)((union { float f; uint32_t u; }){.f = (number)}).u)
#define SET_FLOAT_WORD(number, word) ((number) = ((union { uint32_t u; float f; }){.u = (uint32_t)(word)}).f)
#define HIGH_ORDER_BIT_IS_SET_FOR_SNAN 0
#define issignaling(x) 0
#define math_check_force_underflow(x) ((void)0)
#define math_force_eval(x) ((void)0)
#define math_narrow_eval(x) (x)
#define math_opt_barrier(x) (x)
#define roundeven(x) rint(x)
#define NOINLINE __attribute__((noinline))
#define __glibc_likely(x) (x)
#define __glibc_unlikely(x) (x)
#define __set_errno(number) (errno = (number))

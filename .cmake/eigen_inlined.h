#pragma once

// Eigen, inlined always where our own code is optimized: of a function that is not, the linker keeps one copy for the
// whole program, and a consumer's may be compiled with other instructions, which align and add otherwise.

#if defined(__OPTIMIZE__) && defined(__GNUC__)
#define EIGEN_STRONG_INLINE __attribute__((always_inline)) inline
#endif

#include <Eigen/src/Core/util/Macros.h>

#if defined(__OPTIMIZE__) && defined(__GNUC__)
#undef EIGEN_DEVICE_FUNC
#define EIGEN_DEVICE_FUNC __attribute__((always_inline))
#endif

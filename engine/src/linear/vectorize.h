// DPE_VECTORIZE compiles a function for several instruction sets and picks one at run
// time. It is for loops over raw arrays only: code that exchanges Eigen objects with
// Ceres must not be compiled for AVX, because the two would disagree on alignment.
#ifndef DPE_ENGINE_LINEAR_VECTORIZE_H_
#define DPE_ENGINE_LINEAR_VECTORIZE_H_

// Sanitizers instrument the resolver before their runtime is up, so they go without.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
    defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) &&        \
    !defined(__SANITIZE_THREAD__)
#define DPE_VECTORIZE \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define DPE_VECTORIZE
#endif

// For what such functions call in their loops, so that it is compiled with them: in
// front of a function, and after the parameters of a lambda.
#define DPE_INLINE_LAMBDA __attribute__((always_inline))
#define DPE_ALWAYS_INLINE inline DPE_INLINE_LAMBDA

#endif  // DPE_ENGINE_LINEAR_VECTORIZE_H_

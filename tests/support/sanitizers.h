// DPE_TEST_SANITIZED is defined where a sanitizer instruments the program: everything
// is many times slower then, and memory is the sanitizer's. GCC says so by macros,
// Clang by
// __has_feature.
#ifndef DPE_TESTS_SUPPORT_SANITIZERS_H_
#define DPE_TESTS_SUPPORT_SANITIZERS_H_

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DPE_TEST_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DPE_TEST_SANITIZED
#endif
#endif

#endif  // DPE_TESTS_SUPPORT_SANITIZERS_H_

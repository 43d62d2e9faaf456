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

#if defined(__SANITIZE_ADDRESS__)
#define DPE_TEST_FINDS_LEAKS
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define DPE_TEST_FINDS_LEAKS
#endif
#endif

#ifdef DPE_TEST_FINDS_LEAKS
extern "C" void __lsan_disable();
extern "C" void __lsan_enable();
#endif

namespace dpe::test {

// While one lives, what is allocated on its thread may be lost.
class LeakOnPurpose {
 public:
#ifdef DPE_TEST_FINDS_LEAKS
  LeakOnPurpose() { __lsan_disable(); }
  ~LeakOnPurpose() { __lsan_enable(); }
#else
  LeakOnPurpose() = default;
  ~LeakOnPurpose() {}  // not trivial: one that is never used is meant
#endif
  LeakOnPurpose(const LeakOnPurpose&) = delete;
  LeakOnPurpose& operator=(const LeakOnPurpose&) = delete;
};

}  // namespace dpe::test

#endif  // DPE_TESTS_SUPPORT_SANITIZERS_H_

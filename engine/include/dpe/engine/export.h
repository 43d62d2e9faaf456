// Marks what the library dpe_engine shows; all else in it is hidden.
//
// Where shared libraries are DLLs, DPE_SHARED and, while the library itself is
// compiled, dpe_engine_EXPORTS come from CMake.
#ifndef DPE_ENGINE_EXPORT_H_
#define DPE_ENGINE_EXPORT_H_

#if defined(_WIN32) && defined(dpe_engine_EXPORTS)
#define DPE_ENGINE_API __declspec(dllexport)
#elif defined(_WIN32) && defined(DPE_SHARED)
#define DPE_ENGINE_API __declspec(dllimport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define DPE_ENGINE_API __attribute__((visibility("default")))
#else
#define DPE_ENGINE_API
#endif

#endif  // DPE_ENGINE_EXPORT_H_

/* What all parts of the C interface share. dpe/dpe_c.h has the rules. */
#ifndef DPE_C_TYPES_H_
#define DPE_C_TYPES_H_

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(DPE_BUILDING_LIBRARY)
#define DPE_API __declspec(dllexport)
#elif defined(_WIN32)
#define DPE_API __declspec(dllimport)
#elif defined(__GNUC__)
#define DPE_API __attribute__((visibility("default")))
#else
#define DPE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Of these headers. The library accepts headers of the same major and of no later minor
 * version than its own; functions are added with a new minor version, and changed or
 * removed with a new major one. */
#define DPE_C_VERSION_MAJOR 1u
#define DPE_C_VERSION_MINOR 0u
#define DPE_C_VERSION ((DPE_C_VERSION_MAJOR << 16) | DPE_C_VERSION_MINOR)

typedef int32_t dpe_status;
enum {
  DPE_OK = 0,
  DPE_ERROR_ARGUMENT = 1, /* an argument that is not accepted */
  DPE_ERROR_HANDLE = 2,   /* not a live handle of the right kind */
  DPE_ERROR_VERSION = 3,  /* the headers do not fit the library */
  DPE_ERROR_INPUT = 4,    /* a file or text that is wrong; the message says where */
  DPE_ERROR_STATE = 5,    /* not now, for instance a step while a thread runs */
  DPE_ERROR_BUFFER = 6,   /* the caller's buffer is too small; nothing is written but
                             the size that it should have */
  DPE_ERROR_SIMULATION =
      7, /* the simulation broke down; the message says at which frame */
  DPE_ERROR_MEMORY = 8,
  DPE_ERROR_INTERNAL = 9
};

/* Handles are numbers, never addresses: a wrong one is noticed and refused. 0 is never
 * a handle. */
typedef uint64_t dpe_handle;
typedef dpe_handle dpe_scene;
typedef dpe_handle dpe_playback;
typedef dpe_handle dpe_builder;
typedef dpe_handle dpe_estimation;

/* The version of the library's interface, (major << 16) | minor. Cannot fail. */
DPE_API uint32_t dpe_version(void);

/* Whether headers of version `header` fit this library: DPE_OK or DPE_ERROR_VERSION.
 * All dpe_*_create functions check it, too: pass DPE_C_VERSION to them. */
DPE_API dpe_status dpe_check_version(uint32_t header);

/* A short name of a status code, "DPE_ERROR_INPUT"; "unknown status" for other numbers.
 * The text belongs to the library and stays valid. Cannot fail. */
DPE_API const char* dpe_status_name(dpe_status status);

/* The message of the last failure that happened with a handle, including those of its
 * own thread; empty if there was none. With handle 0 that of the last failed call of
 * the calling thread, whatever handle it was for: this is where to look after a create
 * function or DPE_ERROR_HANDLE.
 *
 * buffer    receives the text and a zero byte; may be null with capacity 0
 * capacity  of the buffer, bytes
 * length    receives the length of the text without the zero byte, also if the buffer
 * is too small; may be null returns   DPE_ERROR_BUFFER if capacity is not more than the
 * length */
DPE_API dpe_status dpe_last_error(dpe_handle handle, char* buffer, int32_t capacity,
                                  int32_t* length);

/* Destroys all handles of the process, as their destroy functions would. For hosts that
 * forget them, such as an editor that reloads its scripts. */
DPE_API dpe_status dpe_shutdown(void);

/* How many handles are alive. Cannot fail. */
DPE_API int32_t dpe_live_handles(void);

#ifdef __cplusplus
}
#endif

#endif /* DPE_C_TYPES_H_ */

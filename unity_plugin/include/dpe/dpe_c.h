/* dpe for programs that are not C++: one header that includes the whole C interface.
 *
 *   dpe/c/types.h       status codes, handles, versions, errors, dpe_shutdown
 *   dpe/c/scene.h       a scene: its data, stepping it, a thread that runs it
 *   dpe/c/changes.h     what may change while it runs: parameters, colliders, pins
 *   dpe/c/playback.h    a recorded motion
 *   dpe/c/builder.h     making a scene of meshes
 *   dpe/c/estimation.h  estimating parameters, in the background
 *
 * Rules that hold for every function of these headers, and are not repeated there:
 *
 * - Units are SI (m, kg, s, N); y is up; the world is right-handed. Positions are
 *   x, y, z of one vertex after the other.
 * - Text is UTF-8. Text that goes in ends with a zero byte.
 * - Memory belongs to the caller: whoever passes a pointer owns what it points to, and
 *   the library keeps none of them after the call, except `user` of a progress
 * callback.
 * - A function returns a dpe_status. If it is not DPE_OK, nothing that the function
 *   would change has changed (where a header says otherwise, it says so), outputs are
 *   not written, and dpe_last_error has a sentence about it.
 * - A null pointer where one is not allowed, an index out of range, a number that is
 *   not finite: DPE_ERROR_ARGUMENT. A handle that is not one, was destroyed, or is of
 *   another kind: DPE_ERROR_HANDLE. Memory that cannot be had: DPE_ERROR_MEMORY. A
 *   fault of the library: DPE_ERROR_INTERNAL. Functions list what else they return.
 * - Threads: every function may be called from any thread, at any time, also several
 *   at once with the same handle. A destroyed handle stays invalid for ever; a call
 * that is under way in another thread when its handle is destroyed ends soon after,
 * with whatever status it had come to.
 * - No exception leaves the library.
 */
#ifndef DPE_DPE_C_H_
#define DPE_DPE_C_H_

#include "dpe/c/builder.h"
#include "dpe/c/changes.h"
#include "dpe/c/estimation.h"
#include "dpe/c/playback.h"
#include "dpe/c/scene.h"
#include "dpe/c/types.h"

#endif /* DPE_DPE_C_H_ */

/* Estimates a scene's parameters from a recorded motion, in the background.
 * dpe/dpe_c.h has the rules.
 *
 *   create, set options, start; poll (or be called back); read results; destroy */
#ifndef DPE_C_ESTIMATION_H_
#define DPE_C_ESTIMATION_H_

#include "dpe/c/types.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  DPE_ESTIMATION_IDLE = 0, /* not started */
  DPE_ESTIMATION_RUNNING = 1,
  DPE_ESTIMATION_DONE = 2,      /* there is a result; its termination says how good */
  DPE_ESTIMATION_CANCELLED = 3, /* by dpe_estimation_cancel; the best so far is the
                                   result, if there is one */
  DPE_ESTIMATION_FAILED = 4     /* dpe_last_error says why; no result */
};

/* Why the optimiser stopped. */
enum {
  DPE_CONVERGED = 0,
  DPE_MAX_ITERATIONS = 1,
  DPE_MAX_SECONDS = 2,
  DPE_INTERRUPTED = 3,
  DPE_START_FAILED = 4,
  DPE_NUMERICAL_FAILURE = 5
};

typedef struct dpe_progress {
  int32_t iteration;
  int32_t num_frames; /* of the part of the recording that is being fitted */
  double cost;        /* half the sum of squared residuals */
  double rms;         /* m, of the best point so far */
  double seconds;     /* since the start */
  double fraction; /* between 0 and 1 and never falling: a guess, for progress bars */
} dpe_progress;

typedef struct dpe_result {
  int32_t termination; /* DPE_CONVERGED, ... */
  int32_t iterations;
  int32_t num_frames;
  int32_t num_blocks;
  int32_t num_parameters;
  int32_t reserved;         /* 0 */
  double initial_rms;       /* m */
  double final_rms;         /* m */
  double seconds;           /* of the fit */
  double deviation_percent; /* from the values of the scene, if its own motion was the
                               target; NaN if not known */
} dpe_result;

typedef struct dpe_block {
  int32_t object;     /* -1: of the scene */
  int32_t kind;       /* DPE_MASS ... DPE_WIND, see changes.h; 5: initial velocity, 6:
                         initial position */
  int32_t mode;       /* the letter G, L or R */
  int32_t num_values; /* SI units */
  int32_t has_errors; /* 1: dpe_estimation_get_errors has standard deviations */
  int32_t reserved;   /* 0 */
} dpe_block;

/* Called in the thread of the estimation after every iteration. It may call any
 * function of this interface, dpe_estimation_cancel and dpe_estimation_destroy of its
 * own estimation included. It must return: destroying waits for it. */
typedef void (*dpe_progress_callback)(void* user, const dpe_progress* progress);

DPE_API dpe_status dpe_estimation_create(uint32_t header_version,
                                         dpe_estimation* estimation);

/* Destroys an estimation in whatever state it is; a running one is cancelled, and the
 * call returns when its thread has ended (at once, if it is that thread which calls).
 */
DPE_API dpe_status dpe_estimation_destroy(dpe_estimation estimation);

/* Options, with the names and meanings of estimate_cloth's flags. DPE_ERROR_STATE once
 * the estimation runs.
 *
 * text:   scene (required), target (empty: the scene's own motion), settings, estimate,
 *         output_dir (empty: nothing is written), solver, init (auto, inverse_dynamics,
 *         scene, screen), horizon, uncertainty
 * number: frames, validate_frames, max_iterations, max_seconds, threads, sigma,
 *         noise_sigma, seed, follow_pins, start_from_target
 *
 * DPE_ERROR_ARGUMENT for another name, or a value out of range; a text that is not one
 * of those to choose from: DPE_ERROR_INPUT. */
DPE_API dpe_status dpe_estimation_set_text(dpe_estimation estimation, const char* name,
                                           const char* value);
DPE_API dpe_status dpe_estimation_set_number(dpe_estimation estimation,
                                             const char* name, double value);

/* callback  null: none
 * user      passed to it as it is */
DPE_API dpe_status dpe_estimation_set_callback(dpe_estimation estimation,
                                               dpe_progress_callback callback,
                                               void* user);

/* Starts the estimation on a thread of its own and returns. Files are read there: what
 * is wrong with them is found in DPE_ESTIMATION_FAILED. DPE_ERROR_STATE if it has been
 * started before; DPE_ERROR_ARGUMENT without a scene. */
DPE_API dpe_status dpe_estimation_start(dpe_estimation estimation);

/* Asks a running estimation to stop and returns at once; otherwise without effect. */
DPE_API dpe_status dpe_estimation_cancel(dpe_estimation estimation);

/* The state, DPE_ESTIMATION_IDLE, ..., and how far it has got; progress may be null.
 * Returns at once. */
DPE_API dpe_status dpe_estimation_poll(dpe_estimation estimation, int32_t* state,
                                       dpe_progress* progress);

/* Waits until it runs no longer, at most `seconds`, and gives the state. */
DPE_API dpe_status dpe_estimation_wait(dpe_estimation estimation, double seconds,
                                       int32_t* state);

/* What was found. All of them: DPE_ERROR_STATE as long as there is no result. Text as
 * dpe_last_error, numbers as dpe_scene_get_parameter; DPE_ERROR_BUFFER. */
DPE_API dpe_status dpe_estimation_get_result(dpe_estimation estimation,
                                             dpe_result* result);
/* Why it stopped, in one sentence, and notes, a line each. */
DPE_API dpe_status dpe_estimation_get_message(dpe_estimation estimation, char* buffer,
                                              int32_t capacity, int32_t* length);
DPE_API dpe_status dpe_estimation_get_block(dpe_estimation estimation, int32_t block,
                                            dpe_block* info);
DPE_API dpe_status dpe_estimation_get_values(dpe_estimation estimation, int32_t block,
                                             double* values, int32_t capacity,
                                             int32_t* count);
/* Standard deviations, in the unit of the values; infinite: not determined. None if the
 * block has no errors. */
DPE_API dpe_status dpe_estimation_get_errors(dpe_estimation estimation, int32_t block,
                                             double* errors, int32_t capacity,
                                             int32_t* count);
/* The files that were written, a line each: the optimised scene first, if there is one.
 */
DPE_API dpe_status dpe_estimation_get_files(dpe_estimation estimation, char* buffer,
                                            int32_t capacity, int32_t* length);
/* A new scene, with the estimated values in it. */
DPE_API dpe_status dpe_estimation_create_scene(dpe_estimation estimation,
                                               dpe_scene* scene);

#ifdef __cplusplus
}
#endif

#endif /* DPE_C_ESTIMATION_H_ */

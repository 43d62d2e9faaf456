/* A program in C11 that uses the library as a host would: it knows the headers and
 * nothing else.
 *
 *   c_program SCENE MOTION [SCENE MOTION ...]
 *
 * MOTION is what simulate_cloth wrote of SCENE as .npy. Exits with 0 if the library gives
 * the same positions, as float, frame by frame: stepped, and on its own thread. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dpe/dpe_c.h"

static int num_failures = 0;

static void check(int condition, const char* what) {
  char message[1024] = "";
  if (condition) return;
  ++num_failures;
  dpe_last_error(0, message, (int32_t)sizeof(message), NULL);
  fprintf(stderr, "failed: %s (last error: %s)\n", what, message);
}

typedef struct motion {
  long num_frames, num_coordinates;
  double* positions; /* frame by frame */
} motion;

/* Reads frames x vertices x 3 float64 in C order, as simulate_cloth writes it. */
static motion read_npy(const char* path) {
  motion m = {0, 0, NULL};
  unsigned char head[10];
  char header[1024];
  long vertices = 0;
  const char* shape = NULL;
  FILE* file = fopen(path, "rb");
  if (file == NULL || fread(head, 1, 10, file) != 10) goto fail;
  const size_t size = head[8] + 256u * head[9];
  if (size >= sizeof(header) || fread(header, 1, size, file) != size) goto fail;
  header[size] = 0;
  shape = strstr(header, "'shape': (");
  if (shape == NULL || strstr(header, "<f8") == NULL) goto fail;
  if (sscanf(shape, "'shape': (%ld, %ld, 3", &m.num_frames, &vertices) != 2) goto fail;
  m.num_coordinates = 3 * vertices;
  const size_t count = (size_t)(m.num_frames * m.num_coordinates);
  m.positions = malloc(count * sizeof(double));
  if (m.positions == NULL) goto fail;
  if (fread(m.positions, sizeof(double), count, file) != count) goto fail;
  fclose(file);
  return m;
fail:
  fprintf(stderr, "%s cannot be read\n", path);
  exit(2);
}

/* The positions that the library has now are those of the motion at their frame.
 * Returns the frame. */
static int64_t compare(dpe_scene scene, const motion* m, float* positions,
                       uint64_t* sequence) {
  int64_t frame = -1;
  int32_t is_new = 0;
  long differences = 0;
  check(dpe_scene_copy_positions(scene, 0, positions, (int32_t)m->num_coordinates,
                                 sequence, &frame, &is_new) == DPE_OK,
        "dpe_scene_copy_positions");
  if (is_new == 0 || frame >= m->num_frames) return frame;
  for (long i = 0; i < m->num_coordinates; ++i) {
    const float expected = (float)m->positions[frame * m->num_coordinates + i];
    if (memcmp(&expected, &positions[i], sizeof(float)) != 0) ++differences;
  }
  if (differences > 0) {
    ++num_failures;
    fprintf(stderr, "frame %" PRId64 ": %ld coordinates differ\n", frame, differences);
  }
  return frame;
}

static void run(const char* path, const char* motion_path) {
  motion m = read_npy(motion_path);
  float* positions = malloc((size_t)m.num_coordinates * sizeof(float));
  uint64_t sequence = 0;
  int64_t frame = 0;
  dpe_scene scene = 0;
  check(positions != NULL, "memory");
  check(dpe_scene_create_from_file(DPE_C_VERSION, path, &scene) == DPE_OK, "create");
  for (long f = 0; f < m.num_frames; ++f) {
    if (f > 0) check(dpe_scene_step(scene, 1) == DPE_OK, "dpe_scene_step");
    frame = compare(scene, &m, positions, &sequence);
    check(frame == f, "the frame after as many steps");
  }
  check(dpe_scene_stop(scene) == DPE_OK, "dpe_scene_stop");
  check(dpe_scene_start(scene) == DPE_OK, "dpe_scene_start");
  do {
    frame = compare(scene, &m, positions, &sequence);
  } while (frame < m.num_frames - 1 && num_failures == 0);
  check(dpe_scene_destroy(scene) == DPE_OK, "destroying a running scene");
  check(dpe_scene_pause(scene) == DPE_ERROR_HANDLE, "a destroyed scene");
  for (int i = 0; i < 100; ++i) {
    check(dpe_scene_create_from_file(DPE_C_VERSION, path, &scene) == DPE_OK, "reload");
    if (i % 3 != 0) check(dpe_scene_start(scene) == DPE_OK, "start");
    check(dpe_scene_destroy(scene) == DPE_OK, "destroy");
  }
  free(positions);
  free(m.positions);
}

int main(int argc, char** argv) {
  if (argc < 3 || argc % 2 == 0) {
    fprintf(stderr, "usage: c_program SCENE MOTION [SCENE MOTION ...]\n");
    return 2;
  }
  check(dpe_check_version(DPE_C_VERSION) == DPE_OK, "the version");
  for (int i = 1; i + 1 < argc; i += 2) run(argv[i], argv[i + 1]);
  check(dpe_live_handles() == 0, "no handle is left");
  printf("%d scenes, %d failures\n", argc / 2, num_failures);
  return num_failures == 0 ? 0 : 1;
}

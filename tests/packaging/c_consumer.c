/* Steps a scene through the installed C interface. */
#include <dpe/dpe_c.h>
#include <stdio.h>

int main(int argc, char** argv) {
  dpe_scene scene = 0;
  if (argc != 2 ||
      dpe_scene_create_from_file(DPE_C_VERSION, argv[1], &scene) != DPE_OK) {
    return 1;
  }
  if (dpe_scene_step(scene, 5) != DPE_OK) return 2;
  if (dpe_scene_destroy(scene) != DPE_OK || dpe_live_handles() != 0) return 3;
  printf("C interface %u.%u\n", (unsigned)(dpe_version() >> 16),
         (unsigned)(dpe_version() & 0xffff));
  return 0;
}

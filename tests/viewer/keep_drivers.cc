// In programs that a sanitizer watches, libraries stay loaded to the end.
//
// Vulkan's loader unloads drivers with the last instance. What a driver still points to
// then looks like a leak, and of what it did nobody can say in which library that was.
// Linked into dpe_viewer too, see viewer/CMakeLists.txt.
#include "support/sanitizers.h"

#ifdef DPE_TEST_SANITIZED
extern "C" int dlclose(void* /*library*/) { return 0; }
#endif

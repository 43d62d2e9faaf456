// An X server without a screen, for tests that open windows.
#ifndef DPE_TESTS_VIEWER_VIRTUAL_DISPLAY_H_
#define DPE_TESTS_VIEWER_VIRTUAL_DISPLAY_H_

#include <sys/types.h>

#include <string>

namespace dpe::viewer {

// Runs Xvfb on a free display and sets DISPLAY as long as it lives.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  // False where Xvfb is not installed or does not start; skip the test then.
  bool runs() const { return process_ > 0; }

 private:
  pid_t process_ = -1;
  std::string display_before_;
};

}  // namespace dpe::viewer

#endif  // DPE_TESTS_VIEWER_VIRTUAL_DISPLAY_H_

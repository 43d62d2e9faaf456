// The memory of supernodal factorisations (supernodal_structure.h).
#ifndef DPE_ENGINE_LINEAR_SUPERNODAL_PANELS_H_
#define DPE_ENGINE_LINEAR_SUPERNODAL_PANELS_H_

#include <cstddef>
#include <memory>
#include <vector>

#include "linear/supernodal_solve.h"
#include "linear/supernodal_structure.h"

namespace dpe {

// That of one factorisation.
class SupernodalPanels {
 public:
  // Arrays begin at multiples of so many bytes and go on for that many beyond their
  // end, so that they can be copied in whole lines of the caches.
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kLine = kAlignment / sizeof(double);

  // That of several, side by side in one piece of memory, which is freed with the last.
  // Where it is large the system is asked for large pages: a pass over all of them
  // visits more small ones than a processor can remember the addresses of.
  static std::vector<SupernodalPanels> MakeSeveral(const SupernodalStructure& structure,
                                                   bool symmetric, int count);

  // Makes room, not filled; nothing if there is as much already.
  void Allocate(const SupernodalStructure& structure, bool symmetric) {
    if (lower_ != nullptr && (upper_ == nullptr) == symmetric) return;
    *this = MakeSeveral(structure, symmetric, 1).front();
  }

  // The panels of L with the own parts of U, and of U^T (null if symmetric).
  double* lower() const { return lower_; }
  double* upper() const { return upper_; }

  // Of both arrays, which are one.
  std::size_t size() const { return size_; }

  SupernodalFactor factor(const SupernodalStructure& structure) const;

 private:
  std::shared_ptr<double> memory_;
  double* lower_ = nullptr;
  double* upper_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_SUPERNODAL_PANELS_H_

#include "linear/supernodal_panels.h"

#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace dpe {
namespace {

std::size_t RoundUp(std::size_t value, std::size_t unit) {
  return (value + unit - 1) / unit * unit;
}

// Asks for large pages where whole ones fit; that it may not be granted is no failure.
void AskForLargePages(void* memory, std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kLargePage = std::size_t{2} << 20;
  const auto start = reinterpret_cast<std::uintptr_t>(memory);
  const std::size_t skip = RoundUp(start, kLargePage) - start;
  if (bytes < skip + kLargePage) return;
  madvise(static_cast<char*>(memory) + skip, bytes - skip, MADV_HUGEPAGE);
#else
  static_cast<void>(memory);
  static_cast<void>(bytes);
#endif
}

std::shared_ptr<double> MakeMemory(std::size_t size) {
  constexpr std::align_val_t kAlign{SupernodalPanels::kAlignment};
  const std::size_t bytes = size * sizeof(double);
  void* memory = ::operator new(bytes, kAlign);
  AskForLargePages(memory, bytes);
  return {static_cast<double*>(memory),
          [](double* array) { ::operator delete(array, kAlign); }};
}

}  // namespace

std::vector<SupernodalPanels> SupernodalPanels::MakeSeveral(
    const SupernodalStructure& structure, bool symmetric, int count) {
  const std::size_t lower = RoundUp(structure.num_lower_values() + kLine, kLine);
  const std::size_t upper =
      symmetric ? 0 : RoundUp(structure.num_upper_values() + kLine, kLine);
  const std::shared_ptr<double> memory = MakeMemory(count * (lower + upper));
  std::vector<SupernodalPanels> panels(count);
  for (int i = 0; i < count; ++i) {
    panels[i].memory_ = memory;
    panels[i].lower_ = memory.get() + i * (lower + upper);
    if (!symmetric) panels[i].upper_ = panels[i].lower_ + lower;
    panels[i].size_ = lower + upper;
  }
  return panels;
}

SupernodalFactor SupernodalPanels::factor(const SupernodalStructure& structure) const {
  SupernodalFactor factor;
  factor.num_supernodes = structure.num_supernodes;
  factor.first_column = structure.first_column.data();
  factor.row_start = structure.row_start.data();
  factor.row_indices = structure.rows.data();
  factor.value_start = structure.value_start.data();
  factor.upper_start = structure.upper_start.data();
  factor.lower = lower_;
  factor.upper = upper_;
  return factor;
}

}  // namespace dpe

#include "forces/parameter_sink.h"

#include <algorithm>

namespace dpe {

ParameterColumns::ParameterColumns(const ParameterLayout& layout, int object) {
  for (const ParameterBlock& block : layout.blocks()) {
    if (block.object != object && block.object != -1) continue;
    std::vector<int>& columns = columns_[static_cast<int>(block.kind)];
    columns = block.element_to_local;
    for (int& column : columns) {
      if (column >= 0) column += block.offset;
    }
    for (int i = 0; i < block.size; ++i) used_.push_back(block.offset + i);
  }
  std::sort(used_.begin(), used_.end());
}

ParameterColumns ParameterColumns::Compressed() const {
  ParameterColumns result = *this;
  for (std::vector<int>& columns : result.columns_) {
    for (int& column : columns) {
      if (column < 0) continue;
      const auto it = std::lower_bound(used_.begin(), used_.end(), column);
      column = static_cast<int>(it - used_.begin());
    }
  }
  return result;
}

}  // namespace dpe

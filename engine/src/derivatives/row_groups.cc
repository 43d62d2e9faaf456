#include "derivatives/row_groups.h"

#include <algorithm>
#include <numeric>

namespace dpe {

std::vector<RowGroup> GroupRows(const StateDerivatives& derivatives) {
  std::vector<int> last;
  for (const StateDerivative* d : derivatives) {
    const int rows =
        static_cast<int>(std::max(d->d_position.rows(), d->d_velocity.rows()));
    const size_t end = d->first_row + rows;
    if (last.size() < end) last.resize(end, -1);
    for (int r = d->first_row; r < d->first_row + rows; ++r) {
      last[r] = std::max(last[r], d->frame);
    }
  }
  std::vector<int> order(last.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return last[a] > last[b]; });
  std::vector<RowGroup> groups;
  for (int row : order) {
    if (last[row] < 0) break;
    if (groups.empty() || groups.back().rows.size() == kPassBlock) {
      groups.push_back({{}, last[row]});
    }
    groups.back().rows.push_back(row);
  }
  return groups;
}

}  // namespace dpe

#include "linear/supernodal_structure.h"

#include <algorithm>
#include <cassert>

namespace dpe {
namespace {

// A part of the workspace.
struct Interval {
  size_t start;
  size_t size;
};

// Takes the lowest gap between `used` intervals (ascending) that is large enough.
size_t Take(size_t size, std::vector<Interval>* used) {
  size_t start = 0;
  auto next = used->begin();
  for (; next != used->end(); ++next) {
    if (next->start >= start + size) break;
    start = next->start + next->size;
  }
  used->insert(next, {start, size});
  return start;
}

void Release(size_t start, std::vector<Interval>* used) {
  const auto it = std::find_if(used->begin(), used->end(),
                               [&](const Interval& i) { return i.start == start; });
  assert(it != used->end());
  used->erase(it);
}

}  // namespace

SupernodalStructure::SupernodalStructure(const BlockPattern& pattern,
                                         const cholmod_factor& symbolic)
    : num_supernodes(static_cast<int>(symbolic.nsuper)) {
  const int* first = static_cast<const int*>(symbolic.super);
  const int* start = static_cast<const int*>(symbolic.pi);
  const int* row = static_cast<const int*>(symbolic.s);
  first_column.assign(first, first + num_supernodes + 1);
  row_start.assign(start, start + num_supernodes + 1);
  rows.assign(row, row + row_start.back());
  value_start.push_back(0);
  upper_start.push_back(0);
  for (int s = 0; s < num_supernodes; ++s) {
    assert(num_columns(s) % 3 == 0 && num_rows(s) % 3 == 0);
    max_columns = std::max(max_columns, num_columns(s));
    value_start.push_back(value_start.back() +
                          static_cast<size_t>(num_rows(s)) * num_columns(s));
    upper_start.push_back(upper_start.back() +
                          static_cast<size_t>(num_below(s)) * num_columns(s));
  }
  FindTree();
  PlaceRemainders();
  ListPairs(pattern);
}

void SupernodalStructure::FindTree() {
  std::vector<int> supernode_of_column(first_column.back());
  for (int s = 0; s < num_supernodes; ++s) {
    std::fill(supernode_of_column.begin() + first_column[s],
              supernode_of_column.begin() + first_column[s + 1], s);
  }
  first_child.assign(num_supernodes, -1);
  next_sibling.assign(num_supernodes, -1);
  std::vector<int> last_child(num_supernodes, -1);
  run_start.push_back(0);
  for (int s = 0; s < num_supernodes; ++s) {
    if (num_rows(s) > num_columns(s)) {
      const int parent = supernode_of_column[rows[row_start[s] + num_columns(s)]];
      int& link = last_child[parent] < 0 ? first_child[parent]
                                         : next_sibling[last_child[parent]];
      link = s;
      last_child[parent] = s;
      AppendRuns(s, parent);
    }
    run_start.push_back(static_cast<int>(runs.size()));
  }
}

void SupernodalStructure::AppendRuns(int s, int parent) {
  const int begin = row_start[s] + num_columns(s);
  int place = 0;
  for (int k = begin; k < row_start[s + 1]; ++k) {
    const int previous = place;
    while (rows[row_start[parent] + place] != rows[k]) ++place;
    if (k > begin && place == previous + 1 && place != num_columns(parent)) {
      ++runs.back().length;
    } else {
      runs.push_back({k - begin, place, 1});
    }
  }
}

void SupernodalStructure::PlaceRemainders() {
  std::vector<Interval> used;
  remainder_start.assign(num_supernodes, 0);
  for (int s = 0; s < num_supernodes; ++s) {
    const size_t size = num_below(s);
    if (size > 0) {
      remainder_start[s] = Take(size * size, &used);
      workspace_size = std::max(workspace_size, remainder_start[s] + size * size);
    }
    for (int c = first_child[s]; c >= 0; c = next_sibling[c]) {
      Release(remainder_start[c], &used);
    }
  }
}

void SupernodalStructure::ListPairs(const BlockPattern& pattern) {
  pair_start.push_back(0);
  std::vector<int> place(pattern.num_nodes(), -1);
  for (int s = 0; s < num_supernodes; ++s) {
    for (int k = 0; k < num_rows(s); k += 3) place[rows[row_start[s] + k] / 3] = k;
    for (int j = first_column[s] / 3; j < first_column[s + 1] / 3; ++j) {
      const int column = 3 * j - first_column[s];
      for (int k = pattern.block_starts()[j]; k < pattern.block_starts()[j + 1]; ++k) {
        const int i = pattern.block_rows()[k];
        if (i < j) continue;
        pairs.push_back({pattern.Find(i, j), pattern.Find(j, i), place[i], column});
      }
    }
    pair_start.push_back(static_cast<int>(pairs.size()));
  }
}

}  // namespace dpe

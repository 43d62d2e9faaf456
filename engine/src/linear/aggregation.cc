#include "linear/aggregation.h"

#include <algorithm>
#include <numeric>

namespace dpe {
namespace {

struct Graph {
  std::vector<int> starts, columns;
  std::vector<float> weights;
  int num_nodes() const { return static_cast<int>(starts.size()) - 1; }
};

// The pair of each node, numbered by their first nodes.
Aggregates Match(const Graph& graph) {
  Aggregates pairs;
  pairs.of_node.assign(graph.num_nodes(), -1);
  for (int i = 0; i < graph.num_nodes(); ++i) {
    if (pairs.of_node[i] >= 0) continue;
    int partner = -1;
    float strongest = 0.0f;
    for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k) {
      const int j = graph.columns[k];
      if (j == i || pairs.of_node[j] >= 0 || graph.weights[k] <= strongest) continue;
      strongest = graph.weights[k];
      partner = j;
    }
    if (partner >= 0) pairs.of_node[partner] = pairs.count;
    pairs.of_node[i] = pairs.count++;
  }
  return pairs;
}

// The graph whose nodes are the groups.
Graph Contract(const Graph& graph, const Aggregates& groups) {
  std::vector<int> first(groups.count + 1, 0);
  for (int g : groups.of_node) ++first[g + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> members(graph.num_nodes()), next = first;
  for (int i = 0; i < graph.num_nodes(); ++i) members[next[groups.of_node[i]]++] = i;
  Graph coarse;
  coarse.starts.push_back(0);
  std::vector<int> place(groups.count, -1);
  for (int g = 0; g < groups.count; ++g) {
    const int start = coarse.starts.back();
    for (int m = first[g]; m < first[g + 1]; ++m) {
      const int i = members[m];
      for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k) {
        const int h = groups.of_node[graph.columns[k]];
        if (h == g) continue;
        if (place[h] < start) {
          place[h] = static_cast<int>(coarse.columns.size());
          coarse.columns.push_back(h);
          coarse.weights.push_back(0.0f);
        }
        coarse.weights[place[h]] += graph.weights[k];
      }
    }
    coarse.starts.push_back(static_cast<int>(coarse.columns.size()));
  }
  return coarse;
}

}  // namespace

Aggregates Aggregate(const std::vector<int>& starts, const std::vector<int>& columns,
                     const std::vector<float>& weights, int num_passes) {
  Graph graph{starts, columns, weights};
  Aggregates result;
  result.count = graph.num_nodes();
  result.of_node.resize(result.count);
  std::iota(result.of_node.begin(), result.of_node.end(), 0);
  for (int pass = 0; pass < num_passes; ++pass) {
    const Aggregates pairs = Match(graph);
    for (int& group : result.of_node) group = pairs.of_node[group];
    result.count = pairs.count;
    if (pass + 1 < num_passes) graph = Contract(graph, pairs);
  }
  return result;
}

}  // namespace dpe

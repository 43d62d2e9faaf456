#include "linear/ordering.h"

#include <cholmod.h>

#include <algorithm>
#include <new>
#include <numeric>

namespace dpe {

std::vector<int> FillReducingOrder(int num_nodes,
                                   const std::vector<std::pair<int, int>>& couplings) {
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NESDIS;
  common.supernodal = CHOLMOD_SIMPLICIAL;
  cholmod_triplet* triplets = cholmod_allocate_triplet(
      num_nodes, num_nodes, couplings.size(), -1, CHOLMOD_PATTERN, &common);
  if (triplets == nullptr) throw std::bad_alloc();
  int* rows = static_cast<int*>(triplets->i);
  int* columns = static_cast<int*>(triplets->j);
  for (const auto& [a, b] : couplings) {
    if (a < 0 || b < 0 || a == b) continue;
    rows[triplets->nnz] = std::max(a, b);
    columns[triplets->nnz] = std::min(a, b);
    ++triplets->nnz;
  }
  cholmod_sparse* graph = cholmod_triplet_to_sparse(triplets, 0, &common);
  cholmod_factor* factor = graph ? cholmod_analyze(graph, &common) : nullptr;
  std::vector<int> order(num_nodes);
  std::iota(order.begin(), order.end(), 0);
  if (factor != nullptr) {
    const int* permutation = static_cast<const int*>(factor->Perm);
    order.assign(permutation, permutation + num_nodes);
  }
  cholmod_free_factor(&factor, &common);
  cholmod_free_sparse(&graph, &common);
  cholmod_free_triplet(&triplets, &common);
  cholmod_finish(&common);
  return order;
}

}  // namespace dpe

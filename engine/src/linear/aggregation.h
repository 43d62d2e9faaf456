// Groups the nodes of a weighted graph into aggregates of strongly coupled neighbours,
// the unknowns of a multigrid method's next coarser level.
//
// By repeated pairwise matching (Notay 2010): each node is paired with the free
// neighbour that it is coupled to most strongly, pairs become the nodes of the next
// pass, whose coupling is the sum of theirs. After p passes aggregates have up to 2^p
// nodes and follow the strong couplings, whatever the mesh.
#ifndef DPE_ENGINE_LINEAR_AGGREGATION_H_
#define DPE_ENGINE_LINEAR_AGGREGATION_H_

#include <vector>

namespace dpe {

struct Aggregates {
  int count = 0;
  std::vector<int> of_node;  // the aggregate of each node
};

// @param starts, columns  compressed rows of a symmetric graph; a node may be its own
//                         neighbour, which is ignored
// @param weights          one per entry, >= 0; entries of weight 0 are not coupled
Aggregates Aggregate(const std::vector<int>& starts, const std::vector<int>& columns,
                     const std::vector<float>& weights, int num_passes);

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_AGGREGATION_H_

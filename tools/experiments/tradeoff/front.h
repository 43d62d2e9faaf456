// Pareto fronts: what nothing else beats.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_FRONT_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_FRONT_H_

#include <cstddef>
#include <vector>

namespace dpe::experiments::tradeoff {

struct CostAndError {
  double cost = 0.0;
  double error = 0.0;
};

// Whether `a` beats `b`: it is cheaper and more accurate. One of which a value is not a
// number beats nothing and is beaten by everything else.
bool Beats(const CostAndError& a, const CostAndError& b);

// The points that no other beats, from the cheapest to the most accurate; of equal
// points the first. Those with a value that is not a number are never among them.
std::vector<size_t> ParetoFront(const std::vector<CostAndError>& points);

// The cheapest point with an error of at most `error`, or points.size().
size_t CheapestWithin(const std::vector<CostAndError>& points, double error);

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_FRONT_H_

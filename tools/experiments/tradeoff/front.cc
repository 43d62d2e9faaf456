#include "experiments/tradeoff/front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dpe::experiments::tradeoff {
namespace {

bool IsKnown(const CostAndError& point) {
  return !std::isnan(point.cost) && !std::isnan(point.error);
}

}  // namespace

bool Beats(const CostAndError& a, const CostAndError& b) {
  if (!IsKnown(a)) return false;
  return !IsKnown(b) || (a.cost < b.cost && a.error < b.error);
}

std::vector<size_t> ParetoFront(const std::vector<CostAndError>& points) {
  std::vector<size_t> order;
  for (size_t i = 0; i < points.size(); ++i) {
    if (IsKnown(points[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost
                                            : points[a].error < points[b].error;
  });
  std::vector<size_t> front;
  double best = std::numeric_limits<double>::infinity();
  for (size_t i : order) {
    if (!(points[i].error < best)) continue;
    best = points[i].error;
    front.push_back(i);
  }
  return front;
}

size_t CheapestWithin(const std::vector<CostAndError>& points, double error) {
  size_t cheapest = points.size();
  for (size_t i = 0; i < points.size(); ++i) {
    if (!IsKnown(points[i]) || points[i].error > error) continue;
    if (cheapest == points.size() || points[i].cost < points[cheapest].cost) {
      cheapest = i;
    }
  }
  return cheapest;
}

}  // namespace dpe::experiments::tradeoff

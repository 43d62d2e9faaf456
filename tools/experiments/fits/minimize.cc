#include "experiments/fits/minimize.h"

#include <algorithm>
#include <cmath>

namespace dpe::experiments {
namespace {

using Point = std::vector<double>;

// Points of a grid in one list; index = i0 + count0 * i1 + ...
class Grid {
 public:
  Grid(const Point& low, const Point& high, const std::vector<int>& count)
      : low_(low), high_(high), count_(count) {}

  int size() const {
    int size = 1;
    for (const int n : count_) size *= n;
    return size;
  }

  Point At(int index) const {
    Point point;
    for (size_t d = 0; d < count_.size(); ++d) {
      const int i = index % count_[d];
      index /= count_[d];
      const double step = count_[d] > 1 ? (high_[d] - low_[d]) / (count_[d] - 1) : 0.0;
      point.push_back(low_[d] + step * i);
    }
    return point;
  }

  // Along the axes.
  std::vector<int> Neighbours(int index) const {
    std::vector<int> neighbours;
    int stride = 1;
    for (const int n : count_) {
      const int i = index / stride % n;
      if (i > 0) neighbours.push_back(index - stride);
      if (i + 1 < n) neighbours.push_back(index + stride);
      stride *= n;
    }
    return neighbours;
  }

 private:
  Point low_, high_;
  std::vector<int> count_;
};

// a + t (b - a)
Point Along(const Point& a, const Point& b, double t) {
  Point result = a;
  for (size_t d = 0; d < a.size(); ++d) result[d] += t * (b[d] - a[d]);
  return result;
}

class Simplex {
 public:
  Simplex(const Objective& objective, const Point& start, double step)
      : objective_(objective) {
    Add(start);
    for (size_t d = 0; d < start.size(); ++d) {
      Point corner = start;
      corner[d] += step;
      Add(corner);
    }
    Sort();
  }

  const Minimum& best() const { return corners_.front(); }

  bool HasConverged(double tolerance) const {
    double extent = 0.0;
    for (const Minimum& corner : corners_) {
      for (size_t d = 0; d < corner.at.size(); ++d) {
        extent = std::max(extent, std::abs(corner.at[d] - best().at[d]));
      }
    }
    return extent < 1e-5 &&
           corners_.back().value - best().value <= tolerance * std::abs(best().value);
  }

  void Step() {
    Minimum& worst = corners_.back();
    const Point centre = Centre();
    const Minimum reflected = Evaluate(Along(worst.at, centre, 2.0));
    if (reflected.value < best().value) {
      const Minimum expanded = Evaluate(Along(worst.at, centre, 3.0));
      worst = expanded.value < reflected.value ? expanded : reflected;
    } else if (reflected.value < corners_[corners_.size() - 2].value) {
      worst = reflected;
    } else {
      const bool is_outside = reflected.value < worst.value;
      const Minimum contracted =
          Evaluate(Along(worst.at, centre, is_outside ? 1.5 : 0.5));
      if (contracted.value < std::min(reflected.value, worst.value)) {
        worst = contracted;
      } else {
        Shrink();
      }
    }
    Sort();
  }

 private:
  Minimum Evaluate(const Point& point) const { return {point, objective_(point)}; }
  void Add(const Point& point) { corners_.push_back(Evaluate(point)); }
  void Sort() {
    std::stable_sort(corners_.begin(), corners_.end(),
                     [](const auto& a, const auto& b) { return a.value < b.value; });
  }
  void Shrink() {
    for (size_t c = 1; c < corners_.size(); ++c) {
      corners_[c] = Evaluate(Along(best().at, corners_[c].at, 0.5));
    }
  }
  // Of all corners but the worst.
  Point Centre() const {
    Point centre(best().at.size(), 0.0);
    const size_t n = corners_.size() - 1;
    for (size_t c = 0; c < n; ++c) {
      for (size_t d = 0; d < centre.size(); ++d) {
        centre[d] += corners_[c].at[d] / static_cast<double>(n);
      }
    }
    return centre;
  }

  const Objective& objective_;
  std::vector<Minimum> corners_;
};

}  // namespace

std::vector<Minimum> GridMinima(const Objective& objective, const Point& low,
                                const Point& high, const std::vector<int>& count,
                                int max_minima) {
  const Grid grid(low, high, count);
  std::vector<double> values;
  for (int i = 0; i < grid.size(); ++i) values.push_back(objective(grid.At(i)));
  std::vector<Minimum> minima;
  for (int i = 0; i < grid.size(); ++i) {
    const std::vector<int> neighbours = grid.Neighbours(i);
    const bool is_lowest = std::isfinite(values[i]) &&
                           std::none_of(neighbours.begin(), neighbours.end(),
                                        [&](int n) { return values[n] < values[i]; });
    if (is_lowest) minima.push_back({grid.At(i), values[i]});
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [](const auto& a, const auto& b) { return a.value < b.value; });
  if (static_cast<int>(minima.size()) > max_minima) minima.resize(max_minima);
  return minima;
}

Minimum GoldenSection(const Objective& objective, double low, double high,
                      double tolerance) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double left = high - ratio * (high - low), right = low + ratio * (high - low);
  double left_value = objective({left}), right_value = objective({right});
  while (high - low > tolerance) {
    if (left_value <= right_value) {
      high = right;
      right = left;
      right_value = left_value;
      left = high - ratio * (high - low);
      left_value = objective({left});
    } else {
      low = left;
      left = right;
      left_value = right_value;
      right = low + ratio * (high - low);
      right_value = objective({right});
    }
  }
  if (left_value <= right_value) return {{left}, left_value};
  return {{right}, right_value};
}

Minimum NelderMead(const Objective& objective, const Point& start, double step,
                   double tolerance) {
  // Smooth minima take about 60; one that takes more is not smooth.
  constexpr int kMaxSteps = 150;
  Minimum best = {start, 0.0};
  for (int run = 0; run < 2; ++run) {
    Simplex simplex(objective, best.at, step);
    for (int i = 0; i < kMaxSteps && !simplex.HasConverged(tolerance); ++i) {
      simplex.Step();
    }
    best = simplex.best();
  }
  return best;
}

}  // namespace dpe::experiments

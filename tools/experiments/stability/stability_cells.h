// Rows of the stability experiment by axis, value, method and solver, as its tables and
// plots ask for them.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_CELLS_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_CELLS_H_

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// A method, and a solver where there is a choice.
struct Way {
  int method;
  const char* solver;

  bool is_direct() const { return std::string(solver) == "cholesky"; }
};
constexpr Way kWays[] = {{0, "cholesky"}, {1, "cholesky"}, {2, "cholesky"}, {2, "cg"},
                         {3, "cholesky"}, {3, "cg"},       {4, "cholesky"}, {4, "cg"}};

std::string MethodName(int method);
// A value of an axis.
std::string ValueText(double value);
// "implicit_euler, cg"; the method alone where there is no choice.
std::string WayName(const Way& way);

// What came of a cell: its "result" (stability_cell.h), or the executor's outcome if
// the job did not end ("crashed", "timed_out", "failed").
std::string ResultOf(const Row& row);

// Whether that is a motion that did not blow up, accurate or not.
bool IsStableResult(const std::string& result);

// The cells of one axis.
class Cells {
 public:
  Cells(const std::vector<Row>& rows, const std::string& axis);
  const Row* Find(double value, const Way& way) const;  // null: there is no such row

 private:
  std::map<std::tuple<double, int, std::string>, const Row*> rows_;
};

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_CELLS_H_

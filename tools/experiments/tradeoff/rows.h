// The rows of the trade-off experiment as its tables and plots read them.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_ROWS_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_ROWS_H_

#include <functional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/tradeoff/front.h"

namespace dpe::experiments::tradeoff {

// The scenes of the experiment.
const std::vector<std::string>& TradeoffScenes();

// The rows of a kind and a scene, whether they are done or not.
std::vector<Row> RowsOf(const std::vector<Row>& rows, const std::string& kind,
                        const std::string& scene);

// NaN unless the row is done, its job not stopped, and the key there.
double Measured(const Row& row, const std::string& key);

// Why a row has no result; empty if it has.
std::string WhyNot(const Row& row);

std::vector<CostAndError> Points(const std::vector<Row>& rows, const std::string& cost,
                                 const std::string& error);

// SettingsText of the row's candidate.
std::string SettingsOf(const Row& row);

// One series of marks per integrator, the front as a line, and the rows that `name`
// gives a name to, annotated with it.
// @param scale_x, scale_y  from the rows' units to those of the axes
std::vector<Series> TradeoffSeries(const std::vector<Row>& rows,
                                   const std::vector<CostAndError>& points,
                                   double scale_x, double scale_y,
                                   const std::function<std::string(const Row&)>& name);

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_ROWS_H_

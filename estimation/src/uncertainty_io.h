// Uncertainty as JSON, a part of the report.
#ifndef DPE_ESTIMATION_UNCERTAINTY_IO_H_
#define DPE_ESTIMATION_UNCERTAINTY_IO_H_

#include <nlohmann/json.hpp>

#include "dpe/estimation/uncertainty.h"

namespace dpe {

// What is unknown or not a finite number is null: the standard deviation of what is not
// determined.
//
// ok, message, noise_known, noise, degrees_of_freedom, reduced_chi_square, rank,
// weak_directions (a number), parameters [{object, capture (of blocks that one of
// several has alone), kind, mode, unit, values,
// standard_deviations, relative, determined_part, flags [{index, names}]}] (values in
// the order of the report's; only flagged ones have an entry in `flags`), covariance
// and correlation (rows, of the logarithms of positive quantities; null beyond
// max_matrix_parameters), strongest_correlations [{first, second, correlation, text}],
// directions [{exact, pattern, num_parameters, parts [{name, coefficient}], data_std,
// std, text}], statements [].
nlohmann::ordered_json UncertaintyToJson(const Uncertainty& uncertainty);

}  // namespace dpe

#endif  // DPE_ESTIMATION_UNCERTAINTY_IO_H_

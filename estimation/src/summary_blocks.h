// The parameter vector as people read it: one entry per block.
#ifndef DPE_ESTIMATION_SUMMARY_BLOCKS_H_
#define DPE_ESTIMATION_SUMMARY_BLOCKS_H_

#include <Eigen/Core>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/estimation/estimator.h"

namespace dpe {

std::vector<EstimatedBlock> MakeEstimatedBlocks(const ParameterLayout& layout,
                                                const Eigen::VectorXd& parameters);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SUMMARY_BLOCKS_H_

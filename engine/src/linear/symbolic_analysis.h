// The symbolic analysis of a pattern by CHOLMOD (Chen, Davis, Hager & Rajamanickam
// 2008): which columns are factorised together, and what fills in.
#ifndef DPE_ENGINE_LINEAR_SYMBOLIC_ANALYSIS_H_
#define DPE_ENGINE_LINEAR_SYMBOLIC_ANALYSIS_H_

#include <memory>

#include "linear/block_pattern.h"
#include "linear/supernodal_structure.h"

namespace dpe {

// @param pattern  in a fill-reducing order (ordering.h): it is not permuted
// @throws std::bad_alloc
std::shared_ptr<const SupernodalStructure> AnalyzePattern(const BlockPattern& pattern);

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_SYMBOLIC_ANALYSIS_H_

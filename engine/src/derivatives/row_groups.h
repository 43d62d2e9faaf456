// Residual rows in the groups that the block adjoint sweeps together.
#ifndef DPE_ENGINE_DERIVATIVES_ROW_GROUPS_H_
#define DPE_ENGINE_DERIVATIVES_ROW_GROUPS_H_

#include <vector>

#include "derivatives/jacobian_pass.h"

namespace dpe {

// At most kPassBlock rows, none of which depends on a frame after last_frame.
struct RowGroup {
  std::vector<int> rows;
  int last_frame = 0;
};

// All rows that the derivatives name, those with the latest last frame first, so that a
// step backward touches a prefix of the groups.
std::vector<RowGroup> GroupRows(const StateDerivatives& derivatives);

}  // namespace dpe

#endif  // DPE_ENGINE_DERIVATIVES_ROW_GROUPS_H_

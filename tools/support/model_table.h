// What estimate_cloth prints of a choice between models.
#ifndef DPE_TOOLS_SUPPORT_MODEL_TABLE_H_
#define DPE_TOOLS_SUPPORT_MODEL_TABLE_H_

#include "dpe/estimation/model_selection.h"

namespace dpe::tools {

// Which model is about to be fitted.
void PrintModelFit(const ModelFit& fit);

// The candidates and why one was chosen.
void PrintModelSelection(const ModelSelection& selection);

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_MODEL_TABLE_H_

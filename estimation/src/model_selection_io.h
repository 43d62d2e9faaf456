// A model selection as part of the report.
#ifndef DPE_ESTIMATION_MODEL_SELECTION_IO_H_
#define DPE_ESTIMATION_MODEL_SELECTION_IO_H_

#include <nlohmann/json.hpp>

#include "dpe/estimation/model_selection.h"

namespace dpe {

// See ReportToJson; what is not known is null.
nlohmann::ordered_json ModelSelectionToJson(const ModelSelection& selection);

}  // namespace dpe

#endif  // DPE_ESTIMATION_MODEL_SELECTION_IO_H_

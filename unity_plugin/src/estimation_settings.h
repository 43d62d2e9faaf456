// Options of an estimation by the names of estimate_cloth's flags.
#ifndef DPE_UNITY_ESTIMATION_SETTINGS_H_
#define DPE_UNITY_ESTIMATION_SETTINGS_H_

#include <string>

#include "dpe/estimation/estimation_job.h"

namespace dpe::c {

// @throws ApiError for a name that is none, or a number out of range; SceneError for a
//         text that is not one of those to choose from; the job is then unchanged
void SetText(const std::string& name, const std::string& value, EstimationJob* job);
void SetNumber(const std::string& name, double value, EstimationJob* job);

}  // namespace dpe::c

#endif  // DPE_UNITY_ESTIMATION_SETTINGS_H_

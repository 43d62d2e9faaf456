#include <memory>
#include <stdexcept>
#include <string>

#include "blas_threads.h"
#include "call.h"
#include "dpe/dpe_c.h"
#include "dpe/engine/parameters.h"
#include "estimation_handle.h"
#include "estimation_settings.h"
#include "scene_handle.h"

using dpe::EstimatedBlock;
using dpe::EstimatorSummary;
using dpe::c::CallWith;
using dpe::c::CopyNumbers;
using dpe::c::CopyText;
using dpe::c::EstimationHandle;
using dpe::c::EstimationOutcome;
using dpe::c::Require;
using dpe::c::RequireText;

namespace {

int KindNumber(const std::string& name) {
  constexpr int kLast = static_cast<int>(dpe::ParameterKind::kInitialPosition);
  for (int kind = 0; kind <= kLast; ++kind) {
    if (dpe::ParameterKindName(static_cast<dpe::ParameterKind>(kind)) == name) {
      return kind;
    }
  }
  throw std::logic_error("unknown kind of parameter: " + name);
}

// The kinds of this interface are the engine's.
static_assert(DPE_MASS == static_cast<int>(dpe::ParameterKind::kMass) &&
              DPE_STIFFNESS == static_cast<int>(dpe::ParameterKind::kStiffness) &&
              DPE_DAMPING == static_cast<int>(dpe::ParameterKind::kDamping) &&
              DPE_DRAG == static_cast<int>(dpe::ParameterKind::kDrag) &&
              DPE_WIND == static_cast<int>(dpe::ParameterKind::kWind));
static_assert(DPE_CONVERGED == static_cast<int>(dpe::Termination::kConverged) &&
              DPE_NUMERICAL_FAILURE ==
                  static_cast<int>(dpe::Termination::kNumericalFailure));

const EstimatedBlock& BlockOf(const EstimatorSummary& summary, int block) {
  dpe::c::RequireIndex("block", block, static_cast<int>(summary.blocks.size()));
  return summary.blocks[block];
}

bool HasErrors(const EstimatorSummary& summary) {
  return summary.uncertainty.ok &&
         summary.uncertainty.blocks.size() == summary.blocks.size();
}

// work(const EstimationOutcome&) for an estimation that has one.
template <class Work>
dpe_status WithOutcome(dpe_estimation estimation, const Work& work) {
  return CallWith<EstimationHandle>(estimation,
                                    [&](EstimationHandle& e) { work(*e.outcome()); });
}

dpe_result ToResult(const EstimationOutcome& outcome) {
  const EstimatorSummary& summary = outcome.summary;
  dpe_result result{};
  result.termination = static_cast<int32_t>(summary.termination);
  result.iterations = summary.iterations;
  result.num_frames = summary.num_frames;
  result.num_blocks = static_cast<int32_t>(summary.blocks.size());
  result.num_parameters = static_cast<int32_t>(summary.parameters.size());
  result.initial_rms = summary.initial_rms;
  result.final_rms = summary.final_rms;
  result.seconds = summary.wall_time_s;
  result.deviation_percent = outcome.deviation_percent;
  return result;
}

}  // namespace

dpe_status dpe_estimation_create(uint32_t header_version, dpe_estimation* estimation) {
  return dpe::c::CreateWith<EstimationHandle>(estimation, [&] {
    dpe::c::RequireVersion(header_version);
    dpe::c::UseOneBlasThread();
    return std::make_shared<EstimationHandle>();
  });
}

dpe_status dpe_estimation_destroy(dpe_estimation estimation) {
  return dpe::c::Destroy<EstimationHandle>(estimation);
}

dpe_status dpe_estimation_set_text(dpe_estimation estimation, const char* name,
                                   const char* value) {
  return CallWith<EstimationHandle>(estimation, [&](EstimationHandle& e) {
    RequireText("the name", name);
    RequireText("the value", value);
    e.Configure([&](auto& job) { dpe::c::SetText(name, value, &job); });
  });
}

dpe_status dpe_estimation_set_number(dpe_estimation estimation, const char* name,
                                     double value) {
  return CallWith<EstimationHandle>(estimation, [&](EstimationHandle& e) {
    RequireText("the name", name);
    e.Configure([&](auto& job) { dpe::c::SetNumber(name, value, &job); });
  });
}

dpe_status dpe_estimation_set_callback(dpe_estimation estimation,
                                       dpe_progress_callback callback, void* user) {
  return CallWith<EstimationHandle>(
      estimation, [&](EstimationHandle& e) { e.SetCallback(callback, user); });
}

dpe_status dpe_estimation_start(dpe_estimation estimation) {
  return CallWith<EstimationHandle>(estimation, [](EstimationHandle& e) { e.Start(); });
}

dpe_status dpe_estimation_cancel(dpe_estimation estimation) {
  return CallWith<EstimationHandle>(estimation,
                                    [](EstimationHandle& e) { e.Cancel(); });
}

dpe_status dpe_estimation_poll(dpe_estimation estimation, int32_t* state,
                               dpe_progress* progress) {
  return CallWith<EstimationHandle>(estimation, [&](EstimationHandle& e) {
    Require(state != nullptr, "the state is null");
    *state = e.Poll(progress);
  });
}

dpe_status dpe_estimation_wait(dpe_estimation estimation, double seconds,
                               int32_t* state) {
  return CallWith<EstimationHandle>(estimation, [&](EstimationHandle& e) {
    Require(state != nullptr, "the state is null");
    *state = e.Wait(seconds);
  });
}

dpe_status dpe_estimation_get_result(dpe_estimation estimation, dpe_result* result) {
  return WithOutcome(estimation, [&](const EstimationOutcome& outcome) {
    Require(result != nullptr, "the result is null");
    *result = ToResult(outcome);
  });
}

dpe_status dpe_estimation_get_message(dpe_estimation estimation, char* buffer,
                                      int32_t capacity, int32_t* length) {
  return WithOutcome(estimation, [&](const EstimationOutcome& outcome) {
    std::string text = outcome.summary.message;
    for (const std::string& note : outcome.summary.notes) text += "\n" + note;
    CopyText(text, buffer, capacity, length);
  });
}

dpe_status dpe_estimation_get_block(dpe_estimation estimation, int32_t block,
                                    dpe_block* info) {
  return WithOutcome(estimation, [&](const EstimationOutcome& outcome) {
    Require(info != nullptr, "the info is null");
    const EstimatedBlock& found = BlockOf(outcome.summary, block);
    *info = {};
    info->object = found.object;
    info->kind = KindNumber(found.kind);
    info->mode = found.mode;
    info->num_values = static_cast<int32_t>(found.values.size());
    info->has_errors = HasErrors(outcome.summary) ? 1 : 0;
  });
}

dpe_status dpe_estimation_get_values(dpe_estimation estimation, int32_t block,
                                     double* values, int32_t capacity, int32_t* count) {
  return WithOutcome(estimation, [&](const EstimationOutcome& outcome) {
    const Eigen::VectorXd& all = BlockOf(outcome.summary, block).values;
    CopyNumbers(all.data(), all.size(), values, capacity, count);
  });
}

dpe_status dpe_estimation_get_errors(dpe_estimation estimation, int32_t block,
                                     double* errors, int32_t capacity, int32_t* count) {
  return WithOutcome(estimation, [&](const EstimationOutcome& outcome) {
    BlockOf(outcome.summary, block);
    Eigen::VectorXd all;
    if (HasErrors(outcome.summary)) {
      all = outcome.summary.uncertainty.blocks[block].standard_deviations;
    }
    CopyNumbers(all.data(), all.size(), errors, capacity, count);
  });
}

dpe_status dpe_estimation_get_files(dpe_estimation estimation, char* buffer,
                                    int32_t capacity, int32_t* length) {
  return WithOutcome(estimation, [&](const EstimationOutcome& outcome) {
    std::string text;
    for (const std::string& file : outcome.files) {
      text += (text.empty() ? "" : "\n") + file;
    }
    CopyText(text, buffer, capacity, length);
  });
}

dpe_status dpe_estimation_create_scene(dpe_estimation estimation, dpe_scene* scene) {
  return WithOutcome(estimation, [&](const EstimationOutcome& outcome) {
    Require(scene != nullptr, "the pointer that receives the scene is null");
    const auto made = std::make_shared<dpe::c::SceneHandle>(outcome.summary.scene, "");
    *scene = dpe::c::HandleTable::Global().Add(dpe::c::SceneHandle::kKind, made);
  });
}

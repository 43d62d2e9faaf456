#include "fuzz/call_order_calls.h"

namespace dpe::test {
namespace {

constexpr Kind kEstimation = Kind::kEstimation;

// Calls back into the interface, from the estimation's thread.
void OnProgress(void* user, const dpe_progress* progress) {
  const auto estimation = *static_cast<const dpe_estimation*>(user);
  std::int32_t state = 0;
  dpe_estimation_poll(estimation, &state, nullptr);
  dpe_estimation_wait(estimation, 1.0, &state);
  if (progress->iteration > 1) dpe_estimation_cancel(estimation);
}

// One that lasts a moment: three iterations of four frames.
void Create(CallOrderPlayer* p) {
  dpe_estimation estimation = 0;
  dpe_status status = dpe_estimation_create(DPE_C_VERSION, p->OrNull(&estimation));
  p->Check("dpe_estimation_create", status);
  if (status != DPE_OK) return;
  p->Remember(estimation, kEstimation);
  status = dpe_estimation_set_number(estimation, "max_iterations", 3);
  p->Check("dpe_estimation_set_number", status);
  if (p->Byte() % 4 == 0) return;
  status = dpe_estimation_set_text(estimation, "scene", p->files().scene.c_str());
  p->Check("dpe_estimation_set_text", status);
}

dpe_status SetText(CallOrderPlayer* p, dpe_estimation estimation) {
  static const char* const kNames[] = {"scene",   "target",     "settings", "estimate",
                                       "solver",  "output_dir", "init",     "horizon",
                                       "nothing", nullptr};
  static const char* const kValues[] = {"auto", "nG", "Gn", "scene",
                                        "full", "",   "?",  nullptr};
  const char* name = kNames[p->Byte() % 10];
  const char* value = p->Byte() % 2 == 0 ? kValues[p->Byte() % 8] : p->Path();
  // Nothing is to be written beside the folder, nor a target simulated for long.
  const bool is_folder = name != nullptr && std::string(name) == "output_dir";
  return dpe_estimation_set_text(estimation, name,
                                 is_folder ? p->files().folder.c_str() : value);
}

dpe_status SetNumber(CallOrderPlayer* p, dpe_estimation estimation) {
  static const char* const kNames[] = {"frames",      "validate_frames", "max_seconds",
                                       "noise_sigma", "sigma",           "seed",
                                       "follow_pins", "nothing",         nullptr};
  const char* name = kNames[p->Byte() % 9];
  const bool is_count =
      name != nullptr && std::string(name).find("frames") != std::string::npos;
  return dpe_estimation_set_number(estimation, name,
                                   is_count ? p->Byte() % 8 - 1 : p->Number());
}

template <class Number, class Get>
OneCall GetNumbers(const char* name, Get get) {
  return OnHandle(name, kEstimation, [=](CallOrderPlayer* p, dpe_estimation e) {
    dpe_status status = DPE_OK;
    const int block = p->Int();
    p->WithBuffer<Number>(name, [&](Number* buffer, int size, int* count) {
      status = get(e, block, buffer, size, count);
    });
    return status;
  });
}

template <class Get>
OneCall GetText(const char* name, Get get) {
  return OnHandle(name, kEstimation, [=](CallOrderPlayer* p, dpe_estimation e) {
    dpe_status status = DPE_OK;
    p->WithBuffer<char>(name, [&](char* buffer, int size, int* length) {
      status = get(e, buffer, size, length);
    });
    return status;
  });
}

dpe_status SetCallback(CallOrderPlayer* p, dpe_estimation estimation) {
  // Outlives all threads.
  static dpe_estimation last = 0;
  if (p->Byte() % 2 == 0) {
    return dpe_estimation_set_callback(estimation, nullptr, nullptr);
  }
  last = 0;  // a handle that is none, for the callback to be refused
  return dpe_estimation_set_callback(estimation, OnProgress, &last);
}

void CreateScene(CallOrderPlayer* p) {
  const HandleModel estimation = *p->Handle(kEstimation);
  dpe_scene scene = 0;
  const dpe_status status =
      dpe_estimation_create_scene(estimation.handle, p->OrNull(&scene));
  p->Check("dpe_estimation_create_scene", status, estimation, kEstimation);
  if (status == DPE_OK) p->Remember(scene, Kind::kScene);
}

}  // namespace

std::vector<OneCall> EstimationCalls() {
  return {
      Create,
      Create,
      CreateScene,
      OnHandle("dpe_estimation_set_text", kEstimation, SetText),
      OnHandle("dpe_estimation_set_number", kEstimation, SetNumber),
      OnHandle("dpe_estimation_set_callback", kEstimation, SetCallback),
      OnHandle(
          "dpe_estimation_start", kEstimation,
          [](CallOrderPlayer*, dpe_estimation e) { return dpe_estimation_start(e); }),
      OnHandle(
          "dpe_estimation_cancel", kEstimation,
          [](CallOrderPlayer*, dpe_estimation e) { return dpe_estimation_cancel(e); }),
      OnHandle("dpe_estimation_poll", kEstimation,
               [](CallOrderPlayer* p, dpe_estimation e) {
                 std::int32_t state = 0;
                 dpe_progress progress;
                 auto* to = p->OrNull(&state);
                 return dpe_estimation_poll(e, to, p->OrNull(&progress));
               }),
      OnHandle("dpe_estimation_wait", kEstimation,
               [](CallOrderPlayer* p, dpe_estimation e) {
                 std::int32_t state = 0;
                 const double seconds = p->Byte() % 8 == 0 ? -1.0 : 0.01;
                 return dpe_estimation_wait(e, seconds, p->OrNull(&state));
               }),
      OnHandle("dpe_estimation_get_result", kEstimation,
               [](CallOrderPlayer* p, dpe_estimation e) {
                 dpe_result result;
                 return dpe_estimation_get_result(e, p->OrNull(&result));
               }),
      OnHandle("dpe_estimation_get_block", kEstimation,
               [](CallOrderPlayer* p, dpe_estimation e) {
                 dpe_block block;
                 const int index = p->Int();
                 return dpe_estimation_get_block(e, index, p->OrNull(&block));
               }),
      GetText("dpe_estimation_get_message", dpe_estimation_get_message),
      GetText("dpe_estimation_get_files", dpe_estimation_get_files),
      GetNumbers<double>("dpe_estimation_get_values", dpe_estimation_get_values),
      GetNumbers<double>("dpe_estimation_get_errors", dpe_estimation_get_errors),
  };
}

}  // namespace dpe::test

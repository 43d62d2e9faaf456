#include "experiments/arguments.h"

#include <algorithm>

#include "dpe/engine/scene.h"

namespace dpe::experiments {

void RequireKnownArguments(const Job& job, const std::vector<std::string>& known) {
  for (const auto& [key, value] : job.values()) {
    if (key == "id" || key == "kind" || key == "note" || key.rfind("note_", 0) == 0) {
      continue;
    }
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string names;
    for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
    throw SceneError(key + ": there is no such argument of " + job.Text("kind", "") +
                     "; accepted are " + names + ", and note_...");
  }
}

}  // namespace dpe::experiments

#include "dpe/engine/timings.h"

#include <algorithm>
#include <cstdio>

namespace dpe {
namespace {

constexpr const char* kNames[Timings::kNumParts] = {
    "forces", "assembly",          "factorisation",
    "solve",  "derivative passes", "least squares"};

void AppendLine(const char* name, double seconds, double total, long calls,
                std::string* table) {
  char line[128];
  char count[32] = "";
  if (calls > 0) std::snprintf(count, sizeof(count), "%ld", calls);
  std::snprintf(line, sizeof(line), "%-18s %10.4f %8.1f %10s\n", name, seconds,
                total > 0.0 ? 100.0 * seconds / total : 0.0, count);
  *table += line;
}

}  // namespace

std::string Timings::Table(double total_seconds, const std::string& rest) const {
  std::string table = "part                 time (s)  share %      calls\n";
  double sum = 0.0;
  for (int i = 0; i < kNumParts; ++i) {
    const TimedPart part = static_cast<TimedPart>(i);
    if (Calls(part) == 0) continue;
    sum += Seconds(part);
    AppendLine(kNames[i], Seconds(part), total_seconds, Calls(part), &table);
  }
  AppendLine(rest.c_str(), std::max(total_seconds - sum, 0.0), total_seconds, 0,
             &table);
  AppendLine("total", total_seconds, total_seconds, 0, &table);
  return table;
}

}  // namespace dpe

// Numbers as JSON: what is not finite is null, which JSON has instead.
#ifndef DPE_ESTIMATION_JSON_NUMBERS_IO_H_
#define DPE_ESTIMATION_JSON_NUMBERS_IO_H_

#include <cmath>
#include <nlohmann/json.hpp>

namespace dpe {

inline nlohmann::ordered_json JsonNumber(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

template <typename Values>
nlohmann::ordered_json JsonNumbers(const Values& values) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const double value : values) array.push_back(JsonNumber(value));
  return array;
}

}  // namespace dpe

#endif  // DPE_ESTIMATION_JSON_NUMBERS_IO_H_

// The words that stand for enumerators in scene files.
#ifndef DPE_ENGINE_SRC_IO_ENUM_NAMES_H_
#define DPE_ENGINE_SRC_IO_ENUM_NAMES_H_

#include "dpe/engine/scene.h"

namespace dpe {

template <typename Enum>
struct EnumName {
  Enum value;
  const char* name;
};

inline constexpr EnumName<SpringKind> kSpringKindNames[] = {
    {SpringKind::kStretch, "stretch"},
    {SpringKind::kShear, "shear"},
    {SpringKind::kBend, "bend"},
};

inline constexpr EnumName<AerodynamicsLaw> kAerodynamicsNames[] = {
    {AerodynamicsLaw::kAuthored, "authored"},
    {AerodynamicsLaw::kUnitNormal, "unit_normal"},
};

// The name of a value, from one of the tables above.
template <typename Enum, size_t N>
const char* NameOf(const EnumName<Enum> (&names)[N], Enum value) {
  for (const EnumName<Enum>& entry : names) {
    if (entry.value == value) return entry.name;
  }
  return "";
}

}  // namespace dpe

#endif  // DPE_ENGINE_SRC_IO_ENUM_NAMES_H_

#include "utf8.h"

#include <cstdint>

namespace dpe::c {
namespace {

// How many bytes the character has that begins here; 0: none does.
int LengthOf(const unsigned char* byte) {
  const unsigned first = byte[0];
  int length = 0;
  std::uint32_t code = 0, least = 0;
  if (first < 0x80) {
    return 1;
  } else if (first >= 0xC0 && first < 0xE0) {
    length = 2, code = first & 0x1F, least = 0x80;
  } else if (first >= 0xE0 && first < 0xF0) {
    length = 3, code = first & 0x0F, least = 0x800;
  } else if (first >= 0xF0 && first < 0xF8) {
    length = 4, code = first & 0x07, least = 0x10000;
  } else {
    return 0;
  }
  // The zero byte at the end is no continuation, so this stops there.
  for (int i = 1; i < length; ++i) {
    if ((byte[i] & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte[i] & 0x3F);
  }
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  return code < least || is_surrogate || code > 0x10FFFF ? 0 : length;
}

}  // namespace

bool IsUtf8(const char* text) {
  const auto* byte = reinterpret_cast<const unsigned char*>(text);
  while (*byte != 0) {
    const int length = LengthOf(byte);
    if (length == 0) return false;
    byte += length;
  }
  return true;
}

}  // namespace dpe::c

// Numbers of binary files, assembled byte by byte: whatever the order of this machine.
#ifndef DPE_ESTIMATION_SRC_CAPTURES_BINARY_H_
#define DPE_ESTIMATION_SRC_CAPTURES_BINARY_H_

#include <cstddef>
#include <cstring>

namespace dpe {

template <typename Bits>
Bits ReadBits(const char* bytes, bool big_endian = false) {
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof(Bits); ++i) {
    const std::size_t byte = big_endian ? i : sizeof(Bits) - 1 - i;
    bits = static_cast<Bits>(bits << 8 | static_cast<unsigned char>(bytes[byte]));
  }
  return bits;
}

// An IEEE number of the size of Bits.
template <typename Float, typename Bits>
Float ReadFloat(const char* bytes, bool big_endian = false) {
  static_assert(sizeof(Float) == sizeof(Bits));
  const Bits bits = ReadBits<Bits>(bytes, big_endian);
  Float value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

}  // namespace dpe

#endif  // DPE_ESTIMATION_SRC_CAPTURES_BINARY_H_

// FNV-1a, 64 bits: the same wherever the program is compiled, unlike std::hash.
#ifndef DPE_TOOLS_EXPERIMENTS_HASH_H_
#define DPE_TOOLS_EXPERIMENTS_HASH_H_

#include <cstddef>
#include <cstdint>

namespace dpe::experiments {

constexpr std::uint64_t kHashStart = 14695981039346656037u;

// @param hash  kHashStart, or the hash of what stands before these bytes
inline std::uint64_t Hash(const void* bytes, std::size_t count,
                          std::uint64_t hash = kHashStart) {
  const auto* byte = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < count; ++i) hash = (hash ^ byte[i]) * 1099511628211u;
  return hash;
}

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_HASH_H_

#pragma once
// A checksum.
#include <cstdint>
#include <string_view>

namespace cnem {

/// FNV-1a, 64 bits (Fowler, Noll and Vo).
inline std::uint64_t fnv(std::string_view bytes) {
  std::uint64_t h = 0xcbf29ce484222325U;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return h;
}

} // namespace cnem

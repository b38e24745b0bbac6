// FNV-1a, 64 bits: the same number on every machine and compiler, unlike std::hash.
#pragma once

#include <cstdint>
#include <string_view>

namespace canhil::world {

/// To hash a text in parts, pass the hash of the preceding part as `hash`.
constexpr std::uint64_t fnv1a_64(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325U) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

}  // namespace canhil::world

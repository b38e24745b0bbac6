// Finds the keys that a reader requests. Runs the reader first with an empty text, then with each key on
// which other keys may depend. So keys that are read only together with other keys are found too.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/described.hpp"

namespace canhil::reference {

/// A key, and the condition under which it is read, as text: "Only with `trajectory` `weave`."
struct AskedKey {
  scenario::DescribedKey key;
  std::string only;                     ///< empty: the key does not depend on other keys
  std::vector<std::string> in_place{};  ///< keys that make a required key unnecessary
};

/// Reads a TOML text. The reader may reject the text, because only the keys that the reader requests are
/// evaluated.
using Read = std::function<void(std::string_view text)>;

enum class Depth : std::uint8_t { as_it_is, every_branch };

/// `given`: the beginning of each text that the reader gets.
std::vector<AskedKey> explore(const Read& read, const std::string& given = "",
                              Depth depth = Depth::every_branch);

}  // namespace canhil::reference

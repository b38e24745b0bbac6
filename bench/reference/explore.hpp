// Finds the keys that a reader asks for by running it: first with an empty text, then with each key on which
// something depends. So keys that are read only beside others are found too.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenario/described.hpp"

namespace canhil::reference {

/// A key and, in words, the condition under which it is read: "Only with `trajectory` `weave`."
struct AskedKey {
  scenario::DescribedKey key;
  std::string only;                     ///< empty: it does not depend on other keys
  std::vector<std::string> in_place{};  ///< keys beside which a required one is not required
};

/// Reads a TOML text. It may reject the text: only the keys that it asked for are evaluated.
using Read = std::function<void(std::string_view text)>;

enum class Depth : std::uint8_t { as_it_is, every_branch };

/// `given`: the beginning of each text.
std::vector<AskedKey> explore(const Read& read, const std::string& given = "",
                              Depth depth = Depth::every_branch);

}  // namespace canhil::reference

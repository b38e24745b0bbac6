// Formats a snapshot as text lines that fit a terminal of any size.
#pragma once

#include <string>
#include <vector>

#include "bench/live/snapshot.hpp"

namespace canhil::live {

struct ScreenLine {
  enum class Look : std::uint8_t { plain, heading, good, bad, open };
  std::string text;  ///< ASCII except in names
  Look look = Look::plain;
};

/// The lines, most important first: at most `rows` lines, none longer than `columns`.
std::vector<ScreenLine> screen_of(const Snapshot& snapshot, std::size_t rows, std::size_t columns,
                                  bool paused);

}  // namespace canhil::live

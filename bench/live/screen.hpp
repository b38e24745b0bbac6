// Formats a snapshot as text lines that fit a terminal of any size.
#pragma once

#include <string>
#include <vector>

#include "bench/live/snapshot.hpp"

namespace canhil::live {

struct ScreenLine {
  enum class Look : std::uint8_t { plain, heading, good, bad, open };
  std::string text;  ///< in ASCII, but for names
  Look look = Look::plain;
};

/// The most important first: at most so many lines, none longer than there are columns.
std::vector<ScreenLine> screen_of(const Snapshot& snapshot, std::size_t rows, std::size_t columns,
                                  bool paused);

}  // namespace canhil::live

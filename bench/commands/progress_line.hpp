// A progress line on stderr, shown only if stderr is a terminal.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "dbc/text/escape.hpp"

namespace canhil::commands {

class ProgressLine {
 public:
  ProgressLine() : shown_(isatty(STDERR_FILENO) != 0) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Replaces the line by the result of `text()`.
  template <class Text>
  void show(Text&& text) const {
    if (shown_) fmt::print(stderr, "\r\033[K  {}", one_line(text()));
  }
  void clear() const {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }

 private:
  bool shown_;
};

/// A bar such as "[=====     ]". `fraction` is done / total, from 0 to 1.
inline std::string progress_bar(double fraction) {
  constexpr int width = 30;
  const int done = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width);
  return fmt::format("[{:=<{}}{:{}}]", "", done, "", width - done);
}

}  // namespace canhil::commands

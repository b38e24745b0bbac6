// Reads whole logs from the bytes of a fuzzer: every entry must be a frame that a bus can carry, every
// message one line.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "dbc/logs/formats.hpp"
#include "dbc/wire/frame_rules.hpp"

namespace canhil::fuzz {

inline void expect_one_line(const std::string& message) {
  if (message.empty() || message.find('\n') != std::string::npos) std::abort();
}

inline void expect_frame(const LogEntry& entry) {
  const Frame& frame = entry.frame;
  if (!can_carry(frame, true) || entry.t_ns < 0 || entry.interface.empty()) std::abort();
  if (!std::ranges::all_of(entry.interface, [](char c) { return c > ' ' && c <= '~'; })) std::abort();
  if (entry.remote && (frame.fd || frame.error)) std::abort();
}

/// Reads to the end of the log or to the first error.
inline void read_all(Result<std::unique_ptr<LogSource>> source) {
  if (!source) return expect_one_line(source.error().message);
  for (;;) {
    const auto entry = (*source)->next();
    if (!entry) expect_one_line(entry.error().message);
    if (!entry || !*entry) break;
    expect_frame(**entry);
  }
  for (const std::string& remark : (*source)->remarks("fuzz")) expect_one_line(remark);
}

/// Reads the bytes with the source of a format.
template <class Source>
void read_with(const std::uint8_t* data, std::size_t size, const Source& source) {
  auto input = logs::Input::of_memory({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!input) return expect_one_line(input.error().message);
  read_all(source(std::move(*input)));
}

}  // namespace canhil::fuzz

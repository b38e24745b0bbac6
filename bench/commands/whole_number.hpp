// Whole numbers on the command line. CLI11 reads them as strtoull does: -1 is a large number there, 010 is
// eight, and what is too large is the largest.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace canhil::commands {

/// Adds an option or argument that takes a decimal number from `least` to `most`. `value` must outlive the
/// command. Refused otherwise, in one line.
inline CLI::Option* add_whole_number(CLI::App& command, const std::string& name,
                                     std::optional<std::uint64_t>& value, const std::string& description,
                                     std::uint64_t least = 0,
                                     std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) {
  const auto read = [&value, name, least, most](const std::string& text) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc{} && end == text.data() + text.size();
    if (!whole || number < least || number > most) {
      throw CLI::ValidationError(name, "'" + text + "' is not a whole number from " + std::to_string(least) +
                                           " to " + std::to_string(most));
    }
    value = number;
  };
  return command.add_option_function<std::string>(name, read, description)->type_name("UINT");
}

}  // namespace canhil::commands

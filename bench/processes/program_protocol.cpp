#include "bench/processes/program_protocol.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <system_error>

#include "dbc/text/escape.hpp"

namespace canhil::processes::program_protocol {
namespace {

// "1" is a plain number.
constexpr std::array<std::string_view, 11> units{"1",     "rad", "rad/s", "rad/s^2", "m", "m/s",
                                                 "m/s^2", "s",   "Pa",    "K",       "T"};
constexpr std::string_view blanks = " \t";
constexpr std::size_t most_variables = 1000;  // inputs and outputs each
constexpr std::string_view state = "state", error = "error";

// Takes the next word from the text; empty: there is none.
std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

// A name that expressions can use: rudder, attitude.heading.
bool is_name(std::string_view name) {
  constexpr std::size_t most = 64;
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto part = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '.'; };
  return !name.empty() && name.size() <= most && letter(name.front()) && name.back() != '.' &&
         name.find("..") == std::string_view::npos && std::ranges::all_of(name, part);
}

// An option of a variable: turns, steps, start=NUMBER.
bool take_option(std::string_view option, bool is_input, Variable& variable) {
  constexpr std::string_view start = "start=";
  if (option == "turns" && variable.si == "rad") {
    variable.turns = true;
  } else if (option == "steps") {
    variable.steps = true;
  } else if (option.starts_with(start) && is_input) {
    const auto value = number_of(option.substr(start.size()));
    variable.start = value.value_or(0);
    return value && std::isfinite(*value);
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::vector<std::string_view> words_of_line(std::string_view line) {
  std::vector<std::string_view> words;
  for (auto word = next_word(line); !word.empty(); word = next_word(line)) words.push_back(word);
  return words;
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (code != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::string opening(std::span<const Parameter> parameters, const Opening& opening) {
  std::string lines =
      fmt::format("canhil-{} 1\nseed {}\nrun {}\n", opening.role, opening.seed, opening.run_index);
  if (!opening.name.empty()) lines += fmt::format("name {}\n", opening.name);
  lines += opening.further;
  for (const auto& [name, value] : parameters) {
    if (const auto* text = std::get_if<std::string>(&value))
      lines += fmt::format("text {} {}\n", name, *text);
    else
      lines += fmt::format("number {} {}\n", name, std::get<double>(value));
  }
  return lines + "start\n";
}

std::string step_line(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) {
  std::string line = fmt::format("step {} {}", from_us, to_us);
  for (const double value : inputs) fmt::format_to(std::back_inserter(line), " {}", value);
  return line + '\n';
}

bool is_state(std::string_view line) { return next_word(line) == state; }

Result<void> declare(std::string_view line, Declared& declared) {
  const auto wrong = [&](std::string_view what, std::string_view expected) {
    return failure(fmt::format("wrote {}: {}, expected {}", shown(line), what, expected));
  };
  const auto words = words_of_line(line);
  if (words.size() < 3 || (words[0] != "input" && words[0] != "output"))
    return wrong("not a declaration", "'input NAME UNIT', 'output NAME UNIT' or 'state' and numbers");
  const bool is_input = words[0] == "input";
  Variable variable{.name = std::string(words[1]), .si = std::string(words[2])};
  if (!is_name(variable.name))
    return wrong("not a name", "at most 64 letters, digits, '_' and '.', first a letter");
  if (std::ranges::find(units, variable.si) == units.end())
    return wrong(fmt::format("unit '{}' is unknown", one_line(variable.si)),
                 fmt::format("one of {}", fmt::join(units, ", ")));
  for (std::size_t i = 3; i < words.size(); ++i) {
    if (!take_option(words[i], is_input, variable))
      return wrong(fmt::format("'{}' is not an option here", one_line(words[i])),
                   "turns (of an angle in rad), steps, or start=NUMBER (of an input)");
  }
  if (variable.si == "1") variable.si.clear();
  auto& all = is_input ? declared.inputs : declared.outputs;
  if (std::ranges::find(all, variable.name, &Variable::name) != all.end())
    return wrong("declared before", "each name once");
  if (all.size() == most_variables)
    return wrong("too many", fmt::format("at most {} inputs and {} outputs", most_variables, most_variables));
  all.push_back(std::move(variable));
  return {};
}

Result<void> read_state(std::string_view line, std::span<const Variable> outputs, std::span<double> values) {
  if (!is_state(line))
    return failure(fmt::format("wrote {}, expected '{}' and {} numbers", shown(line), state, outputs.size()));
  std::string_view rest = line;
  next_word(rest);
  std::size_t read = 0;
  for (auto word = next_word(rest); !word.empty(); word = next_word(rest), ++read) {
    if (read >= outputs.size()) continue;
    const std::string& name = outputs[read].name;
    const auto value = number_of(word);
    if (!value)
      return failure(
          fmt::format("wrote '{}' for '{}', expected a number", one_line(word.substr(0, 40)), name));
    if (!std::isfinite(*value))
      return failure(fmt::format("wrote {} for '{}', expected a finite number", *value, name));
    values[read] = *value;
  }
  if (read == outputs.size()) return {};
  return failure(
      fmt::format("wrote {}: the number of values is {}, expected {}", shown(line), read, outputs.size()));
}

const char* error_text(const std::string& line) {
  const bool is_error = line.starts_with(error) && (line.size() == error.size() || line[error.size()] == ' ');
  return is_error ? line.c_str() + std::min(error.size() + 1, line.size()) : nullptr;
}

std::string shown(std::string_view line) {
  constexpr std::size_t most = 80;
  if (line.size() <= most) return fmt::format("'{}'", one_line(line));
  std::size_t end = most;
  const auto continues_a_character = [](char byte) { return static_cast<signed char>(byte) < -64; };  // UTF-8
  while (end > 0 && continues_a_character(line[end])) --end;
  return fmt::format("'{}...'", one_line(line.substr(0, end)));
}

}  // namespace canhil::processes::program_protocol

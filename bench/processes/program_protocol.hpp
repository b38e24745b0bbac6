// The lines that the bench and a program of the user exchange (docs/plant-program.md, docs/programs.md). A
// line has no line end here.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/processes/program_settings.hpp"
#include "bench/processes/variable.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::processes {

namespace program_protocol {

using Parameter = ProgramSettings::Parameter;

/// What a program is told before it starts.
struct Opening {
  std::string_view role;    ///< what it is: "plant", "sensor", "node"
  std::string_view name{};  ///< of the sensor or node; empty: it has none
  std::uint64_t seed = 0, run_index = 0;
  std::string further{};  ///< further lines
};

/// The lines with which the bench begins, with their line ends.
std::string opening(std::span<const Parameter> parameters, const Opening& opening);

/// The line that asks for a step, with its line end. Numbers are written so that they are read back exactly.
std::string step_line(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs);

inline constexpr std::string_view end_line = "end\n";

/// The inputs and outputs of a program, in the order of its lines.
struct Declared {
  std::vector<Variable> inputs{}, outputs{};
  friend bool operator==(const Declared&, const Declared&) = default;
};

/// The words of a line.
std::vector<std::string_view> words_of_line(std::string_view line);
/// A number as C, Python and most other languages write it; also nan and inf. None: the word is another.
std::optional<double> number_of(std::string_view word);

/// True for a line that gives values: it ends the declarations.
bool is_state(std::string_view line);

/// Adds the input or output that a line declares. Error, one phrase: the line is wrong, or too many.
Result<void> declare(std::string_view line, Declared& declared);

/// Reads the values of the outputs from a line; `values` has one element for each output. Error, one phrase:
/// the line does not give a finite number for each output.
Result<void> read_state(std::string_view line, std::span<const Variable> outputs, std::span<double> values);

/// The text of a line with which a program reports that it cannot go on; null: the line is another one.
const char* error_text(const std::string& line);

/// A line in quotes for a message: escaped, and shortened if it is long.
std::string shown(std::string_view line);

}  // namespace program_protocol
}  // namespace canhil::processes

// The lines that the bench and a plant's program exchange (docs/plant-program.md). A line has no line end
// here.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bench/plant/plant.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::plant::program_protocol {

/// The name of a parameter, and its number or text.
using Parameter = std::pair<std::string, std::variant<double, std::string>>;

/// The lines with which the bench begins, with their line ends.
std::string opening(std::span<const Parameter> parameters, const Draw& draw);

/// The line that asks for a step, with its line end. Numbers are written so that they are read back exactly.
std::string step_line(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs);

inline constexpr std::string_view end_line = "end\n";

/// The inputs and outputs of a program, in the order of its lines.
struct Declared {
  std::vector<Variable> inputs{}, outputs{};
};

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

}  // namespace canhil::plant::program_protocol

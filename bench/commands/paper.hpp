#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bench/commands/exit_code.hpp"
#include "dbc/wire/unrounded.hpp"

namespace canhil::commands {

// As typed.
struct PaperArguments {
  std::string paper;
  std::string folder;  // empty: paper-NAME here
  Rounding rounding = Rounding::as_on_the_bus;
  std::string exact;
  std::optional<std::uint64_t> runs;
};

/// `hil-bench campaign --paper NAME`: flies what a paper claims, prints the tables, writes the page.
ExitCode reproduce_paper(const PaperArguments& arguments);

}  // namespace canhil::commands

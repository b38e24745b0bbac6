// What the analysis does with a DBC that violates rules. A finding about receivers, values or comments does
// not change the time of any frame; a finding about cycle times or the size of a message does.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dbc/parser/finding.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::schedulability {

/// A rule that the DBC violates, and that does not touch timing. The analysis assumes what the lenient reader
/// does.
struct Tolerated {
  dbc::Rule rule{};
  std::size_t count = 0;  ///< number of findings
  dbc::Finding first;
};

/// The warnings about a DBC, in the order of the rules. Error, one line: the first finding that may change
/// the time of a frame, or because of which the file is refused.
Result<std::vector<Tolerated>> tolerated(const dbc::Inspection& inspection, const std::string& file);

}  // namespace canhil::schedulability

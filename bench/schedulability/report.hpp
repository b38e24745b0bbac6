// The results of the analysis as a table for people and as JSON for programs.
#pragma once

#include <span>
#include <string>

#include "bench/schedulability/analysis.hpp"
#include "bench/schedulability/tolerance.hpp"

namespace canhil::schedulability {

/// Inputs and results of the analysis; responses[i] belongs to streams[i].
struct Analysis {
  std::string file;
  Bus bus;
  std::vector<Stream> streams;
  std::vector<Response> responses;
  std::vector<Tolerated> tolerated{};  ///< what is odd about the DBC
};

/// Analyses the messages `streams`, which must be sorted by priority.
Analysis analyse(std::string file, std::vector<Stream> streams, const Bus& bus);

/// True if every message meets its deadline.
bool schedulable(const Analysis& analysis);

/// One line for each message, sorted by priority, with times in ms. After these lines come the utilisation,
/// the assumptions and the verdict.
std::string table(const Analysis& analysis);

/// One JSON object. Times are in s; a missing value is null. docs/schedulability.md describes the keys.
std::string json(const Analysis& analysis);

}  // namespace canhil::schedulability

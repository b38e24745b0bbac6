// The results of the analysis as a table for people and as JSON for programs.
#pragma once

#include <span>
#include <string>

#include "bench/schedulability/analysis.hpp"

namespace canhil::schedulability {

/// Inputs and results of the analysis; responses[i] belongs to streams[i].
struct Analysis {
  std::string file;
  Bus bus;
  std::vector<Stream> streams;
  std::vector<Response> responses;
};

/// Analyses streams, which must be sorted by priority.
Analysis analyse(std::string file, std::vector<Stream> streams, const Bus& bus);

/// True if every message meets its deadline.
bool schedulable(const Analysis& analysis);

/// One line for each message by priority, times in ms; then the utilisation, the assumptions and the verdict.
std::string table(const Analysis& analysis);

/// One JSON object, times in s; null where there is no value. docs/schedulability.md names the keys.
std::string json(const Analysis& analysis);

}  // namespace canhil::schedulability

// A node that sends what was recorded: of any kind, by the names that the DBC gives the signals of its sample
// group. No error model works on it.
//
// From a CSV file (scenario/table.hpp) a row is a sample: its signals by their names, its time of validity by
// t_s. From a candump log of this contract the frames of its group are sent as they were, at their place in
// the time base of the log's Sync: what a run recorded with --log is flown again. A recording of another kind
// is one more reader beside these two, chosen in read_recorded(); what it makes a scenario::Table of is sent
// by what is here.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/nodes/kind.hpp"
#include "bench/scenario/schedule.hpp"
#include "bench/scenario/table.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::nodes {

/// Samples: of each the values of its group's signals, message by message in the order of ids.
struct RecordedSamples {
  std::vector<std::int64_t> valid_us{};     ///< ascending
  std::vector<std::int64_t> interval_us{};  ///< up to each, for groups that tell it
  std::vector<double> values{};             ///< sample by sample, in the units of the signals
  std::size_t signals = 0;                  ///< of a sample
};

/// Frames as they were.
struct RecordedFrames {
  struct At {
    std::int64_t due_us = 0;
    std::size_t index = 0;  ///< in the log: those of several nodes keep their order
    Frame frame;
  };
  std::vector<At> frames{};
};

/// A table with the key `recorded`, of any node.
struct RecordedSettings {
  scenario::Schedule schedule{};
  std::string recorded_from;  ///< the file
  std::shared_ptr<const RecordedSamples> samples{};
  std::shared_ptr<const RecordedFrames> frames{};  ///< one of the two
};

/// The keys recorded, period_ms and, of a CSV file, latency_ms, from_s and gap_s.
NodeSettings read_recorded(const NodeTable& table, Section& section, std::int64_t duration_us);

/// Error: one line about the file.
Result<RecordedSamples> read_samples(const NodeTable& table, const scenario::Table& rows,
                                     std::int64_t from_us, std::int64_t gap_us, std::int64_t period_us,
                                     std::int64_t end_us);
/// The columns that they are read from.
std::vector<std::string> columns_of(const NodeTable& table);

/// Error: one line about the file. `median_us`: the usual time from a sample of the group to the next; 0:
/// there are too few.
struct LoggedGroup {
  RecordedFrames frames;
  std::int64_t median_us = 0;
};
Result<LoggedGroup> read_frames(const NodeTable& table, const std::string& log, std::int64_t end_us);

/// Nodes that send these.
std::unique_ptr<Node> make_samples(const NodeSettings& node, const Run& run);
std::unique_ptr<Node> make_frames(const std::vector<const RecordedFrames*>& of_one_log, const Run& run);

}  // namespace canhil::nodes

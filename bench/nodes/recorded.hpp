// A node that sends recorded samples. It can replace a node of any kind. The columns of the recording are
// named after the signals of the node's sample group in the DBC. No error model is applied.
//
// In a CSV file (scenario/table.hpp) each row is a sample. The columns contain its signals and, in t_s, its
// time of validity. From a candump log with canhil's DBC, the frames of the group are sent unchanged, at the
// times that they had in the time base of the recorded run (from the Sync frames of the log). So a run
// recorded with --log can be flown again. To support another format, add a reader that returns a
// scenario::Table, and select this reader in read_recorded(); the table is then sent like a CSV file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/nodes/kind.hpp"
#include "bench/scenario/schedule.hpp"
#include "bench/scenario/table.hpp"
#include "dbc/wire/frame.hpp"

namespace canhil::nodes {

/// Recorded samples, in the order of their times of validity. For groups with an interval, the interval of a
/// sample is the time since the previous one.
using RecordedSamples = std::vector<sensors::Sample>;

/// Frames of a log, unchanged.
struct RecordedFrames {
  struct At {
    std::int64_t due_us = 0;
    std::size_t index = 0;  ///< position in the log: keeps the order of frames of several nodes
    Frame frame;
  };
  std::vector<At> frames{};
};

/// The settings of a node of any kind whose table has the key `recorded`.
struct RecordedSettings {
  scenario::Schedule schedule{};
  std::string recorded_from;  ///< the file
  std::shared_ptr<const RecordedSamples> samples{};
  std::shared_ptr<const RecordedFrames> frames{};  ///< exactly one of `samples` and `frames` is set
};

/// Reads the keys `recorded` and `period_ms` and, for a CSV file, `latency_ms`, `from_s` and `gap_s`.
NodeSettings read_recorded(const NodeTable& table, Section& section, std::int64_t duration_us);

/// An error is one line about the file.
Result<RecordedSamples> read_samples(const NodeTable& table, const scenario::Table& rows,
                                     std::int64_t from_us, std::int64_t gap_us, std::int64_t period_us,
                                     std::int64_t end_us);
/// The columns that read_samples() accepts.
std::vector<std::string> columns_of(const NodeTable& table);

/// The frames of a sample group in a log.
struct LoggedGroup {
  RecordedFrames frames;
  std::int64_t median_us = 0;  ///< median time between samples; 0: too few samples
};
/// Error: one line about the file.
Result<LoggedGroup> read_frames(const NodeTable& table, const std::string& log, std::int64_t end_us);

/// Makes a sensor of recorded samples. In a log, a sample is a complete group of whole frames; a sample that
/// its counters lack is lost.
std::unique_ptr<sensors::Sensor> make_recorded(const NodeSettings& node, const Run& run);
std::unique_ptr<sensors::Sensor> make_logged(const NodeSettings& node, const Run& run);
/// Makes the node that sends the frames of a log unchanged.
std::unique_ptr<Node> make_frames(const std::vector<const RecordedFrames*>& of_one_log, const Run& run);

}  // namespace canhil::nodes

// Compares the time stamps that the same frames have in two recordings of one bus.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::recordings {

/// The result for all frames with one id. A difference is the stamp in log b minus the stamp in log a.
struct StampDifference {
  std::uint32_t id = 0;
  bool extended = false;
  std::uint64_t count = 0;  ///< number of frames that are in both logs
  double mean_s = 0, sd_s = 0, min_s = 0, max_s = 0;
  std::uint64_t only_in_a = 0, only_in_b = 0;
};

struct StampsCompared {
  std::vector<StampDifference> messages;  ///< sorted by id
  StampDifference all;
  /// The number of frames of one log that were recorded while the other log did not record.
  std::uint64_t outside = 0;
};

/// Two frames count as the same one if they have the same id and content and their stamps, corrected for the
/// clock difference, are at most 5 ms apart. The clock difference starts as the median over the frames whose
/// content occurs once in each log, and then follows the drift of the clocks. Error frames are ignored.
/// Returns an error of one line if a log cannot be read or has no frame.
Result<StampsCompared> compare_stamps(const std::string& log_a, const std::string& log_b);

/// A function that returns the name of a message; an empty string: the name is unknown.
using MessageName = std::function<std::string(const StampDifference& message)>;

/// One line for each message, and one line for all messages together. Times are in us.
std::string to_text(const StampsCompared& compared, const MessageName& name);
/// One object with the keys `messages`, `all` and `outside`. Each element of `messages` has the keys `id`,
/// `extended`, `name`, `count`, `mean_s`, `sd_s`, `min_s`, `max_s`, `only_in_a` and `only_in_b`. If `count`
/// is 0, the keys that end with `_s` are omitted.
std::string to_json(const StampsCompared& compared, const MessageName& name);

}  // namespace canhil::recordings

// Compares the stamps of the same frames in two recordings of one bus.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::recordings {

/// The differences of the stamps (b minus a) of the frames with one id.
struct StampDifference {
  std::uint32_t id = 0;
  bool extended = false;
  std::uint64_t count = 0;  ///< frames that are in both logs
  double mean_s = 0, sd_s = 0, min_s = 0, max_s = 0;
  std::uint64_t only_in_a = 0, only_in_b = 0;
};

struct StampsCompared {
  std::vector<StampDifference> messages;  ///< by id
  StampDifference all;
  std::uint64_t outside = 0;  ///< frames of one log outside the recording time of the other
};

/// Two frames count as the same one if they have the same id and content and their stamps, corrected for the
/// clock difference, are at most 5 ms apart. The clock difference is the median over frames whose content
/// occurs once; its drift is tracked. Error frames are ignored. Error: one line; a log cannot be read or has
/// no frame.
Result<StampsCompared> compare_stamps(const std::string& log_a, const std::string& log_b);

/// The name of a message; empty: unknown.
using MessageName = std::function<std::string(const StampDifference& message)>;

/// A line for each message and a line for all messages, in us.
std::string to_text(const StampsCompared& compared, const MessageName& name);
/// One object: `messages` (`id`, `extended`, `name`, `count`, `mean_s`, `sd_s`, `min_s`, `max_s`,
/// `only_in_a`, `only_in_b`; no times where `count` is 0), `all`, `outside`.
std::string to_json(const StampsCompared& compared, const MessageName& name);

}  // namespace canhil::recordings
